// How many blocks of a map's analysis a tile covers along one side.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/raw_ranges.h"
#include "core/tiles/tile.h"

#include <cstddef>

namespace marsview {

inline constexpr std::size_t kTileBlocks = kTileSide / BlockMeans::kBlock;
inline constexpr std::size_t kTileRanges = kTileSide / RawRanges::kBlock;

} // namespace marsview
