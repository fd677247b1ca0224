// The metric frame in which a raster is drawn and touched.
#pragma once

#include "core/geo/frames.h"

#include <cmath>

namespace marsview {

/// Grid to scene and back: an affine map in the plane; heights are unchanged except for the
/// exaggeration, which the caller chooses. Pure arithmetic on values: any thread, the servo thread
/// included.
struct SceneFrame {
    GridPoint origin;             // the grid position that becomes x = y = 0: the raster's center
    double east_per_column = 1.0; // meters
    double east_per_row = 0.0;
    double north_per_column = 0.0;
    double north_per_row = -1.0;
    constexpr bool operator==(const SceneFrame&) const = default;

    /// Whether the frame is usable: finite, with cells of 1e-9 to 1e9 m that do not collapse to a
    /// line.
    bool isSound() const noexcept
    {
        constexpr double kCellMMax = 1e9;
        constexpr double kOriginMax = 1e12;
        constexpr double kAreaM2Min = 1e-18;
        const auto is_within = [](double value, double most) { return std::abs(value) <= most; };
        const double area_m2 = east_per_column * north_per_row - east_per_row * north_per_column;
        return is_within(origin.column, kOriginMax) && is_within(origin.row, kOriginMax) &&
               is_within(east_per_column, kCellMMax) && is_within(east_per_row, kCellMMax) &&
               is_within(north_per_column, kCellMMax) && is_within(north_per_row, kCellMMax) &&
               std::abs(area_m2) >= kAreaM2Min;
    }

    /// The mean length in meters of a step to the next column and of one to the next row.
    double meanCellSideM() const noexcept
    {
        return 0.5 * (std::hypot(east_per_column, north_per_column) +
                      std::hypot(east_per_row, north_per_row));
    }

    constexpr ScenePoint toScene(GridPoint grid, double scene_height_m) const noexcept
    {
        const double c = grid.column - origin.column;
        const double r = grid.row - origin.row;
        return {c * east_per_column + r * east_per_row, c * north_per_column + r * north_per_row,
                scene_height_m};
    }

    constexpr GridPoint toGrid(const ScenePoint& p) const noexcept
    {
        const double determinant =
            east_per_column * north_per_row - east_per_row * north_per_column;
        return {origin.column + (p.x * north_per_row - p.y * east_per_row) / determinant,
                origin.row + (p.y * east_per_column - p.x * north_per_column) / determinant};
    }
};

} // namespace marsview
