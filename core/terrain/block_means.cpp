#include "core/terrain/block_means.h"

#include "core/base/parallel.h"
#include "core/terrain/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace marsview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Between the centres of a grid of blocks, the outermost ones extended; x and y count blocks, 0 is
// the centre of the first.
float interpolated(GridView<const float> grid, double x, double y)
{
    x = std::clamp(x, 0.0, static_cast<double>(grid.columns() - 1));
    y = std::clamp(y, 0.0, static_cast<double>(grid.rows() - 1));
    const auto left = static_cast<std::size_t>(x);
    const auto upper = static_cast<std::size_t>(y);
    const std::size_t right = std::min(left + 1, grid.columns() - 1);
    const std::size_t lower = std::min(upper + 1, grid.rows() - 1);
    const auto u = static_cast<float>(x - static_cast<double>(left));
    const auto v = static_cast<float>(y - static_cast<double>(upper));
    const float above = grid(left, upper) * (1.0F - u) + grid(right, upper) * u;
    const float below = grid(left, lower) * (1.0F - u) + grid(right, lower) * u;
    return above * (1.0F - v) + below * v;
}

} // namespace

template <typename SampleCount>
BlockMeans::Level BlockMeans::reduced(const Level& finer, const SampleCount& sample_count)
{
    Level level{.columns = (finer.columns + 1) / 2,
                .rows = (finer.rows + 1) / 2,
                .means_m = {},
                .shares = {}};
    level.means_m.resize(level.columns * level.rows);
    level.shares.resize(finer.shares.empty() ? 0 : level.means_m.size());
    for (std::size_t row = 0; row < level.rows; ++row) {
        for (std::size_t column = 0; column < level.columns; ++column) {
            float sum = 0.0F;
            float weight = 0.0F;
            float count = 0.0F;
            for (std::size_t r = 2 * row; r < std::min(2 * row + 2, finer.rows); ++r) {
                for (std::size_t c = 2 * column; c < std::min(2 * column + 2, finer.columns); ++c) {
                    const std::size_t index = r * finer.columns + c;
                    const float all = sample_count(c, r);
                    const float there = finer.shares.empty() ? all : all * finer.shares[index];
                    sum += there > 0.0F ? there * finer.means_m[index] : 0.0F;
                    weight += there;
                    count += all;
                }
            }
            const std::size_t index = row * level.columns + column;
            level.means_m[index] = weight > 0.0F ? sum / weight : kNan;
            if (!level.shares.empty()) {
                level.shares[index] = weight / count;
            }
        }
    }
    return level;
}

Result<BlockMeans> BlockMeans::build(const Heightfield& heightfield, JobMonitor& monitor)
{
    const std::size_t columns = heightfield.columns();
    const std::size_t rows = heightfield.rows();
    const bool has_voids = heightfield.samples().hasVoids();
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const double base_m = (range.minimum_m + range.maximum_m) / 2.0;
    Level blocks{.columns = (columns + kBlock - 1) / kBlock,
                 .rows = (rows + kBlock - 1) / kBlock,
                 .means_m = {},
                 .shares = {}};
    blocks.means_m.resize(blocks.columns * blocks.rows);
    if (has_voids) {
        blocks.shares.resize(blocks.means_m.size());
    }
    parallelRanges(blocks.rows, 8, [&](std::size_t begin, std::size_t end) {
        std::vector<float> heights(columns);
        std::vector<float> sums(columns);
        std::vector<float> counts(has_voids ? columns : 0);
        for (std::size_t block_row = begin; block_row < end && !monitor.isCancelled();
             ++block_row) {
            std::fill(sums.begin(), sums.end(), 0.0F);
            std::fill(counts.begin(), counts.end(), 0.0F);
            const std::size_t row_end = std::min((block_row + 1) * kBlock, rows);
            for (std::size_t row = block_row * kBlock; row < row_end; ++row) {
                readHeights(heightfield, 0, row, base_m, heights);
                for (std::size_t i = 0; i < columns; ++i) {
                    const bool is_there = !has_voids || !std::isnan(heights[i]);
                    sums[i] += is_there ? heights[i] : 0.0F;
                }
                for (std::size_t i = 0; i < counts.size(); ++i) {
                    counts[i] += std::isnan(heights[i]) ? 0.0F : 1.0F;
                }
            }
            const std::size_t block_rows = row_end - block_row * kBlock;
            for (std::size_t block = 0; block < blocks.columns; ++block) {
                const std::size_t first = block * kBlock;
                const std::size_t last = std::min(first + kBlock, columns);
                const auto sample_count = static_cast<float>((last - first) * block_rows);
                float sum = 0.0F;
                float count = has_voids ? 0.0F : sample_count;
                for (std::size_t i = first; i < last; ++i) {
                    sum += sums[i];
                    count += has_voids ? counts[i] : 0.0F;
                }
                const std::size_t index = block_row * blocks.columns + block;
                blocks.means_m[index] =
                    count > 0.0F ? static_cast<float>(static_cast<double>(sum / count) + base_m)
                                 : kNan;
                if (has_voids) {
                    blocks.shares[index] = count / sample_count;
                }
            }
        }
    });
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    BlockMeans means;
    means.levels_.push_back(std::move(blocks));
    while (means.levels_.back().means_m.size() > 1) {
        // Blocks at the last column and row hold fewer samples, and weigh less.
        const std::size_t side = kBlock << (means.levels_.size() - 1);
        const auto sample_count = [&](std::size_t block_column, std::size_t block_row) {
            return static_cast<float>(std::min(side, columns - block_column * side)) *
                   static_cast<float>(std::min(side, rows - block_row * side));
        };
        means.levels_.push_back(reduced(means.levels_.back(), sample_count));
    }
    if (has_voids) {
        means.fill();
    }
    monitor.report(1.0);
    return means;
}

// From the single block of the top, which has a mean, down: a gap takes what the level above has
// there.
void BlockMeans::fill()
{
    std::vector<float> above = levels_.back().means_m;
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        const Level& level = levels_[i];
        const Level& coarser = levels_[i + 1];
        const GridView<const float> around(above.data(), coarser.columns, coarser.rows);
        std::vector<float> filled = level.means_m;
        for (std::size_t row = 0; row < level.rows; ++row) {
            for (std::size_t column = 0; column < level.columns; ++column) {
                float& mean = filled[row * level.columns + column];
                if (std::isnan(mean)) {
                    mean = interpolated(around, (static_cast<double>(column) + 0.5) / 2.0 - 0.5,
                                        (static_cast<double>(row) + 0.5) / 2.0 - 0.5);
                }
            }
        }
        above = std::move(filled);
    }
    filled_m_ = std::move(above);
}

GridView<const float> BlockMeans::means(std::size_t level) const
{
    const Level& l = levels_[level];
    return {l.means_m.data(), l.columns, l.rows};
}

float BlockMeans::share(std::size_t level, std::size_t column, std::size_t row) const noexcept
{
    const Level& l = levels_[level];
    return l.shares.empty() ? 1.0F : l.shares[row * l.columns + column];
}

float BlockMeans::filled(std::size_t column, std::size_t row) const noexcept
{
    const Level& blocks = levels_.front();
    const std::vector<float>& heights = filled_m_.empty() ? blocks.means_m : filled_m_;
    const double block = static_cast<double>(kBlock);
    return interpolated({heights.data(), blocks.columns, blocks.rows},
                        (static_cast<double>(column) + 0.5) / block - 0.5,
                        (static_cast<double>(row) + 0.5) / block - 0.5);
}

} // namespace marsview
