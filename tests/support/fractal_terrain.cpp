#include "tests/support/fractal_terrain.h"

#include <algorithm>
#include <cmath>

namespace marsview::test {
namespace {

// In [-1, 1): the finaliser of splitmix64 over the lattice point.
double latticeValue(std::uint64_t seed, std::uint64_t octave, std::uint64_t c, std::uint64_t r)
{
    std::uint64_t x = seed + 0x9e3779b97f4a7c15U * (octave * 0x100000001U + (c << 32U) + r + 1U);
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    x ^= x >> 31U;
    return static_cast<double>(x >> 11U) * 0x1p-52 - 1.0;
}

double smooth(double x)
{
    return x * x * (3.0 - 2.0 * x);
}

} // namespace

std::vector<float> fractalHeights(std::size_t columns, std::size_t rows, std::uint64_t seed)
{
    std::vector<double> heights(columns * rows, 0.0);
    constexpr std::uint64_t kOctaves = 11;
    for (std::uint64_t octave = 0; octave < kOctaves; ++octave) {
        const std::size_t period = std::size_t{1} << octave;
        if (period > std::max(columns, rows)) {
            break;
        }
        const auto width = static_cast<double>(period);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t r = row / period;
            const double v = smooth(static_cast<double>(row % period) / width);
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t c = column / period;
                const double u = smooth(static_cast<double>(column % period) / width);
                const double upper = (1.0 - u) * latticeValue(seed, octave, c, r) +
                                     u * latticeValue(seed, octave, c + 1, r);
                const double lower = (1.0 - u) * latticeValue(seed, octave, c, r + 1) +
                                     u * latticeValue(seed, octave, c + 1, r + 1);
                heights[row * columns + column] += width * ((1.0 - v) * upper + v * lower);
            }
        }
    }
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const double z = heights[row * columns + column];
            const double across = heights[row * columns + column + 1] - z;
            const double down = heights[(row + 1) * columns + column] - z;
            sum += across * across + down * down;
            count += 1.0;
        }
    }
    const double scale = 0.3 / std::sqrt(sum / count);
    std::vector<float> scaled(heights.size());
    std::transform(heights.begin(), heights.end(), scaled.begin(),
                   [scale](double z) { return static_cast<float>(z * scale); });
    return scaled;
}

} // namespace marsview::test
