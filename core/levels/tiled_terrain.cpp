#include "core/levels/tiled_terrain.h"

#include "core/base/check.h"
#include "core/terrain/touch_terrain.h"

#include <utility>

namespace marsview {

static_assert(TouchTerrain<TiledTerrain>);

TiledTerrain::TiledTerrain(std::shared_ptr<const TileHeights> heights)
    : heights_(std::move(heights))
{
    MARSVIEW_CHECK(heights_ != nullptr);
    columns_ = heights_->layout().columns;
    rows_ = heights_->layout().rows;
    bounds_ = &heights_->bounds();
    filled_maxima_m_ = &heights_->filledMaxima();
}

void TiledTerrain::setAtHand(const Tile& tile) const noexcept
{
    const std::size_t place = placeOf(tile.id.column, tile.id.row);
    const std::uint64_t key = keyOf(tile.id.column, tile.id.row);
    held_[place] = {key, &tile};
    last_ = {};
    if (tile.samples.hasVoids()) {
        places_[place] = {};
        return;
    }
    const void* samples = tile.samples.visit([](auto view) -> const void* { return view.data(); });
    places_[place] = {tile.id.column * static_cast<std::uint32_t>(kTileSide),
                      tile.id.row * static_cast<std::uint32_t>(kTileSide), samples,
                      tile.samples.columns()};
}

void TiledTerrain::clearPlace(std::uint32_t tile_column, std::uint32_t tile_row) const noexcept
{
    const std::size_t place = placeOf(tile_column, tile_row);
    if (held_[place].key == keyOf(tile_column, tile_row)) {
        held_[place] = {};
        places_[place] = {};
        last_ = {};
    }
}

void TiledTerrain::clearPlaces() const noexcept
{
    held_.fill({});
    places_.fill({});
    last_ = {};
}

const TiledTerrain::Place* TiledTerrain::findPlain(std::uint32_t column,
                                                   std::uint32_t row) const noexcept
{
    constexpr auto kSide = static_cast<std::uint32_t>(kTileSide);
    const Place& place = places_[placeOf(column / kSide, row / kSide)];
    if (((column - place.column) | (row - place.row)) >= kSide) {
        return nullptr;
    }
    last_ = place;
    return &last_;
}

} // namespace marsview
