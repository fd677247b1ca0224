#include "core/prepare/checkpoints.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace marsview {
namespace {

namespace fs = std::filesystem;

class CheckpointsTest : public testing::Test {
protected:
    Checkpoints of(const std::string& subject,
                   std::chrono::milliseconds interval = std::chrono::milliseconds(0)) const
    {
        return {path_, subject, interval};
    }

    static void save(Checkpoints& checkpoints, std::uint64_t rows, bool is_complete = true)
    {
        checkpoints.save([rows] { return JobPlace{.rows = rows, .row_count = 9}; },
                         [rows, is_complete](CheckpointWriter& to) {
                             to.put(rows * 100);
                             return is_complete;
                         });
    }

    test::TempFolder folder_;
    std::string path_ = folder_.file("job.checkpoint");
};

TEST_F(CheckpointsTest, ReturnPlaceAndStateToTheSameJobOnly)
{
    Checkpoints job = of("copy of a");
    EXPECT_FALSE(job.find());
    EXPECT_FALSE(job.hasCheckpoint());
    save(job, 3);
    EXPECT_TRUE(job.hasCheckpoint());

    std::optional<Checkpoints::Found> found = of("copy of a").find();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->place, (JobPlace{.rows = 3, .row_count = 9}));
    std::uint64_t state = 0;
    EXPECT_TRUE(found->state.get(state));
    EXPECT_EQ(state, 300U);
    EXPECT_FALSE(of("copy of b").find());
    EXPECT_EQ(placeInCheckpoint(path_), found->place) << "of any job";
}

TEST_F(CheckpointsTest, KeepThePreviousOneIfTheNextFails)
{
    Checkpoints job = of("copy");
    save(job, 1);
    save(job, 2, false);
    job.save([]() -> std::optional<JobPlace> { return std::nullopt; },
             [](CheckpointWriter&) { return true; });
    EXPECT_TRUE(job.hasCheckpoint());
    EXPECT_EQ(placeInCheckpoint(path_)->rows, 1U);
}

TEST_F(CheckpointsTest, AreDueAtOnceOrAfterTheirInterval)
{
    EXPECT_TRUE(of("copy").isDue());
    Checkpoints rare = of("copy", std::chrono::hours(1));
    EXPECT_FALSE(rare.isDue());
    save(rare, 1);
    EXPECT_FALSE(rare.isDue());
}

TEST_F(CheckpointsTest, LeaveNothingWhenRemoved)
{
    Checkpoints job = of("copy");
    save(job, 1);
    folder_.write("job.checkpoint.new", "of a kill while it was written");
    job.remove();
    EXPECT_FALSE(job.hasCheckpoint());
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

} // namespace
} // namespace marsview
