#include "haptics/terrain/touch_map.h"

#include "core/base/check.h"

#include <chrono>
#include <limits>
#include <utility>

namespace marsview {
TouchMap::TouchMap(const SceneMap& map, MapEnds ends)
    : map_(map)
    , map_id_(nextMapId())
{
    const Heightfield& heightfield = map_.map->heightfield();
    if (map_.map->filled() || !heightfield.isTiled()) {
        return;
    }
    const TiledSamples& tiles = *heightfield.tiles();
    const bool wraps = ends == MapEnds::Meet && map_.map->georeference().wrapsAround();
    ClipmapStreamerOptions options;
    options.plan.sides.wraps = wraps;
    streamer_ = std::make_unique<ClipmapStreamer>(
        tiles.raster(),
        std::make_shared<const TileHeights>(map_.map->levels(), heightfield.scale()), tiles.top(),
        options);
    terrain_ = std::make_shared<ServoTerrain>(streamer_->exchange(), streamer_->heights(),
                                              ResidentTerrainOptions{.wraps = wraps});
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
    stream();
    return makeServoMap(frame, terrain_, options);
}

std::shared_ptr<ServoMap> TouchMap::make(ContactModelKind kind,
                                         const std::shared_ptr<const TiledBodyMesh>& mesh,
                                         double radius_m)
{
    MARSVIEW_CHECK(terrain_ != nullptr);
    stream();
    return makeServoMap({map_.map, &map_.map->georeference()}, mesh, terrain_,
                        {.kind = kind, .contact = {.radius_m = radius_m}, .map_id = map_id_});
}

std::shared_ptr<ServoMap> TouchMap::make(ContactModelKind kind,
                                         const TiledBodyMesh& tiled,
                                         const LayeredMesh& mesh,
                                         std::vector<std::shared_ptr<const Georeference>> maps,
                                         double radius_m)
{
    MARSVIEW_CHECK(terrain_ != nullptr);
    stream();
    if (maps.empty()) {
        maps.emplace_back(map_.map, &map_.map->georeference());
    }
    return makeServoMap(maps, mesh, tiled, terrain_,
                        {.kind = kind, .contact = {.radius_m = radius_m}, .map_id = map_id_});
}

void TouchMap::stream()
{
    if (!std::exchange(is_streaming_, true)) {
        streamer_->start();
    }
}

void TouchMap::release()
{
    if (std::exchange(is_streaming_, false)) {
        terrain_->leave();
        streamer_->stop();
    }
}

bool TouchMap::follow(ServoMap& made, const ScenePoint& hand)
{
    if (!isTiled()) {
        return false;
    }
    const auto [at, column_share] = made.surface->onGrid(hand);
    const HandMotion motion{.at = at,
                            .columns_per_s = 0.0,
                            .rows_per_s = 0.0,
                            .column_share = column_share,
                            .time_ns = std::chrono::steady_clock::now().time_since_epoch() /
                                       std::chrono::nanoseconds(1),
                            .is_active = true};
    terrain_->resident().setRate(std::numeric_limits<double>::infinity());
    if (!terrain_->refresh(motion, 1.0)) {
        return false;
    }
    made.model->terrainChanged();
    return true;
}

std::optional<ClipmapStreamerStatistics> TouchMap::statistics() const
{
    return streamer_ ? std::optional(streamer_->statistics()) : std::nullopt;
}

} // namespace marsview
