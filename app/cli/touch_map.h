// What commands that touch have in common: a map as contact models want it.
#pragma once

#include "app/cli/map_options.h"
#include "core/base/job_monitor.h"
#include "core/session/dataset.h"
#include "core/terrain/filled_heightfield.h"

#include <memory>

namespace marsview {

/// A map that can be touched.
struct TouchMap {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    std::shared_ptr<const FilledHeightfield> filled;
};

/// Reads the map whole and measures what casts skip by.
Result<TouchMap> openTouchMap(const MapOptions& options, JobMonitor& monitor);

} // namespace marsview
