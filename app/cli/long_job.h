// Progress on a terminal, and Ctrl-C.
#pragma once

#include "core/base/job_monitor.h"

#include <string>
#include <thread>

namespace marsview {

/// While it lives, shows the monitor's progress on stderr if that is a terminal, and lets Ctrl-C
/// cancel the job instead of killing the program. One at a time.
class LongJob {
public:
    explicit LongJob(std::string what);
    ~LongJob();
    LongJob(const LongJob&) = delete;
    LongJob& operator=(const LongJob&) = delete;

    JobMonitor& monitor() noexcept { return monitor_; }

private:
    void showProgress(const std::stop_token& stop);

    std::string what_;
    JobMonitor monitor_;
    std::jthread display_;
};

} // namespace marsview
