#include "app/bench/computed_terrain.h"

#include "core/base/check.h"
#include "core/terrain/surface_analysis.h"

#include <utility>

namespace marsview {

std::shared_ptr<const FilledHeightfield>
computedTerrain(std::size_t side,
                const std::function<double(std::size_t column, std::size_t row)>& height_m)
{
    auto grid = SampleGrid::create(SampleType::Float32, side, side);
    MARSVIEW_CHECK(grid);
    for (std::size_t row = 0; row < side; ++row) {
        auto* samples = reinterpret_cast<float*>(grid->rowData(row));
        for (std::size_t column = 0; column < side; ++column) {
            samples[column] = static_cast<float>(height_m(column, row));
        }
    }
    const SampleStatistics statistics = grid->applyRule({}, 0, side);
    grid->clearVoids();
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid).value()),
                                  statistics, {});
    JobMonitor monitor;
    auto analysis = analyze(heightfield, monitor);
    auto filled = FilledHeightfield::build(heightfield, *analysis, monitor);
    MARSVIEW_CHECK(filled);
    return std::make_shared<const FilledHeightfield>(std::move(filled).value());
}

} // namespace marsview
