#include "ui/render/terrain_draw_data.h"

#include <algorithm>

namespace marsview {
namespace {

// Shading finer than this costs 128 MiB and shows only when zoomed in so far that the overview's
// triangles show too.
constexpr std::size_t kReliefSideMax = 4096;

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
    Result<ReliefMap> relief = makeReliefMap(
        heightfield, data->frame, std::min(limits.texture_side_max, kReliefSideMax), monitor);
    if (!relief) {
        return std::move(relief).error();
    }
    data->relief = std::move(relief).value();
    return std::shared_ptr<const TerrainDrawData>(std::move(data));
}

} // namespace marsview
