#include "haptics/terrain/touch_map.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace marsview {
TouchMap::TouchMap(const SceneMap& map)
    : map_(map)
    , map_id_(nextMapId())
{
    const Heightfield& heightfield = map_.map->heightfield();
    if (map_.map->filled() || !heightfield.isTiled()) {
        return;
    }
    const TiledSamples& tiles = *heightfield.tiles();
    streamer_ = std::make_unique<ClipmapStreamer>(
        tiles.raster(),
        std::make_shared<const TileHeights>(map_.map->levels(), heightfield.scale()), tiles.top());
    terrain_ = std::make_shared<ServoTerrain>(streamer_->exchange(), streamer_->heights());
}

std::shared_ptr<ServoMap>
TouchMap::make(ContactModelKind kind, double exaggeration, std::optional<double> radius_m)
{
    const GoalFrame frame({map_.map, &map_.map->georeference()}, map_.frame, exaggeration);
    const ServoMapOptions options{
        .kind = kind,
        .contact = {.radius_m = radius_m.value_or(0.5 * map_.frame.meanCellSideM())},
        .map_id = map_id_};
    if (map_.map->filled()) {
        return makeServoMap(frame, map_.map->filled(), options);
    }
    if (!terrain_) {
        return nullptr;
    }
    if (!std::exchange(is_streaming_, true)) {
        streamer_->start();
    }
    return makeServoMap(frame, terrain_, options);
}

void TouchMap::release()
{
    if (std::exchange(is_streaming_, false)) {
        terrain_->leave();
        streamer_->stop();
    }
}

bool TouchMap::follow(MapContactModel& model, const ScenePoint& hand)
{
    if (!isTiled()) {
        return false;
    }
    const ResidentTerrain& surface = terrain_->resident();
    const GridPoint grid = map_.frame.toGrid(hand);
    const GridPoint at{std::clamp(grid.column, 0.0, static_cast<double>(surface.columns() - 1)),
                       std::clamp(grid.row, 0.0, static_cast<double>(surface.rows() - 1))};
    const HandMotion motion{.at = at,
                            .columns_per_s = 0.0,
                            .rows_per_s = 0.0,
                            .time_ns = std::chrono::steady_clock::now().time_since_epoch() /
                                       std::chrono::nanoseconds(1),
                            .is_active = true};
    terrain_->resident().setRate(std::numeric_limits<double>::infinity());
    if (!terrain_->refresh(motion, 1.0)) {
        return false;
    }
    model.terrainChanged();
    return true;
}

std::optional<ClipmapStreamerStatistics> TouchMap::statistics() const
{
    return streamer_ ? std::optional(streamer_->statistics()) : std::nullopt;
}

} // namespace marsview
