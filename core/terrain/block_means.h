// Mean heights of blocks of samples: a small version of a map of any size.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/block_grid.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// Means over square blocks of samples, over four such blocks, and so on up to one block for all.
/// For drawing and for filling voids, never for values shown to people. Immutable; any thread. With
/// blocks of kBlock it takes 1/12 of a byte per sample, twice that if the map has voids.
class BlockMeans {
public:
    /// The smallest blocks, used for a map in memory.
    static constexpr std::size_t kBlock = 8;

    /// Reads every sample once, on all cores. The only error is Canceled.
    static Result<BlockMeans> build(const Heightfield& heightfield, JobMonitor& monitor);
    /// From the means of a map's finest stored blocks; the same bits as build() from there up.
    /// `extent` is the map's, and its block_samples kBlock times a power of two.
    static BlockMeans from(BlockGrid blocks, const BlockExtent& extent);

    /// Samples along a side of level 0's blocks: kBlock, or more for a map larger than memory.
    std::size_t blockSamples() const noexcept { return extent_.block_samples; }
    /// Each level above 0 has blocks of twice as many samples a side.
    std::size_t levelCount() const noexcept { return levels_.size(); }
    /// Mean heights in meters of a level's blocks; NaN if all samples are void.
    GridView<const float> means(std::size_t level) const;
    /// Fraction of a block's samples that are valid, in [0, 1].
    float share(std::size_t level, std::size_t column, std::size_t row) const noexcept;

    /// A height for every sample of the map, void or not: interpolated between the surrounding
    /// means, or between those of larger blocks where they are void. In meters; continuous; depends
    /// only on the position. No allocation.
    float filled(std::size_t column, std::size_t row) const noexcept;
    /// Level 0 without gaps: the values that filled() interpolates.
    GridView<const float> filledMeans() const;

private:
    void fill();

    BlockExtent extent_;
    std::vector<BlockGrid> levels_;
    LargeVector<float> filled_m_; // level 0 without gaps; empty if it has no gaps
};

} // namespace marsview
