// Slope and aspect against closed forms: planes with a known slope on the ground.
#include "core/terrain/surface_slope.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace marsview {
namespace {

using test::MapMaker;

constexpr double kDegree = std::numbers::pi / 180.0;

std::optional<SurfaceSlope> slopeOf(const std::shared_ptr<const Map>& map, GridPoint grid)
{
    return slopeAt(map->heightfield(), map->georeference(), grid);
}

// Gradients eastward and northward.
struct Rise {
    double east;
    double north;

    double slopeDegrees() const { return std::atan(std::hypot(east, north)) / kDegree; }
    // Downhill direction as a compass bearing.
    double aspectDegrees() const
    {
        const double degrees = std::atan2(-east, -north) / kDegree;
        return degrees < 0.0 ? degrees + 360.0 : degrees;
    }
};

TEST(SurfaceSlope, IsThatOfAPlaneOnAMapWithoutCrs)
{
    MapMaker maker;
    for (const Rise rise : {Rise{0.3, 0.0}, Rise{-0.3, 0.0}, Rise{0.0, 0.2}, Rise{0.0, -1.5},
                            Rise{0.1, 0.4}, Rise{-2.0, 0.5}}) {
        const std::shared_ptr<const Map> map = maker.make({}, [&](std::size_t c, std::size_t r) {
            return 30.0 *
                   (rise.east * static_cast<double>(c) - rise.north * static_cast<double>(r));
        });
        for (const GridPoint grid : {GridPoint{7.3, 4.2}, GridPoint{7.2, 4.9}, GridPoint{0.0, 0.0},
                                     GridPoint{19.0, 14.0}}) {
            const auto slope = slopeOf(map, grid);
            ASSERT_TRUE(slope);
            EXPECT_NEAR(slope->slope.degrees(), rise.slopeDegrees(), 1e-4);
            ASSERT_TRUE(slope->aspect);
            EXPECT_NEAR(slope->aspect->degrees(), rise.aspectDegrees(), 1e-4);
        }
    }
}

// The length of a degree decreases with the cosine of the latitude along a parallel, and follows
// the meridian's radius of curvature along a meridian.
TEST(SurfaceSlope, UsesMetersOnTheEllipsoidForMapsInDegrees)
{
    MapMaker maker;
    constexpr double kEquatorial = 6378137.0; // WGS 84
    constexpr double kFlattening = 1.0 / 298.257223563;
    constexpr double kE2 = kFlattening * (2.0 - kFlattening);
    constexpr double kCell = 1.0 / 1200.0;
    for (const double top : {0.05, 46.2, -60.0, 80.0}) {
        const double latitude = (top - 7.5 * kCell) * kDegree; // of row 7
        const double w = std::sqrt(1.0 - kE2 * std::sin(latitude) * std::sin(latitude));
        const double east_m = kEquatorial / w * std::cos(latitude) * kDegree * kCell;
        const double north_m = kEquatorial * (1.0 - kE2) / (w * w * w) * kDegree * kCell;
        const Rise rise{0.25, -0.4};
        const std::shared_ptr<const Map> map =
            maker.make({.transform = {-122.0, kCell, 0.0, top, 0.0, -kCell}, .srs = "EPSG:4326"},
                       [&](std::size_t c, std::size_t r) {
                           return rise.east * east_m * static_cast<double>(c) -
                                  rise.north * north_m * static_cast<double>(r);
                       });
        for (const GridPoint grid : {GridPoint{10.5, 7.0}, GridPoint{3.2, 7.01}}) {
            const auto slope = slopeOf(map, grid);
            ASSERT_TRUE(slope);
            EXPECT_NEAR(slope->slope.degrees(), rise.slopeDegrees(), 2e-3) << top;
            EXPECT_NEAR(slope->aspect->degrees(), rise.aspectDegrees(), 5e-3) << top;
        }
    }
}

TEST(SurfaceSlope, IsThatOfTheSphereOnMars)
{
    MapMaker maker;
    constexpr double kRadius = 3396190.0;
    const double per_degree = kRadius * kDegree;
    const double latitude = 60.0 - 0.25 * 7.5;
    const std::shared_ptr<const Map> map =
        maker.make({.transform = {200.0, 0.25, 0.0, 60.0, 0.0, -0.25}, .srs = "IAU_2015:49900"},
                   [&](std::size_t c, std::size_t) { return 100.0 * static_cast<double>(c); });
    const auto slope = slopeOf(map, {10.0, 7.0});
    ASSERT_TRUE(slope);
    const double steepness = 100.0 / (0.25 * per_degree * std::cos(latitude * kDegree));
    EXPECT_NEAR(std::tan(slope->slope.radians()), steepness, 1e-5 * steepness);
    EXPECT_NEAR(slope->aspect->degrees(), 270.0, 1e-6) << "rising eastward, it faces west";
}

// Away from the central meridian grid north differs from true north, and a meter of the map differs
// from one on the ground: near the pole in a stereographic projection, both apply.
TEST(SurfaceSlope, FacesTrueNorthOnAPolarProjection)
{
    MapMaker maker;
    // 85° N on 90° E lies to the right of the pole: northward is to the left there.
    const std::shared_ptr<const Map> map =
        maker.make({.transform = {296000.0, 10.0, 0.0, 75.0, 0.0, -10.0},
                    .srs = "+proj=stere +lat_0=90 +lon_0=0 +k=1 +R=3396190 +units=m +no_defs"},
                   [](std::size_t c, std::size_t) { return -1.0 * static_cast<double>(c); });
    const auto slope = slopeOf(map, {10.0, 7.0});
    ASSERT_TRUE(slope);
    ASSERT_TRUE(slope->aspect);
    EXPECT_NEAR(slope->aspect->degrees(), 180.0, 0.01) << "it rises toward the pole";
    // The scale of the projection: 2 / (1 + sin of the latitude), at 2 R tan(c / 2) = 296 105 m.
    const double c = 2.0 * std::atan(296105.0 / (2.0 * 3396190.0));
    const double scale = 2.0 / (1.0 + std::cos(c));
    EXPECT_NEAR(std::tan(slope->slope.radians()), 0.1 * scale, 1e-6);
}

TEST(SurfaceSlope, IsThatOfTheTriangleAroundThePosition)
{
    MapMaker maker;
    // Only the lower left corner of the cell at (4, 4) is high.
    const std::shared_ptr<const Map> map =
        maker.make({}, [](std::size_t c, std::size_t r) { return c == 4 && r == 5 ? 30.0 : 0.0; });
    const auto upper = slopeOf(map, {4.8, 4.2});
    ASSERT_TRUE(upper);
    EXPECT_EQ(upper->slope.degrees(), 0.0);
    EXPECT_FALSE(upper->aspect) << "level ground has no aspect";
    const auto lower = slopeOf(map, {4.2, 4.8});
    ASSERT_TRUE(lower);
    // Falls by 30 m over 30 m, eastward and northward.
    EXPECT_NEAR(lower->slope.degrees(), std::atan(std::sqrt(2.0)) / kDegree, 1e-4);
    EXPECT_NEAR(lower->aspect->degrees(), 45.0, 1e-4);
}

TEST(SurfaceSlope, IsEmptyOutsideTheMapAndNextToVoids)
{
    MapMaker maker;
    const std::shared_ptr<const Map> map = maker.make(
        {}, [](std::size_t c, std::size_t r) { return c == 6 && r == 6 ? std::nan("") : 1.0; });
    EXPECT_FALSE(slopeOf(map, {5.6, 5.5}));
    EXPECT_FALSE(slopeOf(map, {-0.1, 3.0}));
    EXPECT_FALSE(slopeOf(map, {3.0, 14.1}));
    EXPECT_FALSE(slopeOf(map, {std::nan(""), 3.0}));
    EXPECT_TRUE(slopeOf(map, {3.5, 3.5}));
}

} // namespace
} // namespace marsview
