// Rows of heights as floats, for passes over all samples.
#pragma once

#include "core/terrain/heightfield.h"

#include <cstddef>
#include <span>

namespace marsview {

/// As below, for a single grid.
void readHeights(const SampleGrid& samples,
                 const ElevationScale& scale,
                 std::size_t first_column,
                 std::size_t row,
                 double base_m,
                 std::span<float> heights);

/// Writes the heights of the samples [first_column, first_column + heights.size()) of a row, minus
/// `base_m`, in meters; NaN for voids. All columns lie on the grid.
void readHeights(const Heightfield& heightfield,
                 std::size_t first_column,
                 std::size_t row,
                 double base_m,
                 std::span<float> heights);

} // namespace marsview
