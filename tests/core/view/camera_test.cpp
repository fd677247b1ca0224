#include "core/view/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace marsview {
namespace {

constexpr Viewport kViewport{1280, 800};

OrbitCamera wideCamera()
{
    return {.target = {1e6, -2e6, 3e3},
            .distance_m = 5e5,
            .azimuth = Angle::degrees(30.0),
            .tilt = Angle::degrees(50.0)};
}

TEST(OrbitCamera, AxesAreOrthonormalAndRightHanded)
{
    const CameraAxes axes = axesOf(wideCamera());
    EXPECT_NEAR(length(axes.right), 1.0, 1e-15);
    EXPECT_NEAR(length(axes.up), 1.0, 1e-15);
    const Vec3 backward = cross(axes.right, axes.up);
    EXPECT_NEAR(length(backward + axes.forward), 0.0, 1e-15);
}

TEST(OrbitCamera, LooksDownWithNorthUpAtZeroTilt)
{
    const CameraAxes axes = axesOf({.distance_m = 10.0});
    EXPECT_EQ(axes.forward.z, -1.0);
    EXPECT_EQ(axes.up.y, 1.0);
    EXPECT_EQ(axes.right.x, 1.0);
    EXPECT_EQ(eyeOf({.distance_m = 10.0}), (ScenePoint{0.0, 0.0, 10.0}));
}

TEST(OrbitCamera, IsSouthOfItsTargetWhenItFacesNorth)
{
    const OrbitCamera camera{.distance_m = 10.0, .tilt = Angle::degrees(60.0)};
    EXPECT_LT(eyeOf(camera).y, 0.0);
    EXPECT_GT(eyeOf(camera).z, 0.0);
    EXPECT_GT(axesOf(camera).forward.y, 0.0);
}

TEST(PickRay, ProjectsBackToItsPixel)
{
    const OrbitCamera camera = wideCamera();
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const PixelPoint pixel{share(random) * kViewport.width, share(random) * kViewport.height};
        const Ray ray = pickRay(camera, kViewport, pixel);
        const auto back = project(camera, kViewport, ray.at(1e3 + share(random) * 1e6));
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->x, pixel.x, 1e-6);
        EXPECT_NEAR(back->y, pixel.y, 1e-6);
    }
}

TEST(PickRay, PassesThroughTheTargetAtTheCenter)
{
    const OrbitCamera camera = wideCamera();
    const Ray ray = pickRay(camera, kViewport, {640.0, 400.0});
    EXPECT_LT(length(ray.at(camera.distance_m) - camera.target), 1e-6);
}

TEST(Project, MatchesTheMatricesUsedForDrawing)
{
    const OrbitCamera camera = wideCamera();
    const SceneBox box{{-3e6, -3e6, -8e3}, {3e6, 3e6, 2e4}};
    const Matrix4 m = projection(camera, kViewport, clipRange(camera, box)) * viewRotation(camera);
    const ScenePoint point{1.1e6, -1.9e6, 1e4};
    const Vec3 p = point - eyeOf(camera);
    const auto row = [&](std::size_t i) {
        return m(i, 0) * p.x + m(i, 1) * p.y + m(i, 2) * p.z + m(i, 3);
    };
    const auto pixel = project(camera, kViewport, point);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((row(0) / row(3) + 1.0) / 2.0 * kViewport.width, pixel->x, 1e-6);
    EXPECT_NEAR((1.0 - row(1) / row(3)) / 2.0 * kViewport.height, pixel->y, 1e-6);
    EXPECT_LT(std::abs(row(2) / row(3)), 1.0);
}

TEST(Project, IsEmptyBehindTheEye)
{
    const OrbitCamera camera = wideCamera();
    EXPECT_FALSE(project(camera, kViewport, eyeOf(camera) - axesOf(camera).forward));
}

TEST(ClipRange, EnclosesABoxInFrontOfTheEye)
{
    const SceneBox box{{-100.0, -50.0, -1.0}, {100.0, 50.0, 9.0}};
    const OrbitCamera camera{.distance_m = 400.0, .tilt = Angle::degrees(45.0)};
    const ClipRange clip = clipRange(camera, box);
    for (const ScenePoint& corner : box.corners()) {
        const double depth = dot(corner - eyeOf(camera), axesOf(camera).forward);
        EXPECT_LT(clip.near_m, depth);
        EXPECT_GT(clip.far_m, depth);
    }
}

TEST(ClipRange, StaysOrderedWhenTheBoxIsBehindOrAround)
{
    const SceneBox box{{-100.0, -50.0, -1.0}, {100.0, 50.0, 9.0}};
    for (const double y : {-1000.0, 0.0, 1000.0}) {
        const OrbitCamera camera{
            .target = {0.0, y, 0.0}, .distance_m = 10.0, .tilt = Angle::degrees(85.0)};
        const ClipRange clip = clipRange(camera, box);
        EXPECT_GT(clip.near_m, 0.0);
        EXPECT_GT(clip.far_m, clip.near_m);
    }
}

} // namespace
} // namespace marsview
