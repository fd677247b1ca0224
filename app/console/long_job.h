// Progress on a terminal, and Ctrl-C.
#pragma once

#include "core/base/job_monitor.h"
#include "core/files/opening_job.h"

#include <chrono>
#include <string>
#include <thread>

namespace marsview {

/// During its lifetime, shows the monitor's progress on stderr if that is a terminal, with the
/// remaining time if it is long enough to be useful, and lets Ctrl-C cancel the job, including the
/// opening of rasters on this thread, instead of killing the program; a second Ctrl-C kills it. One
/// at a time.
class LongJob {
public:
    explicit LongJob(std::string what);
    ~LongJob();
    LongJob(const LongJob&) = delete;
    LongJob& operator=(const LongJob&) = delete;

    JobMonitor& monitor() noexcept { return monitor_; }

    /// Whether one exists.
    static bool isRunning() noexcept;

    /// "about 3 min left" for a job that advanced from `begin` to `fraction` in `elapsed`; empty if
    /// it is too early for an estimate or hardly any time is left.
    static std::string
    timeLeft(double begin, double fraction, std::chrono::duration<double> elapsed);

private:
    void showProgress(const std::stop_token& stop);

    std::string what_;
    JobMonitor monitor_;
    OpeningJob opening_{&monitor_};
    std::jthread display_;
};

} // namespace marsview
