#include "ui/render/wall_drawing.h"

#include "ui/render/terrain_shaders.h"

#include <epoxy/gl.h>

#include <cstddef>

namespace marsview {

WallDrawing::WallDrawing()
{
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
    const auto attribute = [](GLuint location, GLint count, std::size_t offset) {
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(WallCorner),
                              reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's way
    };
    attribute(kCellAttribute, 4, offsetof(WallCorner, column));
    attribute(kWallEndAttribute, 1, offsetof(WallCorner, is_top));
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void WallDrawing::add(const NodeInstance& node,
                      const MapWalls::NodeWalls& walls,
                      std::uint8_t quadrants)
{
    const std::size_t begin = corners_.size();
    for (std::size_t i = 0; i < kQuadrantCount; ++i) {
        if ((static_cast<unsigned>(quadrants) >> i & 1U) != 0) {
            corners_.insert(corners_.end(), walls.at(i).begin(), walls.at(i).end());
        }
    }
    if (corners_.size() > begin) {
        pieces_.push_back({node, begin});
    }
}

void WallDrawing::draw()
{
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(WallCorner)),
                 corners_.data(), GL_STREAM_DRAW);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const auto& [node, begin] = pieces_[i];
        const std::size_t end = i + 1 < pieces_.size() ? pieces_[i + 1].begin : corners_.size();
        glVertexAttrib3fv(kPlaceAttribute, node.place.data());
        glVertexAttrib4fv(kSlotAttribute, node.slot.data());
        glVertexAttrib4fv(kReliefAttribute, node.relief.data());
        glVertexAttrib2fv(kUncleAttribute, node.uncle.data());
        glVertexAttrib4fv(kParentAttribute, node.parent.data());
        glVertexAttrib4fv(kGrandparentAttribute, node.grandparent.data());
        glVertexAttrib3fv(kColorHeightsAttribute, node.color_heights.data());
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(begin), static_cast<GLsizei>(end - begin));
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    corners_.clear();
    pieces_.clear();
}

} // namespace marsview
