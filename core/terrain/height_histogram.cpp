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

// Equal strides along both axes: a stride in storage order could select only a few columns.
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

class Counter {
public:
    explicit Counter(HeightHistogram& histogram)
        : histogram_(histogram)
        , low_(histogram.range.minimum_m)
        , bins_per_meter_(perMeter(histogram))
    {}

    // NaN is ignored.
    void add(double height_m)
    {
        if (std::isnan(height_m)) {
            return;
        }
        const auto bin =
            static_cast<std::size_t>(std::max(0.0, (height_m - low_) * bins_per_meter_));
        ++histogram_.counts[std::min(bin, histogram_.counts.size() - 1)];
        ++histogram_.sample_count;
    }

private:
    static double perMeter(const HeightHistogram& histogram)
    {
        const double extent = histogram.range.maximum_m - histogram.range.minimum_m;
        return extent > 0.0 ? static_cast<double>(histogram.counts.size()) / extent : 0.0;
    }

    HeightHistogram& histogram_;
    double low_;
    double bins_per_meter_;
};

// One level of the samples, the finest with few enough. Tiles that cannot be read are ignored.
void countTiles(const Heightfield& heights,
                const HistogramOptions& options,
                HeightHistogram& histogram)
{
    const TiledRaster& raster = heights.tiles()->raster();
    const TileLayout& layout = raster.layout();
    std::size_t level = 0;
    while (level < layout.topLevel() &&
           layout.columnsAt(TileKind::Samples, level) * layout.rowsAt(TileKind::Samples, level) >
               options.sample_count_max) {
        ++level;
    }
    histogram.stride = std::size_t{1} << level;
    Counter counter(histogram);
    for (std::size_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
        for (std::size_t column = 0; column < layout.tileColumns(TileKind::Samples, level);
             ++column) {
            if (options.monitor != nullptr && options.monitor->isCanceled()) {
                return;
            }
            const auto tile = raster.get({.kind = TileKind::Samples,
                                          .level = static_cast<std::uint8_t>(level),
                                          .column = static_cast<std::uint32_t>(column),
                                          .row = static_cast<std::uint32_t>(row)});
            if (!tile) {
                continue;
            }
            const SampleGrid& samples = (*tile)->samples;
            for (std::size_t j = 0; j < samples.rows(); ++j) {
                for (std::size_t i = 0; i < samples.columns(); ++i) {
                    if (!samples.isVoid(i, j)) {
                        counter.add(heights.scale().height(samples.raw(i, j)));
                    }
                }
            }
        }
    }
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
    if (heights.isTiled()) {
        countTiles(heights, options, histogram);
        return histogram;
    }
    histogram.stride = strideFor(heights.columns(), heights.rows(), options.sample_count_max);
    Counter counter(histogram);
    for (std::size_t row = 0; row < heights.rows(); row += histogram.stride) {
        for (std::size_t column = 0; column < heights.columns(); column += histogram.stride) {
            counter.add(heights.sample(column, row));
        }
    }
    return histogram;
}

} // namespace marsview
