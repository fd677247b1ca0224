#include "haptics/loop/loop_statistics.h"

#include <gtest/gtest.h>

namespace marsview {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds kPeriod = 1ms;
constexpr LoopTime kStart{100s};

TEST(LoopStatistics, TurnsInTimeFollowEachOtherAfterAPeriod)
{
    LoopStatistics statistics;
    LoopTime deadline = kStart;
    for (int i = 0; i < 10; ++i) {
        deadline = statistics.add({deadline, deadline + 50us, deadline + 1ms}, kPeriod);
    }
    EXPECT_EQ(deadline, kStart + 10ms);
    EXPECT_EQ(statistics.tick.count(), 10U);
    EXPECT_EQ(statistics.tick.maximum(), 950us);
    EXPECT_EQ(statistics.lateness.maximum(), 50us);
    EXPECT_EQ(statistics.missed_by_tick, 0U);
    EXPECT_EQ(statistics.missed_by_waking, 0U);
    EXPECT_EQ(statistics.skipped, 0U);
}

TEST(LoopStatistics, ATickLongerThanAPeriodMissesByItself)
{
    LoopStatistics statistics;
    EXPECT_EQ(statistics.add({kStart, kStart, kStart + 3500us}, kPeriod), kStart + 3ms);
    EXPECT_EQ(statistics.missed_by_tick, 1U);
    EXPECT_EQ(statistics.missed_by_waking, 0U);
    EXPECT_EQ(statistics.skipped, 2U); // those at 1 and 2 ms
}

TEST(LoopStatistics, AThreadWokenTooLateMissesByThat)
{
    LoopStatistics statistics;
    EXPECT_EQ(statistics.add({kStart, kStart + 900us, kStart + 1200us}, kPeriod), kStart + 1ms);
    EXPECT_EQ(statistics.missed_by_waking, 1U);
    EXPECT_EQ(statistics.skipped, 0U);
    EXPECT_EQ(statistics.add({kStart, kStart + 7ms, kStart + 7010us}, kPeriod), kStart + 7ms);
    EXPECT_EQ(statistics.missed_by_waking, 2U);
    EXPECT_EQ(statistics.missed_by_tick, 0U);
    EXPECT_EQ(statistics.skipped, 6U);
}

} // namespace
} // namespace marsview
