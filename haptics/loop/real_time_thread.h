// A thread that calls a function at a fixed rate, as punctually as the system lets it.
#pragma once

#include "haptics/loop/leavable_thread.h"
#include "haptics/loop/loop_statistics.h"
#include "haptics/sync/page_lock.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

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
    /// Keeps the memory of the whole process, as far as it has been touched, from being paged out
    /// while the thread runs. Where the system bounds how much may be locked, only the thread's
    /// stack and `memory` are: whatever else the process asks for later must not fail because of
    /// that.
    bool locks_memory = true;
    std::vector<MemoryRange> memory{}; // what ticks use; it outlives the thread's turns
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
    /// Stops within a period, or whenever the turn that hangs is over, unless it was left alone.
    ~RealTimeThread();
    RealTimeThread(const RealTimeThread&) = delete;
    RealTimeThread& operator=(const RealTimeThread&) = delete;

    /// No turn begins after the present one.
    void stop() noexcept { shared_->is_stopping.store(true, std::memory_order_relaxed); }
    /// Until a turn has said Stop, or stop() was called and obeyed.
    void join() { thread_->join(); }
    /// The same for no longer than `patience`; false: a turn hangs.
    bool joinWithin(std::chrono::milliseconds patience) { return thread_->joinWithin(patience); }
    /// Leaves a turn that hangs alone, with all that the tick owns; none begins after it. What the
    /// tick only refers to has to stay.
    void leave()
    {
        stop();
        thread_->leave();
    }

    /// After join().
    const RealTimeGrants& grants() const noexcept { return shared_->grants; }
    const LoopStatistics& statistics() const noexcept { return shared_->statistics; }

    /// While it runs: those of some turns ago, nothing before the first. Any thread.
    std::optional<LoopStatistics> latestStatistics() const noexcept
    {
        return shared_->has_published.load(std::memory_order_acquire)
                   ? std::optional(shared_->published.read())
                   : std::nullopt;
    }
    /// The same of what the system granted, which is known before the first turn.
    std::optional<RealTimeGrants> latestGrants() const
    {
        return shared_->has_grants.load(std::memory_order_acquire) ? std::optional(shared_->grants)
                                                                   : std::nullopt;
    }

private:
    using Tick = LoopOutcome (*)(void* self, const LoopTick& turn) noexcept;

    // On the heap, and the thread's as well: it may be left alone. The histograms' pages are
    // touched by the first write.
    struct Shared {
        std::atomic<bool> is_stopping{false};
        RealTimeGrants grants;
        LoopStatistics statistics;
        SeqLock<LoopStatistics> published;
        std::atomic<bool> has_grants{false};
        std::atomic<bool> has_published{false};
    };

    void start(const RealTimeOptions& options, const std::shared_ptr<void>& self, Tick tick);
    static void run(const RealTimeOptions& options, void* self, Tick tick, Shared& shared);

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::optional<LeavableThread> thread_;
};

} // namespace marsview
