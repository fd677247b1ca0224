#include "app/cli/touch_map.h"

#include "core/raster/raster_file.h"
#include "core/terrain/surface_analysis.h"

#include <utility>

namespace marsview {

Result<TouchMap> openTouchMap(const MapOptions& options, JobMonitor& monitor)
{
    auto dataset =
        loadDataset({.path = options.path, .band = options.band, .overrides = options.overrides()},
                    monitor, defaultMemoryBudget());
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
                    .filled = std::make_shared<const FilledHeightfield>(std::move(filled).value())};
}

} // namespace marsview
