#include "core/measure/crater.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace marsview::test {
namespace {

Result<Crater> craterOf(MeasuredTerrain& terrain, const std::vector<GroundPosition>& rim)
{
    JobMonitor monitor;
    return measureCrater(terrain, rim, monitor);
}

} // namespace

TEST(Crater, OfKnownShapeAtSixtyDegreesNorthIsMeasuredOnTheBody)
{
    // Equirectangular with its true scale at the equator: at 60° a circle is an ellipse of 2 : 1.
    MapMaker maker;
    const GeographicLib::Geodesic moon(1737400.0, 0.0);
    const double lon = 75.0;
    const double lat = 60.0;
    constexpr double kRadiusM = 15'000.0;
    constexpr double kRimM = 800.0;
    constexpr double kFloorM = -2200.0;
    const MapMaker::Place place{.columns = 700,
                                .rows = 400,
                                .transform = {0.0, 100.0, 0.0, 0.0, 0.0, -100.0},
                                .srs = "+proj=eqc +lon_0=0 +R=1737400"};
    MapMaker::Place moved = place;
    const auto crs = Crs::fromText(place.srs);
    ASSERT_TRUE(crs);
    const auto middle = crs->toMap({Angle::degrees(lon), Angle::degrees(lat)});
    moved.transform[0] = middle->x - 350 * 100.0;
    moved.transform[3] = middle->y + 200 * 100.0;
    const Georeference georeference(moved.columns, moved.rows,
                                    *GeoTransform::fromTerms(moved.transform), *crs);
    const auto map = maker.make(moved, [&](std::size_t c, std::size_t r) {
        const auto at = georeference.toGeographic({static_cast<double>(c), static_cast<double>(r)});
        double distance_m = 0.0;
        moon.Inverse(lat, lon, at->latitude.degrees(), at->longitude.degrees(), distance_m);
        const double share = distance_m / kRadiusM;
        // The rim is level, so that triangles do not cut its edge.
        return share < 0.97   ? kFloorM + (kRimM - kFloorM) * share * share / (0.97 * 0.97)
               : share < 1.03 ? kRimM
                              : kRimM * std::exp(-3.0 * (share - 1.03));
    });
    MeasuredTerrain terrain = terrainOf(*map);
    for (const int count : {3, 4, 12}) {
        std::vector<GroundPosition> rim;
        for (int i = 0; i < count; ++i) {
            GroundPosition position;
            moon.Direct(lat, lon, 20.0 + 360.0 * i / count, kRadiusM, position.y, position.x);
            rim.push_back(position);
        }
        const auto crater = craterOf(terrain, rim);
        ASSERT_TRUE(crater) << crater.error().message;
        std::printf("%d points: diameter %.6g m of 30000, depth %.6g m of 3000\n", count,
                    crater->diameter_m, crater->depth_m);
        EXPECT_NEAR(crater->diameter_m, 2.0 * kRadiusM, 0.01);
        EXPECT_NEAR(crater->center.x, lon, 1e-6);
        EXPECT_NEAR(crater->center.y, lat, 1e-6);
        EXPECT_NEAR(crater->rms_m, 0.0, 0.01);
        EXPECT_NEAR(crater->rim_m, kRimM, 1e-3);
        EXPECT_NEAR(crater->floor_m, kFloorM, 0.1);
        EXPECT_NEAR(crater->depth_m, kRimM - kFloorM, 0.1);
    }
}

TEST(Crater, FitsNoisyRimsByLeastSquares)
{
    // Against a search for the smallest sum of squares around the fitted center.
    Random random;
    MapMaker maker;
    const auto map = maker.make({.columns = 200,
                                 .rows = 100,
                                 .transform = {-20.0, 0.2, 0.0, 80.0, 0.0, -0.2},
                                 .srs = "+proj=longlat +a=3396190 +b=3376200"},
                                [](std::size_t, std::size_t) { return 5.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    const Ground& ground = terrain.ground();
    for (int i = 0; i < 20; ++i) {
        const GroundPosition center{random.uniform(-10.0, 10.0), random.uniform(65.0, 75.0)};
        const double radius_m = random.uniform(10'000.0, 100'000.0);
        std::vector<GroundPosition> rim;
        for (int k = 0; k < 9; ++k) {
            rim.push_back(ground.ray(center, random.uniform(0.0, 360.0))
                              .at(radius_m * random.uniform(0.95, 1.05)));
        }
        const auto crater = craterOf(terrain, rim);
        ASSERT_TRUE(crater) << crater.error().message;
        const auto rms = [&](GroundPosition c) {
            double sum = 0.0;
            double squares = 0.0;
            for (const GroundPosition& position : rim) {
                const double d = ground.distanceM(c, position);
                sum += d;
                squares += d * d;
            }
            const double mean = sum / 9.0;
            return std::sqrt(std::max(0.0, squares / 9.0 - mean * mean));
        };
        EXPECT_NEAR(crater->rms_m, rms(crater->center), 0.1);
        for (int k = 0; k < 16; ++k) {
            EXPECT_GE(rms(ground.ray(crater->center, 22.5 * k).at(0.01 * radius_m)),
                      crater->rms_m - 0.1);
        }
    }
}

TEST(Crater, AcrossTheDateLineAndAtAPoleIsTheSame)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 360,
                                 .rows = 180,
                                 .transform = {-180.0, 1.0, 0.0, 90.0, 0.0, -1.0},
                                 .srs = "IAU_2015:30100"},
                                [](std::size_t, std::size_t r) { return static_cast<double>(r); });
    MeasuredTerrain terrain = terrainOf(*map);
    const Ground& ground = terrain.ground();
    for (const GroundPosition& center :
         {GroundPosition{180.0, 10.0}, GroundPosition{0.0, 89.0}, GroundPosition{-179.0, -85.0}}) {
        std::vector<GroundPosition> rim;
        for (const double azimuth : {10.0, 120.0, 200.0, 300.0}) {
            rim.push_back(ground.ray(center, azimuth).at(150'000.0));
        }
        const auto crater = craterOf(terrain, rim);
        ASSERT_TRUE(crater) << crater.error().message;
        EXPECT_NEAR(crater->diameter_m, 300'000.0, 0.01);
        EXPECT_LT(ground.distanceM(crater->center, center), 0.01);
    }
}

TEST(Crater, RefusesPointsWithoutACircle)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 20,
                                 .rows = 20,
                                 .transform = {0.0, 1.0, 0.0, 10.0, 0.0, -1.0},
                                 .srs = "IAU_2015:30100"},
                                [](std::size_t, std::size_t) { return 1.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    EXPECT_EQ(craterOf(terrain, {{1.0, 1.0}, {2.0, 2.0}}).error().message,
              "a crater needs at least 3 positions, but there are 2");
    EXPECT_NE(craterOf(terrain, {{2.0, 0.0}, {5.0, 0.0}, {9.0, 0.0}})
                  .error()
                  .message.find("nearly on a line"),
              std::string::npos);
    EXPECT_NE(craterOf(terrain, {{2.0, 0.0}, {2.0, 0.0}, {2.0, 0.0}})
                  .error()
                  .message.find("nearly on a line"),
              std::string::npos);
    EXPECT_NE(
        craterOf(terrain, {{2.0, 0.0}, {5.0, 0.0}, {50.0, 0.0}}).error().message.find("position 3"),
        std::string::npos);
}

} // namespace marsview::test
