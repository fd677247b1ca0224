#include "ui/render/cover_texture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSideMax = 2048;

// Of a square of samples: 255 if so, and 0 otherwise.
struct Squares {
    std::size_t samples = 1; // along a side
    std::size_t columns = 1;
    std::size_t rows = 1;
    std::vector<std::uint8_t> are_valid{255};  // all samples
    std::vector<std::uint8_t> have_valid{255}; // any sample

    Squares() = default;
    Squares(std::size_t side, std::size_t column_count, std::size_t row_count)
        : samples(side)
        , columns(column_count)
        , rows(row_count)
        , are_valid(columns * rows, 255)
        , have_valid(columns * rows, 255)
    {}
    std::size_t at(std::size_t column, std::size_t row) const { return row * columns + column; }
};

// Levels are squares of whole squares of the first one.
constexpr std::size_t kCoarsest = std::size_t{1} << CoverTexture::kLevelMax;

std::size_t padded(std::size_t count)
{
    return (count + kCoarsest - 1) / kCoarsest * kCoarsest;
}

Squares squaresOf(const Heightfield& heightfield, std::size_t side)
{
    const SampleGrid& samples = heightfield.samples();
    const std::size_t columns = (samples.columns() + side - 1) / side;
    const std::size_t rows = (samples.rows() + side - 1) / side;
    Squares squares(side, padded(columns), padded(rows));
    std::vector<std::uint8_t> have_valid(columns);
    for (std::size_t top = 0; top < samples.rows(); top += side) {
        std::fill(have_valid.begin(), have_valid.end(), std::uint8_t{0});
        const std::size_t first = squares.at(0, top / side);
        for (std::size_t row = top; row < std::min(top + side, samples.rows()); ++row) {
            for (std::size_t column = 0; column < samples.columns(); ++column) {
                if (samples.isVoid(column, row)) {
                    squares.are_valid[first + column / side] = 0;
                } else {
                    have_valid[column / side] = 255;
                }
            }
        }
        std::copy(have_valid.begin(), have_valid.end(),
                  squares.have_valid.begin() + static_cast<std::ptrdiff_t>(first));
    }
    return squares;
}

Squares squaresOf(const BlockMeans& means)
{
    std::size_t level = 0;
    while (std::max(means.means(level).columns(), means.means(level).rows()) > kSideMax) {
        ++level;
    }
    const std::size_t columns = means.means(level).columns();
    const std::size_t rows = means.means(level).rows();
    Squares squares(means.blockSamples() << level, padded(columns), padded(rows));
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const float share = means.share(level, column, row);
            squares.are_valid[squares.at(column, row)] = share < 1.0F ? 0 : 255;
            squares.have_valid[squares.at(column, row)] = share > 0.0F ? 255 : 0;
        }
    }
    return squares;
}

Squares coarser(const Squares& squares)
{
    Squares half(2 * squares.samples, squares.columns / 2, squares.rows / 2);
    for (std::size_t row = 0; row < half.rows; ++row) {
        for (std::size_t column = 0; column < half.columns; ++column) {
            const std::size_t first = squares.at(2 * column, 2 * row);
            const std::size_t below = squares.at(2 * column, 2 * row + 1);
            const auto& all = squares.are_valid;
            const auto& any = squares.have_valid;
            half.are_valid[half.at(column, row)] =
                std::min({all[first], all[first + 1], all[below], all[below + 1]});
            half.have_valid[half.at(column, row)] =
                std::max({any[first], any[first + 1], any[below], any[below + 1]});
        }
    }
    return half;
}

// Texels of the cells between squares: the first one lies before the first square, and those from
// the last square on are like each other.
std::vector<std::uint8_t> cellsOf(const Squares& squares, std::size_t columns, std::size_t rows)
{
    std::vector<std::uint8_t> cells;
    cells.reserve(columns * rows);
    // The least and the most of four rows of squares.
    std::vector<std::uint8_t> all(squares.columns);
    std::vector<std::uint8_t> any(squares.columns);
    const auto square = [](std::size_t cell, std::size_t from_cell, std::size_t count) {
        return std::clamp<std::size_t>(cell + from_cell, 2, count + 1) - 2;
    };
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t first = squares.at(0, square(row, k, squares.rows));
            for (std::size_t i = 0; i < squares.columns; ++i) {
                const std::uint8_t are = squares.are_valid[first + i];
                const std::uint8_t have = squares.have_valid[first + i];
                all[i] = k == 0 ? are : std::min(all[i], are);
                any[i] = k == 0 ? have : std::max(any[i], have);
            }
        }
        const std::uint8_t* const above =
            squares.are_valid.data() + squares.at(0, square(row, 1, squares.rows));
        const std::uint8_t* const below =
            squares.are_valid.data() + squares.at(0, square(row, 2, squares.rows));
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t before = square(column, 0, squares.columns);
            const std::size_t left = square(column, 1, squares.columns);
            const std::size_t right = square(column, 2, squares.columns);
            const std::size_t after = square(column, 3, squares.columns);
            const bool has_diagonal = above[left] != 0 && below[right] != 0;
            const auto flag = [](bool is_so, CoverTexture::CellBit bit) {
                return is_so ? static_cast<unsigned>(bit) : 0U;
            };
            const unsigned bits =
                flag(has_diagonal && above[right] != 0, CoverTexture::UpperTriangle) |
                flag(has_diagonal && below[left] != 0, CoverTexture::LowerTriangle) |
                flag(std::min({all[before], all[left], all[right], all[after]}) != 0,
                     CoverTexture::Surrounded) |
                flag(std::max({any[before], any[left], any[right], any[after]}) == 0,
                     CoverTexture::Bare);
            cells.push_back(static_cast<std::uint8_t>(bits));
        }
    }
    return cells;
}

} // namespace

CoverTexture::CoverTexture(const Heightfield& heightfield, const BlockMeans& means)
{
    Squares squares;
    std::size_t more = 1; // cells than squares along a side
    if (heightfield.hasVoids()) {
        const std::size_t side = std::max(heightfield.columns(), heightfield.rows());
        const bool is_small = !heightfield.isTiled() && side <= 2 * kSideMax;
        squares = is_small ? squaresOf(heightfield, side <= kSideMax ? 1 : 2) : squaresOf(means);
        more = kCoarsest;
        const auto width = static_cast<double>((squares.columns + more) * squares.samples);
        const auto height = static_cast<double>((squares.rows + more) * squares.samples);
        placement_ = {.column_scale = static_cast<double>(heightfield.columns() - 1) / width,
                      .row_scale = static_cast<double>(heightfield.rows() - 1) / height,
                      .column_offset = 0.5 / width,
                      .row_offset = 0.5 / height,
                      .square_samples = static_cast<double>(squares.samples),
                      .level_max = kLevelMax,
                      .has_voids = true};
    }
    bind(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0;; ++level) {
        const std::size_t columns = squares.columns + (more >> level);
        const std::size_t rows = squares.rows + (more >> level);
        const std::vector<std::uint8_t> cells = cellsOf(squares, columns, rows);
        glTexImage2D(GL_TEXTURE_2D, level, GL_R8UI, static_cast<GLsizei>(columns),
                     static_cast<GLsizei>(rows), 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, cells.data());
        if (level == placement_.level_max) {
            break;
        }
        squares = coarser(squares);
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
