#include "haptics/trace/recorded_ground.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

namespace marsview {
namespace {

Error notThere()
{
    return Error{ErrorCode::Invalid, "the recording uses tiles that the map does not have"};
}

} // namespace

Result<std::shared_ptr<RecordedGround>> RecordedGround::make(
    const TiledRaster& raster, std::shared_ptr<const TileHeights> heights, std::uint32_t map)
{
    const std::size_t top_level = raster.layout().topLevel();
    auto top = raster.get({TileKind::Samples, static_cast<std::uint8_t>(top_level), 0, 0});
    if (!top) {
        return std::move(top).error();
    }
    return std::shared_ptr<RecordedGround>(
        new RecordedGround(raster, std::move(heights), std::move(top).value(), map));
}

RecordedGround::RecordedGround(const TiledRaster& raster,
                               std::shared_ptr<const TileHeights> heights,
                               std::shared_ptr<const Tile> top,
                               std::uint32_t map)
    : raster_(raster)
    , heights_(std::move(heights))
    , top_(std::move(top))
    , map_(map)
{
    const std::vector<GridPoint> centers(raster_.layout().topLevel() + 1);
    window_ = std::make_shared<const Clipmap>(heights_, top_, centers);
    for (std::size_t k = 0; k < window_->levelCount(); ++k) {
        shown_.push_back(window_->shown(k));
    }
    terrain_ = std::make_shared<ResidentTerrain>(*window_, heights_);
}

Status RecordedGround::follow(const GroundRecord& record)
{
    const TileLayout& layout = heights_->layout();
    if (const auto* level = std::get_if<GroundLevel>(&record)) {
        if (level->map.value_or(map_) != map_) {
            return Done{};
        }
        const ShownTiles& shown = level->shown;
        if (level->level >= shown_.size() || !Clipmap::fits(layout, level->level, shown) ||
            std::bit_width(shown.is_there) > shown.columns * shown.rows) {
            return notThere();
        }
        shown_[level->level] = shown;
        is_other_window_ = true;
    } else if (const auto* tile = std::get_if<GroundTile>(&record)) {
        if (tile->map.value_or(map_) != map_) {
            return Done{};
        }
        // The coarsest tile always has full weight.
        if (tile->id.level >= layout.topLevel() || !layout.contains(tile->id)) {
            return notThere();
        }
        blend_.put(layout, tile->id, tile->weight);
    } else if (std::holds_alternative<GroundFelt>(record)) {
        return showWindow();
    }
    return Done{};
}

Status RecordedGround::showWindow()
{
    std::shared_ptr<const Clipmap> shown = window_;
    if (std::exchange(is_other_window_, false)) {
        const auto next = std::make_shared<Clipmap>(heights_, top_, shown_);
        for (std::size_t k = 0; k < shown_.size(); ++k) {
            const ShownTiles& level = shown_[k];
            for (std::uint64_t rest = level.is_there; rest != 0; rest &= rest - 1) {
                const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
                const TileId id{TileKind::Samples, static_cast<std::uint8_t>(k),
                                next->level(k).tileColumn(i), next->level(k).tileRow(i)};
                if (next->has(id)) {
                    continue; // the coarsest
                }
                const Clipmap::Slot* slot = window_->slot(id);
                if (slot != nullptr && slot->tile != nullptr) {
                    next->put(slot->tile, 0.0);
                    continue;
                }
                auto tile = raster_.get(id);
                if (!tile) {
                    return std::move(tile).error();
                }
                next->put(std::move(tile).value(), 0.0);
            }
        }
        shown = next;
    }
    terrain_->show(*shown, blend_);
    window_ = std::move(shown);
    blend_.clear();
    return Done{};
}

} // namespace marsview
