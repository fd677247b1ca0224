#include "ui/render/wall_drawing.h"

#include "ui/render/terrain_shaders.h"

#include <cstddef>
#include <epoxy/gl.h>

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
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void WallDrawing::add(const NodeInstance& node,
                      const MapWalls::NodeWalls& walls,
                      std::uint8_t quadrants)
{
    for (std::size_t i = 0; i < kQuadrantCount; ++i) {
        const MapWalls::Walls& of = walls.at(i);
        if ((static_cast<unsigned>(quadrants) >> i & 1U) == 0 || of.triangles.empty()) {
            continue;
        }
        pieces_.push_back({node, corners_.size(), indices_.size()});
        corners_.insert(corners_.end(), of.corners.begin(), of.corners.end());
        indices_.insert(indices_.end(), of.triangles.begin(), of.triangles.end());
    }
}

void WallDrawing::draw()
{
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(WallCorner)),
                 corners_.data(), GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices_.size() * sizeof(std::uint16_t)), indices_.data(),
                 GL_STREAM_DRAW);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const auto& [node, corner, index] = pieces_[i];
        const std::size_t end = i + 1 < pieces_.size() ? pieces_[i + 1].index : indices_.size();
        glVertexAttrib3fv(kPlaceAttribute, node.place.data());
        glVertexAttrib4fv(kSlotAttribute, node.slot.data());
        glVertexAttrib4fv(kReliefAttribute, node.relief.data());
        glVertexAttrib2fv(kUncleAttribute, node.uncle.data());
        glVertexAttrib4fv(kParentAttribute, node.parent.data());
        glVertexAttrib4fv(kGrandparentAttribute, node.grandparent.data());
        glVertexAttrib3fv(kColorHeightsAttribute, node.color_heights.data());
        glDrawElementsBaseVertex(
            GL_TRIANGLES, static_cast<GLsizei>(end - index), GL_UNSIGNED_SHORT,
            reinterpret_cast<const void*>(index * sizeof(std::uint16_t)), // NOLINT: OpenGL's way
            static_cast<GLint>(corner));
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    corners_.clear();
    indices_.clear();
    pieces_.clear();
}

} // namespace marsview
