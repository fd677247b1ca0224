#include "haptics/trace/goal_file.h"
#include "haptics/trace/session_recorder.h"
#include "haptics/trace/trace_file.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <sys/stat.h>
#include <thread>

namespace marsview::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusalOf(const std::string& path)
{
    const auto file = TraceFile::begin(path, "x,y,z");
    return file ? std::string() : file.error().message;
}

} // namespace

TEST(TraceFile, DoesNotWaitForAPipeWithoutAReader)
{
    const TempFolder folder;
    const std::string path = folder.file("pipe");
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    EXPECT_EQ(refusalOf(path), path +
                                   ": is a pipe without a reader; start the reader first, or "
                                   "choose another file");
}

TEST(TraceFile, ContainsTheWrittenText)
{
    const TempFolder folder;
    const std::string path = folder.write("a.csv", "something long that was there before");
    auto file = TraceFile::begin(path, "x,y,z");
    ASSERT_TRUE(file) << file.error().message;
    file->write("1,2,3\n");
    EXPECT_TRUE(file->status());
    EXPECT_TRUE(file->close());
    EXPECT_EQ(readFile(path), "x,y,z\n1,2,3\n");
    file->write("4,5,6\n");
    EXPECT_TRUE(file->close());
    EXPECT_EQ(readFile(path), "x,y,z\n1,2,3\n");
}

TEST(TraceFile, NamesTheCauseAndWhatToDo)
{
    const TempFolder folder;
    EXPECT_EQ(refusalOf("/dev/full"),
              "/dev/full: cannot be written (No space left on device); "
              "free disk space, or choose another file");
    EXPECT_EQ(refusalOf(folder.file("no/a.csv")),
              folder.file("no/a.csv") +
                  ": cannot be written (No such file or directory); choose "
                  "another file in an existing, writable folder");
    EXPECT_THAT(refusalOf(folder.path().string()), HasSubstr("(Is a directory)"));
}

TEST(TraceFile, BelongsToOneRecordingAndIsNotEmptiedByAnother)
{
    const TempFolder folder;
    const std::string path = folder.file("a.csv");
    {
        auto file = TraceFile::begin(path, "x,y,z");
        ASSERT_TRUE(file);
        file->write("1,2,3\n");
        file->flush();
        EXPECT_THAT(refusalOf(path), EndsWith(": is already being recorded to; choose another "
                                              "file"));
    }
    EXPECT_EQ(readFile(path), "x,y,z\n1,2,3\n");
    EXPECT_EQ(refusalOf(path), "");
    // A device file is never locked.
    const auto first = TraceFile::begin("/dev/null", "x,y,z");
    EXPECT_TRUE(first);
    EXPECT_TRUE(TraceFile::begin("/dev/null", "x,y,z"));
}

TEST(SaveFlight, WritesTheLastTicksWhileMoreAreAdded)
{
    const TempFolder folder;
    const std::string path = folder.file("flight.csv");
    FlightRecorder flight(500);
    const auto add = [&flight](std::uint64_t tick) {
        flight.add({.tick = tick,
                    .time_ns = static_cast<std::int64_t>(tick) * 1'000'000,
                    .goal = {static_cast<double>(tick), 2.0, 3.0},
                    .has_goal = tick != 700,
                    .tick_us = 4.5F});
    };
    for (std::uint64_t tick = 1; tick <= 1000; ++tick) {
        add(tick);
    }
    ASSERT_TRUE(saveFlight(flight.records(), path));
    const auto goals = readGoals(readFile(path), path);
    ASSERT_TRUE(goals) << goals.error().message;
    ASSERT_EQ(goals->size(), 500U);
    EXPECT_EQ(goals->front().x, 501.0);
    EXPECT_EQ(goals->back().x, 1000.0);
    EXPECT_TRUE(std::isnan((*goals)[199].x)) << "a tick without a request";
    EXPECT_THAT(readFile(path), StartsWith(std::string(kSessionColumns) + ",hand_x,hand_y,hand_z,"
                                                                          "tick_us,surface_z\n"));
    // As the window does it, with the loop running.
    std::atomic<bool> is_stopping{false};
    std::thread servo([&] {
        for (std::uint64_t tick = 1001; !is_stopping; ++tick) {
            add(tick);
        }
    });
    for (int i = 0; i < 20; ++i) {
        const Status saved = saveFlight(flight, path);
        EXPECT_TRUE(saved);
        const auto some = readGoals(readFile(path), path);
        ASSERT_TRUE(some) << some.error().message;
        for (std::size_t k = 1; k < some->size(); ++k) {
            EXPECT_FALSE((*some)[k].x < (*some)[k - 1].x);
        }
    }
    is_stopping = true;
    servo.join();
    EXPECT_TRUE(saveFlight(std::vector<TickRecord>{}, path)) << "no tick has run yet";
}

} // namespace marsview::test
