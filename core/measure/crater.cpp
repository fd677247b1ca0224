#include "core/measure/crater.h"

#include "core/measure/attitude.h"
#include "core/measure/line_measures.h"
#include "core/measure/terrain_area.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

struct Circle {
    GroundPosition center;
    double radius_m = 0.0;
    double rms_m = 0.0;
};

// On the ground, from a position.
struct Offset {
    double east_m = 0.0;
    double north_m = 0.0;
};

Error nearlyOnALine()
{
    return {ErrorCode::Invalid,
            "the rim points are nearly on a line, so their circle is not determined; add points on "
            "other sides of the rim"};
}

// The center by the algebraic fit of Kåsa, on the plane of distances and azimuths from `origin`.
Result<GroundPosition>
firstCenter(const Ground& ground, GroundPosition origin, std::span<const GroundPosition> rim)
{
    double ee = 0.0;
    double nn = 0.0;
    double en = 0.0;
    double ep = 0.0;
    double np = 0.0;
    const auto count = static_cast<double>(rim.size());
    std::vector<Offset> offsets;
    Offset mean;
    for (const GroundPosition& position : rim) {
        const GroundLine line = ground.line(origin, position);
        const double azimuth = line.azimuthDeg() * kRadians;
        offsets.push_back({line.lengthM() * std::sin(azimuth), line.lengthM() * std::cos(azimuth)});
        mean.east_m += offsets.back().east_m / count;
        mean.north_m += offsets.back().north_m / count;
    }
    double square = 0.0;
    for (Offset& o : offsets) {
        o.east_m -= mean.east_m;
        o.north_m -= mean.north_m;
        square += (o.east_m * o.east_m + o.north_m * o.north_m) / count;
    }
    for (const Offset& o : offsets) {
        const double p = 0.5 * (o.east_m * o.east_m + o.north_m * o.north_m - square);
        ee += o.east_m * o.east_m;
        nn += o.north_m * o.north_m;
        en += o.east_m * o.north_m;
        ep += o.east_m * p;
        np += o.north_m * p;
    }
    // The ratio of the variances across and along, as for attitudes.
    constexpr double kFlattestTriangle = 1e-4;
    const double half_sum = 0.5 * (ee + nn);
    const double root = std::hypot(0.5 * (ee - nn), en);
    if (!(half_sum - root >= kFlattestTriangle * (half_sum + root)) || half_sum == 0.0) {
        return nearlyOnALine();
    }
    const double determinant = ee * nn - en * en;
    const double east = mean.east_m + (ep * nn - np * en) / determinant;
    const double north = mean.north_m + (np * ee - ep * en) / determinant;
    return ground.ray(origin, std::atan2(east, north) / kRadians).at(std::hypot(east, north));
}

// Gauss's and Newton's iteration on the distances themselves.
Circle refined(const Ground& ground, GroundPosition center, std::span<const GroundPosition> rim)
{
    const auto count = static_cast<double>(rim.size());
    Circle circle;
    for (int i = 0; i < 50; ++i) {
        std::vector<double> distances;
        std::vector<Offset> away; // the change of each distance as the center moves
        double mean_m = 0.0;
        Offset mean;
        for (const GroundPosition& position : rim) {
            const GroundLine line = ground.line(center, position);
            const double azimuth = line.azimuthDeg() * kRadians;
            distances.push_back(line.lengthM());
            away.push_back({-std::sin(azimuth), -std::cos(azimuth)});
            mean_m += distances.back() / count;
            mean.east_m += away.back().east_m / count;
            mean.north_m += away.back().north_m / count;
        }
        double ee = 0.0;
        double nn = 0.0;
        double en = 0.0;
        double er = 0.0;
        double nr = 0.0;
        double squares = 0.0;
        for (std::size_t k = 0; k < distances.size(); ++k) {
            const double residual_m = distances[k] - mean_m;
            const double e = away[k].east_m - mean.east_m;
            const double n = away[k].north_m - mean.north_m;
            ee += e * e;
            nn += n * n;
            en += e * n;
            er -= e * residual_m;
            nr -= n * residual_m;
            squares += residual_m * residual_m;
        }
        circle = {center, mean_m, std::sqrt(squares / count)};
        const double determinant = ee * nn - en * en;
        const double east = (er * nn - nr * en) / determinant;
        const double north = (nr * ee - er * en) / determinant;
        const double step_m = std::hypot(east, north);
        constexpr double kConvergedM = 1e-6;
        if (!(step_m > kConvergedM)) {
            break;
        }
        center =
            ground.ray(center, std::atan2(east, north) / kRadians).at(std::min(step_m, mean_m));
    }
    return circle;
}

} // namespace

std::vector<GroundPosition>
circleOn(const Ground& ground, GroundPosition center, double radius_m, std::size_t count)
{
    std::vector<GroundPosition> positions;
    for (std::size_t i = 0; i < count; ++i) {
        const double azimuth = 360.0 * static_cast<double>(i) / static_cast<double>(count);
        positions.push_back(ground.ray(center, azimuth).at(radius_m));
    }
    return positions;
}

Result<Crater>
measureCrater(MeasuredTerrain& terrain, std::span<const GroundPosition> rim, JobMonitor& monitor)
{
    const Ground& ground = terrain.ground();
    if (Status status = checkPositions(ground, rim, 3, "a crater"); !status) {
        return std::move(status).error();
    }
    const Result<std::vector<TerrainPoint>> points = pointsOnTerrain(terrain, rim);
    if (!points) {
        return points.error();
    }
    Vec3 middle;
    for (const GroundPosition& position : rim) {
        middle = middle + ground.cartesian(position, 0.0) * (1.0 / static_cast<double>(rim.size()));
    }
    const Result<GroundPosition> first = firstCenter(ground, ground.positionOf(middle), rim);
    if (!first) {
        return first.error();
    }
    const Circle circle = refined(ground, *first, rim);
    const double radius_m_max = ground.ellipsoid()
                                    ? ground.ellipsoid()->polar_m * std::numbers::pi / 4.0
                                    : std::numeric_limits<double>::infinity();
    if (!(circle.radius_m <= radius_m_max)) {
        return nearlyOnALine();
    }
    Crater crater{.center = circle.center,
                  .diameter_m = 2.0 * circle.radius_m,
                  .rms_m = circle.rms_m,
                  .points = rim.size(),
                  .is_approximate = terrain.isApproximate()};
    for (const TerrainPoint& point : *points) {
        crater.rim_m += point.elevation_m / static_cast<double>(rim.size());
    }
    // Between its vertices, the polygon is within 1e-5 of the radius of the circle.
    constexpr std::size_t kVertices = 720;
    const Result<TerrainArea> inside = measureArea(
        terrain, circleOn(ground, circle.center, circle.radius_m, kVertices), {}, monitor);
    if (!inside) {
        return inside.error();
    }
    crater.floor_m = inside->min_m;
    crater.depth_m = crater.rim_m - crater.floor_m;
    return crater;
}

} // namespace marsview
