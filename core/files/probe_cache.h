// The cache of results for files that were opened in a child process.
#pragma once

#include "core/files/open_probe.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The answer to an earlier probe of these names, as long as none of its files was written to since
/// and the GDAL version is the same. Looks in this process, then in the user's cache folder
/// ($MARSVIEW_CACHE_DIR/opened, else $XDG_CACHE_HOME/marsview/opened). Any thread.
std::optional<ProbeAnswer> cachedProbe(const std::vector<std::string>& names);

/// Remembers that the names open, or that a driver crashes on a file. Does not store results that
/// may differ next time: timeouts, lack of memory, files that no driver opens, virtual rasters that
/// crash, names without files on a disk.
void cacheProbe(const std::vector<std::string>& names, const ProbeAnswer& answer);

} // namespace marsview
