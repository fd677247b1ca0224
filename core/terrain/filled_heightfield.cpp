// Pull and push: means of blocks of samples, means of those and so on until every mean is known;
// then the unknown ones are interpolated from the next coarser level, down to the blocks. A void
// sample is the bilinear interpolation of the four blocks around it. That is continuous, exact for
// a plane where the blocks are full, and never leaves the range of what was measured.

#include "core/terrain/filled_heightfield.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

// Samples along a block's side: the means then take 1/16 byte a sample.
constexpr std::size_t kSide = 8;

struct MeanLevel {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<float> means;
    std::vector<float> weights; // how many samples the mean is of; 0: unknown
};

// Value at (x, y) between the nodes of a level, clamped to its outermost nodes.
template <typename Values>
double interpolated(const Values& values, std::size_t columns, std::size_t rows, double x, double y)
{
    x = std::clamp(x, 0.0, static_cast<double>(columns - 1));
    y = std::clamp(y, 0.0, static_cast<double>(rows - 1));
    const auto c = static_cast<std::size_t>(x);
    const auto r = static_cast<std::size_t>(y);
    const std::size_t c1 = std::min(c + 1, columns - 1);
    const std::size_t r1 = std::min(r + 1, rows - 1);
    const double u = x - static_cast<double>(c);
    const double v = y - static_cast<double>(r);
    const auto at = [&](std::size_t column, std::size_t row) {
        return static_cast<double>(values[row * columns + column]);
    };
    return (1.0 - v) * ((1.0 - u) * at(c, r) + u * at(c1, r)) +
           v * ((1.0 - u) * at(c, r1) + u * at(c1, r1));
}

MeanLevel coarser(const MeanLevel& finer)
{
    MeanLevel level{.columns = (finer.columns + 1) / 2,
                    .rows = (finer.rows + 1) / 2,
                    .means = {},
                    .weights = {}};
    level.means.assign(level.columns * level.rows, 0.0F);
    level.weights.assign(level.columns * level.rows, 0.0F);
    for (std::size_t row = 0; row < level.rows; ++row) {
        for (std::size_t column = 0; column < level.columns; ++column) {
            double sum = 0.0;
            double weight = 0.0;
            for (std::size_t r = 2 * row; r < std::min(2 * row + 2, finer.rows); ++r) {
                for (std::size_t c = 2 * column; c < std::min(2 * column + 2, finer.columns); ++c) {
                    const std::size_t i = r * finer.columns + c;
                    const auto w = static_cast<double>(finer.weights[i]);
                    sum += w * static_cast<double>(finer.means[i]);
                    weight += w;
                }
            }
            if (weight > 0.0) {
                level.means[row * level.columns + column] = static_cast<float>(sum / weight);
                level.weights[row * level.columns + column] = static_cast<float>(weight);
            }
        }
    }
    return level;
}

void fillFrom(const MeanLevel& coarse, MeanLevel& fine)
{
    for (std::size_t row = 0; row < fine.rows; ++row) {
        for (std::size_t column = 0; column < fine.columns; ++column) {
            const std::size_t i = row * fine.columns + column;
            if (fine.weights[i] == 0.0F) {
                fine.means[i] =
                    static_cast<float>(interpolated(coarse.means, coarse.columns, coarse.rows,
                                                    (static_cast<double>(column) + 0.5) / 2.0 - 0.5,
                                                    (static_cast<double>(row) + 0.5) / 2.0 - 0.5));
            }
        }
    }
}

float roundedUp(double value)
{
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value
               ? std::nextafterf(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

} // namespace

Result<FilledHeightfield> FilledHeightfield::build(const Heightfield& heightfield,
                                                   std::shared_ptr<const MinMaxPyramid> pyramid,
                                                   JobMonitor& monitor)
{
    MARSVIEW_CHECK(pyramid != nullptr);
    FilledHeightfield filled(heightfield, std::move(pyramid));
    if (heightfield.samples().hasVoids() &&
        !(filled.buildMeans(monitor) && filled.buildMaxima(monitor))) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    monitor.report(1.0);
    return filled;
}

bool FilledHeightfield::buildMeans(JobMonitor& monitor)
{
    std::vector<MeanLevel> levels(1);
    MeanLevel& blocks = levels.front();
    blocks.columns = (columns() + kSide - 1) / kSide;
    blocks.rows = (rows() + kSide - 1) / kSide;
    blocks.means.assign(blocks.columns * blocks.rows, 0.0F);
    blocks.weights.assign(blocks.columns * blocks.rows, 0.0F);
    for (std::size_t row = 0; row < blocks.rows; ++row) {
        if (monitor.isCancelled()) {
            return false;
        }
        monitor.report(0.5 * static_cast<double>(row) / static_cast<double>(blocks.rows));
        for (std::size_t column = 0; column < blocks.columns; ++column) {
            double sum = 0.0;
            double count = 0.0;
            for (std::size_t r = row * kSide; r < std::min((row + 1) * kSide, rows()); ++r) {
                for (std::size_t c = column * kSide; c < std::min((column + 1) * kSide, columns());
                     ++c) {
                    if (!isVoid(c, r)) {
                        sum += heightfield_.sample(c, r);
                        count += 1.0;
                    }
                }
            }
            if (count > 0.0) {
                const std::size_t i = row * blocks.columns + column;
                blocks.means[i] = static_cast<float>(sum / count);
                blocks.weights[i] = static_cast<float>(count);
            }
        }
    }
    while (levels.back().means.size() > 1) {
        levels.push_back(coarser(levels.back()));
    }
    for (std::size_t i = levels.size() - 1; i > 0; --i) {
        fillFrom(levels[i], levels[i - 1]);
    }
    mean_columns_ = levels.front().columns;
    mean_rows_ = levels.front().rows;
    means_ = std::move(levels.front().means);
    return true;
}

double FilledHeightfield::fillAt(std::size_t column, std::size_t row) const noexcept
{
    constexpr double kBlock = static_cast<double>(kSide);
    return interpolated(means_, mean_columns_, mean_rows_,
                        (static_cast<double>(column) + 0.5) / kBlock - 0.5,
                        (static_cast<double>(row) + 0.5) / kBlock - 0.5);
}

// What is filled may be higher than what was measured nearby, and a cast must not pass through it.
bool FilledHeightfield::buildMaxima(JobMonitor& monitor)
{
    const std::size_t levels = pyramid_->levelCount();
    maxima_.resize(levels);
    for (std::size_t level = 0; level < levels; ++level) {
        maxima_[level].resize(pyramid_->columns(level) * pyramid_->rows(level));
    }
    const std::size_t blocks = pyramid_->columns(0);
    for (std::size_t row = 0; row < pyramid_->rows(0); ++row) {
        if (monitor.isCancelled()) {
            return false;
        }
        monitor.report(0.5 +
                       0.5 * static_cast<double>(row) / static_cast<double>(pyramid_->rows(0)));
        for (std::size_t column = 0; column < blocks; ++column) {
            const MinMaxPyramid::Bounds& bounds = pyramid_->bounds(0, column, row);
            float maximum =
                bounds.isEmpty() ? std::numeric_limits<float>::lowest() : bounds.maximum_m;
            constexpr std::size_t kBlock = MinMaxPyramid::kBlock;
            for (std::size_t r = row * kBlock; r <= std::min((row + 1) * kBlock, rows() - 1); ++r) {
                for (std::size_t c = column * kBlock;
                     c <= std::min((column + 1) * kBlock, columns() - 1); ++c) {
                    if (isVoid(c, r)) {
                        maximum = std::max(maximum, roundedUp(fillAt(c, r)));
                    }
                }
            }
            maxima_[0][row * blocks + column] = maximum;
        }
    }
    for (std::size_t level = 1; level < levels; ++level) {
        const std::size_t width = pyramid_->columns(level);
        std::fill(maxima_[level].begin(), maxima_[level].end(),
                  std::numeric_limits<float>::lowest());
        for (std::size_t row = 0; row < pyramid_->rows(level - 1); ++row) {
            for (std::size_t column = 0; column < pyramid_->columns(level - 1); ++column) {
                float& maximum = maxima_[level][(row / 2) * width + column / 2];
                maximum = std::max(maximum,
                                   maxima_[level - 1][row * pyramid_->columns(level - 1) + column]);
            }
        }
    }
    return true;
}

} // namespace marsview
