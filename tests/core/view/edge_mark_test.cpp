#include "core/view/edge_mark.h"
#include "tests/core/view/some_camera.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

using test::someCamera;

constexpr EdgeLine kLine{.viewport = {1000, 600}, .inset_px = 20.0, .covered_px = 40.0};

// A point at the given distances to the right of, below and in front of the eye.
ScenePoint placeAt(const OrbitCamera& camera, const Vec3& right_down_forward)
{
    const CameraAxes axes = axesOf(camera);
    return eyeOf(camera) + axes.right * right_down_forward.x - axes.up * right_down_forward.y +
           axes.forward * right_down_forward.z;
}

TEST(EdgeMark, IsEmptyForPointsInThePicture)
{
    const OrbitCamera camera = someCamera();
    EXPECT_FALSE(edgeMark(camera, camera.target, kLine));
    for (const PixelPoint pixel : {PixelPoint{1.0, 41.0}, {999.0, 599.0}, {500.0, 300.0}}) {
        const ScenePoint place = pickRay(camera, kLine.viewport, pixel).at(5e4);
        EXPECT_FALSE(edgeMark(camera, place, kLine));
    }
    EXPECT_TRUE(edgeMark(camera, pickRay(camera, kLine.viewport, {500.0, 39.0}).at(5e4), kLine))
        << "covered";
}

TEST(EdgeMark, LiesOnTheSideOfThePoint)
{
    const OrbitCamera camera = someCamera();
    const auto right = edgeMark(camera, placeAt(camera, {9e4, 0.0, 1e4}), kLine);
    ASSERT_TRUE(right);
    EXPECT_NEAR(right->at.x, 980.0, 1e-9);
    EXPECT_NEAR(right->at.y, 300.0, 1e-9);
    EXPECT_NEAR(right->right, 1.0, 1e-12);
    const auto left_behind = edgeMark(camera, placeAt(camera, {-9e4, 0.0, -1e4}), kLine);
    ASSERT_TRUE(left_behind);
    EXPECT_NEAR(left_behind->at.x, 20.0, 1e-9);
    EXPECT_NEAR(left_behind->right, -1.0, 1e-12);
    const auto above = edgeMark(camera, placeAt(camera, {0.0, -9e4, 1e4}), kLine);
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->at.x, 500.0, 1e-9);
    EXPECT_NEAR(above->at.y, 60.0, 1e-9) << "below the covered strip";
    EXPECT_NEAR(above->down, -1.0, 1e-12);
    const auto below = edgeMark(camera, placeAt(camera, {0.0, 9e4, 1e4}), kLine);
    ASSERT_TRUE(below);
    EXPECT_NEAR(below->at.y, 580.0, 1e-9);
    const auto behind = edgeMark(camera, placeAt(camera, {0.0, 0.0, -1e4}), kLine);
    ASSERT_TRUE(behind);
    EXPECT_NEAR(behind->at.y, 580.0, 1e-9);
    EXPECT_NEAR(behind->down, 1.0, 1e-6);
}

TEST(EdgeMark, LiesOnTheLineFromTheMiddleToTheProjectedPoint)
{
    test::Random random;
    const auto any = [&] { return random.uniform(-1.0, 1.0); };
    int marks = 0;
    for (int i = 0; i < 2000; ++i) {
        const OrbitCamera camera = someCamera();
        const ScenePoint place = placeAt(camera, {2e5 * any(), 2e5 * any(), 5e4 * (1.1 + any())});
        const auto pixel = project(camera, kLine.viewport, place);
        const auto mark = edgeMark(camera, place, kLine);
        ASSERT_TRUE(pixel);
        if (!mark) {
            continue;
        }
        ++marks;
        const double x = pixel->x - 500.0;
        const double y = pixel->y - 300.0;
        ASSERT_NEAR(mark->right, x / std::hypot(x, y), 1e-9);
        ASSERT_NEAR(mark->down, y / std::hypot(x, y), 1e-9);
        const double mark_x = mark->at.x - 500.0;
        const double mark_y = mark->at.y - 300.0;
        ASSERT_NEAR(mark_x * mark->down - mark_y * mark->right, 0.0, 1e-9);
        ASSERT_GT(mark_x * mark->right + mark_y * mark->down, 0.0);
        // On the line: at one of its sides, and not beyond any.
        const double to_side = std::min(std::min(mark->at.x - 20.0, 980.0 - mark->at.x),
                                        std::min(mark->at.y - 60.0, 580.0 - mark->at.y));
        ASSERT_NEAR(to_side, 0.0, 1e-9);
    }
    EXPECT_GT(marks, 1000);
}

// Among all small turns of the view, the one toward the mark moves the place closest to the view.
TEST(EdgeMark, PointsTheShortestWayEvenToPointsBehindTheEye)
{
    test::Random random;
    const auto any = [&] { return random.uniform(-1.0, 1.0); };
    const OrbitCamera camera = someCamera();
    const CameraAxes axes = axesOf(camera);
    for (int i = 0; i < 200; ++i) {
        const ScenePoint place = placeAt(camera, {1e5 * any(), 1e5 * any(), 1e5 * (any() - 1.01)});
        const auto mark = edgeMark(camera, place, kLine);
        ASSERT_TRUE(mark);
        const Vec3 to_place = normalized(place - eyeOf(camera));
        const auto nearness = [&](double right, double down) {
            constexpr double kTurn = 1e-3;
            return dot(
                normalized(axes.forward + axes.right * (kTurn * right) - axes.up * (kTurn * down)),
                to_place);
        };
        const double best = nearness(mark->right, mark->down);
        for (int step = 0; step < 360; ++step) {
            const double around = std::numbers::pi * step / 180.0;
            ASSERT_LE(nearness(std::cos(around), std::sin(around)), best + 1e-12);
        }
    }
}

TEST(EdgeMark, IsInTheMiddleWithoutRoom)
{
    const OrbitCamera camera = someCamera();
    const auto mark = edgeMark(camera, placeAt(camera, {9e4, 1e4, 1e4}),
                               {.viewport = {30, 30}, .inset_px = 20.0, .covered_px = 0.0});
    ASSERT_TRUE(mark);
    EXPECT_NEAR(mark->at.x, 15.0, 1e-9);
    EXPECT_NEAR(mark->at.y, 15.0, 1e-9);
}

} // namespace
} // namespace marsview
