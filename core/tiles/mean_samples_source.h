// Coarser samples of a raster that nobody has prepared, from its overviews.
#pragma once

#include "core/tiles/tile_source.h"

#include <memory>

namespace marsview {

/// Where the finer Samples of a source end that are read as they are; coarser ones are made of
/// Means: sample i of level k is what lies between the means of the blocks around i · 2^k, by
/// bilinear interpolation between their centres. These are about right, cost one to four tiles to
/// read at any level, and are not nested: good to look at until somebody looks closely.
///
/// Voids are where all blocks around are void. Where the source has no Means, all its Samples are
/// read as they are.
std::shared_ptr<const TileSource> samplesFromMeans(std::shared_ptr<const TileSource> source,
                                                   std::size_t exact_levels = 1);

} // namespace marsview
