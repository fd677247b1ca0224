// Opens files with GDAL. Every file that GDAL reads is opened here.
//
// A plain file (plainDrivers(), on a disk, naming no other files) is opened in this process, after
// our own checks. Anything else is opened by a child process first (open_probe.h), unless that was
// done before (probe_cache.h); then in this process, by the same driver only.
#pragma once

#include "core/base/result.h"

#include <gdal_priv.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

struct GuardedDataset {
    GDALDatasetUniquePtr dataset;
    std::size_t name = 0;       // index into the requested names
    std::string opening_driver; // which may differ from the dataset's
    bool prints = false;        // a library prints lines: read within a QuietOutput
};

/// Opens the first of the names, at least one, that GDAL opens. The error is a sentence without the
/// path, empty if no driver recognizes any name. Unreadable if the file is shorter than its header
/// requires or a driver crashes on it, TooLarge if opening takes too much memory, Canceled if the
/// thread's OpeningJob is canceled. Any thread.
Result<GuardedDataset> openFirst(const std::vector<std::string>& names);

/// Opens the same raster again, with the driver that opened it.
GDALDatasetUniquePtr reopen(const std::string& name, const GuardedDataset& opened);

/// Discards all output to stdout and stderr of this process during its lifetime.
class QuietOutput {
public:
    explicit QuietOutput(bool is_needed);
    ~QuietOutput();
    QuietOutput(const QuietOutput&) = delete;
    QuietOutput& operator=(const QuietOutput&) = delete;

private:
    bool is_needed_;
};

} // namespace marsview
