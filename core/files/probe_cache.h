// The cache of results for files that were opened in a child process.
#pragma once

#include "core/files/open_probe.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The answer to an earlier probe of these names, as long as none of its files was written to since
/// and the GDAL version is the same. A timeout counts for an hour, and only if the child had
/// `limit_s` seconds or more. Looks in this process, then in the user's cache folder
/// ($MARSVIEW_CACHE_DIR/opened, else $XDG_CACHE_HOME/marsview/opened). Any thread.
std::optional<ProbeAnswer> cachedProbe(const std::vector<std::string>& names, double limit_s);

/// Remembers that the names open, or that a driver crashes on a file or does not end. Does not
/// store results that may differ next time: lack of memory, files that no driver opens, failures
/// before a driver began, virtual rasters that do not open, names without files on a disk.
void cacheProbe(const std::vector<std::string>& names, const ProbeAnswer& answer);

} // namespace marsview
