// The strip of cells that closes a map which goes once around its body.
#pragma once

#include "core/geo/frames.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace marsview {

/// A position between the last column and the first one, which is its eastern neighbour.
struct SeamPosition {
    std::size_t row = 0; // upper row of the cell
    double u = 0.0;      // fractions within the cell, as in triangulation.h
    double v = 0.0;
};

/// Where `grid` lies in the seam of a wrapping map of columns × rows samples. Nothing where it lies
/// on the grid itself, or beyond the first or last row.
inline std::optional<SeamPosition> seamCell(GridPoint grid, std::size_t columns, std::size_t rows)
{
    const double count = static_cast<double>(columns);
    const double last_row = static_cast<double>(rows - 1);
    const double column = grid.column < 0.0 ? grid.column + count : grid.column;
    if (!(column > count - 1.0 && column < count && grid.row >= 0.0 && grid.row <= last_row)) {
        return std::nullopt;
    }
    const double row = std::min(std::floor(grid.row), last_row - 1.0);
    return SeamPosition{static_cast<std::size_t>(row), column - (count - 1.0), grid.row - row};
}

} // namespace marsview
