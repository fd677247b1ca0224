// Maps as measuring reads them, and angles.
#pragma once

#include "core/measure/measured_terrain.h"
#include "core/session/map.h"

#include <cmath>
#include <cstddef>

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

} // namespace marsview::test
