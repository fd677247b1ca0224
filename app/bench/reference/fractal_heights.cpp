#include "app/bench/reference/fractal_heights.h"

#include "core/base/check.h"
#include "core/base/split_mix.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr std::uint64_t kOctaves = 11;
constexpr double kSlope = 0.3;

// A value in [-1, 1) for a point of the lattice.
double latticeValue(std::uint64_t seed, std::uint64_t octave, std::uint64_t c, std::uint64_t r)
{
    const std::uint64_t x =
        splitMix(seed + kSplitMixStep * (octave * 0x100000001U + (c << 32U) + r + 1U));
    return static_cast<double>(x >> 11U) * 0x1p-52 - 1.0;
}

double smooth(double x)
{
    return x * x * (3.0 - 2.0 * x);
}

} // namespace

FractalHeights::FractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed)
    : columns_(columns)
    , rows_(rows)
    , seed_(seed)
{
    MARSVIEW_CHECK(columns >= 2 && rows >= 2);
    std::vector<double> upper(columns);
    std::vector<double> lower(columns);
    unscaledRow(0, upper);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        unscaledRow(row + 1, lower);
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const double across = upper[column + 1] - upper[column];
            const double down = lower[column] - upper[column];
            sum += across * across + down * down;
            count += 1.0;
        }
        upper.swap(lower);
    }
    scale_ = kSlope / std::sqrt(sum / count);
}

void FractalHeights::unscaledRow(std::size_t row, std::span<double> heights) const
{
    std::fill(heights.begin(), heights.end(), 0.0);
    std::vector<double> across; // position of a column within its lattice cell
    for (std::uint64_t octave = 0; octave < kOctaves; ++octave) {
        const std::size_t period = std::size_t{1} << octave;
        if (period > std::max(columns_, rows_)) {
            break;
        }
        const auto width = static_cast<double>(period);
        const std::size_t r = row / period;
        const double v = smooth(static_cast<double>(row % period) / width);
        across.resize(period);
        for (std::size_t i = 0; i < period; ++i) {
            across[i] = smooth(static_cast<double>(i) / width);
        }
        double upper_left = latticeValue(seed_, octave, 0, r);
        double lower_left = latticeValue(seed_, octave, 0, r + 1);
        for (std::size_t begin = 0; begin < columns_; begin += period) {
            const std::size_t c = begin / period;
            const double upper_right = latticeValue(seed_, octave, c + 1, r);
            const double lower_right = latticeValue(seed_, octave, c + 1, r + 1);
            const std::size_t count = std::min(period, columns_ - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const double u = across[i];
                const double upper = (1.0 - u) * upper_left + u * upper_right;
                const double lower = (1.0 - u) * lower_left + u * lower_right;
                heights[begin + i] += width * ((1.0 - v) * upper + v * lower);
            }
            upper_left = upper_right;
            lower_left = lower_right;
        }
    }
}

void FractalHeights::row(std::size_t row, std::span<double> heights) const
{
    MARSVIEW_CHECK(row < rows_ && heights.size() == columns_);
    unscaledRow(row, heights);
    for (double& height : heights) {
        height *= scale_;
    }
}

std::vector<float> fractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed)
{
    const FractalHeights fractal(columns, rows, seed);
    std::vector<float> heights(columns * rows);
    std::vector<double> line(columns);
    for (std::size_t row = 0; row < rows; ++row) {
        fractal.row(row, line);
        std::transform(line.begin(), line.end(),
                       heights.begin() + static_cast<std::ptrdiff_t>(row * columns),
                       [](double z) { return static_cast<float>(z); });
    }
    return heights;
}

} // namespace marsview
