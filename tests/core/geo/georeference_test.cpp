#include "core/geo/georeference.h"
#include "tests/core/geo/placed.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace marsview {
namespace {

struct PlacementCase {
    const char* name;
    const char* crs;
    std::size_t columns;
    std::size_t rows;
    GeoTransform::Terms terms;
    bool wraps_around;
};

std::vector<PlacementCase> placementCases()
{
    const double mars_pixel = 2.0 * std::numbers::pi * 3396190.0 / 1440.0;
    const double mola_pixel = 14818.0; // of the label, rounded: the circumference is 1439.99 pixels
    const double c30 = 30.0 * std::cos(0.5);
    const double s30 = 30.0 * std::sin(0.5);
    return {
        {"Utm", "EPSG:32610", 327, 468, {557805, 30, 0, 5121975, 0, -30}, false},
        {"UtmSouthUp", "EPSG:32733", 200, 300, {300000, 30, 0, 6e6, 0, 30}, false},
        {"UtmRotated", "EPSG:32611", 1197, 643, {390045, c30, s30, 3797505, s30, -c30}, false},
        {"UtmMirrored", "EPSG:32611", 100, 64, {390045, -30, 0, 3797505, 0, -30}, false},
        {"UtmRowsEast", "EPSG:32611", 100, 64, {390045, 0, 30, 3797505, 30, 0}, false},
        {"UtmZone1", "EPSG:32601", 400, 300, {200000, 1000, 0, 7.5e6, 0, -1000}, false},
        {"UtmZone60", "EPSG:32660", 400, 300, {600000, 1000, 0, 7.5e6, 0, -1000}, false},
        {"PolarNorth", "EPSG:3995", 500, 500, {-2e6, 8000, 0, 2e6, 0, -8000}, false},
        {"PolarSouth", "EPSG:3031", 500, 500, {-2e6, 8000, 0, 2e6, 0, -8000}, false},
        {"Oblique", "EPSG:2056", 500, 500, {2.5e6, 500, 0, 1.3e6, 0, -500}, false},
        {"WestSouth", "EPSG:2053", 100, 100, {-5e4, 1000, 0, 3e6, 0, 1000}, false},
        {"NorthEast", "EPSG:2193", 100, 100, {1.6e6, 1000, 0, 5.5e6, 0, -1000}, false},
        {"Paris", "EPSG:27572", 100, 100, {5e5, 1000, 0, 2.3e6, 0, -1000}, false},
        {"Dateline", "EPSG:4326", 200, 100, {175, 0.05, 0, 10, 0, -0.05}, false},
        {"DatelineWest", "EPSG:4326", 200, 100, {-185, 0.05, 0, 10, 0, -0.05}, false},
        {"Grads", "EPSG:4807", 200, 100, {-4, 0.05, 0, 54, 0, -0.05}, false},
        {"Global360", "EPSG:4326", 720, 360, {0, 0.5, 0, 90, 0, -0.5}, true},
        {"Global180", "EPSG:4326", 720, 360, {-180, 0.5, 0, 90, 0, -0.5}, true},
        {"GlobalFrom20", "EPSG:4326", 360, 180, {19.5, 1, 0, 90, 0, -1}, true},
        {"GlobalSouthUp", "EPSG:4326", 720, 360, {0, 0.5, 0, -90, 0, 0.5}, true},
        {"GridRegistered", "EPSG:4326", 361, 181, {-180.5, 1, 0, 90.5, 0, -1}, false},
        {"MarsSphere", "IAU_2015:49900", 1440, 720, {0, 0.25, 0, 90, 0, -0.25}, true},
        {"MarsGraphicWest", "IAU_2015:49901", 1440, 720, {0, 0.25, 0, 90, 0, -0.25}, true},
        {"MarsGraphicEast", "IAU_2015:49901", 1440, 720, {360, -0.25, 0, 90, 0, -0.25}, true},
        {"MarsCentric", "IAU_2015:49902", 1440, 720, {0, 0.25, 0, 90, 0, -0.25}, true},
        {"MarsEqc",
         "IAU_2015:49910",
         1440,
         720,
         {-720 * mars_pixel, mars_pixel, 0, 360 * mars_pixel, 0, -mars_pixel},
         true},
        {"MarsEqcFrom0",
         "IAU_2015:49910",
         1440,
         720,
         {0, mars_pixel, 0, 360 * mars_pixel, 0, -mars_pixel},
         true},
        {"MarsEqcWest",
         "IAU_2015:49911",
         1440,
         720,
         {-720 * mars_pixel, mars_pixel, 0, 360 * mars_pixel, 0, -mars_pixel},
         true},
        {"MolaLabel",
         "+proj=eqc +lon_0=180 +R=3396000 +no_defs",
         1440,
         720,
         {-720 * mola_pixel, mola_pixel, 0, 360 * mola_pixel, 0, -mola_pixel},
         true},
        {"MarsEqcHalf",
         "IAU_2015:49910",
         720,
         720,
         {0, mars_pixel, 0, 360 * mars_pixel, 0, -mars_pixel},
         false},
        {"MarsSinu", "IAU_2015:49920", 100, 100, {-5e5, 1e4, 0, 5e5, 0, -1e4}, false},
        {"MarsSouth", "IAU_2015:49935", 500, 500, {-1e6, 4000, 0, 1e6, 0, -4000}, false},
        {"MarsGraphicNorth", "IAU_2015:49931", 500, 500, {-1e6, 4000, 0, 1e6, 0, -4000}, false},
        {"MoonEqc", "IAU_2015:30110", 100, 100, {1e6, 1000, 0, 1e6, 0, -1000}, false},
    };
}

void PrintTo(const PlacementCase& c, std::ostream* stream)
{
    *stream << c.crs;
}

class Placement : public testing::TestWithParam<PlacementCase> {
protected:
    Georeference reference_ =
        placed(GetParam().columns, GetParam().rows, GetParam().terms, GetParam().crs);
    test::Random random_;

    // Points between the outermost samples, the corners first. Global rasters end at the poles,
    // where longitude is undefined; the outermost samples lie half a pixel away from them.
    GridPoint position(int i)
    {
        const double right = static_cast<double>(GetParam().columns - 1);
        const double bottom = static_cast<double>(GetParam().rows - 1);
        if (i < 4) {
            return {i % 2 == 0 ? 0.0 : right, i < 2 ? 0.0 : bottom};
        }
        return {random_.uniform(0.0, right), random_.uniform(0.0, bottom)};
    }

    bool isAtPole(const GeographicPoint& p) const
    {
        return std::abs(p.latitude.degrees()) > 90.0 - 1e-3;
    }
};

TEST_P(Placement, PixelToMapAndBackIsTheSamePixel)
{
    for (int i = 0; i < 2000; ++i) {
        const GridPoint grid = position(i);
        const GridPoint back = reference_.toGrid(reference_.toMap(grid));
        ASSERT_NEAR(back.column, grid.column, 1e-9);
        ASSERT_NEAR(back.row, grid.row, 1e-9);
    }
}

TEST_P(Placement, PixelToLongitudeAndLatitudeAndBackIsTheSamePixel)
{
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const GridPoint grid = position(i);
        const auto geographic = reference_.toGeographic(grid);
        ASSERT_TRUE(geographic);
        if (isAtPole(*geographic)) {
            continue; // longitude without latitude
        }
        const auto back = reference_.toGrid(*geographic);
        ASSERT_TRUE(back);
        ASSERT_NEAR(back->column, grid.column, 1e-9) << grid.column << " " << grid.row;
        ASSERT_NEAR(back->row, grid.row, 1e-9) << grid.column << " " << grid.row;
        worst =
            std::max({worst, std::abs(back->column - grid.column), std::abs(back->row - grid.row)});
    }
    std::printf("%s: worst round trip %.3g pixel\n", GetParam().name, worst);
}

TEST_P(Placement, LongitudesInOtherTurnsAreTheSamePixel)
{
    for (int i = 4; i < 500; ++i) {
        const GridPoint grid = position(i);
        const auto geographic = reference_.toGeographic(grid);
        ASSERT_TRUE(geographic);
        if (isAtPole(*geographic)) {
            continue;
        }
        for (const double turns : {-2.0, -1.0, 1.0, 2.0}) {
            const auto back = reference_.toGrid(GeographicPoint{
                geographic->longitude + Angle::degrees(360.0) * turns, geographic->latitude});
            ASSERT_TRUE(back) << turns;
            ASSERT_NEAR(back->column, grid.column, 1e-8) << turns;
            ASSERT_NEAR(back->row, grid.row, 1e-8) << turns;
        }
    }
}

TEST_P(Placement, DetectsMapsThatWrapAroundTheBody)
{
    EXPECT_EQ(reference_.wrapsAround(), GetParam().wraps_around);
}

TEST_P(Placement, MetricPixelSizeMatchesTheBody)
{
    // Near the center, scene meters equal meters on the body within the projection's scale there. A
    // factor of 2 is enough to detect wrong units, radii and signs.
    const GridPoint center = reference_.sceneFrame().origin;
    const auto here = reference_.toGeographic(center);
    const auto below = reference_.toGeographic(GridPoint{center.column, center.row + 0.25});
    const auto right = reference_.toGeographic(GridPoint{center.column + 0.25, center.row});
    ASSERT_TRUE(here && below && right);
    if (std::abs(here->latitude.degrees()) > 80.0) {
        return; // longitudes converge: not a plane
    }
    const double radius = reference_.crs()->ellipsoid()->equatorial_m;
    const auto meters = [&](const GeographicPoint& p) {
        const double dlon = std::remainder((p.longitude - here->longitude).degrees(), 360.0);
        const double dlat = (p.latitude - here->latitude).degrees();
        return radius * kDegree * std::hypot(dlon * std::cos(here->latitude.radians()), dlat);
    };
    EXPECT_NEAR(std::log2(4.0 * meters(*right) / reference_.pixelWidthMeters()), 0.0, 1.0);
    EXPECT_NEAR(std::log2(4.0 * meters(*below) / reference_.pixelHeightMeters()), 0.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Rasters,
                         Placement,
                         testing::ValuesIn(placementCases()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Georeference, LongitudesAFullTurnApartAreTheSamePixel)
{
    const Georeference mars = placed(1440, 720, {0, 0.25, 0, 90, 0, -0.25}, "IAU_2015:49900");
    const auto east = mars.toGrid({Angle::degrees(226.2), Angle::degrees(18.65)});
    const auto west = mars.toGrid({Angle::degrees(-133.8), Angle::degrees(18.65)});
    ASSERT_TRUE(east && west);
    EXPECT_NEAR(east->column, 226.2 / 0.25 - 0.5, 1e-9);
    EXPECT_NEAR(east->row, (90.0 - 18.65) / 0.25 - 0.5, 1e-9);
    EXPECT_NEAR(west->column, east->column, 1e-9);
    EXPECT_NEAR(west->row, east->row, 1e-9);
}

TEST(Georeference, WestPositiveColumnsCountAgainstEastPositiveLongitudes)
{
    const Georeference mars = placed(1440, 720, {0, 0.25, 0, 90, 0, -0.25}, "IAU_2015:49901");
    const auto grid = mars.toGrid({Angle::degrees(226.2), Angle::degrees(0.0)});
    ASSERT_TRUE(grid);
    EXPECT_NEAR(grid->column, (360.0 - 226.2) / 0.25 - 0.5, 1e-9);
}

TEST(Georeference, HasNoLongitudeWithoutACrs)
{
    const Georeference reference(10, 20, GeoTransform{}, {});
    EXPECT_FALSE(reference.toGeographic(GridPoint{1.0, 2.0}));
    EXPECT_FALSE(reference.toGrid(GeographicPoint{Angle::degrees(1.0), Angle::degrees(2.0)}));
    EXPECT_FALSE(reference.wrapsAround());
    EXPECT_EQ(reference.body(), nullptr);
    EXPECT_EQ(reference.toMap({0.0, 0.0}), (MapPoint{0.5, -0.5}));
}

TEST(Georeference, ConvertsPositionsOfAnotherGridInTheRightTurn)
{
    const Georeference west = placed(200, 100, {-185, 0.05, 0, 10, 0, -0.05}, "EPSG:4326");
    const Georeference east = placed(400, 200, {175, 0.025, 0, 10, 0, -0.025}, "EPSG:4326");
    // 180° W, 8.975° N: the same meridian as 180° E.
    const GridPoint there = east.toGrid(GridPoint{99.5, 20.0}, west);
    EXPECT_NEAR(there.column, (180.0 - 175.0) / 0.025 - 0.5, 1e-9);
    EXPECT_NEAR(there.row, (10.0 - 8.975) / 0.025 - 0.5, 1e-9);
    EXPECT_EQ(east.toGrid(GridPoint{-3.0, 7.25}, east), (GridPoint{-3.0, 7.25}));
}

TEST(Georeference, ConvertsPositionsOfAnotherGridWithoutACrs)
{
    const Georeference coarse(10, 10, *GeoTransform::fromTerms({100, 2, 0, 50, 0, -2}),
                              std::nullopt);
    const Georeference fine(40, 40, *GeoTransform::fromTerms({90, 1, 0, 60, 0, -1}), std::nullopt);
    // The center of sample (3, 4) is at x = 107, y = 41.
    EXPECT_EQ(fine.toGrid(GridPoint{3.0, 4.0}, coarse), (GridPoint{16.5, 18.5}));
}

} // namespace
} // namespace marsview
