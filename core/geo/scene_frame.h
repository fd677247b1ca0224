// The metric frame in which a raster is drawn and touched.
#pragma once

#include "core/geo/frames.h"

namespace marsview {

/// Grid to scene and back: an affine map in the plane; heights pass unchanged except for the
/// exaggeration, which the caller chooses. All of it is arithmetic on values: any thread, the
/// servo thread included.
struct SceneFrame {
    GridPoint origin;             // the grid position that becomes x = y = 0: the raster's centre
    double east_per_column = 1.0; // metres
    double east_per_row = 0.0;
    double north_per_column = 0.0;
    double north_per_row = -1.0;
    constexpr bool operator==(const SceneFrame&) const = default;

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
