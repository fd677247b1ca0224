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
    if (!map_.map->filled() && map_.map->heightfield().isTiled()) {
        streams_.push_back(streamOf(*map_.map, ends));
    }
}

TouchMap::TouchMap(const std::vector<std::shared_ptr<const Map>>& in_tiles)
    : map_({.map = in_tiles.front(), .frame = in_tiles.front()->georeference().sceneFrame()})
    , map_id_(nextMapId())
{
    for (const auto& map : in_tiles) {
        streams_.push_back(streamOf(*map, MapEnds::Meet));
    }
}

TouchMap::Stream TouchMap::streamOf(const Map& map, MapEnds ends)
{
    const Heightfield& heightfield = map.heightfield();
    const TiledSamples& tiles = *heightfield.tiles();
    const bool wraps = ends == MapEnds::Meet && map.georeference().wrapsAround();
    ClipmapStreamerOptions options;
    options.plan.sides.wraps = wraps;
    Stream stream;
    stream.streamer = std::make_unique<ClipmapStreamer>(
        tiles.raster(), std::make_shared<const TileHeights>(map.levels(), heightfield.scale()),
        tiles.top(), options);
    stream.terrain =
        std::make_shared<ServoTerrain>(stream.streamer->exchange(), stream.streamer->heights(),
                                       ResidentTerrainOptions{.wraps = wraps});
    return stream;
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
    if (!isTiled()) {
        return nullptr;
    }
    stream();
    return makeServoMap(frame, streams_.front().terrain, options);
}

std::shared_ptr<ServoMap> TouchMap::make(ContactModelKind kind,
                                         const std::shared_ptr<const TiledBodyMesh>& mesh,
                                         double radius_m)
{
    MARSVIEW_CHECK(streams_.size() == 1);
    stream();
    return makeServoMap({map_.map, &map_.map->georeference()}, mesh, streams_.front().terrain,
                        {.kind = kind, .contact = {.radius_m = radius_m}, .map_id = map_id_});
}

std::shared_ptr<ServoMap>
TouchMap::make(ContactModelKind kind,
               const std::vector<std::shared_ptr<const TiledBodyMesh>>& tiled,
               const LayeredMesh& mesh,
               std::vector<std::shared_ptr<const Georeference>> maps,
               double radius_m)
{
    MARSVIEW_CHECK(tiled.size() == streams_.size());
    stream();
    if (maps.empty()) {
        maps.emplace_back(map_.map, &map_.map->georeference());
    }
    std::vector<TiledLayer> layers;
    for (std::size_t i = 0; i < tiled.size(); ++i) {
        layers.push_back({.mesh = tiled[i], .terrain = streams_[i].terrain});
    }
    return makeServoMap(maps, mesh, layers,
                        {.kind = kind, .contact = {.radius_m = radius_m}, .map_id = map_id_});
}

void TouchMap::stream()
{
    if (!std::exchange(is_streaming_, true)) {
        for (const Stream& stream : streams_) {
            stream.streamer->start();
        }
    }
}

void TouchMap::release()
{
    if (std::exchange(is_streaming_, false)) {
        for (const Stream& stream : streams_) {
            stream.terrain->leave();
            stream.streamer->stop();
        }
    }
}

bool TouchMap::follow(ServoMap& made, const ScenePoint& hand)
{
    const auto time_ns =
        std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    bool has_changed = false;
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        ServoTerrain& terrain = *streams_[i].terrain;
        const auto [at, column_share, is_near] = made.surface->onGrid(hand, i);
        terrain.resident().setRate(std::numeric_limits<double>::infinity());
        has_changed = terrain.refresh({.at = at,
                                       .columns_per_s = 0.0,
                                       .rows_per_s = 0.0,
                                       .column_share = column_share,
                                       .time_ns = time_ns,
                                       .is_active = is_near},
                                      1.0) ||
                      has_changed;
    }
    if (has_changed) {
        made.model->terrainChanged();
    }
    return has_changed;
}

std::optional<ClipmapStreamerStatistics> TouchMap::statistics() const
{
    return isTiled() ? std::optional(streams_.front().streamer->statistics()) : std::nullopt;
}

} // namespace marsview
