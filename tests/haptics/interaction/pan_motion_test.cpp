#include "haptics/interaction/pan_motion.h"
#include "tests/haptics/tick_time.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

PanOptions withoutDrag()
{
    PanOptions options;
    options.drag_per_s = 0.0;
    return options;
}

TEST(PanMotion, WithoutDragAReleasedMapMovesForever)
{
    PanState state{.velocity_m_per_s = {0.12, -0.05, 0.0}};
    Vec3 way{};
    for (int i = 0; i < 10'000; ++i) {
        const PanStep step = glideMap(withoutDrag(), state, 1.0, kDt);
        way = way + step.shift_m;
        EXPECT_EQ(step.force_n, Vec3{});
    }
    EXPECT_EQ(state.velocity_m_per_s, (Vec3{0.12, -0.05, 0.0})); // bit-exact
    EXPECT_NEAR(way.x, 1.2, 1e-9);
    EXPECT_NEAR(way.y, -0.5, 1e-9);
}

TEST(PanMotion, DragSlowsItDownToRest)
{
    PanOptions options;
    options.drag_per_s = 2.0;
    PanState state{.velocity_m_per_s = {0.4, 0.0, 0.0}};
    for (int i = 0; i < 500; ++i) {
        glideMap(options, state, 1.0, kDt);
    }
    EXPECT_NEAR(state.velocity_m_per_s.x, 0.4 * std::exp(-1.0), 1e-3);
    for (int i = 0; i < 10'000; ++i) {
        glideMap(options, state, 1.0, kDt);
    }
    EXPECT_EQ(state.velocity_m_per_s, Vec3{});
}

// m dv/dt = F - m c v: pulled with a constant force, the map reaches v = F / (m c).
TEST(PanMotion, DragLimitsTheSpeedOfAPulledMap)
{
    PanOptions options;
    options.drag_per_s = 2.0;
    PanState state;
    grabMap(options, state, {}, {});
    Vec3 force_n{};
    constexpr double kSpeed = 0.1; // of the hand, m/s
    for (int i = 0; i < 10'000; ++i) {
        force_n = pullMap(options, state, {kSpeed * kDt, 0.0, 0.0}, 1.0, kDt).force_n;
    }
    EXPECT_NEAR(state.velocity_m_per_s.x, kSpeed, 1e-6);
    EXPECT_NEAR(-force_n.x, options.mass_kg * options.drag_per_s * kSpeed, 1e-6);
}

// grabMap: the hold begins with the force that the hand feels, whatever hand and map do. The force
// of a moment later, F = k s + b (v - v'), is the same.
TEST(PanMotion, TheForceContinuesAtTheGrab)
{
    const PanOptions options;
    for (const Vec3& hand_m_per_s : {Vec3{}, Vec3{0.2, -0.1, 0.3}, Vec3{-0.3, 0.0, 0.0}}) {
        for (const Vec3& map_m_per_s : {Vec3{}, Vec3{0.1, 0.25, 0.0}}) {
            PanState state{.velocity_m_per_s = map_m_per_s};
            grabMap(options, state, {0.4, -0.7, 1.5}, hand_m_per_s);
            constexpr double kMomentS = 1e-9;
            const Vec3 force_n =
                pullMap(options, state, hand_m_per_s * kMomentS, 1.0, kMomentS).force_n;
            EXPECT_NEAR(length(force_n - Vec3{0.4, -0.7, 0.0}), 0.0, 1e-6);
            EXPECT_NEAR(length(state.velocity_m_per_s - map_m_per_s), 0.0, 1e-6);
        }
    }
}

TEST(PanMotion, MomentumComesFromTheHand)
{
    Random random;
    const PanOptions options = withoutDrag();
    PanState state;
    grabMap(options, state, {}, {});
    Vec3 impulse{}; // from the hand to the map
    for (int i = 0; i < 3000; ++i) {
        const Vec3 shift{random.uniform(-3e-4, 5e-4), random.uniform(-4e-4, 4e-4), 0.0};
        impulse = impulse - pullMap(options, state, shift, 1.0, kDt).force_n * kDt;
        const Vec3 momentum = state.velocity_m_per_s * options.mass_kg;
        ASSERT_NEAR(length(momentum - impulse), 0.0, 1e-12);
    }
}

TEST(PanMotion, ASteadyHandFeelsNothingAndAChangeIsResisted)
{
    const PanOptions options = withoutDrag();
    PanState state;
    grabMap(options, state, {}, {});
    const Vec3 shift{1e-4, 0.0, 0.0};         // 0.1 m/s
    pullMap(options, state, shift, 1.0, kDt); // the force continues
    // the map must be accelerated
    EXPECT_LT(pullMap(options, state, shift, 1.0, kDt).force_n.x, 0.0);
    PanStep step;
    for (int i = 0; i < 20'000; ++i) {
        step = pullMap(options, state, shift, 1.0, kDt);
    }
    EXPECT_NEAR(step.force_n.x, 0.0, 1e-6);
    EXPECT_NEAR(state.velocity_m_per_s.x, 0.1, 1e-6);
    // After a stop the map pushes on.
    for (int i = 0; i < 5; ++i) {
        step = pullMap(options, state, {}, 1.0, kDt);
    }
    EXPECT_GT(step.force_n.x, 0.0);
}

TEST(PanMotion, WithoutMassThereIsNoForceAndTheMapFollows)
{
    Random random;
    const PanOptions options;
    PanState state{.velocity_m_per_s = {0.3, 0.1, 0.0}, .stretch_m = {0.002, 0.0, 0.0}};
    Vec3 hand{0.002, 0.0, 0.0};
    Vec3 map{};
    for (int i = 0; i < 2000; ++i) {
        const Vec3 shift = i < 1000 ? Vec3{random.uniform(-1e-3, 1e-3), 0.0, 0.0} : Vec3{};
        const PanStep step = pullMap(options, state, shift, 0.0, kDt);
        EXPECT_NEAR(length(step.force_n), 0.0, 1e-12);
        hand = hand + shift;
        map = map + step.shift_m;
    }
    EXPECT_NEAR(length(hand - map), 0.0, 1e-9);
}

// A hand of 1 m/s grabs a map at rest: k v would be 0.25 N in a millisecond. The force still is
// what changes the momentum.
TEST(PanMotion, TheForceOfTheHoldGrowsAtItsRate)
{
    const PanOptions options = withoutDrag();
    PanState state;
    grabMap(options, state, {0.0, 0.1, 0.0}, {1.0, 0.0, 0.0});
    double last_n = 0.1;
    Vec3 impulse{};
    for (int i = 0; i < 40; ++i) {
        const double before_n = last_n;
        const PanStep step = pullMap(options, state, {1e-3, 0.0, 0.0}, 1.0, kDt);
        last_n = length(step.force_n);
        impulse = impulse - step.force_n * kDt;
        EXPECT_LE(last_n, before_n + 0.02 + 1e-12) << i;
        EXPECT_NEAR(length(state.velocity_m_per_s * options.mass_kg - impulse), 0.0, 1e-12);
    }
    EXPECT_NEAR(last_n, 0.88, 1e-9); // 0.1 N in the first step, and 39 times 0.02 N
}

TEST(PanMotion, ForcesAreContinuousInTheMass)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const PanState state{.velocity_m_per_s = {random.uniform(-0.3, 0.3), 0.0, 0.0},
                             .stretch_m = {random.uniform(-0.01, 0.01), 0.0, 0.0}};
        const Vec3 shift{random.uniform(-1e-3, 1e-3), 0.0, 0.0};
        const double share = random.unit();
        PanState a = state;
        PanState b = state;
        const double force_a = pullMap({}, a, shift, share, kDt).force_n.x;
        const double force_b = pullMap({}, b, shift, share * (1.0 - 1e-6), kDt).force_n.x;
        EXPECT_NEAR(force_a, force_b, 1e-4);
    }
}

// m v' = F - m c v: at a steady speed the hand pulls with m c v.
TEST(PanMotion, PullingAtASteadySpeedCostsTheDrag)
{
    const PanOptions options{.mass_kg = 0.2, .drag_per_s = 0.7};
    PanState state;
    grabMap(options, state, {}, {});
    PanStep step;
    for (int i = 0; i < 20'000; ++i) {
        step = pullMap(options, state, {1e-4, 0.0, 0.0}, 1.0, kDt); // 0.1 m/s
    }
    EXPECT_NEAR(step.force_n.x, -0.2 * 0.7 * 0.1, 1e-9);
    EXPECT_NEAR(state.velocity_m_per_s.x, 0.1, 1e-9);
}

TEST(PanMotion, WhatStopsTheMapTakesItsVelocityThatWayAndStretchesTheHold)
{
    PanState state{.velocity_m_per_s = {0.2, -0.1, 0.0}, .stretch_m = {0.001, 0.0, 0.0}};
    stopMap(state, {-0.004, 0.0, 0.0}, 0.5);
    EXPECT_NEAR(length(state.velocity_m_per_s - Vec3{0.0, -0.1, 0.0}), 0.0, 1e-15);
    EXPECT_NEAR(state.stretch_m.x, 0.001 + 0.002, 1e-15);
    // In its own direction it keeps the velocity.
    stopMap(state, {0.0, -0.001, 0.0}, 0.0);
    EXPECT_NEAR(length(state.velocity_m_per_s - Vec3{0.0, -0.1, 0.0}), 0.0, 1e-15);
    stopMap(state, {}, 1.0);
    EXPECT_NEAR(length(state.velocity_m_per_s - Vec3{0.0, -0.1, 0.0}), 0.0, 1e-15);
}

TEST(PanMotion, AWallTakesTheMomentum)
{
    PanState state{.velocity_m_per_s = {0.4, 0.0, 0.0}};
    EXPECT_EQ(glideMap({}, state, 0.0, kDt).shift_m, Vec3{});
    EXPECT_EQ(glideMap({}, state, 1.0, kDt).shift_m, Vec3{}); // permanently
}

// After a grab without a force the hold has none to exert in the first step, near a wall too, and
// what has no mass needs none.
TEST(PanMotion, AKnockIsHeldBackWithAnyMass)
{
    for (const double share : {0.0, 0.002, 1.0}) {
        PanState state;
        grabMap({}, state, {}, {});
        const PanStep step = pullMap({}, state, {5e-4, 0.0, 0.0}, share, kDt);
        EXPECT_NEAR(length(step.force_n), 0.0, 1e-12) << share;
        // The map follows without mass; with mass it stays where it is.
        EXPECT_NEAR(step.shift_m.x, share > 0.0 ? 0.0 : 5e-4, 1e-12) << share;
    }
}

TEST(PanMotion, WithoutTimeTheForceIsThatOfTheStretchedHold)
{
    PanState state{.stretch_m = {0.002, -0.001, 0.0}};
    const PanOptions options;
    const PanStep step = pullMap(options, state, {}, 1.0, 0.0);
    EXPECT_EQ(step.shift_m, Vec3{});
    EXPECT_NEAR(step.force_n.x, -0.002 * options.grip_n_per_m, 1e-12);
    EXPECT_NEAR(step.force_n.y, 0.001 * options.grip_n_per_m, 1e-12);
}

TEST(PanMotion, AMapSlowerThanATenthOfAMillimeterPerSecondRests)
{
    for (const double speed_m_per_s : {0.9e-4, 1.1e-4}) {
        PanState state{.velocity_m_per_s = {0.0, -speed_m_per_s, 0.0}};
        EXPECT_EQ(glideMap({}, state, 1.0, kDt).shift_m == Vec3{}, speed_m_per_s < 1e-4);
    }
}

TEST(PanMotion, TakesAnyTimeStep)
{
    for (const double dt_s : {0.0, 1e-9, 1e-4, 0.01, 1.0, std::nan("")}) {
        PanState state{.velocity_m_per_s = {0.4, 0.0, 0.0}};
        for (int i = 0; i < 100; ++i) {
            const PanStep step = pullMap({}, state, {1e-3, 0.0, 0.0}, 0.5, dt_s);
            EXPECT_TRUE(std::isfinite(step.force_n.x) && std::isfinite(step.shift_m.x)) << dt_s;
        }
    }
}

TEST(PanMotion, NothingMovesUpOrDown)
{
    PanState state;
    EXPECT_EQ(pullMap({}, state, {0.0, 0.0, 0.01}, 1.0, kDt).shift_m, Vec3{});
}

} // namespace
} // namespace marsview::test
