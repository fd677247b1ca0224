// Opening a raster in a child process, to find out whether GDAL survives it.
//
// Drivers of GDAL hand files to libraries that abort, overflow the stack, never end or take all
// memory on some of them. Such an end is the child's alone. Used inside core/files and by
// app/probe.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace marsview {

struct ProbeAnswer {
    enum class Kind {
        Opened,    // `driver` opens `name`, and its first samples can be read
        NotOpened, // no driver opens any name; `message` of the one that recognised it, or empty
        Crashed,   // of `driver`, on `name`, as are the following
        TimedOut,
        OutOfMemory,
    };
    Kind kind = Kind::NotOpened;
    std::size_t name = 0; // of those that were asked for
    std::string driver;
    std::vector<std::string> files; // where Opened: all that it is made of, as GDAL lists them
    std::string message;
    bool prints = false; // a library prints lines to stderr
};

/// Has a child open the first of the names that GDAL opens, and read samples for a moment. Bounds:
/// probeMemoryBytes(), and probeSeconds() for files of `bytes` together. Cancelled where the job,
/// which may be null, is cancelled; Unreadable where the child cannot be started.
Result<ProbeAnswer>
probeNames(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job);

/// What a child may take at most: 1 GiB, or MARSVIEW_OPEN_MB in the environment.
std::size_t probeMemoryBytes();
/// 10 s and one more for every 10 MB, or MARSVIEW_OPEN_SECONDS in the environment.
double probeSeconds(std::size_t bytes);

/// The child's own part: reads names from stdin, ended by zero bytes each, answers on stdout.
/// Returns its exit status.
int runProbe();

} // namespace marsview
