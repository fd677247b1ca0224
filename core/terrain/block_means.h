// Mean heights of blocks of samples: a small picture of a map of any size.
#pragma once

#include "core/base/grid_view.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// Means over blocks of kBlock × kBlock samples, over four such blocks, and so on up to one block
/// for all. For drawing and for filling voids, never for numbers that people read. Immutable; any
/// thread. Takes 1/12 of a byte a sample, twice that where the map has voids.
class BlockMeans {
public:
    static constexpr std::size_t kBlock = 8;

    /// Reads every sample once, on all cores. Only Cancelled can go wrong.
    static Result<BlockMeans> build(const Heightfield& heightfield, JobMonitor& monitor);

    /// Level 0 has blocks of kBlock samples a side, each further level twice as many.
    std::size_t levelCount() const noexcept { return levels_.size(); }
    /// Mean heights in metres of a level's blocks; NaN where all samples are void.
    GridView<const float> means(std::size_t level) const;
    /// Share of a block's samples that are not void, in [0, 1].
    float share(std::size_t level, std::size_t column, std::size_t row) const noexcept;

    /// A height for every sample of the map, void or not: interpolated between the means around,
    /// and where these are void between those of larger blocks. Metres; continuous; a function of
    /// the position alone. No allocation.
    float filled(std::size_t column, std::size_t row) const noexcept;

private:
    struct Level {
        std::size_t columns = 0;
        std::size_t rows = 0;
        std::vector<float> means_m;
        std::vector<float> shares; // empty: all 1
    };

    // `sample_count` of (column, row) is the number of samples, void or not, of a finer block.
    template <typename SampleCount>
    static Level reduced(const Level& finer, const SampleCount& sample_count);
    void fill();

    std::vector<Level> levels_;
    std::vector<float> filled_m_; // level 0 without gaps; empty where it has none
};

} // namespace marsview
