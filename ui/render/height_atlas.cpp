#include "ui/render/height_atlas.h"

namespace marsview {
HeightAtlas::HeightAtlas(std::size_t slot_columns, std::size_t slot_rows)
    : slots_(slot_columns, slot_rows)
{
    bind(GL_TEXTURE0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, static_cast<GLsizei>(slot_columns * kNodeSide),
                 static_cast<GLsizei>(slot_rows * kNodeSide), 0, GL_RED, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

std::optional<HeightAtlas::Place> HeightAtlas::place(const LayerNode& node,
                                                     const DrawnSurface& surface,
                                                     std::uint64_t generation,
                                                     std::vector<TileId>& missing)
{
    return slots_.place(node, {.generation = generation}, missing,
                        [&](const Place& place, std::vector<TileId>& lacking) {
                            const NodeState state = readNode(surface, node.node, heights_, lacking);
                            send(place);
                            return state;
                        });
}

void HeightAtlas::send(const Place& place)
{
    bind(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, static_cast<GLsizei>(kNodeSide),
                    static_cast<GLsizei>(kNodeSide), GL_RED, GL_FLOAT, heights_.data());
}

void HeightAtlas::bind(GLenum unit) const
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
}

} // namespace marsview
