#include "app/bench/terrain/terrain_bench.h"
#include "core/session/open_map.h"
#include "core/terrain/tiled_samples.h"

#include <memory>

namespace marsview {

MapResources tiledResources()
{
    MapResources resources = defaultMapResources();
    resources.held_bytes_max = 0;
    return resources;
}

Result<std::shared_ptr<const Map>> openInTiles(const TerrainBenchOptions& options,
                                               JobMonitor& monitor)
{
    return openMap(options.map.spec(), tiledResources(), monitor);
}

TouchedTiles touchedTiles(const std::shared_ptr<const Map>& map)
{
    const Heightfield& heightfield = map->heightfield();
    return {.raster = heightfield.tiles()->raster(),
            .heights = std::make_shared<const TileHeights>(map->levels(), heightfield.scale()),
            .frame = map->georeference().sceneFrame()};
}

} // namespace marsview
