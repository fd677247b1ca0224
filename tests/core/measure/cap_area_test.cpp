#include "core/measure/cap_area.h"
#include "core/measure/terrain_area.h"
#include "tests/core/measure/measured_map.h"
#include "tests/core/measure/polar_maps.h"
#include "tests/support/map_maker.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

TerrainArea areaIn(MeasuredTerrain& terrain,
                   const std::vector<GroundPosition>& vertices,
                   const AreaOptions& options = {})
{
    JobMonitor monitor;
    const auto area = measureArea(terrain, vertices, options, monitor);
    EXPECT_TRUE(area) << (area ? "" : area.error().message);
    return area.value();
}

// Longitude, and the distance from the pole in distances of the outermost row.
GroundPosition polar(const PolarMap& map, double longitude_deg, double rows)
{
    return {longitude_deg, map.pole_deg - std::copysign(map.row_distance_deg * rows, map.pole_deg)};
}

std::vector<GroundPosition>
ring(const PolarMap& map, double rows, std::size_t count, double first_deg = 3.7)
{
    std::vector<GroundPosition> vertices;
    for (std::size_t i = 0; i < count; ++i) {
        vertices.push_back(polar(
            map, first_deg + 360.0 * static_cast<double>(i) / static_cast<double>(count), rows));
    }
    return vertices;
}

// The chords of the circle of samples stand for its arcs: an edge between them is moved to the
// chord.
double chordShare(const PolarMap& map)
{
    const double step = 2.0 * std::numbers::pi / static_cast<double>(map.place.columns);
    return 1e-6 + 0.25 * step * step;
}

std::shared_ptr<const Map> flat(MapMaker& maker, const PolarMap& map, double height_m)
{
    return maker.make(map.place, [=](std::size_t, std::size_t) { return height_m; });
}

} // namespace

class AreaInCap : public testing::TestWithParam<PolarMap> {};

// The truth is the polygon's area by GeographicLib.
TEST_P(AreaInCap, CoversPolygonsAroundAPole)
{
    MapMaker maker;
    const auto map = flat(maker, GetParam(), 500.0);
    MeasuredTerrain terrain = terrainOf(*map);
    const AreaOptions above{.base = VolumeBase::Elevation, .base_m = 400.0};
    for (const double rows : {0.2, 0.8, 1.7, 2.2}) {
        for (const bool is_reversed : {false, true}) {
            std::vector<GroundPosition> vertices = ring(GetParam(), rows, 37);
            if (is_reversed) {
                std::reverse(vertices.begin(), vertices.end());
            }
            const TerrainArea area = areaIn(terrain, vertices, above);
            // Cells of some degrees are wrong by their curvature.
            const double share = chordShare(GetParam());
            EXPECT_NEAR(area.covered_m2, area.geodesic_m2, share * area.geodesic_m2) << rows;
            EXPECT_NEAR(area.surface_m2, area.covered_m2, 1e-9 * area.covered_m2) << rows;
            EXPECT_NEAR(*area.volume_above_m3, 100.0 * area.covered_m2, 1e-6 * area.covered_m2);
            EXPECT_NEAR(*area.volume_below_m3, 0.0, 1e-6 * area.covered_m2);
            EXPECT_NEAR(area.hypsometry.totalM2(), area.covered_m2, 1e-9 * area.covered_m2);
            EXPECT_NEAR(area.mean_m, 500.0, 1e-9);
            EXPECT_FALSE(area.crosses_itself) << rows;
        }
    }
}

TEST_P(AreaInCap, CoversPolygonsBesideAPole)
{
    MapMaker maker;
    const auto map = flat(maker, GetParam(), -300.0);
    MeasuredTerrain terrain = terrainOf(*map);
    const auto at = [](double longitude_deg, double rows) {
        return polar(GetParam(), longitude_deg, rows);
    };
    const std::vector<std::vector<GroundPosition>> polygons{
        {at(10.0, 0.3), at(40.0, 0.8), at(80.0, 0.4)},
        {at(10.0, 0.3), at(40.0, 1.9), at(80.0, 0.4)},
        {at(-20.0, 1.8), at(15.0, 0.5), at(50.0, 1.6)},
        {at(350.0, 0.6), at(100.0, 0.1), at(170.0, 1.7), at(240.0, 0.9)},
        {at(0.0, 0.0), at(120.0, 1.5), at(200.0, 0.8)},
    };
    for (const auto& vertices : polygons) {
        const TerrainArea area = areaIn(terrain, vertices);
        EXPECT_NEAR(area.covered_m2, area.geodesic_m2,
                    chordShare(GetParam()) * area.geodesic_m2 * 4.0);
        EXPECT_NEAR(area.mean_m, -300.0, 1e-9);
    }
}

// A plane that rises with x, the distance from a meridian plane: the samples of a circle are
// linear in it, and so are the triangles that close it. On a disc of radius r around the pole the
// volume above 0 is 2/3 · slope · r³.
TEST_P(AreaInCap, MeasuresAnInclinedDiscAsItsClosedForm)
{
    const PolarMap& tested = GetParam();
    constexpr double kSlope = 0.1;
    MapMaker maker;
    const auto level = flat(maker, tested, 0.0);
    const MeasuredTerrain ground = terrainOf(*level);
    const auto map = maker.make(tested.place, [&](std::size_t c, std::size_t r) {
        const auto at = ground.fromGrid({static_cast<double>(c), static_cast<double>(r)})
                            .value_or(GroundPosition{});
        return kSlope * ground.ground().cartesian(at, 0.0).x;
    });
    MeasuredTerrain terrain = terrainOf(*map);
    constexpr double kRows = 0.9;
    const std::vector<GroundPosition> vertices = ring(tested, kRows, 720);
    const TerrainArea area =
        areaIn(terrain, vertices, {.base = VolumeBase::Elevation, .base_m = 0.0});
    const Vec3 rim = terrain.ground().cartesian(vertices[0], 0.0);
    const double radius_m = std::hypot(rim.x, rim.y);
    const double volume_m3 = 2.0 / 3.0 * kSlope * std::pow(radius_m, 3.0);
    // Ground that is not parallel to the plane is larger by the square of the angle, halved.
    const double angle = kRows * tested.row_distance_deg * kRadiansPerDegree;
    const double share = 2e-4 + angle * angle + chordShare(tested);
    EXPECT_NEAR(*area.volume_above_m3, volume_m3, share * volume_m3);
    EXPECT_NEAR(*area.volume_below_m3, volume_m3, share * volume_m3);
    EXPECT_NEAR(area.surface_m2 / area.covered_m2, std::sqrt(1.0 + kSlope * kSlope),
                kSlope * kSlope * angle * angle + 1e-9);
    EXPECT_NEAR(area.mean_m, 0.0, (1e-3 + chordShare(tested)) * kSlope * radius_m);
    EXPECT_NEAR(area.max_m, kSlope * radius_m, 1e-3 * kSlope * radius_m);
    EXPECT_NEAR(area.min_m, -kSlope * radius_m, 1e-3 * kSlope * radius_m);

    // Its own plane has nothing above or below it, but for what the ground curves.
    const TerrainArea on_plane = areaIn(terrain, vertices, {.base = VolumeBase::BorderPlane});
    EXPECT_LT(*on_plane.volume_above_m3 + *on_plane.volume_below_m3,
              (1e-4 + 2.0 * angle * angle) * volume_m3);
}

// The truth is read point by point, by what profiles are proved with.
TEST_P(AreaInCap, HasTheElevationsOfProfiles)
{
    const PolarMap& tested = GetParam();
    constexpr double kReliefM = 1000.0;
    MapMaker maker;
    const auto map = rough(maker, tested, kReliefM);
    MeasuredTerrain terrain = terrainOf(*map);
    constexpr double kRows = 1.3;
    const TerrainArea area = areaIn(terrain, ring(tested, kRows, 1440),
                                    {.base = VolumeBase::Elevation, .base_m = 400.0});
    constexpr int rings = 400;
    const auto steps = static_cast<int>(std::max<std::size_t>(4 * tested.place.columns, 720));
    double sum = 0.0;
    double height = 0.0;
    double above = 0.0;
    double below = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double rows = kRows * (i + 0.5) / rings;
        for (int k = 0; k < steps; ++k) {
            const double z = terrain.elevation(polar(tested, 360.0 * (k + 0.5) / steps, rows));
            const double share = std::sin(rows * tested.row_distance_deg * kRadiansPerDegree);
            sum += share;
            height += share * z;
            above += share * std::max(z - 400.0, 0.0);
            below += share * std::max(400.0 - z, 0.0);
        }
    }
    const double tolerance_m = kReliefM * (4e-4 + chordShare(tested));
    EXPECT_NEAR(area.mean_m, height / sum, tolerance_m);
    EXPECT_NEAR(*area.volume_above_m3 / area.covered_m2, above / sum, tolerance_m);
    EXPECT_NEAR(*area.volume_below_m3 / area.covered_m2, below / sum, tolerance_m);
}

TEST_P(AreaInCap, IsTheSumOfItsParts)
{
    const PolarMap& tested = GetParam();
    MapMaker maker;
    const auto map = rough(maker, tested, 1000.0);
    MeasuredTerrain terrain = terrainOf(*map);
    const AreaOptions options{.base = VolumeBase::Elevation, .base_m = 500.0};
    const std::vector<GroundPosition> whole = ring(tested, 1.4, 12, 0.0);
    const TerrainArea all = areaIn(terrain, whole, options);
    double covered = 0.0;
    double surface = 0.0;
    double above = 0.0;
    double height = 0.0;
    for (std::size_t first = 0; first < 12; first += 4) {
        std::vector<GroundPosition> part{polar(tested, 0.0, 0.0)};
        for (std::size_t i = first; i <= first + 4; ++i) {
            part.push_back(whole[i % 12]);
        }
        const TerrainArea area = areaIn(terrain, part, options);
        covered += area.covered_m2;
        surface += area.surface_m2;
        above += *area.volume_above_m3;
        height += area.mean_m * area.covered_m2;
    }
    // The edges on the grid, and between the chords and the circle of samples.
    const double share = 1e-6 + 0.01 * chordShare(tested);
    EXPECT_NEAR(covered, all.covered_m2, share * all.covered_m2);
    EXPECT_NEAR(surface, all.surface_m2, share * all.surface_m2);
    EXPECT_NEAR(above, *all.volume_above_m3, share * *all.volume_above_m3);
    EXPECT_NEAR(height / covered, all.mean_m, share * 1000.0);
}

INSTANTIATE_TEST_SUITE_P(Maps, AreaInCap, testing::ValuesIn(kPolarMaps), [](const auto& tested) {
    return tested.param.name;
});

TEST(AreaInCap, OmitsTrianglesWithoutTerrain)
{
    const PolarMap& tested = kPolarMaps[0];
    MapMaker maker;
    const auto map = maker.make(tested.place, [](std::size_t c, std::size_t r) {
        return c == 701 && r == 0 ? std::numeric_limits<double>::quiet_NaN() : 100.0;
    });
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainArea area = areaIn(terrain, ring(tested, 0.99, 90));
    const double missing = 1.0 - area.covered_m2 / area.geodesic_m2;
    EXPECT_GT(missing, 1e-6);
    EXPECT_LT(missing, 0.01);
    EXPECT_NEAR(area.mean_m, 100.0, 1e-9);
    EXPECT_NEAR(area.hypsometry.totalM2(), area.covered_m2, 1e-9 * area.covered_m2);
}

// The part beyond the outermost row of a map that ends at 80° N is missing.
TEST(AreaInCap, IsEmptyWhereAMapDoesNotReachThePole)
{
    const PolarMap open{"Open", {360, 20, {0, 1, 0, 80.5, 0, -1}, "IAU_2015:30100"}, 90.0, 10.0};
    MapMaker maker;
    const auto map = flat(maker, open, 100.0);
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainArea area = areaIn(terrain, ring(open, 1.8, 720));
    const auto cap = [](double latitude_deg) {
        return 1.0 - std::sin(latitude_deg * kRadiansPerDegree);
    };
    EXPECT_NEAR(area.covered_m2 / area.geodesic_m2, 1.0 - cap(80.0) / cap(72.0), 1e-4);
}

} // namespace marsview::test
