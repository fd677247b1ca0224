#include "core/session/loaded_map.h"

#include "core/view/exaggeration.h"
#include "core/view/scene_box.h"
#include "core/view/tint_range.h"

#include <utility>

namespace marsview {

Result<LoadedMap> prepareMap(std::shared_ptr<const Dataset> dataset, JobMonitor& monitor)
{
    const Heightfield& heightfield = dataset->heightfield();
    auto analysis = analyse(heightfield, monitor);
    if (!analysis) {
        return std::move(analysis).error();
    }
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const HeightRange tinted = tintRange((*analysis)->means, range);
    return LoadedMap{.dataset = std::move(dataset),
                     .analysis = std::move(analysis).value(),
                     .tint_range = tinted};
}

double suitableExaggeration(const Dataset& dataset)
{
    const Heightfield& heightfield = dataset.heightfield();
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const SceneBox box = sceneBox(dataset.georeference().sceneFrame(), heightfield.columns(),
                                  heightfield.rows(), range, 1.0);
    return defaultExaggeration(box.extent_m(), range.maximum_m - range.minimum_m);
}

} // namespace marsview
