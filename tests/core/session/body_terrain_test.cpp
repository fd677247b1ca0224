#include "core/globe/body_camera.h"
#include "core/session/body_terrain.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

constexpr double kExaggeration = 3.0;

struct Placed {
    const char* name;
    MapMaker::Place place;
};

std::vector<Placed> placedMaps()
{
    return {{"whole", {72, 36, {0, 5, 0, 90, 0, -5}, "IAU_2015:49900"}},
            {"whole from -180", {72, 36, {-180, 5, 0, 90, 0, -5}, "IAU_2015:49900"}},
            {"repeated column", {73, 37, {-2.5, 5, 0, 92.5, 0, -5}, "IAU_2015:49900"}},
            {"part", {60, 50, {130, 0.01, 0, -4.5, 0, -0.01}, "IAU_2015:49900"}},
            {"polar", {80, 80, {-4e5, 1e4, 0, 4e5, 0, -1e4}, "IAU_2015:49930"}},
            {"UTM", {60, 50, {4e5, 30, 0, 5.5e6, 0, -30}, "EPSG:32633"}}};
}

BodyTerrain terrainOf(MapMaker& maker, const MapMaker::Place& place)
{
    const auto map = maker.make(place, [&](std::size_t column, std::size_t row) {
        // Around the body, a repeated column has the heights of the first one.
        const std::size_t period = place.columns == 73 ? 72 : place.columns;
        const double relief_m = std::string_view(place.srs).starts_with("EPSG") ? 9.0 : 180.0;
        return relief_m * std::sin(0.9 * static_cast<double>(column % period)) *
               std::cos(0.7 * static_cast<double>(row));
    });
    JobMonitor monitor;
    return {map, BodyGrid::make(map->georeference(), monitor).value()};
}

TEST(BodyTerrain, ARayHitsTheFirstPointThatIsNotAboveTheTerrain)
{
    MapMaker maker;
    test::Random random(71);
    for (const Placed& placed : placedMaps()) {
        const BodyTerrain terrain = terrainOf(maker, placed.place);
        const Ellipsoid& body = terrain.grid()->ellipsoid();
        const double cell_m = terrain.grid()->stepMaxM();
        int hits = 0;
        for (int i = 0; i < 150; ++i) {
            const auto foot = terrain.map()->georeference().toGeographic(
                {random.uniform(0.0, static_cast<double>(placed.place.columns - 1)),
                 random.uniform(0.0, static_cast<double>(placed.place.rows - 1))});
            ASSERT_TRUE(foot);
            const BodyCamera camera{.target = *foot,
                                    .height_m = random.uniform(-2700.0, 2700.0),
                                    .distance_m = cell_m * random.uniform(5.0, 50.0) + 2e4,
                                    .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
                                    .tilt = Angle::degrees(random.uniform(0.0, 85.0))};
            const CameraPose pose = poseOf(camera, body);
            const Ray ray{pose.eye, pose.axes.forward};
            const auto clearance = [&](double t) {
                const BodyPlace place = placeOf(ray.at(t), body);
                return place.height_m - kExaggeration * terrain.height(place.foot);
            };
            if (placeOf(ray.origin, body).height_m < 3000.0) {
                continue; // not above all terrain
            }
            const auto hit = terrain.cast(ray, kExaggeration);
            const double end = hit ? hit->distance_m : 3.0 * camera.distance_m;
            bool is_from_the_side = false; // under the terrain from the map's edge on
            double before_m = 0.0;
            for (int step = 0; step < 3000 && !is_from_the_side; ++step) {
                const double t = (end - 0.01 * cell_m) * step / 3000.0;
                const double clear_m = clearance(t);
                is_from_the_side = clear_m < 0.0 && std::isnan(before_m);
                ASSERT_FALSE(clear_m < -3.0 && !is_from_the_side)
                    << placed.name << ' ' << i << ": " << clear_m << " m at " << t << " of " << end;
                before_m = clear_m;
            }
            if (hit) {
                ++hits;
                EXPECT_NEAR(clearance(hit->distance_m), 0.0, 0.01) << placed.name << ' ' << i;
                const BodyPlace place = placeOf(ray.at(hit->distance_m), body);
                const auto grid = terrain.gridAt(place.foot);
                ASSERT_TRUE(grid) << placed.name << ' ' << i;
                EXPECT_NEAR(grid->column, hit->grid.column, 1e-6) << placed.name << ' ' << i;
                EXPECT_NEAR(grid->row, hit->grid.row, 1e-6) << placed.name << ' ' << i;
                EXPECT_NEAR(terrain.heightOnGrid(*grid), hit->height_m, 0.01);
            }
        }
        EXPECT_GT(hits, 40) << placed.name;
    }
}

TEST(BodyTerrain, LongitudeIsPeriodicAndThePolesAreCovered)
{
    MapMaker maker;
    const BodyTerrain terrain = terrainOf(maker, placedMaps().front().place);
    for (const double latitude_deg : {-89.99, -90.0, -40.0, 0.0, 89.9, 90.0}) {
        for (double longitude_deg = -181.0; longitude_deg < 180.0; longitude_deg += 7.0) {
            const auto height = [&](double turns) {
                return terrain.height({.longitude = Angle::degrees(longitude_deg + 360.0 * turns),
                                       .latitude = Angle::degrees(latitude_deg)});
            };
            EXPECT_TRUE(std::isfinite(height(0.0))) << latitude_deg << ' ' << longitude_deg;
            EXPECT_NEAR(height(-2.0), height(0.0), 1e-6);
            EXPECT_NEAR(height(1.0), height(0.0), 1e-6);
        }
    }
}

TEST(BodyTerrain, PartsOfABodyEndAtTheirOutermostSamples)
{
    MapMaker maker;
    for (const Placed& placed : placedMaps()) {
        const BodyTerrain terrain = terrainOf(maker, placed.place);
        if (terrain.grid()->closes()) {
            continue;
        }
        const auto opposite = terrain.map()->georeference().toGeographic({20.0, 20.0});
        ASSERT_TRUE(opposite);
        EXPECT_TRUE(
            std::isnan(terrain.height({.longitude = opposite->longitude + Angle::degrees(180.0),
                                       .latitude = Angle::degrees(-opposite->latitude.degrees())})))
            << placed.name;
        const Vec3 away = footOf(terrain.grid()->ellipsoid(), *opposite).normal;
        EXPECT_FALSE(terrain.cast({away * -1e8, away * -1.0}, 1.0)) << placed.name;
    }
}

// A polar map in degrees, over its map of the pole, over all of Mars.
TEST(BodyScene, TheTerrainIsThatOfTheUppermostMapWithASurface)
{
    MapMaker maker;
    const auto level = [&maker](const MapMaker::Place& place, double height_m) {
        const auto map =
            maker.make(place, [height_m](std::size_t, std::size_t) { return height_m; });
        JobMonitor monitor;
        return BodyTerrain(map, BodyGrid::make(map->georeference(), monitor).value());
    };
    const BodyScene scene({level({90, 20, {100, 1, 0, 85, 0, -1}, "IAU_2015:49900"}, -300.0),
                           level({80, 80, {-8e5, 2e4, 0, 8e5, 0, -2e4}, "IAU_2015:49930"}, 100.0),
                           level({72, 36, {0, 5, 0, 90, 0, -5}, "IAU_2015:49900"}, 200.0)});
    struct Known {
        double longitude_deg;
        double latitude_deg;
        std::size_t index;
        double height_m;
    };
    for (const Known& known :
         {Known{120.0, 80.0, 0, -300.0}, Known{50.0, 80.0, 1, 100.0}, Known{-170.0, 89.9, 1, 100.0},
          Known{120.0, 40.0, 2, 200.0}, Known{0.001, -89.0, 2, 200.0}}) {
        const GeographicPoint place{.longitude = Angle::degrees(known.longitude_deg),
                                    .latitude = Angle::degrees(known.latitude_deg)};
        EXPECT_EQ(scene.mapAt(place), known.index);
        EXPECT_DOUBLE_EQ(scene.height(place), known.height_m);
        // From straight above, the rays pass through surfaces that are covered.
        const CameraPose pose = poseOf({.target = place, .distance_m = 1e5}, scene.ellipsoid());
        const auto ground = scene.cast({pose.eye, pose.axes.forward}, kExaggeration);
        ASSERT_TRUE(ground) << known.latitude_deg;
        EXPECT_EQ(ground->index, known.index);
        EXPECT_NEAR(ground->hit.height_m, known.height_m, 1e-6);
        EXPECT_NEAR(ground->hit.distance_m, 1e5 - kExaggeration * known.height_m, 1.0);
    }
    EXPECT_DOUBLE_EQ(scene.range().minimum_m, -300.0);
    EXPECT_DOUBLE_EQ(scene.range().maximum_m, 200.0);
    EXPECT_TRUE(BodyScene().isEmpty());
}

} // namespace
} // namespace marsview
