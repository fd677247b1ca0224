#include "core/measure/cap_path.h"
#include "core/measure/terrain_slope.h"
#include "tests/core/measure/measured_lines.h"
#include "tests/core/measure/measured_map.h"
#include "tests/core/measure/polar_maps.h"
#include "tests/support/map_maker.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

int gapsOf(const Profile& profile)
{
    return static_cast<int>(
        std::count_if(profile.points.begin(), profile.points.end(),
                      [](const ProfilePoint& point) { return std::isnan(point.elevation_m); }));
}

// Lines over the pole along a meridian, past it at several distances, along the edge of its cap,
// and such that end or begin within it, in shares of the distance of the row.
std::vector<std::vector<GroundPosition>> linesOf(const PolarMap& map)
{
    const auto at = [&](double longitude_deg, double rows) {
        return GroundPosition{
            longitude_deg, map.pole_deg - std::copysign(map.row_distance_deg * rows, map.pole_deg)};
    };
    return {
        {at(10.0, 1.6), at(190.0, 1.6)},  {at(0.3, 1.6), at(180.3, 1.6)},
        {at(0.0, 1.6), at(0.0, 0.0)},     {at(77.0, 0.0), at(-20.0, 1.6)},
        {at(10.0, 1.6), at(189.0, 1.6)},  {at(100.0, 1.6), at(210.0, 1.9)},
        {at(30.0, 1.5), at(120.0, 1.38)}, {at(200.0, 1.2), at(33.0, 0.4)},
        {at(5.0, 0.02), at(120.0, 0.7)},  {at(-71.0, 0.9), at(-64.0, 0.95)},
        {at(10.0, 0.3), at(250.0, 1.6)},  {at(90.0, 0.5), at(270.0, 0.5)},
    };
}

} // namespace

class PathInCap : public testing::TestWithParam<PolarMap> {};

// The reference are the globe's triangles, whose edges are straight in space: they lie up to
// r² / 8R below the curved surface of elevation 0, as much as those of a map without relief. The
// rest are second-order effects: they move the places of triangles sideways by (r / R)² of the
// cap, and by the relief over R.
TEST_P(PathInCap, HasTheHeightsOfTheTrianglesOfTheGlobe)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const CapRelief relief(maker, tested);
    MeasuredTerrain terrain = terrainOf(*relief.map());
    double worst_m = 0.0;
    int compared = 0;
    for (const auto& positions : linesOf(tested)) {
        const Profile profile = profileOf(terrain, positions);
        EXPECT_EQ(gapsOf(profile), 0) << positions[0].x << ", " << positions[0].y;
        const GroundLine line = terrain.ground().line(positions[0], positions[1]);
        for (int i = 0; i <= 100; ++i) {
            const double distance_m = line.lengthM() * i / 100;
            const GroundPosition here = line.at(distance_m);
            const LocalFrame frame = terrain.ground().frameAt(here);
            const double truth_m = relief.above(frame.origin, frame.up);
            if (std::isnan(truth_m)) {
                continue; // outside
            }
            ++compared;
            worst_m = std::max(worst_m, std::abs(interpolated(profile, distance_m) - truth_m));
            EXPECT_NEAR(terrain.elevation(here), truth_m, relief.toleranceM());
        }
    }
    std::printf("%d elevations, largest difference %.2g m of %.2g m\n", compared, worst_m,
                relief.toleranceM());
    EXPECT_GT(compared, 500);
    EXPECT_LE(worst_m, relief.toleranceM());
}

// Between its points a profile is straight, and it has no step, neither at the edges of triangles
// nor at the row, where the elevation is that of the cells.
TEST_P(PathInCap, IsTheElevationEverywhereWithoutAStep)
{
    const PolarMap& tested = GetParam();
    constexpr double kReliefM = 100.0;
    MapMaker maker;
    const auto map = rough(maker, tested, kReliefM);
    MeasuredTerrain terrain = terrainOf(*map);
    for (const auto& positions : linesOf(tested)) {
        const Profile profile = profileOf(terrain, positions);
        const GroundLine line = terrain.ground().line(positions[0], positions[1]);
        double worst_m = 0.0;
        for (int i = 0; i <= 1000; ++i) {
            const double distance_m = line.lengthM() * i / 1000;
            const double truth_m = terrain.elevation(line.at(distance_m));
            ASSERT_TRUE(std::isfinite(truth_m));
            worst_m = std::max(worst_m, std::abs(interpolated(profile, distance_m) - truth_m));
        }
        EXPECT_LE(worst_m, 1e-3) << positions[0].x << ", " << positions[0].y;
        for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
            ASSERT_GT(profile.points[i + 1].distance_m, profile.points[i].distance_m);
        }
    }
}

TEST_P(PathInCap, IsLevelOnALevelMap)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = maker.make(tested.place, [](std::size_t, std::size_t) { return 1234.5; });
    MeasuredTerrain terrain = terrainOf(*map);
    for (const auto& positions : linesOf(tested)) {
        for (const ProfilePoint& point : profileOf(terrain, positions).points) {
            EXPECT_NEAR(point.elevation_m, 1234.5, 1e-9);
        }
        const Distance distance = distanceOf(terrain, positions);
        EXPECT_EQ(distance.void_m, 0.0);
        EXPECT_NEAR(distance.surface_m, distance.geodesic_m, 1e-9 * distance.geodesic_m);
        JobMonitor monitor;
        const auto slopes = measureSlopes(terrain, positions, std::nullopt, monitor);
        ASSERT_TRUE(slopes);
        for (const TerrainSlope& slope : *slopes) {
            EXPECT_NEAR(slope.slope_deg, 0.0, 1e-9);
        }
    }
}

TEST_P(PathInCap, OfSectionsAddsUpToTheWhole)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = rough(maker, tested, 300.0);
    MeasuredTerrain terrain = terrainOf(*map);
    Random random;
    for (const auto& ends : linesOf(tested)) {
        const GroundLine line = terrain.ground().line(ends[0], ends[1]);
        std::vector<double> cuts_m{0.0, line.lengthM()};
        for (int i = 0; i < 6; ++i) {
            cuts_m.push_back(random.uniform(0.0, line.lengthM()));
        }
        std::sort(cuts_m.begin(), cuts_m.end());
        std::vector<GroundPosition> positions;
        for (const double cut_m : cuts_m) {
            positions.push_back(line.at(cut_m));
        }
        const Distance whole = distanceOf(terrain, ends);
        const Distance parts = distanceOf(terrain, positions);
        EXPECT_EQ(whole.void_m, 0.0);
        EXPECT_EQ(parts.void_m, 0.0);
        EXPECT_NEAR(parts.surface_m, whole.surface_m, 1e-7 * whole.surface_m);
        EXPECT_NEAR(parts.rise_m, whole.rise_m, 1e-6);
    }
}

// The pole depends on every eighth of the row's samples, a vertex of a ring on its own sample and
// on the pole.
TEST_P(PathInCap, HasGapsAtVoids)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const bool is_last = (tested.pole_deg > 0.0) != (tested.place.transform[5] < 0.0);
    const std::size_t row = is_last ? tested.place.rows - 1 : 0;
    const auto none = maker.make(
        tested.place, [&](std::size_t, std::size_t r) { return r == row ? kNan : 100.0; });
    MeasuredTerrain without = terrainOf(*none);
    const auto one = maker.make(tested.place, [&](std::size_t c, std::size_t r) {
        return r == row && c == 1 ? kNan : 100.0;
    });
    MeasuredTerrain terrain = terrainOf(*one);
    const double latitude_deg =
        tested.pole_deg - std::copysign(0.999 * tested.row_distance_deg, tested.pole_deg);
    for (const auto& positions : linesOf(tested)) {
        const Distance distance = distanceOf(without, positions);
        EXPECT_NEAR(distance.void_m, distance.geodesic_m, 1e-9 * distance.geodesic_m);
    }
    const auto longitude_at = [&](double column) {
        return terrain.fromGrid({column, static_cast<double>(row)})->x;
    };
    EXPECT_TRUE(std::isnan(terrain.elevation(GroundPosition{longitude_at(1.1), latitude_deg})));
    EXPECT_TRUE(std::isnan(terrain.elevation(GroundPosition{longitude_at(0.9), latitude_deg})));
    EXPECT_NEAR(terrain.elevation(GroundPosition{longitude_at(3.5), latitude_deg}), 100.0, 1e-9);
    EXPECT_NEAR(terrain.elevation(GroundPosition{longitude_at(1.0), tested.pole_deg}), 100.0, 1e-9);
    const Profile across =
        profileOf(terrain, {{longitude_at(-2.0), latitude_deg}, {longitude_at(6.0), latitude_deg}});
    EXPECT_GT(gapsOf(across), 0);
    EXPECT_NEAR(across.points.front().elevation_m, 100.0, 1e-9);
    EXPECT_NEAR(across.points.back().elevation_m, 100.0, 1e-9);
}

// The slope is that of the elevations a little to the east and the north.
TEST_P(PathInCap, HasTheSlopesOfItsTriangles)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = rough(maker, tested, 300.0);
    MeasuredTerrain terrain = terrainOf(*map);
    Random random;
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        const GroundPosition here{
            random.uniform(-180.0, 180.0),
            tested.pole_deg - std::copysign(random.uniform(0.02, 0.97) * tested.row_distance_deg,
                                            tested.pole_deg)};
        JobMonitor monitor;
        const std::vector<GroundPosition> positions{here};
        const double short_m = 1e-4 * tested.row_distance_deg * 3e4;
        const auto slope = measureSlopes(terrain, positions, std::nullopt, monitor);
        const auto expected = measureSlopes(terrain, positions, short_m, monitor);
        const auto shorter = measureSlopes(terrain, positions, 0.5 * short_m, monitor);
        ASSERT_TRUE(slope && expected && shorter);
        if (std::abs(shorter->front().slope_deg - expected->front().slope_deg) > 1e-4) {
            continue; // over an edge
        }
        ++compared;
        EXPECT_NEAR(slope->front().slope_deg, expected->front().slope_deg, 0.01);
        EXPECT_LT(angleBetween(slope->front().aspect_deg, expected->front().aspect_deg), 0.2);
    }
    EXPECT_GT(compared, 50);
}

INSTANTIATE_TEST_SUITE_P(CapPath, PathInCap, testing::ValuesIn(kPolarMaps), [](const auto& tested) {
    return tested.param.name;
});

// A row of samples that lies at the pole is the terrain there.
TEST(CapPath, OfAMapWithARowAtThePoleHasNoGap)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 361,
                                 .rows = 19,
                                 .transform = {-0.5, 1, 0, 90.5, 0, -1},
                                 .srs = "IAU_2015:49900"},
                                [](std::size_t c, std::size_t r) {
                                    return r == 0 ? 50.0 : static_cast<double>((c % 360) * r % 37);
                                });
    MeasuredTerrain terrain = terrainOf(*map);
    for (const double longitude_deg : {0.0, 10.0, 123.4}) {
        const Profile profile =
            profileOf(terrain, {{longitude_deg, 85.0}, {longitude_deg + 180.0, 86.0}});
        EXPECT_EQ(gapsOf(profile), 0);
        EXPECT_NEAR(terrain.elevation(GroundPosition{longitude_deg, 90.0}), 50.0, 1e-6);
    }
}

// No pole is closed where the map ends more than a cell before it, or does not go around it.
TEST(CapPath, EndsAtTheMapThatDoesNotCloseAtThePole)
{
    MapMaker maker;
    const auto level = [](std::size_t, std::size_t) { return 7.0; };
    for (const MapMaker::Place& place :
         {MapMaker::Place{360, 20, {0, 1, 0, 88, 0, -1}, "IAU_2015:49900"},
          MapMaker::Place{300, 20, {0, 1, 0, 90, 0, -1}, "IAU_2015:49900"}}) {
        const auto map = maker.make(place, level);
        MeasuredTerrain terrain = terrainOf(*map);
        EXPECT_TRUE(std::isnan(terrain.elevation(GroundPosition{20.0, 89.9})));
        EXPECT_GT(gapsOf(profileOf(terrain, {{20.0, 85.0}, {200.0, 85.0}})), 0);
    }
}

TEST(CapPath, OfGlobalMapsHasTerrainOverBothPoles)
{
    const auto mars = loadedMap(bundledMars());
    for (std::size_t level = 0; level < 3; ++level) {
        MeasuredTerrain terrain = terrainOf(*mars, level);
        for (const double latitude_deg : {88.0, -88.0}) {
            for (const double longitude_deg : {10.0, 0.125, 359.9}) {
                const Profile profile = profileOf(terrain, {{longitude_deg, latitude_deg},
                                                            {longitude_deg + 180.0, latitude_deg}});
                EXPECT_EQ(gapsOf(profile), 0) << latitude_deg << " " << level;
                EXPECT_NEAR(
                    interpolated(profile, 0.5 * profile.points.back().distance_m),
                    terrain.elevation(GroundPosition{0.0, std::copysign(90.0, latitude_deg)}),
                    1e-3);
            }
        }
    }
}

} // namespace marsview::test
