// The fill heights of the void samples of a tile.
#pragma once

#include "core/levels/level_file_format.h"

#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

/// The means of blocks of 8 × 8 samples around a level-0 tile, with gaps filled.
struct TileFill {
    FillWindow window;
    std::vector<float> means_m;    // row by row
    std::size_t level_columns = 0; // of blocks of the whole map
    std::size_t level_rows = 0;

    /// Fill heights of samples [first_column, first_column + heights.size()) of a row of the map:
    /// those of BlockMeans::filled(), to the bit. The samples lie on the tile, or on the first
    /// column or row of the next one.
    void row(std::size_t first_column, std::size_t row, std::span<float> heights_m) const;
};

} // namespace marsview
