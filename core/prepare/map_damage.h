// Whether a prepared map still is what it was when it was prepared: all of it is read.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/tiles/geotiff_tile_source.h"

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

struct PreparedFiles {
    const GeotiffTileSource* raster = nullptr;
    std::string level_path;
    LevelFileKey level_key;
    std::string remedy; // ends the sentence about a damaged raster
};

struct MapDamage {
    enum class Of : std::uint8_t { Levels, Raster };
    Of of = Of::Levels;
    Error error;
};

/// The first damage found, or nothing. Decodes every tile once, on all cores: a fifth of the time
/// that preparing took. Errors are those that tell nothing: Cancelled, no memory, a level file that
/// is of another raster.
Result<std::optional<MapDamage>> findDamage(const PreparedFiles& files, JobMonitor& monitor);

} // namespace marsview
