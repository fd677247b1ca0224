#include "haptics/terrain/map_touch.h"

#include "core/contact/resident_heights.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace marsview {

MapTouch::MapTouch(const SceneMap& map)
    : map_(map)
{
    const Heightfield& heightfield = map_.map->heightfield();
    if (!heightfield.isTiled()) {
        return;
    }
    // A map always has its coarsest tile in memory.
    const TiledSamples& tiles = *heightfield.tiles();
    feeder_ = std::make_unique<ClipmapStreamer>(
        tiles.raster(),
        std::make_shared<const TileHeights>(map_.map->levels(), heightfield.scale()), tiles.top());
    feeder_->exchange()->windows.take();
    // A jump cannot be felt with a mouse, so no rate limit is needed.
    terrain_ = std::make_shared<ResidentTerrain>(
        *feeder_->exchange()->windows.front(), feeder_->heights(),
        ResidentTerrainOptions{.rate_m_per_s = std::numeric_limits<double>::infinity()});
}

std::unique_ptr<MapContactModel>
MapTouch::makeModel(ContactModelKind kind, double exaggeration, const ContactModelOptions& options)
{
    if (map_.map->filled()) {
        return makeContactModel(kind, {map_.map->filled(), map_.frame, exaggeration}, options);
    }
    if (!terrain_) {
        return nullptr;
    }
    if (!std::exchange(is_followed_, true)) {
        feeder_->start();
    }
    return makeContactModel(kind, TiledHeightfieldSurface(terrain_, map_.frame, exaggeration),
                            options);
}

bool MapTouch::follow(MapContactModel& model, const ScenePoint& hand)
{
    if (!isTiled()) {
        return false;
    }
    const GridPoint grid = map_.frame.toGrid(hand);
    const GridPoint at{std::clamp(grid.column, 0.0, static_cast<double>(terrain_->columns() - 1)),
                       std::clamp(grid.row, 0.0, static_cast<double>(terrain_->rows() - 1))};
    ClipmapExchange& exchange = *feeder_->exchange();
    exchange.motion.write({.at = at,
                           .columns_per_s = 0.0,
                           .rows_per_s = 0.0,
                           .time_ns = std::chrono::steady_clock::now().time_since_epoch() /
                                      std::chrono::nanoseconds(1),
                           .is_active = true});
    bool has_changed = false;
    if (exchange.windows.take()) {
        has_changed = terrain_->show(*exchange.windows.front(), at);
    }
    has_changed = terrain_->advance(at, 1.0) || has_changed;
    if (has_changed) {
        model.terrainChanged();
    }
    return has_changed;
}

void MapTouch::release()
{
    if (std::exchange(is_followed_, false)) {
        feeder_->exchange()->motion.write({});
        feeder_->stop();
    }
}

} // namespace marsview
