// The range of heights in every part of a map, so that casts can skip parts that they cannot hit.
#pragma once

#include "core/base/float_rounding.h"
#include "core/base/job_monitor.h"
#include "core/base/raw_array.h"
#include "core/base/result.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/raw_ranges.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace marsview {

/// A quadtree over blocks of kBlock × kBlock cells, each level half of the one below. Immutable;
/// any thread. Takes about 1/300 of the memory of int16 samples: the blocks keep their raw values,
/// because first touches of memory are most of the cost of opening a large map.
class MinMaxPyramid {
public:
    static constexpr std::size_t kBlock = RawRanges::kBlock;

    /// Bounds of all samples of a node, rounded outward; minimum_m > maximum_m if all are void.
    struct Bounds {
        float minimum_m;
        float maximum_m;
        bool isEmpty() const noexcept { return !(minimum_m <= maximum_m); }
    };

    /// Reads every sample once, on all cores. The only error is Canceled.
    static Result<MinMaxPyramid> build(const Heightfield& heightfield, JobMonitor& monitor);
    /// For a map whose blocks have these ranges; the same bits as build().
    static MinMaxPyramid from(RawRanges ranges, const ElevationScale& scale);

    /// The raw values of level 0.
    const RawRanges& blocks() const noexcept { return blocks_; }

    /// Level 0 has the blocks; the last level is a single node.
    std::size_t levelCount() const noexcept { return levels_.size(); }
    std::size_t columns(std::size_t level) const noexcept { return levels_[level].columns; }
    std::size_t rows(std::size_t level) const noexcept { return levels_[level].rows; }
    Bounds bounds(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        if (level == 0) {
            return blocks_.visit(
                [&](auto blocks) { return boundsOf(blocks(column, row), scale_); });
        }
        const Level& l = levels_[level];
        return l.bounds[row * l.columns + column];
    }

private:
    struct Level {
        std::size_t columns = 0;
        std::size_t rows = 0;
        RawArray<Bounds> bounds; // empty at level 0
    };

    static constexpr Bounds kEmpty{std::numeric_limits<float>::infinity(),
                                   -std::numeric_limits<float>::infinity()};

    // A negative gain swaps the ends.
    template <typename T>
    static Bounds boundsOf(const RawRanges::Range<T>& range, const ElevationScale& scale) noexcept
    {
        if (range.isEmpty()) {
            return kEmpty;
        }
        const double a = scale.height(static_cast<double>(range.minimum));
        const double b = scale.height(static_cast<double>(range.maximum));
        return {roundedDown(std::min(a, b)), roundedUp(std::max(a, b))};
    }

    RawRanges blocks_;
    ElevationScale scale_;
    std::vector<Level> levels_;
};

} // namespace marsview
