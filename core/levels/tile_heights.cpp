#include "core/levels/tile_heights.h"

#include "core/base/check.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace marsview {

TileHeights::TileHeights(std::shared_ptr<const MapLevels> levels, const ElevationScale& scale)
    : levels_(std::move(levels))
    , scale_(scale)
{
    MARSVIEW_CHECK(levels_ && levels_->analysis);
    MARSVIEW_CHECK(levels_->layout.columns >= 2 && levels_->layout.rows >= 2);
    const SampleStatistics& statistics = levels_->statistics;
    if (statistics.hasSamples()) {
        const double a = scale_.height(statistics.raw_minimum);
        const double b = scale_.height(statistics.raw_maximum);
        range_ = {std::min(a, b), std::max(a, b)}; // a negative gain swaps them
    }
}

double TileHeights::sample(const Tile& tile, std::size_t column, std::size_t row) const noexcept
{
    if (tile.samples.isVoid(column, row)) {
        const float filled_m = tile.filled_m[row * tile.samples.columns() + column];
        return std::clamp(static_cast<double>(filled_m), range_.minimum_m, range_.maximum_m);
    }
    return scale_.height(tile.samples.raw(column, row));
}

double TileHeights::ceiling(std::size_t column, std::size_t row) const noexcept
{
    // A node includes the samples at both ends of its cells: a sample on the line between two nodes
    // belongs to both.
    constexpr std::size_t kBlock = MinMaxPyramid::kBlock;
    const auto first = [](std::size_t sample) {
        return (std::max<std::size_t>(sample, 1) - 1) / kBlock;
    };
    const auto last = [](std::size_t sample, std::size_t count) {
        return std::min(sample, count - 2) / kBlock;
    };
    double ceiling_m = std::numeric_limits<double>::infinity();
    for (std::size_t r = first(row); r <= last(row, layout().rows); ++r) {
        for (std::size_t c = first(column); c <= last(column, layout().columns); ++c) {
            ceiling_m = std::min(ceiling_m, maximum(0, c, r));
        }
    }
    return ceiling_m;
}

} // namespace marsview
