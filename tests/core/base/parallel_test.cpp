#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace marsview {
namespace {

TEST(ParallelRanges, CoversEachIndexOnceInPartsOfAtMostTheGrain)
{
    for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 64U, 1000U, 4097U}) {
        for (const std::size_t grain : {1U, 2U, 3U, 7U, 64U, 1000U, 4096U, 100000U}) {
            std::vector<std::atomic<int>> visits(count);
            std::atomic<int> bad_parts{0};
            std::atomic<std::size_t> part_count{0};
            parallelRanges(count, grain, [&](std::size_t begin, std::size_t end) {
                bad_parts += begin < end && end <= count && end - begin <= grain ? 0 : 1;
                ++part_count;
                for (std::size_t i = begin; i < std::min(end, count); ++i) {
                    ++visits[i];
                }
            });
            EXPECT_EQ(bad_parts, 0) << count << " by " << grain;
            EXPECT_EQ(part_count, (count + grain - 1) / grain);
            EXPECT_TRUE(std::all_of(visits.begin(), visits.end(),
                                    [](const std::atomic<int>& n) { return n == 1; }))
                << count << " by " << grain;
        }
    }
}

TEST(ParallelRanges, ReturnsAfterAllWorkIsDone)
{
    constexpr std::size_t kCount = 5000;
    std::vector<std::size_t> results(kCount);
    for (std::size_t round = 1; round <= 50; ++round) {
        parallelRanges(kCount, 3, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                results[i] = i * round;
            }
        });
        for (std::size_t i = 0; i < kCount; ++i) {
            ASSERT_EQ(results[i], i * round);
        }
    }
}

} // namespace
} // namespace marsview
