#include "ui/render/cover_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSideMax = 1024;

} // namespace

CoverTexture::CoverTexture(const Heightfield& heightfield, const BlockMeans& means)
{
    std::size_t level = 0;
    std::size_t columns = 1;
    std::size_t rows = 1;
    if (heightfield.hasVoids()) {
        while (std::max(means.means(level).columns(), means.means(level).rows()) > kSideMax) {
            ++level;
        }
        columns = means.means(level).columns();
        rows = means.means(level).rows();
        // Texels are blocks, and the last ones may reach beyond the last samples.
        const auto block = static_cast<double>(means.blockSamples() << level);
        const double width = static_cast<double>(columns) * block; // samples
        const double height = static_cast<double>(rows) * block;
        placement_ = {.column_scale = static_cast<double>(heightfield.columns() - 1) / width,
                      .row_scale = static_cast<double>(heightfield.rows() - 1) / height,
                      .column_offset = 0.5 / width,
                      .row_offset = 0.5 / height};
    }
    std::vector<std::uint8_t> shares(columns * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            shares[row * columns + column] =
                static_cast<std::uint8_t>(std::lround(255.0F * means.share(level, column, row)));
        }
    }
    bind(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, static_cast<GLsizei>(columns), static_cast<GLsizei>(rows),
                 0, GL_RED, GL_UNSIGNED_BYTE, shares.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void CoverTexture::bind(GLenum unit) const
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
}

} // namespace marsview
