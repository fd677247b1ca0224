#include "haptics/interaction/hand_modes.h"
#include "tests/haptics/tick_time.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

// A hand that moves by the given steps.
struct Hand {
    ModeOptions options;
    ModeState state;
    ModeInput input{.stiffness_n_per_m = 400.0, .frame = {.scene_per_meter = 1e4}};

    ModeStep move(const Vec3& shift, double twist_rad = 0.0)
    {
        input.hand = input.hand + shift;
        input.hand_shift = shift;
        input.twist_change_rad = twist_rad;
        const ModeStep step = stepModes(options, input, state, kDt);
        input.frame = step.frame;
        return step;
    }
};

TEST(HandModes, AGrabPansInContactAndZoomsInFreeSpace)
{
    Hand hand;
    hand.input.is_in_contact = true;
    EXPECT_FALSE(hand.move({}).has_changed_mode);
    EXPECT_EQ(hand.state.mode, StylusMode::Press);
    hand.input.is_grabbing = true;
    EXPECT_TRUE(hand.move({}).has_changed_mode);
    EXPECT_EQ(hand.state.mode, StylusMode::Pan);
    hand.input.is_in_contact = false; // the pan continues until the grab ends
    EXPECT_FALSE(hand.move({}).has_changed_mode);
    EXPECT_EQ(hand.state.mode, StylusMode::Pan);
    hand.input.is_grabbing = false;
    EXPECT_TRUE(hand.move({}).has_changed_mode);
    EXPECT_EQ(hand.state.mode, StylusMode::Hover);
    hand.input.is_grabbing = true;
    EXPECT_TRUE(hand.move({}).has_changed_mode);
    EXPECT_EQ(hand.state.mode, StylusMode::Zoom);
}

TEST(HandModes, HoveringAndPressingFeelTheSameAndMoveNothing)
{
    Hand hand;
    const WorkspaceFrame frame = hand.input.frame;
    const ModeStep step = hand.move({0.01, 0.0, 0.0});
    EXPECT_EQ(step.force_n, Vec3{});
    EXPECT_EQ(step.frame, frame);
    EXPECT_FALSE(step.has_moved_map);
}

TEST(HandModes, PanningHoldsTheHeightAndMovesTheMap)
{
    Hand hand;
    hand.input.is_in_contact = true;
    hand.input.is_grabbing = true;
    hand.move({});
    const ScenePoint grabbed = hand.input.frame.toScene(hand.input.hand);
    for (int i = 0; i < 500; ++i) { // without knocks, so that the hold does not slip
        const double share = std::sin(3.14159265358979 * i / 500.0);
        hand.move({4e-5 * share, -2e-5 * share, 0.0});
    }
    ModeStep step;
    for (int i = 0; i < 20'000; ++i) {
        step = hand.move({});
    }
    EXPECT_NEAR(length(hand.input.frame.toScene(hand.input.hand) - grabbed), 0.0, 1.0); // of 1e4
    step = hand.move({0.0, 0.0, 0.002});
    EXPECT_NEAR(step.force_n.z, -0.8, 1e-12); // 2 mm of 400 N/m
    EXPECT_NEAR(step.force_n.x, 0.0, 1e-3);
}

// Section 4.2: at the grab the force continues, also that on a hand that strokes. With the map's
// mass m and drag c and the hold's spring k and damper b, the first step keeps the share
// m (1 + c dt) / (m (1 + c dt) + (k dt + b) dt) of the horizontal force, whatever the hand's speed.
TEST(HandModes, TheForceOnAStrokingHandContinuesAtTheGrab)
{
    const PanOptions pan;
    const double mass = pan.mass_kg * (1.0 + pan.drag_per_s * kDt);
    const double share = mass / (mass + (pan.grip_n_per_m * kDt + pan.grip_n_s_per_m) * kDt);
    for (const double speed_m_per_s : {0.0, 0.1, 0.5}) {
        for (const double stiffness : {400.0, 0.5}) {
            Hand hand;
            hand.input.is_in_contact = true;
            hand.input.stiffness_n_per_m = stiffness;
            hand.move({});
            hand.input.is_grabbing = true;
            hand.input.surface_force_n = {0.003, -0.002, 0.004};
            const ModeStep step = hand.move({-speed_m_per_s * kDt, 0.5 * speed_m_per_s * kDt, 0.0});
            // A spring that is as weak as the hand's takes the place of a stiffer hold.
            const double kept =
                stiffness < 1.0 ? mass / (mass + (1.0 * kDt + pan.grip_n_s_per_m) * kDt) : share;
            EXPECT_NEAR(step.force_n.x, 0.003 * kept, 1e-12);
            EXPECT_NEAR(step.force_n.y, -0.002 * kept, 1e-12);
            EXPECT_NEAR(step.force_n.z, 0.004, 1e-12);
        }
    }
}

TEST(HandModes, AGrabInATickWithoutTimeKeepsTheForce)
{
    ModeState state;
    const ModeInput input{.is_grabbing = true,
                          .is_in_contact = true,
                          .stiffness_n_per_m = 400.0,
                          .surface_force_n = {0.003, -0.002, 0.004},
                          .frame = {.scene_per_meter = 1e4}};
    const ModeStep step = stepModes({}, input, state, 0.0);
    EXPECT_EQ(state.mode, StylusMode::Pan);
    EXPECT_NEAR(length(step.force_n - input.surface_force_n), 0.0, 1e-12);
}

TEST(HandModes, WithoutStiffnessAGrabExertsNoVerticalForce)
{
    Hand hand;
    hand.input.is_in_contact = true;
    hand.input.stiffness_n_per_m = 0.0;
    hand.input.is_grabbing = true;
    hand.input.surface_force_n = {0.0, 0.0, 0.5};
    EXPECT_EQ(hand.move({}).force_n.z, 0.0);
    EXPECT_EQ(hand.move({0.0, 0.0, 0.01}).force_n.z, 0.0);
}

// Section 4.2: while the hand zooms, its horizontal position is held.
TEST(HandModes, AZoomPullsBackToWhereItGrabbed)
{
    Hand hand;
    hand.move({0.02, -0.03, 0.01});
    hand.input.is_grabbing = true;
    EXPECT_FALSE(hand.move({}).has_moved_map);
    const ModeStep aside = hand.move({0.001, 0.002, 0.0});
    EXPECT_NEAR(aside.force_n.x, -0.4, 1e-12); // 400 N/m
    EXPECT_NEAR(aside.force_n.y, -0.8, 1e-12);
    EXPECT_FALSE(aside.has_moved_map);
    EXPECT_TRUE(hand.move({}, 0.01).has_moved_map);
    EXPECT_TRUE(hand.move({0.0, 0.0, 0.001}).has_moved_map);
    EXPECT_FALSE(hand.move({}).has_moved_map);
}

// The detents belong to the zoom at which the hand grabs, wherever it has just been.
TEST(HandModes, AGrabOnADetentFeelsNoneThoughTheHandMoves)
{
    Hand hand;
    hand.input.frame.scene_per_meter = 4096.0;
    hand.input.is_grabbing = true;
    const ModeStep step = hand.move({0.0, 0.0, 0.001});
    ASSERT_EQ(hand.state.mode, StylusMode::Zoom);
    EXPECT_NEAR(step.force_n.z, 0.0, 1e-12);
}

TEST(HandModes, TheMapKeepsMovingWhenReleasedInMotion)
{
    Hand hand;
    hand.options.pan.drag_per_s = 0.0;
    hand.input.is_in_contact = true;
    hand.input.is_grabbing = true;
    hand.move({});
    for (int i = 0; i < 5000; ++i) {
        hand.move({1e-4, 0.0, 0.0}); // 0.1 m/s
    }
    hand.input.is_grabbing = false;
    hand.move({});
    const ScenePoint before = hand.input.frame.place;
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(hand.move({}).force_n, Vec3{});
    }
    EXPECT_NEAR((before - hand.input.frame.place).x, 0.1 * 1e4, 1.0);
    hand.input.free_share = 0.0; // a wall
    hand.move({});
    EXPECT_FALSE(hand.move({}).has_moved_map);
}

TEST(HandModes, ZoomingHoldsThePlaceAndZoomsByHeight)
{
    Hand hand;
    hand.input.is_grabbing = true;
    hand.move({});
    const double before = hand.input.frame.scene_per_meter;
    ModeStep step;
    for (int i = 0; i < 300; ++i) {
        step = hand.move({0.0, 0.0, 1e-4}); // 30 mm: one doubling of the scale
    }
    EXPECT_NEAR(hand.input.frame.scene_per_meter, 0.5 * before, 1e-9 * before);
    step = hand.move({0.001, -0.002, 0.0});
    EXPECT_NEAR(step.force_n.x, -0.4, 1e-12);
    EXPECT_NEAR(step.force_n.y, 0.8, 1e-12);
    EXPECT_LE(std::abs(step.force_n.z), 0.25);
}

// Paper, 4.2: the hand grabs empty space "to move the surface towards or away from the camera".
TEST(HandModes, AZoomMovesTheSurfaceWithTheHandFromEveryHeight)
{
    for (const double clearance_m : {0.0, 0.005, 0.02, 0.05, 0.12}) {
        for (const double side : {1.0, -1.0}) {
            Hand hand;
            hand.input.is_grabbing = true;
            hand.move({});
            double ground_m = -clearance_m;
            const double scale = hand.input.frame.scene_per_meter;
            for (int i = 0; i < 360; ++i) {
                const ScenePoint ground = hand.input.frame.toScene({0.0, 0.0, ground_m});
                hand.input.clearance_m = hand.input.hand.z + side * 1e-4 - ground_m;
                hand.move({0.0, 0.0, side * 1e-4});
                const double now_m = hand.input.frame.toWorkspace(ground).z;
                ASSERT_GT((now_m - ground_m) * side, 0.2e-4) << clearance_m;
                ground_m = now_m;
                ASSERT_GE(hand.input.hand.z - ground_m, -1e-12);
            }
            EXPECT_NEAR(hand.input.frame.scene_per_meter, scale * std::exp2(-side * 1.2),
                        1e-9 * scale);
        }
    }
}

TEST(HandModes, AZoomThereAndBackEndsWhereItBegan)
{
    Hand hand;
    hand.input.is_grabbing = true;
    hand.move({});
    double ground_m = -0.05;
    const auto lift = [&](double step_m) {
        const ScenePoint ground = hand.input.frame.toScene({0.0, 0.0, ground_m});
        hand.input.clearance_m = hand.input.hand.z + step_m - ground_m;
        hand.move({0.0, 0.0, step_m});
        ground_m = hand.input.frame.toWorkspace(ground).z;
    };
    for (int i = 0; i < 3000; ++i) {
        lift(1e-5);
    }
    for (int i = 0; i < 3000; ++i) {
        lift(-1e-5);
    }
    EXPECT_NEAR(ground_m, -0.05, 1e-5);
}

TEST(HandModes, TwistingTurnsTheMapAboutTheHand)
{
    Hand hand;
    hand.input.hand = {0.03, 0.01, 0.0};
    hand.input.is_grabbing = true;
    hand.move({});
    const ScenePoint held = hand.input.frame.toScene(hand.input.hand);
    const ScenePoint right = hand.input.frame.toScene(hand.input.hand + Vec3{0.01, 0.0, 0.0});
    for (int i = 0; i < 90; ++i) {
        hand.move({}, 3.14159265358979 / 180.0);
    }
    EXPECT_NEAR(length(hand.input.frame.toScene(hand.input.hand) - held), 0.0, 1e-6);
    const Vec3 now = hand.input.frame.toWorkspace(right) - hand.input.hand;
    EXPECT_NEAR(now.x, 0.0, 1e-9);
    EXPECT_NEAR(now.y, 0.01, 1e-9);
}

TEST(HandModes, ZoomsStayWithinTheirLimits)
{
    Hand hand;
    hand.options.scene_per_meter_min = 2000.0;
    hand.input.is_grabbing = true;
    hand.move({});
    for (int i = 0; i < 2000; ++i) {
        hand.move({0.0, 0.0, 1e-4});
    }
    EXPECT_NEAR(hand.input.frame.scene_per_meter, 2000.0, 1e-6);
}

TEST(HandModes, AtALimitOfTheZoomNoForcePushesOn)
{
    Hand hand;
    hand.options.scene_per_meter_min = 0.9 * hand.input.frame.scene_per_meter;
    hand.input.is_grabbing = true;
    hand.move({});
    double sum_n = 0.0;
    double most_n = 0.0;
    double last_n = hand.move({}).force_n.z;
    double step_n = 0.0;
    for (int i = 0; i < 600; ++i) { // four steps of the detents, nearly all beyond the limit
        const double force_n = hand.move({0.0, 0.0, 1e-4}).force_n.z;
        sum_n += force_n;
        most_n = std::max(most_n, std::abs(force_n));
        step_n = std::max(step_n, std::abs(force_n - last_n));
        last_n = force_n;
    }
    EXPECT_NEAR(sum_n / 600.0, 0.0, 1e-3);
    EXPECT_NEAR(most_n, 60.0 * 0.00375, 2e-3); // the stiffness times a quarter of 15 mm
    EXPECT_LT(step_n, 60.0 * 1e-4 + 1e-9);     // continuous
}

TEST(HandModes, StayFiniteForAnyMotion)
{
    Random random;
    Hand hand;
    for (int i = 0; i < 200'000; ++i) {
        hand.input.is_grabbing =
            random.chance(0.01) ? !hand.input.is_grabbing : hand.input.is_grabbing;
        hand.input.is_in_contact = random.chance(0.5);
        hand.input.free_share = random.chance(0.1) ? 0.0 : random.unit();
        const ModeStep step = hand.move(
            {random.uniform(-1e-2, 1e-2), random.uniform(-1e-2, 1e-2), random.uniform(-1e-2, 1e-2)},
            random.uniform(-0.1, 0.1));
        ASSERT_TRUE(step.frame.isSound());
        ASSERT_TRUE(std::isfinite(length(step.force_n)));
    }
}

} // namespace
} // namespace marsview::test
