#include "app/cli/long_job.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <unistd.h>

namespace marsview {
namespace {

std::atomic<JobMonitor*> running_job{nullptr};
static_assert(std::atomic<JobMonitor*>::is_always_lock_free);

void cancelRunningJob(int)
{
    if (JobMonitor* job = running_job.load()) {
        job->cancel();
    }
}

} // namespace

LongJob::LongJob(std::string what)
    : what_(std::move(what))
{
    running_job.store(&monitor_);
    std::signal(SIGINT, cancelRunningJob);
    if (isatty(STDERR_FILENO) != 0) {
        display_ = std::jthread([this](const std::stop_token& stop) { showProgress(stop); });
    }
}

LongJob::~LongJob()
{
    if (display_.joinable()) {
        display_.request_stop();
        display_.join();
    }
    std::signal(SIGINT, SIG_DFL);
    running_job.store(nullptr);
}

void LongJob::showProgress(const std::stop_token& stop)
{
    constexpr std::chrono::milliseconds kInterval{200};
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    bool has_shown = false;
    while (!wake.wait_for(lock, stop, kInterval, [&stop] { return stop.stop_requested(); })) {
        std::fprintf(stderr, "\r%s %3.0f %%", what_.c_str(), 100.0 * monitor_.fraction());
        has_shown = true;
    }
    if (has_shown) {
        std::fprintf(stderr, "\r\033[K");
    }
}

} // namespace marsview
