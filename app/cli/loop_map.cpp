#include "app/cli/loop_map.h"

#include "app/cli/pile_mesh.h"
#include "core/base/check.h"
#include "core/session/open_map.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// The map and those below it as one surface.
Status touchPile(const LoopMapOptions& options, JobMonitor& monitor, LoopMap& result)
{
    auto pile = joinedPile(result.on_body.maps(), options.exaggeration, monitor);
    if (!pile) {
        return std::move(pile).error();
    }
    result.mesh = pile->joined.mesh->map(0);
    const double radius_m = options.radius_m.value_or(pile->radius_m);
    if (pile->in_tiles.empty()) {
        result.map = makeServoMap(pile->georeferences, pile->joined.mesh,
                                  {.kind = options.kind, .contact = {.radius_m = radius_m}});
        return Done{};
    }
    result.touch = std::make_unique<TouchMap>(pile->in_tiles);
    result.map = result.touch->make(options.kind, pile->tiled, *pile->joined.mesh,
                                    pile->georeferences, radius_m);
    return Done{};
}

Status putOnBody(const MapOptions& map,
                 const LoopMapOptions& options,
                 JobMonitor& monitor,
                 LoopMap& result)
{
    const auto failed = [&map](const Error& error) {
        return Error{error.code, fmt::format("{}: {}", map.path, error.message)};
    };
    const Georeference& georeference = result.opened->georeference();
    auto maps = pileOnBody(result.opened, options.pile, monitor);
    if (!maps) {
        return std::move(maps).error();
    }
    result.grid = maps->front().grid();
    result.on_body = BodyScene(std::move(maps).value());
    result.cell_m = 0.5 * (georeference.pixelWidthMeters() + georeference.pixelHeightMeters());
    if (!options.pile.below.empty()) {
        Status joined = touchPile(options, monitor, result);
        return joined ? joined : Status(failed(joined.error()));
    }
    const double radius_m = options.radius_m.value_or(0.5 * result.cell_m);
    auto layer = layOnBody(result.on_body.maps().front(), options.exaggeration, monitor);
    if (!layer) {
        return failed(layer.error());
    }
    if (layer->mesh) {
        result.mesh = std::move(layer->mesh);
        result.map = makeServoMap({result.opened, &georeference}, result.mesh,
                                  {.kind = options.kind, .contact = {.radius_m = radius_m}});
        return Done{};
    }
    result.touch = std::make_unique<TouchMap>(
        SceneMap{.map = result.opened, .frame = georeference.sceneFrame()}, MapEnds::Meet);
    result.map = result.touch->make(options.kind, layer->tiled, radius_m);
    result.mesh = layer->tiled->over(result.map->tiles.front().terrain->terrain());
    return Done{};
}

} // namespace

Result<LoopMap>
openLoopMap(const MapOptions& map, const LoopMapOptions& options, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> opened = openMap(map.spec(), defaultMapResources(), monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    LoopMap result;
    result.opened = std::move(opened).value();
    if (options.scene == SceneKind::Body) {
        if (Status put = putOnBody(map, options, monitor, result); !put) {
            return std::move(put).error();
        }
        return result;
    }
    const Georeference& georeference = result.opened->georeference();
    const Heightfield& heightfield = result.opened->heightfield();
    const SceneFrame& frame = georeference.sceneFrame();
    result.cell_m = frame.meanCellSideM();
    result.box = sceneBox(frame, georeference.columns(), georeference.rows(),
                          heightfield.range().value_or(HeightRange{}), options.exaggeration);
    result.touch = std::make_unique<TouchMap>(SceneMap{.map = result.opened, .frame = frame});
    result.map = result.touch->make(options.kind, options.exaggeration, options.radius_m);
    MARSVIEW_CHECK(result.map != nullptr); // openMap() fills the voids of a map in memory
    return result;
}

} // namespace marsview
