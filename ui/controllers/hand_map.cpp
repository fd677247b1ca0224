#include "ui/controllers/hand_map.h"

#include <utility>

namespace marsview {
namespace {

// The GUI thread alone counts.
std::uint64_t nextMapId()
{
    static std::uint64_t last = 0;
    return ++last;
}

} // namespace

HandMap::HandMap(const SceneMap& map)
    : map_(map)
    , map_id_(nextMapId())
{
    const Heightfield& heightfield = map_.map->heightfield();
    if (map_.map->filled() || !heightfield.isTiled()) {
        return;
    }
    // The map has its coarsest tile always at hand: there is something to touch at once, and finer
    // ground comes as it is loaded.
    const TiledSamples& tiles = *heightfield.tiles();
    feeder_ = std::make_unique<ClipmapStreamer>(
        tiles.raster(),
        std::make_shared<const TileHeights>(map_.map->levels(), heightfield.scale()), tiles.top());
    terrain_ = std::make_shared<ServoTerrain>(feeder_->exchange(), feeder_->heights());
    feeder_->start();
}

std::shared_ptr<ServoMap> HandMap::make(ContactModelKind kind, double exaggeration) const
{
    const GoalFrame frame({map_.map, &map_.map->georeference()}, map_.frame, exaggeration);
    const ServoMapOptions options{
        .kind = kind, .contact = {.radius_m = 0.5 * map_.frame.meanCellSideM()}, .map_id = map_id_};
    if (map_.map->filled()) {
        return makeServoMap(frame, map_.map->filled(), options);
    }
    return terrain_ ? makeServoMap(frame, terrain_, options) : nullptr;
}

} // namespace marsview
