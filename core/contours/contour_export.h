// Contour lines of a whole raster as a vector file.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/raster/open_raster.h"

#include <cstddef>
#include <string>

namespace marsview {

struct ContourJob {
    RasterSpec raster{};
    double interval_m = 0.0; // > 0
    double base_m = 0.0;     // an elevation that has a contour
    std::string path{};      // of the result: .gpkg or .shp
};

struct ContourReport {
    std::size_t lines = 0;
};

/// Writes the contours of all samples, at full resolution: lines in the raster's CRS with the
/// fields "id" and "elevation" (meters). They run between sample centers and end at voids. The
/// raster is read once, row by row, with its overrides, so memory does not depend on its size.
///
/// An existing file is replaced when the new one is complete. Errors name the path: Unsupported for
/// other formats,
/// Unreadable, Canceled. Blocks on the disk: not for the GUI thread.
Result<ContourReport> exportContours(const ContourJob& job, JobMonitor& monitor);

} // namespace marsview
