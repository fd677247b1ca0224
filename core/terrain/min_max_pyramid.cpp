#include "core/terrain/min_max_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float roundedDown(double value)
{
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) > value ? std::nextafterf(nearest, -kInfinity) : nearest;
}

float roundedUp(double value)
{
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value ? std::nextafterf(nearest, kInfinity) : nearest;
}

void include(MinMaxPyramid::Bounds& bounds, const MinMaxPyramid::Bounds& other)
{
    bounds.minimum_m = std::min(bounds.minimum_m, other.minimum_m);
    bounds.maximum_m = std::max(bounds.maximum_m, other.maximum_m);
}

constexpr MinMaxPyramid::Bounds kEmpty{kInfinity, -kInfinity};

struct RawRange {
    double minimum = std::numeric_limits<double>::infinity();
    double maximum = -std::numeric_limits<double>::infinity();
};

} // namespace

Result<MinMaxPyramid> MinMaxPyramid::build(const Heightfield& heightfield, JobMonitor& monitor)
{
    const std::size_t cell_columns = heightfield.columns() - 1;
    const std::size_t cell_rows = heightfield.rows() - 1;
    MinMaxPyramid pyramid;
    Level blocks{.columns = (cell_columns + kBlock - 1) / kBlock,
                 .rows = (cell_rows + kBlock - 1) / kBlock,
                 .bounds = {}};
    blocks.bounds.assign(blocks.columns * blocks.rows, kEmpty);
    const SampleGrid& samples = heightfield.samples();
    std::vector<RawRange> ranges(blocks.columns);
    for (std::size_t block_row = 0; block_row < blocks.rows; ++block_row) {
        if (monitor.isCancelled()) {
            return Error{ErrorCode::Cancelled, "cancelled"};
        }
        monitor.report(static_cast<double>(block_row) / static_cast<double>(blocks.rows));
        std::fill(ranges.begin(), ranges.end(), RawRange{});
        const std::size_t row_end = std::min((block_row + 1) * kBlock, cell_rows) + 1;
        samples.visit([&](auto view) {
            for (std::size_t row = block_row * kBlock; row < row_end; ++row) {
                for (std::size_t i = 0; i < blocks.columns; ++i) {
                    RawRange range = ranges[i];
                    // A block shares its last samples with the next one.
                    const std::size_t end = std::min((i + 1) * kBlock, cell_columns) + 1;
                    for (std::size_t column = i * kBlock; column < end; ++column) {
                        if (!samples.isVoid(column, row)) {
                            const auto raw = static_cast<double>(view(column, row));
                            range.minimum = std::min(range.minimum, raw);
                            range.maximum = std::max(range.maximum, raw);
                        }
                    }
                    ranges[i] = range;
                }
            }
        });
        for (std::size_t i = 0; i < blocks.columns; ++i) {
            if (ranges[i].minimum <= ranges[i].maximum) {
                // A negative gain swaps the ends.
                const double a = heightfield.scale().height(ranges[i].minimum);
                const double b = heightfield.scale().height(ranges[i].maximum);
                blocks.bounds[block_row * blocks.columns + i] = {roundedDown(std::min(a, b)),
                                                                 roundedUp(std::max(a, b))};
            }
        }
    }
    pyramid.levels_.push_back(std::move(blocks));
    while (pyramid.levels_.back().bounds.size() > 1) {
        const Level& finer = pyramid.levels_.back();
        Level coarser{
            .columns = (finer.columns + 1) / 2, .rows = (finer.rows + 1) / 2, .bounds = {}};
        coarser.bounds.assign(coarser.columns * coarser.rows, kEmpty);
        for (std::size_t row = 0; row < finer.rows; ++row) {
            for (std::size_t column = 0; column < finer.columns; ++column) {
                include(coarser.bounds[(row / 2) * coarser.columns + column / 2],
                        finer.bounds[row * finer.columns + column]);
            }
        }
        pyramid.levels_.push_back(std::move(coarser));
    }
    monitor.report(1.0);
    return pyramid;
}

} // namespace marsview
