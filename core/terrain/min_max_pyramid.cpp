#include "core/terrain/min_max_pyramid.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kRowsAtOnce = 64;

void include(MinMaxPyramid::Bounds& bounds, const MinMaxPyramid::Bounds& other)
{
    bounds.minimum_m = std::min(bounds.minimum_m, other.minimum_m);
    bounds.maximum_m = std::max(bounds.maximum_m, other.maximum_m);
}

} // namespace

Result<MinMaxPyramid> MinMaxPyramid::build(const Heightfield& heightfield, JobMonitor& monitor)
{
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    MinMaxPyramid pyramid =
        from(RawRanges::of(heightfield.samples(), monitor), heightfield.scale());
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    monitor.report(1.0);
    return pyramid;
}

MinMaxPyramid MinMaxPyramid::from(RawRanges ranges, const ElevationScale& scale)
{
    MinMaxPyramid pyramid;
    pyramid.blocks_ = std::move(ranges);
    pyramid.scale_ = scale;
    pyramid.levels_.push_back(
        {.columns = pyramid.blocks_.columns(), .rows = pyramid.blocks_.rows(), .bounds = {}});
    // Every node is merged from the four below it, or fewer at the far edges.
    const auto add_level = [&pyramid](auto&& merged) {
        const Level& finer = pyramid.levels_.back();
        const std::size_t columns = (finer.columns + 1) / 2;
        const std::size_t rows = (finer.rows + 1) / 2;
        Level coarser{.columns = columns, .rows = rows, .bounds = RawArray<Bounds>(columns * rows)};
        parallelRanges(rows, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const std::size_t upper = 2 * row;
                const std::size_t lower = std::min(upper + 1, finer.rows - 1);
                Bounds* bounds = coarser.bounds.data() + row * columns;
                for (std::size_t column = 0; column < columns; ++column) {
                    const std::size_t left = 2 * column;
                    const std::size_t right = std::min(left + 1, finer.columns - 1);
                    *bounds++ = merged(upper, lower, left, right);
                }
            }
        });
        pyramid.levels_.push_back(std::move(coarser));
    };
    const auto has_more = [&pyramid] {
        return pyramid.levels_.back().columns * pyramid.levels_.back().rows > 1;
    };
    if (has_more()) {
        pyramid.blocks_.visit([&](auto blocks) {
            // Merged as raw values: scaling and rounding keep the order.
            add_level(
                [&](std::size_t upper, std::size_t lower, std::size_t left, std::size_t right) {
                    auto range = blocks(left, upper);
                    range.include(blocks(right, upper));
                    range.include(blocks(left, lower));
                    range.include(blocks(right, lower));
                    return boundsOf(range, scale);
                });
        });
    }
    while (has_more()) {
        const Level& finer = pyramid.levels_.back();
        const Bounds* const nodes = finer.bounds.data();
        add_level([nodes, width = finer.columns](std::size_t upper, std::size_t lower,
                                                 std::size_t left, std::size_t right) {
            Bounds bounds = nodes[upper * width + left];
            include(bounds, nodes[upper * width + right]);
            include(bounds, nodes[lower * width + left]);
            include(bounds, nodes[lower * width + right]);
            return bounds;
        });
    }
    return pyramid;
}

} // namespace marsview
