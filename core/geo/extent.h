// The extent of a raster.
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

/// A span of longitude and of planetocentric latitude. East is between west and west plus one turn;
/// either may be beyond ±180°.
struct GeographicExtent {
    Angle west;
    Angle east;
    Angle south;
    Angle north;
};

/// The nearest position between the centers of the outermost pixels.
GridPoint clampedToSamples(const Georeference& georeference, GridPoint grid);

/// Of the pixels' outer edges; a pole inside the raster is included, with all longitudes. The edges
/// are sampled in steps, so a curved edge may extend further by 1e-4 of its length. Empty if the
/// map has no longitudes, or its outer samples lie outside its projection (a whole disk, for
/// example). Calls PROJ some 260 times.
std::optional<GeographicExtent> geographicExtent(const Georeference& georeference);

} // namespace marsview
