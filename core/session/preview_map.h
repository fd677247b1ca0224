// A map to look at until the map itself is ready.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/decimated_read.h"
#include "core/session/loaded_map.h"

namespace marsview {

/// A smaller map of the same ground, held in memory, with the placement, body, unit and overrides
/// of the whole one: see DatasetKind and readDecimated(). Refuses what the whole map would be
/// refused for, as far as it can be told from these samples: fewer than 2 × 2 samples, and, as
/// Invalid, nothing but voids. Blocks on the disk: not for the GUI thread.
Result<LoadedMap>
readPreview(const DatasetSpec& spec, const DecimationLimits& limits, JobMonitor& monitor);

} // namespace marsview
