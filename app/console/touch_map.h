// What commands that touch have in common: a map as contact models want it.
#pragma once

#include "app/console/map_options.h"
#include "core/base/job_monitor.h"
#include "core/session/dataset.h"
#include "core/session/open_map.h"
#include "core/terrain/filled_heightfield.h"

#include <memory>

namespace marsview {

/// A map that can be touched.
struct TouchMap {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    std::shared_ptr<const FilledHeightfield> filled; // null where the map comes in tiles
    std::shared_ptr<const MapLevels> levels;         // null where it is held
};

/// Whether a map may or has to come in tiles, prepared first where it is not.
enum class TouchStore { Held, HeldOrTiled, Tiled };

/// Reads the map whole and measures what casts skip by, or opens it in tiles.
Result<TouchMap> openTouchMap(const MapOptions& options, TouchStore store, JobMonitor& monitor);

} // namespace marsview
