// What is remembered of files that were opened in a child process.
#pragma once

#include "core/files/open_probe.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The answer to an earlier probe of these names, as long as no file of it was written to since and
/// GDAL is the same version. Looked for in this process, then in the user's cache folder
/// ($MARSVIEW_CACHE_DIR/opened, else $XDG_CACHE_HOME/marsview/opened). Any thread.
std::optional<ProbeAnswer> recallProbe(const std::vector<std::string>& names);

/// Remembers that the names open, or that a driver crashes on a file. Not what may be otherwise
/// next time: ends for lack of time or memory, files that no driver opens, virtual rasters that
/// crash, names without files on a disk.
void rememberProbe(const std::vector<std::string>& names, const ProbeAnswer& answer);

} // namespace marsview
