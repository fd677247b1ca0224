#include "haptics/terrain/ground_log.h"

namespace marsview {
namespace {

GroundPart partOf(std::uint64_t serial, const Georeference& georeference, const SceneFrame& frame)
{
    const Body* body = georeference.body();
    return {.part = serial,
            .columns = georeference.columns(),
            .rows = georeference.rows(),
            .ellipsoid = body != nullptr ? body->ellipsoid : Ellipsoid{},
            .frame = frame};
}

std::optional<std::uint32_t> indexOf(const ServoMap& map, std::size_t tiles) noexcept
{
    return map.below.empty() ? std::nullopt
                             : std::optional(static_cast<std::uint32_t>(map.tiles[tiles].map));
}

} // namespace

std::optional<std::uint32_t>
GroundLog::record(const ServoMap& map, bool was_notified, Queue& queue) noexcept
{
    const std::size_t most =
        2 + map.below.size() +
        map.tiles.size() * (ResidentTerrain::kLevelsMax + ClipmapBlend::kTilesMax);
    if (queue.room() < most) {
        return std::nullopt;
    }
    std::uint32_t count = 0;
    const auto put = [&](const GroundRecord& record) {
        queue.put(record);
        ++count;
    };
    if (map.serial != serial_) {
        serial_ = map.serial;
        put(partOf(map.serial, map.frame.georeference(), map.frame.frame()));
        for (const auto& below : map.below) {
            put(GroundBelow{partOf(map.serial, *below, below->sceneFrame())});
        }
    }
    if (map.map_id != map_id_) {
        map_id_ = map.map_id;
        shown_ = {};
        is_blending_ = false;
    }
    bool has_changed = was_notified;
    bool is_blending = false;
    for (std::size_t i = 0; i < map.tiles.size(); ++i) {
        const ResidentTerrain& terrain = map.tiles[i].terrain->resident();
        is_blending = is_blending || !terrain.blend().isEmpty();
        for (std::size_t k = 0; k < terrain.window().levelCount(); ++k) {
            const ShownTiles& shown = terrain.shown(k);
            if (shown != shown_[i][k]) {
                shown_[i][k] = shown;
                has_changed = true;
                put(GroundLevel{k, shown, indexOf(map, i)});
            }
        }
    }
    // A changing blend is reported again.
    if (has_changed || is_blending != is_blending_) {
        for (std::size_t i = 0; i < map.tiles.size(); ++i) {
            map.tiles[i].terrain->resident().blend().eachTile([&](const TileId& id, double weight) {
                put(GroundTile{id, weight, indexOf(map, i)});
            });
        }
        put(GroundFelt{was_notified ? map.serial : 0});
    }
    is_blending_ = is_blending;
    return count;
}

} // namespace marsview
