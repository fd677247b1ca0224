#include "haptics/terrain/body_layers.h"

#include <utility>

namespace marsview {

std::shared_ptr<const TileHeights> tileHeightsOf(const Map& map)
{
    return std::make_shared<const TileHeights>(map.levels(), map.heightfield().scale());
}

Result<BodyLayer> layOnBody(const BodyTerrain& terrain, double exaggeration, JobMonitor& monitor)
{
    const std::shared_ptr<const Map>& map = terrain.shown();
    if (map->filled()) {
        auto mesh = BodyMesh::build(map->filled(), map->georeference(), exaggeration, monitor,
                                    terrain.grid()->ellipsoid());
        if (!mesh) {
            return std::move(mesh).error();
        }
        return BodyLayer{.mesh = std::move(mesh).value()};
    }
    auto tiled = TiledBodyMesh::build(terrain.grid(), tileHeightsOf(*map), exaggeration, monitor);
    if (!tiled) {
        return std::move(tiled).error();
    }
    return BodyLayer{.mesh = nullptr, .tiled = std::move(tiled).value(), .map = map};
}

Result<JoinedLayers> joinLayers(const std::vector<BodyLayer>& layers, JobMonitor& monitor)
{
    JoinedLayers joined;
    std::vector<std::shared_ptr<const BodyMesh>> meshes;
    for (const BodyLayer& layer : layers) {
        if (!layer.tiled) {
            meshes.push_back(layer.mesh);
            continue;
        }
        joined.waiting.push_back(std::make_shared<const WaitingTerrain>(
            layer.map->heightfield().tiles()->raster(), tileHeightsOf(*layer.map)));
        meshes.push_back(layer.tiled->over(joined.waiting.back()));
    }
    auto mesh = LayeredMesh::build(meshes, monitor);
    for (const auto& waiting : joined.waiting) {
        if (waiting->error()) {
            return *waiting->error();
        }
    }
    if (!mesh) {
        return std::move(mesh).error();
    }
    joined.mesh = std::move(mesh).value();
    return joined;
}

} // namespace marsview
