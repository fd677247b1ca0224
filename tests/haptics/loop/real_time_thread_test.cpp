#include "haptics/loop/real_time_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace marsview {
namespace {

using namespace std::chrono_literals;

// Does not lock memory, which would affect all tests that follow.
RealTimeOptions quick()
{
    return {.period = 100us, .uncounted_turns = 0, .locks_memory = false};
}

TEST(RealTimeThread, CallsAtWholePeriodsUntilStopped)
{
    std::vector<LoopTick> turns;
    turns.reserve(200);
    RealTimeThread thread(quick(), [&turns](const LoopTick& turn) noexcept {
        turns.push_back(turn);
        return turns.size() < 200 ? LoopOutcome::Continue : LoopOutcome::Stop;
    });
    thread.join();
    ASSERT_EQ(turns.size(), 200U);
    EXPECT_EQ(turns.front().dt_s, 0.0);
    std::uint64_t periods = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        EXPECT_EQ(turns[i].number, i);
        const auto since_first = turns[i].deadline - turns.front().deadline;
        EXPECT_EQ(since_first % 100us, 0ns);
        if (i > 0) {
            EXPECT_GT(turns[i].deadline, turns[i - 1].deadline);
            EXPECT_GT(turns[i].dt_s, 0.0);
            periods = static_cast<std::uint64_t>(since_first / 100us);
        }
    }
    const LoopStatistics& statistics = thread.statistics();
    EXPECT_EQ(statistics.tick.count(), 200U);
    EXPECT_EQ(statistics.lateness.count(), 200U);
    // Periods missed during the last turn are not followed by a turn that would count them as
    // skipped.
    EXPECT_LE(periods - 199U, statistics.skipped);
    EXPECT_EQ(thread.grants().locking_refusal, "not requested");
}

TEST(RealTimeThread, PreparesTurnsAheadOfTheirDeadline)
{
    RealTimeOptions options = quick();
    options.period = 2ms;
    options.lead = 1ms;
    std::uint64_t turns = 0;
    std::uint64_t prepared = 0;
    RealTimeThread thread(options, [&](const LoopTick& turn) noexcept {
        EXPECT_EQ(turn.number, turns);
        if (turn.is_preparation) {
            EXPECT_LT(std::chrono::steady_clock::now(), turn.deadline);
            ++prepared;
            return LoopOutcome::Stop; // ignored
        }
        EXPECT_GE(std::chrono::steady_clock::now(), turn.deadline);
        return ++turns < 50 ? LoopOutcome::Continue : LoopOutcome::Stop;
    });
    thread.join();
    EXPECT_EQ(turns, 50U);
    EXPECT_GT(prepared, 0U);
    EXPECT_LE(prepared, 50U);
    EXPECT_EQ(thread.statistics().tick.count(), 50U) << "preparations are not counted";
}

TEST(RealTimeThread, CountsATickThatTakesTooLong)
{
    int turns = 0;
    RealTimeThread thread(quick(), [&turns](const LoopTick& turn) noexcept {
        if (turns == 3) {
            while (std::chrono::steady_clock::now() < turn.deadline + 5ms) {
            }
        }
        return ++turns < 6 ? LoopOutcome::Continue : LoopOutcome::Stop;
    });
    thread.join();
    EXPECT_EQ(turns, 6);
    EXPECT_GE(thread.statistics().missed_by_tick + thread.statistics().missed_by_waking, 1U);
    EXPECT_GE(thread.statistics().skipped, 48U);
}

TEST(RealTimeThread, StopsOnRequest)
{
    std::atomic<int> turns{0};
    RealTimeThread thread(quick(), [&turns](const LoopTick&) noexcept {
        turns.fetch_add(1);
        return LoopOutcome::Continue;
    });
    while (turns.load() < 3) {
        std::this_thread::yield();
    }
    thread.stop();
    thread.join();
    const int stopped_at = turns.load();
    EXPECT_GE(stopped_at, 3);
    EXPECT_EQ(thread.statistics().tick.count(), static_cast<std::uint64_t>(stopped_at));
    thread.join(); // a second call is harmless
}

TEST(RealTimeThread, LeavesOutTheFirstTurnsAndTheirPageFaults)
{
    RealTimeOptions options = quick();
    options.uncounted_turns = 50;
    constexpr std::size_t kPage = 4096;
    constexpr std::size_t kPages = 64;
    for (const std::uint64_t touched_at : {std::uint64_t{10}, std::uint64_t{70}}) {
        // Pages that have not been accessed before.
        std::unique_ptr<char[]> memory(new char[4096 * kPage]);
        RealTimeThread thread(options, [&memory, touched_at](const LoopTick& turn) noexcept {
            if (turn.number == touched_at) {
                for (std::size_t i = 0; i < kPages; ++i) {
                    static_cast<volatile char*>(memory.get())[i * 64 * kPage] = 1;
                }
            }
            return turn.number < 99 ? LoopOutcome::Continue : LoopOutcome::Stop;
        });
        thread.join();
        EXPECT_EQ(thread.statistics().tick.count(), 50U);
        const std::uint64_t faults =
            thread.statistics().minor_faults + thread.statistics().major_faults;
        if (touched_at < options.uncounted_turns) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // their own memory has faults
            EXPECT_EQ(faults, 0U);
#endif
        } else {
            // Fewer than one per page if the system uses huge pages.
            EXPECT_GE(faults, 1U);
        }
    }
}

} // namespace
} // namespace marsview
