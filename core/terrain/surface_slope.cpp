#include "core/terrain/surface_slope.h"

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

// Change of height for one sample.
struct GridGradient {
    double per_column_m;
    double per_row_m;
};

GridGradient gradientOf(const Heightfield& heightfield, GridPoint grid)
{
    const auto first = [](double at, std::size_t count) {
        return std::clamp(std::floor(at), 0.0, static_cast<double>(count) - 2.0);
    };
    const double c = first(grid.column, heightfield.columns());
    const double r = first(grid.row, heightfield.rows());
    const double upper_left = heightfield.heightNow({c, r});
    const double lower_right = heightfield.heightNow({c + 1.0, r + 1.0});
    if (grid.column - c >= grid.row - r) {
        const double upper_right = heightfield.heightNow({c + 1.0, r});
        return {upper_right - upper_left, lower_right - upper_right};
    }
    const double lower_left = heightfield.heightNow({c, r + 1.0});
    return {lower_right - lower_left, lower_left - upper_left};
}

// A direction on the terrain.
struct Ground {
    double east_m;
    double north_m;
};

// The ground vectors of one column and one row.
struct Steps {
    Ground column;
    Ground row;
    bool is_at_pole = false;
};

constexpr double kHalfSample = 0.5; // samples, to both sides

Vec3 onEllipsoid(const GeographicPoint& point, const Ellipsoid& ellipsoid)
{
    const double latitude = ellipsoid.planetographic(point.latitude).radians();
    const double longitude = point.longitude.radians();
    const double flattening = ellipsoid.flattening();
    const double e2 = flattening * (2.0 - flattening);
    const double normal_m =
        ellipsoid.equatorial_m / std::sqrt(1.0 - e2 * std::sin(latitude) * std::sin(latitude));
    return {normal_m * std::cos(latitude) * std::cos(longitude),
            normal_m * std::cos(latitude) * std::sin(longitude),
            normal_m * (1.0 - e2) * std::sin(latitude)};
}

std::optional<Steps> stepsOnBody(const Georeference& georeference, GridPoint grid)
{
    const auto here = georeference.toGeographic(grid);
    if (!here || !georeference.crs()->ellipsoid()) {
        return std::nullopt;
    }
    const Ellipsoid& ellipsoid = *georeference.crs()->ellipsoid();
    const double latitude = ellipsoid.planetographic(here->latitude).radians();
    const double longitude = here->longitude.radians();
    const Vec3 east{-std::sin(longitude), std::cos(longitude), 0.0};
    const Vec3 north{-std::sin(latitude) * std::cos(longitude),
                     -std::sin(latitude) * std::sin(longitude), std::cos(latitude)};
    // Over both sides, or over one side if the projection ends at the other.
    const auto step = [&](double columns, double rows) -> std::optional<Ground> {
        const auto before = georeference.toGeographic({grid.column - columns, grid.row - rows});
        const auto after = georeference.toGeographic({grid.column + columns, grid.row + rows});
        if (!before && !after) {
            return std::nullopt;
        }
        const Vec3 way = onEllipsoid(after.value_or(*here), ellipsoid) -
                         onEllipsoid(before.value_or(*here), ellipsoid);
        const double samples = (before ? kHalfSample : 0.0) + (after ? kHalfSample : 0.0);
        return Ground{dot(way, east) / samples, dot(way, north) / samples};
    };
    const auto column = step(kHalfSample, 0.0);
    const auto row = step(0.0, kHalfSample);
    if (!column || !row) {
        return std::nullopt;
    }
    constexpr double kPole = 1e-9; // radians
    return Steps{*column, *row, std::cos(latitude) < kPole};
}

Steps stepsOnMap(const Georeference& georeference, GridPoint grid)
{
    const double unit_m = georeference.crs() ? georeference.crs()->unit() : 1.0;
    const auto step = [&](double columns, double rows) {
        const MapPoint before = georeference.toMap({grid.column - columns, grid.row - rows});
        const MapPoint after = georeference.toMap({grid.column + columns, grid.row + rows});
        return Ground{(after.x - before.x) * unit_m, (after.y - before.y) * unit_m};
    };
    return {step(kHalfSample, 0.0), step(0.0, kHalfSample)};
}

} // namespace

std::optional<SurfaceSlope>
slopeAt(const Heightfield& heightfield, const Georeference& georeference, GridPoint grid)
{
    if (!std::isfinite(heightfield.heightNow(grid))) {
        return std::nullopt;
    }
    const GridGradient height = gradientOf(heightfield, grid);
    const Steps steps = stepsOnBody(georeference, grid).value_or(stepsOnMap(georeference, grid));
    const Ground& c = steps.column;
    const Ground& r = steps.row;
    const double area = c.east_m * r.north_m - c.north_m * r.east_m;
    const double east = (height.per_column_m * r.north_m - height.per_row_m * c.north_m) / area;
    const double north = (height.per_row_m * c.east_m - height.per_column_m * r.east_m) / area;
    const double steepness = std::hypot(east, north);
    if (!std::isfinite(steepness)) {
        return std::nullopt;
    }
    SurfaceSlope result{.slope = Angle::radians(std::atan(steepness)), .aspect = std::nullopt};
    if (steepness > 0.0 && !steps.is_at_pole) {
        const double downhill = std::atan2(-east, -north);
        result.aspect =
            Angle::radians(downhill < 0.0 ? downhill + 2.0 * std::numbers::pi : downhill);
    }
    return result;
}

} // namespace marsview
