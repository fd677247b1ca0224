// The default elevation range of color ramps.
#pragma once

#include "core/terrain/block_means.h"

#include <optional>
#include <vector>

namespace marsview {

/// The range of a map's elevations without the extreme 0.5 % at either end, so that one volcano
/// does not take half of the colors. `all` is the map's whole range, and the result for fewer than
/// 400 blocks or if a single elevation would remain.
HeightRange tintRange(const BlockMeans& means, const HeightRange& all);

/// The mean elevations of at most a million blocks that cover the map, in meters, without nodata.
std::vector<float> blockHeights(const BlockMeans& means);

/// From the value with rank floor(n · share) from below to the one with that rank from above, of n
/// values; share in [0, 0.5). Empty without values and if the two are equal.
std::optional<HeightRange> rangeWithoutRarest(std::vector<float> heights_m, double share);

} // namespace marsview
