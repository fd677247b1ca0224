// The heights over which colours are spread.
#pragma once

#include "core/terrain/block_means.h"

namespace marsview {

/// The range of a map's heights without the rarest half percent at either end, so that one volcano
/// does not take half of the colours. `all` is the map's whole range, and the result where there is
/// too little to count or nothing but one height is left.
HeightRange tintRange(const BlockMeans& means, const HeightRange& all);

} // namespace marsview
