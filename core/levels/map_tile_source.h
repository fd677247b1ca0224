// The tiles of a large map: from the raster, and the missing levels from its level file.
#pragma once

#include "core/levels/level_file.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <memory>
#include <optional>
#include <string>

namespace marsview {

/// The sources of the finer and coarser levels of a map.
struct MapTiles {
    /// Samples at the finest levels, and Means.
    std::shared_ptr<const TileSource> raster;
    /// The path of the level file with Samples from LevelFile::kFirstLevel on, and the key that it
    /// was opened with. Without one the raster has Samples at all levels.
    std::optional<std::string> level_path;
    LevelFileKey level_key;
    std::shared_ptr<const SurfaceAnalysis> analysis; // to fill voids at coarser levels
    ElevationScale scale;
    TileLayout layout; // from the level file
};

/// One source of all tiles, void samples filled.
std::shared_ptr<const TileSource> mapTileSource(MapTiles tiles);

} // namespace marsview
