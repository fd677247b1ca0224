// The one door through which GDAL is let at files.
//
// A plain file (plainDrivers(), on a disk, naming no other files) is opened in this process, after
// checks of our own. Anything else is opened by a child process first (open_probe.h), unless that
// was done before (open_memory.h); then here, by the same driver alone.
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
    std::size_t name = 0;       // of those that were asked for
    std::string opening_driver; // which may differ from the dataset's
    bool prints = false;        // a library prints lines: read within a QuietOutput
};

/// Opens the first of the names, at least one, that GDAL opens. The error is a sentence without the
/// path, empty where no driver recognises any name; Unreadable where the file cannot hold what it
/// promises or a driver does not survive it, TooLarge where that takes too much memory, Cancelled
/// where the thread's OpeningJob is cancelled. Any thread.
Result<GuardedDataset> openFirst(const std::vector<std::string>& names);

/// The same raster once more, by the driver that opened it.
GDALDatasetUniquePtr reopen(const std::string& name, const GuardedDataset& opened);

/// While one lives, what is printed to stdout and stderr in this process is lost.
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
