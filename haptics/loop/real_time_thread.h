// A thread that calls a function at a fixed rate, as punctually as the system permits.
#pragma once

#include "haptics/loop/detachable_thread.h"
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
    /// If the system refuses that: asks RealtimeKit, which grants a lower priority.
    bool asks_realtime_kit = true;
    /// Initial turns that are not counted: first calls of functions cause page faults that later
    /// calls do not.
    std::uint64_t uncounted_turns = 100;
    /// Before each turn the function is also called this much earlier, to prepare the turn
    /// (LoopTick::is_preparation); 0: it is not.
    std::chrono::nanoseconds lead{0};
    std::size_t stack_bytes_touched = std::size_t{256} << 10; // before the first turn
    /// Locks all touched pages of the process while the thread runs. If the system limits how much
    /// may be locked, only the thread's stack and `memory` are locked, so that other allocations of
    /// the process do not fail.
    bool locks_memory = true;
    std::vector<MemoryRange> memory{}; // used by ticks; must outlive the thread's turns
};

/// What the system granted. An empty reason means granted.
struct RealTimeGrants {
    std::string scheduling_refusal; // why the thread runs without SCHED_FIFO
    std::string locking_refusal;    // why its memory may be paged out
    bool hasScheduling() const noexcept { return scheduling_refusal.empty(); }
    bool hasLocking() const noexcept { return locking_refusal.empty(); }
};

/// Information about one turn.
struct LoopTick {
    std::uint64_t number = 0; // from 0, without skipped turns
    LoopTime deadline;
    double dt_s = 0.0;           // measured between the beginnings of turns; 0 at the first
    bool is_preparation = false; // of turn `number`; the outcome is ignored
};

enum class LoopOutcome : std::uint8_t { Continue, Stop };

/// Turns begin at whole periods after the first, by the clock, so that lateness does not
/// accumulate. The loop around the ticks does not allocate, lock or log; the tick is responsible
/// for its own behavior.
class RealTimeThread {
public:
    /// Starts at once. `tick(const LoopTick&) noexcept` returns a LoopOutcome; it is destroyed with
    /// the thread.
    template <typename F>
    RealTimeThread(const RealTimeOptions& options, F tick)
    {
        static_assert(std::is_nothrow_invocable_r_v<LoopOutcome, F&, const LoopTick&>);
        auto kept = std::make_shared<F>(std::move(tick));
        start(options, kept, [](void* self, const LoopTick& turn) noexcept {
            return (*static_cast<F*>(self))(turn);
        });
    }
    /// Stops within a period, or when a hanging turn ends, unless the thread was detached.
    ~RealTimeThread();
    RealTimeThread(const RealTimeThread&) = delete;
    RealTimeThread& operator=(const RealTimeThread&) = delete;

    /// No turn begins after the current one.
    void stop() noexcept { shared_->is_stopping.store(true, std::memory_order_relaxed); }
    /// Waits until a turn has returned Stop, or until stop() has taken effect.
    void join() { thread_->join(); }
    /// As join(), with a time limit; false: a turn hangs.
    bool joinWithin(std::chrono::milliseconds patience) { return thread_->joinWithin(patience); }
    /// Detaches a hanging turn, with all that the tick owns; no turn begins after it. Objects that
    /// the tick only refers to must stay alive.
    void leave()
    {
        stop();
        thread_->leave();
    }

    /// Only after join().
    const RealTimeGrants& grants() const noexcept { return shared_->grants; }
    const LoopStatistics& statistics() const noexcept { return shared_->statistics; }

    /// While the thread runs: statistics that are some turns old; empty before the first. Any
    /// thread.
    std::optional<LoopStatistics> latestStatistics() const noexcept
    {
        return shared_->has_published.load(std::memory_order_acquire)
                   ? std::optional(shared_->published.read())
                   : std::nullopt;
    }
    /// As latestStatistics(), for the grants, which are available before the first turn.
    std::optional<RealTimeGrants> latestGrants() const
    {
        return shared_->has_grants.load(std::memory_order_acquire) ? std::optional(shared_->grants)
                                                                   : std::nullopt;
    }

private:
    using Tick = LoopOutcome (*)(void* self, const LoopTick& turn) noexcept;

    // On the heap and shared with the thread, which may be detached. The first write touches the
    // histograms' pages.
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
    std::optional<DetachableThread> thread_;
};

} // namespace marsview
