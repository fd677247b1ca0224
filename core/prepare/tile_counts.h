// Rows of level-0 tiles, and how many blocks of a map's analysis a tile covers along one side.
#pragma once

#include "core/terrain/block_means.h"
#include "core/terrain/raw_ranges.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <limits>

namespace marsview {

inline constexpr std::size_t kTileBlocks = kTileSide / BlockMeans::kBlock;
inline constexpr std::size_t kTileRanges = kTileSide / RawRanges::kBlock;

/// Rows of level-0 tiles [first, end); by default, all of a map.
struct TileRowRange {
    std::size_t first = 0;
    std::size_t end = std::numeric_limits<std::size_t>::max();
};

} // namespace marsview
