#include "core/view/color_stretch.h"
#include "tests/support/make_terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview {
namespace {

constexpr HeightRange kAutomatic{.minimum_m = 3.0, .maximum_m = 4.0};

HeightRange stretched(const Heightfield& field, const ColorStretch& stretch)
{
    JobMonitor monitor;
    const BlockMeans means = BlockMeans::build(field, monitor).value();
    return stretchedRange(stretch, {.heights = field, .means = means, .automatic = kAutomatic});
}

// Elevations 0 … 9999, each once, in an order unrelated to the blocks.
Heightfield shuffledNumbers()
{
    return test::floatTerrain(100, 100, [](std::size_t c, std::size_t r) {
        return static_cast<double>((7919 * (100 * r + c)) % 10000);
    });
}

TEST(ColorStretch, DefaultsToTheAutomaticRange)
{
    const HeightRange range = stretched(shuffledNumbers(), {});
    EXPECT_EQ(range.minimum_m, kAutomatic.minimum_m);
    EXPECT_EQ(range.maximum_m, kAutomatic.maximum_m);
}

TEST(ColorStretch, IsTheWholeRangeOnRequest)
{
    const HeightRange range = stretched(shuffledNumbers(), {.kind = StretchKind::Full});
    EXPECT_EQ(range.minimum_m, 0.0);
    EXPECT_EQ(range.maximum_m, 9999.0);
}

TEST(ColorStretch, CutsThePercentageOfSamplesAtEitherEnd)
{
    const Heightfield field = shuffledNumbers();
    for (const double percent : {0.0, 0.5, 2.0, 10.0, 25.0, 45.0}) {
        const HeightRange range =
            stretched(field, {.kind = StretchKind::Percentile, .cut_percent = percent});
        EXPECT_EQ(range.minimum_m, percent * 100.0) << percent;
        EXPECT_EQ(range.maximum_m, 9999.0 - percent * 100.0) << percent;
    }
}

TEST(ColorStretch, IgnoresNodata)
{
    const Heightfield field = test::floatTerrain(100, 100, [](std::size_t c, std::size_t r) {
        return r < 50 ? std::nan("") : static_cast<double>(100 * (r - 50) + c);
    });
    const HeightRange range =
        stretched(field, {.kind = StretchKind::Percentile, .cut_percent = 10.0});
    EXPECT_EQ(range.minimum_m, 500.0);
    EXPECT_EQ(range.maximum_m, 4499.0);
}

TEST(ColorStretch, IsTheWholeRangeIfAPercentileLeavesOneElevation)
{
    const Heightfield field = test::floatTerrain(
        100, 100, [](std::size_t c, std::size_t r) { return c == 3 && r == 4 ? 80.0 : 10.0; });
    const HeightRange range =
        stretched(field, {.kind = StretchKind::Percentile, .cut_percent = 2.0});
    EXPECT_EQ(range.minimum_m, 10.0);
    EXPECT_EQ(range.maximum_m, 80.0);
}

TEST(ColorStretch, StaysOneElevationOnAConstantMap)
{
    const Heightfield field = test::floatTerrain(30, 30, [](auto...) { return 7.0; });
    for (const StretchKind kind : {StretchKind::Full, StretchKind::Percentile}) {
        const HeightRange range = stretched(field, {.kind = kind});
        EXPECT_EQ(range.minimum_m, 7.0);
        EXPECT_EQ(range.maximum_m, 7.0);
    }
}

TEST(ColorStretch, KeepsFixedEndsBeyondTheMap)
{
    const HeightRange range = stretched(shuffledNumbers(), fixedStretch(-500.0, 20000.0));
    EXPECT_EQ(range.minimum_m, -500.0);
    EXPECT_EQ(range.maximum_m, 20000.0);
}

TEST(ColorStretch, RefusesEndsThatAreNotARange)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(isStretchRange(-1.0, 1.0));
    EXPECT_TRUE(isStretchRange(0.0, 1e-9));
    EXPECT_FALSE(isStretchRange(1.0, 1.0));
    EXPECT_FALSE(isStretchRange(2.0, 1.0));
    EXPECT_FALSE(isStretchRange(kNan, 1.0));
    EXPECT_FALSE(isStretchRange(0.0, kInfinity));
    EXPECT_FALSE(isStretchRange(1e9, std::nextafter(1e9, 2e9)));
}

} // namespace
} // namespace marsview
