// The level file of a raster: finds it, checks that it belongs to the raster, and verifies tiles.
#pragma once

#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/raster/open_raster.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <memory>
#include <string>

namespace marsview {

/// An open level file that belongs to its raster.
struct RasterLevels {
    std::string path;
    LevelFileKey key; // of the raster
    LevelFile file;
};

/// Opens the level file at `level_path` for the raster at `raster_path`, which `info` describes
/// with overrides. NotFound if the level file does not exist; any other error says why it cannot be
/// used. The raster is read only if a level file exists; on a server this takes a dozen requests.
Result<RasterLevels> openLevels(const std::string& level_path,
                                const std::string& raster_path,
                                int band,
                                const RasterInfo& info);

/// The notice about a level file that is not used.
std::string notUsed(const std::string& level_path, const Error& why);

/// Tiles with checksums.
struct VerifiedTiles {
    std::shared_ptr<const TileSource> tiles; // null without a usable level file
    std::string notice;                      // why a level file is not used, or empty
};

/// The tiles of a raster with a level file next to it. Reading one that has changed since the level
/// file was built is an error: GDAL may decode a damaged tile to other samples without an error.
Result<VerifiedTiles> verifiedTiles(const OpenRaster& raster);

} // namespace marsview
