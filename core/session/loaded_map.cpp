#include "core/session/loaded_map.h"

#include "core/base/free_memory.h"
#include "core/view/exaggeration.h"
#include "core/view/scene_box.h"
#include "core/view/tint_range.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

// A relief texel's largest slope is this many times the slope that the default exaggeration makes
// steep. 16 bits then resolve 5e-4 of that, which no light shows.
constexpr double kSlopeReach = 16.0;

// Of the relief of the whole map.
SlopeRange slopesOf(const ReliefTile& whole, const Heightfield& heightfield, double slope_max)
{
    const std::size_t step = std::size_t{1}
                             << wholeRelief(heightfield.columns(), heightfield.rows()).level;
    return slopeRange(whole, (heightfield.columns() + step - 1) / step,
                      (heightfield.rows() + step - 1) / step, slope_max);
}

} // namespace

Result<LoadedMap> prepareMap(std::shared_ptr<const Dataset> dataset, JobMonitor& monitor)
{
    const Heightfield& heightfield = dataset->heightfield();
    auto analysis = [&] {
        const JobPart analysing(monitor, 0.0, 0.95);
        return analyse(heightfield, monitor);
    }();
    if (!analysis) {
        return std::move(analysis).error();
    }
    monitor.beginStage(0.95, 1.0);
    auto filled = FilledHeightfield::build(heightfield, *analysis, monitor);
    if (!filled) {
        return std::move(filled).error();
    }
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const HeightRange tinted = tintRange((*analysis)->means, range);
    const double slope_max = kSlopeReach / suitableExaggeration(*dataset);
    auto relief = std::make_shared<const ReliefTile>(
        makeReliefTile(heightfield, dataset->georeference().sceneFrame(),
                       wholeRelief(heightfield.columns(), heightfield.rows()), slope_max));
    // GDAL's blocks and the buffers of the passes: half as much again as the samples.
    returnFreeMemory();
    return LoadedMap{.dataset = std::move(dataset),
                     .analysis = std::move(analysis).value(),
                     .filled = std::make_shared<const FilledHeightfield>(std::move(filled).value()),
                     .levels = nullptr,
                     .tint_range = tinted,
                     .slope_range = slopesOf(*relief, heightfield, slope_max),
                     .slope_max = slope_max,
                     .relief = relief};
}

Result<LoadedMap> prepareTiledMap(std::shared_ptr<const Dataset> dataset,
                                  std::shared_ptr<const MapLevels> levels)
{
    const Heightfield& heightfield = dataset->heightfield();
    const double slope_max = kSlopeReach / suitableExaggeration(*dataset);
    Result<ReliefTile> relief =
        loadReliefTile(heightfield, dataset->georeference().sceneFrame(),
                       wholeRelief(heightfield.columns(), heightfield.rows()), slope_max);
    if (!relief) {
        return std::move(relief).error();
    }
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const HeightRange tinted = tintRange(levels->analysis->means, range);
    std::shared_ptr<const SurfaceAnalysis> analysis = levels->analysis;
    return LoadedMap{.dataset = std::move(dataset),
                     .analysis = std::move(analysis),
                     .filled = nullptr,
                     .levels = std::move(levels),
                     .tint_range = tinted,
                     .slope_range = slopesOf(*relief, heightfield, slope_max),
                     .slope_max = slope_max,
                     .relief = std::make_shared<const ReliefTile>(std::move(relief).value())};
}

ReliefTileId wholeRelief(std::size_t columns, std::size_t rows)
{
    // Nodes double from DetailErrors::kNodeCells cells until one is enough; tiles cover the same.
    std::size_t level = 0;
    while ((ReliefTile::kTexels << level) < std::max(columns, rows) - 1) {
        ++level;
    }
    return {.level = level};
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
