#include "core/terrain/surface_analysis.h"

#include <utility>

namespace marsview {

Result<std::shared_ptr<const SurfaceAnalysis>> analyse(const Heightfield& heightfield,
                                                       JobMonitor& monitor)
{
    Result<MinMaxPyramid> bounds = MinMaxPyramid::build(heightfield, monitor);
    if (!bounds) {
        return std::move(bounds).error();
    }
    Result<BlockMeans> means = BlockMeans::build(heightfield, monitor);
    if (!means) {
        return std::move(means).error();
    }
    // This takes most of the time, and so is the progress that is seen.
    Result<DetailErrors> errors = DetailErrors::build({heightfield, *means}, monitor);
    if (!errors) {
        return std::move(errors).error();
    }
    return std::make_shared<const SurfaceAnalysis>(
        SurfaceAnalysis{.bounds = std::move(bounds).value(),
                        .means = std::move(means).value(),
                        .errors = std::move(errors).value()});
}

} // namespace marsview
