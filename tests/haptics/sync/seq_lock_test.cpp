#include "haptics/sync/seq_lock.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace marsview {
namespace {

struct Odd {
    double a = 1.0;
    char b = 'x';
};

TEST(SeqLock, GivesBackWhatWasWritten)
{
    SeqLock<Odd> lock;
    EXPECT_EQ(lock.read().a, 1.0);
    EXPECT_EQ(lock.read().b, 'x');
    lock.write({2.5, 'y'});
    const auto read = lock.tryRead();
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->a, 2.5);
    EXPECT_EQ(read->b, 'y');
}

TEST(SeqLock, ReadersNeverSeeATornOrOlderValue)
{
    using Value = std::array<std::uint64_t, 12>;
    constexpr std::uint64_t kLast = 200'000;
    SeqLock<Value> lock;
    std::atomic<int> readers{0};
    struct Seen {
        std::uint64_t torn = 0;
        std::uint64_t older = 0;
    };
    std::vector<Seen> seen(2);
    std::vector<std::thread> threads;
    for (Seen& mine : seen) {
        threads.emplace_back([&] {
            ++readers;
            for (std::uint64_t last = 0; last < kLast;) {
                const Value value = lock.read();
                for (const std::uint64_t word : value) {
                    mine.torn += word != value[0] ? 1U : 0U;
                }
                mine.older += value[0] < last ? 1U : 0U;
                last = value[0];
            }
        });
    }
    while (readers < 2) {
        std::this_thread::yield();
    }
    for (std::uint64_t i = 1; i <= kLast; ++i) {
        Value value;
        value.fill(i);
        lock.write(value);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const Seen& mine : seen) {
        EXPECT_EQ(mine.torn, 0U);
        EXPECT_EQ(mine.older, 0U);
    }
}

} // namespace
} // namespace marsview
