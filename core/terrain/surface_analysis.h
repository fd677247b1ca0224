// The analysis of a whole map, computed once.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/block_means.h"
#include "core/terrain/detail_errors.h"
#include "core/terrain/min_max_pyramid.h"

#include <memory>

namespace marsview {

/// The data that ray casts, contact models and drawing use to skip parts of a surface. Immutable;
/// any thread.
struct SurfaceAnalysis {
    MinMaxPyramid bounds;
    BlockMeans means;
    DetailErrors errors;
};

/// Reads every sample a few times, on all cores: not for the GUI thread. The only error is
/// Canceled.
Result<std::shared_ptr<const SurfaceAnalysis>> analyze(const Heightfield& heightfield,
                                                       JobMonitor& monitor);

} // namespace marsview
