#include "haptics/loop/flight_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview::test {
namespace {

TickRecord tickAt(std::uint64_t tick, std::int64_t time_ns)
{
    return {.tick = tick, .time_ns = time_ns};
}

TEST(FlightRecorder, KeepsTheLastOfThemInOrder)
{
    FlightRecorder flight(100);
    EXPECT_TRUE(flight.isEmpty());
    EXPECT_TRUE(flight.records().empty());
    for (int i = 1; i <= 250; ++i) {
        flight.add(tickAt(static_cast<std::uint64_t>(i), i));
        const auto records = flight.records();
        ASSERT_EQ(records.size(), static_cast<std::size_t>(std::min(i, 100)));
        ASSERT_EQ(records.back().time_ns, i);
        ASSERT_EQ(records.front().time_ns, std::max(1, i - 99));
    }
    EXPECT_FALSE(flight.isEmpty());
}

TEST(FlightRecorder, ItsMemoryHoldsOneTickMoreThanItKeeps)
{
    const FlightRecorder flight(10);
    EXPECT_EQ(flight.memory().bytes, 11 * sizeof(SeqLock<TickRecord>));
}

// 2026-11-22: after another map was opened, the file still ended with the previous one.
TEST(FlightRecorder, ContinuesWhenTickNumbersRestart)
{
    FlightRecorder flight(100);
    std::int64_t time_ns = 0;
    for (const int run : {60, 30, 30}) {
        for (int i = 1; i <= run; ++i) {
            flight.add(tickAt(static_cast<std::uint64_t>(i), ++time_ns));
        }
    }
    const auto records = flight.records();
    ASSERT_EQ(records.size(), 100U);
    for (std::size_t i = 0; i < records.size(); ++i) {
        EXPECT_EQ(records[i].time_ns, static_cast<std::int64_t>(i) + 21);
    }
}

} // namespace
} // namespace marsview::test
