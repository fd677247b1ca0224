#include "core/view/slope_range.h"
#include "tests/support/make_terrain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

constexpr double kSlopeMax = 16.0;

// The tile at level 0 of a map with cells of one meter.
SlopeRange rangeOf(const Heightfield& field)
{
    const SceneFrame frame = test::northUpFrame(field.columns(), field.rows(), 1.0);
    return slopeRange(makeReliefTile(field, frame, {0, 0, 0}, kSlopeMax), field.columns(),
                      field.rows(), kSlopeMax);
}

// A roof: its two sides are planes with known slopes, and a given share of the map is steeper.
Heightfield roof(double degrees, double steep_degrees, std::size_t steep_rows)
{
    const double slope = std::tan(Angle::degrees(degrees).radians());
    const double steep = std::tan(Angle::degrees(steep_degrees).radians());
    return test::floatTerrain(200, 200, [=](std::size_t c, std::size_t r) {
        return static_cast<double>(c) * (r < steep_rows ? steep : slope);
    });
}

TEST(SlopeRange, EndsAtTheRoundNumberAboveTheSlopesOfTheMap)
{
    EXPECT_EQ(rangeOf(roof(1.4, 1.4, 0)).minimum.degrees(), 0.0);
    EXPECT_NEAR(rangeOf(roof(1.4, 1.4, 0)).maximum.degrees(), 1.5, 1e-9);
    EXPECT_NEAR(rangeOf(roof(12.0, 12.0, 0)).maximum.degrees(), 15.0, 1e-9);
    EXPECT_NEAR(rangeOf(roof(81.0, 81.0, 0)).maximum.degrees(), 90.0, 1e-9);
}

TEST(SlopeRange, LeavesOutTheSteepestHundredth)
{
    // The step between the two parts is a texel wide: columns of slopes along the rows.
    const auto cliff = [](std::size_t cliff_columns) {
        return test::floatTerrain(256, 256, [=](std::size_t c, std::size_t) {
            const std::size_t steep = std::min(c, cliff_columns);
            return 3.0 * static_cast<double>(steep) + 0.01 * static_cast<double>(c);
        });
    };
    EXPECT_NEAR(rangeOf(cliff(1)).maximum.degrees(), 0.6, 1e-9); // at most two columns of 256
    EXPECT_GT(rangeOf(cliff(8)).maximum.degrees(), 50.0);
}

TEST(SlopeRange, IsNotEmptyForLevelTerrain)
{
    const SlopeRange range = rangeOf(roof(0.0, 0.0, 0));
    EXPECT_NEAR(range.maximum.degrees(), 0.1, 1e-9);
}

TEST(SlopeRange, CountsOnlyTexelsOfTheMap)
{
    // 40 of the tile's 256 rows are on the map; the last row, a tenth of it, is steep.
    const Heightfield field = test::floatTerrain(256, 40, [](std::size_t c, std::size_t r) {
        const double slope = r == 39 && c < 20 ? 2.0 : 0.02;
        return slope * static_cast<double>(c);
    });
    const SceneFrame frame = test::northUpFrame(256, 40, 1.0);
    const ReliefTile tile = makeReliefTile(field, frame, {0, 0, 0}, kSlopeMax);
    EXPECT_GT(slopeRange(tile, 256, 256, kSlopeMax).maximum.degrees(), 10.0)
        << "beyond the map the tile repeats its last row";
    EXPECT_LT(slopeRange(tile, 256, 40, kSlopeMax).maximum.degrees(),
              slopeRange(tile, 256, 256, kSlopeMax).maximum.degrees());
}

TEST(SlopeRange, LeavesOutVoids)
{
    const Heightfield field = test::floatTerrain(200, 200, [](std::size_t c, std::size_t r) {
        return r > 20 ? std::nan("") : 0.03 * static_cast<double>(c);
    });
    EXPECT_NEAR(rangeOf(field).maximum.degrees(), 2.0, 1e-9);
}

TEST(SlopeHistogram, CountsTheTexelsOfEachSlope)
{
    // 50 of 200 rows rise by 20 degrees, the others by 10.
    const Heightfield field = roof(10.0, 20.0, 50);
    const SceneFrame frame = test::northUpFrame(field.columns(), field.rows(), 1.0);
    const SlopeHistogram histogram = slopeHistogram(
        makeReliefTile(field, frame, {0, 0, 0}, kSlopeMax), field.columns(), 49, kSlopeMax, 4);
    ASSERT_EQ(histogram.counts.size(), 4U);
    EXPECT_NEAR(histogram.maximum.degrees(), 20.0, 0.1);
    EXPECT_EQ(histogram.counts[3], 200U * 49U) << "49 rows of the steep part";
    const SlopeHistogram below =
        slopeHistogram(makeReliefTile(roof(10.0, 10.0, 0), frame, {0, 0, 0}, kSlopeMax),
                       field.columns(), field.rows(), kSlopeMax, 4);
    EXPECT_NEAR(below.maximum.degrees(), 10.0, 0.1);
    EXPECT_EQ(below.counts[0] + below.counts[1] + below.counts[2] + below.counts[3], 200U * 200U);
}

TEST(SlopeHistogram, HandlesLevelTerrainAndVoids)
{
    const Heightfield level = roof(0.0, 0.0, 0);
    const SceneFrame frame = test::northUpFrame(level.columns(), level.rows(), 1.0);
    const SlopeHistogram flat = slopeHistogram(makeReliefTile(level, frame, {0, 0, 0}, kSlopeMax),
                                               level.columns(), level.rows(), kSlopeMax, 4);
    EXPECT_EQ(flat.maximum, Angle());
    EXPECT_EQ(flat.counts[0], 200U * 200U);
    ReliefTile voids = makeReliefTile(level, frame, {0, 0, 0}, kSlopeMax);
    for (ReliefTexel& texel : voids.levels.front().texels) {
        texel = {};
    }
    EXPECT_TRUE(slopeHistogram(voids, 200, 200, kSlopeMax).counts.empty());
}

} // namespace
} // namespace marsview
