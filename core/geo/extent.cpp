#include "core/geo/extent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

constexpr int kStepsPerSide = 64;
constexpr double kTurn = 2.0 * std::numbers::pi;

std::array<GridPoint, 4> outerCorners(const Georeference& georeference)
{
    const double right = static_cast<double>(georeference.columns()) - 0.5;
    const double bottom = static_cast<double>(georeference.rows()) - 0.5;
    return {{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
}

GridPoint between(GridPoint a, GridPoint b, double t)
{
    return {a.column + (b.column - a.column) * t, a.row + (b.row - a.row) * t};
}

bool isInside(const Georeference& georeference, GeographicPoint place)
{
    const auto grid = georeference.toGrid(place);
    return grid && grid->column >= -0.5 && grid->row >= -0.5 &&
           grid->column <= static_cast<double>(georeference.columns()) - 0.5 &&
           grid->row <= static_cast<double>(georeference.rows()) - 0.5;
}

} // namespace

GridPoint clampedToSamples(const Georeference& georeference, GridPoint grid)
{
    return {std::clamp(grid.column, 0.0, static_cast<double>(georeference.columns()) - 1.0),
            std::clamp(grid.row, 0.0, static_cast<double>(georeference.rows()) - 1.0)};
}

MapExtent mapExtent(const Georeference& georeference)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    MapExtent extent{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
    for (const GridPoint corner : outerCorners(georeference)) {
        const MapPoint p = georeference.toMap(corner);
        extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
        extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
    }
    return extent;
}

std::optional<GeographicExtent> geographicExtent(const Georeference& georeference)
{
    const auto corners = outerCorners(georeference);
    double west = std::numeric_limits<double>::infinity();
    double east = -west;
    double south = west;
    double north = -west;
    std::optional<double> before;
    // Longitude is continued around the raster from the turn of the first corner.
    for (std::size_t side = 0; side < corners.size(); ++side) {
        for (int step = 0; step <= kStepsPerSide; ++step) {
            const GridPoint edge = between(corners[side], corners[(side + 1) % corners.size()],
                                           static_cast<double>(step) / kStepsPerSide);
            auto place = georeference.toGeographic(edge);
            if (!place) { // half a pixel of a sample at a pole lies beyond the pole
                place = georeference.toGeographic(clampedToSamples(georeference, edge));
            }
            if (!place) {
                return std::nullopt;
            }
            double longitude = place->longitude.radians();
            const bool has_turn = georeference.crs() && georeference.crs()->turn();
            if (before && !has_turn) {
                longitude = *before + std::remainder(longitude - *before, kTurn);
            }
            before = longitude;
            west = std::min(west, longitude);
            east = std::max(east, longitude);
            south = std::min(south, place->latitude.radians());
            north = std::max(north, place->latitude.radians());
        }
    }
    for (const double pole : {-1.0, 1.0}) {
        const Angle latitude = Angle::degrees(90.0 * pole);
        if (georeference.crs() && !georeference.crs()->turn() &&
            isInside(georeference, {Angle::radians(west), latitude})) {
            (pole < 0.0 ? south : north) = latitude.radians();
            west = -std::numbers::pi;
            east = std::numbers::pi;
        }
    }
    east = std::min(east, west + kTurn);
    return GeographicExtent{.west = Angle::radians(west),
                            .east = Angle::radians(east),
                            .south = Angle::radians(south),
                            .north = Angle::radians(north)};
}

} // namespace marsview
