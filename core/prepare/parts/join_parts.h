// Joins the parts of a map into the same files that one preparation makes.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/level_builder.h"
#include "core/prepare/row_memory.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/raster/open_raster.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace marsview {

struct JoinJob {
    std::string path;   // of the tiled GeoTIFF; on a server, it is written in one stream
    std::string folder; // of the parts, on a disk
    std::size_t parts = 1;
    TiledGeoTiffJob::Order order = TiledGeoTiffJob::Order::AsMade;
    std::size_t mean_blocks_max = LevelBuild{}.mean_blocks_max; // the parts'
    RowMemory memory{};                                         // as in PartJob
};

struct JoinReport {
    std::string level_path;
    std::uint64_t samples = 0;
    std::uint64_t bytes = 0;       // of the tiled GeoTIFF
    std::uint64_t level_bytes = 0; // of the level file
    std::size_t measured = 0;      // parts whose second pass this call made
    double copy_seconds = 0.0;
    double level_seconds = 0.0;
};

/// Writes both files, byte for byte those of prepareMapFiles() except the time of the first in the
/// second, and removes the parts. Makes the second pass of those parts that lack it. NotFound, with
/// their numbers, if parts are missing. On failure the parts stay, and the next call starts over.
/// On all cores; not for the GUI thread. Raises the soft limit of open files if there are many
/// parts.
Result<JoinReport> joinParts(const OpenRaster& raster, const JoinJob& job, JobMonitor& monitor);

} // namespace marsview
