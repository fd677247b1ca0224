#include "core/terrain/tile_check.h"

#include "core/base/check.h"
#include "core/base/float_rounding.h"
#include "core/terrain/raw_ranges.h"

#include <algorithm>
#include <cstddef>

namespace marsview {
namespace {

constexpr std::size_t kBlock = RawRanges::kBlock;

// The range of the samples in rows and columns [first, end) that are not void.
template <typename View>
auto rangeOf(const SampleGrid& samples,
             const View& view,
             std::size_t first_column,
             std::size_t end_column,
             std::size_t first_row,
             std::size_t end_row)
{
    using T = std::remove_cvref_t<decltype(view(0, 0))>;
    RawRanges::Range<T> range;
    const bool has_voids = samples.hasVoids();
    for (std::size_t row = first_row; row < end_row; ++row) {
        for (std::size_t column = first_column; column < end_column; ++column) {
            if (!has_voids || !samples.isVoid(column, row)) {
                const T sample = view(column, row);
                range.include({sample, sample});
            }
        }
    }
    return range;
}

} // namespace

bool isWithinBounds(const SampleGrid& samples,
                    const TileId& tile,
                    const TileLayout& layout,
                    const MinMaxPyramid& bounds,
                    const ElevationScale& scale)
{
    static_assert(kTileSide % kBlock == 0);
    MARSVIEW_CHECK(tile.kind == TileKind::Samples);
    if (tile.level >= bounds.levelCount()) {
        return true;
    }
    const std::size_t first_column = tile.column * (kTileSide / kBlock);
    const std::size_t first_row = tile.row * (kTileSide / kBlock);
    // The last samples of a map may be the side of a block alone.
    const std::size_t blocks_across = std::min((samples.columns() + kBlock - 1) / kBlock,
                                               bounds.columns(tile.level) - first_column);
    const std::size_t blocks_down =
        std::min((samples.rows() + kBlock - 1) / kBlock, bounds.rows(tile.level) - first_row);
    const bool has_last_column = tile.column * kTileSide + samples.columns() == layout.columns;
    const bool has_last_row = tile.row * kTileSide + samples.rows() == layout.rows;
    const auto is_within = [&](auto view, std::size_t column, std::size_t row) {
        const std::size_t end_column = std::min((column + 1) * kBlock + 1, samples.columns());
        const std::size_t end_row = std::min((row + 1) * kBlock + 1, samples.rows());
        const bool is_whole = tile.level == 0 &&
                              (has_last_row || end_row == (row + 1) * kBlock + 1) &&
                              (has_last_column || end_column == (column + 1) * kBlock + 1);
        const auto range =
            rangeOf(samples, view, column * kBlock, end_column, row * kBlock, end_row);
        const MinMaxPyramid::Bounds& known =
            bounds.bounds(tile.level, first_column + column, first_row + row);
        if (range.isEmpty()) {
            return !is_whole || known.isEmpty();
        }
        // As bounds are made from ranges.
        const double a = scale.height(static_cast<double>(range.minimum));
        const double b = scale.height(static_cast<double>(range.maximum));
        const float minimum_m = roundedDown(std::min(a, b));
        const float maximum_m = roundedUp(std::max(a, b));
        return is_whole ? minimum_m == known.minimum_m && maximum_m == known.maximum_m
                        : minimum_m >= known.minimum_m && maximum_m <= known.maximum_m;
    };
    return samples.visit([&](auto view) {
        for (std::size_t row = 0; row < blocks_down; ++row) {
            for (std::size_t column = 0; column < blocks_across; ++column) {
                if (!is_within(view, column, row)) {
                    return false;
                }
            }
        }
        return true;
    });
}

} // namespace marsview
