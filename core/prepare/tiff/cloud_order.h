// The order of tiles for readers on a network: coarse overviews first.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/tiff/tiff_tiles.h"

#include <string>
#include <vector>

namespace marsview {

/// Pages from the coarsest to the raster itself; a mask follows its page.
std::vector<std::vector<std::size_t>> pagesFromCoarsest(const std::vector<TiffPage>& pages);

/// Whether the tiles of every overview come before those of the next finer one, as in a
/// cloud-optimized GeoTIFF. False for other files than those of TiffTiles.
bool isOrderedForCloud(const std::string& path);

/// Writes the file `from` to `to` with its tiles in that order, and flushes it to the disk. Reads
/// and writes every byte once. On failure `to` is removed.
Status orderForCloud(const std::string& from, const std::string& to, JobMonitor& monitor);

} // namespace marsview
