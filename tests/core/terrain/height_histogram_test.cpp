#include "core/terrain/height_histogram.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace marsview {
namespace {

Heightfield
surfaceOf(std::size_t columns, const std::vector<float>& samples, const ElevationScale& scale = {})
{
    const std::size_t rows = samples.size() / columns;
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t r = 0; r < rows; ++r) {
        std::memcpy(grid.rowData(r), samples.data() + r * columns, columns * sizeof(float));
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    return {std::make_shared<const SampleGrid>(std::move(grid)), statistics, scale};
}

std::uint64_t total(const HeightHistogram& histogram)
{
    return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
}

TEST(HeightHistogram, CountsEverySampleOfASmallMapInItsBin)
{
    test::Random random;
    std::vector<float> samples(70 * 50);
    for (float& sample : samples) {
        sample = random.chance(0.1) ? static_cast<float>(kNan)
                                    : static_cast<float>(random.uniform(-8000.0, 21000.0));
    }
    const Heightfield heights = surfaceOf(70, samples, {.gain = -0.5, .offset_m = 100.0});
    const HeightHistogram histogram = heightHistogram(heights, {.bin_count = 29});
    EXPECT_EQ(histogram.stride, 1U);
    ASSERT_EQ(histogram.counts.size(), 29U);
    EXPECT_EQ(histogram.range.minimum_m, heights.range()->minimum_m);
    EXPECT_EQ(histogram.range.maximum_m, heights.range()->maximum_m);
    // By the bin edges instead of by division.
    const double step = (histogram.range.maximum_m - histogram.range.minimum_m) / 29.0;
    for (std::size_t bin = 0; bin < 29; ++bin) {
        const double low = histogram.range.minimum_m + static_cast<double>(bin) * step;
        std::uint64_t sure = 0;
        std::uint64_t on_edge = 0;
        for (const float sample : samples) {
            const double height = static_cast<double>(sample) * -0.5 + 100.0;
            const bool is_near_edge =
                std::abs(height - low) < 1e-6 || std::abs(height - low - step) < 1e-6;
            on_edge += is_near_edge ? 1 : 0;
            sure += !is_near_edge && height > low && height < low + step ? 1 : 0;
        }
        EXPECT_GE(histogram.counts[bin], sure) << bin;
        EXPECT_LE(histogram.counts[bin], sure + on_edge) << bin;
    }
    EXPECT_EQ(total(histogram), histogram.sample_count);
}

TEST(HeightHistogram, CountsNoMoreSamplesThanAllowed)
{
    test::Random random;
    for (int i = 0; i < 200; ++i) {
        const std::size_t columns = 2 + random.below(random.chance(0.3) ? 3000 : 60);
        const std::size_t rows = 2 + random.below(random.chance(0.3) ? 300 : 60);
        const std::size_t most = 1 + random.below(5000);
        const HeightHistogram histogram =
            heightHistogram(surfaceOf(columns, std::vector<float>(columns * rows, 5.0F)),
                            {.bin_count = 8, .sample_count_max = most});
        const auto looked = [&](std::size_t stride) {
            return ((columns - 1) / stride + 1) * ((rows - 1) / stride + 1);
        };
        EXPECT_EQ(histogram.sample_count, looked(histogram.stride));
        EXPECT_LE(histogram.sample_count, most);
        if (histogram.stride > 1) {
            EXPECT_GT(looked(histogram.stride - 1), most); // no sparser than necessary
        }
    }
}

TEST(HeightHistogram, OnALargeMapIsCloseToThatOfAllSamples)
{
    test::Random random;
    std::vector<float> samples(1000 * 700);
    for (float& sample : samples) {
        sample = static_cast<float>(random.uniform(0.0, 1.0) + random.uniform(0.0, 1.0));
    }
    const Heightfield heights = surfaceOf(1000, samples);
    const HeightHistogram all = heightHistogram(heights, {.bin_count = 10});
    const HeightHistogram some =
        heightHistogram(heights, {.bin_count = 10, .sample_count_max = 20000});
    EXPECT_GT(some.stride, 5U);
    for (std::size_t i = 0; i < 10; ++i) {
        const double share_all = static_cast<double>(all.counts[i]) / 700000.0;
        const double share_some =
            static_cast<double>(some.counts[i]) / static_cast<double>(some.sample_count);
        EXPECT_NEAR(share_some, share_all, 0.02) << i; // six standard deviations
    }
}

TEST(HeightHistogram, HandlesFlatMapsAndVoids)
{
    const HeightHistogram flat = heightHistogram(surfaceOf(3, std::vector<float>(9, -7.0F)));
    EXPECT_EQ(flat.counts[0], 9U);
    EXPECT_EQ(total(flat), 9U);
    const HeightHistogram none =
        heightHistogram(surfaceOf(3, std::vector<float>(9, static_cast<float>(kNan))));
    EXPECT_TRUE(none.counts.empty());
    EXPECT_EQ(none.sample_count, 0U);
}

} // namespace
} // namespace marsview
