// Everything that is measured once over a whole map.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/block_means.h"
#include "core/terrain/detail_errors.h"
#include "core/terrain/min_max_pyramid.h"

#include <memory>

namespace marsview {

/// What rays, contact and drawing need to know of a surface to skip what does not matter.
/// Immutable; any thread.
struct SurfaceAnalysis {
    MinMaxPyramid bounds;
    BlockMeans means;
    DetailErrors errors;
};

/// Reads every sample a few times, on all cores: not for the GUI thread. Only Cancelled can go
/// wrong.
Result<std::shared_ptr<const SurfaceAnalysis>> analyse(const Heightfield& heightfield,
                                                       JobMonitor& monitor);

} // namespace marsview
