// Attitude: strike and dip of a plane through points, with its uncertainty.
//
// The plane is fitted by principal components of the points in body-fixed Cartesian coordinates:
// A. J. Quinn and B. L. Ehlmann (2019), A PCA-based framework for determining remotely sensed
// geological surface orientations and their statistical quality, Earth and Space Science 6,
// 1378–1408, doi 10.1029/2018EA000416. Directions are those of the local frame at the center of the
// points, so they do not depend on a projection, on its north, or on the order of the points.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/measure/measured_terrain.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace marsview {

/// A point on the terrain.
struct TerrainPoint {
    GroundPosition position;
    double elevation_m = 0.0;
};

/// A semi-axis of the ellipse around the pole of a plane that contains the true pole.
struct PoleAxis {
    double half_angle_deg = 0.0;
    // Its direction, in the lower hemisphere.
    double trend_deg = 0.0;
    double plunge_deg = 0.0;
};

/// So many points lie exactly on a plane, and on a circle: they have no residuals, from which
/// errors could be estimated.
inline constexpr std::size_t kExactPoints = 3;

struct AttitudeUncertainty {
    double confidence = 0.95;
    double dip_error_deg = 0.0; // the largest difference within the ellipse
    /// 180 where the plane may be level, so that any strike is possible.
    double strike_error_deg = 0.0;
    std::array<PoleAxis, 2> axes; // the longer one first
    /// The standard deviation of elevations that the errors follow from; empty if they follow from
    /// the residuals.
    std::optional<double> elevation_error_m;
    /// False where the errors only follow from the step of the samples: a lower bound, which people
    /// are not shown.
    bool is_estimated = true;
};

struct Attitude {
    GroundPosition center;
    double center_elevation_m = 0.0;
    // Clockwise from north, in [0°, 360°); NaN for a level plane.
    double strike_deg = 0.0; // right-hand rule: the plane dips to the right
    double dip_direction_deg = 0.0;
    double dip_deg = 0.0; // in [0°, 90°]
    Vec3 normal;          // unit vector east, north, up; points upward
    double rms_m = 0.0;   // of the distances from the plane
    std::size_t points = 0;
    std::vector<double> residuals_m; // of each point, along the normal
    AttitudeUncertainty uncertainty;

    bool hasResiduals() const noexcept { return points > kExactPoints; }
    /// The pole in the lower hemisphere.
    double poleTrendDeg() const;
    double polePlungeDeg() const { return 90.0 - dip_deg; }
};

struct AttitudeOptions {
    /// Standard deviation of elevations; errors then follow from it instead of the residuals.
    std::optional<double> elevation_error_m{};
    /// Used with three points, which have no residuals.
    double default_elevation_error_m = 0.0;
};

/// The plane through three or more points. Invalid for fewer, for points that nearly coincide or
/// lie on a line (the ratio of their variances across and along is below 1e-4) in space or in plan,
/// and where the pole is uncertain by more than 45°.
Result<Attitude> fitAttitude(const Ground& ground,
                             std::span<const TerrainPoint> points,
                             const AttitudeOptions& options);

/// The same for positions on the terrain. OutOfRange for a position without terrain.
Result<Attitude> measureAttitude(MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> positions,
                                 const AttitudeOptions& options);

/// Half the step between the elevations that a sample near `elevation_m` can have, in meters: the
/// smallest error that samples of this raster have.
double elevationStepError(const RasterInfo& info, double elevation_m);

/// The elevations at these positions; OutOfRange with the number of the first position that has
/// none.
Result<std::vector<TerrainPoint>> pointsOnTerrain(MeasuredTerrain& terrain,
                                                  std::span<const GroundPosition> positions);

} // namespace marsview
