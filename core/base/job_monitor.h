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
    /// work, or of the JobPart that it is in, 0 <= begin <= end <= 1. A job without stages is one
    /// stage.
    void beginStage(double begin, double end) noexcept
    {
        stage_begin_ = part_begin_ + (part_end_ - part_begin_) * begin;
        stage_end_ = part_begin_ + (part_end_ - part_begin_) * end;
    }
    /// Of the whole work.
    double fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }

    /// Asks the worker to stop soon. Cannot be undone.
    void cancel() noexcept { is_cancelled_.store(true, std::memory_order_relaxed); }
    bool isCancelled() const noexcept { return is_cancelled_.load(std::memory_order_relaxed); }

private:
    friend class JobPart;

    std::atomic<double> fraction_{0.0};
    std::atomic<bool> is_cancelled_{false};
    double part_begin_ = 0.0; // the worker's and its helpers', as are the following
    double part_end_ = 1.0;
    double stage_begin_ = 0.0;
    double stage_end_ = 1.0;
    static_assert(std::atomic<double>::is_always_lock_free);
    static_assert(std::atomic<bool>::is_always_lock_free);
};

/// While it lives, what the worker calls has a part of the work for itself: its stages are stages
/// of that part, and the progress never goes back to where the part began. Parts nest; the
/// worker's alone, as beginStage() is.
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
