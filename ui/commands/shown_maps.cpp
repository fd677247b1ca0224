#include "ui/commands/shown_maps.h"

#include "ui/canvas/terrain_view.h"
#include "ui/globe/globe_view.h"

namespace marsview {

std::vector<std::shared_ptr<const Map>> shownMaps(const TerrainView& view, const GlobeView& globe)
{
    std::vector<std::shared_ptr<const Map>> maps;
    if (globe.isHidden()) {
        for (const SceneMap& shown : view.ground().maps()) {
            maps.push_back(shown.map);
        }
    } else {
        for (const BodyTerrain& shown : globe.scene().maps()) {
            maps.push_back(shown.map());
        }
    }
    return maps;
}

std::optional<GridPoint> onTopmost(const TerrainView& view, const Map& map, GridPoint grid)
{
    if (!view.map() || view.map().get() == &map) {
        return grid;
    }
    const Georeference& topmost = view.map()->georeference();
    if (map.georeference().body() == nullptr) {
        return topmost.toGrid(grid, map.georeference()); // the flat map has one CRS
    }
    const auto place = map.georeference().toGeographic(grid);
    return place ? topmost.toGrid(*place) : std::nullopt;
}

} // namespace marsview
