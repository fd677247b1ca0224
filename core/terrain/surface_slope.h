// Slope and aspect of the surface at a position.
#pragma once

#include "core/base/angle.h"
#include "core/geo/georeference.h"
#include "core/terrain/heightfield.h"

#include <optional>

namespace marsview {

struct SurfaceSlope {
    Angle slope;                 // in [0°, 90°), not exaggerated
    std::optional<Angle> aspect; // downhill, clockwise from north, in [0°, 360°); empty if level
};

/// Of the triangle (triangulation.h) that contains `grid`: the plane through its three samples,
/// with true lengths and true north on the ellipsoid at that position, in any projection. On an
/// edge it is one of the two triangles. Without a CRS, lengths and north are those of the map. At a
/// pole the aspect is empty.
///
/// Empty outside the outermost samples and if one of the three is void. On a tiled map from the
/// loaded samples; see Heightfield::isExact().
std::optional<SurfaceSlope>
slopeAt(const Heightfield& heightfield, const Georeference& georeference, GridPoint grid);

} // namespace marsview
