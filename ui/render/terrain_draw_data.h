// What the renderer needs of a map, made away from the GUI thread.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/scene_frame.h"
#include "core/session/dataset.h"
#include "core/terrain/overview.h"

#include <cstddef>
#include <memory>

namespace marsview {

/// What the graphics driver can take, and what it should be given.
struct RenderLimits {
    std::size_t texture_side_max = 4096;
    std::size_t triangle_count_max = 250'000;
};

/// A map reduced to what is drawn. Immutable; any thread.
struct TerrainDrawData {
    SceneFrame frame;
    std::size_t columns = 0; // of the map itself
    std::size_t rows = 0;
    HeightRange range;
    HeightRange tint_range; // over which the colour ramp is spread: all but the rarest heights
    OverviewGrid overview;
    ReliefMap relief;
};

/// Reads every sample a few times: not for the GUI thread. Only Cancelled can go wrong.
Result<std::shared_ptr<const TerrainDrawData>>
makeTerrainDrawData(const Dataset& dataset, const RenderLimits& limits, JobMonitor& monitor);

} // namespace marsview
