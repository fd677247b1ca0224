#include "core/terrain/overview.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace marsview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const Error kCancelled{ErrorCode::Cancelled, "cancelled"};

std::size_t vertexCount(std::size_t samples, std::size_t step)
{
    return (samples - 1 + step - 1) / step + 1;
}

// The mean of the valid samples on the nearest square ring around a void sample that has any, at
// most `reach` away.
double
heightNear(const Heightfield& heightfield, std::size_t column, std::size_t row, std::size_t reach)
{
    const auto c = static_cast<std::ptrdiff_t>(column);
    const auto r = static_cast<std::ptrdiff_t>(row);
    double sum = 0.0;
    int count = 0;
    const auto add = [&](std::ptrdiff_t at_column, std::ptrdiff_t at_row) {
        if (at_column < 0 || at_row < 0 ||
            at_column >= static_cast<std::ptrdiff_t>(heightfield.columns()) ||
            at_row >= static_cast<std::ptrdiff_t>(heightfield.rows())) {
            return;
        }
        const double height = heightfield.sample(static_cast<std::size_t>(at_column),
                                                 static_cast<std::size_t>(at_row));
        if (!std::isnan(height)) {
            sum += height;
            ++count;
        }
    };
    for (std::ptrdiff_t ring = 1; ring <= static_cast<std::ptrdiff_t>(reach); ++ring) {
        for (std::ptrdiff_t i = -ring; i < ring; ++i) {
            add(c + i, r - ring);
            add(c + ring, r + i);
            add(c - i, r + ring);
            add(c - ring, r - i);
        }
        if (count > 0) {
            return sum / count;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

// One row of block averages, and the share of samples that went into each.
struct AverageRow {
    std::vector<float> heights_m; // NaN where the block is void
    std::vector<float> shares;
};

AverageRow averageRow(const Heightfield& heightfield,
                      std::size_t texel_columns,
                      std::size_t texel_row,
                      std::size_t step)
{
    const SampleGrid& samples = heightfield.samples();
    const ElevationScale scale = heightfield.scale();
    const std::size_t row_begin = texel_row * step;
    const std::size_t row_end = std::min(row_begin + step, heightfield.rows());
    AverageRow average{std::vector<float>(texel_columns, kNan),
                       std::vector<float>(texel_columns, 0.0F)};
    std::vector<double> sums(texel_columns, 0.0);
    std::vector<std::uint32_t> counts(texel_columns, 0);
    samples.visit([&](auto view) {
        for (std::size_t row = row_begin; row < row_end; ++row) {
            for (std::size_t i = 0; i < texel_columns; ++i) {
                const std::size_t end = std::min((i + 1) * step, view.columns());
                for (std::size_t column = i * step; column < end; ++column) {
                    if (!samples.isVoid(column, row)) {
                        sums[i] += static_cast<double>(view(column, row));
                        ++counts[i];
                    }
                }
            }
        }
    });
    for (std::size_t i = 0; i < texel_columns; ++i) {
        if (counts[i] > 0) {
            const std::size_t columns = std::min((i + 1) * step, heightfield.columns()) - i * step;
            average.heights_m[i] = static_cast<float>(scale.height(sums[i] / counts[i]));
            average.shares[i] =
                static_cast<float>(counts[i]) / static_cast<float>(columns * (row_end - row_begin));
        }
    }
    return average;
}

// Difference of heights per texel around `here`: central where both neighbours are there, else to
// the one that is. 0 where there is none.
float difference(float before, float here, float after)
{
    const bool has_before = !std::isnan(before);
    const bool has_after = !std::isnan(after);
    if (has_before && has_after) {
        return (after - before) * 0.5F;
    }
    if (has_after) {
        return after - here;
    }
    return has_before ? here - before : 0.0F;
}

std::uint16_t unorm16(float share)
{
    // Never negative, and called for every texel: lround would be a function call.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::uint16_t>(std::clamp(share, 0.0F, 1.0F) * 65535.0F + 0.5F);
}

} // namespace

Result<OverviewGrid>
makeOverview(const Heightfield& heightfield, const OverviewLimits& limits, JobMonitor& monitor)
{
    MARSVIEW_CHECK(limits.triangle_count_max >= 2 && limits.side_max >= 2);
    OverviewGrid grid;
    const auto is_too_fine = [&](std::size_t step) {
        const std::size_t columns = vertexCount(heightfield.columns(), step);
        const std::size_t rows = vertexCount(heightfield.rows(), step);
        return std::max(columns, rows) > limits.side_max ||
               2 * (columns - 1) * (rows - 1) > limits.triangle_count_max;
    };
    while (is_too_fine(grid.step)) {
        ++grid.step;
    }
    grid.columns = vertexCount(heightfield.columns(), grid.step);
    grid.rows = vertexCount(heightfield.rows(), grid.step);
    grid.heights_m.resize(grid.columns * grid.rows);
    if (const auto& range = heightfield.range()) {
        grid.base_height_m = (range->minimum_m + range->maximum_m) / 2.0;
    }
    for (std::size_t j = 0; j < grid.rows; ++j) {
        if (monitor.isCancelled()) {
            return kCancelled;
        }
        const std::size_t row = std::min(j * grid.step, heightfield.rows() - 1);
        for (std::size_t i = 0; i < grid.columns; ++i) {
            const std::size_t column = std::min(i * grid.step, heightfield.columns() - 1);
            double height = heightfield.sample(column, row);
            if (std::isnan(height)) {
                height = heightNear(heightfield, column, row, grid.step);
            }
            grid.height(i, j) = static_cast<float>(height - grid.base_height_m);
        }
    }
    return grid;
}

Result<ReliefMap> makeReliefMap(const Heightfield& heightfield,
                                const SceneFrame& frame,
                                const ReliefOptions& options,
                                JobMonitor& monitor)
{
    MARSVIEW_CHECK(options.side_max >= 2 && options.exaggeration > 0.0);
    ReliefMap map;
    const std::size_t side = std::max(heightfield.columns(), heightfield.rows());
    map.step = (side + options.side_max - 1) / options.side_max;
    map.exaggeration = options.exaggeration;
    map.columns = (heightfield.columns() + map.step - 1) / map.step;
    map.rows = (heightfield.rows() + map.step - 1) / map.step;
    map.texels.resize(4 * map.columns * map.rows);

    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const auto low = static_cast<float>(range.minimum_m);
    const double relief = range.maximum_m - range.minimum_m;
    const float per_metre = relief > 0.0 ? static_cast<float>(1.0 / relief) : 0.0F;

    // Gradients transform by the inverse transpose of the frame's linear part.
    const double step = static_cast<double>(map.step);
    const double determinant = (frame.east_per_column * frame.north_per_row -
                                frame.east_per_row * frame.north_per_column) *
                               step / options.exaggeration;
    const auto east_of_column = static_cast<float>(frame.north_per_row / determinant);
    const auto east_of_row = static_cast<float>(-frame.north_per_column / determinant);
    const auto north_of_column = static_cast<float>(-frame.east_per_row / determinant);
    const auto north_of_row = static_cast<float>(frame.east_per_column / determinant);

    const AverageRow none{std::vector<float>(map.columns, kNan),
                          std::vector<float>(map.columns, 0.0F)};
    AverageRow above = none;
    AverageRow here = averageRow(heightfield, map.columns, 0, map.step);
    for (std::size_t row = 0; row < map.rows; ++row) {
        if (monitor.isCancelled()) {
            return kCancelled;
        }
        monitor.report(static_cast<double>(row) / static_cast<double>(map.rows));
        AverageRow below =
            row + 1 < map.rows ? averageRow(heightfield, map.columns, row + 1, map.step) : none;
        std::uint16_t* texel = map.texels.data() + 4 * row * map.columns;
        for (std::size_t column = 0; column < map.columns; ++column, texel += 4) {
            const float height = here.heights_m[column];
            const float share = here.shares[column];
            map.has_voids = map.has_voids || share < 1.0F;
            if (std::isnan(height)) {
                continue; // all zero
            }
            const float left = column > 0 ? here.heights_m[column - 1] : kNan;
            const float right = column + 1 < map.columns ? here.heights_m[column + 1] : kNan;
            const float per_column = difference(left, height, right);
            const float per_row =
                difference(above.heights_m[column], height, below.heights_m[column]);
            const float slope_east = per_column * east_of_column + per_row * east_of_row;
            const float slope_north = per_column * north_of_column + per_row * north_of_row;
            const float inverse =
                1.0F / std::sqrt(1.0F + slope_east * slope_east + slope_north * slope_north);
            texel[0] = unorm16((0.5F - 0.5F * slope_east * inverse) * share);
            texel[1] = unorm16((0.5F - 0.5F * slope_north * inverse) * share);
            texel[2] = unorm16((height - low) * per_metre * share);
            texel[3] = unorm16(share);
        }
        above = std::move(here);
        here = std::move(below);
    }
    monitor.report(1.0);
    return map;
}

} // namespace marsview
