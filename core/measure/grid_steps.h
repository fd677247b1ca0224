// The ground under a step on the grid.
#pragma once

#include "core/measure/measured_terrain.h"

#include <optional>

namespace marsview {

/// Meters east and north for one column and one row: the derivative of the placement on the ground,
/// on the ellipsoid or the plane.
struct GridSteps {
    double east_per_column = 1.0;
    double north_per_column = 0.0;
    double east_per_row = 0.0;
    double north_per_row = -1.0;

    /// Area of a cell in square meters, positive.
    double cellArea() const noexcept
    {
        const double area = east_per_column * north_per_row - north_per_column * east_per_row;
        return area < 0.0 ? -area : area;
    }
};

/// At a position; relative error below 1e-7. Empty outside the projection. Calls PROJ four times
/// for a map projection.
std::optional<GridSteps> gridSteps(const MeasuredTerrain& terrain, GridPoint grid);

} // namespace marsview
