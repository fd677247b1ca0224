#include "haptics/sync/spsc_queue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace marsview::test {
namespace {

TEST(SpscQueue, KeepsTheOrderAndRefusesValuesThatDoNotFit)
{
    SpscQueue<int, 4> queue;
    int value = 0;
    EXPECT_FALSE(queue.take(value));
    for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(queue.room(), static_cast<std::size_t>(4 - i));
            EXPECT_TRUE(queue.put(10 * round + i));
        }
        EXPECT_EQ(queue.room(), 0U);
        EXPECT_FALSE(queue.put(99));
        for (int i = 0; i < 4; ++i) {
            ASSERT_TRUE(queue.take(value));
            EXPECT_EQ(value, 10 * round + i);
        }
        EXPECT_FALSE(queue.take(value));
    }
}

struct Pair {
    std::uint64_t number = 0;
    std::uint64_t twice = 0;
};

TEST(SpscQueue, LosesAndTearsNothingBetweenTwoThreads)
{
    constexpr std::uint64_t kCount = 200'000;
    SpscQueue<Pair, 64> queue;
    std::thread writer([&queue] {
        for (std::uint64_t i = 0; i < kCount;) {
            i += queue.put({i, 2 * i}) ? 1U : 0U;
        }
    });
    Pair pair;
    for (std::uint64_t i = 0; i < kCount;) {
        if (queue.take(pair)) {
            ASSERT_EQ(pair.number, i);
            ASSERT_EQ(pair.twice, 2 * i);
            ++i;
        }
    }
    writer.join();
    EXPECT_FALSE(queue.take(pair));
}

} // namespace
} // namespace marsview::test
