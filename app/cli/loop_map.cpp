#include "app/cli/loop_map.h"

#include "core/session/open_map.h"

#include <utility>

namespace marsview {

Result<LoopMap>
openLoopMap(const MapOptions& map, const LoopMapOptions& options, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> opened = openMap(map.spec(), defaultMapResources(), monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    LoopMap result;
    result.opened = std::move(opened).value();
    const Georeference& georeference = result.opened->georeference();
    const Heightfield& heightfield = result.opened->heightfield();
    result.cell_m = 0.5 * (georeference.pixelWidthMeters() + georeference.pixelHeightMeters());
    result.radius_m = options.radius_m.value_or(0.5 * result.cell_m);
    result.box = sceneBox(georeference.sceneFrame(), georeference.columns(), georeference.rows(),
                          heightfield.range().value_or(HeightRange{}), options.exaggeration);
    const GoalFrame frame({result.opened, &georeference}, options.exaggeration);
    const ServoMapOptions servo{.kind = options.kind, .contact = {.radius_m = result.radius_m}};
    if (result.opened->filled()) {
        result.map = makeServoMap(frame, result.opened->filled(), servo);
        return result;
    }
    auto feeder = ClipmapStreamer::create(
        heightfield.tiles()->raster(),
        std::make_shared<const TileHeights>(result.opened->levels(), heightfield.scale()));
    if (!feeder) {
        return std::move(feeder).error();
    }
    result.feeder = std::move(feeder).value();
    const auto terrain =
        std::make_shared<ServoTerrain>(result.feeder->exchange(), result.feeder->heights());
    result.map = makeServoMap(frame, terrain, servo);
    result.feeder->start();
    return result;
}

} // namespace marsview
