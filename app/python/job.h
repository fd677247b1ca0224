// Long work on another thread, while Python stays responsive.
#pragma once

#include "app/python/conversion.h"
#include "core/base/job_monitor.h"

#include <functional>
#include <optional>
#include <utility>

namespace marsview::python {

/// Runs `work` on another thread without the GIL, and waits. Every tenth of a second calls
/// `progress`, if it is not None, with the fraction that is done. Ctrl-C, an exception of
/// `progress`, or a return value of False cancel the work; the exception is then raised.
void runJob(const py::object& progress, const std::function<void(JobMonitor&)>& work);

/// The same for work with a result; errors are raised.
template <typename T>
T resultOf(const py::object& progress, const std::function<Result<T>(JobMonitor&)>& work)
{
    std::optional<Result<T>> result;
    runJob(progress, [&](JobMonitor& monitor) { result.emplace(work(monitor)); });
    return valueOf(std::move(*result));
}

} // namespace marsview::python
