#include "app/cli/pile_mesh.h"

#include <algorithm>
#include <utility>

namespace marsview {

Result<PileMesh>
joinedPile(const std::vector<BodyTerrain>& maps, double exaggeration, JobMonitor& monitor)
{
    PileMesh pile;
    std::vector<std::shared_ptr<const BodyMesh>> meshes;
    for (const BodyTerrain& terrain : maps) {
        const std::shared_ptr<const Map>& map = terrain.shown();
        const Georeference& georeference = map->georeference();
        const double radius_m =
            0.25 * (georeference.pixelWidthMeters() + georeference.pixelHeightMeters());
        pile.radius_m = pile.radius_m > 0.0 ? std::min(pile.radius_m, radius_m) : radius_m;
        pile.georeferences.emplace_back(map, &georeference);
        if (map->filled()) {
            auto mesh = BodyMesh::build(map->filled(), georeference, exaggeration, monitor,
                                        terrain.grid()->ellipsoid());
            if (!mesh) {
                return std::move(mesh).error();
            }
            meshes.push_back(std::move(mesh).value());
            continue;
        }
        const Heightfield& heightfield = map->heightfield();
        const auto heights =
            std::make_shared<const TileHeights>(map->levels(), heightfield.scale());
        auto tiled = TiledBodyMesh::build(terrain.grid(), heights, exaggeration, monitor);
        if (!tiled) {
            return std::move(tiled).error();
        }
        pile.in_tiles.push_back(map);
        pile.tiled.push_back(std::move(tiled).value());
        pile.waiting.push_back(
            std::make_shared<const WaitingTerrain>(heightfield.tiles()->raster(), heights));
        meshes.push_back(pile.tiled.back()->over(pile.waiting.back()));
    }
    auto joined = LayeredMesh::build(meshes, monitor);
    for (const auto& waiting : pile.waiting) {
        if (waiting->error()) {
            return *waiting->error();
        }
    }
    if (!joined) {
        return std::move(joined).error();
    }
    pile.mesh = std::move(joined).value();
    return pile;
}

} // namespace marsview
