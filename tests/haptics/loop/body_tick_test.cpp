#include "core/body/body_mesh.h"
#include "core/contact/body_goal_frame.h"
#include "core/contact/body_surface.h"
#include "core/contact/layered_surface.h"
#include "core/globe/body_camera.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/loop/camera_link.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/rt_scope.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/haptics/tick_time.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kRadiusM = 1e6;
constexpr double kElevationM = 2000.0;
constexpr double kMetersPerMeter = 2e7; // the ball has a radius of 50 mm in the workspace

struct Ground {
    std::shared_ptr<const Georeference> georeference;
    std::shared_ptr<const BodyMesh> mesh;

    const Ellipsoid& body() const { return mesh->positions().ellipsoid(); }
    std::shared_ptr<ServoMap> servoMap(ContactModelKind kind = kContactModelDefault) const
    {
        return makeServoMap(georeference, mesh, {.kind = kind, .contact = {.radius_m = 1e4}});
    }
};

Ground groundOf(const BodyMap& map, const std::shared_ptr<const FilledHeightfield>& heights)
{
    JobMonitor monitor;
    const auto georeference = std::make_shared<const Georeference>(georeferenceOf(map));
    return {georeference, BodyMesh::build(heights, *georeference, 1.0, monitor).value()};
}

// A ball: every sample has the same elevation on a sphere. Cells of half a degree lie up to 1e-5 of
// the radius below it, and their normals are within 0.36° of the vertical.
const Ground& ball()
{
    static const Ground made = [] {
        const BodyMap map{
            "Ball", "+proj=longlat +R=1000000 +no_defs", 720, 360, {0, 0.5, 0, 90, 0, -0.5}, 0.0};
        return groundOf(
            map, filledTerrain(map.columns, std::vector<float>(map.columns * map.rows,
                                                               static_cast<float>(kElevationM))));
    }();
    return made;
}

// Hills on an ellipsoid.
Ground hillyMars()
{
    BodyMap map = wholeMars(120, 60);
    map.crs = "IAU_2015:49902";
    return groundOf(map, fractalMap(map));
}

GeographicPoint degrees(double longitude, double latitude)
{
    return {.longitude = Angle::degrees(longitude), .latitude = Angle::degrees(latitude)};
}

struct Rig {
    Ground ground;
    DeviceCapabilities device = desktopDevice();
    TickOptions options = tickOptionsFor(device);
    LoopSettings settings;
    TickState state;
    TickInput input;
    std::uint64_t allocations = 0;

    // The surface at the site is at the middle of the workspace.
    explicit Rig(Ground on,
                 const GeographicPoint& site,
                 ContactModelKind kind = kContactModelDefault)
        : ground(std::move(on))
    {
        settings.map = ground.servoMap(kind);
        settings.frame = frameAt(site);
        settings.frame_number = 1;
        settings.stiffness_n_per_m = 400.0;
        options.limits.ramp_s = 1e-3; // full force at once
        options.limits.change_ramp_s = 1e-3;
        options.limits.rate_n_per_s_max = 1e5;
        options.is_passivity_kept = false;
    }

    WorkspaceFrame frameAt(const GeographicPoint& site) const
    {
        WorkspaceFrame frame = frameOverSite(
            ground.body(), {.place = site},
            {.minimum = {-1.0, -1.0, -1.0}, .maximum = {1.0, 1.0, 1.0}}, device.workspace);
        frame.place = frame.place + frame.body_axes->z * kElevationM;
        frame.scene_per_meter = kMetersPerMeter;
        return frame;
    }
    // The allocations of the ticks are counted.
    StepResult at(const WorkspacePoint& hand)
    {
        input.settings = &settings;
        input.device = &device;
        input.now += std::chrono::milliseconds(1);
        input.sample.position = hand;
        input.sample.time = input.now;
        const RtScope scope;
        const std::uint64_t before = RtScope::allocationCount();
        const StepResult result = step(options, input, state, kDt);
        allocations += RtScope::allocationCount() - before;
        return result;
    }
    StepResult to(const WorkspacePoint& hand, int ticks = 100)
    {
        const Vec3 way = hand - state.hand;
        const WorkspacePoint begin = state.hand;
        StepResult last;
        for (int i = 1; i <= ticks; ++i) {
            last = at(begin + way * (static_cast<double>(i) / ticks));
        }
        return last;
    }
    Vec3 upAt(const WorkspacePoint& hand) const
    {
        const Vec3 up = verticalAt(ground.body(), state.frame.toScene(hand)).up;
        return state.frame.body_axes->inverse() * up;
    }
};

WorkspacePoint point(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

// On the ball: the depth in the workspace times the stiffness, away from the center. Facets change
// the depth by 1e-5 of the radius and the direction by less than half a degree.
void expectPressedBack(const Rig& rig, const StepResult& result, const WorkspacePoint& hand)
{
    const ScenePoint at = rig.state.frame.toScene(hand);
    const double depth_m = (kRadiusM + kElevationM - length(at)) / kMetersPerMeter;
    const double force_n = rig.settings.stiffness_n_per_m * depth_m;
    ASSERT_GT(depth_m, 0.0);
    ASSERT_TRUE(result.contact.is_in_contact);
    ASSERT_NEAR(length(result.force_n), force_n,
                1e-3 * force_n + rig.settings.stiffness_n_per_m * 1e-5 * 0.05);
    const Vec3 up = rig.state.frame.body_axes->inverse() * normalized(at);
    ASSERT_NEAR(length(normalized(result.force_n) - up), 0.0, 0.0088);
}

TEST(BodyTick, PressesBackAlongTheLocalVertical)
{
    for (const GeographicPoint& site :
         {degrees(40.0, 30.0), degrees(0.1, -20.0), degrees(359.9, 0.0), degrees(200.0, 90.0),
          degrees(0.0, -90.0), degrees(10.0, 89.0)}) {
        Rig rig(ball(), site);
        for (const Vec3 across : {Vec3{}, Vec3{0.012, -0.018, 0.0}}) {
            // The ball's center is 50.1 mm below the middle.
            const double radius = (kRadiusM + kElevationM) / kMetersPerMeter;
            const Vec3 away = normalized(across + Vec3{0.0, 0.0, radius});
            const auto above = [&](double height) {
                return point(away * (radius + height) - Vec3{0.0, 0.0, radius});
            };
            EXPECT_EQ(rig.to(above(0.01)).force_n, Vec3{}); // free
            EXPECT_NEAR(rig.at(above(0.01)).surface_z_m, above(0.0).z, 1e-6);
            const StepResult result = rig.to(above(-0.003));
            EXPECT_EQ(result.mode, StylusMode::Press);
            EXPECT_EQ(result.reason, ForceOffReason::None);
            expectPressedBack(rig, result, above(-0.003));
            rig.to(above(0.01));
        }
        EXPECT_EQ(rig.allocations, 0U);
    }
}

// Along the ball, 3 mm below its surface: nothing is felt of the first meridian and of the poles.
TEST(BodyTick, StrokesAcrossTheFirstMeridianAndOverAPole)
{
    for (const auto& [site, direction] : {std::pair(degrees(0.0, 0.0), Vec3{1.0, 0.0, 0.0}),
                                          std::pair(degrees(30.0, 90.0), Vec3{0.6, 0.8, 0.0}),
                                          std::pair(degrees(180.0, -89.5), Vec3{0.0, 1.0, 0.0})}) {
        Rig rig(ball(), site);
        const double radius = (kRadiusM + kElevationM) / kMetersPerMeter;
        const auto along = [&](double angle, double height) {
            const Vec3 away = direction * std::sin(angle) + Vec3{0.0, 0.0, std::cos(angle)};
            return point(away * (radius + height) - Vec3{0.0, 0.0, radius});
        };
        rig.to(along(-0.4, 0.01));
        rig.to(along(-0.4, -0.003));
        for (int i = 0; i <= 800; ++i) {
            const WorkspacePoint hand = along(-0.4 + 1e-3 * i, -0.003);
            ASSERT_NO_FATAL_FAILURE(expectPressedBack(rig, rig.at(hand), hand)) << i;
        }
        EXPECT_EQ(rig.allocations, 0U);
    }
}

TEST(BodyTick, AnotherPlaceBelowTheHandIsReachedAboveTheBody)
{
    Rig rig(ball(), degrees(0.0, 0.0));
    rig.at({0.0, 0.0, 0.005});
    rig.to({0.0, 0.0, -0.003});
    for (const GeographicPoint& site :
         {degrees(180.0, 0.0), degrees(0.0, 0.0), degrees(90.0, 0.0), degrees(-90.0, 5.0),
          degrees(30.0, 90.0), degrees(0.0, -90.0), degrees(70.0, -60.0)}) {
        rig.settings.frame = rig.frameAt(site);
        ++rig.settings.frame_number;
        const StepResult jumped = rig.at({0.0, 0.0, -0.003});
        EXPECT_TRUE(jumped.has_changed_map);
        for (std::size_t i = 0; i + 1 < jumped.goals.count; ++i) {
            EXPECT_FALSE(jumped.goals.are_in_contact[i]);
        }
        rig.to({0.0, 0.0, -0.003}, 10);
        expectPressedBack(rig, rig.at({0.0, 0.0, -0.003}), {0.0, 0.0, -0.003});
    }
}

// What a recording contains, and `trace --scene body` repeats.
TEST(BodyTick, ItsGoalsGiveTheSameProxiesAgain)
{
    const Ground mars = hillyMars();
    for (const ContactModelKind kind : kContactModelKinds) {
        Rig rig(mars, degrees(350.0, 40.0), kind);
        const auto model =
            makeContactModel(kind, BodySurface(mars.mesh), ContactModelOptions{.radius_m = 1e4});
        const BodyGoalFrame frame = bodyGoalFrame(*mars.georeference, mars.body(), 1.0);
        std::size_t contacts = 0;
        for (int i = 0; i < 1500; ++i) {
            const double t = kDt * i;
            const StepResult result = rig.at({0.03 * std::sin(3.0 * t), 0.02 * std::cos(4.0 * t),
                                              -0.004 + 0.006 * std::cos(5.0 * t)});
            ASSERT_EQ(result.goals.count, 1U);
            const TracePoint& goal = result.goals.goals[0];
            const ContactState state = model->update(frame.toScene(goal));
            ASSERT_EQ(state.is_in_contact, result.contact.is_in_contact);
            ASSERT_EQ(state.is_in_contact ? frame.fromScene(state.proxy) : goal,
                      result.goals.proxies[0])
                << contactModelName(kind) << ' ' << i;
            contacts += state.is_in_contact ? 1U : 0U;
        }
        EXPECT_GT(contacts, 300U);
        EXPECT_EQ(rig.allocations, 0U);
    }
}

// From inside, the edge of a map that does not go around the body is a wall, as in the plane.
TEST(BodyTick, TheEdgeOfALocalMapIsAWallFromInside)
{
    const BodyMap map{"Part", "+proj=longlat +R=1000000 +no_defs", 41,
                      41,     {-1, 0.05, 0, 1, 0, -0.05},          0.0};
    const Ground ground =
        groundOf(map, filledTerrain(map.columns, std::vector<float>(41 * 41, 2000.0F)));
    constexpr double kBallM = 1.002; // 1 mm of the workspace is a kilometer
    const double edge = Angle::degrees(1.025).radians();
    const Vec3 border{std::sin(edge), 0.0, std::cos(edge)};
    const WorkspacePoint beyond{0.02, 0.0, -0.003};
    const auto begun = [&](const WorkspacePoint& at) {
        Rig rig(ground, degrees(0.0, 0.0));
        rig.settings.frame.scene_per_meter = 1e6;
        rig.at(at);
        return rig;
    };
    Rig rig = begun({0.0, 0.0, 0.005});
    EXPECT_NEAR(rig.to({0.0, 0.0, -0.003}).force_n.z, 1.2, 1e-3);
    rig.to({0.0, 0.0, 0.005});
    rig.to({0.02, 0.0, 0.005});
    const StepResult held = rig.to(beyond);
    EXPECT_TRUE(held.is_at_edge);
    EXPECT_TRUE(held.contact.is_in_contact);
    EXPECT_TRUE(std::isnan(held.surface_z_m));
    const Vec3 from_center{beyond.x, 0.0, kBallM + beyond.z};
    EXPECT_NEAR(length(held.force_n - (border * kBallM - from_center) * 400.0), 0.0, 5e-3);
    // A hand that begins outside touches nothing until it comes over the map.
    Rig outside = begun({0.03, 0.0, 0.005});
    EXPECT_EQ(outside.to({0.03, 0.0, -0.003}).force_n, Vec3{});
    EXPECT_FALSE(outside.at({0.03, 0.0, -0.003}).is_at_edge);
    const StepResult inside = outside.to({0.0, 0.0, -0.003});
    EXPECT_TRUE(inside.contact.is_in_contact);
    EXPECT_NEAR(outside.to({0.0, 0.0, -0.003}).force_n.z, 1.2, 1e-3);
    EXPECT_EQ(rig.allocations + outside.allocations, 0U);
}

TEST(BodyTick, WithoutAFrameOnTheBodyNothingIsTouched)
{
    Rig rig(ball(), degrees(0.0, 0.0));
    rig.settings.frame.body_axes.reset();
    EXPECT_EQ(rig.at({0.0, 0.0, -0.003}).reason, ForceOffReason::NoTouch);
    Rig flat(ball(), degrees(0.0, 0.0));
    flat.settings.map = servoMap(11, 11, [](std::size_t, std::size_t) { return 0.0; });
    EXPECT_EQ(flat.at({0.0, 0.0, -0.003}).reason, ForceOffReason::NoTouch);
}

// The ball turns about its center until the grabbed point is below the hand again; the hand is held
// at its height.
TEST(BodyTick, APanRollsTheBodyUnderTheHand)
{
    Rig rig(ball(), degrees(77.0, 35.0));
    const double radius = (kRadiusM + kElevationM) / kMetersPerMeter;
    const auto along = [&](double angle, double height) {
        return point(Vec3{std::sin(angle), 0.0, std::cos(angle)} * (radius + height) -
                     Vec3{0.0, 0.0, radius});
    };
    rig.to(along(0.1, 0.01));
    rig.to(along(0.1, -0.003));
    const Vec3 grabbed = normalized(rig.state.frame.toScene(along(0.1, -0.003)));
    const WorkspacePoint center = rig.state.frame.toWorkspace({});
    rig.settings.is_grabbing = true;
    const StepResult begun = rig.at(along(0.1, -0.003));
    EXPECT_EQ(begun.mode, StylusMode::Pan);
    EXPECT_NEAR(length(begun.force_n - rig.upAt(along(0.1, -0.003)) * 1.2), 0.0, 0.02);
    rig.to(along(0.1, -0.003), 200); // the hold becomes firm
    WorkspaceFrame recorded = rig.state.seen_frame;
    for (int i = 0; i <= 500; ++i) {
        if (const auto motion = rig.at(along(0.1 + 1e-3 * i, -0.003)).motion) {
            recorded = recorded.after(*motion);
        }
    }
    EXPECT_LT(length(recorded.toScene({}) - rig.state.seen_frame.toScene({})), 1e-9 * kRadiusM)
        << "the motions in a recording lead to the same place";
    rig.to(along(0.6, -0.003), 2000);
    const StepResult held = rig.at(along(0.6, -0.003));
    EXPECT_LT(length(rig.state.frame.toWorkspace({}) - center), 1e-9);
    EXPECT_NEAR(length(normalized(rig.state.frame.toScene(along(0.6, -0.003))) - grabbed), 0.0,
                1e-3);
    EXPECT_NEAR(length(held.force_n - rig.upAt(along(0.6, -0.003)) * 1.2), 0.0, 0.02);
    // One millimeter deeper: 0.4 N more.
    const StepResult deeper = rig.to(along(0.6, -0.004), 500);
    EXPECT_NEAR(length(deeper.force_n - rig.upAt(along(0.6, -0.004)) * 1.6), 0.0, 0.02);
    EXPECT_EQ(rig.allocations, 0U);
}

// Released in motion, it keeps turning about the same axis, wherever the hand moves.
TEST(BodyTick, AReleasedBodyKeepsItsAxisAndLosesItsSpeedToDrag)
{
    Rig rig(ball(), degrees(0.0, 0.0));
    rig.at({0.0, 0.0, 0.01});
    rig.to({0.0, 0.0, -0.002});
    rig.settings.is_grabbing = true;
    for (int i = 0; i < 200; ++i) {
        rig.at({5e-5 * i, 0.0, -0.002});
    }
    rig.settings.is_grabbing = false;
    rig.to({0.01, 0.0, 0.03});
    const Vec3 spin = rig.state.body_modes.spin_rad_per_s;
    EXPECT_GT(spin.y, 0.5); // about the axis away from the user: 50 mm/s at 48 mm
    EXPECT_LT(std::hypot(spin.x, spin.z), 1e-3 * spin.y);
    Rotation before = *rig.state.frame.body_axes;
    rig.to({0.01, 0.03, 0.02}, 1000);
    const Vec3 later = rig.state.body_modes.spin_rad_per_s;
    EXPECT_NEAR(length(normalized(later) - normalized(spin)), 0.0, 1e-12);
    const double drag_per_s = rig.settings.modes.pan.drag_per_s;
    const double share = std::pow(1.0 + drag_per_s * kDt, -1000.0);
    EXPECT_NEAR(length(later) / length(spin), share, 1e-9);
    // By the sum of the steps, about that axis.
    double angle = 0.0;
    for (int i = 1; i <= 1000; ++i) {
        angle += length(spin) * std::pow(1.0 + drag_per_s * kDt, -i) * kDt;
    }
    const Rotation expected = before * Rotation::by(-normalized(spin) * angle);
    EXPECT_NEAR(length(rig.state.frame.body_axes->x - expected.x), 0.0, 1e-6);
    EXPECT_EQ(rig.allocations, 0U);
}

TEST(BodyTick, ARollKeepsTheVerticalAndTheHeightAtTheHandOnAnEllipsoid)
{
    const Ground mars = hillyMars();
    Rig rig(mars, degrees(20.0, 45.0));
    const WorkspacePoint hand{0.02, -0.01, 0.004};
    WorkspaceFrame frame = rig.settings.frame;
    const BodyVertical before = verticalAt(mars.body(), frame.toScene(hand));
    const Vec3 up = frame.body_axes->inverse() * before.up;
    for (int i = 0; i < 3000; ++i) {
        frame = rolled(frame, mars.body(), hand, {1e-3, 2e-3, 0.0});
    }
    const BodyVertical after = verticalAt(mars.body(), frame.toScene(hand));
    EXPECT_NEAR(after.height_m, before.height_m, 1e-5);
    EXPECT_NEAR(length(frame.body_axes->inverse() * after.up - up), 0.0, 1e-12);
    EXPECT_NEAR(frame.scene_per_meter, kMetersPerMeter, 0.0);
}

// Raised and twisted in free space, away from the middle: about the vertical there.
TEST(BodyTick, ZoomAndTwistAreAboutTheVerticalAtTheHand)
{
    const Ground mars = hillyMars();
    Rig rig(mars, degrees(120.0, -30.0));
    rig.settings.frame.scene_per_meter = 5e7;
    const WorkspacePoint begin{0.015, 0.01, 0.02};
    rig.at(begin);
    const ScenePoint before = rig.state.frame.toScene(begin);
    const Vec3 up_before = verticalAt(mars.body(), before).up;
    const Vec3 up = rig.upAt(begin);
    const WorkspaceFrame frame = rig.state.frame;
    rig.settings.is_grabbing = true;
    constexpr double kRiseM = 0.012;
    constexpr double kTwist = 0.5;
    StepResult last = rig.at(begin);
    EXPECT_EQ(last.mode, StylusMode::Zoom);
    WorkspacePoint hand = begin;
    for (int i = 1; i <= 200; ++i) {
        hand = begin + up * (kRiseM * i / 200.0);
        rig.input.sample.twist_rad = kTwist * i / 200.0;
        last = rig.at(hand);
    }
    EXPECT_EQ(last.mode, StylusMode::Zoom);
    const WorkspaceFrame& after = rig.state.frame;
    EXPECT_NEAR(after.scene_per_meter,
                frame.scene_per_meter / zoomFactor(rig.settings.modes.zoom, kRiseM),
                1e-9 * frame.scene_per_meter);
    const BodyVertical now = verticalAt(mars.body(), after.toScene(hand));
    EXPECT_NEAR(length(now.up - up_before), 0.0, 1e-9) << "over the same place";
    EXPECT_NEAR(length(rig.upAt(hand) - up), 0.0, 1e-9) << "which has not tilted";
    // The body has turned with the stylus, counterclockwise about the vertical.
    const Vec3 north = frame.body_axes->inverse() * Vec3{0.0, 0.0, 1.0};
    const Vec3 turned = after.body_axes->inverse() * Vec3{0.0, 0.0, 1.0};
    EXPECT_NEAR(length(Rotation::by(up * kTwist) * north - turned), 0.0, 1e-9);
    EXPECT_EQ(rig.allocations, 0U);
}

// Hand, tick, frame, camera and the camera's limits together. The ball is pulled eastward by an arc
// that is longer than the camera may go: its target turns by the arc, as far as its limit.
TEST(BodyTick, TheCameraFollowsTheHandUpToItsLimits)
{
    const GeographicPoint site = degrees(20.0, 0.0);
    Rig rig(ball(), site);
    constexpr double kReachDeg = 20.0;
    const BodyLimits limits{.ellipsoid = ball().body(),
                            .area = {.middle = site, .reach = Angle::degrees(kReachDeg)},
                            .lowest_m = kElevationM,
                            .highest_m = kElevationM,
                            .distance_min_m = 1e3,
                            .distance_max_m = 1e8};
    const BodyGround ground = [](const GeographicPoint&) { return kElevationM; };
    BodyCamera camera =
        constrained({.target = site, .height_m = kElevationM, .distance_m = 2e6}, limits, ground);
    BodyCameraLink link;
    link.begin({.camera = camera, .frame = rig.settings.frame, .body = limits.ellipsoid}, limits,
               rig.settings);
    const double radius = (kRadiusM + kElevationM) / kMetersPerMeter;
    const auto along = [&](double angle) {
        return point(Vec3{std::sin(angle), 0.0, std::cos(angle)} * (radius - 0.003) -
                     Vec3{0.0, 0.0, radius});
    };
    int corrections = 0;
    const auto hold = [&](double angle, int ticks) {
        StepResult last;
        for (int i = 0; i < ticks; ++i) {
            last = rig.at(along(angle));
            EXPECT_FALSE(last.has_changed_map);
            if (i % 16 == 0) {
                const LinkStep step = link.follow(
                    {.seen = rig.state.seen_frame,
                     .number = rig.state.frame_number,
                     .mode = rig.state.modes.mode},
                    limits, rig.settings,
                    [&](const BodyCamera& wanted) {
                        return camera = constrained(wanted, limits, ground);
                    },
                    [&] { return rig.settings.frame; });
                corrections += step.has_moved_camera && step.has_changed_settings ? 1 : 0;
            }
        }
        return last;
    };
    rig.at({0.0, 0.0, 0.01});
    rig.to(along(0.0));
    rig.settings.is_grabbing = true;
    hold(0.0, 300);
    const double target_x = rig.state.frame.toWorkspace(targetOf(camera, limits.ellipsoid)).x;
    for (int i = 1; i <= 200; ++i) {
        hold(1e-3 * i, 4);
    }
    hold(0.2, 2000);
    // The terrain goes east with the hand, and the target of the picture to the west.
    EXPECT_NEAR(camera.target.longitude.degrees(), 20.0 - Angle::radians(0.2).degrees(), 0.1);
    EXPECT_NEAR(camera.target.latitude.degrees(), 0.0, 1e-6);
    EXPECT_NEAR(rig.state.frame.toWorkspace(targetOf(camera, limits.ellipsoid)).x, target_x, 1e-4);
    for (int i = 201; i <= 500; ++i) {
        hold(1e-3 * i, 4);
    }
    const StepResult held = hold(0.5, 2000);
    EXPECT_EQ(corrections, 0) << "the tick keeps within the limits by itself";
    EXPECT_EQ(held.mode, StylusMode::Pan);
    EXPECT_NEAR(camera.target.longitude.degrees(), 20.0 - kReachDeg, 0.1);
    EXPECT_NEAR(rig.state.frame.toWorkspace(targetOf(camera, limits.ellipsoid)).x, target_x, 1e-3);
    EXPECT_EQ(rig.allocations, 0U);
}

// Where another map is seen that cannot be touched, the hand is in free space, inside and beyond.
TEST(BodyTick, ACoveredMapIsNotFelt)
{
    Rig rig(ball(), degrees(40.0, 30.0));
    rig.at({0.0, 0.0, 0.01});
    expectPressedBack(rig, rig.to({0.0, 0.0, -0.003}), {0.0, 0.0, -0.003});
    rig.settings.is_covered = true;
    StepResult covered = rig.to({0.0, 0.0, -0.003}, 20);
    EXPECT_EQ(covered.force_n, Vec3{});
    EXPECT_FALSE(covered.contact.is_in_contact);
    EXPECT_EQ(covered.goals.count, 0U) << "the model is not asked";
    covered = rig.to({0.01, 0.0, -0.02});
    EXPECT_EQ(length(covered.goal - rig.state.frame.toScene({0.01, 0.0, -0.02})), 0.0);
    rig.settings.is_covered = false;
    rig.to({0.01, 0.0, -0.004}, 20);
    expectPressedBack(rig, rig.at({0.01, 0.0, -0.004}), {0.01, 0.0, -0.004});
    EXPECT_EQ(rig.allocations, 0U);
}

// Over the border of a map, whose faces are stored, and over those that are not.
TEST(LayeredSurface, UpdatesAllocateNothing)
{
    JobMonitor monitor;
    for (const NestedMaps& nested : nestedMaps({"FineWithVoids"})) {
        const auto maps = meshesOf(nested);
        const auto mesh = LayeredMesh::build(maps, monitor);
        ASSERT_TRUE(mesh) << mesh.error().message;
        Random random(5);
        for (const ContactModelKind kind : kContactModelKinds) {
            const auto model = makeContactModel(kind, LayeredSurface(*mesh), {.radius_m = 100.0});
            std::uint64_t allocations = 0;
            int contacts = 0;
            for (int i = 0; i < 50; ++i) {
                const ScenePoint place = placeNear(*maps.front(), random);
                const ScenePoint goal = place * random.uniform(0.995, 1.0);
                const std::uint64_t before = RtScope::allocationCount();
                const RtScope scope;
                contacts += model->update(goal).is_in_contact ? 1 : 0;
                allocations += RtScope::allocationCount() - before;
            }
            EXPECT_EQ(allocations, 0U) << contactModelName(kind);
            EXPECT_GT(contacts, 10) << contactModelName(kind);
        }
    }
}

} // namespace
} // namespace marsview::test
