#include "core/measure/terrain_area.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

TerrainArea areaOf(MeasuredTerrain& terrain,
                   const std::vector<GroundPosition>& vertices,
                   const AreaOptions& options = {})
{
    JobMonitor monitor;
    const auto area = measureArea(terrain, vertices, options, monitor);
    EXPECT_TRUE(area) << (area ? "" : area.error().message);
    return area.value();
}

// A map in meters without a CRS, around the origin: 801 × 801 samples of 5 m.
std::shared_ptr<const Map> planeMap(MapMaker& maker, const std::function<double(double, double)>& z)
{
    constexpr std::size_t kSide = 801;
    constexpr double kStepM = 5.0;
    return maker.make({.columns = kSide,
                       .rows = kSide,
                       .transform = {-2002.5, kStepM, 0.0, 2002.5, 0.0, -kStepM},
                       .srs = ""},
                      [&](std::size_t c, std::size_t r) {
                          return z(kStepM * (static_cast<double>(c) - 400.0),
                                   kStepM * (400.0 - static_cast<double>(r)));
                      });
}

std::vector<GroundPosition> star(Random& random, double reach, std::size_t count)
{
    std::vector<GroundPosition> vertices;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        const double r = reach * random.uniform(0.2, 1.0);
        vertices.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return vertices;
}

const std::vector<GroundPosition> kSquare{
    {-1900, -1900}, {1900, -1900}, {1900, 1900}, {-1900, 1900}};

} // namespace

TEST(TerrainArea, VolumesAreThoseOfClosedForms)
{
    struct Body {
        const char* name;
        std::function<double(double, double)> z;
        double above_m3;
        double below_m3;
    };
    constexpr double kRadiusM = 1500.0;
    constexpr double kHeightM = 300.0;
    const std::vector<Body> bodies{
        {"cone",
         [](double x, double y) {
             return std::max(0.0, kHeightM * (1.0 - std::hypot(x, y) / kRadiusM));
         },
         std::numbers::pi * kRadiusM * kRadiusM * kHeightM / 3.0, 0.0},
        {"bowl",
         [](double x, double y) {
             return std::min(0.0, kHeightM * ((x * x + y * y) / (kRadiusM * kRadiusM) - 1.0));
         },
         0.0, std::numbers::pi * kRadiusM * kRadiusM * kHeightM / 2.0},
        {"pyramid",
         [](double x, double y) {
             return std::max(0.0, kHeightM * (1.0 - std::max(std::abs(x), std::abs(y)) / kRadiusM));
         },
         4.0 * kRadiusM * kRadiusM * kHeightM / 3.0, 0.0},
        // Half above and half below, with the edge along x = 0.
        {"wedge", [](double x, double) { return kHeightM * x / 1900.0; },
         3800.0 * 1900.0 * kHeightM / 2.0, 3800.0 * 1900.0 * kHeightM / 2.0},
    };
    MapMaker maker;
    for (const Body& body : bodies) {
        SCOPED_TRACE(body.name);
        const auto map = planeMap(maker, body.z);
        MeasuredTerrain terrain = terrainOf(*map);
        const TerrainArea area = areaOf(terrain, kSquare, {.base = VolumeBase::Elevation});
        const double truth = body.above_m3 + body.below_m3;
        std::printf("%s: above %+.2g %%, below %+.2g %% of its volume off\n", body.name,
                    100.0 * (*area.volume_above_m3 - body.above_m3) / truth,
                    100.0 * (*area.volume_below_m3 - body.below_m3) / truth);
        EXPECT_NEAR(*area.volume_above_m3, body.above_m3, 1e-4 * truth);
        EXPECT_NEAR(*area.volume_below_m3, body.below_m3, 1e-4 * truth);
        EXPECT_NEAR(area.geodesic_m2, 3800.0 * 3800.0, 1e-3);
        EXPECT_NEAR(area.covered_m2, 3800.0 * 3800.0, 1e-3);
        EXPECT_NEAR(area.mean_m * area.covered_m2, body.above_m3 - body.below_m3, 1e-4 * truth);
        EXPECT_FALSE(area.crosses_itself);
    }
}

TEST(TerrainArea, PlaneThroughTheBorderRemovesATrend)
{
    // A bowl in an inclined plane: its border lies in that plane.
    MapMaker maker;
    const double radius_m = 1000.0;
    const auto map = planeMap(maker, [&](double x, double y) {
        return 500.0 + 0.2 * x - 0.1 * y +
               std::min(0.0, 200.0 * ((x * x + y * y) / (radius_m * radius_m) - 1.0));
    });
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainArea area =
        areaOf(terrain, {{-1500, -1300}, {1700, -1500}, {1600, 1800}, {-1400, 1500}},
               {.base = VolumeBase::BorderPlane});
    const double truth = std::numbers::pi * radius_m * radius_m * 200.0 / 2.0;
    EXPECT_NEAR(*area.volume_below_m3, truth, 1e-4 * truth);
    EXPECT_NEAR(*area.volume_above_m3, 0.0, 1e-4 * truth);
}

TEST(TerrainArea, OfAnInclinedPlaneIsThatOfItsPolygonOverTheCosineOfItsDip)
{
    Random random;
    MapMaker maker;
    const auto map = planeMap(maker, [](double x, double y) { return 0.75 * x + 0.5 * y; });
    MeasuredTerrain terrain = terrainOf(*map);
    for (int i = 0; i < 20; ++i) {
        std::vector<GroundPosition> polygon = star(random, 1900.0, 3 + random.below(10));
        const TerrainArea area = areaOf(terrain, polygon);
        const double stretch = std::sqrt(1.0 + 0.75 * 0.75 + 0.5 * 0.5);
        EXPECT_NEAR(area.surface_m2, area.geodesic_m2 * stretch, 1e-7 * area.geodesic_m2);
        EXPECT_NEAR(area.covered_m2, area.geodesic_m2, 1e-7 * area.geodesic_m2);
        double low_m = std::numeric_limits<double>::infinity();
        double high_m = -low_m;
        for (const GroundPosition& vertex : polygon) {
            low_m = std::min(low_m, 0.75 * vertex.x + 0.5 * vertex.y);
            high_m = std::max(high_m, 0.75 * vertex.x + 0.5 * vertex.y);
        }
        EXPECT_NEAR(area.min_m, low_m, 1e-3);
        EXPECT_NEAR(area.max_m, high_m, 1e-3);
        // Neither the direction nor the first vertex matters, nor that it is written closed.
        std::reverse(polygon.begin(), polygon.end());
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
        polygon.push_back(polygon.front());
        const TerrainArea same = areaOf(terrain, polygon);
        EXPECT_NEAR(same.surface_m2, area.surface_m2, 1e-9 * area.surface_m2);
        EXPECT_NEAR(same.mean_m, area.mean_m, 1e-9 * std::abs(area.mean_m) + 1e-6);
    }
}

TEST(TerrainArea, OfRoughTerrainIsTheSumOverFinePoints)
{
    Random random;
    MapMaker maker;
    constexpr std::size_t kSide = 24;
    std::vector<double> heights;
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
        heights.push_back(random.chance(0.03) ? std::numeric_limits<double>::quiet_NaN()
                                              : random.uniform(-50.0, 50.0));
    }
    const auto map =
        maker.make({.columns = kSide,
                    .rows = kSide,
                    .transform = {-12.0, 1.0, 0.0, 12.0, 0.0, -1.0},
                    .srs = ""},
                   [&](std::size_t c, std::size_t r) { return heights[r * kSide + c]; });
    MeasuredTerrain terrain = terrainOf(*map);
    for (int i = 0; i < 12; ++i) {
        const std::vector<GroundPosition> polygon =
            star(random, 15.0, 4 + random.below(7)); // partly off the map
        const TerrainArea area =
            areaOf(terrain, polygon, {.base = VolumeBase::Elevation, .base_m = 7.0});
        constexpr int kFine = 60;
        double covered = 0.0;
        double sum = 0.0;
        double above = 0.0;
        double below = 0.0;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (int y = -15 * kFine; y < 15 * kFine; ++y) {
            for (int x = -15 * kFine; x < 15 * kFine; ++x) {
                const double px = (x + 0.5) / kFine;
                const double py = (y + 0.5) / kFine;
                if (!isInside(polygon, px, py)) {
                    continue;
                }
                const double z = terrain.elevation(GroundPosition{px, py});
                if (std::isfinite(z)) {
                    covered += 1.0;
                    sum += z;
                    above += std::max(0.0, z - 7.0);
                    below += std::max(0.0, 7.0 - z);
                    low = std::min(low, z);
                    high = std::max(high, z);
                }
            }
        }
        const double cell = 1.0 / (kFine * kFine);
        EXPECT_NEAR(area.covered_m2, covered * cell, 1e-3 * covered * cell);
        EXPECT_NEAR(area.mean_m, sum / covered, 0.05);
        EXPECT_NEAR(*area.volume_above_m3, above * cell, 2e-3 * (above + below) * cell);
        EXPECT_NEAR(*area.volume_below_m3, below * cell, 2e-3 * (above + below) * cell);
        EXPECT_LE(area.min_m, low);
        EXPECT_GE(area.max_m, high);
        EXPECT_NEAR(area.min_m, low, 3.0);
        EXPECT_NEAR(area.max_m, high, 3.0);
    }
}

TEST(TerrainArea, CoversGeodesicPolygonsInEveryProjection)
{
    Random random;
    MapMaker maker;
    const auto level = [](std::size_t, std::size_t) { return 0.0; };
    const std::vector<MapMaker::Place> places{
        {.columns = 120,
         .rows = 100,
         .transform = {500000, 3000, 0, 4000000, 0, -3000},
         .srs = "EPSG:32610"},
        {.columns = 150,
         .rows = 150,
         .transform = {-1500000, 20000, 0, 1500000, 0, -20000},
         .srs = "+proj=stere +lat_0=90 +lon_0=20 +a=3396190 +b=3376200"},
        {.columns = 100,
         .rows = 100,
         .transform = {-500000, 10000, 1500, 500000, 1200, -9000},
         .srs = "+proj=laea +lat_0=-40 +lon_0=170 +a=3396190 +b=3376200"},
        {.columns = 120,
         .rows = 110,
         .transform = {5.0, 0.1, 0.0, 71.0, 0.0, -0.1},
         .srs = "EPSG:4326"},
        {.columns = 100,
         .rows = 100,
         .transform = {-300000, 6000, 0, 1800000, 0, -6000},
         .srs = "+proj=eqc +lon_0=30 +R=1737400"},
    };
    for (const MapMaker::Place& place : places) {
        SCOPED_TRACE(place.srs);
        const auto map = maker.make(place, level);
        MeasuredTerrain terrain = terrainOf(*map);
        double worst = 0.0;
        for (int i = 0; i < 20; ++i) {
            std::vector<GroundPosition> polygon;
            for (const GroundPosition& p : star(random, 0.4, 3 + random.below(8))) {
                polygon.push_back(
                    *terrain.fromGrid({static_cast<double>(place.columns) * (0.5 + p.x),
                                       static_cast<double>(place.rows) * (0.5 + p.y)}));
            }
            const TerrainArea area = areaOf(terrain, polygon);
            worst = std::max(worst, std::abs(area.covered_m2 / area.geodesic_m2 - 1.0));
            EXPECT_NEAR(area.surface_m2, area.covered_m2, 1e-12 * area.covered_m2);
        }
        std::printf("%s: %.2g of the area off\n", place.srs.c_str(), worst);
        EXPECT_LT(worst, 5e-6); // cells of 20 km
    }
}

TEST(TerrainArea, CoversPolygonsAcrossTheSeamAndAroundAPole)
{
    MapMaker maker;
    // 1° over the whole Moon.
    const auto map = maker.make({.columns = 360,
                                 .rows = 180,
                                 .transform = {0.0, 1.0, 0.0, 90.0, 0.0, -1.0},
                                 .srs = "IAU_2015:30100"},
                                [](std::size_t, std::size_t) { return 100.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    const double radius_m = 1737400.0;
    const double sphere_m2 = 4.0 * std::numbers::pi * radius_m * radius_m;
    const auto check = [&](const std::vector<GroundPosition>& polygon, const char* name) {
        for (const double turn : {0.0, 360.0, -360.0}) {
            for (const bool is_reversed : {false, true}) {
                std::vector<GroundPosition> moved = polygon;
                for (GroundPosition& vertex : moved) {
                    vertex.x += turn;
                }
                if (is_reversed) {
                    std::reverse(moved.begin(), moved.end());
                }
                const TerrainArea area = areaOf(terrain, moved);
                EXPECT_NEAR(area.covered_m2, area.geodesic_m2, 2e-5 * area.geodesic_m2) << name;
                EXPECT_NEAR(area.mean_m, 100.0, 1e-9) << name;
                EXPECT_LE(area.geodesic_m2, 0.5 * sphere_m2 * (1.0 + 1e-9)) << name;
                EXPECT_FALSE(area.crosses_itself) << name;
            }
        }
    };
    check({{350, -10}, {10, -12}, {12, 20}, {351, 15}}, "seam");
    check({{170, 10}, {190, 12}, {180, 30}}, "date line");
    check({{10, 60}, {130, 55}, {250, 70}}, "north pole");
    check({{10, -60}, {130, -55}, {250, -70}}, "south pole");
    check({{0, 80}, {90, 80}, {180, 80}, {270, 80}}, "square around the north pole");
    check({{0, 90}, {90, 70}, {180, 70}}, "vertex at the north pole");
    check({{0, -90}, {90, -70}, {180, -70}}, "vertex at the south pole");
    check({{0, 90}, {20, 70}, {110, 70}, {200, 70}, {290, 70}}, "three quarters around a pole");
    check({{10, 80}, {190, 80}, {100, 60}}, "edge across the pole");
    check({{10, 5}, {130, -5}, {250, 5}}, "half of the body");
    check({{0, 20},
           {90, 30},
           {180, 20},
           {270, 30},
           {360, 20},
           {360, -5},
           {270, 5},
           {180, -5},
           {90, 5},
           {0, -5}},
          "360° long");
}

TEST(TerrainArea, FindsTheHighestAndTheLowestPlaceInside)
{
    MapMaker maker;
    const auto map = maker.make(
        {.columns = 30, .rows = 30, .transform = {0.0, 1.0, 0.0, 30.0, 0.0, -1.0}, .srs = ""},
        [](std::size_t c, std::size_t r) {
            return c == 10 && r == 12   ? 99.0
                   : c == 20 && r == 20 ? -50.0
                   : c == 2 && r == 2   ? 500.0
                                        : 0.0;
        });
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainArea area = areaOf(terrain, {{5.0, 5.0}, {25.0, 5.0}, {25.0, 25.0}, {5.0, 25.0}});
    EXPECT_EQ(area.max_m, 99.0);
    EXPECT_EQ(area.min_m, -50.0);
}

TEST(TerrainArea, FindsTheHighestPlaceAtEveryCornerOfTheMap)
{
    MapMaker maker;
    for (const std::size_t corner : {0U, 1U, 2U, 3U}) {
        const std::size_t column = corner % 2 == 0 ? 0 : 29;
        const std::size_t row = corner < 2 ? 0 : 29;
        const auto map = maker.make(
            {.columns = 30, .rows = 30, .transform = {0.0, 1.0, 0.0, 30.0, 0.0, -1.0}, .srs = ""},
            [&](std::size_t c, std::size_t r) { return c == column && r == row ? 99.0 : 0.0; });
        MeasuredTerrain terrain = terrainOf(*map);
        // The polygon's edges are outside the map.
        const TerrainArea area =
            areaOf(terrain, {{-5.0, -5.0}, {35.0, -5.0}, {35.0, 35.0}, {-5.0, 35.0}});
        EXPECT_EQ(area.max_m, 99.0) << corner;
        EXPECT_NEAR(area.covered_m2, 29.0 * 29.0, 1e-9);
    }
}

TEST(TerrainArea, ReportsEdgesThatCross)
{
    MapMaker maker;
    const auto map = maker.make(
        {.columns = 30, .rows = 30, .transform = {0.0, 1.0, 0.0, 30.0, 0.0, -1.0}, .srs = ""},
        [](std::size_t, std::size_t) { return 1.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    const TerrainArea eight = areaOf(terrain, {{5.0, 5.0}, {25.0, 25.0}, {25.0, 5.0}, {5.0, 20.0}});
    EXPECT_TRUE(eight.crosses_itself);
    EXPECT_NEAR(eight.covered_m2, eight.geodesic_m2, 1e-9);
    // Parts that count as negative would make these wrong, for example a mean above the highest.
    EXPECT_TRUE(std::isnan(eight.surface_m2) && std::isnan(eight.mean_m));
    EXPECT_TRUE(eight.hypsometry.isEmpty());
    EXPECT_EQ(eight.min_m, 1.0);
    EXPECT_EQ(eight.max_m, 1.0);
}

TEST(TerrainArea, ReportsNoCrossingOfTriangles)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 300,
                                 .rows = 200,
                                 .transform = {-122.165, 0.00027, 0.0, 42.98, 0.0, -0.00027},
                                 .srs = "EPSG:4326"},
                                [](std::size_t, std::size_t) { return 1.0; });
    MeasuredTerrain terrain = terrainOf(*map);
    Random random(7);
    for (int i = 0; i < 30; ++i) {
        std::vector<GroundPosition> triangle;
        for (int k = 0; k < 3; ++k) {
            triangle.push_back({random.uniform(-122.16, -122.09), random.uniform(42.93, 42.975)});
        }
        EXPECT_FALSE(areaOf(terrain, triangle).crosses_itself) << "triangle " << i;
    }
}

TEST(TerrainArea, IsTheSameOfFileTilesAndLevels)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain fine = terrainOf(*mars);
    MeasuredTerrain coarse = terrainOf(*mars, 3);
    const std::vector<GroundPosition> polygon{
        {210.0, 0.0}, {240.0, 5.0}, {235.0, 35.0}, {205.0, 30.0}};
    const TerrainArea exact = areaOf(fine, polygon, {.base = VolumeBase::Elevation});
    const TerrainArea rough = areaOf(coarse, polygon, {.base = VolumeBase::Elevation});
    EXPECT_TRUE(rough.is_approximate);
    EXPECT_EQ(rough.geodesic_m2, exact.geodesic_m2);
    EXPECT_NEAR(rough.covered_m2, exact.covered_m2, 1e-4 * exact.covered_m2);
    EXPECT_NEAR(*rough.volume_above_m3, *exact.volume_above_m3, 0.03 * *exact.volume_above_m3);
    JobMonitor monitor;
    monitor.cancel();
    const auto canceled = measureArea(fine, polygon, {}, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

TEST(TerrainArea, VolumesOnABodyAreMeasuredOnItsEllipsoid)
{
    // A cone of 20 km radius at 60° north, in a geographic map and in a polar one.
    MapMaker maker;
    const Ellipsoid ellipsoid{3396190.0, 3376200.0};
    const Ground ground = Ground::onEllipsoid(ellipsoid);
    const GroundPosition top{30.0, 60.0};
    for (const MapMaker::Place& place :
         {MapMaker::Place{.columns = 500,
         .rows = 300,
         .transform = {29.0, 0.004, 0.0, 60.6, 0.0, -0.004},
         .srs = "+proj=longlat +a=3396190 +b=3376200"},
          MapMaker::Place{.columns = 400,
          .rows = 400,
          .transform = {0.0, 150.0, 0.0, 0.0, 0.0, -150.0},
          .srs = "+proj=stere +lat_0=90 +lon_0=0 +a=3396190 +b=3376200"}}) {
        SCOPED_TRACE(place.srs);
        MapMaker::Place moved = place;
        const auto crs = Crs::fromText(place.srs);
        ASSERT_TRUE(crs);
        if (crs->kind() == CrsKind::Projected) {
            const auto middle = crs->toMap(ground.geographic(top));
            moved.transform[0] = middle->x - 200 * 150.0;
            moved.transform[3] = middle->y + 200 * 150.0;
        }
        const Georeference georeference(moved.columns, moved.rows,
                                        *GeoTransform::fromTerms(moved.transform), *crs);
        constexpr double kRadiusM = 20'000.0;
        const auto map = maker.make(moved, [&](std::size_t c, std::size_t r) {
            const auto at =
                georeference.toGeographic({static_cast<double>(c), static_cast<double>(r)});
            return std::max(
                0.0, 1000.0 * (1.0 - ground.distanceM(top, ground.position(*at)) / kRadiusM));
        });
        MeasuredTerrain terrain = terrainOf(*map);
        std::vector<GroundPosition> border;
        for (int i = 0; i < 24; ++i) {
            border.push_back(ground.ray(top, 15.0 * i).at(25'000.0));
        }
        const double truth = std::numbers::pi * kRadiusM * kRadiusM * 1000.0 / 3.0;
        for (const VolumeBase base : {VolumeBase::Elevation, VolumeBase::BorderPlane}) {
            const TerrainArea area = areaOf(terrain, border, {.base = base});
            std::printf("cone on Mars: %+.2g %% off\n",
                        100.0 * (*area.volume_above_m3 / truth - 1.0));
            EXPECT_NEAR(*area.volume_above_m3, truth, 1e-4 * truth);
            EXPECT_NEAR(area.covered_m2, area.geodesic_m2, 1e-6 * area.geodesic_m2);
        }
    }
}

TEST(TerrainArea, RefusesWhatIsNotAPolygon)
{
    const auto mars = loadedMap(bundledMars());
    MeasuredTerrain terrain = terrainOf(*mars);
    JobMonitor monitor;
    const std::vector<GroundPosition> two{{1.0, 2.0}, {3.0, 4.0}};
    EXPECT_EQ(measureArea(terrain, two, {}, monitor).error().message,
              "an area needs at least 3 positions, but there are 2");
    const std::vector<GroundPosition> large{{0.0, 0.0}, {90.0, 0.0}, {45.0, 60.0}};
    const auto plane = measureArea(terrain, large, {.base = VolumeBase::BorderPlane}, monitor);
    ASSERT_FALSE(plane);
    EXPECT_EQ(plane.error().code, ErrorCode::OutOfRange);
}

} // namespace marsview::test
