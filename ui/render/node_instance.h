// The attributes of a node for the vertex shader.
#pragma once

#include "core/geo/frames.h"
#include "core/view/detail_selection.h"
#include "ui/render/height_atlas.h"
#include "ui/render/relief_cache.h"

#include <array>

namespace marsview {

/// What one instance of the node mesh is drawn with; see TerrainAttribute.
struct NodeInstance {
    std::array<float, 3> place;
    std::array<float, 4> slot;
    std::array<float, 4> relief;
    std::array<float, 2> uncle;
    CornerRanges parent;
    CornerRanges grandparent;
    std::array<float, 3> color_heights;
};

/// `anchor` is the sample that positions are relative to, `base_m` the height that heights are.
NodeInstance nodeInstance(const SelectedNode& selected,
                          const GridPoint& anchor,
                          double base_m,
                          const HeightAtlas::Place& heights,
                          const ReliefCache::Found& relief);

/// The sample nearest to the eye.
GridPoint nodeAnchor(const GridPoint& eye, std::size_t columns, std::size_t rows);

/// Makes the bound vertex array read instances from the bound array buffer.
void describeNodeInstances();

} // namespace marsview
