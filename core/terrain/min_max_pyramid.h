// The range of heights in every part of a map: what lets a cast skip what it cannot hit.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/raw_array.h"
#include "core/base/result.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/raw_ranges.h"

#include <cstddef>
#include <vector>

namespace marsview {

/// A quadtree over blocks of kBlock × kBlock cells, each level half of the one below. Immutable;
/// any thread. Takes about 1/90 of the memory of int16 samples.
class MinMaxPyramid {
public:
    static constexpr std::size_t kBlock = RawRanges::kBlock;

    /// Bounds of all samples of a node, rounded outward; minimum_m > maximum_m where all are void.
    struct Bounds {
        float minimum_m;
        float maximum_m;
        bool isEmpty() const noexcept { return !(minimum_m <= maximum_m); }
    };

    /// Reads every sample once, on all cores. Only Cancelled can go wrong.
    static Result<MinMaxPyramid> build(const Heightfield& heightfield, JobMonitor& monitor);
    /// Of a map whose blocks have these ranges; the same bits as build().
    static MinMaxPyramid from(const RawRanges& ranges, const ElevationScale& scale);

    /// Level 0 holds the blocks; the last level is a single node.
    std::size_t levelCount() const noexcept { return levels_.size(); }
    std::size_t columns(std::size_t level) const noexcept { return levels_[level].columns; }
    std::size_t rows(std::size_t level) const noexcept { return levels_[level].rows; }
    const Bounds& bounds(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        const Level& l = levels_[level];
        return l.bounds[row * l.columns + column];
    }

private:
    struct Level {
        std::size_t columns = 0;
        std::size_t rows = 0;
        RawArray<Bounds> bounds;
    };

    std::vector<Level> levels_;
};

} // namespace marsview
