#include "core/terrain/heightfield.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace marsview {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Heightfield surfaceOf(std::size_t columns,
                      const std::vector<float>& samples,
                      const ElevationScale& scale = {},
                      const VoidRule& voids = {})
{
    const std::size_t rows = samples.size() / columns;
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t r = 0; r < rows; ++r) {
        std::memcpy(grid.rowData(r), samples.data() + r * columns, columns * sizeof(float));
    }
    const SampleStatistics statistics = grid.applyRule(voids, 0, rows);
    return {std::make_shared<const SampleGrid>(std::move(grid)), statistics, scale};
}

std::vector<float> noise(test::Random& random, std::size_t count)
{
    std::vector<float> samples(count);
    for (float& sample : samples) {
        sample = static_cast<float>(random.uniform(-8000.0, 21000.0));
    }
    return samples;
}

TEST(Heightfield, IsExactAtIntegerPositions)
{
    test::Random random;
    const std::vector<float> samples = noise(random, 37 * 23);
    const ElevationScale scale{0.3048, -17.5};
    const Heightfield surface = surfaceOf(37, samples, scale);
    for (std::size_t r = 0; r < 23; ++r) {
        for (std::size_t c = 0; c < 37; ++c) {
            const double expected = static_cast<double>(samples[r * 37 + c]) * 0.3048 - 17.5;
            EXPECT_EQ(surface.sample(c, r), expected);
            EXPECT_EQ(surface.height({static_cast<double>(c), static_cast<double>(r)}), expected);
        }
    }
}

TEST(Heightfield, InterpolatesOnTheTriangulation)
{
    test::Random random;
    const std::vector<float> samples = noise(random, 37 * 23);
    const Heightfield surface = surfaceOf(37, samples);
    for (int i = 0; i < 20000; ++i) {
        const double x = random.uniform(0.0, 36.0);
        const double y = random.uniform(0.0, 22.0);
        const auto c = static_cast<std::size_t>(x);
        const auto r = static_cast<std::size_t>(y);
        const auto z = [&](std::size_t column, std::size_t row) {
            return static_cast<long double>(samples[row * 37 + column]);
        };
        const long double expected =
            test::planeHeight({z(c, r), z(c + 1, r), z(c, r + 1), z(c + 1, r + 1)},
                              x - static_cast<double>(c), y - static_cast<double>(r));
        ASSERT_NEAR(surface.height({x, y}), static_cast<double>(expected), 4.0 * 0x1p-38);
    }
}

TEST(Heightfield, TheLastRowAndColumnBelongToTheSurface)
{
    const Heightfield surface = surfaceOf(3, {0, 1, 2, 10, 11, 12});
    EXPECT_EQ(surface.height({2.0, 1.0}), 12.0);
    EXPECT_EQ(surface.height({2.0, 0.5}), 7.0);
    EXPECT_EQ(surface.height({0.5, 1.0}), 10.5);
}

TEST(Heightfield, IsNanOutsideAndForNan)
{
    const Heightfield surface = surfaceOf(3, {0, 1, 2, 10, 11, 12});
    const double past_column = std::nextafter(2.0, 3.0);
    const double past_row = std::nextafter(1.0, 2.0);
    const double before = -std::numeric_limits<double>::denorm_min();
    for (const GridPoint p :
         {GridPoint{past_column, 0.0}, GridPoint{0.0, past_row}, GridPoint{before, 0.0},
          GridPoint{0.0, before}, GridPoint{kNan, 0.0}, GridPoint{0.0, kNan}, GridPoint{kInf, 0.0},
          GridPoint{-kInf, 0.0}, GridPoint{0.0, kInf}, GridPoint{1e300, 1e300},
          GridPoint{-1e300, 0.0}}) {
        EXPECT_TRUE(std::isnan(surface.height(p))) << p.column << " " << p.row;
    }
    EXPECT_EQ(surface.height({-0.0, -0.0}), 0.0);
}

TEST(Heightfield, VoidsAreNanWithoutAffectingNeighbors)
{
    const Heightfield surface =
        surfaceOf(3, {0, 1, 2, 10, -9999, 12, 20, 21, 22}, {}, {.nodata = -9999.0});
    EXPECT_TRUE(std::isnan(surface.sample(1, 1)));
    EXPECT_TRUE(std::isnan(surface.height({1.0, 1.0})));
    EXPECT_TRUE(std::isnan(surface.height({0.5, 0.5}))); // the diagonal ends in the void
    EXPECT_TRUE(std::isnan(surface.height({1.25, 0.75})));
    EXPECT_EQ(surface.height({1.0, 0.0}), 1.0);
    EXPECT_EQ(surface.height({0.0, 1.5}), 15.0);
    EXPECT_EQ(surface.height({2.0, 0.5}), 7.0);
    EXPECT_TRUE(std::isnan(surface.height({1.25, 1.0})));
    // Between (1, 0), (2, 0) and (2, 1), none of which is void.
    EXPECT_EQ(surface.height({1.5, 0.25}), 0.5 * 1 + 0.25 * 2 + 0.25 * 12);
}

TEST(Heightfield, RangeMatchesTheHeights)
{
    const std::vector<float> samples{5, 1, -2, 10, -9999, 12};
    const VoidRule voids{-9999.0};
    const Heightfield up = surfaceOf(3, samples, {2.0, 100.0}, voids);
    ASSERT_TRUE(up.range());
    EXPECT_EQ(up.range()->minimum_m, 96.0);
    EXPECT_EQ(up.range()->maximum_m, 124.0);
    const Heightfield down = surfaceOf(3, samples, {-2.0, 100.0}, voids); // depths
    ASSERT_TRUE(down.range());
    EXPECT_EQ(down.range()->minimum_m, 76.0);
    EXPECT_EQ(down.range()->maximum_m, 104.0);
    EXPECT_FALSE(surfaceOf(2, {-9999, -9999, -9999, -9999}, {}, voids).range());
}

TEST(HeightfieldDeathTest, RefusesFewerThanTwoByTwoSamples)
{
    EXPECT_DEATH(surfaceOf(1, {1, 2, 3}), "check failed");
    EXPECT_DEATH(surfaceOf(3, {1, 2, 3}), "check failed");
}

} // namespace
} // namespace marsview
