#include "ui/render/height_atlas.h"

#include <algorithm>

namespace marsview {
namespace {

constexpr std::size_t kSide = DetailErrors::kNodeCells + 1;

} // namespace

HeightAtlas::HeightAtlas(std::size_t slot_columns, std::size_t slot_rows)
    : slots_(slot_columns * slot_rows)
    , slot_columns_(slot_columns)
    , heights_(kSide * kSide)
{
    bind(GL_TEXTURE0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, static_cast<GLsizei>(slot_columns * kSide),
                 static_cast<GLsizei>(slot_rows * kSide), 0, GL_RED, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

std::optional<HeightAtlas::Place> HeightAtlas::place(const LayerNode& node,
                                                     const DrawnSurface& surface)
{
    std::optional<std::size_t> slot = slots_.find(node);
    const bool is_known = slot.has_value();
    if (!is_known) {
        slot = slots_.assign(node);
        if (!slot) {
            return std::nullopt;
        }
    }
    const Place place{static_cast<int>(*slot % slot_columns_ * kSide),
                      static_cast<int>(*slot / slot_columns_ * kSide)};
    if (is_known) {
        return place;
    }
    const std::size_t step = std::size_t{1} << node.node.level;
    const std::size_t first_column = node.node.column * DetailErrors::kNodeCells * step;
    const std::size_t first_row = node.node.row * DetailErrors::kNodeCells * step;
    const std::size_t last_column = surface.heightfield().columns() - 1;
    const std::size_t last_row = surface.heightfield().rows() - 1;
    for (std::size_t j = 0; j < kSide; ++j) {
        const std::size_t row = std::min(first_row + j * step, last_row);
        for (std::size_t i = 0; i < kSide; ++i) {
            heights_[j * kSide + i] =
                surface.height(std::min(first_column + i * step, last_column), row);
        }
    }
    bind(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, static_cast<GLsizei>(kSide),
                    static_cast<GLsizei>(kSide), GL_RED, GL_FLOAT, heights_.data());
    return place;
}

void HeightAtlas::bind(GLenum unit) const
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
}

} // namespace marsview
