// A first look at a raster that is too large for memory and has no overviews yet.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/decimated_read.h"
#include "core/raster/open_raster.h"
#include "core/session/map.h"

#include <memory>

namespace marsview {

/// A map of some of the raster's samples, in memory: from an overview of the file, or picked from
/// as many of its blocks as there is time for. Elevations of it are approximate. Blocks on the
/// disk: not for the GUI thread.
Result<std::shared_ptr<const Map>>
readPreview(OpenRaster raster, const DecimationLimits& limits, JobMonitor& monitor);
/// The same, of a raster that is not open yet.
Result<std::shared_ptr<const Map>>
readPreview(const RasterSpec& spec, const DecimationLimits& limits, JobMonitor& monitor);

} // namespace marsview
