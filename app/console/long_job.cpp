#include "app/console/long_job.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <unistd.h>

namespace marsview {
namespace {

std::atomic<JobMonitor*> running_job{nullptr};
static_assert(std::atomic<JobMonitor*>::is_always_lock_free);

void cancelRunningJob(int)
{
    JobMonitor* const job = running_job.load();
    if (job != nullptr && !job->isCanceled()) {
        job->cancel();
        return;
    }
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
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

bool LongJob::isRunning() noexcept
{
    return running_job.load() != nullptr;
}

std::string LongJob::timeLeft(double begin, double fraction, std::chrono::duration<double> elapsed)
{
    constexpr double kElapsedMinS = 2.0;
    constexpr double kLeftMinS = 2.0;
    if (elapsed.count() < kElapsedMinS || fraction <= begin) {
        return {};
    }
    const double left_s = elapsed.count() / (fraction - begin) * (1.0 - fraction);
    if (left_s < kLeftMinS) {
        return {};
    }
    if (left_s < 90.0) {
        return fmt::format("about {:.0f} s left", left_s);
    }
    if (left_s < 90.0 * 60.0) {
        return fmt::format("about {:.0f} min left", left_s / 60.0);
    }
    return fmt::format("about {:.1f} h left", left_s / 3600.0);
}

void LongJob::showProgress(const std::stop_token& stop)
{
    constexpr std::chrono::milliseconds kInterval{200};
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    bool has_shown = false;
    // A job may resume earlier work: only the progress made from now on gives the rate.
    std::optional<double> begin;
    std::chrono::steady_clock::time_point begin_time;
    while (!wake.wait_for(lock, stop, kInterval, [&stop] { return stop.stop_requested(); })) {
        const double fraction = monitor_.fraction();
        const auto now = std::chrono::steady_clock::now();
        if (!begin && fraction > 0.0) {
            begin = fraction;
            begin_time = now;
        }
        const std::string left =
            begin ? timeLeft(*begin, fraction, now - begin_time) : std::string();
        std::fprintf(stderr, "\r%s %3.0f %%%s%s\033[K", what_.c_str(), 100.0 * fraction,
                     left.empty() ? "" : ", ", left.c_str());
        has_shown = true;
    }
    if (has_shown) {
        std::fprintf(stderr, "\r\033[K");
    }
}

} // namespace marsview
