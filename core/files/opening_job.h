// The job for which a thread opens rasters.
#pragma once

#include "core/base/job_monitor.h"

namespace marsview {

/// During its lifetime, canceling the job aborts the opening of a raster on this thread with the
/// error Canceled. The innermost object counts.
class OpeningJob {
public:
    /// `job`, which may be null, outlives this object.
    explicit OpeningJob(const JobMonitor* job) noexcept
        : outer_(current_)
    {
        current_ = job;
    }
    ~OpeningJob() { current_ = outer_; }
    OpeningJob(const OpeningJob&) = delete;
    OpeningJob& operator=(const OpeningJob&) = delete;

    /// Null if there is none.
    static const JobMonitor* current() noexcept { return current_; }

private:
    static inline thread_local const JobMonitor* current_ = nullptr;
    const JobMonitor* outer_;
};

} // namespace marsview
