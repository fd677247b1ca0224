// Opens a map of any size by its name: in memory, or in tiles.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/decimated_read.h"
#include "core/raster/open_raster.h"
#include "core/session/map.h"
#include "core/session/map_resources.h"

#include <memory>

namespace marsview {

/// How to open a map that is too large for memory and has no overviews.
enum class WithoutOverviews {
    Build,   // they are built, which takes minutes
    Preview, // a preview is returned
};

struct OpenMapOptions {
    WithoutOverviews without_overviews = WithoutOverviews::Build;
    DecimationLimits preview{};
    /// Whether the samples are read into memory even if they could be read in tiles.
    bool is_in_memory = false;
};

/// Opens a map, ready to be shown and touched. Prepared files that turn out to be damaged are
/// removed, and the map is opened without them. Errors begin with the path and say what to do;
/// Canceled when `monitor` is. Blocks on the disk: not for the GUI thread.
Result<std::shared_ptr<const Map>> openMap(const RasterSpec& spec,
                                           const MapResources& resources,
                                           JobMonitor& monitor,
                                           const OpenMapOptions& options = {});

/// Builds the overviews of a map in the folder of prepared maps, making room there. Resumes a build
/// that was stopped. On all cores; the source is read once and never written to.
Status buildOverviews(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor);

} // namespace marsview
