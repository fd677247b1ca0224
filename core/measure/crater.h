// Craters: a circle on the body through points of the rim.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/attitude.h"
#include "core/measure/measured_terrain.h"

#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

struct Crater {
    GroundPosition center;
    double diameter_m = 0.0; // twice the radius, which is a geodesic distance
    double rms_m = 0.0;      // of the distances of the rim points from the circle
    double rim_m = 0.0;      // mean elevation of the rim points
    double floor_m = 0.0;    // lowest elevation in the circle
    double depth_m = 0.0;    // from the rim to the floor
    std::size_t points = 0;
    bool is_approximate = false;

    bool hasResiduals() const noexcept { return points > kExactPoints; }
};

/// The circle of all positions at one geodesic distance from its center that fits best through
/// three or more rim points (least squares of distances). Invalid for fewer points, points nearly
/// on a line, and circles larger than a quarter of the body; OutOfRange for points without terrain;
/// Canceled; errors of reading.
Result<Crater>
measureCrater(MeasuredTerrain& terrain, std::span<const GroundPosition> rim, JobMonitor& monitor);

/// `count` positions on a circle, clockwise from its northernmost one.
std::vector<GroundPosition>
circleOn(const Ground& ground, GroundPosition center, double radius_m, std::size_t count);

} // namespace marsview
