#include "core/terrain/block_grid.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace marsview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Sums of a column of a block. Those of two-byte samples are exact in 32 bits, those of four-byte
// integers in a double; others are rounded in the order of rows and columns.
template <typename T>
using Sum = std::conditional_t<sizeof(T) <= 2, std::int32_t, double>;

// Adds up the samples of a row of blocks column by column, which vectorizes.
template <typename T>
class ColumnSums {
public:
    explicit ColumnSums(const SampleGrid& samples)
        : samples_(samples)
        , sums_(samples.columns())
        , counts_(samples.hasVoids() ? samples.columns() : 0)
    {}

    void add(GridView<const T> values, std::size_t first_row, std::size_t end_row)
    {
        std::fill(sums_.begin(), sums_.end(), Sum<T>{});
        std::fill(counts_.begin(), counts_.end(), 0);
        for (std::size_t row = first_row; row < end_row; ++row) {
            const T* value = values.row(row).data();
            if (counts_.empty()) {
                for (std::size_t i = 0; i < sums_.size(); ++i) {
                    sums_[i] += static_cast<Sum<T>>(value[i]);
                }
                continue;
            }
            for (std::size_t i = 0; i < sums_.size(); ++i) {
                if (!samples_.isVoid(i, row)) {
                    sums_[i] += static_cast<Sum<T>>(value[i]);
                    ++counts_[i];
                }
            }
        }
    }

    // The sum over columns [begin, end), and the number of samples in it.
    struct Block {
        double sum = 0.0;
        double count = 0.0;
    };
    Block block(std::size_t begin, std::size_t end, std::size_t rows) const
    {
        Sum<T> sum{};
        std::int64_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            sum += sums_[i];
            count += counts_.empty() ? 0 : counts_[i];
        }
        return {static_cast<double>(sum),
                static_cast<double>(
                    counts_.empty() ? static_cast<std::int64_t>((end - begin) * rows) : count)};
    }

private:
    const SampleGrid& samples_;
    std::vector<Sum<T>> sums_;
    std::vector<std::int32_t> counts_; // empty: no voids
};

} // namespace

BlockGrid emptyBlocks(const BlockExtent& extent, BlockShares shares)
{
    BlockGrid grid = blocksToBeFilled(extent, shares);
    std::fill(grid.means_m.begin(), grid.means_m.end(), 0.0F);
    std::fill(grid.shares.begin(), grid.shares.end(), 0.0F);
    return grid;
}

BlockGrid blocksToBeFilled(const BlockExtent& extent, BlockShares shares)
{
    BlockGrid grid{
        .columns = extent.blockColumns(), .rows = extent.blockRows(), .means_m = {}, .shares = {}};
    grid.means_m.resize(grid.columns * grid.rows);
    grid.shares.resize(shares == BlockShares::Kept ? grid.means_m.size() : 0);
    return grid;
}

void measureBlocks(const SampleGrid& samples,
                   std::size_t block_samples,
                   const ElevationScale& scale,
                   std::size_t begin,
                   std::size_t end,
                   BlockGrid& grid)
{
    samples.visit([&](auto values) {
        ColumnSums<std::remove_cvref_t<decltype(values(0, 0))>> sums(samples);
        for (std::size_t block_row = begin; block_row < end; ++block_row) {
            const std::size_t first_row = block_row * block_samples;
            const std::size_t end_row = std::min(first_row + block_samples, samples.rows());
            sums.add(values, first_row, end_row);
            for (std::size_t column = 0; column < grid.columns; ++column) {
                const std::size_t first = column * block_samples;
                const std::size_t last = std::min(first + block_samples, samples.columns());
                const auto block = sums.block(first, last, end_row - first_row);
                const std::size_t index = block_row * grid.columns + column;
                grid.means_m[index] =
                    block.count > 0.0 ? static_cast<float>(scale.height(block.sum / block.count))
                                      : kNan;
                if (!grid.shares.empty()) {
                    grid.shares[index] = static_cast<float>(block.count) /
                                         static_cast<float>((last - first) * (end_row - first_row));
                }
            }
        }
    });
}

BlockGrid reduced(const BlockGrid& finer, const BlockExtent& extent)
{
    BlockGrid level =
        emptyBlocks(extent.coarser(), finer.shares.empty() ? BlockShares::None : BlockShares::Kept);
    for (std::size_t row = 0; row < level.rows; ++row) {
        for (std::size_t column = 0; column < level.columns; ++column) {
            float sum = 0.0F;
            float weight = 0.0F;
            float count = 0.0F;
            for (std::size_t r = 2 * row; r < std::min(2 * row + 2, finer.rows); ++r) {
                for (std::size_t c = 2 * column; c < std::min(2 * column + 2, finer.columns); ++c) {
                    const std::size_t index = r * finer.columns + c;
                    const float all = extent.sampleCount(c, r);
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

void fillGaps(BlockRows& rows, const BlockRows& coarser)
{
    for (std::size_t row = rows.first_row; row < rows.endRow(); ++row) {
        const BlockPlace y = placeOfSample(row, 2, coarser.level_rows);
        for (std::size_t column = 0; column < rows.columns; ++column) {
            float& mean = rows.heights_m[(row - rows.first_row) * rows.columns + column];
            if (std::isnan(mean)) {
                const BlockPlace x = placeOfSample(column, 2, coarser.columns);
                mean = interpolated(
                    interpolated(coarser(x.before, y.before), coarser(x.after, y.before), x.share),
                    interpolated(coarser(x.before, y.after), coarser(x.after, y.after), x.share),
                    y.share);
            }
        }
    }
}

RowRange rowsToFillFrom(RowRange rows, std::size_t coarser_rows)
{
    return {placeOfSample(rows.first, 2, coarser_rows).before,
            placeOfSample(rows.end - 1, 2, coarser_rows).after + 1};
}

} // namespace marsview
