#include "app/cli/pile_mesh.h"

#include <algorithm>
#include <utility>

namespace marsview {

Result<PileMesh>
joinedPile(const std::vector<BodyTerrain>& maps, double exaggeration, JobMonitor& monitor)
{
    PileMesh pile;
    std::vector<BodyLayer> layers;
    for (const BodyTerrain& terrain : maps) {
        const Georeference& georeference = terrain.map()->georeference();
        const double radius_m =
            0.25 * (georeference.pixelWidthMeters() + georeference.pixelHeightMeters());
        pile.radius_m = pile.radius_m > 0.0 ? std::min(pile.radius_m, radius_m) : radius_m;
        pile.georeferences.emplace_back(terrain.map(), &georeference);
        auto layer = layOnBody(terrain, exaggeration, monitor);
        if (!layer) {
            return std::move(layer).error();
        }
        if (layer->tiled) {
            pile.in_tiles.push_back(layer->map);
            pile.tiled.push_back(layer->tiled);
        }
        layers.push_back(std::move(layer).value());
    }
    auto joined = joinLayers(layers, monitor);
    if (!joined) {
        return std::move(joined).error();
    }
    pile.joined = std::move(joined).value();
    return pile;
}

} // namespace marsview
