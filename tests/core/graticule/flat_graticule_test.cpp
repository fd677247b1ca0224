#include "core/graticule/flat_graticule.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_terrain.h"
#include "tests/support/map_maker.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

constexpr Viewport kPicture{1600, 1000};

struct Place {
    const char* crs; // of the map
    const char* geographic;
    double pixel; // in units of the CRS
    double x;     // of the middle of the map
    double y;
    double relief_m;
};

// A map of 400 × 300 samples with hills, at the place.
std::shared_ptr<const Map> mapAt(const Place& place)
{
    MapMaker maker;
    return maker.make({.columns = 400,
                       .rows = 300,
                       .transform = {place.x - 200.0 * place.pixel, place.pixel, 0.0,
                                     place.y + 150.0 * place.pixel, 0.0, -place.pixel},
                       .srs = place.crs},
                      [&place](std::size_t column, std::size_t row) {
                          return place.relief_m * std::sin(0.05 * static_cast<double>(column)) *
                                 std::cos(0.07 * static_cast<double>(row));
                      });
}

OrbitCamera cameraOver(const SceneSurface& ground, double distance_m, double tilt_deg)
{
    OrbitCamera camera;
    camera.target = {0.0, 0.0, ground.height(0.0, 0.0)};
    camera.distance_m = distance_m;
    camera.tilt = Angle::degrees(tilt_deg);
    return camera;
}

// Longitudes and latitudes of points of the scene, by GDAL's own program.
std::vector<Position>
geographic(const Map& map, const Place& place, const std::vector<ScenePoint>& points)
{
    std::vector<Position> positions;
    for (const ScenePoint& point : points) {
        const MapPoint p = map.georeference().toMap(map.georeference().sceneFrame().toGrid(point));
        positions.push_back({p.x, p.y});
    }
    return transformed(place.crs, place.geographic, positions);
}

} // namespace

TEST(Graticule, StepsAreOneTwoAndFive)
{
    const auto decimal = [](double least) {
        return graticuleStep(AngleNotation::DecimalDegrees, Angle::degrees(least)).degrees();
    };
    EXPECT_DOUBLE_EQ(decimal(1e-9), 1e-9);
    EXPECT_DOUBLE_EQ(decimal(0.00011), 0.0002);
    EXPECT_DOUBLE_EQ(decimal(0.3), 0.5);
    EXPECT_DOUBLE_EQ(decimal(0.6), 1.0);
    EXPECT_DOUBLE_EQ(decimal(3.0), 5.0);
    EXPECT_DOUBLE_EQ(decimal(11.0), 15.0);
    EXPECT_DOUBLE_EQ(decimal(16.0), 30.0);
    EXPECT_DOUBLE_EQ(decimal(300.0), 90.0);
    const auto minutes = [](double least_minutes) {
        return graticuleStep(AngleNotation::DegreesMinutesSeconds,
                             Angle::degrees(least_minutes / 60.0))
                   .degrees() *
               60.0;
    };
    EXPECT_DOUBLE_EQ(minutes(21.0), 30.0);
    EXPECT_DOUBLE_EQ(minutes(1.5), 2.0);
    EXPECT_DOUBLE_EQ(minutes(0.6), 1.0);
    EXPECT_NEAR(minutes(0.4), 0.5, 1e-12); // 30″
    EXPECT_NEAR(minutes(0.015), 1.0 / 60.0, 1e-12);
    EXPECT_NEAR(minutes(0.001), 0.1 / 60.0, 1e-12); // 0.06″ → 0.1″
    EXPECT_DOUBLE_EQ(minutes(40.0), 60.0);
}

TEST(Graticule, LinesLieOnTheirMeridiansAndParallelsAtEveryScale)
{
    const Place places[] = {
        // A rover's map of 1 cm samples, UTM and Mars; whole regions; polar stereographic.
        {"EPSG:32611", "EPSG:4326", 0.01, 512345.6, 4012345.6, 0.2},
        {"EPSG:32611", "EPSG:4326", 30.0, 512345.6, 4012345.6, 300.0},
        {"EPSG:3031", "EPSG:4326", 5000.0, 123456.0, -234567.0, 4000.0},
        {"EPSG:3413", "EPSG:4326", 200.0, -654321.0, -1234567.0, 2000.0},
        {"EPSG:4326", "EPSG:4326", 0.01, 11.3, 46.7, 4000.0},
        {"EPSG:3857", "EPSG:4326", 1.0, 1.3e6, 6e6, 10.0},
        {"IAU_2015:49910", "IAU_2015:49900", 1000.0, 1.234e6, -2.345e6, 8000.0},
        {"IAU_2015:30130", "IAU_2015:30100", 2000.0, 1234.0, 5678.0, 5000.0},
    };
    double worst_px = 0.0;
    std::size_t count = 0;
    for (const Place& place : places) {
        SCOPED_TRACE(place.crs);
        const auto map = mapAt(place);
        const SceneSurface ground{std::vector{map}};
        const double extent_m = ground.box(1.0).extent_m();
        std::vector<ScenePoint> points;
        std::vector<GraticuleLine> lines;
        std::vector<double> pixels_m;
        for (const double tilt_deg : {0.0, 60.0}) {
            for (const double share : {1.2, 0.1}) {
                const OrbitCamera camera = cameraOver(ground, share * extent_m, tilt_deg);
                const Graticule graticule =
                    graticuleOf(ground, camera,
                                {.viewport = kPicture, .latitudes = LatitudeKind::Planetographic});
                EXPECT_GE(graticule.lines.size(), 2U) << tilt_deg << ' ' << share;
                for (const GraticuleLine& line : graticule.lines) {
                    for (std::size_t i = 0; i < line.points.size();
                         i += 1 + line.points.size() / 20) {
                        points.push_back(line.points[i]);
                        lines.push_back({.axis = line.axis, .value = line.value, .points = {}});
                        pixels_m.push_back(
                            std::abs(metersPerPixel(camera, kPicture, line.points[i])));
                    }
                }
            }
        }
        const std::vector<Position> truth = geographic(*map, place, points);
        const double meters_per_degree =
            map->georeference().crs()->ellipsoid()->equatorial_m * std::numbers::pi / 180.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double value = lines[i].value.degrees();
            const bool is_meridian = lines[i].axis == GraticuleAxis::Meridian;
            const double off_deg = is_meridian ? std::remainder(truth[i].x - value, 360.0) *
                                                     std::cos(truth[i].y * std::numbers::pi / 180.0)
                                               : truth[i].y - value;
            const double off_m = std::abs(off_deg) * meters_per_degree;
            worst_px = std::max(worst_px, off_m / pixels_m[i]);
            ASSERT_LT(off_m, 0.5 * pixels_m[i])
                << (is_meridian ? "meridian " : "parallel ") << value;
            // On the terrain.
            ASSERT_NEAR(points[i].z, ground.height(points[i].x, points[i].y), 1e-6);
        }
        count += points.size();
    }
    std::printf("%zu points, at most %.3f pixels beside their line\n", count, worst_px);
}

TEST(Graticule, APolarMapHasAllMeridians)
{
    const auto map = mapAt({"IAU_2015:30130", "IAU_2015:30100", 2000.0, 0.0, 0.0, 5000.0});
    const SceneSurface ground{std::vector{map}};
    const Graticule graticule = graticuleOf(
        ground, cameraOver(ground, 1.2 * ground.box(1.0).extent_m(), 0.0), {.viewport = kPicture});
    std::set<int> meridians;
    for (const GraticuleLine& line : graticule.lines) {
        if (line.axis == GraticuleAxis::Meridian) {
            meridians.insert(static_cast<int>(std::lround(line.value.degrees() + 360.0)) % 360);
        }
    }
    EXPECT_EQ(meridians.size(), 12U);
}

TEST(Graticule, TheWholeGlobeHasAFewLinesFromEdgeToEdge)
{
    JobMonitor monitor;
    const auto map = *readMap(RasterSpec{.path = bundledMars()}, monitor, std::size_t{1} << 28);
    const SceneSurface ground{std::vector{map}};
    const OrbitCamera camera = cameraOver(ground, 1.2 * ground.box(1.0).extent_m(), 0.0);
    const auto begin = std::chrono::steady_clock::now();
    const Graticule graticule = graticuleOf(ground, camera, {.viewport = kPicture});
    std::printf("%zu lines in %.2f ms\n", graticule.lines.size(),
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                    .count());
    EXPECT_DOUBLE_EQ(graticule.latitude_step.degrees(), 30.0);
    std::size_t meridians = 0;
    for (const GraticuleLine& line : graticule.lines) {
        meridians += line.axis == GraticuleAxis::Meridian ? 1U : 0U;
        const auto end = labelEnd(line, camera, kPicture);
        ASSERT_TRUE(end);
    }
    EXPECT_EQ(meridians, 11U); // 0° and 360° are half a sample outside the outermost ones
    EXPECT_EQ(graticule.lines.size() - meridians, 5U);
}

TEST(Graticule, LinesFollowTheTerrainWithinItsCells)
{
    // Samples 14.8 km apart, some 300 pixels.
    JobMonitor monitor;
    const auto map = *readMap(RasterSpec{.path = bundledMars()}, monitor, std::size_t{1} << 28);
    const SceneSurface ground{std::vector{map}};
    OrbitCamera camera = cameraOver(ground, 5e4, 30.0);
    const double x = 1.2e6;
    const double y = -8e5;
    camera.target = {x, y, 10.0 * ground.height(x, y)};
    const Graticule graticule =
        graticuleOf(ground, camera, {.viewport = kPicture, .exaggeration = 10.0});
    std::size_t pieces = 0;
    std::size_t ends = 0;
    for (const GraticuleLine& line : graticule.lines) {
        ends += labelEnd(line, camera, kPicture) ? 1U : 0U;
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            const ScenePoint middle = (line.points[i - 1] + line.points[i]) * 0.5;
            const double off_m = std::abs(middle.z - 10.0 * ground.height(middle.x, middle.y));
            ASSERT_LT(off_m, 3.0 * std::abs(metersPerPixel(camera, kPicture, middle)));
            ++pieces;
        }
    }
    EXPECT_GT(pieces, 500U);
    EXPECT_GE(ends, 8U);
}

TEST(Graticule, VoidsInterruptLinesAndMapsWithoutLongitudesHaveNone)
{
    MapMaker maker;
    const auto holed =
        maker.make({.columns = 400, .rows = 300, .srs = "EPSG:32611"},
                   [](std::size_t column, std::size_t row) {
                       const bool is_hole = column > 150 && column < 250 && row > 100 && row < 200;
                       return is_hole ? std::numeric_limits<double>::quiet_NaN() : 10.0;
                   });
    const SceneSurface ground{std::vector{holed}};
    const Graticule graticule =
        graticuleOf(ground, cameraOver(ground, 20000.0, 0.0), {.viewport = kPicture});
    EXPECT_FALSE(graticule.lines.empty());
    for (const GraticuleLine& line : graticule.lines) {
        for (const ScenePoint& point : line.points) {
            ASSERT_TRUE(std::isfinite(point.z));
        }
    }
    const auto local = maker.make({}, [](std::size_t, std::size_t) { return 1.0; });
    const SceneSurface plane{std::vector{local}};
    EXPECT_TRUE(
        graticuleOf(plane, cameraOver(plane, 50.0, 0.0), {.viewport = kPicture}).lines.empty());
}

} // namespace marsview::test
