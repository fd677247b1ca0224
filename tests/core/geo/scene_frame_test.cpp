#include "core/geo/georeference.h"
#include "core/geo/scene_frame.h"
#include "tests/core/geo/placed.h"
#include "tests/support/random.h"
#include "tests/support/reference_ellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

void expectRoundTrips(const Georeference& reference)
{
    test::Random random;
    const SceneFrame& frame = reference.sceneFrame();
    for (int i = 0; i < 1000; ++i) {
        const GridPoint grid{random.uniform(0.0, static_cast<double>(reference.columns() - 1)),
                             random.uniform(0.0, static_cast<double>(reference.rows() - 1))};
        const double height_m = random.uniform(-1e4, 1e4);
        const ScenePoint scene = frame.toScene(grid, height_m);
        const GridPoint back = frame.toGrid(scene);
        ASSERT_EQ(scene.z, height_m);
        ASSERT_NEAR(back.column, grid.column, 1e-9);
        ASSERT_NEAR(back.row, grid.row, 1e-9);
    }
}

TEST(SceneFrame, TheOriginIsTheCenterOfTheRaster)
{
    const Georeference reference =
        placed(11, 7, {500000.0, 30.0, 0.0, 4e6, 0.0, -30.0}, "EPSG:32610");
    EXPECT_EQ(reference.sceneFrame().toScene({5.0, 3.0}, 8.0), (ScenePoint{0.0, 0.0, 8.0}));
}

TEST(SceneFrame, TheMeanCellSideIsThatOfColumnsAndRows)
{
    const SceneFrame frame{.origin = {},
                           .east_per_column = 3.0,
                           .east_per_row = 0.0,
                           .north_per_column = 4.0,
                           .north_per_row = -7.0};
    EXPECT_EQ(frame.meanCellSideM(), 6.0); // of 5 and 7
}

TEST(SceneFrame, AProjectedRasterUsesItsLinearUnit)
{
    // EPSG:2853 is in meters; EPSG:2924 is the same zone in US survey feet.
    const Georeference meters = placed(11, 7, {0.0, 30.0, 0.0, 0.0, 0.0, -20.0}, "EPSG:2853");
    EXPECT_EQ(meters.sceneFrame().east_per_column, 30.0);
    EXPECT_EQ(meters.sceneFrame().north_per_row, -20.0);
    const Georeference feet = placed(11, 7, {0.0, 30.0, 0.0, 0.0, 0.0, -20.0}, "EPSG:2924");
    const double unit = feet.crs()->unit();
    EXPECT_TRUE(unit == 0.3048 || std::abs(unit - 1200.0 / 3937.0) < 1e-12) << unit;
    EXPECT_DOUBLE_EQ(feet.sceneFrame().east_per_column, 30.0 * unit);
    EXPECT_DOUBLE_EQ(feet.sceneFrame().north_per_row, -20.0 * unit);
}

TEST(SceneFrame, MapUnitsAreMetersWithoutACrs)
{
    const Georeference reference(11, 7, *GeoTransform::fromTerms({0, 3, 0, 0, 0, -2}), {});
    EXPECT_EQ(reference.sceneFrame().toScene({6.0, 2.0}, 0.0), (ScenePoint{3.0, 2.0, 0.0}));
    expectRoundTrips(reference);
}

// The rule in CLI.md: over the whole raster, a degree has its length on the body's ellipsoid at the
// latitude of the raster's center.
TEST(SceneFrame, DegreesAreScaledAtTheCenterOfTheRaster)
{
    const struct {
        const char* crs;
        double a;
        double b;
        bool is_centric;
        double center_deg;
    } cases[] = {
        {"EPSG:4326", 6378137.0, 6356752.314245179, false, 45.0},
        {"EPSG:4326", 6378137.0, 6356752.314245179, false, 0.0},
        {"EPSG:4326", 6378137.0, 6356752.314245179, false, -77.5},
        {"EPSG:4267", 6378206.4, 6356583.8, false, 38.0},
        {"IAU_2015:49900", 3396190.0, 3396190.0, false, 18.65},
        {"IAU_2015:49901", 3396190.0, 3376200.0, false, 18.65},
        {"IAU_2015:49902", 3396190.0, 3376200.0, true, 18.65},
        {"IAU_2015:49902", 3396190.0, 3376200.0, true, -60.0},
        {"IAU_2015:30100", 1737400.0, 1737400.0, false, 20.0},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(std::string(c.crs) + " at " + std::to_string(c.center_deg));
        const double step = 0.125;
        const Georeference reference =
            placed(9, 5, {10.0, step, 0.0, c.center_deg + 2.5 * step, 0.0, -step}, c.crs);
        const long double graphic = c.is_centric ? test::graphicLatitude_deg(c.a, c.b, c.center_deg)
                                                 : static_cast<long double>(c.center_deg);
        const double east = static_cast<double>(test::parallelRadius(c.a, c.b, graphic));
        double north = static_cast<double>(test::meridianRadius(c.a, c.b, graphic));
        if (c.is_centric) {
            // Checked with a difference quotient of the closed formula.
            const long double h = 1e-5L;
            const long double slope = (test::graphicLatitude_deg(c.a, c.b, c.center_deg + h) -
                                       test::graphicLatitude_deg(c.a, c.b, c.center_deg - h)) /
                                      (2.0L * h);
            north *= static_cast<double>(slope);
        }
        const SceneFrame& frame = reference.sceneFrame();
        const double east_sign = std::string(c.crs) == "IAU_2015:49901" ? -1.0 : 1.0;
        EXPECT_NEAR(frame.east_per_column / (east_sign * east * step * kDegree), 1.0, 1e-11);
        EXPECT_NEAR(frame.north_per_row / (-north * step * kDegree), 1.0, 1e-11);
        EXPECT_EQ(frame.east_per_row, 0.0);
        EXPECT_EQ(frame.north_per_column, 0.0);
        expectRoundTrips(reference);
    }
}

TEST(SceneFrame, ReversesMapAxesThatRunWestOrSouth)
{
    // IAU Ographic equirectangular: x grows westward.
    const Georeference mars = placed(9, 5, {0.0, 100.0, 0.0, 0.0, 0.0, -100.0}, "IAU_2015:49911");
    EXPECT_EQ(mars.sceneFrame().east_per_column, -100.0);
    EXPECT_EQ(mars.sceneFrame().north_per_row, -100.0);
    // South African Lo zones: x grows westward, y southward.
    const Georeference lo = placed(9, 5, {0.0, 100.0, 0.0, 0.0, 0.0, -100.0}, "EPSG:2053");
    EXPECT_EQ(lo.sceneFrame().east_per_column, -100.0);
    EXPECT_EQ(lo.sceneFrame().north_per_row, 100.0);
    // Northing before easting changes only the axis order.
    const Georeference nz = placed(9, 5, {1.7e6, 100.0, 0.0, 5.4e6, 0.0, -100.0}, "EPSG:2193");
    EXPECT_EQ(nz.sceneFrame().east_per_column, 100.0);
    EXPECT_EQ(nz.sceneFrame().north_per_row, -100.0);
    expectRoundTrips(mars);
    expectRoundTrips(lo);
    expectRoundTrips(nz);
}

TEST(SceneFrame, EastInTheSceneIsEastOnTheBody)
{
    const struct {
        const char* crs;
        GeoTransform::Terms terms;
    } cases[] = {
        {"EPSG:32610", {500000.0, 30.0, 0.0, 4e6, 0.0, -30.0}},
        {"EPSG:32610", {500000.0, 30.0, 0.0, 4e6, 0.0, 30.0}}, // south-up
        {"EPSG:2053", {10000.0, 30.0, 0.0, 3.3e6, 0.0, 30.0}},
        {"IAU_2015:49901", {100.0, 0.25, 0.0, 20.0, 0.0, -0.25}},
        {"IAU_2015:49911", {1e6, 1000.0, 0.0, 1e6, 0.0, -1000.0}},
        {"IAU_2015:49912", {1e6, 1000.0, 0.0, 1e6, 0.0, -1000.0}},
        {"EPSG:4807", {0.0, 0.01, 0.0, 50.0, 0.0, -0.01}},
    };
    for (const auto& c : cases) {
        const Georeference reference = placed(101, 81, c.terms, c.crs);
        const GridPoint center = reference.sceneFrame().origin;
        const auto here = reference.toGeographic(center);
        const GridPoint right{center.column + 5.0, center.row};
        const GridPoint below{center.column, center.row + 5.0};
        const auto there = reference.toGeographic(right);
        const auto under = reference.toGeographic(below);
        ASSERT_TRUE(here && there && under) << c.crs;
        EXPECT_GT(reference.sceneFrame().toScene(right, 0.0).x *
                      (there->longitude - here->longitude).radians(),
                  0.0)
            << c.crs;
        EXPECT_GT(reference.sceneFrame().toScene(below, 0.0).y *
                      (under->latitude - here->latitude).radians(),
                  0.0)
            << c.crs;
    }
}

TEST(SceneFrame, ARotatedRasterRoundTrips)
{
    const Georeference reference = placed(1197, 643,
                                          {390045.0, 30.0 * std::cos(0.5), 30.0 * std::sin(0.5),
                                           3797505.0, 30.0 * std::sin(0.5), -30.0 * std::cos(0.5)},
                                          "EPSG:32611");
    EXPECT_NEAR(reference.pixelWidthMeters(), 30.0, 1e-12);
    EXPECT_NEAR(reference.pixelHeightMeters(), 30.0, 1e-12);
    expectRoundTrips(reference);
}

// At a pole a degree of longitude has zero length; the frame must still be invertible.
TEST(SceneFrame, ARasterCenteredOnAPoleIsInvertible)
{
    const Georeference reference =
        placed(9, 5, {10.0, 0.125, 0.0, 90.0 + 2.5 * 0.125, 0.0, -0.125}, "EPSG:4326");
    EXPECT_GT(reference.sceneFrame().east_per_column, 0.0);
    expectRoundTrips(reference);
}

} // namespace
} // namespace marsview
