#include "core/view/tint_range.h"
#include "tests/support/make_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

BlockMeans meansOf(const Heightfield& field)
{
    JobMonitor monitor;
    return BlockMeans::build(field, monitor).value();
}

HeightRange tinted(const Heightfield& field)
{
    return tintRange(meansOf(field), field.range().value());
}

TEST(TintRange, LeavesOutTheRarestHalfPercentOfBlocksAtEitherEnd)
{
    test::Random random;
    constexpr std::size_t kSide = 640;
    const Heightfield field =
        test::floatTerrain(kSide, kSide, [&](auto...) { return random.uniform(-1.0, 1.0); });
    const BlockMeans means = meansOf(field);
    std::vector<float> sorted;
    for (std::size_t row = 0; row < means.means(0).rows(); ++row) {
        const auto line = means.means(0).row(row);
        sorted.insert(sorted.end(), line.begin(), line.end());
    }
    std::sort(sorted.begin(), sorted.end());
    const HeightRange range = tintRange(means, field.range().value());
    const auto below = std::count_if(sorted.begin(), sorted.end(), [&](float height) {
        return static_cast<double>(height) < range.minimum_m;
    });
    const auto above = std::count_if(sorted.begin(), sorted.end(), [&](float height) {
        return static_cast<double>(height) > range.maximum_m;
    });
    EXPECT_EQ(sorted.size(), 6400U);
    EXPECT_EQ(below, 32);
    EXPECT_EQ(above, 32);
}

TEST(TintRange, IsTheWholeRangeOfSmallMaps)
{
    const Heightfield field = test::floatTerrain(
        50, 50, [](std::size_t c, std::size_t) { return static_cast<double>(c); });
    EXPECT_EQ(tinted(field).minimum_m, 0.0);
    EXPECT_EQ(tinted(field).maximum_m, 49.0);
}

TEST(TintRange, IsTheWholeRangeIfASingleElevationWouldRemain)
{
    const Heightfield field = test::floatTerrain(600, 400, [](std::size_t c, std::size_t r) {
        return c >= 200 && c < 211 && r >= 45 && r < 56 ? 30.0 : 10.0;
    });
    EXPECT_EQ(tinted(field).minimum_m, 10.0);
    EXPECT_EQ(tinted(field).maximum_m, 30.0);
}

TEST(TintRange, IgnoresVoids)
{
    const Heightfield field = test::floatTerrain(800, 800, [](std::size_t c, std::size_t r) {
        return r < 500 ? std::nan("") : static_cast<double>(c);
    });
    EXPECT_NEAR(tinted(field).minimum_m, 4.0, 8.0);
    EXPECT_NEAR(tinted(field).maximum_m, 795.0, 8.0);
}

} // namespace
} // namespace marsview
