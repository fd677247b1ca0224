// Estimates the analysis of a whole map from its overviews: enough to draw it and to skip most of
// it, for maps on a server without a level file.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <cstddef>

namespace marsview {

/// The limit on the means of the overview that is read: 0.5 to 2 MB of a compressed map.
inline constexpr std::size_t kEstimateMeansMax = std::size_t{1} << 20;

/// Reads one level of Means of `source` and five tiles at full resolution, and estimates the
/// content of a level file. Exact, from the samples, if the source has no Means and at most
/// `means_max` samples; TooLarge if it has no level of Means of at most `means_max`.
///
///  - means: from the overview;
///  - bounds: the lowest and highest mean around each node, widened by the differences of means
///    there; two to four times wider than necessary. On maps of the Moon, Mars and the Earth and on
///    fractals at most one sample in 3000 lies outside. A ray may miss such a peak, but haptic
///    casts may not: they skip nothing;
///  - errors: measured between the coarse levels and in the tiles, with a power law between these.
///    On the same maps the median node of every level has 0.5 to 1.3 times its true error, nine of
///    ten between 0.25 and 2 times (except for the ocean floor);
///  - statistics: from all of these.
///
/// Waits for the source: not for the GUI thread. Errors: those of the source, Canceled.
Result<MapLevels> estimateLevels(const TileSource& source,
                                 const ElevationScale& scale,
                                 JobMonitor& monitor,
                                 std::size_t means_max = kEstimateMeansMax);

} // namespace marsview
