// How far a raster reaches.
#pragma once

#include "core/geo/georeference.h"

#include <optional>

namespace marsview {

/// A box in map coordinates.
struct MapExtent {
    MapPoint low;
    MapPoint high;
};

/// Of the pixels' outer corners, rotated rasters included.
MapExtent mapExtent(const Georeference& georeference);

/// A span of longitude and of planetocentric latitude. East is at least west and at most a turn
/// more; either may be beyond ±180°.
struct GeographicExtent {
    Angle west;
    Angle east;
    Angle south;
    Angle north;
};

/// Of the pixels' outer edges; a pole inside the raster counts, and with it every longitude. The
/// edges are walked in steps, so a curved one may reach further by 1e-4 of its length. Nothing
/// where the map has no longitudes, or its outer samples lie outside its projection (a whole disk,
/// for example). Asks PROJ some 260 times.
std::optional<GeographicExtent> geographicExtent(const Georeference& georeference);

} // namespace marsview
