#include "core/body/body_positions.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/interaction/body_modes.h"
#include "haptics/interaction/body_view.h"
#include "haptics/interaction/stroke_area.h"
#include "haptics/interaction/workspace_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

constexpr Ellipsoid kBall{1e6, 1e6};
constexpr Ellipsoid kMars{3396190.0, 3376200.0};
constexpr WorkspaceBox kReach{{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
constexpr Viewport kSquare{.width = 800, .height = 800};

BodyCamera cameraOver(double longitude_deg, double latitude_deg, double distance_m)
{
    return {.target = {.longitude = Angle::degrees(longitude_deg),
                       .latitude = Angle::degrees(latitude_deg)},
            .distance_m = distance_m,
            .azimuth = Angle::degrees(25.0),
            .tilt = Angle::degrees(0.0)};
}

WorkspaceFrame frameFor(const BodyCamera& camera, const Ellipsoid& body)
{
    return frameForBodyView(
        camera, kSquare, [](const GeographicPoint&) { return 0.0; }, body, kReach);
}

double angleBetween(const WorkspaceFrame& a, const WorkspaceFrame& b)
{
    return length((*a.body_axes * b.body_axes->inverse()).turn());
}

TEST(BodyView, TheWorkspaceCoversWhatTheViewShows)
{
    // Near the ground the picture is flat: twice the distance times the tangent of half the field
    // of view. The curvature takes less than a thousandth.
    const BodyCamera near = cameraOver(40.0, 60.0, 5e3);
    const WorkspaceFrame frame = frameFor(near, kBall);
    const double width_m = 2.0 * 5e3 * std::tan(Angle::degrees(20.0).radians());
    EXPECT_NEAR(frame.scene_per_meter, width_m / 0.12, 1e-3 * width_m / 0.12);
    const WorkspacePoint target = frame.toWorkspace(targetOf(near, kBall));
    EXPECT_NEAR(std::hypot(target.x, target.y), 0.0, 1e-6);
    EXPECT_NEAR(length(frame.body_axes->z - localAxes(kBall, near.target).up), 0.0, 1e-12);
    const LocalAxes local = localAxes(kBall, near.target);
    const double azimuth = near.azimuth.radians();
    EXPECT_NEAR(length(frame.body_axes->y -
                       (local.north * std::cos(azimuth) + local.east * std::sin(azimuth))),
                0.0, 1e-12);
    // From far away the whole ball is in the picture: to its edge where the view is tangent to it.
    const BodyCamera far = cameraOver(40.0, 60.0, 1e7);
    const double edge_m = 1e6 * std::sqrt(1.0 - 1.0 / (11.0 * 11.0));
    const WorkspaceFrame whole = frameFor(far, kBall);
    EXPECT_NEAR(whole.scene_per_meter, 2.0 * edge_m / 0.12, 0.02 * edge_m / 0.12);
    // A hand in the middle of the workspace is at the side that faces up, not in the ball.
    EXPECT_NEAR(length(whole.toScene({0.0, 0.0, 0.0})) / 1e6, 1.0, 1e-3);
}

TEST(BodyView, FindsTheTerrainOnTheVerticalOfTheWorkspace)
{
    constexpr double kHeightM = 5e3;
    const BodyCamera camera = cameraOver(-100.0, 35.0, 4e6);
    const WorkspaceFrame frame = frameFor(camera, kBall);
    const double radius = (1e6 + kHeightM) / frame.scene_per_meter;
    const WorkspacePoint center = frame.toWorkspace({});
    const BodyGround level = [](const GeographicPoint&) { return kHeightM; };
    for (const double x : {-0.5, 0.0, 0.3}) {
        for (const double y : {-0.2, 0.6}) {
            // From above the terrain, within the body and from below it.
            for (const double at_z : {0.02, center.z, center.z - 2.0 * radius}) {
                const WorkspacePoint at{center.x + x * radius, center.y + y * radius, at_z};
                const auto found = terrainAlong(frame, at, level, kBall);
                ASSERT_TRUE(found);
                const double z = center.z + radius * std::sqrt(1.0 - x * x - y * y);
                EXPECT_NEAR(length(frame.toWorkspace(*found) - WorkspacePoint{at.x, at.y, z}), 0.0,
                            1e-9);
            }
        }
    }
    EXPECT_FALSE(terrainAlong(frame, {center.x + 1.01 * radius, center.y, 0.0}, level, kBall));
    const BodyGround none = [](const GeographicPoint&) {
        return std::numeric_limits<double>::quiet_NaN();
    };
    EXPECT_FALSE(terrainAlong(frame, center, none, kBall));
}

// From far away a ball is a disc: the largest rectangle in it is a square.
TEST(BodyView, ASimulatedHandStrokesOnTheBallThatIsSeen)
{
    const BodyCamera far = cameraOver(40.0, 60.0, 2e7);
    const WorkspaceFrame frame = frameFor(far, kBall);
    const CameraPose pose = poseOf(far, kBall);
    const BodyGround level = [](const GeographicPoint&) { return 0.0; };
    const auto area = strokeArea(kReach, kSquare, [&](const WorkspacePoint& at) {
        const auto terrain = terrainAlong(frame, at, level, kBall);
        return terrain && dot(*terrain, pose.eye - *terrain) > 0.0
                   ? project(pose, kSquare, *terrain)
                   : std::nullopt;
    });
    ASSERT_TRUE(area);
    const double half = 1e6 / frame.scene_per_meter / std::numbers::sqrt2;
    constexpr double kCell = 0.16 / 32.0;
    EXPECT_NEAR(area->high.x, half, kCell);
    EXPECT_NEAR(area->low.x, -half, kCell);
    EXPECT_NEAR(area->high.y, half, kCell);
    EXPECT_NEAR(area->low.y, -half, kCell);
}

// On a sphere a roll and a turn about the vertical leave the camera level: the frame that follows
// the camera is the one that the camera has followed.
TEST(BodyView, CameraAndFrameFollowEachOther)
{
    const BodyCamera camera = cameraOver(-30.0, 20.0, 3e5);
    const BodyHandView before{camera, frameFor(camera, kBall), kBall};
    WorkspaceFrame frame = rolled(before.frame, kBall, {0.01, 0.02, 0.0}, Vec3{0.3, -0.7, 0.0});
    const BodyCamera followed = cameraFollowing(before, frame);
    EXPECT_NEAR(followed.distance_m, camera.distance_m, 1e-6);
    EXPECT_NEAR(followed.height_m, camera.height_m, 1e-5);
    EXPECT_GT(length(targetOf(followed, kBall) - targetOf(camera, kBall)), 1e5);
    const WorkspaceFrame again = frameFollowing(before, followed);
    EXPECT_NEAR(angleBetween(again, frame), 0.0, 1e-9);
    const WorkspacePoint corner{0.05, 0.05, 0.0};
    EXPECT_NEAR(length(again.toScene(corner) - frame.toScene(corner)), 0.0, 1e-3);
    const LimitedBodyView limited = limitedView({followed, frame, kBall}, followed);
    EXPECT_FALSE(limited.is_moved);
    BodyCamera higher = followed;
    higher.height_m += 1e4;
    EXPECT_FALSE(limitedView({followed, frame, kBall}, higher).is_moved);
    BodyCamera beside = followed;
    beside.target.latitude = beside.target.latitude + Angle::degrees(5.0);
    const LimitedBodyView moved = limitedView({followed, frame, kBall}, beside);
    EXPECT_TRUE(moved.is_moved);
    EXPECT_NEAR(length(moved.view.frame.toWorkspace(targetOf(beside, kBall)) -
                       frame.toWorkspace(targetOf(followed, kBall))),
                0.0, 1e-9);
}

// A camera that the limits have moved by more than a thousandth of its distance, or turned by more
// than 0.05°, is another view.
TEST(BodyView, ALimitMovesTheFrameOnlyIfItIsSeen)
{
    const BodyCamera camera = cameraOver(-30.0, 20.0, 3e5);
    const BodyHandView followed{camera, frameFor(camera, kBall), kBall};
    const auto is_moved = [&](auto change) {
        BodyCamera limited = camera;
        change(limited);
        return limitedView(followed, limited).is_moved;
    };
    for (const double sign : {-1.0, 1.0}) {
        const auto north = [&](double way_m) {
            return is_moved([&](BodyCamera& at) {
                at.target.latitude = at.target.latitude + Angle::radians(sign * way_m / 1e6);
            });
        };
        EXPECT_FALSE(north(290.0));
        EXPECT_TRUE(north(310.0));
        const auto away = [&](double share) {
            return is_moved([&](BodyCamera& at) { at.distance_m *= 1.0 + sign * share; });
        };
        EXPECT_FALSE(away(0.9e-3));
        EXPECT_TRUE(away(1.1e-3));
        const auto turned = [&](double degrees) {
            return is_moved(
                [&](BodyCamera& at) { at.azimuth = at.azimuth + Angle::degrees(sign * degrees); });
        };
        EXPECT_FALSE(turned(0.04));
        EXPECT_TRUE(turned(0.06));
        EXPECT_FALSE(turned(360.0));
    }
    EXPECT_TRUE(is_moved([](BodyCamera& at) { at.azimuth = -at.azimuth; }));
    // From far away a target that has moved by less than a thousandth of the distance may have
    // another north by more than 0.05°; headings count in whole turns.
    const BodyCamera far = cameraOver(-30.0, 20.0, 1e7);
    BodyCamera beside = far;
    beside.target.latitude = beside.target.latitude + Angle::degrees(0.1);
    beside.azimuth = beside.azimuth + Angle::degrees(360.0);
    EXPECT_FALSE(limitedView({far, frameFor(far, kBall), kBall}, beside).is_moved);
    // At a pole the heading of one and the same view depends on the longitude.
    BodyCamera pole = cameraOver(10.0, 90.0, 3e5);
    const BodyHandView over_pole{pole, frameFor(pole, kBall), kBall};
    pole.target.longitude = pole.target.longitude + Angle::degrees(40.0);
    pole.azimuth = pole.azimuth + Angle::degrees(40.0);
    EXPECT_FALSE(limitedView(over_pole, pole).is_moved);
    pole.azimuth = pole.azimuth + Angle::degrees(40.0);
    EXPECT_TRUE(limitedView(over_pole, pole).is_moved);
}

// Room for a hand over the highest terrain and below the lowest: 0.15 of the relief and 0.03 of the
// view's diagonal.
TEST(BodyView, TheWorkspaceHasRoomOverAndBelowARelief)
{
    constexpr double kReliefM = 1e4;
    BodyCamera camera = cameraOver(40.0, 60.0, 5e3);
    camera.azimuth = {};
    const WorkspaceFrame frame = frameForBodyView(
        camera, kSquare,
        [&](const GeographicPoint& foot) {
            return foot.latitude.radians() > camera.target.latitude.radians() ? kReliefM : 0.0;
        },
        kBall, kReach);
    // Terrain that is higher is wider by its share of the radius.
    const double width_m = 2.0 * 5e3 * std::tan(Angle::degrees(20.0).radians());
    const double room_m = 0.15 * kReliefM + 0.03 * width_m * std::hypot(1.01, 1.005);
    // The fall of a ball away from the target takes 3 m below, and as much is added above.
    const double fall_m = width_m * width_m / 4.0 / 1e6;
    EXPECT_NEAR(frame.scene_per_meter * 0.12, kReliefM + 2.0 * (room_m + fall_m), 1.0);
    const double middle_m = length(frame.toScene({})) - 1e6;
    EXPECT_NEAR(middle_m, 0.5 * kReliefM, 5.0);
}

// Over a few meters a ball is flat.
TEST(BodyView, OfASmallViewTheTerrainIsAtHalfTheHeight)
{
    const WorkspaceFrame frame = frameForBodyView(
        cameraOver(40.0, 60.0, 10.0), kSquare, [](const GeographicPoint&) { return 0.0; }, kBall,
        kReach);
    EXPECT_NEAR(length(frame.toScene({})) - 1e6, 0.0, 1e-3);
}

// At the camera's nearest and farthest distance the workspace has the scales between which a hand
// may zoom.
TEST(BodyView, LimitsOfTheCameraBoundAHand)
{
    const BodyCamera camera = cameraOver(-30.0, 20.0, 3e5);
    const BodyHandView view{camera, frameFor(camera, kBall), kBall};
    BodyLimits limits;
    limits.distance_min_m = 1e3;
    limits.distance_max_m = 6e6;
    ModeOptions modes;
    boundZoom(view, limits, modes);
    EXPECT_NEAR(modes.scene_per_meter_min / view.frame.scene_per_meter, 1e3 / 3e5, 1e-12);
    EXPECT_NEAR(modes.scene_per_meter_max / view.frame.scene_per_meter, 6e6 / 3e5, 1e-9);
    limits.area.middle = {.longitude = Angle::degrees(90.0), .latitude = Angle::degrees(30.0)};
    limits.area.reach = Angle::degrees(50.0);
    const auto bounds = boundsFor(view, limits);
    ASSERT_TRUE(bounds);
    EXPECT_NEAR(length(view.frame.toScene(bounds->target) - targetOf(camera, kBall)), 0.0, 1e-6);
    EXPECT_NEAR(length(bounds->middle - Vec3{0.0, std::sqrt(0.75), 0.5}), 0.0, 1e-12);
    EXPECT_NEAR(bounds->reach_rad, 50.0 * std::numbers::pi / 180.0, 1e-12);
    // A map around the body has no edge.
    limits.area.reach = Angle::radians(std::numbers::pi);
    EXPECT_FALSE(boundsFor(view, limits));
}

TEST(BodyView, TheFrameHasTheScaleOfTheCameraThatItFollows)
{
    const BodyCamera camera = cameraOver(-30.0, 20.0, 3e5);
    const BodyHandView before{camera, frameFor(camera, kBall), kBall};
    BodyCamera away = camera;
    away.distance_m *= 2.5;
    EXPECT_NEAR(frameFollowing(before, away).scene_per_meter / before.frame.scene_per_meter, 2.5,
                1e-12);
}

// Until the workspace fits the view again, level and of its size.
TEST(BodyView, TheWorkspaceSlowlyFitsTheViewAgain)
{
    const BodyCamera camera = cameraOver(-30.0, 20.0, 3e5);
    const WorkspaceFrame fitted = frameFor(camera, kMars);
    WorkspaceFrame frame = fitted.zoomed({0.03, 0.02, 0.01}, 1.4);
    frame.body_axes = *frame.body_axes * Rotation::by({0.1, -0.2, 0.05});
    const WorkspaceFit fit{.seen = frame, .fitted = fitted};
    const WorkspaceFrame seen = frame;
    const WorkspacePoint hand{0.02, -0.01, 0.03};
    int steps = 0;
    for (; steps < 20'000; ++steps) {
        const WorkspaceFrame next = marsview::fitted({}, fit, frame, seen, hand, {}, 1e-3);
        if (next == frame) {
            break;
        }
        EXPECT_LT(angleBetween(next, frame), 1.1e-4); // 0.1 rad/s
        frame = next;
    }
    EXPECT_LT(steps, 20'000);
    EXPECT_LT(angleBetween(frame, fitted), 2e-5);
    EXPECT_NEAR(frame.scene_per_meter / fitted.scene_per_meter, 1.0, 1e-4);
    EXPECT_LT(length(frame.toWorkspace(fitted.toScene(hand)) - hand), 3e-5);
}

TEST(BodyView, ARotationIsMadeAgainFromItsTurn)
{
    for (const Vec3& turn : {Vec3{}, Vec3{1e-10, 0.0, 0.0}, Vec3{0.3, -0.2, 0.7},
                             Vec3{0.0, 3.1, 0.0}, Vec3{0.0, 0.0, std::numbers::pi}}) {
        EXPECT_NEAR(length(Rotation::by(turn).turn() - turn), 0.0, 1e-9) << length(turn);
    }
    const Vec3 z{0.0, 0.0, 1.0};
    EXPECT_NEAR(length(Rotation::carrying(z, -z) * z + z), 0.0, 1e-12);
    EXPECT_NEAR(length(Rotation::carrying(z, {0.6, 0.0, 0.8}) * z - Vec3{0.6, 0.0, 0.8}), 0.0,
                1e-15);
}

} // namespace
} // namespace marsview
