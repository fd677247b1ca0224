// Coarse samples of an unprepared raster, computed from its overviews.
#pragma once

#include "core/tiles/tile_source.h"

#include <memory>

namespace marsview {

/// The first `exact_levels` levels of Samples are read from the source unchanged. Coarser Samples
/// are computed from Means: sample i of level k is interpolated at i · 2^k, bilinearly between the
/// centers of the blocks around it. They are approximate, cost one to four tiles to read at any
/// level, and are not nested: sufficient for display until exact values are needed.
///
/// A sample is void if all blocks around it are void. If the source has no Means, all its Samples
/// are read unchanged.
std::shared_ptr<const TileSource> samplesFromMeans(std::shared_ptr<const TileSource> source,
                                                   std::size_t exact_levels = 1);

} // namespace marsview
