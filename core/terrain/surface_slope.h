// How steep the surface is at a place, and which way it faces.
#pragma once

#include "core/base/angle.h"
#include "core/geo/georeference.h"
#include "core/terrain/heightfield.h"

#include <optional>

namespace marsview {

struct SurfaceSlope {
    Angle slope;                 // in [0°, 90°), not exaggerated
    std::optional<Angle> aspect; // downhill, clockwise from north, in [0°, 360°); none where level
};

/// Of the triangle (triangulation.h) that holds `grid`: the plane through its three samples,
/// against true lengths and true north on the ellipsoid at that place, whatever the projection. On
/// an edge it is one of the two triangles. Without a CRS, lengths and north are those of the map.
/// At a pole there is no aspect.
///
/// Nothing outside the outermost samples and where one of the three is void. Of a tiled map by
/// the samples that are loaded; see Heightfield::isExact().
std::optional<SurfaceSlope>
slopeAt(const Heightfield& heightfield, const Georeference& georeference, GridPoint grid);

} // namespace marsview
