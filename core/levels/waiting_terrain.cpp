#include "core/levels/waiting_terrain.h"

#include "core/base/check.h"

#include <algorithm>
#include <utility>

namespace marsview {

WaitingTerrain::WaitingTerrain(TiledRaster raster,
                               std::shared_ptr<const TileHeights> heights,
                               std::size_t tiles_max)
    : TiledTerrain(std::move(heights))
    , raster_(std::move(raster))
    , tiles_max_(tiles_max)
{
    MARSVIEW_CHECK(tiles_max >= 1 && tiles_max <= kTilesMax);
    MARSVIEW_CHECK(raster_.layout().columns == columns() && raster_.layout().rows == rows() &&
                   raster_.layout().type == this->heights().layout().type);
}

const Tile* WaitingTerrain::fetch(std::size_t column, std::size_t row) const noexcept
{
    if (const Tile* tile = tileAtHand(column, row)) {
        return tile;
    }
    ++fetch_count_;
    const TileId id{TileKind::Samples, 0, static_cast<std::uint32_t>(column / kTileSide),
                    static_cast<std::uint32_t>(row / kTileSide)};
    if (error_ && std::find(failed_.begin(), failed_.end(), id) != failed_.end()) {
        return nullptr; // otherwise every request would read it again
    }
    auto tile = raster_.get(id);
    if (!tile) {
        failed_.push_back(id);
        if (!error_) {
            error_ = tile.error();
        }
        return nullptr;
    }
    MARSVIEW_CHECK(TileHeights::isTouchable(**tile));
    const std::size_t place = placeOf(id.column, id.row);
    if (!tiles_[place]) {
        if (places_.size() == tiles_max_) {
            std::shared_ptr<const Tile>& oldest = tiles_[places_.front()];
            clearPlace(oldest->id.column, oldest->id.row);
            oldest.reset();
            places_.pop_front();
        }
        places_.push_back(place);
    }
    tiles_[place] = std::move(tile).value();
    setAtHand(*tiles_[place]);
    return tiles_[place].get();
}

bool WaitingTerrain::isVoid(std::size_t column, std::size_t row) const noexcept
{
    const Tile* tile = fetch(column, row);
    return tile != nullptr && tile->samples.isVoid(column % kTileSide, row % kTileSide);
}

double WaitingTerrain::sampleElsewhere(std::size_t column, std::size_t row) const noexcept
{
    const Tile* tile = fetch(column, row);
    return tile != nullptr ? heights().sample(*tile, column % kTileSide, row % kTileSide)
                           : heights().ceiling(column, row);
}

} // namespace marsview
