#include "core/globe/body_camera.h"
#include "core/session/contour_labels.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace marsview::test {
namespace {

constexpr Viewport kPicture{1280, 800};
constexpr double kTop = 3000.0;
constexpr double kGrade = 0.4;

// A cone around the middle, 30 m a sample, and a camera that looks at it.
class ContourLabelsTest : public testing::Test {
    MapMaker maker_;

protected:
    std::shared_ptr<const Map> cone_ =
        maker_.make({.columns = 301, .rows = 301}, [](std::size_t c, std::size_t r) {
            return kTop -
                   kGrade * 30.0 *
                       std::hypot(static_cast<double>(c) - 150.0, static_cast<double>(r) - 150.0);
        });
    SceneSurface ground_{std::vector{cone_}};
    TerrainLook look_{.has_contours = true, .contour_interval_m = 50.0};

    OrbitCamera camera(double tilt_deg, double azimuth_deg = 0.0)
    {
        return {.target = {0.0, 0.0, kTop - 900.0},
                .distance_m = 9000.0,
                .azimuth = Angle::degrees(azimuth_deg),
                .tilt = Angle::degrees(tilt_deg)};
    }
    static std::vector<ContourLabel>
    labels(const SceneSurface& ground, const OrbitCamera& camera, const TerrainLook& look)
    {
        return contourLabels(ground, camera, look, {.viewport = kPicture}, 14.0,
                             [](double) { return 40.0; });
    }
};

void expectApart(const std::vector<ContourLabel>& labels)
{
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const LabelBox& box = labels[i].box;
        EXPECT_TRUE(box.left >= 0.0 && box.top >= 0.0 && box.right <= kPicture.width &&
                    box.bottom <= kPicture.height);
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_FALSE(box.overlaps(labels[k].box));
        }
    }
}

} // namespace

// The contour of elevation e on the cone is the circle of radius (top − e) / grade.
TEST_F(ContourLabelsTest, LieOnTheirContoursAndAlongThem)
{
    for (const double tilt_deg : {0.0, 40.0, 65.0}) {
        const OrbitCamera seen_from = camera(tilt_deg, 25.0);
        const auto found = labels(ground_, seen_from, look_);
        EXPECT_GE(found.size(), 4U) << tilt_deg;
        expectApart(found);
        for (const ContourLabel& label : found) {
            EXPECT_EQ(std::fmod(label.elevation_m, 250.0), 0.0);
            const auto hit = ground_.cast(pickRay(seen_from, kPicture, label.middle), 1.0);
            ASSERT_TRUE(hit);
            const ScenePoint place = ground_.maps()[0].frame.toScene(hit->grid, hit->height_m);
            const double radius_m = (kTop - label.elevation_m) / kGrade;
            EXPECT_NEAR(std::hypot(place.x, place.y), radius_m, 20.0); // of 30 m samples
            // Along the circle: at right angles to the line to the top.
            const Vec3 along = label.to - label.from;
            const double cosine = (along.x * place.x + along.y * place.y) /
                                  (std::hypot(along.x, along.y) * std::hypot(place.x, place.y));
            EXPECT_LT(std::abs(cosine), 0.2);
            EXPECT_LE(std::abs(label.angle_rad), std::numbers::pi / 2.0 + 1e-9);
        }
    }
}

TEST_F(ContourLabelsTest, OnlyIndexContoursHaveThemAndOnlyIfTheyAreDrawn)
{
    TerrainLook none = look_;
    none.has_contours = false;
    EXPECT_TRUE(labels(ground_, camera(0.0), none).empty());
    TerrainLook coarse = look_;
    coarse.contour_interval_m = 2000.0; // no index contour on the cone but 0 m, which it misses
    EXPECT_TRUE(labels(ground_, camera(0.0), coarse).empty());
    EXPECT_TRUE(labels(SceneSurface(), camera(0.0), look_).empty());
}

TEST_F(ContourLabelsTest, KeepClearOfObstacles)
{
    const auto all = labels(ground_, camera(30.0), look_);
    ASSERT_FALSE(all.empty());
    const std::vector<LabelBox> obstacles{{0.0, 0.0, 640.0, 800.0}};
    const auto right_half =
        contourLabels(ground_, camera(30.0), look_, {.viewport = kPicture, .obstacles = obstacles},
                      14.0, [](double) { return 40.0; });
    EXPECT_FALSE(right_half.empty());
    for (const ContourLabel& label : right_half) {
        EXPECT_GE(label.box.left, 640.0);
    }
}

TEST_F(ContourLabelsTest, MoveWithTheTerrain)
{
    const OrbitCamera before = camera(30.0);
    const auto found = labels(ground_, before, look_);
    ASSERT_FALSE(found.empty());
    const auto same = labelIn(found.front(), before, kPicture);
    ASSERT_TRUE(same);
    EXPECT_NEAR(same->middle.x, found.front().middle.x, 3.0);
    EXPECT_NEAR(same->middle.y, found.front().middle.y, 3.0);
    EXPECT_NEAR(same->angle_rad, found.front().angle_rad, 0.1);
    OrbitCamera away = before;
    away.target.x += 1e6;
    EXPECT_FALSE(labelIn(found.front(), away, kPicture));
}

TEST_F(ContourLabelsTest, NeverOverlapOnRealTerrainFromAnySide)
{
    JobMonitor monitor;
    const auto map = *readMap(RasterSpec{.path = bundledMars()}, monitor, std::size_t{1} << 28);
    const SceneSurface mars{std::vector{map}};
    const SceneBox box = mars.box(1.0);
    Random random;
    std::size_t count = 0;
    for (int i = 0; i < 100; ++i) {
        OrbitCamera seen_from;
        const double x = random.uniform(box.minimum.x, box.maximum.x);
        const double y = random.uniform(box.minimum.y, box.maximum.y);
        seen_from.target = {x, y, mars.height(x, y)};
        seen_from.distance_m = box.extent_m() * std::pow(10.0, random.uniform(-2.0, 0.0));
        seen_from.azimuth = Angle::degrees(random.uniform(0.0, 360.0));
        seen_from.tilt = Angle::degrees(random.uniform(0.0, 85.0));
        const auto found =
            labels(mars, seen_from, {.has_contours = true, .contour_interval_m = 0.0});
        expectApart(found);
        count += found.size();
    }
    EXPECT_GT(count, 300U);
}

// On a planet, at its equator and at a pole.
TEST(BodyContourLabels, LieOnTheirContours)
{
    MapMaker maker;
    using Transform = std::array<double, 6>;
    const double radius_m = 3396190.0;
    for (const auto& [srs, latitude_deg, terms] :
         {std::tuple("+proj=longlat +R=3396190", 0.0, Transform{136.9, 0.001, 0, 0.1, 0, -0.001}),
          {"+proj=stere +lat_0=90 +R=3396190", 90.0, Transform{-6000, 60, 0, 6000, 0, -60}}}) {
        const auto map =
            maker.make({.columns = 200, .rows = 200, .transform = terms, .srs = srs},
                       [](std::size_t c, std::size_t r) {
                           return 3000.0 - 15.0 * std::hypot(static_cast<double>(c) - 100.0,
                                                             static_cast<double>(r) - 100.0);
                       });
        JobMonitor monitor;
        const BodyScene scene({{map, BodyGrid::make(map->georeference(), monitor).value()}});
        const CameraPose pose = poseOf({.target = {.longitude = Angle::degrees(137.0),
                                                   .latitude = Angle::degrees(latitude_deg)},
                                        .height_m = 2.0 * 2500.0,
                                        .distance_m = 14000.0,
                                        .tilt = Angle::degrees(40.0)},
                                       scene.ellipsoid());
        const auto labels = contourLabels(
            scene, pose, {.has_contours = true, .contour_interval_m = 50.0},
            {.viewport = kPicture, .exaggeration = 2.0}, 14.0, [](double) { return 40.0; });
        EXPECT_GE(labels.size(), 4U) << srs;
        for (const ContourLabel& label : labels) {
            EXPECT_EQ(std::remainder(label.elevation_m, 250.0), 0.0);
            for (const ScenePoint& end : {label.from, label.to}) {
                EXPECT_NEAR((length(end) - radius_m) / 2.0, label.elevation_m, 0.4 * 50.0);
            }
            const auto same = labelIn(label, pose, kPicture);
            ASSERT_TRUE(same);
            EXPECT_NEAR(same->middle.x, label.middle.x, 3.0);
            EXPECT_NEAR(same->middle.y, label.middle.y, 3.0);
        }
    }
}

} // namespace marsview::test
