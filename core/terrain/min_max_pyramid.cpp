#include "core/terrain/min_max_pyramid.h"

#include "core/base/float_rounding.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <limits>

namespace marsview {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr MinMaxPyramid::Bounds kEmpty{kInfinity, -kInfinity};

void include(MinMaxPyramid::Bounds& bounds, const MinMaxPyramid::Bounds& other)
{
    bounds.minimum_m = std::min(bounds.minimum_m, other.minimum_m);
    bounds.maximum_m = std::max(bounds.maximum_m, other.maximum_m);
}

} // namespace

Result<MinMaxPyramid> MinMaxPyramid::build(const Heightfield& heightfield, JobMonitor& monitor)
{
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    MinMaxPyramid pyramid =
        from(RawRanges::of(heightfield.samples(), monitor), heightfield.scale());
    if (monitor.isCancelled()) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    monitor.report(1.0);
    return pyramid;
}

MinMaxPyramid MinMaxPyramid::from(const RawRanges& ranges, const ElevationScale& scale)
{
    MinMaxPyramid pyramid;
    Level blocks{.columns = ranges.columns(),
                 .rows = ranges.rows(),
                 .bounds = RawArray<Bounds>(ranges.columns() * ranges.rows())};
    ranges.visit([&](auto raw) {
        parallelRanges(blocks.rows, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                Bounds* bounds = blocks.bounds.data() + row * blocks.columns;
                for (const auto& range : raw.row(row)) {
                    // A negative gain swaps the ends.
                    const double a = scale.height(static_cast<double>(range.minimum));
                    const double b = scale.height(static_cast<double>(range.maximum));
                    *bounds++ = range.isEmpty() ? kEmpty
                                                : Bounds{roundedDown(std::min(a, b)),
                                                         roundedUp(std::max(a, b))};
                }
            }
        });
    });
    pyramid.levels_.push_back(std::move(blocks));
    while (pyramid.levels_.back().bounds.size() > 1) {
        const Level& finer = pyramid.levels_.back();
        const std::size_t columns = (finer.columns + 1) / 2;
        const std::size_t rows = (finer.rows + 1) / 2;
        Level coarser{.columns = columns, .rows = rows, .bounds = RawArray<Bounds>(columns * rows)};
        parallelRanges(rows, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const Bounds* upper = finer.bounds.data() + 2 * row * finer.columns;
                const Bounds* lower = 2 * row + 1 < finer.rows ? upper + finer.columns : upper;
                for (std::size_t column = 0; column < columns; ++column) {
                    const std::size_t left = 2 * column;
                    const std::size_t right = std::min(left + 1, finer.columns - 1);
                    Bounds bounds = upper[left];
                    include(bounds, upper[right]);
                    include(bounds, lower[left]);
                    include(bounds, lower[right]);
                    coarser.bounds[row * columns + column] = bounds;
                }
            }
        });
        pyramid.levels_.push_back(std::move(coarser));
    }
    return pyramid;
}

} // namespace marsview
