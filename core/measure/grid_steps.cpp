#include "core/measure/grid_steps.h"

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

GridSteps scaled(const GeoTransform::Terms& terms, double east_per_x, double north_per_y)
{
    return {.east_per_column = terms[1] * east_per_x,
            .north_per_column = terms[4] * north_per_y,
            .east_per_row = terms[2] * east_per_x,
            .north_per_row = terms[5] * north_per_y};
}

// Meters per unit of a geographic CRS, in closed form.
std::optional<GridSteps> onDegrees(const Georeference& georeference, GridPoint grid)
{
    const Crs& crs = *georeference.crs();
    const Ellipsoid& ellipsoid = *crs.ellipsoid();
    const auto here = georeference.toGeographic(grid);
    if (!here) {
        return std::nullopt;
    }
    const Angle graphic = ellipsoid.planetographic(here->latitude);
    const double north_m = crs.latitudeKind() == LatitudeKind::Planetocentric
                               ? ellipsoid.metersPerRadianOfPlanetocentricLatitude(graphic)
                               : ellipsoid.metersPerRadianOfPlanetographicLatitude(graphic);
    return scaled(georeference.transform().terms(),
                  ellipsoid.metersPerRadianOfLongitude(graphic) * crs.unit() * crs.eastSign(),
                  north_m * crs.unit() * crs.northSign());
}

} // namespace

std::optional<GridSteps> gridSteps(const MeasuredTerrain& terrain, GridPoint grid)
{
    const Georeference& georeference = terrain.georeference();
    if (!terrain.ground().ellipsoid()) {
        const double unit_m = georeference.crs() ? georeference.crs()->unit() : 1.0;
        return scaled(georeference.transform().terms(), unit_m, unit_m);
    }
    if (georeference.crs()->kind() == CrsKind::Geographic) {
        return onDegrees(georeference, grid);
    }
    // Chords of 2e-4 of the radius: short enough for their curvature (1e-8), long enough for the
    // rounding of PROJ.
    const double reach_m = 1e-4 * terrain.ground().ellipsoid()->equatorial_m;
    const auto here = terrain.fromGrid(grid);
    if (!here) {
        return std::nullopt;
    }
    const LocalFrame frame = terrain.ground().frameAt(*here);
    const auto step = [&](double columns, double rows) -> std::optional<Vec3> {
        const auto before = terrain.fromGrid({grid.column - columns, grid.row - rows});
        const auto after = terrain.fromGrid({grid.column + columns, grid.row + rows});
        if (!before || !after) {
            return std::nullopt;
        }
        const Vec3 way =
            terrain.ground().cartesian(*after, 0.0) - terrain.ground().cartesian(*before, 0.0);
        const double samples = 2.0 * (columns + rows);
        return Vec3{dot(way, frame.east) / samples, dot(way, frame.north) / samples, 0.0};
    };
    const auto column = step(reach_m / georeference.pixelWidthMeters(), 0.0);
    const auto row = step(0.0, reach_m / georeference.pixelHeightMeters());
    if (!column || !row) {
        return std::nullopt;
    }
    return GridSteps{column->x, column->y, row->x, row->y};
}

} // namespace marsview
