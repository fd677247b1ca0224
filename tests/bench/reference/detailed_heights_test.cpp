#include "app/bench/reference/detailed_heights.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace marsview {
namespace {

using test::Random;

constexpr std::size_t kColumns = 40;
constexpr std::size_t kRows = 30;

std::vector<float> flat(float height)
{
    return std::vector<float>(kColumns * kRows, height);
}

std::vector<float> rough(Random& random, double relief_m)
{
    std::vector<float> heights(kColumns * kRows);
    for (float& height : heights) {
        height = static_cast<float>(random.uniform(-relief_m, relief_m));
    }
    return heights;
}

DetailedHeights detailed(const std::vector<float>& heights, const DetailedHeightsOptions& options)
{
    return {GridView<const float>(heights.data(), kColumns, kRows), options};
}

std::vector<std::int16_t> windowOf(const DetailedHeights& heights,
                                   std::size_t column,
                                   std::size_t row,
                                   std::size_t columns,
                                   std::size_t rows)
{
    std::vector<std::int16_t> samples(columns * rows);
    heights.window(column, row, GridView<std::int16_t>(samples.data(), columns, rows));
    return samples;
}

std::vector<std::int16_t> wholeOf(const DetailedHeights& heights)
{
    return windowOf(heights, 0, 0, heights.columns(), heights.rows());
}

// Root mean square of the differences over `distance` rows.
double rootMeanSquareDifference(const std::vector<std::int16_t>& samples,
                                std::size_t columns,
                                std::size_t distance)
{
    const std::size_t lag = distance * columns;
    double sum = 0.0;
    for (std::size_t i = lag; i < samples.size(); ++i) {
        const double difference = samples[i] - samples[i - lag];
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(samples.size() - lag));
}

std::uint64_t hashOf(const std::vector<std::int16_t>& samples)
{
    std::uint64_t hash = 0xcbf29ce484222325U; // FNV-1a
    for (const std::int16_t sample : samples) {
        hash = (hash ^ static_cast<std::uint16_t>(sample)) * 0x100000001b3U;
    }
    return hash;
}

} // namespace

TEST(DetailedHeights, AnyWindowComputedAloneHasTheSameBits)
{
    Random random;
    for (const bool wraps_around : {false, true}) {
        const DetailedHeights heights =
            detailed(rough(random, 400.0),
                     {.columns = 1111, .rows = 777, .seed = 5, .wraps_around = wraps_around});
        const std::vector<std::int16_t> whole = wholeOf(heights);
        for (int i = 0; i < 60; ++i) {
            const std::size_t columns = 1 + random.below(i % 2 == 0 ? 20 : 400);
            const std::size_t rows = 1 + random.below(i % 3 == 0 ? 20 : 300);
            const std::size_t column = random.below(heights.columns() - columns + 1);
            const std::size_t row = random.below(heights.rows() - rows + 1);
            const std::vector<std::int16_t> window = windowOf(heights, column, row, columns, rows);
            for (std::size_t r = 0; r < rows; ++r) {
                ASSERT_EQ(std::memcmp(window.data() + r * columns,
                                      whole.data() + (row + r) * heights.columns() + column,
                                      columns * sizeof(std::int16_t)),
                          0)
                    << columns << " × " << rows << " at " << column << ", " << row << " + " << r;
            }
        }
    }
}

TEST(DetailedHeights, AreTheSameOnEveryMachine)
{
    std::vector<float> heights(kColumns * kRows);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        heights[i] = static_cast<float>((i * 7919) % 997) - 500.0F;
    }
    EXPECT_EQ(hashOf(wholeOf(detailed(heights, {.columns = 1000, .rows = 900, .seed = 42}))),
              15967326983371935708U);
}

TEST(DetailedHeights, AnotherSeedGivesOtherDetailOnTheSameTerrain)
{
    Random random;
    const std::vector<float> land = rough(random, 300.0);
    const auto with_seed = [&](std::uint64_t seed) {
        return wholeOf(detailed(land, {.columns = 800, .rows = 600, .seed = seed}));
    };
    const auto first = with_seed(1);
    const auto second = with_seed(2);
    EXPECT_EQ(first, with_seed(1));
    double land_energy = 0.0;
    double detail_energy = 0.0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const double mean = (first[i] + second[i]) / 2.0;
        land_energy += mean * mean;
        detail_energy += (first[i] - mean) * (first[i] - mean);
        same += first[i] == second[i] ? 1U : 0U;
    }
    EXPECT_LT(same, first.size() / 20);
    EXPECT_LT(detail_energy, 0.5 * land_energy);
    EXPECT_GT(detail_energy, 0.01 * land_energy);
}

TEST(DetailedHeights, PlainsAndStraightSlopesStaySmooth)
{
    for (const std::int16_t z : wholeOf(detailed(flat(1234.0F), {.columns = 900, .rows = 500}))) {
        ASSERT_EQ(z, 1234);
    }
    std::vector<float> slope(kColumns * kRows);
    for (std::size_t i = 0; i < slope.size(); ++i) {
        slope[i] =
            100.0F * static_cast<float>(i / kColumns) - 30.0F * static_cast<float>(i % kColumns);
    }
    const DetailedHeights heights = detailed(slope, {.columns = 400, .rows = 300});
    const auto samples = wholeOf(heights);
    for (std::size_t r = 20; r < 280; ++r) { // the bends at the border itself are excluded
        for (std::size_t c = 20; c < 380; ++c) {
            const double down = (static_cast<double>(r) + 0.5) / 10.0 - 0.5;
            const double across = (static_cast<double>(c) + 0.5) / 10.0 - 0.5;
            ASSERT_NEAR(samples[r * 400 + c], 100.0 * down - 30.0 * across, 0.51) << c << ", " << r;
        }
    }
}

TEST(DetailedHeights, OnlyRoughTerrainGetsRoughDetail)
{
    Random random;
    std::vector<float> land = rough(random, 500.0);
    for (std::size_t i = 0; i < land.size(); ++i) {
        land[i] *= i % kColumns < kColumns / 2 ? 0.01F : 1.0F;
    }
    const DetailedHeights heights = detailed(land, {.columns = 1600, .rows = 1200});
    const auto calm = windowOf(heights, 100, 100, 400, 1000);
    const auto wild = windowOf(heights, 1100, 100, 400, 1000);
    EXPECT_GT(rootMeanSquareDifference(wild, 400, 2),
              20.0 * rootMeanSquareDifference(calm, 400, 2));
}

TEST(DetailedHeights, ContinueThePowerLawOfTheMap)
{
    // Terrain whose differences follow a power law is generated by this class from coarse noise.
    // The map is every 16th of its samples; the differences between the added samples must match
    // those of the original terrain.
    Random random;
    const DetailedHeights land =
        detailed(rough(random, 4000.0), {.columns = 2560, .rows = 1920, .seed = 3});
    const std::vector<std::int16_t> truth = wholeOf(land);
    const std::size_t columns = 160;
    const std::size_t rows = 120;
    std::vector<float> map(columns * rows);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            map[r * columns + c] = truth[(16 * r + 8) * 2560 + 16 * c + 8];
        }
    }
    const DetailedHeights made(GridView<const float>(map.data(), columns, rows),
                               {.columns = 2560, .rows = 1920, .seed = 4});
    EXPECT_NEAR(made.halvingRatio(), std::sqrt(0.5), 0.1);
    const std::vector<std::int16_t> detail = wholeOf(made);
    for (const std::size_t distance : {1U, 2U, 4U, 8U, 16U}) {
        const double expected = rootMeanSquareDifference(truth, 2560, distance);
        const double found = rootMeanSquareDifference(detail, 2560, distance);
        EXPECT_GT(found, 0.6 * expected) << distance;
        EXPECT_LT(found, 1.5 * expected) << distance;
    }
}

TEST(DetailedHeights, AWrappingMapHasNoStepAtItsSeam)
{
    Random random;
    const std::vector<float> land = rough(random, 500.0);
    const auto step_ratio = [&](bool wraps_around) {
        const std::size_t columns = 1600;
        const auto samples = wholeOf(detailed(
            land, {.columns = columns, .rows = 1200, .seed = 9, .wraps_around = wraps_around}));
        double seam = 0.0;
        double inside = 0.0;
        for (std::size_t r = 0; r < 1200; ++r) {
            const std::int16_t* row = samples.data() + r * columns;
            seam += std::abs(row[0] - row[columns - 1]);
            inside += std::abs(row[701] - row[700]);
        }
        return seam / inside;
    };
    EXPECT_LT(step_ratio(true), 1.5);
    EXPECT_GT(step_ratio(false), 5.0);
}

TEST(DetailedHeights, StayWithinTheRangeOfTheirType)
{
    const auto high = wholeOf(detailed(flat(1e6F), {.columns = 60, .rows = 60}));
    EXPECT_EQ(*std::min_element(high.begin(), high.end()), 32767);
    const auto low = wholeOf(detailed(flat(-1e6F), {.columns = 60, .rows = 60}));
    EXPECT_EQ(*std::max_element(low.begin(), low.end()), -32768);
}

TEST(DetailedHeights, KeepTheMapsSamplesIfItIsNotEnlarged)
{
    Random random;
    std::vector<float> land = rough(random, 400.0);
    for (float& height : land) {
        height = std::round(height);
    }
    const DetailedHeights heights = detailed(land, {.columns = kColumns, .rows = kRows});
    EXPECT_EQ(heights.octaveCount(), 0U);
    const auto samples = wholeOf(heights);
    for (std::size_t i = 0; i < land.size(); ++i) {
        ASSERT_EQ(samples[i], static_cast<int>(land[i])) << i;
    }
}

} // namespace marsview
