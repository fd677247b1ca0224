#include "haptics/interaction/hand_view.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

constexpr Viewport kViewport{.width = 1000, .height = 700};

HandView randomView(Random& random)
{
    return {.camera = {.target = {random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 50.0},
                       .distance_m = random.uniform(500.0, 5e4),
                       .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
                       .tilt = Angle::degrees(random.uniform(0.0, 80.0))},
            .frame = {.anchor = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.01},
                      .place = {random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 20.0},
                      .scene_per_meter = random.uniform(1e3, 1e5),
                      .turn = Angle::degrees(random.uniform(-180.0, 180.0))}};
}

// A point of the workspace stays at the same place in the view, whatever pan and zoom the hand has
// applied to the map.
TEST(HandView, TheCameraSeesTheWorkspaceAsBefore)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const HandView before = randomView(random);
        const WorkspaceFrame now =
            before.frame.panned({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0})
                .zoomed({0.02, -0.03, 0.01}, random.uniform(0.3, 3.0))
                .turned({-0.05, 0.01, 0.0}, Angle::degrees(random.uniform(-90.0, 90.0)));
        const OrbitCamera camera = cameraFollowing(before, now);
        for (int j = 0; j < 5; ++j) {
            const WorkspacePoint at =
                before.frame.toWorkspace(before.camera.target) +
                Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-1.0, 1.0)} *
                    (0.2 * before.camera.distance_m / before.frame.scene_per_meter);
            const auto then = project(before.camera, kViewport, before.frame.toScene(at));
            const auto seen = project(camera, kViewport, now.toScene(at));
            ASSERT_TRUE(then && seen);
            EXPECT_NEAR(seen->x, then->x, 1e-5);
            EXPECT_NEAR(seen->y, then->y, 1e-5);
        }
    }
}

TEST(HandView, TheFrameFollowsTheCameraBack)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const HandView before = randomView(random);
        const HandView other = randomView(random);
        OrbitCamera camera = other.camera;
        camera.tilt = before.camera.tilt;
        const WorkspaceFrame frame = frameFollowing(before, camera);
        const OrbitCamera back = cameraFollowing(before, frame);
        EXPECT_LT(length(back.target - camera.target), 1e-6);
        EXPECT_NEAR(back.distance_m / camera.distance_m, 1.0, 1e-12);
        EXPECT_NEAR(std::remainder((back.azimuth - camera.azimuth).degrees(), 360.0), 0.0, 1e-9);
    }
}

// Each of them alone: the position, the distance and the heading of the camera.
TEST(HandView, ALimitOfTheCameraMovesTheMapExceptInHeight)
{
    const HandView followed{.camera = {.target = {10.0, 20.0, 5.0},
                                       .distance_m = 100.0,
                                       .azimuth = Angle::degrees(30.0),
                                       .tilt = Angle::degrees(40.0)},
                            .frame = {.place = {8.0, 15.0, 3.0}, .scene_per_meter = 1000.0}};
    const auto limited = [&](auto change) {
        OrbitCamera camera = followed.camera;
        change(camera);
        return limitedView(followed, camera);
    };
    EXPECT_FALSE(limited([](OrbitCamera&) {}).is_moved);
    EXPECT_FALSE(limited([](OrbitCamera& c) { c.target.z = 50.0; }).is_moved);
    EXPECT_TRUE(limited([](OrbitCamera& c) { c.distance_m = 120.0; }).is_moved);
    EXPECT_TRUE(limited([](OrbitCamera& c) { c.azimuth = Angle::degrees(31.0); }).is_moved);
    EXPECT_FALSE(limited([](OrbitCamera& c) { c.azimuth = Angle::degrees(390.0); }).is_moved);
    // A thousandth of the distance of 100 m is rounding.
    EXPECT_FALSE(limited([](OrbitCamera& c) { c.target.x += 0.09; }).is_moved);
    EXPECT_TRUE(limited([](OrbitCamera& c) { c.target.x += 0.11; }).is_moved);
    EXPECT_FALSE(limited([](OrbitCamera& c) { c.distance_m += 0.09; }).is_moved);
    EXPECT_TRUE(limited([](OrbitCamera& c) { c.distance_m += 0.11; }).is_moved);
    for (const double side : {1.0, -1.0}) { // as is a twentieth of a degree
        const auto turned = [&](double degrees) {
            return limited(
                [&](OrbitCamera& c) { c.azimuth = c.azimuth + Angle::degrees(side * degrees); });
        };
        EXPECT_FALSE(turned(0.045).is_moved);
        EXPECT_TRUE(turned(0.055).is_moved);
    }
    const LimitedView moved = limited([](OrbitCamera& c) { c.target.x = 14.0; });
    EXPECT_TRUE(moved.is_moved);
    // The target stays at its place in the workspace.
    const WorkspacePoint at = moved.view.frame.toWorkspace(moved.view.camera.target);
    EXPECT_NEAR(length(at - followed.frame.toWorkspace(followed.camera.target)), 0.0, 1e-12);
    EXPECT_EQ(moved.view.camera.target.x, 14.0);
}

} // namespace
} // namespace marsview::test
