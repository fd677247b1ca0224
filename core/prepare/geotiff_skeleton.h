// A tiled GeoTIFF with everything but its tiles.
#pragma once

#include "core/base/result.h"
#include "core/raster/raster_info.h"

#include <string>

namespace marsview {

/// What the samples of a prepared file are made from.
struct GeoTiffOrigin {
    std::string key;    // compared as a whole
    std::string source; // the path, for people
};

/// Lays out a deflated BigTIFF in tiles of kTileSide for one band as `info` describes it: type,
/// placement, CRS, nodata, scale, offset, unit, vertical datum, a mask where the raster has one,
/// and all overviews. No tile is there yet. Replaces what was at `path`.
Status
writeGeoTiffSkeleton(const std::string& path, const RasterInfo& info, const GeoTiffOrigin& origin);

/// Empty for files that did not begin as a skeleton, and where there is none.
GeoTiffOrigin readGeoTiffOrigin(const std::string& path);

} // namespace marsview
