#include "core/terrain/tiled_terrain.h"

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
}

void TiledTerrain::setAtHand(const Tile& tile) const noexcept
{
    const std::size_t place = placeOf(tile.id.column, tile.id.row);
    const std::uint64_t key = keyOf(tile.id.column, tile.id.row);
    held_[place] = {key, &tile};
    if (tile.samples.hasVoids()) {
        places_[place] = {};
        return;
    }
    const void* samples = tile.samples.visit([](auto view) -> const void* { return view.data(); });
    places_[place] = {key, samples, tile.samples.columns()};
}

void TiledTerrain::clearPlace(std::uint32_t tile_column, std::uint32_t tile_row) const noexcept
{
    const std::size_t place = placeOf(tile_column, tile_row);
    if (held_[place].key == keyOf(tile_column, tile_row)) {
        held_[place] = {};
        places_[place] = {};
    }
}

void TiledTerrain::clearPlaces() const noexcept
{
    held_.fill({});
    places_.fill({});
}

} // namespace marsview
