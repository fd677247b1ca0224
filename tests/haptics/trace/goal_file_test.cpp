#include "haptics/trace/goal_file.h"

#include <gtest/gtest.h>

#include <string>

namespace marsview {
namespace {

TEST(GoalFile, NamesTheLineOfARecordingThatItCannotRead)
{
    const std::string header = "x,y,z,map,part,model,radius_m,exaggeration\n";
    const auto goals = readGoalRecording(header + "1,2,3,1,7,god-object,0.5,2\n", "a.csv");
    ASSERT_TRUE(goals);
    ASSERT_EQ(goals->parts.size(), 1U);
    EXPECT_EQ(goals->parts[0].kind, ContactModelKind::GodObject);
    EXPECT_TRUE(readGoalRecording("x,y,z\n1,2,3\n", "a.csv")->parts.empty());
    for (const char* line : {"1,2,3,1,7,god-objects,0.5,2", "1,2,3,1,7,god-object,0.5",
                             "1,2,3,1,7,god-object,0,2", "1,2,3,1,7,god-object,0.5,nan",
                             "1,2,3,-1,7,god-object,0.5,2", "1,2,3,1,,god-object,0.5,2"}) {
        const auto refused = readGoalRecording(header + line + "\n", "a.csv");
        ASSERT_FALSE(refused) << line;
        EXPECT_TRUE(refused.error().message.starts_with("a.csv: line 2 ")) << line;
    }
}

TEST(GoalFile, ReadsTheGroundOfARecording)
{
    const std::string header = "x,y,z,map,part,model,radius_m,exaggeration,ground\n";
    const std::string touch = ",1,7,god-object,0.5,2,";
    const auto goals =
        readGoalRecording(header + "1,2,3" + touch +
                              "part/7/40/30/3396190.0/3376200.0/19.5/14.5/200.0/0.0/0.0/-200.0 "
                              "level/0/0/0/1/1/1 felt/7\n"
                              "1,2,3" +
                              touch + "\n1,2,3" + touch + "tile/0/0/0/0.25 felt/0\n",
                          "a.csv");
    ASSERT_TRUE(goals) << goals.error().message;
    ASSERT_EQ(goals->parts.size(), 1U);
    ASSERT_TRUE(goals->parts[0].ground);
    EXPECT_EQ(goals->parts[0].ground->columns, 40U);
    EXPECT_EQ(goals->parts[0].ground->ellipsoid.polar_m, 3376200.0);
    ASSERT_EQ(goals->ground.size(), 2U);
    EXPECT_EQ(goals->ground[0].goal, 0U);
    EXPECT_EQ(goals->ground[0].records.size(), 2U);
    EXPECT_EQ(goals->ground[1].goal, 2U);
    EXPECT_EQ(goals->ground[1].records[1], GroundRecord(GroundFelt{0}));

    const auto refused = readGoalRecording(header + "1,2,3" + touch + "felt/x\n", "a.csv");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "a.csv: line 2 has the invalid ground \"felt/x\"");
    // A file from an earlier version of the program.
    const auto older = readGoalRecording(
        "x,y,z,map,part,model,radius_m,exaggeration\n1,2,3,1,7,god-object,0.5,2\n", "a.csv");
    ASSERT_TRUE(older);
    EXPECT_FALSE(older->parts[0].ground);
    EXPECT_TRUE(older->ground.empty());
}

} // namespace
} // namespace marsview
