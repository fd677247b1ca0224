#include "app/bench/terrain/terrain_bench.h"
#include "core/terrain/tiled_samples.h"

#include <memory>

namespace marsview {

MapResources tiledResources()
{
    MapResources resources = defaultMapResources();
    resources.held_bytes_max = 0;
    return resources;
}

Result<LoadedMap> openInTiles(const TerrainBenchOptions& options, JobMonitor& monitor)
{
    return openMap(options.map.spec(), tiledResources(), monitor);
}

TouchedTiles touchedTiles(const LoadedMap& map)
{
    const Heightfield& heightfield = map.dataset->heightfield();
    return {.raster = heightfield.tiles()->raster(),
            .heights = std::make_shared<const TileHeights>(map.levels, heightfield.scale()),
            .frame = map.dataset->georeference().sceneFrame()};
}

} // namespace marsview
