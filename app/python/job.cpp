#include "app/python/job.h"

#include "core/files/opening_job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace marsview::python {
namespace {

// Of the worker.
struct Progress {
    std::mutex mutex;
    std::condition_variable has_ended;
    bool is_done = false;
    std::exception_ptr thrown;
};

bool endsWithin(Progress& progress, std::chrono::milliseconds time)
{
    const py::gil_scoped_release released;
    std::unique_lock lock(progress.mutex);
    return progress.has_ended.wait_for(lock, time, [&] { return progress.is_done; });
}

// Empty if the work may continue; otherwise the exception to raise, or a null one for Canceled.
std::optional<std::exception_ptr> reasonToStop(const py::object& callback, double fraction)
{
    try {
        if (PyErr_CheckSignals() != 0) {
            throw py::error_already_set();
        }
        if (!callback.is_none()) {
            const py::object answer = callback(fraction);
            if (answer.is(py::bool_(false))) {
                return std::exception_ptr();
            }
        }
    } catch (...) {
        return std::current_exception();
    }
    return std::nullopt;
}

} // namespace

void runJob(const py::object& progress, const std::function<void(JobMonitor&)>& work)
{
    constexpr std::chrono::milliseconds kInterval{100};
    JobMonitor monitor;
    Progress worker;
    std::optional<std::exception_ptr> stopped;
    {
        std::jthread thread([&] {
            const OpeningJob opening(&monitor);
            std::exception_ptr thrown;
            try {
                work(monitor);
            } catch (...) {
                thrown = std::current_exception();
            }
            const std::lock_guard lock(worker.mutex);
            worker.thrown = thrown;
            worker.is_done = true;
            worker.has_ended.notify_one();
        });
        while (!endsWithin(worker, kInterval)) {
            if (!stopped) {
                stopped = reasonToStop(progress, monitor.fraction());
                if (stopped) {
                    monitor.cancel();
                }
            }
        }
    }
    if (stopped && *stopped) {
        std::rethrow_exception(*stopped);
    }
    if (worker.thrown) {
        std::rethrow_exception(worker.thrown);
    }
    if (!stopped && !progress.is_none()) {
        progress(1.0);
    }
}

} // namespace marsview::python
