#include "ui/render/cover_texture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSideMax = 2048;

// Whether all samples of square blocks are valid: 255 if so, and 0 otherwise.
struct Blocks {
    std::size_t samples = 1; // along a side
    std::size_t columns = 1;
    std::size_t rows = 1;
    std::vector<std::uint8_t> are_valid{255};

    static Blocks valid(std::size_t samples, std::size_t columns, std::size_t rows)
    {
        return {samples, columns, rows, std::vector<std::uint8_t>(columns * rows, 255)};
    }
    std::uint8_t& operator()(std::size_t column, std::size_t row)
    {
        return are_valid[row * columns + column];
    }
};

// The columns or rows of a texture whose levels are blocks of whole texels.
std::size_t padded(std::size_t count)
{
    constexpr std::size_t kBlock = std::size_t{1} << CoverTexture::kLevelMax;
    return (count + kBlock - 1) / kBlock * kBlock;
}

Blocks blocksOf(const Heightfield& heightfield, std::size_t side)
{
    const SampleGrid& samples = heightfield.samples();
    Blocks blocks = Blocks::valid(side, padded((samples.columns() + side - 1) / side),
                                  padded((samples.rows() + side - 1) / side));
    for (std::size_t row = 0; row < samples.rows(); ++row) {
        for (std::size_t column = 0; column < samples.columns(); ++column) {
            if (samples.isVoid(column, row)) {
                blocks(column / side, row / side) = 0;
            }
        }
    }
    return blocks;
}

Blocks blocksOf(const BlockMeans& means)
{
    std::size_t level = 0;
    while (std::max(means.means(level).columns(), means.means(level).rows()) > kSideMax) {
        ++level;
    }
    const std::size_t columns = means.means(level).columns();
    const std::size_t rows = means.means(level).rows();
    Blocks blocks = Blocks::valid(means.blockSamples() << level, padded(columns), padded(rows));
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            blocks(column, row) = means.share(level, column, row) < 1.0F ? 0 : 255;
        }
    }
    return blocks;
}

Blocks coarser(Blocks& blocks)
{
    Blocks half = Blocks::valid(2 * blocks.samples, blocks.columns / 2, blocks.rows / 2);
    for (std::size_t row = 0; row < half.rows; ++row) {
        for (std::size_t column = 0; column < half.columns; ++column) {
            half(column, row) =
                std::min({blocks(2 * column, 2 * row), blocks(2 * column + 1, 2 * row),
                          blocks(2 * column, 2 * row + 1), blocks(2 * column + 1, 2 * row + 1)});
        }
    }
    return half;
}

} // namespace

CoverTexture::CoverTexture(const Heightfield& heightfield, const BlockMeans& means)
{
    Blocks blocks;
    if (heightfield.hasVoids()) {
        const std::size_t side = std::max(heightfield.columns(), heightfield.rows());
        const bool is_small = !heightfield.isTiled() && side <= 2 * kSideMax;
        blocks = is_small ? blocksOf(heightfield, side <= kSideMax ? 1 : 2) : blocksOf(means);
        const auto width = static_cast<double>(blocks.columns * blocks.samples);
        const auto height = static_cast<double>(blocks.rows * blocks.samples);
        placement_ = {.column_scale = static_cast<double>(heightfield.columns() - 1) / width,
                      .row_scale = static_cast<double>(heightfield.rows() - 1) / height,
                      .column_offset = 0.5 / width,
                      .row_offset = 0.5 / height,
                      .texel_samples = static_cast<double>(blocks.samples),
                      .level_max = kLevelMax};
    }
    bind(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0;; ++level) {
        glTexImage2D(GL_TEXTURE_2D, level, GL_R8, static_cast<GLsizei>(blocks.columns),
                     static_cast<GLsizei>(blocks.rows), 0, GL_RED, GL_UNSIGNED_BYTE,
                     blocks.are_valid.data());
        if (level == placement_.level_max) {
            break;
        }
        blocks = coarser(blocks);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, placement_.level_max);
}

void CoverTexture::bind(GLenum unit) const
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
}

} // namespace marsview
