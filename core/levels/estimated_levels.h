// What can be known of a whole map from its overviews alone: enough to draw it and to skip most of
// it, for maps at a server that have no level file beside them.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/levels/level_file.h"
#include "core/raster/raster_info.h"
#include "core/tiles/tile_source.h"

#include <cstddef>

namespace marsview {

/// Overviews of up to so many means are read, half a megabyte to two of a compressed map.
inline constexpr std::size_t kEstimateMeansMax = std::size_t{1} << 20;

/// Reads one level of Means of `source` and five tiles at full resolution, and estimates what a
/// level file would tell. Exact, from the samples, where the source has no Means and is that small
/// itself; TooLarge where it has no level of Means of at most `means_max`.
///
///  - means: those of the overview;
///  - bounds: the lowest and highest mean around each node, widened by how much means differ there;
///    two to four times as wide as need be. On maps of the Moon, Mars and the Earth and on fractals
///    at most one sample in 3000 lies outside; a ray may miss such a peak, but what is touched may
///    not: casts of the hand skip nothing;
///  - errors: measured between the coarse levels and in the tiles, by a power law between these. On
///    the same maps the middle node of every level has 0.5 to 1.3 times its true error, nine of ten
///    between a quarter and twice (the ocean floor excepted);
///  - statistics: from all of these.
///
/// Waits for the source: not for the GUI thread. What the source says when it fails, Cancelled.
Result<MapLevels> estimateLevels(const TileSource& source,
                                 const ElevationScale& scale,
                                 JobMonitor& monitor,
                                 std::size_t means_max = kEstimateMeansMax);

} // namespace marsview
