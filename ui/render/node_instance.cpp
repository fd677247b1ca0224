#include "ui/render/node_instance.h"

#include "ui/render/terrain_shaders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <epoxy/gl.h>

namespace marsview {
namespace {

// Fraction of the height-th part of an ancestor in which a node begins.
std::array<float, 2> placeIn(const DetailNode& node, std::size_t levels_up)
{
    const std::size_t parts = std::size_t{1} << levels_up;
    return {static_cast<float>(node.column % parts) / static_cast<float>(parts),
            static_cast<float>(node.row % parts) / static_cast<float>(parts)};
}

} // namespace

NodeInstance nodeInstance(const SelectedNode& selected,
                          const GridPoint& anchor,
                          double base_m,
                          const HeightAtlas::Place& heights,
                          const ReliefCache::Found& relief)
{
    constexpr auto kCells = static_cast<double>(DetailErrors::kNodeCells);
    const DetailNode& node = selected.node;
    const double step = static_cast<double>(std::size_t{1} << node.level);
    const double first_column = static_cast<double>(node.column) * kCells * step;
    const double first_row = static_cast<double>(node.row) * kCells * step;
    NodeInstance instance{};
    instance.place = {static_cast<float>(first_column - anchor.column),
                      static_cast<float>(first_row - anchor.row), static_cast<float>(step)};
    const auto in_parent = placeIn(node, 1);
    instance.slot = {static_cast<float>(heights.x), static_cast<float>(heights.y), in_parent[0],
                     in_parent[1]};
    instance.uncle = placeIn(node, 2);
    instance.parent = selected.parent_ranges_m;
    instance.grandparent = selected.grandparent_ranges_m;
    // Texture coordinates of a sample: its texel, counted from the border's first.
    const ReliefTileId tile = reliefTileOf(relief.node);
    const double texel = static_cast<double>(std::size_t{1} << tile.level);
    const double side = static_cast<double>(ReliefTile::kSide);
    const auto coordinate = [&](double sample, std::size_t tile_index) {
        const double first = static_cast<double>(tile_index * ReliefTile::kTexels) * texel;
        return static_cast<float>(
            ((sample - first + 0.5) / texel + static_cast<double>(ReliefTile::kBorder)) / side);
    };
    // The fraction marks a texel a sample, see the shader.
    instance.relief = {static_cast<float>(1.0 / (texel * side)),
                       coordinate(first_column, tile.column), coordinate(first_row, tile.row),
                       static_cast<float>(relief.layer) + (tile.level == 0 ? 0.25F : 0.0F)};
    // While a larger relief replaces it, the mesh has more detail wherever its cells are smaller.
    const bool is_mesh_finer = relief.node.level != selected.relief.level && step < texel;
    instance.color_heights = {static_cast<float>(relief.height_reach_m),
                              static_cast<float>(relief.height_middle_m - base_m),
                              is_mesh_finer ? 1.0F : 0.0F};
    return instance;
}

GridPoint nodeAnchor(const GridPoint& eye, std::size_t columns, std::size_t rows)
{
    return {std::clamp(std::floor(eye.column), 0.0, static_cast<double>(columns - 1)),
            std::clamp(std::floor(eye.row), 0.0, static_cast<double>(rows - 1))};
}

void describeNodeInstances()
{
    const auto attribute = [](GLuint location, GLint count, std::size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(NodeInstance),
                              reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's way
        glVertexAttribDivisor(location, 1);
    };
    attribute(kPlaceAttribute, 3, offsetof(NodeInstance, place));
    attribute(kSlotAttribute, 4, offsetof(NodeInstance, slot));
    attribute(kReliefAttribute, 4, offsetof(NodeInstance, relief));
    attribute(kUncleAttribute, 2, offsetof(NodeInstance, uncle));
    attribute(kParentAttribute, 4, offsetof(NodeInstance, parent));
    attribute(kGrandparentAttribute, 4, offsetof(NodeInstance, grandparent));
    attribute(kColorHeightsAttribute, 3, offsetof(NodeInstance, color_heights));
}

} // namespace marsview
