#include "core/measure/terrain_slope.h"

#include "core/measure/constants.h"
#include "core/measure/grid_steps.h"
#include "core/measure/line_measures.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

struct Gradient {
    double east = kNoMeasure;
    double north = kNoMeasure;
};

// Of the triangle of a pole: distances from the axis, which the plane has, are shorter than those
// along the meridian by the sine of the latitude.
Gradient inCap(MeasuredTerrain& terrain, const CapTerrain& cap, GroundPosition position)
{
    const CapTerrain::Place place = terrain.placeIn(cap, position);
    const std::uint32_t face = cap.plane.faceAt(place.column, place.point);
    const auto elevation = [&](CapPlane::Point offset) {
        return terrain.elevation(cap, face, place.point + offset);
    };
    const double here_m = elevation({0.0, 0.0});
    const CapPlane::Point rise{elevation({1.0, 0.0}) - here_m, elevation({0.0, 1.0}) - here_m};
    const LocalFrame frame = terrain.ground().frameAt(position);
    const CapPlane::Point out = terrain.outwardIn(position);
    const double outward = (rise.x * out.x + rise.y * out.y) / cap.radius_m;
    const double ahead = (rise.y * out.x - rise.x * out.y) / cap.radius_m;
    return {terrain.columnsRunEast() ? ahead : -ahead, -outward * frame.up.z};
}

Gradient ofTriangle(MeasuredTerrain& terrain, GroundPosition position)
{
    const auto grid = terrain.toGrid(position);
    const auto place = grid ? terrain.placeOf(*grid) : std::nullopt;
    if (const CapTerrain* cap = grid && !place ? terrain.capBeyond(grid->row) : nullptr) {
        return inCap(terrain, *cap, position);
    }
    const auto steps = place ? gridSteps(terrain, *grid) : std::nullopt;
    if (!steps) {
        return {};
    }
    const CellHeights z = terrain.cell(place->column, place->row);
    const double width = terrain.columnLine(place->column + 1) - terrain.columnLine(place->column);
    const double height = terrain.rowLine(place->row + 1) - terrain.rowLine(place->row);
    const bool is_upper = place->u >= place->v;
    const double per_column =
        (is_upper ? z.upper_right - z.upper_left : z.lower_right - z.lower_left) / width;
    const double per_row =
        (is_upper ? z.lower_right - z.upper_right : z.lower_left - z.upper_left) / height;
    // per_column = east·east_per_column + north·north_per_column, and likewise for rows.
    const double determinant = steps->east_per_column * steps->north_per_row -
                               steps->north_per_column * steps->east_per_row;
    return {(per_column * steps->north_per_row - per_row * steps->north_per_column) / determinant,
            (per_row * steps->east_per_column - per_column * steps->east_per_row) / determinant};
}

Gradient overBaseline(MeasuredTerrain& terrain, GroundPosition position, double baseline_m)
{
    const auto at = [&](double azimuth_deg) {
        return terrain.elevation(terrain.ground().ray(position, azimuth_deg).at(0.5 * baseline_m));
    };
    return {(at(90.0) - at(270.0)) / baseline_m, (at(0.0) - at(180.0)) / baseline_m};
}

} // namespace

double longestBaselineM(const Ground& ground)
{
    return ground.ellipsoid() ? std::numbers::pi * ground.ellipsoid()->polar_m
                              : std::numeric_limits<double>::infinity();
}

Result<std::vector<TerrainSlope>> measureSlopes(MeasuredTerrain& terrain,
                                                std::span<const GroundPosition> positions,
                                                std::optional<double> baseline_m,
                                                JobMonitor& monitor)
{
    if (Status status = checkPositions(terrain.ground(), positions, 1, "a slope"); !status) {
        return std::move(status).error();
    }
    if (baseline_m && *baseline_m > longestBaselineM(terrain.ground())) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("a baseline of {} m reaches more than half way around the body; "
                                 "use one of at most {:.0f} m",
                                 *baseline_m, longestBaselineM(terrain.ground()))};
    }
    std::vector<TerrainSlope> slopes;
    for (const GroundPosition& position : positions) {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "measuring was canceled"};
        }
        TerrainSlope slope{.elevation_m = terrain.elevation(position),
                           .slope_deg = kNoMeasure,
                           .aspect_deg = kNoMeasure};
        const Gradient gradient = baseline_m ? overBaseline(terrain, position, *baseline_m)
                                             : ofTriangle(terrain, position);
        const double steepness = std::hypot(gradient.east, gradient.north);
        if (std::isfinite(steepness) && std::isfinite(slope.elevation_m)) {
            slope.slope_deg = std::atan(steepness) * kDegreesPerRadian;
            if (steepness > 0.0) {
                const double downhill =
                    std::atan2(-gradient.east, -gradient.north) * kDegreesPerRadian;
                slope.aspect_deg = downhill < 0.0 ? downhill + 360.0 : downhill;
            }
        }
        if (terrain.failure()) {
            return *terrain.failure();
        }
        slopes.push_back(slope);
        monitor.report(static_cast<double>(slopes.size()) / static_cast<double>(positions.size()));
    }
    return slopes;
}

} // namespace marsview
