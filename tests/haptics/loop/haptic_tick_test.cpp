#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/rt_scope.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/haptics/tick_time.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

using namespace std::chrono_literals;

// A level plane at 10 m. 1 m of the scene is 1 mm of the workspace, whose middle is 20 m above the
// plane, over the middle of the map.
struct Rig {
    DeviceCapabilities device = desktopDevice();
    TickOptions options = tickOptionsFor(device);
    LoopSettings settings;
    TickState state;
    TickInput input;

    explicit Rig(std::shared_ptr<ServoMap> map = servoMap(201, 201, [](std::size_t, std::size_t) {
                     return 10.0;
                 }))
    {
        settings.map = std::move(map);
        settings.frame = {.place = {0.0, 0.0, 30.0}, .scene_per_meter = 1000.0};
        settings.frame_number = 1;
        settings.stiffness_n_per_m = 400.0;
        options.limits.ramp_s = 1e-3; // full force at once
        options.limits.change_ramp_s = 1e-3;
        options.limits.rate_n_per_s_max = 1e5;
        options.is_passivity_kept = false;
    }

    StepResult at(const WorkspacePoint& hand, double dt_s = kDt)
    {
        input.settings = &settings;
        input.device = &device;
        input.now += std::chrono::milliseconds(1);
        input.sample.position = hand;
        input.sample.time = input.now;
        return step(options, input, state, dt_s);
    }
    // Straight there, at the speed of a hand.
    StepResult to(const WorkspacePoint& hand)
    {
        const Vec3 way = hand - state.hand;
        StepResult last;
        const WorkspacePoint begin = state.hand;
        for (int i = 1; i <= 100; ++i) {
            last = at(begin + way * (0.01 * i));
        }
        return last;
    }
};

TEST(HapticTick, PressesBackByTheDepthInTheWorkspace)
{
    Rig rig;
    EXPECT_EQ(rig.at({}).force_n, Vec3{});                // 20 mm above
    const StepResult result = rig.to({0.0, 0.0, -0.025}); // 5 mm below
    EXPECT_TRUE(result.contact.is_in_contact);
    EXPECT_EQ(result.mode, StylusMode::Press);
    EXPECT_NEAR(result.force_n.z, 2.0, 1e-9); // of 400 N/m
    EXPECT_NEAR(std::hypot(result.force_n.x, result.force_n.y), 0.0, 1e-9);
    EXPECT_NEAR(result.proxy.z, 10.0, 1e-9);
    EXPECT_EQ(result.reason, ForceOffReason::None);
}

TEST(HapticTick, ARehearsalHasTheResultOfTheTickAndChangesNothing)
{
    const auto hills = [](std::size_t column, std::size_t row) {
        return 10.0 + 3.0 * std::sin(0.4 * static_cast<double>(column)) +
               2.0 * std::cos(0.3 * static_cast<double>(row));
    };
    for (const ContactModelKind kind : kContactModelKinds) {
        Rig rehearsed(servoMap(201, 201, hills, {.kind = kind}));
        Rig plain(servoMap(201, 201, hills, {.kind = kind}));
        std::size_t contacts = 0;
        for (int i = 0; i < 2000; ++i) {
            const double t = 1e-3 * i;
            const WorkspacePoint hand{0.03 * std::sin(3.0 * t), 0.02 * std::cos(4.0 * t),
                                      -0.022 + 0.006 * std::sin(2.0 * t)};
            plain.settings.is_grabbing = rehearsed.settings.is_grabbing = i > 1200 && i < 1600;
            rehearsed.input.settings = &rehearsed.settings;
            rehearsed.input.device = &rehearsed.device;
            TickInput input = rehearsed.input;
            input.now += std::chrono::milliseconds(1);
            input.sample.position = hand;
            input.sample.time = input.now;
            StepResult expected;
            {
                const RtScope scope;
                const auto allocations = RtScope::allocationCount();
                expected = rehearse(rehearsed.options, input, rehearsed.state, kDt);
                ASSERT_EQ(RtScope::allocationCount(), allocations);
            }
            const StepResult result = rehearsed.at(hand);
            const StepResult without = plain.at(hand);
            ASSERT_EQ(result.force_n, expected.force_n) << contactModelName(kind) << ' ' << i;
            ASSERT_EQ(result.contact.proxy, expected.contact.proxy);
            ASSERT_EQ(result.mode, expected.mode);
            ASSERT_EQ(result.force_n, without.force_n) << "rehearsals change nothing";
            ASSERT_EQ(result.contact.proxy, without.contact.proxy);
            contacts += result.contact.is_in_contact ? 1U : 0U;
        }
        EXPECT_GT(contacts, 500U);
    }
}

TEST(HapticTick, ASmoothMotionOfTheCameraIsNoJump)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.025});
    rig.settings.frame.place.x += 1.0; // 1 mm of the workspace
    ++rig.settings.frame_number;
    EXPECT_FALSE(rig.at({0.0, 0.0, -0.025}).has_changed_map);
    rig.settings.frame.place.x += 5.0; // 5 mm
    ++rig.settings.frame_number;
    EXPECT_TRUE(rig.at({0.0, 0.0, -0.025}).has_changed_map);
}

// 2 mm: of the map below the hand, and, where the map is scaled about the hand, of the point that
// is touched, 5 mm above it.
TEST(HapticTick, AJumpOfTheMapIsAMotionOfTwoMillimeters)
{
    for (const double moved_mm : {1.9, 2.1}) {
        const bool is_jump = moved_mm > 2.0;
        Rig free;
        free.at({});
        free.settings.frame.place.y -= moved_mm;
        ++free.settings.frame_number;
        EXPECT_EQ(free.at({}).has_changed_map, is_jump) << moved_mm;
        Rig pressed;
        pressed.at({});
        pressed.to({0.0, 0.0, -0.025});
        pressed.settings.frame =
            pressed.settings.frame.zoomed(pressed.state.hand, (5.0 + moved_mm) / 5.0);
        ++pressed.settings.frame_number;
        EXPECT_EQ(pressed.at({0.0, 0.0, -0.025}).has_changed_map, is_jump) << moved_mm;
    }
}

// The difference between the forces of a hold and of the surface fades after a release; a later
// jump does not bring it back.
TEST(HapticTick, NoForceOfAnEarlierHoldFollowsAJump)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.022});
    rig.settings.is_grabbing = true;
    EXPECT_LT(rig.to({0.0, 0.0, -0.015}).force_n.z, -1.0) << "the hold pulls back";
    rig.settings.is_grabbing = false;
    rig.at({0.0, 0.0, -0.015});
    EXPECT_EQ(rig.to({0.0, 0.0, 0.0}).force_n, Vec3{});
    rig.options.limits.change_ramp_s = 0.05;
    rig.settings.frame.place = rig.state.frame.place + Vec3{20.0, 0.0, 0.0};
    ++rig.settings.frame_number;
    const StepResult jumped = rig.at({});
    EXPECT_TRUE(jumped.has_changed_map);
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(rig.at({}).force_n, Vec3{}) << i;
    }
    // Nor does one that still fades: a jump ends it.
    rig.options.limits.change_ramp_s = 1e-3;
    rig.to({0.0, 0.0, -0.022});
    rig.settings.is_grabbing = true;
    EXPECT_LT(rig.to({0.0, 0.0, -0.015}).force_n.z, -1.0);
    rig.settings.is_grabbing = false;
    rig.options.limits.change_ramp_s = 0.05;
    EXPECT_LT(rig.at({0.0, 0.0, -0.015}).force_n.z, -1.0);
    rig.settings.frame.place = rig.state.frame.place + Vec3{20.0, 0.0, 0.0};
    ++rig.settings.frame_number;
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(rig.at({0.0, 0.0, -0.015}).force_n, Vec3{}) << i;
    }
}

// Linearly, within the time of a ramp, or of a millisecond if that is zero.
TEST(HapticTick, TheForceOfAHoldFadesAfterARelease)
{
    for (const auto& [ramp_s, ticks] : {std::pair(0.01, 10), std::pair(0.0, 1)}) {
        Rig rig;
        rig.at({});
        rig.to({0.0, 0.0, -0.022});
        rig.settings.is_grabbing = true;
        const double held_n = rig.to({0.0, 0.0, -0.015}).force_n.z;
        EXPECT_LT(held_n, -1.0);
        rig.settings.is_grabbing = false;
        rig.options.limits.change_ramp_s = ramp_s;
        for (int i = 0; i < ticks + 2; ++i) {
            EXPECT_NEAR(rig.at({0.0, 0.0, -0.015}).force_n.z,
                        held_n * std::max(0.0, 1.0 - static_cast<double>(i) / ticks), 1e-9)
                << ramp_s << " s, tick " << i;
        }
    }
}

TEST(HapticTick, ReportsTheHeightOfTheSurfaceBelowTheHand)
{
    Rig rig; // 20 mm above the plane
    EXPECT_NEAR(rig.at({}).surface_z_m, -0.02, 1e-12);
    EXPECT_NEAR(rig.to({0.01, 0.0, -0.025}).surface_z_m, -0.02, 1e-12);
    rig.settings.frame.scene_per_meter = 4000.0; // the edge of the map is at 25 mm
    ++rig.settings.frame_number;
    rig.to({0.02, 0.0, 0.02});
    EXPECT_TRUE(std::isnan(rig.to({0.03, 0.0, 0.02}).surface_z_m)) << "outside the map";
}

TEST(HapticTick, FeelsASlopeAtARightAngleHoweverTheMapIsTurned)
{
    const auto slope = [](std::size_t column, std::size_t) {
        return 0.5 * (static_cast<double>(column) - 100.0);
    };
    for (const double turn_deg : {0.0, 90.0, -37.0}) {
        Rig rig(servoMap(201, 201, slope));
        rig.settings.frame.place.z = 0.0;
        rig.settings.frame.turn = Angle::degrees(turn_deg);
        rig.at({0.0, 0.0, 0.02});
        const StepResult result = rig.to({0.0, 0.0, -0.003});
        ASSERT_TRUE(result.contact.is_in_contact);
        const double force = 400.0 * 0.003 / std::sqrt(1.25); // depth along the normal
        EXPECT_NEAR(length(result.force_n), force, 1e-6);
        // Downhill is west in the scene.
        const Vec3 in_scene = rig.state.frame.differenceToScene(result.force_n);
        EXPECT_NEAR(in_scene.y, 0.0, 1e-6 * 1000.0);
        EXPECT_NEAR(in_scene.x / in_scene.z, -0.5, 1e-6);
    }
}

TEST(HapticTick, AtAWallTheTerrainForceIsZero)
{
    Rig rig;
    rig.at({});
    EXPECT_NEAR(rig.to({0.0, 0.0, -0.025}).force_n.z, 2.0, 1e-9);
    const StepResult half = rig.to({0.08 - 0.5 * kWallFadeM, 0.0, -0.025});
    EXPECT_NEAR(half.force_n.z, 1.0, 1e-9);
    EXPECT_NEAR(half.force_n.x, 0.0, 1e-9);
    const StepResult beyond = rig.to({0.082, 0.0, -0.025});
    EXPECT_NEAR(beyond.force_n.z, 0.0, 1e-9);
    EXPECT_NEAR(beyond.force_n.x, -0.8, 1e-9);
    rig.settings.has_walls = false;
    EXPECT_NEAR(rig.at({0.082, 0.0, -0.025}).force_n.x, 0.0, 1e-9);
}

TEST(HapticTick, TheEdgeOfTheMapIsAWallFromInside)
{
    Rig rig;
    rig.settings.frame.scene_per_meter = 4000.0; // the map is 50 mm wide, its edge at 25 mm
    rig.at({});
    const StepResult in_air = rig.to({0.027, 0.0, 0.0});
    EXPECT_FALSE(in_air.contact.is_in_contact);
    EXPECT_TRUE(in_air.is_at_edge);
    EXPECT_NEAR(in_air.force_n.x, -400.0 * 0.002, 1e-9);
    EXPECT_NEAR(in_air.force_n.z, 0.0, 1e-9);
    rig.to({0.02, 0.0, 0.0});
    const StepResult result = rig.to({0.026, 0.0, -0.01});
    EXPECT_TRUE(result.contact.is_in_contact);
    EXPECT_NEAR(result.force_n.x, -400.0 * 0.001, 1e-9);
    EXPECT_NEAR(result.force_n.z, 400.0 * 0.005, 1e-9);
    EXPECT_FALSE(rig.to({0.0, 0.0, 0.0}).is_at_edge);
}

TEST(HapticTick, BesideTheMapThereIsNothingToTouch)
{
    Rig rig;
    rig.settings.frame.scene_per_meter = 4000.0;
    rig.at({0.04, 0.0, 0.0}); // begins outside the map
    const StepResult below = rig.to({0.04, 0.0, -0.02});
    EXPECT_FALSE(below.contact.is_in_contact);
    EXPECT_FALSE(below.is_at_edge);
    EXPECT_EQ(below.force_n, Vec3{});
    EXPECT_NEAR(length(below.contact.proxy - rig.state.frame.toScene({0.04, 0.0, -0.02})), 0.0,
                1e-9);
    rig.to({0.04, 0.0, 0.0});
    rig.to({0.0, 0.0, 0.0});
    EXPECT_NEAR(rig.to({0.0, 0.0, -0.01}).force_n.z, 400.0 * 0.005, 1e-9);
    EXPECT_NEAR(rig.to({0.026, 0.0, 0.0}).force_n.x, -0.4, 1e-9); // a wall from now on
}

TEST(HapticTick, ReportsANewMapAndItsRemovalAsChanges)
{
    Rig rig;
    EXPECT_TRUE(rig.at({}).has_changed_map);
    EXPECT_FALSE(rig.at({}).has_changed_map);
    rig.settings.map = nullptr;
    EXPECT_TRUE(rig.at({}).has_changed_map);
    EXPECT_FALSE(rig.at({}).has_changed_map);
    rig.settings.map = servoMap(201, 201, [](std::size_t, std::size_t) { return 10.0; });
    EXPECT_TRUE(rig.at({}).has_changed_map);
}

// 160 mm, the width of the workspace, and an octave: less than 5 s, without a force.
TEST(HapticTick, InFreeSpaceTheWorkspaceFitsTheViewWithinFiveSeconds)
{
    Rig rig;
    rig.settings.frame.place.z = 70.0; // 60 mm above the terrain
    rig.at({});
    WorkspaceFit fit{.seen = rig.settings.frame, .fitted = rig.settings.frame};
    fit.fitted.scene_per_meter *= 2.0;
    fit.fitted.place.z += 0.16 * fit.fitted.scene_per_meter; // the terrain sinks
    rig.settings.fit = fit;
    for (int i = 0; i < 5000; ++i) {
        ASSERT_EQ(rig.at({}).force_n, Vec3{});
    }
    const WorkspacePoint at = fit.fitted.toWorkspace(rig.state.frame.toScene({}));
    EXPECT_LT(length(at - WorkspacePoint{}), 1e-3);
    EXPECT_NEAR(std::log2(rig.state.frame.scene_per_meter / fit.fitted.scene_per_meter), 0.0, 0.01);
}

// The surface is 20 mm above the workspace, whose top is at 60 mm; the hand below it cannot get
// into free space.
TEST(HapticTick, ASurfaceAboveTheWorkspaceSinksToItsTop)
{
    Rig rig;
    rig.settings.frame.place.z = -70.0;
    rig.at({});
    const auto surface_z = [&rig] { return rig.state.frame.toWorkspace({0.0, 0.0, 10.0}).z; };
    EXPECT_NEAR(surface_z(), 0.08, 20.001e-6);
    for (int i = 0; i < 3000; ++i) {
        const double before = surface_z();
        ASSERT_TRUE(rig.at({0.0, 0.0, 0.01}).contact.is_in_contact);
        ASSERT_LE(before - surface_z(), 20.001e-6); // 20 mm in a second
    }
    EXPECT_NEAR(surface_z(), 0.06, 1e-6);
    EXPECT_EQ(rig.state.seen_frame, rig.settings.frame); // the camera stays
}

TEST(HapticTick, WithoutAStatedHeightAWorkspaceHasNoTop)
{
    Rig rig;
    rig.device.workspace.low.z = rig.device.workspace.high.z = 0.0;
    rig.settings.frame.place.z = -70.0; // the surface is at 80 mm
    for (int i = 0; i < 100; ++i) {
        rig.at({});
    }
    EXPECT_NEAR(rig.state.frame.toWorkspace({0.0, 0.0, 10.0}).z, 0.08, 1e-12);
}

// Section 4.2: while the hand pans, the vertical position is held.
TEST(HapticTick, ASurfaceAboveTheWorkspaceRestsWhileItIsHeld)
{
    Rig rig;
    rig.settings.frame.place.z = -70.0;
    rig.at({});
    rig.settings.is_grabbing = true;
    EXPECT_EQ(rig.at({}).mode, StylusMode::Pan);
    const double before = rig.state.frame.toWorkspace({0.0, 0.0, 10.0}).z;
    for (int i = 0; i < 100; ++i) {
        rig.at({});
    }
    EXPECT_NEAR(rig.state.frame.toWorkspace({0.0, 0.0, 10.0}).z, before, 1e-12);
    rig.settings.is_grabbing = false;
    rig.at({});
    EXPECT_LT(rig.state.frame.toWorkspace({0.0, 0.0, 10.0}).z, before - 15e-6); // sinks on
}

TEST(HapticTick, NearTheSurfaceTheWorkspaceSlowlyFitsTheView)
{
    Rig rig;
    rig.settings.frame.place.z = 13.0; // the terrain 3 mm below the hand
    rig.at({});
    WorkspaceFit fit{.seen = rig.settings.frame, .fitted = rig.settings.frame};
    fit.fitted.place.z += 10.0; // the terrain 10 mm lower in the workspace
    fit.fitted.scene_per_meter *= 1.1;
    rig.settings.fit = fit;
    WorkspaceFrame last = rig.state.frame;
    for (int i = 0; i < 3000; ++i) {
        const StepResult result = rig.at({});
        EXPECT_EQ(result.force_n, Vec3{});
        // At most 15 mm a second.
        ASSERT_LE(length(rig.state.frame.toWorkspace(last.toScene({})) - WorkspacePoint{}),
                  15.001e-6);
        last = rig.state.frame;
    }
    EXPECT_NEAR(rig.state.frame.scene_per_meter, fit.fitted.scene_per_meter, 0.2);
    EXPECT_NEAR(rig.state.frame.toScene({}).z, fit.fitted.toScene({}).z, 0.05); // meters
    EXPECT_EQ(rig.state.seen_frame, rig.settings.frame);                        // the camera stays
    // Toward the hand, it never gets into contact.
    rig.settings.fit->fitted.place.z -= 200.0;
    for (int i = 0; i < 20'000; ++i) {
        ASSERT_FALSE(rig.at({}).contact.is_in_contact);
    }
    // In contact it rests.
    rig.to({0.0, 0.0, -0.03});
    const WorkspaceFrame touched = rig.state.frame;
    ASSERT_TRUE(rig.at({0.0, 0.0, -0.03}).contact.is_in_contact);
    rig.settings.fit->fitted.place.z += 400.0;
    for (int i = 0; i < 1000; ++i) {
        rig.at({0.0, 0.0, -0.03});
    }
    EXPECT_EQ(rig.state.frame, touched);
}

TEST(HapticTick, SwitchesTheForceOffForEveryReason)
{
    const auto reasonAfter = [](auto&& spoil) {
        Rig rig;
        rig.at({});
        EXPECT_GT(rig.to({0.0, 0.0, -0.025}).force_n.z, 1.9);
        spoil(rig);
        StepResult result;
        for (int i = 0; i < 10; ++i) {
            rig.input.settings = &rig.settings;
            rig.input.now += 1ms;
            result = step(rig.options, rig.input, rig.state, kDt);
        }
        EXPECT_EQ(result.force_n, Vec3{});
        return result.reason;
    };
    EXPECT_EQ(reasonAfter([](Rig& r) { r.settings.is_stopped = true; }),
              ForceOffReason::EmergencyStop);
    EXPECT_EQ(reasonAfter([](Rig& r) { r.input.status = DeviceStatus::Lost; }),
              ForceOffReason::DeviceLost);
    EXPECT_EQ(reasonAfter([](Rig& r) { r.input.status = DeviceStatus::Unready; }),
              ForceOffReason::DeviceUnready);
    EXPECT_EQ(reasonAfter([](Rig& r) { r.input.status = DeviceStatus::Finished; }),
              ForceOffReason::DeviceFinished);
    EXPECT_EQ(reasonAfter([](Rig& r) { r.input.now += 16ms; }), ForceOffReason::DeviceStale);
    EXPECT_EQ(reasonAfter([](Rig& r) { r.input.sample.time += 1h; }), ForceOffReason::DeviceStale);
    const auto fresh = [](Rig& r) { r.input.sample.time = r.input.now + 10ms; };
    EXPECT_EQ(reasonAfter([&](Rig& r) {
                  fresh(r);
                  r.input.sample.position.y = kNan;
              }),
              ForceOffReason::DeviceImplausible);
    EXPECT_EQ(reasonAfter([&](Rig& r) {
                  fresh(r);
                  r.input.sample.position.x = 25.0; // millimeters
              }),
              ForceOffReason::DeviceImplausible);
    EXPECT_EQ(reasonAfter([&](Rig& r) {
                  fresh(r);
                  r.input.sample.is_held = false;
              }),
              ForceOffReason::NotHeld);
    EXPECT_EQ(reasonAfter([&](Rig& r) {
                  fresh(r);
                  r.input.has_missed_deadline = true;
              }),
              ForceOffReason::MissedDeadline);
    EXPECT_EQ(reasonAfter([&](Rig& r) {
                  fresh(r);
                  r.settings.map = nullptr;
              }),
              ForceOffReason::NoTouch);
}

// The number of ticks with force out of 2000; `is_late` selects the late ones.
template <typename F>
int ticksWithForce(const F& is_late)
{
    Rig rig;
    rig.at({});
    const WorkspacePoint pressed{0.0, 0.0, -0.025};
    rig.to(pressed);
    int held = 0;
    for (int i = 0; i < 2000; ++i) {
        rig.input.has_missed_deadline = is_late(i);
        const StepResult result = rig.at(pressed);
        const bool is_held = result.reason == ForceOffReason::None;
        EXPECT_TRUE(is_held || result.reason == ForceOffReason::MissedDeadline) << "tick " << i;
        held += is_held ? 1 : 0;
    }
    return held;
}

TEST(HapticTick, SwitchesTheForceOffIfTooManyDeadlinesAreMissed)
{
    EXPECT_EQ(ticksWithForce([](int) { return false; }), 2000);
    EXPECT_EQ(ticksWithForce([](int i) { return i == 700; }), 2000) << "a single one";
    EXPECT_EQ(ticksWithForce([](int i) { return i % 100 < 5; }), 2000) << "five in a row";
    EXPECT_EQ(ticksWithForce([](int i) { return i % 5 == 0; }), 2000) << "one in five";
    EXPECT_EQ(ticksWithForce([](int) { return true; }), 5) << "all";
    // Five in six: never six in a row, yet the force goes off permanently. In quarters of a miss:
    // 20 after five ticks, then 19, 23, and at the eighth tick 27, which is more than six misses.
    EXPECT_EQ(ticksWithForce([](int i) { return i % 6 != 5; }), 7);
    // One in two adds 3/4 of a miss every two ticks: at the 15th tick the sum is six.
    EXPECT_EQ(ticksWithForce([](int i) { return i % 2 == 0; }), 14);
    EXPECT_LT(ticksWithForce([](int i) { return i % 4 == 0; }), 400) << "one in four";
    // Later the force stays on, after the 24 ticks that six misses cost.
    EXPECT_EQ(ticksWithForce([](int i) { return i < 6; }), 2000 - 24);
}

TEST(HapticTick, APauseBetweenWritesSwitchesTheForceOffAndRampsInAgain)
{
    Rig rig;
    rig.options.limits.ramp_s = 0.1;
    rig.at({});
    const WorkspacePoint pressed{0.0, 0.0, -0.025};
    rig.to(pressed);
    for (int i = 0; i < 100; ++i) {
        rig.at(pressed);
    }
    ASSERT_NEAR(rig.at(pressed).force_n.z, 2.0, 1e-9);
    rig.input.since_write_s = kSafetyStepMaxS; // late; a single one does not count
    rig.input.has_missed_deadline = true;
    EXPECT_NEAR(rig.at(pressed).force_n.z, 2.0, 1e-9);
    rig.input.since_write_s = 0.0101;
    EXPECT_EQ(rig.at(pressed).reason, ForceOffReason::MissedDeadline);
    rig.input.has_missed_deadline = false;
    rig.input.since_write_s = kDt;
    int ticks = 1;
    for (; rig.at(pressed).reason == ForceOffReason::MissedDeadline; ++ticks) {
        ASSERT_LT(ticks, 100);
        EXPECT_EQ(rig.state.safety.force_n, Vec3{});
    }
    EXPECT_EQ(ticks, 24);
    for (int i = 2; i <= 100; ++i) {
        EXPECT_NEAR(rig.at(pressed).force_n.z, 0.02 * i, 1e-9); // a hundredth of the ramp each
    }
}

TEST(HapticTick, TheLimiterCountsTheTimeSinceTheLastWrite)
{
    Rig rig;
    rig.options.limits.rate_n_per_s_max = 500.0;
    rig.at({});
    rig.to({0.0, 0.0, -0.0215});
    const double before_n = rig.state.safety.force_n.z;
    // The sample is 1 ms newer than the previous one, but the last write was 20 us ago.
    rig.input.since_write_s = 20e-6;
    EXPECT_NEAR(rig.at({0.0, 0.0, -0.0255}).force_n.z, before_n + 500.0 * 20e-6, 1e-9);
}

TEST(HapticTick, StretchedGroundRampsIn)
{
    // A peak in the middle. With five times the height, it rises 40 mm above the device.
    const auto peak = [](std::size_t column, std::size_t row) {
        return std::max(0.0, 10.0 - 0.1 * std::hypot(static_cast<double>(column) - 100.0,
                                                     static_cast<double>(row) - 100.0));
    };
    const auto filled = filledTerrain(201, 201, peak);
    const auto stretched = [&](double exaggeration) {
        const GoalFrame plain = meterFrame(201, 201);
        return makeServoMap(
            GoalFrame(std::make_shared<const Georeference>(plain.georeference()), exaggeration),
            filled, {.map_id = 1});
    };
    const auto afterwards = [&](auto&& change) {
        Rig rig(stretched(1.0));
        rig.options.limits.change_ramp_s = 0.15;
        rig.at({});
        rig.to({0.0, 0.0, -0.021});
        EXPECT_NEAR(rig.state.safety.force_n.z, 0.4, 0.01);
        change(rig);
        std::vector<StepResult> results;
        for (int i = 0; i < 160; ++i) {
            results.push_back(rig.at({0.0, 0.0, -0.021}));
        }
        EXPECT_EQ(results.back().reason, ForceOffReason::None);
        return results;
    };
    const auto high = afterwards([&](Rig& rig) { rig.settings.map = stretched(5.0); });
    EXPECT_TRUE(high[0].has_changed_map);
    EXPECT_NEAR(length(high.back().force_n), 3.3, 1e-6) << "finally the peak force";
    for (std::size_t i = 0; i < 149; ++i) {
        const double ramp = static_cast<double>(i + 1) / 150.0;
        EXPECT_LE(length(high[i].force_n), 3.3 * ramp + 1e-6) << i;
    }
    // The device does not move; the surface shrinks away from below it, or rises.
    const auto swollen = afterwards([&](Rig& rig) {
        const WorkspaceFrame& now = rig.state.frame;
        const double factor = 0.25; // 1 mm deep to 4 mm
        rig.settings.frame = now.zoomed(rig.state.hand, 1.0 / factor);
        ++rig.settings.frame_number;
    });
    EXPECT_TRUE(swollen[0].has_changed_map);
    EXPECT_LE(swollen[0].force_n.z, 0.02);
    // Another model of the same surface needs no ramp.
    const auto same = afterwards([&](Rig& rig) { rig.settings.map = stretched(1.0); });
    EXPECT_FALSE(same[0].has_changed_map);
    EXPECT_NEAR(same[0].force_n.z, 0.4, 0.01);
}

TEST(HapticTick, AcceptsAnySampleTimes)
{
    using Time = std::chrono::steady_clock::time_point;
    for (const Time time : {Time::min(), Time::max(), Time(-1ns)}) {
        Rig rig;
        rig.at({});
        rig.input.now = Time(1h);
        rig.input.sample.time = time;
        EXPECT_EQ(step(rig.options, rig.input, rig.state, kDt).reason, ForceOffReason::DeviceStale);
    }
}

TEST(HapticTick, SwitchesTheForceOffIfTheTerrainStopsArriving)
{
    const TiledMap tiles =
        tiledMap(floatTerrain(201, 201, [](std::size_t, std::size_t) { return 10.0; }));
    const auto exchange = std::make_shared<ClipmapExchange>(
        std::make_shared<const Clipmap>(tiles.window({100.0, 100.0})));
    Rig rig(makeServoMap(meterFrame(201, 201),
                         std::make_shared<ServoTerrain>(exchange, tiles.heights), {}));
    const auto feed = [&] { exchange->fed_ns = rig.input.now.time_since_epoch() / 1ns; };
    rig.at({});
    const WorkspacePoint pressed{0.0, 0.0, -0.025};
    EXPECT_NEAR(rig.to(pressed).force_n.z, 2.0, 1e-9) << "no timeout before the start";
    feed();
    for (int i = 1; i <= 500; ++i) {
        ASSERT_EQ(rig.at(pressed).reason, ForceOffReason::None) << i << " ms";
    }
    rig.at(pressed);
    for (int i = 0; i < 100; ++i) {
        const StepResult result = rig.at(pressed);
        ASSERT_EQ(result.reason, ForceOffReason::TerrainStale);
        ASSERT_EQ(result.force_n, Vec3{});
    }
    feed();
    EXPECT_EQ(rig.at(pressed).reason, ForceOffReason::None);
    EXPECT_NEAR(rig.at(pressed).force_n.z, 2.0, 1e-9);
}

// The streamer is told where the proxy was in the last tick, and how fast it moves: 0.05 m/s to the
// right are 50 columns of a meter, 0.1 m/s towards the user 100 rows.
TEST(HapticTick, TellsTheStreamerHowTheProxyMoves)
{
    const TiledMap tiles =
        tiledMap(floatTerrain(201, 201, [](std::size_t, std::size_t) { return 10.0; }));
    const auto exchange = std::make_shared<ClipmapExchange>(
        std::make_shared<const Clipmap>(tiles.window({100.0, 100.0})));
    Rig rig(makeServoMap(meterFrame(201, 201),
                         std::make_shared<ServoTerrain>(exchange, tiles.heights), {}));
    rig.at({});
    HandMotion motion = exchange->motion.read();
    EXPECT_EQ(motion.columns_per_s, 0.0) << "nothing was touched before";
    EXPECT_EQ(motion.rows_per_s, 0.0);
    for (int i = 1; i <= 3; ++i) {
        rig.at({5e-5 * i, -1e-4 * i, 0.0});
    }
    motion = exchange->motion.read();
    EXPECT_NEAR(motion.at.column, 100.0 + 0.05 * 2.0, 1e-9);
    EXPECT_NEAR(motion.at.row, 100.0 + 0.1 * 2.0, 1e-9);
    EXPECT_NEAR(motion.columns_per_s, 50.0, 1e-6);
    EXPECT_NEAR(motion.rows_per_s, 100.0, 1e-6);
    EXPECT_EQ(motion.time_ns, rig.input.now.time_since_epoch() / 1ns);
    EXPECT_TRUE(motion.is_active);
    rig.at({5e-5 * 4, -1e-4 * 4, 0.0}, 0.0);
    EXPECT_EQ(exchange->motion.read().columns_per_s, 0.0) << "no time has passed";
}

// At 400 N/m, 20 N/s are 50 mm/s of the workspace and 50 m/s of the scene. Samples between those of
// the coarser level are half a meter higher. At twice the height the terrain rises half as fast.
TEST(HapticTick, TerrainThatArrivesChangesTheForceSlowly)
{
    for (const double exaggeration : {1.0, 2.0}) {
        const TiledMap tiles =
            tiledMap(floatTerrain(301, 301, [](std::size_t column, std::size_t row) {
                return column % 2 == 1 && row % 2 == 1 ? 10.5 : 10.0;
            }));
        const auto exchange = std::make_shared<ClipmapExchange>(
            std::make_shared<const Clipmap>(tiles.window({150.0, 150.0})));
        const auto terrain = std::make_shared<ServoTerrain>(exchange, tiles.heights);
        const GoalFrame frame(
            std::make_shared<const Georeference>(meterFrame(301, 301).georeference()),
            exaggeration);
        Rig rig(makeServoMap(frame, terrain, {}));
        rig.at({});
        const auto height_m = [&] { return terrain->terrain()->sample(151, 151); };
        EXPECT_EQ(height_m(), 10.0);
        auto next = std::make_shared<Clipmap>(tiles.window({150.0, 150.0}));
        next->put(tiles.tile(samplesTile(0, 0, 0)), 0.5);
        exchange->windows.back() = next;
        exchange->windows.publish();
        const double rise_m = 0.05 / exaggeration;
        for (int i = 1; i <= 22; ++i) {
            rig.at({});
            EXPECT_NEAR(height_m(), 10.0 + std::min(rise_m * i, 0.5), rise_m + 1e-4) << i;
            EXPECT_LE(height_m(), 10.0 + rise_m * i + 1e-9) << i;
        }
        EXPECT_EQ(height_m(), 10.5);
    }
}

TEST(HapticTick, KeepsToTheContinuousForceOfTheDevice)
{
    DeviceCapabilities device = desktopDevice();
    EXPECT_EQ(tickOptionsFor(device).limits.force_n_continuous, 3.3) << "not stated";
    device.force_n_continuous = 0.9;
    Rig rig;
    rig.options.limits.force_n_continuous = tickOptionsFor(device).limits.force_n_continuous;
    rig.at({});
    EXPECT_NEAR(rig.to({0.0, 0.0, -0.025}).force_n.z, 2.0, 1e-9);
    StepResult result;
    for (int i = 0; i < 40'000; ++i) {
        result = rig.at({0.0, 0.0, -0.025});
    }
    EXPECT_NEAR(result.force_n.z, 0.9, 1e-3);
    EXPECT_EQ(result.reason, ForceOffReason::None);
}

TEST(HapticTick, AJumpOfTheDeviceSwitchesTheForceOffAndContinuesFromThere)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.025});
    EXPECT_EQ(rig.at({0.07, 0.0, -0.025}).reason, ForceOffReason::DeviceImplausible);
    EXPECT_EQ(rig.at({0.07, 0.0, -0.025}).reason, ForceOffReason::None);
}

// At less than 5 m/s, with 10 mm to spare: 15 mm in a millisecond, 30 mm in four.
TEST(HapticTick, AHandIsNoFasterThanFiveMetersPerSecond)
{
    for (const auto& [dt_s, shift_m] :
         {std::pair(0.001, 0.015), std::pair(0.004, 0.03), std::pair(0.0, 0.01)}) {
        for (const double share : {0.99, 1.01}) {
            Rig rig;
            rig.at({});
            EXPECT_EQ(rig.at({0.0, shift_m * share, 0.0}, dt_s).reason,
                      share < 1.0 ? ForceOffReason::None : ForceOffReason::DeviceImplausible)
                << dt_s << " s";
        }
    }
}

// Beyond the workspace by its own width, here 0.16, 0.12 and 0.12 m, or by 0.25 m if that is more.
TEST(HapticTick, APositionFarOutsideTheWorkspaceIsImplausibleOnEachAxis)
{
    for (const Vec3& axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
        for (const double side : {1.0, -1.0}) {
            Rig rig;
            const auto reason_at = [&](double beyond_m) {
                const Vec3& high = {0.08, 0.06, 0.06};
                rig.state.has_hand = false; // no jump
                return rig.at(WorkspacePoint{} + axis * (side * (dot(axis, high) + beyond_m)))
                    .reason;
            };
            EXPECT_EQ(reason_at(0.249), ForceOffReason::None);
            EXPECT_EQ(reason_at(0.251), ForceOffReason::DeviceImplausible);
        }
    }
    Rig wide;
    wide.device.workspace = {{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}};
    EXPECT_EQ(wide.at({0.599, 0.0, 0.0}).reason, ForceOffReason::None);
    wide.state.has_hand = false;
    EXPECT_EQ(wide.at({0.601, 0.0, 0.0}).reason, ForceOffReason::DeviceImplausible);
}

TEST(HapticTick, AMapThatJumpsPutsTheProxyStraightAboveTheHand)
{
    // A ridge between the two points, higher than the device: a proxy that slid over would be
    // stopped by it.
    const auto ridge = [](std::size_t column, std::size_t) {
        return column > 60 && column < 80 ? 500.0 : 10.0;
    };
    Rig rig(servoMap(201, 201, ridge));
    rig.at({});
    EXPECT_TRUE(rig.to({0.0, 0.0, -0.025}).contact.is_in_contact);
    rig.settings.frame = rig.settings.frame.panned({0.08, 0.0, 0.0}); // now over column 20
    rig.settings.frame_number = 2;
    const StepResult result = rig.at({0.0, 0.0, -0.025});
    EXPECT_TRUE(result.has_changed_map);
    EXPECT_NEAR(result.proxy.x, 20.0, 1e-6);
    EXPECT_NEAR(result.proxy.z, 10.0, 1e-6);
    EXPECT_EQ(result.goals.count, 3U);
}

TEST(HapticTick, AMapThatJumpsAsItsModelChangesPutsTheProxyStraightAboveTheHand)
{
    // As above; in one tick, as if the loop had not seen the settings in between.
    const auto ridge = [](std::size_t column, std::size_t) {
        return column > 60 && column < 80 ? 500.0 : 10.0;
    };
    const auto filled = filledTerrain(201, 201, ridge);
    const auto made = [&] { return makeServoMap(meterFrame(201, 201), filled, {}); };
    Rig rig(made());
    rig.at({});
    EXPECT_TRUE(rig.to({0.0, 0.0, -0.025}).contact.is_in_contact);
    rig.settings.map = made();
    rig.settings.frame = rig.settings.frame.panned({0.08, 0.0, 0.0}); // now over column 20
    rig.settings.frame_number = 2;
    const StepResult result = rig.at({0.0, 0.0, -0.025});
    EXPECT_TRUE(result.has_changed_map);
    EXPECT_NEAR(result.proxy.x, 20.0, 1e-6);
    EXPECT_NEAR(result.proxy.z, 10.0, 1e-6);
}

TEST(HapticTick, AnotherModelOfTheSameMapGoesOnWhereTheLastOneWas)
{
    const auto bumps = [](std::size_t column, std::size_t row) {
        return 10.0 + 3.0 * std::sin(0.3 * static_cast<double>(column)) +
               2.0 * std::cos(0.2 * static_cast<double>(row));
    };
    const auto filled = filledTerrain(201, 201, bumps);
    const auto made = [&](ContactModelKind kind) {
        return makeServoMap(meterFrame(201, 201), filled, {.kind = kind});
    };
    Rig rig(made(ContactModelKind::ContinuousWalk));
    rig.at({});
    const StepResult before = rig.to({0.01, 0.02, -0.024});
    ASSERT_TRUE(before.contact.is_in_contact);
    for (const ContactModelKind kind :
         {ContactModelKind::SurfaceWalk, ContactModelKind::ProxyGraph,
          ContactModelKind::GodObjectRelease, ContactModelKind::ContinuousWalk}) {
        rig.settings.map = made(kind);
        const StepResult after = rig.at({0.01, 0.02, -0.024});
        EXPECT_FALSE(after.has_changed_map);
        EXPECT_NEAR(after.proxy.x, before.proxy.x, 1e-3);
        EXPECT_NEAR(after.proxy.y, before.proxy.y, 1e-3);
        EXPECT_NEAR(length(after.force_n - before.force_n), 0.0, 1e-3);
    }
}

TEST(HapticTick, PansAndZoomsByTheButton)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.022});
    rig.input.sample.buttons = 1;
    EXPECT_EQ(rig.at({0.0, 0.0, -0.022}).mode, StylusMode::Pan);
    const ScenePoint before = rig.state.frame.place;
    rig.to({0.03, 0.0, -0.022});
    EXPECT_LT(rig.state.frame.place.x, before.x - 10.0); // pulled to the right
    rig.input.sample.buttons = 0;
    EXPECT_EQ(rig.at({0.03, 0.0, -0.022}).mode, StylusMode::Press);
    rig.to({0.03, 0.0, 0.01});
    rig.to({0.03, 0.0, 0.011});
    EXPECT_EQ(rig.at({0.03, 0.0, 0.011}).mode, StylusMode::Hover);
    rig.settings.is_grabbing = true; // the key has the same effect
    EXPECT_EQ(rig.at({0.03, 0.0, 0.011}).mode, StylusMode::Zoom);
    rig.to({0.03, 0.0, 0.041});
    EXPECT_NEAR(rig.state.frame.scene_per_meter, 500.0, 1e-6);
}

// From 3.1 to -3.1 radians a stylus turns on, by what is missing from a whole turn.
TEST(HapticTick, AStylusTurnsOnOverHalfATurn)
{
    Rig rig;
    rig.settings.is_grabbing = true;
    rig.input.sample.twist_rad = 3.1;
    EXPECT_EQ(rig.at({}).mode, StylusMode::Zoom);
    const WorkspaceFrame before = rig.state.frame;
    rig.input.sample.twist_rad = -3.1;
    rig.at({});
    // Counterclockwise in the workspace, so the workspace turns clockwise in the scene.
    EXPECT_NEAR((rig.state.frame.turn + -before.turn).radians(), 6.2 - 2.0 * std::numbers::pi,
                1e-12);
}

TEST(HapticTick, TheFirstButtonSetsPointsForATool)
{
    Rig rig;
    rig.settings.is_placing = true;
    rig.at({});
    rig.to({0.0, 0.0, -0.022});
    rig.input.sample.buttons = 0b01;
    StepResult result = rig.at({0.0, 0.0, -0.022});
    EXPECT_TRUE(result.has_pressed_point);
    EXPECT_EQ(result.mode, StylusMode::Press) << "the map is not grabbed";
    EXPECT_GT(result.force_n.z, 0.0) << "the surface is still felt";
    result = rig.at({0.0, 0.0, -0.022});
    EXPECT_FALSE(result.has_pressed_point) << "once a press";
    EXPECT_FALSE(result.has_released_point);
    rig.settings.is_placing = false; // another tool, with the button still pressed
    result = rig.at({0.0, 0.0, -0.022});
    EXPECT_EQ(result.mode, StylusMode::Press);
    rig.input.sample.buttons = 0;
    result = rig.at({0.0, 0.0, -0.022});
    EXPECT_TRUE(result.has_released_point);
    rig.input.sample.buttons = 0b01;
    result = rig.at({0.0, 0.0, -0.022});
    EXPECT_EQ(result.mode, StylusMode::Pan);
    EXPECT_FALSE(result.has_pressed_point);
    rig.settings.is_placing = true; // what has grabbed sets no point
    result = rig.at({0.0, 0.0, -0.022});
    EXPECT_EQ(result.mode, StylusMode::Pan);
    EXPECT_FALSE(result.has_pressed_point);
    rig.input.sample.buttons = 0;
    EXPECT_FALSE(rig.at({0.0, 0.0, -0.022}).has_released_point);
    rig.input.sample.buttons = 0b10;
    EXPECT_EQ(rig.at({0.0, 0.0, -0.022}).mode, StylusMode::Pan) << "the second one grabs";
}

TEST(HapticTick, StiffnessIsLimitedByTheDeviceAndTheLoop)
{
    const DeviceCapabilities device = desktopDevice(); // 600 N/m
    EXPECT_EQ(usedStiffness(400.0, device, 1e-3, 1e-3), 400.0);
    EXPECT_EQ(usedStiffness(900.0, device, 1e-3, 1e-3), 600.0);
    EXPECT_NEAR(usedStiffness(900.0, device, 1e-3, 2e-3), 300.0, 1e-9); // half the rate
    EXPECT_EQ(usedStiffness(900.0, device, 1e-3, 0.5e-3), 600.0);
    EXPECT_EQ(usedStiffness(-1.0, device, 1e-3, 1e-3), 0.0);
    DeviceCapabilities silent = device; // the effective stiffness
    silent.stiffness_n_per_m_max = 0.0;
    EXPECT_EQ(usedStiffness(1e5, silent, 1e-3, 1e-3), kStiffnessUnstatedNPerM);
    EXPECT_EQ(usedStiffness(1e5, silent, 1e-3, 2e-3), 0.5 * kStiffnessUnstatedNPerM);
    silent.force_n_peak = 0.5;
    EXPECT_EQ(usedStiffness(1e5, silent, 1e-3, 1e-3), kStiffnessUnstatedNPerM);
    silent.force_n_peak = 0.0;
    EXPECT_EQ(usedStiffness(1e5, silent, 1e-3, 1e-3), 1e5) << "it cannot push";
    EXPECT_EQ(usedStiffness(std::nan(""), device, 1e-3, 1e-3), 0.0);
}

// The mean of about 50 ticks: p' = p + 0.02 (dt - p). From 1 ms on, after n ticks of 2 ms it is
// 2 ms - 0.98^n ms.
TEST(HapticTick, ASlowLoopLearnsItsPeriodAndSoftensTheSurface)
{
    Rig rig;
    rig.settings.stiffness_n_per_m = 900.0;
    EXPECT_EQ(rig.at({}, 0.5e-3).stiffness_n_per_m, 600.0);
    EXPECT_EQ(rig.state.period_s, 1e-3) << "at least the device's";
    for (int n = 1; n <= 100; ++n) {
        const double period_ms = 2.0 - std::pow(0.98, n);
        ASSERT_NEAR(rig.at({}, 2e-3).stiffness_n_per_m, 600.0 / period_ms, 1e-9) << n;
    }
    const double learned_s = rig.state.period_s;
    rig.at({}, 0.0);
    EXPECT_EQ(rig.state.period_s, learned_s) << "nothing is learned from no time";
    Rig slow; // from the first tick on
    slow.settings.stiffness_n_per_m = 900.0;
    EXPECT_NEAR(slow.at({}, 4e-3).stiffness_n_per_m, 600.0 / 4.0, 1e-9);
    DeviceCapabilities device = desktopDevice();
    device.rate_hz = 500.0;
    EXPECT_EQ(tickOptionsFor(device).period_s, 2e-3);
    device.rate_hz = 0.0; // unstated
    EXPECT_EQ(tickOptionsFor(device).period_s, 1e-3);
}

TEST(HapticTick, TheShareOfTheForceIsBetweenNoneAndAll)
{
    for (const auto& [share, force_n] :
         {std::pair(0.5, 1.0), std::pair(1.0, 2.0), std::pair(3.0, 2.0), std::pair(-1.0, 0.0)}) {
        Rig rig;
        rig.settings.force_share = share;
        rig.at({});
        EXPECT_NEAR(rig.to({0.0, 0.0, -0.025}).force_n.z, force_n, 1e-9) << share;
    }
}

// The naive sum of section 4.2 of the paper: beside a wall the surface pushes as elsewhere.
TEST(HapticTick, TheNaiveSumDoesNotFade)
{
    Rig rig;
    rig.options.mixing = ForceMixing::NaiveSum;
    rig.at({});
    EXPECT_NEAR(rig.to({0.0, 0.0, -0.025}).force_n.z, 2.0, 1e-9);
    const StepResult beyond = rig.to({0.082, 0.0, -0.025});
    EXPECT_NEAR(beyond.force_n.z, 2.0, 1e-9);
    EXPECT_NEAR(beyond.force_n.x, -0.8, 1e-9);
}

// A surplus of energy is damped along the motion: F - b v. What the surface's spring holds, F²/2k,
// counts as energy that it may return.
TEST(HapticTick, DampsASurplusOfEnergyAndLetsSpringsReturnTheirs)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.025}); // 5 mm deep
    rig.options.is_passivity_kept = true;
    rig.state.passivity = {.energy_j = -1e-3, .velocity_m_per_s = {0.0, 0.0, 0.1}};
    const StepResult damped = rig.at({0.0, 0.0, -0.0249});
    EXPECT_GT(damped.damping_n_s_per_m, 0.0);
    EXPECT_NEAR(damped.force_n.z,
                400.0 * 4.9e-3 - damped.damping_n_s_per_m * rig.state.passivity.velocity_m_per_s.z,
                1e-9);
    rig.state.passivity.energy_j = 1.0;
    rig.at({0.0, 0.0, -0.025});
    EXPECT_NEAR(rig.state.passivity.energy_j,
                rig.options.passivity.energy_j_max + 0.5 * 2.0 * 2.0 / 400.0, 1e-12);
}

// The hand has the energy of the spring to give back, and that of the map that it has set in
// motion.
TEST(HapticTick, AMovingMapHoldsKineticEnergy)
{
    Rig rig;
    rig.at({});
    rig.to({0.0, 0.0, -0.022});
    rig.settings.is_grabbing = true;
    rig.to({0.01, 0.0, -0.022}); // at 0.1 m/s
    rig.options.is_passivity_kept = true;
    rig.state.passivity.energy_j = 1.0;
    const double force_n = length(rig.at({0.0101, 0.0, -0.022}).force_n);
    const double map_m_per_s = length(rig.state.modes.pan.velocity_m_per_s);
    EXPECT_GT(map_m_per_s, 0.05);
    EXPECT_NEAR(rig.state.passivity.energy_j,
                rig.options.passivity.energy_j_max + 0.5 * force_n * force_n / 400.0 +
                    0.5 * rig.settings.modes.pan.mass_kg * map_m_per_s * map_m_per_s,
                1e-12);
}

// The hand is 20 mm from the map's edge, which glides towards it at 0.3 m/s.
TEST(HapticTick, AGlidingMapStopsWhereItsEdgeReachesTheHand)
{
    Rig rig;
    rig.at({});
    rig.to({-0.05, 0.0, 0.0});
    rig.settings.frame.place.x -= 30.0; // the edge, 100 m west of the middle, is now at -70 mm
    ++rig.settings.frame_number;
    rig.to({-0.05, 0.0, 0.0});
    rig.state.modes.pan.velocity_m_per_s = {0.3, 0.0, 0.0};
    rig.at({-0.05, 0.0, 0.0});
    EXPECT_GT(rig.state.modes.pan.velocity_m_per_s.x, 0.29);
    StepResult result;
    for (int i = 0; i < 200; ++i) {
        result = rig.at({-0.05, 0.0, 0.0});
        EXPECT_FALSE(result.is_at_edge);
    }
    EXPECT_NEAR(rig.state.frame.toScene({-0.05, 0.0, 0.0}).x, -100.0, 1e-9);
    EXPECT_EQ(rig.state.modes.pan.velocity_m_per_s, Vec3{});
}

// A map glides by its speed, which drag reduces, times the time of the tick. That is at most 10 ms,
// and nothing if the clock is broken.
TEST(HapticTick, AfterAPauseAMapGlidesOnFromWhereItWas)
{
    for (const auto& [dt_s, glides_s] :
         {std::pair(0.004, 0.004), std::pair(0.01, 0.01), std::pair(0.015, 0.01),
          std::pair(1e9, 0.01), std::pair(-1.0, 0.0), std::pair(kNan, 0.0),
          std::pair(std::numeric_limits<double>::infinity(), 0.0)}) {
        Rig rig;
        rig.at({});
        const double before_m = rig.state.frame.toScene({}).x;
        rig.state.modes.pan.velocity_m_per_s = {0.3, 0.0, 0.0};
        rig.at({}, dt_s);
        const double speed = 0.3 / (1.0 + rig.settings.modes.pan.drag_per_s * glides_s);
        EXPECT_NEAR(rig.state.frame.toScene({}).x - before_m, -1000.0 * speed * glides_s, 1e-9)
            << dt_s;
    }
}

TEST(HapticTick, AModelThatIsGivenTheGoalsAgainGivesTheSameProxiesToTheBit)
{
    Random random;
    const auto heights = heightsFrom(fractalHeights(random, 201, 201, 20.0, 0.6), 201);
    for (const ContactModelKind kind : kContactModelKinds) {
        Rig rig(servoMap(201, 201, heights, {.kind = kind, .contact = {.radius_m = 0.5}}));
        rig.settings.frame.place.z = 0.0;
        const auto again =
            servoMap(201, 201, heights, {.kind = kind, .contact = {.radius_m = 0.5}});
        WorkspacePoint hand{};
        Vec3 velocity{};
        for (int i = 0; i < 4000; ++i) {
            velocity = velocity * 0.98 +
                       Vec3{random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4),
                            random.uniform(-1e-4, 1e-4)} -
                       (hand - WorkspacePoint{}) * 1e-3;
            hand = hand + velocity;
            if (i % 1000 == 999) { // the map jumps
                rig.settings.frame = rig.state.frame.panned({0.02, -0.01, 0.0});
                ++rig.settings.frame_number;
            }
            rig.input.sample.buttons = i % 700 > 600 ? 1 : 0;
            const StepResult result = rig.at(hand);
            for (std::size_t g = 0; g < result.goals.count; ++g) {
                again->model->update(again->frame.toScene(result.goals.goals[g]));
            }
            // While the hand holds the map, the proxy is the held point.
            if (result.goals.count > 0) {
                ASSERT_EQ(again->model->state().proxy, result.contact.proxy)
                    << contactModelName(kind) << " tick " << i;
            }
        }
    }
}

// Invariants of the loop under any external changes.
TEST(HapticTick, WhatARecordingAimsAtDoesNotDependOnWhatIsSeen)
{
    const auto bumps = [](std::size_t column, std::size_t row) {
        return 3.0 * std::sin(0.3 * static_cast<double>(column)) +
               2.0 * std::cos(0.2 * static_cast<double>(row));
    };
    Rig rig(servoMap(201, 201, bumps));
    const auto again = servoMap(201, 201, bumps);
    Random random;
    RecordedTick tick{.goal = {100.0, -100.0, -1.0}};
    TracePoint& goal = tick.goal;
    rig.input.recorded = &tick;
    for (int i = 0; i < 2000; ++i) {
        goal.x = std::clamp(goal.x + random.uniform(-2.0, 2.0), 10.0, 190.0);
        goal.y = std::clamp(goal.y + random.uniform(-2.0, 2.0), -190.0, -10.0);
        if (random.chance(0.05)) { // the camera jumps
            rig.settings.frame.place = {random.uniform(-90.0, 90.0), random.uniform(-90.0, 90.0),
                                        random.uniform(-50.0, 50.0)};
            rig.settings.frame.scene_per_meter = random.uniform(100.0, 5000.0);
            ++rig.settings.frame_number;
        }
        const StepResult result = rig.at({});
        const ContactState state = again->model->update(again->frame.toScene(goal));
        ASSERT_EQ(result.goals.count, 1U) << i;
        ASSERT_EQ(result.contact.proxy, state.proxy) << i;
    }
}

TEST(HapticTick, KeepsItsBoundsForAMillionRandomTicks)
{
    Random random;
    const auto heights = heightsFrom(fractalHeights(random, 101, 101, 20.0, 0.7), 101);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto anyNumber = [&random] {
        constexpr std::array kBad{std::numeric_limits<double>::quiet_NaN(),
                                  kInfinity,
                                  -kInfinity,
                                  1e300,
                                  -1e300,
                                  1e-300,
                                  0.0};
        return kBad[random.below(kBad.size())];
    };
    std::vector<std::shared_ptr<ServoMap>> maps{nullptr};
    for (const ContactModelKind kind : kContactModelKinds) {
        maps.push_back(
            servoMap(101, 101, heights, {.kind = kind, .contact = {.radius_m = 0.5}, .map_id = 1}));
        maps.push_back(
            servoMap(101, 101, heights, {.kind = kind, .contact = {.radius_m = 0.5}, .map_id = 2}));
    }
    Rig rig;
    std::uint64_t pushed = 0;
    std::array<std::uint64_t, kForceOffReasonCount> reasons{};
    Vec3 last{};
    WorkspacePoint hand{};
    Vec3 velocity{};
    double wrote_at_s = 0.0; // in real time, where a tick can stall at any point
    double now_s = 0.0;
    constexpr int kTicks = 1'000'000;
    for (int i = 0; i < kTicks; ++i) {
        if (i % 20'000 == 0) {
            rig.device.force_n_peak = random.uniform(0.5, 10.0);
            rig.device.force_n_continuous =
                random.chance(0.5) ? random.uniform(0.1, rig.device.force_n_peak) : 0.0;
            rig.device.stiffness_n_per_m_max = random.uniform(100.0, 2000.0);
            rig.options = tickOptionsFor(rig.device);
            rig.options.is_passivity_kept = random.chance(0.8);
            rig.options.limits.ramp_s = random.uniform(0.0, 0.2);
            rig.state = {};
            last = {};
        }
        if (random.chance(0.001)) {
            rig.settings.map = maps[random.below(maps.size())];
        }
        if (random.chance(0.002)) {
            rig.settings.frame = {.place = {random.uniform(-60.0, 60.0),
                                            random.uniform(-60.0, 60.0),
                                            random.uniform(-20.0, 20.0)},
                                  .scene_per_meter = std::pow(10.0, random.uniform(1.0, 4.0)),
                                  .turn = Angle::radians(random.uniform(-4.0, 4.0))};
            if (random.chance(0.05)) {
                rig.settings.frame.scene_per_meter = anyNumber();
            }
            if (random.chance(0.05)) {
                rig.settings.frame.place.y = anyNumber();
            }
            ++rig.settings.frame_number;
        }
        if (random.chance(0.002)) {
            rig.settings.stiffness_n_per_m =
                random.chance(0.1) ? anyNumber() : random.uniform(0.0, 3000.0);
            rig.settings.force_share = random.chance(0.1) ? anyNumber() : random.unit();
            rig.settings.has_walls = random.chance(0.8);
            rig.settings.is_stopped = random.chance(0.05);
            rig.settings.is_grabbing = random.chance(0.2);
        }
        velocity = velocity * 0.99 +
                   Vec3{random.uniform(-2e-4, 2e-4), random.uniform(-2e-4, 2e-4),
                        random.uniform(-2e-4, 2e-4)} -
                   (hand - WorkspacePoint{}) * 2e-3;
        hand = hand + velocity;
        rig.input.sample.position = hand;
        rig.input.sample.twist_rad = random.chance(0.001) ? anyNumber() : 0.01 * i;
        rig.input.sample.buttons =
            random.chance(0.003) ? 1U - rig.input.sample.buttons : rig.input.sample.buttons & 1U;
        rig.input.sample.is_held = !random.chance(0.001);
        if (random.chance(0.002)) {
            rig.input.sample.position = {anyNumber(), anyNumber(), random.uniform(-5.0, 5.0)};
        }
        rig.input.status =
            random.chance(0.001) ? static_cast<DeviceStatus>(random.below(4)) : DeviceStatus::Fine;
        rig.input.has_missed_deadline = random.chance(i % 50'000 < 100 ? 0.9 : 0.01);
        rig.input.now += 1ms;
        rig.input.sample.time = rig.input.now - (random.chance(0.001) ? 20ms : 1ms);
        rig.input.settings = &rig.settings;
        rig.input.device = &rig.device;
        const double dt_s = random.chance(0.002) ? anyNumber() : random.uniform(0.5e-3, 1.5e-3);
        const auto stall_s = [&random] {
            return random.chance(0.001) ? random.uniform(0.0, 0.5) : random.uniform(0.0, 2e-5);
        };
        // The order: wake-up, sometimes right after a late one; read; compute; write.
        now_s += random.chance(0.01) ? 1e-6 : random.uniform(0.5e-3, 1.5e-3);
        now_s += stall_s();
        const double measured_at_s = now_s;
        rig.input.since_write_s = random.chance(0.001) ? anyNumber() : measured_at_s - wrote_at_s;
        now_s += stall_s();
        if (random.chance(0.0005)) { // simulates memory corruption by a bug elsewhere
            SafetyState& safety = rig.state.safety;
            const std::array fields{&safety.force_n.x, &safety.force_n.z, &safety.gain,
                                    &safety.ramp_s, &safety.heat_n2};
            *fields[random.below(fields.size())] = anyNumber();
            last = isFinite(safety.force_n) ? safety.force_n : Vec3{};
        }

        const StepResult result = step(rig.options, rig.input, rig.state, dt_s);

        const double magnitude_n = length(result.force_n);
        ASSERT_LE(magnitude_n, rig.device.force_n_peak) << "tick " << i; // false for NaN
        const double given_s = *rig.input.since_write_s;
        const bool is_measured = given_s == measured_at_s - wrote_at_s;
        const double step_s = is_measured ? now_s - wrote_at_s
                              : std::isfinite(given_s) && given_s >= 0.0
                                  ? std::min(given_s, kSafetyStepMaxS)
                                  : 1e-3;
        wrote_at_s = now_s;
        const double rate = result.reason == ForceOffReason::None
                                ? rig.options.limits.rate_n_per_s_max
                                : rig.options.limits.release_n_per_s_max;
        if (length(last) <= rig.device.force_n_peak) { // otherwise the magnitude limit comes first
            ASSERT_LE(length(result.force_n - last), rate * step_s + 1e-13) << "tick " << i;
        }
        last = result.force_n;
        pushed += magnitude_n > 0.1 ? 1U : 0U;
        ++reasons[static_cast<std::size_t>(result.reason)];
    }
    std::printf("%llu of %d ticks with force;", static_cast<unsigned long long>(pushed), kTicks);
    for (std::uint8_t i = 0; i < kForceOffReasonCount; ++i) {
        std::printf(" %s %llu", std::string(forceOffReasonName(ForceOffReason{i})).c_str(),
                    static_cast<unsigned long long>(reasons[i]));
    }
    std::printf("\n");
    EXPECT_GT(pushed, 100'000U); // otherwise nothing was tested
}

TEST(HapticTick, AllocatesNothingInAnyModelOrMode)
{
#ifndef MARSVIEW_COUNTS_ALLOCATIONS
    GTEST_SKIP() << "allocations are not counted in this build";
#else
    Random random;
    const auto heights = heightsFrom(fractalHeights(random, 201, 201, 20.0, 0.6), 201);
    { // the counter works
        const std::uint64_t before = RtScope::allocationCount();
        const RtScope scope;
        const std::unique_ptr<int> one(new int(1));
        EXPECT_EQ(RtScope::allocationCount(), before + 1);
    }
    for (const ContactModelKind kind : kContactModelKinds) {
        Rig rig(servoMap(201, 201, heights, {.kind = kind, .contact = {.radius_m = 0.5}}));
        rig.options.is_passivity_kept = true;
        rig.settings.frame.place.z = 0.0;
        const std::uint64_t before = RtScope::allocationCount();
        std::array<int, 4> modes{};
        for (int i = 0; i < 20'000; ++i) {
            const RtScope scope;
            rig.input.sample.buttons = i % 1000 > 800 ? 1 : 0;
            rig.settings.frame_number += i % 5000 == 0 ? 1 : 0;
            rig.settings.is_stopped = i % 3000 == 1500;
            const double t = 1e-3 * i;
            const StepResult result = rig.at(
                {0.07 * std::sin(3.0 * t), 0.06 * std::cos(2.3 * t), 0.03 * std::sin(7.1 * t)});
            ++modes[static_cast<std::size_t>(result.mode)];
        }
        EXPECT_EQ(RtScope::allocationCount(), before) << contactModelName(kind);
        for (const int count : modes) {
            EXPECT_GT(count, 100); // every mode occurred
        }
    }
#endif
}

} // namespace
} // namespace marsview::test
