// Whether a level file is used for a raster, and what it vouches for.
#pragma once

#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/raster/raster_file.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <memory>
#include <string>

namespace marsview {

/// What a level file of the raster at `raster_path`, which `info` describes, has to be made from.
Result<LevelFileKey> levelFileKey(const std::string& raster_path, int band, const RasterInfo& info);

/// Whether the file is there and belongs to the raster: an error where it is not used, NotFound
/// where there is none. Only where there is one is the raster looked at, which at a server takes a
/// dozen requests.
Status checkLevels(const std::string& level_path,
                   const std::string& raster_path,
                   int band,
                   const RasterInfo& info);
bool hasLevels(const std::string& level_path,
               const std::string& raster_path,
               int band,
               const RasterInfo& info);

/// What the user is told of a level file that is not used.
std::string notUsed(const std::string& level_path, const Error& why);

/// Tiles that somebody vouches for.
struct VouchedTiles {
    std::shared_ptr<const TileSource> tiles; // null where nobody does
    std::string notice;                      // why a level file is not used; empty: there is none
};

/// The tiles of a raster that has a level file beside it: an error each that is not as it was when
/// that was made, for of a damaged tile GDAL may decode other samples without a word. `info` is the
/// file's, overrides included.
Result<VouchedTiles> vouchedTiles(const RasterFile& file, const RasterInfo& info);

} // namespace marsview
