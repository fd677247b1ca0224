// Against closed forms: planes viewed from straight above.
#include "core/session/range_in_picture.h"
#include "tests/support/map_maker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

// 100 × 100 cells of 10 m in the scene x, y = −495 … 495; elevation = 100 + x / 10.
std::shared_ptr<const Map> slope(test::MapMaker& maker)
{
    return maker.make(
        {.columns = 100,
         .rows = 100,
         .transform = {500000.0, 10.0, 0.0, 4000000.0, 0.0, -10.0},
         .srs = "EPSG:32611"},
        [](std::size_t column, std::size_t) { return 100.0 + static_cast<double>(column) - 49.5; });
}

OrbitCamera above(double x_m, double distance_m)
{
    return {.target = {x_m, 0.0, 100.0}, .distance_m = distance_m, .azimuth = {}, .tilt = {}};
}

TEST(RangesInPicture, ReachFromEdgeToEdgeOfThePicture)
{
    test::MapMaker maker;
    const SceneSurface ground({slope(maker)});
    const Viewport viewport{.width = 400, .height = 400};
    for (const double x_m : {0.0, 150.0}) {
        const OrbitCamera camera = above(x_m, 300.0);
        const auto ranges = rangesInPicture(ground, camera, viewport, 1.0);
        ASSERT_EQ(ranges.size(), 1U);
        ASSERT_TRUE(ranges[0]);
        // The edges of the picture on the plane: the rays of its left and right pixels.
        const auto x_at = [&](double pixel_x) {
            const Ray ray = pickRay(camera, viewport, {pixel_x, 200.0});
            // z = 100 + x / 10 along the ray
            const double t = (100.0 + ray.origin.x / 10.0 - ray.origin.z) /
                             (ray.direction.z - ray.direction.x / 10.0);
            return ray.origin.x + t * ray.direction.x;
        };
        EXPECT_NEAR(ranges[0]->minimum_m, 100.0 + x_at(0.0) / 10.0, 1e-3) << x_m;
        EXPECT_NEAR(ranges[0]->maximum_m, 100.0 + x_at(400.0) / 10.0, 1e-3) << x_m;
    }
}

TEST(RangesInPicture, AreElevationsWithoutExaggeration)
{
    test::MapMaker maker;
    const SceneSurface ground({slope(maker)});
    const OrbitCamera camera = above(0.0, 5000.0);
    const auto ranges = rangesInPicture(ground, camera, {.width = 400, .height = 400}, 3.0,
                                        {.columns = 300, .rows = 300});
    ASSERT_TRUE(ranges[0]);
    EXPECT_NEAR(ranges[0]->minimum_m, 50.5, 2.0);
    EXPECT_NEAR(ranges[0]->maximum_m, 149.5, 2.0);
}

TEST(RangesInPicture, AreEmptyForMapsOutsideThePicture)
{
    test::MapMaker maker;
    // A small plateau over the eastern end of the slope.
    const std::shared_ptr<const Map> small =
        maker.make({.columns = 10,
                    .rows = 10,
                    .transform = {500900.0, 10.0, 0.0, 3999550.0, 0.0, -10.0},
                    .srs = "EPSG:32611"},
                   [](auto...) { return 900.0; });
    const SceneSurface ground({small, slope(maker)});
    const Viewport viewport{.width = 200, .height = 200};
    const ScenePoint plateau = ground.maps()[0].frame.toScene({4.5, 4.5}, 900.0);
    OrbitCamera camera{.target = plateau, .distance_m = 60.0, .azimuth = {}, .tilt = {}};
    const auto near = rangesInPicture(ground, camera, viewport, 1.0);
    ASSERT_TRUE(near[0]);
    EXPECT_DOUBLE_EQ(near[0]->minimum_m, 900.0);
    EXPECT_DOUBLE_EQ(near[0]->maximum_m, 900.0);
    EXPECT_FALSE(near[1]);
    camera.target.x -= 600.0;
    camera.target.z = 100.0;
    camera.distance_m = 200.0;
    const auto away = rangesInPicture(ground, camera, viewport, 1.0);
    EXPECT_FALSE(away[0]);
    EXPECT_TRUE(away[1]);
    // Into the sky.
    camera.tilt = Angle::degrees(89.0);
    camera.target.z = 1e6;
    for (const auto& range : rangesInPicture(ground, camera, viewport, 1.0)) {
        EXPECT_FALSE(range);
    }
}

} // namespace
} // namespace marsview
