#include "haptics/interaction/workspace_frame.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

WorkspaceFrame randomFrame(Random& random)
{
    return {
        .anchor = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.02},
        .place = {random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), random.uniform(-1e3, 1e3)},
        .scene_per_meter = std::pow(10.0, random.uniform(-1.0, 7.0)),
        .turn = Angle::radians(random.uniform(-10.0, 10.0))};
}

WorkspacePoint randomPoint(Random& random)
{
    return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
}

double distance(const WorkspacePoint& a, const WorkspacePoint& b)
{
    return length(a - b);
}

TEST(WorkspaceFrame, QuarterTurnByHand)
{
    // Heading east: the workspace direction away from the user is east in the scene, and right is
    // south.
    const WorkspaceFrame frame{.anchor = {0.01, 0.02, 0.03},
                               .place = {100.0, 200.0, 300.0},
                               .scene_per_meter = 1000.0,
                               .turn = Angle::degrees(-90.0)};
    const ScenePoint away = frame.toScene({0.01, 0.12, 0.03});
    EXPECT_NEAR(away.x, 200.0, 1e-9);
    EXPECT_NEAR(away.y, 200.0, 1e-9);
    EXPECT_NEAR(away.z, 300.0, 1e-9);
    const ScenePoint right = frame.toScene({0.11, 0.02, 0.08});
    EXPECT_NEAR(right.x, 100.0, 1e-9);
    EXPECT_NEAR(right.y, 100.0, 1e-9);
    EXPECT_NEAR(right.z, 350.0, 1e-9);
}

TEST(WorkspaceFrame, RoundTripsToTheSamePosition)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const WorkspaceFrame frame = randomFrame(random);
        const WorkspacePoint p = randomPoint(random);
        const WorkspacePoint q = frame.toWorkspace(frame.toScene(p));
        const double rounding = 1e-15 * (1e6 / frame.scene_per_meter + 1.0) * 16;
        EXPECT_NEAR(distance(p, q), 0.0, rounding);
    }
}

TEST(WorkspaceFrame, IsASimilarity)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const WorkspaceFrame frame = randomFrame(random);
        const WorkspacePoint a = randomPoint(random);
        const WorkspacePoint b = randomPoint(random);
        const double scene_m = length(frame.toScene(a) - frame.toScene(b));
        EXPECT_NEAR(scene_m, distance(a, b) * frame.scene_per_meter, 1e-9 + 1e-9 * scene_m);
    }
}

TEST(WorkspaceFrame, PanningMovesTheMap)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        WorkspaceFrame frame = randomFrame(random);
        frame.scene_per_meter = 1e5;
        const WorkspacePoint p = randomPoint(random);
        const Vec3 shift{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0};
        const ScenePoint grabbed = frame.toScene(p);
        EXPECT_NEAR(distance(frame.panned(shift).toWorkspace(grabbed), p + shift), 0.0, 1e-12);
    }
}

TEST(WorkspaceFrame, ZoomingAndTurningKeepTheirPlace)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        WorkspaceFrame frame = randomFrame(random);
        frame.scene_per_meter = 1e5;
        const WorkspacePoint fixed = randomPoint(random);
        const WorkspacePoint other = randomPoint(random);
        const ScenePoint held = frame.toScene(fixed);
        const ScenePoint seen = frame.toScene(other);
        const double factor = random.uniform(0.2, 5.0);
        const WorkspaceFrame zoomed = frame.zoomed(fixed, factor);
        EXPECT_NEAR(distance(zoomed.toWorkspace(held), fixed), 0.0, 1e-12);
        const Vec3 grown = zoomed.toWorkspace(seen) - fixed;
        EXPECT_NEAR(length(grown - (other - fixed) * factor), 0.0, 1e-11);
        // A quarter turn counter-clockwise: the direction right of the hand becomes away from the
        // user.
        const WorkspaceFrame turned = frame.turned(fixed, Angle::degrees(90.0));
        EXPECT_NEAR(distance(turned.toWorkspace(held), fixed), 0.0, 1e-12);
        const Vec3 before = other - fixed;
        const Vec3 after = turned.toWorkspace(seen) - fixed;
        EXPECT_NEAR(length(after - Vec3{-before.y, before.x, before.z}), 0.0, 1e-11);
    }
}

TEST(WorkspaceFrame, AFrameAfterItsMotionToAnotherIsThatOne)
{
    Random random;
    for (int i = 0; i < 100; ++i) {
        const WorkspaceFrame from = randomFrame(random);
        const WorkspaceFrame to = randomFrame(random);
        const WorkspaceFrame after = from.after(to.motionFrom(from));
        const WorkspacePoint point = randomPoint(random);
        const ScenePoint expected = to.toScene(point);
        EXPECT_NEAR(length(after.toScene(point) - expected), 0.0,
                    1e-9 * (1.0 + length(expected - ScenePoint{}) + to.scene_per_meter));
    }
}

TEST(WorkspaceFrame, AFrameOnABodyAfterItsMotionToAnotherIsThatOne)
{
    Random random;
    const auto on_body = [&random] {
        WorkspaceFrame frame = randomFrame(random);
        frame.turn = {};
        frame.body_axes = Rotation::by(
            {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
        return frame;
    };
    for (int i = 0; i < 100; ++i) {
        const WorkspaceFrame from = on_body();
        const WorkspaceFrame to = on_body();
        const SceneMotion motion = to.motionFrom(from);
        EXPECT_EQ(motion.turn_rad, 0.0);
        const WorkspaceFrame after = from.after(motion);
        const WorkspacePoint point = randomPoint(random);
        const ScenePoint expected = to.toScene(point);
        EXPECT_NEAR(length(after.toScene(point) - expected), 0.0,
                    1e-9 * (1.0 + length(expected) + to.scene_per_meter));
    }
    // Motions of the other scene are none of this one.
    const WorkspaceFrame frame = on_body();
    EXPECT_EQ(frame.after({.to = {1.0, 2.0, 3.0}, .turn_rad = 1.0}), frame);
}

// Another frame of the same scene: what was one meter east of the motion's point is two meters
// north of where that point is then, turned by a quarter and twice as far.
TEST(WorkspaceFrame, AMotionMovesEveryPlaceOfItsScene)
{
    SceneMotion motion{.from = {1.0, 2.0, 3.0},
                       .to = {10.0, 20.0, 30.0},
                       .scale = 2.0,
                       .turn_rad = Angle::degrees(90.0).radians()};
    WorkspaceFrame frame{.place = {2.0, 2.0, 3.5}, .scene_per_meter = 5.0};
    const auto expectMoved = [](const WorkspaceFrame& after) {
        EXPECT_NEAR(length(after.place - ScenePoint{10.0, 22.0, 31.0}), 0.0, 1e-12);
        EXPECT_NEAR(length(after.toScene({1.0, 0.0, 0.0}) - after.place - Vec3{0.0, 10.0, 0.0}),
                    0.0, 1e-12);
    };
    expectMoved(frame.after(motion));
    motion.body_turn_rad = Vec3{0.0, 0.0, motion.turn_rad};
    motion.turn_rad = 0.0;
    frame.body_axes = Rotation{};
    expectMoved(frame.after(motion));
}

// A point p of the scene moves to `to` + R (p - `from`) s, with R about the axis: first by one
// motion, then by the other.
TEST(WorkspaceFrame, TwoMotionsCombinedMoveAsOneAfterTheOther)
{
    Random random;
    const auto moved = [](const SceneMotion& motion, const ScenePoint& point) {
        const Vec3 along = point - motion.from;
        const Vec3 turn = motion.body_turn_rad.value_or(Vec3{0.0, 0.0, motion.turn_rad});
        const double angle = length(turn);
        const Vec3 axis = turn * (1.0 / angle);
        const Vec3 turned = along * std::cos(angle) + cross(axis, along) * std::sin(angle) +
                            axis * (dot(axis, along) * (1.0 - std::cos(angle)));
        return motion.to + turned * motion.scale;
    };
    const auto any = [&random] {
        return Vec3{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0),
                    random.uniform(-2.0, 2.0)};
    };
    const auto motionOn = [&](bool is_body) {
        SceneMotion motion{.from = any(), .to = any(), .scale = random.uniform(0.5, 2.0)};
        if (is_body) {
            motion.body_turn_rad = any();
        } else {
            motion.turn_rad = random.uniform(0.1, 2.0);
        }
        return motion;
    };
    for (int i = 0; i < 100; ++i) {
        for (const bool is_body : {false, true}) {
            const SceneMotion first = motionOn(is_body);
            const SceneMotion last = motionOn(is_body);
            const SceneMotion other = motionOn(!is_body);
            const ScenePoint at = any();
            EXPECT_NEAR(length(moved(combined(first, last), at) - moved(last, moved(first, at))),
                        0.0, 1e-12);
            EXPECT_NEAR(length(moved(combined(other, last), at) - moved(last, at)), 0.0, 1e-12);
        }
    }
}

TEST(WorkspaceFrame, OnlyFiniteFramesWithAScaleAreSound)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    WorkspaceFrame frame;
    EXPECT_TRUE(frame.isSound());
    for (const double scale : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(WorkspaceFrame{.scene_per_meter = scale}.isSound()) << scale;
    }
    EXPECT_FALSE((WorkspaceFrame{.anchor = {0.0, kNan, 0.0}}.isSound()));
    EXPECT_FALSE((WorkspaceFrame{.place = {0.0, 0.0, kNan}}.isSound()));
    EXPECT_FALSE(WorkspaceFrame{.turn = Angle::radians(kNan)}.isSound());
    frame.body_axes = Rotation{};
    EXPECT_TRUE(frame.isSound());
    for (Vec3 Rotation::*axis : {&Rotation::x, &Rotation::y, &Rotation::z}) {
        WorkspaceFrame broken = frame;
        ((*broken.body_axes).*axis).y = kNan;
        EXPECT_FALSE(broken.isSound());
    }
    frame.anchor.x = kNan;
    EXPECT_FALSE(frame.isSound());
}

TEST(WorkspaceFrame, AMapLiesInTheMiddleOfTheReach)
{
    const SceneBox box{{10.0, 100.0, -1.0}, {14.0, 103.0, 1.0}};
    const WorkspaceFrame frame = frameForMap(box, {{-0.06, -0.05, -0.02}, {0.10, 0.07, 0.06}});
    EXPECT_NEAR(frame.scene_per_meter, 25.0, 1e-12); // 3 m in 120 mm
    EXPECT_NEAR(length(frame.toScene({0.02, 0.01, 0.02}) - ScenePoint{12.0, 101.5, 0.0}), 0.0,
                1e-12);
    // A reach without an extent along an axis is filled along the others.
    EXPECT_NEAR(frameForMap(box, {{-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}).scene_per_meter, 0.25, 1e-12);
    const SceneBox point{{10.0, 100.0, 1.0}, {10.0, 100.0, 1.0}};
    EXPECT_EQ(frameForMap(point, {{-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}).scene_per_meter, 1.0);
}

TEST(WorkspaceFrame, WithoutAMapInSightItCoversTheCamerasSurroundings)
{
    const MapPlan map{.frame = northUpFrame(1000, 800, 100.0), .columns = 1000, .rows = 800};
    const SceneBox box{{-5e4, -4e4, -30.0}, {5e4, 4e4, 50.0}};
    const OrbitCamera camera{.target = {4e5, -3e5, 10.0},
                             .distance_m = 3000.0,
                             .azimuth = Angle::degrees(90.0),
                             .tilt = Angle::degrees(10.0)};
    const WorkspaceFrame frame =
        frameForView(camera, {1200, 800}, map, box, {{-0.10, -0.06, -0.06}, {0.10, 0.06, 0.06}});
    EXPECT_NEAR(frame.scene_per_meter, 3000.0 / 0.12, 1e-6);
    EXPECT_NEAR(length(frame.toScene({}) - ScenePoint{4e5, -3e5, 10.0}), 0.0, 1e-6);
}

TEST(WorkspaceFrame, TheHandReachesWhatTheCameraSees)
{
    Random random;
    const WorkspaceBox reach{{-0.07, -0.05, -0.06}, {0.09, 0.05, 0.06}};
    const MapPlan map{.frame = northUpFrame(1000, 800, 100.0), .columns = 1000, .rows = 800};
    const SceneBox box{{-5e4, -4e4, -3000.0}, {5e4, 4e4, 5000.0}};
    for (int i = 0; i < 200; ++i) {
        const OrbitCamera camera{.target = {random.uniform(-3e4, 3e4), random.uniform(-3e4, 3e4),
                                            random.uniform(-1000.0, 1000.0)},
                                 .distance_m = std::pow(10.0, random.uniform(3.0, 5.0)),
                                 .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
                                 .tilt = Angle::degrees(random.uniform(0.0, 80.0))};
        const Viewport viewport{1200, 800};
        const WorkspaceFrame frame = frameForView(camera, viewport, map, box, reach);
        ASSERT_TRUE(frame.isSound());
        for (const GridPoint& corner : footprint(camera, viewport, map)) {
            for (const double z : {box.minimum.z, box.maximum.z}) {
                const WorkspacePoint at = frame.toWorkspace(map.frame.toScene(corner, z));
                EXPECT_GE(at.x, reach.low.x - 1e-9);
                EXPECT_LE(at.x, reach.high.x + 1e-9);
                EXPECT_GE(at.y, reach.low.y - 1e-9);
                EXPECT_LE(at.y, reach.high.y + 1e-9);
                EXPECT_GE(at.z, reach.low.z - 1e-9);
                EXPECT_LE(at.z, reach.high.z + 1e-9);
            }
        }
        // The direction away from the user is the one in which the camera looks.
        const Vec3 away = frame.differenceToScene({0.0, 1.0, 0.0});
        EXPECT_NEAR(std::atan2(away.x, away.y),
                    std::remainder(camera.azimuth.radians(), 2.0 * 3.14159265358979), 1e-9);
    }
}

} // namespace
} // namespace marsview::test
