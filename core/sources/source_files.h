// The files that make up a raster.
#pragma once

#include "core/sources/source_identity.h"

#include <string>
#include <vector>

namespace marsview {

/// Sorted: a label's data, a mosaic's parts and the file itself; statistics that other programs
/// leave next to it are excluded. Empty if GDAL does not open it. Any thread.
std::vector<std::string> sourceFilesOf(const std::string& path,
                                       OverviewFiles overviews = OverviewFiles::Ignored);

} // namespace marsview
