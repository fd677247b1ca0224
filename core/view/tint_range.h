// The elevations over which colors are spread.
#pragma once

#include "core/terrain/block_means.h"

#include <optional>
#include <vector>

namespace marsview {

/// The range of a map's elevations without the rarest half percent at either end, so that one
/// volcano does not take half of the colors. `all` is the map's whole range, and the result for
/// fewer than 400 blocks and where a single elevation would be left.
HeightRange tintRange(const BlockMeans& means, const HeightRange& all);

/// The mean elevations of at most a million blocks that cover the map, in metres, without nodata.
std::vector<float> blockHeights(const BlockMeans& means);

/// From the value with rank floor(n · share) from below to the one with that rank from above, of n
/// values; share in [0, 0.5). Nothing without values and where the two are equal.
std::optional<HeightRange> rangeWithoutRarest(std::vector<float> heights_m, double share);

} // namespace marsview
