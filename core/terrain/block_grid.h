// One level of mean heights of blocks, and the filling of its gaps from a coarser level: the parts
// of BlockMeans, for whole maps and for parts of maps.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/large_vector.h"
#include "core/raster/raster_info.h"
#include "core/raster/sample_grid.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace marsview {

/// Means over square blocks of samples; those at the last column and row may be smaller.
struct BlockGrid {
    std::size_t columns = 0;
    std::size_t rows = 0;
    LargeVector<float> means_m; // NaN if all samples are void
    LargeVector<float> shares;  // fractions of valid samples, in [0, 1]; empty: all 1
};

/// The samples that blocks cover.
struct BlockExtent {
    std::size_t columns = 0; // of samples
    std::size_t rows = 0;
    std::size_t block_samples = 0; // along a side

    std::size_t blockColumns() const { return (columns + block_samples - 1) / block_samples; }
    std::size_t blockRows() const { return (rows + block_samples - 1) / block_samples; }
    /// The number of samples of a block, void or not.
    float sampleCount(std::size_t column, std::size_t row) const
    {
        return static_cast<float>(std::min(block_samples, columns - column * block_samples)) *
               static_cast<float>(std::min(block_samples, rows - row * block_samples));
    }
    BlockExtent coarser() const { return {columns, rows, 2 * block_samples}; }
};

enum class BlockShares { None, Kept };

/// A grid for these blocks, not yet measured: 0 everywhere.
BlockGrid emptyBlocks(const BlockExtent& extent, BlockShares shares);
/// The same without values.
BlockGrid blocksToBeFilled(const BlockExtent& extent, BlockShares shares);

/// Measures rows [begin, end) of blocks of `block_samples` a side, all of whose samples are in
/// `samples`. `grid` has all rows of blocks; parts may be measured concurrently.
void measureBlocks(const SampleGrid& samples,
                   std::size_t block_samples,
                   const ElevationScale& scale,
                   std::size_t begin,
                   std::size_t end,
                   BlockGrid& grid);

/// Means over four blocks each. `extent` is that of `finer`. Blocks with fewer samples weigh less.
BlockGrid reduced(const BlockGrid& finer, const BlockExtent& extent);

/// Some rows of one level's means.
struct BlockRows {
    std::size_t columns = 0;
    std::size_t level_rows = 0; // of the whole level
    std::size_t first_row = 0;
    LargeVector<float> heights_m; // of rows from first_row on

    std::size_t endRow() const { return first_row + heights_m.size() / columns; }
    float operator()(std::size_t column, std::size_t row) const
    {
        return heights_m[(row - first_row) * columns + column];
    }
};

/// A position in blocks, 0 being the center of the first, relative to the neighboring centers.
struct BlockPlace {
    std::size_t before = 0;
    std::size_t after = 0;
    float share = 0.0F; // of `after`
};

/// Positions beyond the outermost centers are clamped to them. `position` is in blocks.
inline BlockPlace blockPlace(double position, std::size_t count)
{
    const double inside = std::clamp(position, 0.0, static_cast<double>(count - 1));
    const auto before = static_cast<std::size_t>(inside);
    return {before, std::min(before + 1, count - 1),
            static_cast<float>(inside - static_cast<double>(before))};
}

/// The position of a sample between blocks of `block_samples`.
inline BlockPlace placeOfSample(std::size_t sample, std::size_t block_samples, std::size_t count)
{
    return blockPlace(
        (static_cast<double>(sample) + 0.5) / static_cast<double>(block_samples) - 0.5, count);
}

inline float interpolated(float before, float after, float share)
{
    return before * (1.0F - share) + after * share;
}

/// Replaces NaN by the value of the next coarser level, whose gaps are filled. `coarser` has the
/// surrounding rows.
void fillGaps(BlockRows& rows, const BlockRows& coarser);

/// The rows of the next coarser level, which has `coarser_rows`, that filling rows [first, end) of
/// a level needs.
struct RowRange {
    std::size_t first = 0;
    std::size_t end = 0;
};
RowRange rowsToFillFrom(RowRange rows, std::size_t coarser_rows);

} // namespace marsview
