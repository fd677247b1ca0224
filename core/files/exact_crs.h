// The exact CRS of a GeoTIFF, stored in this program's own metadata.
#pragma once

#include "core/geo/crs.h"

#include <optional>

class GDALDataset;

namespace marsview {

/// The metadata domain of everything that this program writes into a GeoTIFF.
inline constexpr const char* kOwnMetadataDomain = "MARSVIEW";

/// The CRS that keepExactCrs() wrote; empty for other files.
std::optional<Crs> exactCrsOf(GDALDataset& dataset);

/// Writes `crs` into the metadata if GeoTIFF's own keys cannot express it, for example
/// west-positive longitudes or planetocentric latitudes on an ellipsoid. The dataset has been
/// reopened since its CRS was set. False if GDAL fails.
bool keepExactCrs(GDALDataset& dataset, const std::optional<Crs>& crs);

} // namespace marsview
