#include "core/geo/extent.h"
#include "tests/core/geo/placed.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace marsview {
namespace {

TEST(MapExtent, ReachesToTheOuterEdgesOfARotatedRaster)
{
    const double c = 30.0 * std::cos(0.5);
    const double s = 30.0 * std::sin(0.5);
    const MapExtent extent =
        mapExtent(placed(100, 50, {1000.0, c, s, 2000.0, s, -c}, "EPSG:32611"));
    // Corners by hand: (0,0), (100,0), (0,50), (100,50) in pixel corners.
    EXPECT_NEAR(extent.low.x, 1000.0, 1e-9);
    EXPECT_NEAR(extent.high.x, 1000.0 + 100 * c + 50 * s, 1e-9);
    EXPECT_NEAR(extent.low.y, 2000.0 - 50 * c, 1e-9);
    EXPECT_NEAR(extent.high.y, 2000.0 + 100 * s, 1e-9);
}

TEST(GeographicExtent, UsesTheTurnOfAGlobalMap)
{
    for (const double west : {-180.0, 0.0}) {
        const auto extent =
            geographicExtent(placed(720, 360, {west, 0.5, 0, 90, 0, -0.5}, "IAU_2015:49900"));
        ASSERT_TRUE(extent);
        EXPECT_NEAR(extent->west.degrees(), west, 1e-9);
        EXPECT_NEAR(extent->east.degrees(), west + 360.0, 1e-9);
        EXPECT_NEAR(extent->south.degrees(), -90.0, 1e-9);
        EXPECT_NEAR(extent->north.degrees(), 90.0, 1e-9);
    }
}

TEST(GeographicExtent, IncludesAPoleInsideTheRaster)
{
    const auto extent =
        geographicExtent(placed(500, 500, {-2e6, 8000, 0, 2e6, 0, -8000}, "EPSG:3031"));
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->south.degrees(), -90.0, 1e-9);
    EXPECT_NEAR(extent->east.degrees() - extent->west.degrees(), 360.0, 1e-9);
    EXPECT_LT(extent->north.degrees(), -55.0);
    EXPECT_GT(extent->north.degrees(), -75.0);
}

// As in etopo5: samples at the poles, and half a pixel beyond.
TEST(GeographicExtent, EndsAtThePolesWhereSamplesLieOnThem)
{
    const auto extent = geographicExtent(placed(360, 181, {0, 1, 0, 90.5, 0, -1}, "EPSG:4326"));
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->north.degrees(), 90.0, 1e-9);
    EXPECT_NEAR(extent->south.degrees(), -90.0, 1e-9);
    EXPECT_NEAR(extent->west.degrees(), 0.0, 1e-9);
    EXPECT_NEAR(extent->east.degrees(), 360.0, 1e-9);
}

TEST(GeographicExtent, ContinuesAcrossTheDateLine)
{
    // UTM zone 1 from 200 to 600 km: both sides of 180°.
    const auto extent =
        geographicExtent(placed(400, 300, {200000, 1000, 0, 7.5e6, 0, -1000}, "EPSG:32601"));
    ASSERT_TRUE(extent);
    EXPECT_LT(extent->east.degrees() - extent->west.degrees(), 20.0);
}

TEST(GeographicExtent, ContainsEveryPositionOfTheRaster)
{
    test::Random random;
    for (const Georeference& map :
         {placed(400, 300, {200000, 1000, 0, 7.5e6, 0, -1000}, "EPSG:32601"),
          placed(500, 500, {-2e6, 8000, 0, 2e6, 0, -8000}, "EPSG:3031"),
          placed(500, 500, {1e5, 2000, 0, 2e6, 0, -2000}, "EPSG:3995"),
          placed(200, 100, {175, 0.05, 0, 10, 0, -0.05}, "EPSG:4326")}) {
        const auto extent = geographicExtent(map);
        ASSERT_TRUE(extent);
        const double slack = 0.02; // degrees; the edges are curved between the steps
        for (int i = 0; i < 500; ++i) {
            const auto place = map.toGeographic(
                GridPoint{random.uniform(0.0, static_cast<double>(map.columns() - 1)),
                          random.uniform(0.0, static_cast<double>(map.rows() - 1))});
            ASSERT_TRUE(place);
            EXPECT_GE(place->latitude.degrees(), extent->south.degrees() - slack);
            EXPECT_LE(place->latitude.degrees(), extent->north.degrees() + slack);
            const double center = (extent->west.degrees() + extent->east.degrees()) / 2.0;
            const double half = (extent->east.degrees() - extent->west.degrees()) / 2.0;
            EXPECT_LE(std::abs(std::remainder(place->longitude.degrees() - center, 360.0)),
                      half + slack);
        }
    }
}

TEST(GeographicExtent, IsUnknownWithoutLongitudesOrBeyondTheProjection)
{
    EXPECT_FALSE(geographicExtent(Georeference(10, 10, GeoTransform{}, std::nullopt)));
    // The corners around the disk of an orthographic view are outside the body.
    EXPECT_FALSE(geographicExtent(placed(200, 200, {-7e6, 7e4, 0, 7e6, 0, -7e4},
                                         "+proj=ortho +lat_0=0 +lon_0=0 +R=6371000")));
}

} // namespace
} // namespace marsview
