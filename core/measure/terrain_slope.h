// Slope and aspect of the terrain at positions.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/measured_terrain.h"

#include <optional>
#include <span>
#include <vector>

namespace marsview {

struct TerrainSlope {
    double elevation_m = 0.0; // NaN outside the map and in voids, with the slope and the aspect
    double slope_deg = 0.0;   // in [0°, 90°)
    double aspect_deg = 0.0;  // downhill, clockwise from north, in [0°, 360°); NaN if level
};

/// Half way around the body; infinite on a plane.
double longestBaselineM(const Ground& ground);

/// Of the triangle at each position; with `baseline_m`, of the elevations half a baseline away in
/// the four cardinal directions. Lengths and north are those of the ellipsoid. Invalid and
/// OutOfRange for positions that are none and for a baseline above longestBaselineM(); Canceled;
/// errors of reading.
Result<std::vector<TerrainSlope>> measureSlopes(MeasuredTerrain& terrain,
                                                std::span<const GroundPosition> positions,
                                                std::optional<double> baseline_m,
                                                JobMonitor& monitor);

} // namespace marsview
