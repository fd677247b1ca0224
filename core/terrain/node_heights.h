// The heights that a node of the quadtree is drawn with.
#pragma once

#include "core/terrain/detail_errors.h"
#include "core/terrain/drawn_surface.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

/// Samples along a side of a node.
inline constexpr std::size_t kNodeSide = DetailErrors::kNodeCells + 1;

/// Whether the heights are those of the node's level or still of coarser levels.
enum class NodeState { Complete, Coarser };

/// The heights of a node's samples in meters over the surface's base, row by row; beyond the map
/// those of its last column and row. For a tiled map, missing tiles are added to `missing`, coarser
/// ones first. A sample has the same height in every node as long as no tile is loaded or evicted,
/// so there are no cracks between nodes.
NodeState readNode(const DrawnSurface& surface,
                   const DetailNode& node,
                   std::span<float, kNodeSide * kNodeSide> heights,
                   std::vector<TileId>& missing);

} // namespace marsview
