// Progress and cancellation of a long job.
#pragma once

#include <atomic>

namespace marsview {

/// Shared between the thread that works and the threads that watch. The worker reports, watchers
/// poll at display rate; any thread and a signal handler may cancel. All members are lock-free.
class JobMonitor {
public:
    /// Worker: `fraction` in [0, 1] of the current stage is done.
    void report(double fraction) noexcept
    {
        fraction_.store(stage_begin_ + (stage_end_ - stage_begin_) * fraction,
                        std::memory_order_relaxed);
    }
    /// Worker, before it starts helpers: the following reports cover this part of the whole work,
    /// or of the current JobPart, 0 <= begin <= end <= 1. A job without stages is one stage.
    void beginStage(double begin, double end) noexcept
    {
        stage_begin_ = part_begin_ + (part_end_ - part_begin_) * begin;
        stage_end_ = part_begin_ + (part_end_ - part_begin_) * end;
    }
    /// Of the whole work, in [0, 1].
    double fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }

    /// Asks the worker to stop soon. Cannot be undone.
    void cancel() noexcept { is_canceled_.store(true, std::memory_order_relaxed); }
    bool isCanceled() const noexcept { return is_canceled_.load(std::memory_order_relaxed); }

private:
    friend class JobPart;

    std::atomic<double> fraction_{0.0};
    std::atomic<bool> is_canceled_{false};
    double part_begin_ = 0.0; // the worker's and its helpers', as are the following
    double part_end_ = 1.0;
    double stage_begin_ = 0.0;
    double stage_end_ = 1.0;
    static_assert(std::atomic<double>::is_always_lock_free);
    static_assert(std::atomic<bool>::is_always_lock_free);
};

/// Gives the worker a part of the job while it lives: stages begun then are stages of that part,
/// and the progress never falls below the beginning of the part. Parts nest. For the worker only,
/// like beginStage().
class JobPart {
public:
    /// 0 <= begin <= end <= 1, of the part around it.
    JobPart(JobMonitor& monitor, double begin, double end) noexcept
        : monitor_(monitor)
        , begin_(monitor.part_begin_)
        , end_(monitor.part_end_)
    {
        monitor_.beginStage(begin, end);
        monitor_.part_begin_ = monitor_.stage_begin_;
        monitor_.part_end_ = monitor_.stage_end_;
    }
    ~JobPart()
    {
        monitor_.part_begin_ = begin_;
        monitor_.part_end_ = end_;
    }
    JobPart(const JobPart&) = delete;
    JobPart& operator=(const JobPart&) = delete;

private:
    JobMonitor& monitor_;
    double begin_; // of the part around it
    double end_;
};

} // namespace marsview
