// A tiled GeoTIFF complete except for its tiles.
#pragma once

#include "core/base/result.h"
#include "core/raster/raster_info.h"

#include <string>

namespace marsview {

/// The source of the samples of a prepared file.
struct GeoTiffOrigin {
    std::string key;    // compared as a whole
    std::string source; // the path, for display
};

/// Creates a deflated BigTIFF in tiles of kTileSide for one band as described by `info`: type,
/// placement, CRS, nodata, scale, offset, unit, vertical datum, a mask if the raster has one, and
/// all overviews. It has no tiles yet. Replaces any file at `path`.
Status
writeGeoTiffSkeleton(const std::string& path, const RasterInfo& info, const GeoTiffOrigin& origin);

/// Empty for files not created from a skeleton, and if the file does not exist.
GeoTiffOrigin readGeoTiffOrigin(const std::string& path);

} // namespace marsview
