#include "core/terrain/height_histogram.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

std::size_t dividedUp(std::size_t count, std::size_t stride)
{
    return (count + stride - 1) / stride;
}

// Strides that are equal both ways: a stride along the samples as they are stored could keep to a
// few columns.
std::size_t strideFor(std::size_t columns, std::size_t rows, std::size_t sample_count_max)
{
    const double share = static_cast<double>(columns) * static_cast<double>(rows) /
                         static_cast<double>(sample_count_max);
    auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(share)));
    while (dividedUp(columns, stride) * dividedUp(rows, stride) > sample_count_max) {
        ++stride;
    }
    return stride;
}

} // namespace

HeightHistogram heightHistogram(const Heightfield& heights, const HistogramOptions& options)
{
    MARSVIEW_CHECK(options.bin_count > 0 && options.sample_count_max > 0);
    HeightHistogram histogram;
    if (!heights.range()) {
        return histogram;
    }
    histogram.range = *heights.range();
    histogram.counts.assign(options.bin_count, 0);
    histogram.stride = strideFor(heights.columns(), heights.rows(), options.sample_count_max);
    const double low = histogram.range.minimum_m;
    const double extent = histogram.range.maximum_m - low;
    const double bins_per_metre =
        extent > 0.0 ? static_cast<double>(options.bin_count) / extent : 0.0;
    for (std::size_t row = 0; row < heights.rows(); row += histogram.stride) {
        for (std::size_t column = 0; column < heights.columns(); column += histogram.stride) {
            const double height = heights.sample(column, row);
            if (std::isnan(height)) {
                continue;
            }
            const auto bin =
                static_cast<std::size_t>(std::max(0.0, (height - low) * bins_per_metre));
            ++histogram.counts[std::min(bin, options.bin_count - 1)];
            ++histogram.sample_count;
        }
    }
    return histogram;
}

} // namespace marsview
