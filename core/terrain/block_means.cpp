#include "core/terrain/block_means.h"

#include "core/base/parallel.h"

#include <utility>

namespace marsview {

Result<BlockMeans> BlockMeans::build(const Heightfield& heightfield, JobMonitor& monitor)
{
    const SampleGrid& samples = heightfield.samples();
    const BlockExtent extent{samples.columns(), samples.rows(), kBlock};
    BlockGrid blocks =
        emptyBlocks(extent, samples.hasVoids() ? BlockShares::Kept : BlockShares::None);
    parallelRanges(blocks.rows, 8, [&](std::size_t begin, std::size_t end) {
        if (!monitor.isCanceled()) {
            measureBlocks(samples, kBlock, heightfield.scale(), begin, end, blocks);
        }
    });
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    BlockMeans means = from(std::move(blocks), extent);
    monitor.report(1.0);
    return means;
}

BlockMeans BlockMeans::from(BlockGrid blocks, const BlockExtent& extent)
{
    MARSVIEW_CHECK(blocks.columns == extent.blockColumns() && blocks.rows == extent.blockRows());
    BlockMeans means;
    means.extent_ = extent;
    means.levels_.push_back(std::move(blocks));
    BlockExtent finer = extent;
    while (means.levels_.back().means_m.size() > 1) {
        means.levels_.push_back(reduced(means.levels_.back(), finer));
        finer = finer.coarser();
    }
    if (!means.levels_.front().shares.empty()) {
        means.fill();
    }
    return means;
}

// From the single top block, which has a mean, down: a gap takes the value of the level above.
void BlockMeans::fill()
{
    const auto rows_of = [](const BlockGrid& level) {
        return BlockRows{.columns = level.columns,
                         .level_rows = level.rows,
                         .first_row = 0,
                         .heights_m = level.means_m};
    };
    BlockRows above = rows_of(levels_.back());
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        BlockRows level = rows_of(levels_[i]);
        fillGaps(level, above);
        above = std::move(level);
    }
    filled_m_ = std::move(above.heights_m);
}

GridView<const float> BlockMeans::means(std::size_t level) const
{
    const BlockGrid& l = levels_[level];
    return {l.means_m.data(), l.columns, l.rows};
}

float BlockMeans::share(std::size_t level, std::size_t column, std::size_t row) const noexcept
{
    const BlockGrid& l = levels_[level];
    return l.shares.empty() ? 1.0F : l.shares[row * l.columns + column];
}

GridView<const float> BlockMeans::filledMeans() const
{
    const BlockGrid& blocks = levels_.front();
    const LargeVector<float>& heights = filled_m_.empty() ? blocks.means_m : filled_m_;
    return {heights.data(), blocks.columns, blocks.rows};
}

float BlockMeans::filled(std::size_t column, std::size_t row) const noexcept
{
    const GridView<const float> grid = filledMeans();
    const BlockPlace x = placeOfSample(column, extent_.block_samples, grid.columns());
    const BlockPlace y = placeOfSample(row, extent_.block_samples, grid.rows());
    return interpolated(interpolated(grid(x.before, y.before), grid(x.after, y.before), x.share),
                        interpolated(grid(x.before, y.after), grid(x.after, y.after), x.share),
                        y.share);
}

} // namespace marsview
