// Maps as measuring reads them, angles and polygons.
#pragma once

#include "core/measure/measured_terrain.h"
#include "core/session/map.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace marsview::test {

inline MeasuredTerrain terrainOf(const Map& map, std::size_t level = 0)
{
    return {map.georeference(), readSamples(map.heightfield(), level)};
}

/// In degrees, in [0, 180].
inline double angleBetween(double a_deg, double b_deg)
{
    return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

/// Whether a point lies in a polygon, by the crossings of a ray with its edges.
inline bool isInside(const std::vector<GroundPosition>& polygon, double x, double y)
{
    bool is_inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const GroundPosition& a = polygon[i];
        const GroundPosition& b = polygon[(i + 1) % polygon.size()];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            is_inside = !is_inside;
        }
    }
    return is_inside;
}

} // namespace marsview::test
