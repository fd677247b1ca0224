// Draws the walls of the nodes of a map on its body.
#pragma once

#include "core/globe/map_walls.h"
#include "ui/render/gl_objects.h"
#include "ui/render/node_instance.h"

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
        std::size_t begin = 0; // of its corners
    };

    GlVertexArray array_;
    GlBuffer buffer_;
    std::vector<WallCorner> corners_;
    std::vector<Piece> pieces_;
};

} // namespace marsview
