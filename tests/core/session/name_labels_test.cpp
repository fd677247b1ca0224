#include "core/globe/body_camera.h"
#include "core/names/names_file.h"
#include "core/session/name_labels.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace marsview::test {
namespace {

constexpr Viewport kWindow{1600, 1000};

std::shared_ptr<const Map> load(const std::string& path)
{
    JobMonitor monitor;
    return *readMap(RasterSpec{.path = path}, monitor, std::size_t{1} << 28);
}

LabelSize sizeOf(const Gazetteer& names, std::size_t name)
{
    return {.width_px = 7.0 * static_cast<double>(names.names()[name].name.size()),
            .height_px = 16.0};
}

// A camera over the map at a height that shows between a thousandth and all of it.
OrbitCamera randomCamera(Random& random, const SceneSurface& ground, double exaggeration)
{
    const SceneBox box = ground.box(1.0);
    OrbitCamera camera;
    const double x = random.uniform(box.minimum.x, box.maximum.x);
    const double y = random.uniform(box.minimum.y, box.maximum.y);
    const double z = ground.height(x, y);
    camera.target = {x, y, std::isfinite(z) ? z * exaggeration : 0.0};
    camera.distance_m = box.extent_m() * std::pow(10.0, random.uniform(-3.0, 0.3));
    camera.azimuth = Angle::degrees(random.uniform(0.0, 360.0));
    camera.tilt = Angle::degrees(random.uniform(0.0, 85.0));
    return camera;
}

} // namespace

class NameLabelsTest : public testing::Test {
protected:
    std::shared_ptr<const Map> map_ = load(bundledMars());
    SceneSurface ground_{std::vector{map_}};
    std::shared_ptr<const Gazetteer> names_ = bundledGazetteer(*map_->info().body);

    std::map<std::string, NameLabel>
    labels(NameLabels& all, const OrbitCamera& camera, double exaggeration = 1.0)
    {
        std::map<std::string, NameLabel> found;
        for (const NameLabel& label :
             all.inPicture(camera, {.viewport = kWindow, .exaggeration = exaggeration},
                           [this](std::size_t name, double) { return sizeOf(*names_, name); })) {
            found[names_->names()[label.name].name] = label;
        }
        return found;
    }
    OrbitCamera over(double longitude_deg, double latitude_deg, double distance_m)
    {
        const GridPoint grid = *map_->georeference().toGrid(
            GeographicPoint{Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)});
        OrbitCamera camera;
        camera.target =
            map_->georeference().sceneFrame().toScene(grid, map_->heightfield().height(grid));
        camera.distance_m = distance_m;
        return camera;
    }
};

TEST_F(NameLabelsTest, NoLabelsOverlapInAThousandRandomViews)
{
    NameLabels all(names_, ground_);
    EXPECT_GT(all.count(), 1780U);
    Random random;
    std::size_t labels = 0;
    std::size_t pictures_with_labels = 0;
    std::chrono::nanoseconds spent{};
    for (int i = 0; i < 1000; ++i) {
        const double exaggeration = std::pow(10.0, random.uniform(0.0, 1.5));
        const OrbitCamera camera = randomCamera(random, ground_, exaggeration);
        const auto begin = std::chrono::steady_clock::now();
        const auto shown =
            all.inPicture(camera, {.viewport = kWindow, .exaggeration = exaggeration},
                          [this](std::size_t name, double) { return sizeOf(*names_, name); });
        spent += std::chrono::steady_clock::now() - begin;
        labels += shown.size();
        pictures_with_labels += shown.empty() ? 0U : 1U;
        for (std::size_t a = 0; a < shown.size(); ++a) {
            ASSERT_TRUE(shown[a].box.left >= 0.0 && shown[a].box.right <= kWindow.width &&
                        shown[a].box.top >= 0.0 && shown[a].box.bottom <= kWindow.height);
            for (std::size_t b = 0; b < a; ++b) {
                ASSERT_FALSE(shown[a].box.overlaps(shown[b].box));
            }
        }
    }
    std::printf("%zu labels in 1000 views, %.2f ms a view\n", labels,
                std::chrono::duration<double, std::milli>(spent).count() / 1000.0);
    EXPECT_GT(labels, 3000U);
    EXPECT_GT(pictures_with_labels, 300U);
}

// With many more names than Mars, most of them of small craters.
TEST(NameLabels, NoneOverlapOnTheMoonEither)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const auto map = load((sharedData() / "moon_lola/LDEM_4.IMG").string());
    const SceneSurface ground{std::vector{map}};
    const auto names = bundledGazetteer(*map->info().body);
    NameLabels all(names, ground);
    EXPECT_GT(all.count(), 8900U);
    Random random;
    std::size_t labels = 0;
    for (int i = 0; i < 300; ++i) {
        const OrbitCamera camera = randomCamera(random, ground, 1.0);
        const auto shown =
            all.inPicture(camera, {.viewport = kWindow},
                          [&](std::size_t name, double) { return sizeOf(*names, name); });
        labels += shown.size();
        for (std::size_t a = 0; a < shown.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                ASSERT_FALSE(shown[a].box.overlaps(shown[b].box));
            }
        }
    }
    EXPECT_GT(labels, 1000U);
}

// 2026-11: in a picture with room for few labels, wide plains had names and the highest mountains
// had none.
TEST_F(NameLabelsTest, HighMountainsKeepTheirNamesWhereLabelsAreFew)
{
    NameLabels all(names_, ground_);
    for (const double azimuth : {300.0, 320.0, 340.0}) {
        OrbitCamera camera = over(266.4, -1.8, 6.5e6);
        camera.target.z *= 10.0;
        camera.azimuth = Angle::degrees(azimuth);
        camera.tilt = Angle::degrees(50.0);
        const NameLabelOptions options{.viewport = {947, 580}, .exaggeration = 10.0};
        std::map<std::string, std::size_t> rank;
        for (const NameLabel& label :
             all.inPicture(camera, options,
                           [this](std::size_t name, double) { return sizeOf(*names_, name); })) {
            rank.emplace(names_->names()[label.name].name, rank.size());
        }
        EXPECT_LE(rank.size(), 18U);
        EXPECT_TRUE(rank.contains("Olympus Mons")) << azimuth;
        EXPECT_TRUE(rank.contains("Ascraeus Mons")) << azimuth;
    }
}

TEST_F(NameLabelsTest, OnTheGlobeNamesLieOverTheirPlacesInFrontOfTheHorizon)
{
    JobMonitor monitor;
    const BodyTerrain terrain(map_, BodyGrid::make(map_->georeference(), monitor).value());
    const BodyScene scene({terrain});
    NameLabels all(names_, scene);
    EXPECT_EQ(all.count(), names_->names().size());
    Random random;
    std::size_t labels = 0;
    for (int i = 0; i < 300; ++i) {
        const double exaggeration = std::pow(10.0, random.uniform(0.0, 1.0));
        const GeographicPoint place{.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
                                    .latitude = Angle::degrees(random.uniform(-90.0, 90.0))};
        const CameraPose camera = poseOf({.target = place,
                                          .height_m = scene.height(place) * exaggeration,
                                          .distance_m = std::pow(10.0, random.uniform(5.0, 7.2)),
                                          .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
                                          .tilt = Angle::degrees(random.uniform(0.0, 70.0))},
                                         scene.ellipsoid());
        const auto shown =
            all.inPicture(camera, {.viewport = kWindow, .exaggeration = exaggeration},
                          [this](std::size_t name, double) { return sizeOf(*names_, name); });
        labels += shown.size();
        for (std::size_t j = 0; j < shown.size(); ++j) {
            for (std::size_t k = j + 1; k < shown.size(); ++k) {
                EXPECT_FALSE(shown[j].box.overlaps(shown[k].box)) << i;
            }
            // Straight through the place, a ray meets the terrain where the name is.
            const GeographicPoint named = names_->names()[shown[j].name].position;
            const ScenePoint point =
                targetOf({.target = named, .height_m = scene.height(named) * exaggeration},
                         scene.ellipsoid());
            const auto pixel = project(camera, kWindow, point);
            ASSERT_TRUE(pixel);
            EXPECT_NEAR(pixel->x, shown[j].place.x, 1e-6);
            EXPECT_NEAR(pixel->y, shown[j].place.y, 1e-6);
            EXPECT_GT(dot(camera.eye - point, localAxes(scene.ellipsoid(), named).up), 0.0);
        }
    }
    EXPECT_GT(labels, 1000U);
}

TEST_F(NameLabelsTest, LargeFeaturesAreNamedFromAfarAndSmallOnesNearby)
{
    NameLabels all(names_, ground_);
    const auto far = labels(all, over(226.2, 18.65, 8e6));
    EXPECT_TRUE(far.contains("Olympus Mons"));
    EXPECT_FALSE(far.contains("Pangboche"));
    const auto near = labels(all, over(226.6, 17.1, 1.5e5));
    EXPECT_TRUE(near.contains("Pangboche")); // 10.5 km, near the summit
    // The label is over the middle of what it names, or a line above or below.
    const NameLabel& label = far.at("Olympus Mons");
    EXPECT_NEAR(0.5 * (label.box.left + label.box.right), label.place.x, 1e-9);
    EXPECT_NEAR(0.5 * (label.box.top + label.box.bottom), label.place.y, 22.0 + 1e-9);
}

TEST_F(NameLabelsTest, TerrainInFrontHidesAName)
{
    NameLabels all(names_, ground_);
    // From 350 km south of Olympus Mons near the ground, heights × 30: the mountain is between the
    // eye and Lycus Sulci to its north.
    OrbitCamera camera = over(226.2, 18.65, 1.0e6);
    camera.tilt = Angle::degrees(20.0);
    EXPECT_TRUE(labels(all, camera, 30.0).contains("Jovis Tholus") ||
                labels(all, camera, 1.0).contains("Olympus Mons"));
    camera.tilt = Angle::degrees(86.0);
    const auto shown = labels(all, camera, 30.0);
    for (const auto& [name, label] : shown) {
        const PlaceName& place = names_->names()[label.name];
        const GridPoint grid = *map_->georeference().toGrid(place.position);
        ScenePoint point = map_->georeference().sceneFrame().toScene(
            grid, 30.0 * map_->heightfield().height(grid));
        const ScenePoint eye = eyeOf(camera);
        // By brute force: no terrain is above the line of sight, which ends four points above.
        point.z += 4.0 * metersPerPixel(camera, kWindow, point);
        for (double share = 0.001; share < 0.999; share += 0.001) {
            const ScenePoint p = eye + (point - eye) * share;
            const double ground_m = ground_.height(p.x, p.y) * 30.0;
            ASSERT_FALSE(ground_m > p.z) << name << " is behind the terrain at " << share;
        }
    }
}

} // namespace marsview::test
