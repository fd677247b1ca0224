#include "app/console/touch_map.h"

#include "core/raster/raster_file.h"
#include "core/terrain/surface_analysis.h"

#include <utility>

namespace marsview {

Result<TouchMap> openTouchMap(const MapOptions& options, TouchStore store, JobMonitor& monitor)
{
    const DatasetSpec spec = options.spec();
    MapResources resources = defaultMapResources();
    if (store == TouchStore::Tiled) {
        resources.held_bytes_max = 0;
    }
    if (store != TouchStore::Held) {
        const Result<OpenPlan> plan = planOpening(spec, resources);
        if (!plan) {
            return plan.error();
        }
        if (plan->store != MapStore::Held) {
            Result<LoadedMap> map = openMap(spec, resources, monitor);
            if (!map) {
                return std::move(map).error();
            }
            return TouchMap{.dataset = map->dataset,
                            .analysis = map->analysis,
                            .filled = map->filled,
                            .levels = map->levels};
        }
    }
    auto dataset = loadDataset(spec, monitor, defaultMemoryBudget());
    if (!dataset) {
        return std::move(dataset).error();
    }
    const Heightfield& heightfield = (*dataset)->heightfield();
    auto analysis = analyse(heightfield, monitor);
    if (!analysis) {
        return std::move(analysis).error();
    }
    auto filled = FilledHeightfield::build(heightfield, *analysis, monitor);
    if (!filled) {
        return std::move(filled).error();
    }
    return TouchMap{.dataset = std::move(dataset).value(),
                    .analysis = std::move(analysis).value(),
                    .filled = std::make_shared<const FilledHeightfield>(std::move(filled).value()),
                    .levels = nullptr};
}

} // namespace marsview
