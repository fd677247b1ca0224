// Which job the rasters of a thread are opened for.
#pragma once

#include "core/base/job_monitor.h"

namespace marsview {

/// While it lives, a raster that is being opened on this thread is given up, with the error
/// Cancelled, when the job is cancelled. The innermost counts.
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

    /// Null where there is none.
    static const JobMonitor* current() noexcept { return current_; }

private:
    static inline thread_local const JobMonitor* current_ = nullptr;
    const JobMonitor* outer_;
};

} // namespace marsview
