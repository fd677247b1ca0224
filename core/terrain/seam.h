// The strip of cells that closes a global map across its seam.
#pragma once

#include "core/geo/frames.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace marsview {

/// A position between the last column and the first one, which is its eastern neighbor.
struct SeamPosition {
    std::size_t row = 0; // upper row of the cell
    double u = 0.0;      // fractions within the cell, as in triangulation.h
    double v = 0.0;
};

/// The position of `grid` in the seam of a wrapping map of columns × rows samples. Empty if it lies
/// on the grid itself, or beyond the first or last row.
inline std::optional<SeamPosition> seamCell(GridPoint grid, std::size_t columns, std::size_t rows)
{
    const double last_column = static_cast<double>(columns - 1);
    const double last_row = static_cast<double>(rows - 1);
    // Counted from the last column. Left of the first one the fraction is slightly less than 1 at
    // most, which may round to 1 but not beyond.
    const double u = grid.column < 0.0 ? grid.column + 1.0 : grid.column - last_column;
    const bool is_between =
        grid.column < 0.0 ? u >= 0.0 : u > 0.0 && grid.column < last_column + 1.0;
    if (!(is_between && grid.row >= 0.0 && grid.row <= last_row)) {
        return std::nullopt;
    }
    const double row = std::min(std::floor(grid.row), last_row - 1.0);
    return SeamPosition{static_cast<std::size_t>(row), u, grid.row - row};
}

} // namespace marsview
