#include "ui/render/terrain_draw_data.h"

#include "core/view/exaggeration.h"
#include "core/view/scene_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace marsview {
namespace {

// Shading finer than this costs 128 MiB and shows only when zoomed in so far that the overview's
// triangles show too.
constexpr std::size_t kReliefSideMax = 4096;

// One volcano must not take half of the colours: this share of the map at either end has the end's
// colour.
constexpr double kRareShare = 0.005;

HeightRange commonRange(const OverviewGrid& overview, const HeightRange& otherwise)
{
    std::vector<float> heights;
    std::copy_if(overview.heights_m.begin(), overview.heights_m.end(), std::back_inserter(heights),
                 [](float h) { return !std::isnan(h); });
    const auto rare = static_cast<std::ptrdiff_t>(kRareShare * static_cast<double>(heights.size()));
    if (heights.size() < 2) {
        return otherwise;
    }
    std::nth_element(heights.begin(), heights.begin() + rare, heights.end());
    const float low = heights[static_cast<std::size_t>(rare)];
    std::nth_element(heights.begin(), heights.end() - 1 - rare, heights.end());
    const float high = *(heights.end() - 1 - rare);
    return {.minimum_m = static_cast<double>(low) + overview.base_height_m,
            .maximum_m = static_cast<double>(high) + overview.base_height_m};
}

} // namespace

Result<std::shared_ptr<const TerrainDrawData>>
makeTerrainDrawData(const Dataset& dataset, const RenderLimits& limits, JobMonitor& monitor)
{
    const Heightfield& heightfield = dataset.heightfield();
    auto data = std::make_shared<TerrainDrawData>();
    data->frame = dataset.georeference().sceneFrame();
    data->columns = heightfield.columns();
    data->rows = heightfield.rows();
    data->range = heightfield.range().value_or(HeightRange{});
    Result<OverviewGrid> overview = makeOverview(
        heightfield,
        {.triangle_count_max = limits.triangle_count_max, .side_max = limits.texture_side_max},
        monitor);
    if (!overview) {
        return std::move(overview).error();
    }
    data->overview = std::move(overview).value();
    data->tint_range = commonRange(data->overview, data->range);
    const SceneBox box = sceneBox(data->frame, data->columns, data->rows, data->range, 1.0);
    Result<ReliefMap> relief =
        makeReliefMap(heightfield, data->frame,
                      {.side_max = std::min(limits.texture_side_max, kReliefSideMax),
                       .exaggeration = defaultExaggeration(
                           box.extent_m(), data->range.maximum_m - data->range.minimum_m)},
                      monitor);
    if (!relief) {
        return std::move(relief).error();
    }
    data->relief = std::move(relief).value();
    return std::shared_ptr<const TerrainDrawData>(std::move(data));
}

} // namespace marsview
