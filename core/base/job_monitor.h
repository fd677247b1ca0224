// How a long job tells its progress and learns that it is no longer wanted.
#pragma once

#include <atomic>

namespace marsview {

/// Shared between the thread that works and the threads that watch. The worker reports, watchers
/// poll at display rate; anybody, a signal handler included, may cancel. All members are lock-free.
class JobMonitor {
public:
    /// The worker: `fraction` of the present stage in [0, 1] is done.
    void report(double fraction) noexcept
    {
        fraction_.store(stage_begin_ + (stage_end_ - stage_begin_) * fraction,
                        std::memory_order_relaxed);
    }
    /// The worker, before it starts helpers: what is reported next is about this part of the whole
    /// work, 0 <= begin <= end <= 1. A job without stages is one stage.
    void beginStage(double begin, double end) noexcept
    {
        stage_begin_ = begin;
        stage_end_ = end;
    }
    /// Of the whole work.
    double fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }

    /// Asks the worker to stop soon. Cannot be undone.
    void cancel() noexcept { is_cancelled_.store(true, std::memory_order_relaxed); }
    bool isCancelled() const noexcept { return is_cancelled_.load(std::memory_order_relaxed); }

private:
    std::atomic<double> fraction_{0.0};
    std::atomic<bool> is_cancelled_{false};
    double stage_begin_ = 0.0; // the worker's and its helpers'
    double stage_end_ = 1.0;
    static_assert(std::atomic<double>::is_always_lock_free);
    static_assert(std::atomic<bool>::is_always_lock_free);
};

} // namespace marsview
