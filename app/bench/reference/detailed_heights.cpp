#include "app/bench/reference/detailed_heights.h"

#include "core/base/check.h"
#include "core/base/split_mix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Noise is a sum of octaves. Octave k assigns a random number to every point of a lattice of 2^k
// samples and interpolates them with a cubic B-spline. Such a spline is also a spline over the
// lattice of half the width, whose numbers are fixed weighted sums of the wider lattice's numbers.
// So all octaves are summed starting with the widest: subdivide, add the octave's own numbers,
// subdivide, and so on. A sample costs little more than that of the last octave alone.
//
// A height depends only on +, -, ×, ÷ and square roots of single numbers, which are rounded the
// same way on every machine; no sum depends on the window.

namespace marsview {
namespace {

// Side of the blocks that are computed at once: their buffers fit into the second-level cache.
constexpr std::size_t kBlockSide = 256;

// Squares of halvingRatio() outside this range are clamped: natural terrain has Hurst exponents of
// 0.5 to 0.95, and at 1 (0.25) noise of ever wider octaves would be needed for the differences.
constexpr double kHalvingLeast = 0.268;
constexpr double kHalvingMost = 0.5;

// The values that are constant along a row of an octave's lattice.
struct RowKey {
    std::uint32_t before = 0;
    std::uint32_t within = 0;
};

RowKey rowKey(std::uint64_t seed, std::size_t octave, std::int64_t row)
{
    const std::uint64_t key = splitMix(splitMix(seed + kSplitMixStep * (octave + 1)) +
                                       kSplitMixStep * static_cast<std::uint64_t>(row));
    return {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)};
}

// A value in [-1, 1), of variance 1/3.
float latticeValue(const RowKey& key, std::uint32_t column)
{
    std::uint32_t x = (column * 0x9e3779b1U) ^ key.before;
    x ^= x >> 16U;
    x *= 0x21f0aaadU;
    x += key.within;
    x ^= x >> 15U;
    x *= 0x735a2d97U;
    x ^= x >> 15U;
    return static_cast<float>(static_cast<std::int32_t>(x)) * 0x1p-31F;
}

// The centered cardinal B-spline of `degree`, by its recursion.
double bSpline(int degree, double x)
{
    const double half = (degree + 1) / 2.0;
    if (degree == 0) {
        return x >= -half && x < half ? 1.0 : 0.0;
    }
    return ((half + x) * bSpline(degree - 1, x + 0.5) + (half - x) * bSpline(degree - 1, x - 0.5)) /
           degree;
}

// The mean square of the differences over a distance along one axis, in lattice steps, of a spline
// over independent numbers of variance 1/3: cubic B-splines correlate as the one of degree 7.
double squaredDifference(double distance)
{
    const double still = bSpline(7, 0.0);
    return 2.0 / 3.0 * still * (still - bSpline(7, std::min(distance, 4.0)));
}

// Four polynomial coefficients in the fraction, for the values before, at, after and beyond.
using Cubic = std::array<float, 4>;

Cubic catmullRom(float a, float b, float c, float d)
{
    return {b, 0.5F * (c - a), a - 2.5F * b + 2.0F * c - 0.5F * d, 0.5F * (d - a) + 1.5F * (b - c)};
}

Cubic cubicBSpline(float a, float b, float c, float d)
{
    constexpr float kSixth = 1.0F / 6.0F;
    return {kSixth * (a + 4.0F * b + c), 0.5F * (c - a), 0.5F * (a - 2.0F * b + c),
            kSixth * (d - a) + 0.5F * (b - c)};
}

float at(const Cubic& cubic, float t)
{
    return ((cubic[3] * t + cubic[2]) * t + cubic[1]) * t + cubic[0];
}

std::int64_t half(std::int64_t x)
{
    return x >> 1;
}

std::size_t wrapped(std::int64_t i, std::size_t count)
{
    const auto n = static_cast<std::int64_t>(count);
    return static_cast<std::size_t>(((i % n) + n) % n);
}

std::size_t clamped(std::int64_t i, std::size_t count)
{
    return static_cast<std::size_t>(
        std::clamp(i, std::int64_t{0}, static_cast<std::int64_t>(count) - 1));
}

// A rectangle of lattice points, which may begin before the map.
struct Lattice {
    std::int64_t column = 0;
    std::int64_t row = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;

    // The part of the lattice twice as wide that this one depends on.
    Lattice wider() const
    {
        const std::int64_t c = half(column) - 1;
        const std::int64_t r = half(row) - 1;
        const std::int64_t c_end = half(column + static_cast<std::int64_t>(columns) - 1) + 2;
        const std::int64_t r_end = half(row + static_cast<std::int64_t>(rows) - 1) + 2;
        return {c, r, static_cast<std::size_t>(c_end - c), static_cast<std::size_t>(r_end - r)};
    }
};

// Doubles the density of a row of the wider lattice. `from` begins at lattice column `wide`.
void expandRow(const float* from, std::int64_t wide, std::int64_t column, std::span<float> to)
{
    // Odd columns lie between two numbers, even ones at one.
    std::size_t i = 0;
    const float* p = from + (half(column) - wide);
    if ((column & 1) != 0) {
        to[i++] = 0.5F * (p[0] + p[1]);
        ++p;
    }
    const std::size_t pairs = (to.size() - i) / 2;
    float* out = to.data() + i;
    for (std::size_t k = 0; k < pairs; ++k) {
        out[2 * k] = 0.125F * (p[k - 1] + p[k + 1]) + 0.75F * p[k];
        out[2 * k + 1] = 0.5F * (p[k] + p[k + 1]);
    }
    if (i + 2 * pairs < to.size()) {
        p += pairs;
        to.back() = 0.125F * (p[-1] + p[1]) + 0.75F * p[0];
    }
}

} // namespace

// The buffers of a thread.
struct DetailedHeights::Block {
    std::vector<float> values; // finally the noise, row by row
    std::vector<float> wide;
    std::vector<float> expanded;
};

DetailedHeights::Axis DetailedHeights::axisOf(std::size_t count, std::size_t source_count)
{
    Axis axis;
    axis.index.resize(count);
    axis.fraction.resize(count);
    const double ratio = static_cast<double>(source_count) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Pixel centers, over the same extent.
        const double place = (static_cast<double>(i) + 0.5) * ratio - 0.5;
        const double before = std::floor(place);
        axis.index[i] = static_cast<std::int32_t>(before);
        axis.fraction[i] = static_cast<float>(place - before);
    }
    return axis;
}

DetailedHeights::DetailedHeights(GridView<const float> heights_m,
                                 const DetailedHeightsOptions& options)
    : source_columns_(heights_m.columns())
    , source_rows_(heights_m.rows())
    , seed_(options.seed)
    , wraps_around_(options.wraps_around)
    , across_(axisOf(options.columns, heights_m.columns()))
    , down_(axisOf(options.rows, heights_m.rows()))
{
    MARSVIEW_CHECK(options.columns >= 2 && options.rows >= 2);
    MARSVIEW_CHECK(heights_m.columns() >= 4 && heights_m.rows() >= 4);
    source_m_.reserve(source_columns_ * source_rows_);
    for (std::size_t r = 0; r < source_rows_; ++r) {
        const std::span<const float> row = heights_m.row(r);
        source_m_.insert(source_m_.end(), row.begin(), row.end());
    }
    measure();
}

void DetailedHeights::measure()
{
    const std::size_t columns = source_columns_;
    const auto height = [&](std::size_t c, std::size_t r) {
        return static_cast<double>(source_m_[r * columns + c]);
    };
    // Along columns only: rows get shorter toward the poles of a geographic map.
    double over_one = 0.0;
    double over_two = 0.0;
    std::vector<double> bends(columns * source_rows_); // squares of second differences
    for (std::size_t r = 1; r + 1 < source_rows_; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            const double above = height(c, r - 1);
            const double here = height(c, r);
            const double below = height(c, r + 1);
            over_one += (below - here) * (below - here);
            over_two += (below - above) * (below - above);
            const double bend = above - 2.0 * here + below;
            bends[r * columns + c] = bend * bend;
        }
    }
    for (std::size_t c = 0; c < columns; ++c) {
        bends[c] = bends[columns + c];
        bends[(source_rows_ - 1) * columns + c] = bends[(source_rows_ - 2) * columns + c];
    }
    const double squared_ratio =
        std::clamp(over_two > 0.0 ? over_one / over_two : 0.0, kHalvingLeast, kHalvingMost);
    halving_ratio_ = std::sqrt(squared_ratio);

    // Local averages, twice with weights 1 4 6 4 1: roughness varies slowly.
    constexpr std::array kWeights{1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0};
    std::vector<double> smoothed(bends.size());
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t r = 0; r < source_rows_; ++r) {
            for (std::size_t c = 0; c < columns; ++c) {
                double sum = 0.0;
                for (std::int64_t i = -2; i <= 2; ++i) {
                    const std::int64_t near = static_cast<std::int64_t>(c) + i;
                    sum += kWeights[static_cast<std::size_t>(i + 2)] *
                           bends[r * columns +
                                 (wraps_around_ ? wrapped(near, columns) : clamped(near, columns))];
                }
                smoothed[r * columns + c] = sum;
            }
        }
        for (std::size_t r = 0; r < source_rows_; ++r) {
            for (std::size_t c = 0; c < columns; ++c) {
                double sum = 0.0;
                for (std::int64_t i = -2; i <= 2; ++i) {
                    sum +=
                        kWeights[static_cast<std::size_t>(i + 2)] *
                        smoothed[clamped(static_cast<std::int64_t>(r) + i, source_rows_) * columns +
                                 c];
                }
                bends[r * columns + c] = sum;
            }
        }
    }
    // Second differences are 4 D(1) - D(2), where D(2) = D(1) / squared_ratio.
    const double differences_per_bend = 1.0 / (4.0 - 1.0 / squared_ratio);
    roughness_m_.resize(bends.size());
    std::transform(bends.begin(), bends.end(), roughness_m_.begin(), [&](double bend) {
        return static_cast<float>(std::sqrt(bend * differences_per_bend));
    });

    // Octaves narrower than the map's samples. The infinite sum of all octaves would reproduce the
    // map's own differences over the distance of its samples.
    const double sample = static_cast<double>(rows()) / static_cast<double>(source_rows_);
    std::size_t octaves = 0;
    while (static_cast<double>(std::size_t{1} << octaves) < 0.75 * sample) {
        ++octaves;
    }
    double sum = 0.0;
    double gain = 1.0; // squared, of the octave with a lattice of one sample
    double width = 1.0;
    double term = 0.0;
    for (; width < 32.0 * sample; width *= 2.0) {
        term = gain * squaredDifference(sample / width);
        sum += term;
        gain /= squared_ratio;
    }
    // For wider lattices the splines are parabolas, and the octaves' contributions a geometric
    // series.
    const double growth = 0.25 / squared_ratio;
    sum += term * growth / (1.0 - growth);
    constexpr int kNarrower = 40;
    gain = squared_ratio;
    width = 0.5;
    for (int k = 0; k < kNarrower; ++k) {
        sum += gain * squaredDifference(sample / width);
        gain *= squared_ratio;
        width /= 2.0;
    }
    gain = 1.0 / sum;
    for (std::size_t k = 0; k < octaves; ++k) {
        octave_gain_.push_back(static_cast<float>(std::sqrt(gain)));
        gain /= squared_ratio;
    }
}

void DetailedHeights::noise(std::int64_t column,
                            std::int64_t row,
                            std::size_t columns,
                            std::size_t rows,
                            Block& block) const
{
    // The last step, from numbers to the spline, needs one more number on each side.
    constexpr std::size_t kOctavesMax = 32;
    std::array<Lattice, kOctavesMax> lattices{};
    lattices[0] = {column - 1, row - 1, columns + 2, rows + 2};
    const std::size_t octaves = octave_gain_.size();
    for (std::size_t k = 1; k < octaves; ++k) {
        lattices[k] = lattices[k - 1].wider();
    }
    for (std::size_t k = octaves; k-- > 0;) {
        const Lattice& here = lattices[k];
        const bool is_widest = k + 1 == octaves;
        block.values.swap(block.wide);
        block.values.resize(here.columns * here.rows);
        if (!is_widest) {
            const Lattice& wide = lattices[k + 1];
            block.expanded.resize(here.columns * wide.rows);
            for (std::size_t r = 0; r < wide.rows; ++r) {
                expandRow(block.wide.data() + r * wide.columns, wide.column, here.column,
                          std::span(block.expanded).subspan(r * here.columns, here.columns));
            }
        }
        const float gain = octave_gain_[k];
        const auto first = static_cast<std::uint32_t>(here.column);
        for (std::size_t r = 0; r < here.rows; ++r) {
            const std::int64_t y = here.row + static_cast<std::int64_t>(r);
            const RowKey key = rowKey(seed_, k, y);
            float* to = block.values.data() + r * here.columns;
            const auto count = static_cast<std::uint32_t>(here.columns);
            if (is_widest) {
                for (std::uint32_t c = 0; c < count; ++c) {
                    to[c] = gain * latticeValue(key, first + c);
                }
                continue;
            }
            const float* p = block.expanded.data() +
                             static_cast<std::size_t>(half(y) - lattices[k + 1].row) * here.columns;
            const float* below = p + here.columns;
            if ((y & 1) != 0) {
                for (std::uint32_t c = 0; c < count; ++c) {
                    to[c] = 0.5F * (p[c] + below[c]) + gain * latticeValue(key, first + c);
                }
            } else {
                const float* above = p - here.columns;
                for (std::uint32_t c = 0; c < count; ++c) {
                    to[c] = 0.125F * (above[c] + below[c]) + 0.75F * p[c] +
                            gain * latticeValue(key, first + c);
                }
            }
        }
    }
    // The spline at its own lattice points: weights 1 4 1.
    constexpr float kSixth = 1.0F / 6.0F;
    constexpr float kTwoThirds = 2.0F / 3.0F;
    const std::size_t stride = columns + 2;
    block.expanded.resize(columns * (rows + 2));
    for (std::size_t r = 0; r < rows + 2; ++r) {
        const float* p = block.values.data() + r * stride + 1;
        float* to = block.expanded.data() + r * columns;
        for (std::size_t c = 0; c < columns; ++c) {
            to[c] = kSixth * (p[c - 1] + p[c + 1]) + kTwoThirds * p[c];
        }
    }
    block.values.resize(columns * rows);
    for (std::size_t r = 0; r < rows; ++r) {
        const float* p = block.expanded.data() + (r + 1) * columns;
        const float* above = p - columns;
        const float* below = p + columns;
        float* to = block.values.data() + r * columns;
        for (std::size_t c = 0; c < columns; ++c) {
            to[c] = kSixth * (above[c] + below[c]) + kTwoThirds * p[c];
        }
    }
}

void DetailedHeights::block(std::size_t column,
                            std::size_t row,
                            GridView<std::int16_t> heights_m) const
{
    const std::size_t columns = heights_m.columns();
    const std::size_t rows = heights_m.rows();
    thread_local Block buffers;
    const bool has_noise = !octave_gain_.empty();
    if (has_noise) {
        const auto c = static_cast<std::int64_t>(column);
        const auto r = static_cast<std::int64_t>(row);
        noise(c, r, columns, rows, buffers);
        // Near the last column of a map that wraps around, its noise is blended into the noise
        // before the first column.
        const std::size_t seam = std::min(this->columns(), std::size_t{2} << octave_gain_.size());
        const std::size_t seam_begin = this->columns() - seam;
        if (wraps_around_ && column + columns > seam_begin) {
            std::vector<float> inner = buffers.values;
            noise(c - static_cast<std::int64_t>(this->columns()), r, columns, rows, buffers);
            for (std::size_t i = 0; i < columns; ++i) {
                const std::size_t x = column + i;
                const float share = x < seam_begin ? 0.0F
                                                   : (static_cast<float>(x - seam_begin) + 0.5F) /
                                                         static_cast<float>(seam);
                for (std::size_t j = i; j < columns * rows; j += columns) {
                    buffers.values[j] = (1.0F - share) * inner[j] + share * buffers.values[j];
                }
            }
        }
    }
    // The map's columns needed for the block, interpolated along the rows' axis.
    const std::int64_t first = across_.index[column] - std::int64_t{1};
    const auto needed =
        static_cast<std::size_t>(across_.index[column + columns - 1] + std::int64_t{2} - first + 1);
    std::vector<std::size_t> source_column(needed);
    for (std::size_t i = 0; i < needed; ++i) {
        const std::int64_t c = first + static_cast<std::int64_t>(i);
        source_column[i] =
            wraps_around_ ? wrapped(c, source_columns_) : clamped(c, source_columns_);
    }
    std::vector<float> base(needed);
    std::vector<float> rough(needed);
    constexpr float kLow = std::numeric_limits<std::int16_t>::min();
    constexpr float kHigh = std::numeric_limits<std::int16_t>::max();
    for (std::size_t r = 0; r < rows; ++r) {
        std::array<std::size_t, 4> line{};
        for (std::size_t i = 0; i < 4; ++i) {
            line[i] =
                clamped(down_.index[row + r] + static_cast<std::int64_t>(i) - 1, source_rows_) *
                source_columns_;
        }
        const float v = down_.fraction[row + r];
        for (std::size_t i = 0; i < needed; ++i) {
            const std::size_t c = source_column[i];
            base[i] = at(catmullRom(source_m_[line[0] + c], source_m_[line[1] + c],
                                    source_m_[line[2] + c], source_m_[line[3] + c]),
                         v);
            rough[i] = at(cubicBSpline(roughness_m_[line[0] + c], roughness_m_[line[1] + c],
                                       roughness_m_[line[2] + c], roughness_m_[line[3] + c]),
                          v);
        }
        std::int16_t* to = heights_m.row(r).data();
        const float* noise_row = has_noise ? buffers.values.data() + r * columns : nullptr;
        const float* u = across_.fraction.data() + column;
        for (std::size_t begin = 0; begin < columns;) {
            // Samples between the same two samples of the map.
            const std::int32_t index = across_.index[column + begin];
            std::size_t end = begin + 1;
            while (end < columns && across_.index[column + end] == index) {
                ++end;
            }
            const auto i = static_cast<std::size_t>(index - first);
            const Cubic z = catmullRom(base[i - 1], base[i], base[i + 1], base[i + 2]);
            const Cubic s = cubicBSpline(rough[i - 1], rough[i], rough[i + 1], rough[i + 2]);
            const auto write = [&](std::size_t c, float height) {
                // Truncated after a shift, which vectorizes well.
                const float bounded = std::min(std::max(height, kLow), kHigh);
                to[c] = static_cast<std::int16_t>(static_cast<std::int32_t>(bounded + 32768.5F) -
                                                  32768);
            };
            if (has_noise) {
                for (std::size_t c = begin; c < end; ++c) {
                    write(c, at(z, u[c]) + at(s, u[c]) * noise_row[c]);
                }
            } else {
                for (std::size_t c = begin; c < end; ++c) {
                    write(c, at(z, u[c]));
                }
            }
            begin = end;
        }
    }
}

void DetailedHeights::window(std::size_t column,
                             std::size_t row,
                             GridView<std::int16_t> heights_m) const
{
    MARSVIEW_CHECK(column + heights_m.columns() <= columns() && row + heights_m.rows() <= rows());
    for (std::size_t r = 0; r < heights_m.rows(); r += kBlockSide) {
        for (std::size_t c = 0; c < heights_m.columns(); c += kBlockSide) {
            block(column + c, row + r,
                  GridView<std::int16_t>(heights_m.data() + r * heights_m.rowStride() + c,
                                         std::min(kBlockSide, heights_m.columns() - c),
                                         std::min(kBlockSide, heights_m.rows() - r),
                                         heights_m.rowStride()));
        }
    }
}

} // namespace marsview
