// A thread that calls a function at a fixed rate, as punctually as the system lets it.
#pragma once

#include "haptics/loop/loop_statistics.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

namespace marsview {

struct RealTimeOptions {
    std::chrono::nanoseconds period{1'000'000};
    int priority = 80; // of SCHED_FIFO, 1 to 99
    /// Where the system refuses that: asks RealtimeKit, which gives a lower priority.
    bool asks_realtime_kit = true;
    /// Turns before those that are counted: the first calls of functions cost page faults that no
    /// later ones do.
    std::uint64_t uncounted_turns = 100;
    std::size_t stack_bytes_touched = std::size_t{256} << 10; // before the first turn
    /// Keeps the memory of the whole process, as far as it has been touched, from being paged out.
    bool locks_memory = true;
};

/// What the system granted. An empty reason means that it did.
struct RealTimeGrants {
    std::string scheduling_refusal; // why the thread runs with the others, without SCHED_FIFO
    std::string locking_refusal;    // why its memory may be paged out
    bool hasScheduling() const noexcept { return scheduling_refusal.empty(); }
    bool hasLocking() const noexcept { return locking_refusal.empty(); }
};

/// What a turn knows of itself.
struct LoopTick {
    std::uint64_t number = 0; // from 0, those that are skipped left out
    LoopTime deadline;
    double dt_s = 0.0; // since the last turn's beginning, measured; 0 at the first
};

enum class LoopOutcome : std::uint8_t { GoOn, Stop };

/// Turns begin at whole periods after the first, by the clock, so that lateness does not add up.
/// What ticks may not do is up to them: the loop around them does not allocate, lock or log.
class RealTimeThread {
public:
    /// Starts at once. `tick(const LoopTick&) noexcept` returns a LoopOutcome; it lives as long as
    /// this object.
    template <typename F>
    RealTimeThread(const RealTimeOptions& options, F tick)
    {
        static_assert(std::is_nothrow_invocable_r_v<LoopOutcome, F&, const LoopTick&>);
        auto kept = std::make_shared<F>(std::move(tick));
        start(options, kept, [](void* self, const LoopTick& turn) noexcept {
            return (*static_cast<F*>(self))(turn);
        });
    }
    /// Stops within a period.
    ~RealTimeThread();
    RealTimeThread(const RealTimeThread&) = delete;
    RealTimeThread& operator=(const RealTimeThread&) = delete;

    /// No turn begins after the present one.
    void stop() noexcept { is_stopping_.store(true, std::memory_order_relaxed); }
    /// Until a turn has said Stop, or stop() was called and obeyed.
    void join();

    /// After join().
    const RealTimeGrants& grants() const noexcept { return grants_; }
    const LoopStatistics& statistics() const noexcept { return statistics_; }

    /// While it runs: those of some turns ago, nothing before the first. Any thread.
    std::optional<LoopStatistics> latestStatistics() const noexcept
    {
        return has_published_.load(std::memory_order_acquire) ? std::optional(published_->read())
                                                              : std::nullopt;
    }
    /// The same of what the system granted, which is known before the first turn.
    std::optional<RealTimeGrants> latestGrants() const
    {
        return has_grants_.load(std::memory_order_acquire) ? std::optional(grants_) : std::nullopt;
    }

private:
    using Tick = LoopOutcome (*)(void* self, const LoopTick& turn) noexcept;

    void start(const RealTimeOptions& options, std::shared_ptr<void> self, Tick tick);
    void run(const RealTimeOptions& options, void* self, Tick tick);

    std::shared_ptr<void> self_;
    std::atomic<bool> is_stopping_{false};
    RealTimeGrants grants_;
    LoopStatistics statistics_;
    // On the heap: it is large, and the histogram's pages are touched by the first write.
    std::unique_ptr<SeqLock<LoopStatistics>> published_;
    std::atomic<bool> has_grants_{false};
    std::atomic<bool> has_published_{false};
    std::thread thread_;
};

} // namespace marsview
