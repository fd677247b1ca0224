// Draws the walls of the nodes of a map on its body.
#pragma once

#include "core/globe/map_walls.h"
#include "ui/render/node_instance.h"
#include "ui/render/opengl/gl_objects.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// Collects walls of nodes, and draws them at once.
class WallDrawing {
public:
    WallDrawing();

    bool isEmpty() const noexcept { return corners_.empty(); }
    /// `quadrants` are those of the node that are drawn.
    void add(const NodeInstance& node, const MapWalls::NodeWalls& walls, std::uint8_t quadrants);
    /// With the program in use. Forgets them.
    void draw();

private:
    struct Piece {
        NodeInstance node;
        std::size_t corner = 0; // its first one
        std::size_t index = 0;  // likewise, of its triangles
    };

    GlVertexArray array_;
    GlBuffer buffer_;
    GlBuffer index_buffer_;
    std::vector<WallCorner> corners_;
    std::vector<std::uint16_t> indices_;
    std::vector<Piece> pieces_;
};

} // namespace marsview
