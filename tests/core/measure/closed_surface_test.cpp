#include "core/globe/body_camera.h"
#include "core/measure/closed_surface.h"
#include "core/session/body_terrain.h"
#include "tests/core/measure/measured_map.h"
#include "tests/core/measure/polar_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace marsview::test {
namespace {

BodyTerrain onBody(const std::shared_ptr<const Map>& map)
{
    JobMonitor monitor;
    return {map, BodyGrid::make(map->georeference(), monitor).value()};
}

// Longitude and latitude in degrees: within the cap of a map.
GeographicPoint placeInCap(const PolarMap& map, Random& random, double rows_max = 1.0)
{
    const double off_deg = map.row_distance_deg * rows_max * std::sqrt(random.uniform(0.0, 1.0));
    return {.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
            .latitude = Angle::degrees(map.pole_deg - std::copysign(off_deg, map.pole_deg))};
}

} // namespace

class ClosedSurfaceAtAPole : public testing::TestWithParam<PolarMap> {};

// The reference are the globe's triangles, as for profiles (PathInCap).
TEST_P(ClosedSurfaceAtAPole, HasTheElevationsOfTheTrianglesOfTheGlobe)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const CapRelief relief(maker, tested);
    const BodyTerrain terrain = onBody(relief.map());
    Random random(5);
    double worst_m = 0.0;
    int compared = 0;
    for (int i = 0; i < 300; ++i) {
        const GeographicPoint place = placeInCap(tested, random);
        const BodyPositions::Foot foot = footOf(terrain.grid()->ellipsoid(), place);
        const double truth_m = relief.above(foot.surface_m, foot.normal);
        if (std::isnan(truth_m)) {
            continue; // outside
        }
        ++compared;
        worst_m = std::max(worst_m, std::abs(terrain.height(place) - truth_m));
        EXPECT_NEAR(terrain.height(place), truth_m, relief.toleranceM());
    }
    std::printf("%d elevations, largest difference %.2g m of %.2g m\n", compared, worst_m,
                relief.toleranceM());
    EXPECT_GT(compared, 250);
}

TEST_P(ClosedSurfaceAtAPole, HasTheElevationsOfProfiles)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = rough(maker, tested, 300.0);
    const BodyTerrain terrain = onBody(map);
    MeasuredTerrain measured = terrainOf(*map);
    Random random(6);
    for (int i = 0; i < 300; ++i) {
        const GeographicPoint place = placeInCap(tested, random, 1.5); // and around it
        EXPECT_NEAR(terrain.height(place), measured.elevation(measured.ground().position(place)),
                    2e-3) // "Projected" states its steps to 1e-4 m
            << place.longitude.degrees() << ", " << place.latitude.degrees();
    }
    const GeographicPoint pole{.longitude = Angle::degrees(77.0),
                               .latitude = Angle::degrees(tested.pole_deg)};
    EXPECT_NEAR(terrain.height(pole), measured.elevation(measured.ground().position(pole)), 1e-6);
}

TEST_P(ClosedSurfaceAtAPole, ARayReadsThePlaceThatItMeets)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = rough(maker, tested, 300.0);
    const BodyTerrain terrain = onBody(map);
    Random random(7);
    for (int i = 0; i < 60; ++i) {
        const GeographicPoint place = placeInCap(tested, random);
        const CameraPose pose =
            poseOf({.target = place, .distance_m = 1e5}, terrain.grid()->ellipsoid());
        const auto hit = terrain.cast({pose.eye, pose.axes.forward}, 1.0);
        ASSERT_TRUE(hit);
        const auto read = map->georeference().toGeographic(hit->grid);
        ASSERT_TRUE(read);
        const ScenePoint there = footOf(terrain.grid()->ellipsoid(), *read).surface_m;
        EXPECT_LT(length(there - footOf(terrain.grid()->ellipsoid(), place).surface_m), 1.0);
        EXPECT_NEAR(hit->height_m, terrain.height(place), 0.1);
    }
}

TEST_P(ClosedSurfaceAtAPole, HasTheVoidsOfProfiles)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const bool is_last = (tested.pole_deg > 0.0) != (tested.place.transform[5] < 0.0);
    const std::size_t row = is_last ? tested.place.rows - 1 : 0;
    const auto map = maker.make(tested.place, [&](std::size_t c, std::size_t r) {
        // The pole does not depend on these.
        return r == row && (c % 16 == 1 || c % 16 == 2) ? std::numeric_limits<double>::quiet_NaN()
                                                        : 100.0;
    });
    const BodyTerrain terrain = onBody(map);
    MeasuredTerrain measured = terrainOf(*map);
    Random random(8);
    int voids = 0;
    for (int i = 0; i < 300; ++i) {
        const GeographicPoint place = placeInCap(tested, random);
        const double height_m = terrain.height(place);
        EXPECT_EQ(std::isnan(height_m),
                  std::isnan(measured.elevation(measured.ground().position(place))))
            << place.longitude.degrees() << ", " << place.latitude.degrees();
        voids += std::isnan(height_m) ? 1 : 0;
    }
    EXPECT_GT(voids, 5);
}

INSTANTIATE_TEST_SUITE_P(Maps,
                         ClosedSurfaceAtAPole,
                         testing::ValuesIn(kPolarMaps),
                         [](const auto& map) { return map.param.name; });

} // namespace marsview::test
