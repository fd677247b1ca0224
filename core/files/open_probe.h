// Opens a raster in a child process, to find out whether GDAL survives it.
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
        NotOpened, // no driver opens any name; `message` is from the one that recognized it, or
                   // empty
        Crashed,   // `driver` crashed on `name`; the following likewise
        TimedOut,
        OutOfMemory,
    };
    Kind kind = Kind::NotOpened;
    std::size_t name = 0; // index into the requested names
    std::string driver;
    std::vector<std::string> files; // if Opened: all files of the raster, as GDAL lists them
    std::string message;
    bool prints = false;  // a library prints lines to stderr
    double limit_s = 0.0; // if TimedOut: how long the child had
};

/// Lets a child open the first of the names that GDAL opens and read samples for a moment. Limits:
/// probeMemoryBytes(), and probeSeconds() for files of `bytes` in total. Canceled if the job,
/// which may be null, is canceled; Unreadable if the child cannot be started, or is ended from
/// outside.
Result<ProbeAnswer>
probeNames(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job);

/// A raster among several names, as a child sees it.
struct ProbedRaster {
    std::size_t name = 0; // index into the requested names
    std::string driver;
    std::size_t columns = 0;
    std::size_t rows = 0;
    bool has_bytes = false;  // samples of 8 bits
    bool has_colors = false; // a palette, or bands of colors
    std::vector<std::string> files;
};

/// Lets a child open all of the names, and another one those after a name that ends it. No samples
/// are read. Rasters without a band, and names after a time limit as of probeNames(), are left out.
/// Errors as of probeNames().
Result<std::vector<ProbedRaster>>
probeEach(const std::vector<std::string>& names, std::size_t bytes, const JobMonitor* job);

/// The memory limit of a child: 1 GiB, or MARSVIEW_OPEN_MB in the environment.
std::size_t probeMemoryBytes();
/// The time limit: 10 s plus 1 s for every 10 MB, or MARSVIEW_OPEN_SECONDS in the environment.
double probeSeconds(std::size_t bytes);

/// The child's own part: takes limits of memory in bytes and of processor time in seconds as
/// arguments, and "each" for probeEach(). Reads zero-terminated names from stdin and answers on
/// stdout. Returns its exit status.
int probeMain(const std::vector<std::string>& arguments);

/// Makes all children start without loading the program again (core/base/fork_server.h), and keeps
/// PROJ from printing to stderr unless the user sets PROJ_DEBUG. Call it once, at the start of
/// main().
void prestartProbes();

} // namespace marsview
