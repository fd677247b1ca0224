// Which files a raster is made of.
#pragma once

#include "core/raster/source_identity.h"

#include <string>
#include <vector>

namespace marsview {

/// Sorted: a label's data, a mosaic's parts and the file itself; statistics that other programs
/// leave beside it do not count. Empty where GDAL does not open it. Any thread.
std::vector<std::string> sourceFilesOf(const std::string& path,
                                       OverviewFiles overviews = OverviewFiles::Ignored);

} // namespace marsview
