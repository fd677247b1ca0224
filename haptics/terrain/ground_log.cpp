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

} // namespace

std::optional<std::uint32_t>
GroundLog::record(const ServoMap& map, bool was_notified, Queue& queue) noexcept
{
    if (queue.room() < kMax) {
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
    if (map.terrain == nullptr) {
        return count; // a map in memory is always complete
    }
    const ResidentTerrain& terrain = map.terrain->resident();
    bool has_changed = was_notified;
    for (std::size_t k = 0; k < terrain.window().levelCount(); ++k) {
        const ShownTiles& shown = terrain.shown(k);
        if (shown != shown_[k]) {
            shown_[k] = shown;
            has_changed = true;
            put(GroundLevel{k, shown});
        }
    }
    const bool was_blending = is_blending_;
    is_blending_ = !terrain.blend().isEmpty();
    // A changing blend is reported again.
    if (has_changed || is_blending_ != was_blending) {
        terrain.blend().eachTile([&put](const TileId& id, double weight) {
            put(GroundTile{id, weight});
        });
        put(GroundFelt{was_notified ? map.serial : 0});
    }
    return count;
}

} // namespace marsview
