#include "haptics/terrain/clipmap_blend.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace marsview {

SamplesNear::SamplesNear(const TileLayout& layout,
                         GridPoint hand,
                         std::size_t tiles,
                         bool wraps) noexcept
{
    const auto tile_of = [](double position, std::size_t count) {
        const double inside = position >= 0.0 ? position : 0.0; // also for NaN
        return static_cast<std::size_t>(std::min(inside, static_cast<double>(count - 1))) /
               kTileSide;
    };
    const auto along = [&](double position, std::size_t count) {
        const std::size_t tile = tile_of(position, count);
        return std::pair{(std::max(tile, tiles) - tiles) * kTileSide,
                         std::min((tile + tiles + 1) * kTileSide, count) - 1};
    };
    const auto [left, right] = along(hand.column, layout.columns);
    const auto [upper, lower] = along(hand.row, layout.rows);
    here_ = {left, right, upper, lower};
    beyond_ = here_;
    if (!wraps) {
        return;
    }
    const std::size_t last = (layout.columns - 1) / kTileSide;
    const std::size_t tile = tile_of(hand.column, layout.columns);
    if (tile < tiles) { // the last tiles; the very last one may be narrow
        const std::size_t first = last - std::min(last, tiles - tile);
        beyond_ = {first * kTileSide, layout.columns - 1, upper, lower};
    } else if (tile + tiles > last) {
        beyond_ = {0, std::min((tile + tiles - last) * kTileSide, layout.columns) - 1, upper,
                   lower};
    }
}

bool SamplesNear::doOverlap(const SampleBox& box) const noexcept
{
    return marsview::doOverlap(here_, box) || marsview::doOverlap(beyond_, box);
}

SampleBox ClipmapBlend::reach(const TileLayout& layout, const TileId& tile) noexcept
{
    // A sample of a level affects the cells around it, up to the next samples of that level.
    const auto along = [&tile](std::size_t first, std::size_t width, std::size_t level_count,
                               std::size_t count) {
        const std::size_t behind = first + width;
        const std::size_t low = first == 0 ? 0 : ((first - 1) << tile.level) + 1;
        const std::size_t high =
            behind >= level_count ? count - 1 : std::min((behind << tile.level) - 1, count - 1);
        return std::pair{low, high};
    };
    const auto [left, right] =
        along(std::size_t{tile.column} * kTileSide, layout.tileWidth(tile),
              layout.columnsAt(TileKind::Samples, tile.level), layout.columns);
    const auto [upper, lower] = along(std::size_t{tile.row} * kTileSide, layout.tileHeight(tile),
                                      layout.rowsAt(TileKind::Samples, tile.level), layout.rows);
    return {left, right, upper, lower};
}

void ClipmapBlend::add(const TileLayout& layout, const TileId& tile, double difference_m) noexcept
{
    if (!(difference_m > 0.0) || has(tile)) {
        return;
    }
    if (count_ == kTilesMax) {
        ++overflow_count_;
        return;
    }
    tiles_[count_++] = {tile, difference_m, 0.0, reach(layout, tile)};
}

void ClipmapBlend::put(const TileLayout& layout, const TileId& tile, double weight) noexcept
{
    if (count_ < kTilesMax && !has(tile)) {
        constexpr double kHeld = std::numeric_limits<double>::infinity(); // not changed by any rate
        tiles_[count_++] = {tile, kHeld, weight, reach(layout, tile)};
    }
}

void ClipmapBlend::advance(double seconds, double rate_m_per_s) noexcept
{
    // While a finer tile is blended over it, a coarser one keeps its weight, so that only one
    // difference changes at a time.
    std::array<bool, kTilesMax> is_held{};
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = 0; j < count_ && !is_held[i]; ++j) {
            is_held[i] = tiles_[j].id.level < tiles_[i].id.level &&
                         doOverlap(tiles_[i].reach, tiles_[j].reach);
        }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        Blended& tile = tiles_[i];
        if (!is_held[i]) {
            tile.weight += seconds * rate_m_per_s / tile.difference_m;
        }
        if (tile.weight < 1.0) {
            tiles_[kept++] = tile;
        }
    }
    count_ = kept;
}

double ClipmapBlend::weight(const TileId& tile) const noexcept
{
    const Blended* found = find(tile);
    return found == nullptr ? 1.0 : found->weight;
}

const ClipmapBlend::Blended* ClipmapBlend::find(const TileId& tile) const noexcept
{
    const auto end = tiles_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto found = std::find_if(tiles_.begin(), end,
                                    [&tile](const Blended& blended) { return blended.id == tile; });
    return found == end ? nullptr : &*found;
}

} // namespace marsview
