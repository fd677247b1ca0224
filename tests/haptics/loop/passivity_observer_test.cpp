#include "haptics/loop/passivity_observer.h"
#include "tests/haptics/tick_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

TEST(PassivityObserver, LeavesASpringThatTakesEnergyAlone)
{
    PassivityState state;
    double x_m = 0.0;
    for (int i = 0; i < 1000; ++i) { // pressing in
        const Vec3 wanted{-200.0 * x_m, 0.0, 0.0};
        const PassivityStep step =
            keepPassive({}, {.force_n = wanted, .shift_m = {1e-5, 0.0, 0.0}}, state, kDt);
        EXPECT_EQ(step.force_n, wanted);
        noteWritten(state, step.force_n);
        x_m += 1e-5;
    }
    EXPECT_GT(state.energy_j, 0.0);
}

TEST(PassivityObserver, CountsTheWorkOfTheHand)
{
    PassivityState state;
    noteWritten(state, {-2.0, 1.0, 0.0});
    keepPassive({.energy_j_max = 1.0},
                {.force_n = {-2.0, 1.0, 0.0}, .shift_m = {0.003, 0.001, 0.5}}, state, kDt);
    EXPECT_NEAR(state.energy_j, 0.006 - 0.001, 1e-12);
}

// What a spring has stored may come back at any time: only a surplus is forgotten.
TEST(PassivityObserver, LeavesASpringThatReturnsItsEnergyLaterAlone)
{
    PassivityState state;
    const Vec3 force_n{0.0, 0.0, 1.0};
    const PassivityInput held{.force_n = force_n, .shift_m = {}, .stored_j = 1e-3};
    PassivityInput pressed = held;
    pressed.shift_m = {0.0, 0.0, -1e-3};
    PassivityInput released = held;
    released.shift_m = {0.0, 0.0, 1e-3};
    noteWritten(state, force_n);
    keepPassive({}, pressed, state, kDt);
    EXPECT_NEAR(state.energy_j, 1e-3, 1e-15);
    for (int i = 0; i < 2000; ++i) {
        keepPassive({}, held, state, kDt);
    }
    EXPECT_NEAR(state.energy_j, 1e-3, 1e-15);
    EXPECT_EQ(keepPassive({}, released, state, kDt).force_n, force_n);
    EXPECT_NEAR(state.energy_j, 0.0, 1e-15);
}

TEST(PassivityObserver, AStepWithoutATimeChangesNothing)
{
    for (const double dt_s : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        PassivityState state;
        noteWritten(state, {1.0, 0.0, 0.0});
        const PassivityStep step =
            keepPassive({}, {.force_n = {2.0, 0.0, 0.0}, .shift_m = {1e-4, 0.0, 0.0}}, state, dt_s);
        EXPECT_EQ(step.force_n, (Vec3{2.0, 0.0, 0.0})) << dt_s;
        EXPECT_EQ(state.energy_j, 0.0);
        EXPECT_EQ(state.velocity_m_per_s, Vec3{});
    }
}

// The hand has just been pushed, and is pushed no longer.
TEST(PassivityObserver, NoForceIsNotDamped)
{
    PassivityState state;
    noteWritten(state, {1.0, 0.0, 0.0});
    const PassivityStep step = keepPassive({}, {.shift_m = {1e-4, 0.0, 0.0}}, state, kDt);
    EXPECT_LT(state.energy_j, 0.0);
    EXPECT_EQ(step.force_n, Vec3{});
    EXPECT_EQ(step.damping_n_s_per_m, 0.0);
}

TEST(PassivityObserver, DampsAnActivePort)
{
    PassivityState state;
    noteWritten(state, {1.0, 0.0, 0.0});
    const PassivityStep step =
        keepPassive({}, {.force_n = {1.0, 0.0, 0.0}, .shift_m = {1e-4, 0.0, 0.0}}, state, kDt);
    EXPECT_LT(state.energy_j, 0.0); // it pushes in the direction of motion: generated energy
    EXPECT_GT(step.damping_n_s_per_m, 0.0);
    EXPECT_LT(step.force_n.x, 1.0);
    EXPECT_LE(step.damping_n_s_per_m, PassivityOptions{}.damping_n_s_per_m_max);
}

// Hannaford and Ryu, equation 8: the damping that dissipates the surplus within the step, E / (v²
// dt).
TEST(PassivityObserver, TheDampingDissipatesTheSurplus)
{
    const PassivityOptions options{.damping_n_s_per_m_max = 3.0, .velocity_hz = 1e6};
    PassivityState state;
    noteWritten(state, {0.1, 0.0, 0.0});
    const PassivityStep step =
        keepPassive(options, {.force_n = {0.1, 0.0, 0.0}, .shift_m = {1e-4, 0.0, 0.0}}, state, kDt);
    EXPECT_NEAR(state.energy_j, -1e-5, 1e-15);
    EXPECT_NEAR(step.damping_n_s_per_m, 1e-5 / (0.1 * 0.1 * kDt), 1e-9);
    EXPECT_NEAR(step.force_n.x, 0.1 - 1.0 * 0.1, 1e-9);
}

// The damping ends where it would turn the force around, and across the force there is none.
TEST(PassivityObserver, NeverPullsBack)
{
    const PassivityOptions options{.velocity_hz = 1e6};
    const auto damped = [&](const Vec3& force_n, const Vec3& shift_m) {
        PassivityState state{.energy_j = -1e-3};
        return keepPassive(options, {.force_n = force_n, .shift_m = shift_m}, state, kDt);
    };
    const Vec3 leaving = damped({0.0, 0.0, 0.1}, {0.0, 0.0, 2e-4}).force_n;
    EXPECT_NEAR(leaving.z, 0.0, 1e-12); // 3 N s/m would take 0.6 N of 0.1 N
    EXPECT_EQ(damped({0.0, 0.0, 1.0}, {2e-4, 0.0, 0.0}).damping_n_s_per_m, 0.0); // slides
    EXPECT_EQ(damped({0.0, 0.0, 1.0}, {2e-4, 0.0, 1e-5}).force_n.x, 0.0);
    // A force against the motion takes energy.
    EXPECT_EQ(damped({0.0, 0.0, 1.0}, {0.0, 0.0, -2e-4}).force_n, (Vec3{0.0, 0.0, 1.0}));
    EXPECT_NEAR(damped({0.0, 0.0, 1.0}, {0.0, 0.0, 2e-4}).force_n.z, 1.0 - 3.0 * 0.2, 1e-12);
}

TEST(PassivityObserver, ForgetsASurplusThatIsNotRenewed)
{
    PassivityState state{.energy_j = -1e-3};
    for (int i = 0; i < 100; ++i) {
        keepPassive({.surplus_s = 0.1}, {.force_n = {0.0, 0.0, 1.0}}, state, kDt);
    }
    EXPECT_NEAR(state.energy_j, -1e-3 * std::exp(-1.0), 1e-12);
}

// A spring may return what it stores, although that is more than the limit.
TEST(PassivityObserver, RemembersWhatSpringsStore)
{
    PassivityState state;
    noteWritten(state, {-1.0, 0.0, 0.0});
    keepPassive({.energy_j_max = 2e-3},
                {.force_n = {-1.0, 0.0, 0.0}, .shift_m = {0.1, 0.0, 0.0}, .stored_j = 5e-3}, state,
                kDt);
    EXPECT_EQ(state.energy_j, 7e-3);
}

TEST(PassivityObserver, FiltersTheVelocityAtItsCutoff)
{
    PassivityState state;
    keepPassive({.velocity_hz = 60.0}, {.force_n = {}, .shift_m = {1e-4, 0.0, 0.0}}, state, kDt);
    EXPECT_NEAR(state.velocity_m_per_s.x, 0.1 * (1.0 - std::exp(-2.0 * 3.14159265358979 * 0.06)),
                1e-12);
}

TEST(PassivityObserver, RemembersNoMoreEnergyThanItsLimit)
{
    for (const double side : {1.0, -1.0}) {
        PassivityState state;
        noteWritten(state, {-side, 0.0, 0.0});
        keepPassive({.energy_j_max = 2e-3},
                    {.force_n = {1.0, 0.0, 0.0}, .shift_m = {0.1, 0.0, 0.0}}, state, kDt);
        EXPECT_EQ(state.energy_j, side * 2e-3);
    }
}

// A mass on a delayed spring: without the observer its oscillation grows.
TEST(PassivityObserver, KeepsADelayedSpringFromGrowing)
{
    const auto lastSwing = [](bool is_kept) {
        PassivityState state;
        double x_m = 1e-3;
        double v = 0.0;
        double last_n = 0.0; // acts one period late
        double most_m = 0.0;
        for (int i = 0; i < 3000; ++i) {
            const double wanted_n = -300.0 * x_m;
            const double before_m = x_m;
            v += (last_n - 0.05 * v) * kDt / 0.1;
            x_m += v * kDt;
            last_n = wanted_n;
            if (is_kept) {
                const Vec3 force_n{wanted_n, 0.0, 0.0};
                last_n = keepPassive({.damping_n_s_per_m_max = 3.0},
                                     {.force_n = force_n, .shift_m = {x_m - before_m, 0.0, 0.0}},
                                     state, kDt)
                             .force_n.x;
                noteWritten(state, {last_n, 0.0, 0.0});
            }
            most_m = i > 2500 ? std::max(most_m, std::abs(x_m)) : most_m;
        }
        return most_m;
    };
    EXPECT_GT(lastSwing(false), 3e-3);
    EXPECT_LT(lastSwing(true), 1.2e-3);
}

TEST(PassivityObserver, DropsEnergyGatheredInFreeSpace)
{
    PassivityState state{.energy_j = 1.0};
    keepPassive({}, {.force_n = {}, .shift_m = {1e-4, 0.0, 0.0}}, state, kDt);
    EXPECT_EQ(state.energy_j, 0.0);
}

TEST(PassivityObserver, PassesForcesOnForATimeStepOfZero)
{
    for (const double dt_s : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
        PassivityState state{.energy_j = -1.0};
        EXPECT_EQ(
            keepPassive({}, {.force_n = {1.0, 2.0, 3.0}, .shift_m = {1e-3, 0.0, 0.0}}, state, dt_s)
                .force_n,
            (Vec3{1.0, 2.0, 3.0}));
    }
}

} // namespace
} // namespace marsview::test
