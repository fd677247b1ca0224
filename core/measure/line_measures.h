// Distances and profiles along lines on the ground.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/measured_terrain.h"

#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// Lengths in meters. Elevations that are missing are NaN.
struct LegDistance {
    double geodesic_m = 0.0;  // along the ellipsoid
    double azimuth_deg = 0.0; // at the start, clockwise from north, in [0°, 360°)
    /// Along the terrain: the square root of (dx² + dz²), summed, with dx on the ellipsoid. Only
    /// over the parts with terrain.
    double surface_m = 0.0;
    double void_m = 0.0; // the part of geodesic_m without terrain
    double rise_m = 0.0; // elevation at the end minus elevation at the start
};

struct Distance {
    double geodesic_m = 0.0;
    double surface_m = 0.0;
    double void_m = 0.0;
    double straight_m = 0.0; // through space, between the terrain at both ends
    double rise_m = 0.0;
    std::vector<LegDistance> legs;
    bool is_approximate = false;
};

/// Along the shortest lines between consecutive positions, at least two. Exact: the surface is
/// followed from triangle to triangle. Invalid for fewer positions and coordinates that are not
/// finite or beyond a pole; Canceled; errors of reading.
Result<Distance> measureDistance(MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> positions,
                                 JobMonitor& monitor);

struct ProfilePoint {
    double distance_m = 0.0;  // from the start, over all legs
    GroundPosition position;  // longitude in the turn of the map
    double elevation_m = 0.0; // NaN in a gap
};

struct Profile {
    std::vector<ProfilePoint> points;
    std::vector<double> vertices_m; // the distances of the positions that were given
    bool is_approximate = false;
};

/// The elevations along the shortest lines between consecutive positions. By default a point where
/// the line meets an edge of a triangle, and some in between: between points the elevation is
/// linear within 0.1 mm. Where
/// the terrain ends or is void, points with NaN are a gap. With `step_m`, points at its multiples
/// and at the end. Errors as measureDistance(); OutOfRange if the step makes more than ten million
/// points.
Result<Profile> measureProfile(MeasuredTerrain& terrain,
                               std::span<const GroundPosition> positions,
                               std::optional<double> step_m,
                               JobMonitor& monitor);

/// The coarsest level at which a profile still has about `points_min` points, so that a first
/// picture of it reads little: the level for readSamples().
std::size_t profileLevel(const MeasuredTerrain& terrain,
                         std::span<const GroundPosition> positions,
                         double points_min);

/// Refuses fewer positions than `count_min`, coordinates that are not finite, and latitudes beyond
/// a pole. `what` says what is measured ("a distance").
Status checkPositions(const Ground& ground,
                      std::span<const GroundPosition> positions,
                      std::size_t count_min,
                      const char* what);

} // namespace marsview
