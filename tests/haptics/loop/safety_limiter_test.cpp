#include "haptics/loop/safety_limiter.h"
#include "tests/haptics/tick_time.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace marsview::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr SafetyLimits kLimits{.force_n_max = 3.0,
                               .rate_n_per_s_max = 500.0,
                               .release_n_per_s_max = 2000.0,
                               .ramp_s = 0.1,
                               .change_ramp_s = 0.02};

// The result after `count` steps with the same force.
SafetyOutput steps(SafetyState& state, const Vec3& force_n, int count)
{
    SafetyOutput last;
    for (int i = 0; i < count; ++i) {
        last = limitForce(kLimits, {.force_n = force_n}, state, kDt);
    }
    return last;
}

TEST(SafetyLimiter, RampsInFromZeroToTheFullForce)
{
    SafetyState state;
    double before = 0.0;
    for (int i = 1; i <= 99; ++i) {
        const SafetyOutput output = limitForce(kLimits, {.force_n = {0.0, 0.0, 1.0}}, state, kDt);
        EXPECT_NEAR(output.force_n.z, 0.01 * i, 1e-12); // a hundredth of the ramp each
        EXPECT_GT(output.force_n.z, before);
        before = output.force_n.z;
    }
    EXPECT_EQ(steps(state, {0.0, 0.0, 1.0}, 2).force_n, (Vec3{0.0, 0.0, 1.0}));
}

TEST(SafetyLimiter, KeepsTheDirectionOfForcesThatAreTooStrong)
{
    SafetyState state;
    const Vec3 force_n = steps(state, {30.0, 40.0, 0.0}, 500).force_n;
    EXPECT_NEAR(force_n.x, 1.8, 1e-12);
    EXPECT_NEAR(force_n.y, 2.4, 1e-12);
    EXPECT_LE(length(force_n), 3.0);
}

TEST(SafetyLimiter, ChangesNoFasterThanItsRate)
{
    SafetyState state;
    steps(state, {3.0, 0.0, 0.0}, 500);
    const SafetyOutput output = limitForce(kLimits, {.force_n = {-3.0, 0.0, 0.0}}, state, kDt);
    EXPECT_NEAR(output.force_n.x, 2.5, 1e-12); // 500 N/s for a millisecond
}

TEST(SafetyLimiter, RampsDownFasterThanUpAndRampsInAgain)
{
    SafetyState state;
    steps(state, {3.0, 0.0, 0.0}, 500);
    SafetyInput lost{.force_n = {3.0, 0.0, 0.0}, .reason = ForceOffReason::DeviceLost};
    EXPECT_NEAR(limitForce(kLimits, lost, state, kDt).force_n.x, 1.0, 1e-12);
    const SafetyOutput output = limitForce(kLimits, lost, state, kDt);
    EXPECT_EQ(output.force_n, Vec3{});
    EXPECT_EQ(output.reason, ForceOffReason::DeviceLost);
    EXPECT_NEAR(steps(state, {1.0, 0.0, 0.0}, 1).force_n.x, 0.01, 1e-12);
}

TEST(SafetyLimiter, RampsInAgainAfterAChange)
{
    SafetyState state;
    steps(state, {0.4, 0.0, 0.0}, 500);
    const SafetyInput changed{.force_n = {0.4, 0.0, 0.0}, .has_changed = true};
    const SafetyOutput output = limitForce(kLimits, changed, state, kDt);
    EXPECT_NEAR(output.force_n.x, 0.02, 1e-12);
    EXPECT_NEAR(steps(state, {0.4, 0.0, 0.0}, 20).force_n.x, 0.4, 1e-12);
    // One map change after another, as while a map is dragged: the force must not build up.
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LE(limitForce(kLimits, changed, state, kDt).force_n.x, 0.021);
        if (i == 0) {
            continue;
        }
        EXPECT_NEAR(state.gain, 0.05, 1e-12);
    }
}

TEST(SafetyLimiter, InvalidForcesAndTimesAreFaults)
{
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            SafetyState state;
            steps(state, {3.0, 0.0, 0.0}, 500);
            const Vec3 force_n{axis == 0 ? bad : 1.0, axis == 1 ? bad : 1.0, axis == 2 ? bad : 1.0};
            const SafetyOutput output = limitForce(kLimits, {.force_n = force_n}, state, kDt);
            EXPECT_EQ(output.reason, ForceOffReason::Fault);
            EXPECT_NEAR(output.force_n.x, 1.0, 1e-12);
        }
        SafetyState state;
        steps(state, {3.0, 0.0, 0.0}, 500);
        EXPECT_EQ(limitForce(kLimits, {.force_n = {3.0, 0.0, 0.0}}, state, bad).reason,
                  ForceOffReason::Fault);
        EXPECT_NEAR(state.force_n.x, 1.0, 1e-12); // as in a millisecond
    }
}

TEST(SafetyLimiter, NothingJumpsAfterAPause)
{
    for (const double pause_s : {0.010001, 0.03, 1.0, 60.0}) {
        SafetyState state;
        steps(state, {3.0, 0.0, 0.0}, 500);
        // Ramps down to zero although the full opposite force is requested, then ramps that force
        // in.
        const SafetyInput wanted{.force_n = {-3.0, 0.0, 0.0}};
        SafetyOutput output = limitForce(kLimits, wanted, state, pause_s);
        EXPECT_EQ(output.reason, ForceOffReason::MissedDeadline);
        EXPECT_NEAR(output.force_n.x, 1.0, 1e-12); // 2000 N/s for a millisecond
        // The next write follows immediately, or one period later.
        double last_n = output.force_n.x;
        for (int i = 1; i <= 99; ++i) {
            const double dt_s = i == 1 ? 20e-6 : kDt;
            output = limitForce(kLimits, wanted, state, dt_s);
            EXPECT_EQ(output.reason, ForceOffReason::None);
            EXPECT_LE(std::abs(output.force_n.x - last_n), 500.0 * dt_s + 1e-12) << i;
            EXPECT_GE(output.force_n.x, -0.03 * i - 1e-12) << i;
            last_n = output.force_n.x;
        }
        EXPECT_NEAR(steps(state, {-3.0, 0.0, 0.0}, 2).force_n.x, -3.0, 1e-12);
    }
    // The longest interval that does not count as a pause is one step.
    SafetyState state;
    steps(state, {3.0, 0.0, 0.0}, 500);
    const SafetyOutput output =
        limitForce(kLimits, {.force_n = {-3.0, 0.0, 0.0}}, state, kSafetyStepMaxS);
    EXPECT_EQ(output.reason, ForceOffReason::None);
    EXPECT_NEAR(output.force_n.x, -2.0, 1e-12); // 500 N/s for 10 ms
}

TEST(SafetyLimiter, AnInvalidStateSwitchesTheForceOff)
{
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        for (int field = 0; field < 3; ++field) {
            SafetyState state;
            steps(state, {3.0, 0.0, 0.0}, 500);
            (field == 0 ? state.gain : field == 1 ? state.ramp_s : state.force_n.y) = bad;
            const SafetyOutput output =
                limitForce(kLimits, {.force_n = {3.0, 0.0, 0.0}}, state, kDt);
            EXPECT_EQ(output.reason, ForceOffReason::Fault);
            EXPECT_NEAR(output.force_n.x, field < 2 ? 1.0 : 0.0, 1e-12);
            EXPECT_EQ(limitForce(kLimits, {}, state, kDt).reason, ForceOffReason::None);
        }
    }
}

TEST(SafetyLimiter, ATimeStepOfZeroChangesNothing)
{
    SafetyState state;
    const Vec3 before = steps(state, {1.0, 2.0, 0.5}, 500).force_n;
    EXPECT_EQ(limitForce(kLimits, {.force_n = {-3.0, 0.0, 0.0}}, state, 0.0).force_n, before);
}

TEST(SafetyLimiter, InvalidLimitsAllowNoForce)
{
    for (const double bad : {kNan, -kInfinity, -1.0, 0.0}) {
        SafetyState state;
        for (int i = 0; i < 100; ++i) {
            const SafetyLimits limits{.force_n_max = bad};
            EXPECT_EQ(limitForce(limits, {.force_n = {1.0, 0.0, 0.0}}, state, kDt).force_n, Vec3{});
        }
    }
}

// The values of a small desktop device.
// A wall that is pressed with 8 N takes what 3 N leave: sqrt(3² - 0.6²).
TEST(SafetyLimiter, ReducesTheYieldingPartFirst)
{
    const auto limited = [](const Vec3& force_n, const Vec3& yielding_n) {
        SafetyState state;
        SafetyOutput output;
        for (int i = 0; i < 500; ++i) {
            output =
                limitForce(kLimits, {.force_n = force_n, .yielding_n = yielding_n}, state, kDt);
        }
        EXPECT_LE(length(output.force_n), 3.0);
        return output.force_n;
    };
    EXPECT_EQ(limited({0.0, 0.0, 0.6}, {-1.0, 0.5, 0.0}), (Vec3{-1.0, 0.5, 0.6})); // both fit
    const Vec3 wall = limited({0.0, 0.0, 0.6}, {-8.0, 0.0, 0.0});
    EXPECT_NEAR(wall.z, 0.6, 1e-12);
    EXPECT_NEAR(wall.x, -std::sqrt(9.0 - 0.36), 1e-12);
    // Along the same line the two cancel: all that fits of the other.
    const Vec3 against = limited({2.0, 0.0, 0.0}, {-8.0, 0.0, 0.0});
    EXPECT_NEAR(against.x, -3.0, 1e-12);
    const Vec3 both = limited({0.0, 6.0, 0.0}, {4.0, 0.0, 0.0});
    EXPECT_NEAR(length(both - Vec3{0.0, 3.0, 0.0}), 0.0, 1e-6);
    const Vec3 huge = limited({0.0, 0.0, 0.6}, {1e200, 0.0, 0.0});
    EXPECT_NEAR(huge.z, 0.6, 1e-6);
    SafetyState state;
    EXPECT_EQ(limitForce(kLimits, {.yielding_n = {std::nan(""), 0.0, 0.0}}, state, kDt).reason,
              ForceOffReason::Fault);
}

constexpr SafetyLimits kWarmLimits{.force_n_max = 3.3,
                                   .force_n_continuous = 0.9,
                                   .heat_s = 5.0,
                                   .rate_n_per_s_max = 500.0,
                                   .release_n_per_s_max = 2000.0,
                                   .ramp_s = 1e-3,
                                   .change_ramp_s = 1e-3};

TEST(SafetyLimiter, StrongForMomentsAndContinuousForLong)
{
    SafetyState state;
    double root_mean_square_n = 0.0;
    double squares_n2 = 0.0; // an independent low-pass, with Euler steps
    for (int i = 1; i <= 60'000; ++i) {
        const Vec3 force_n =
            limitForce(kWarmLimits, {.force_n = {0.0, 30.0, 40.0}}, state, kDt).force_n;
        EXPECT_NEAR(force_n.z * 0.75, force_n.y, 1e-9); // its direction does not change
        squares_n2 += kDt / 5.0 * (dot(force_n, force_n) - squares_n2);
        root_mean_square_n = std::max(root_mean_square_n, std::sqrt(squares_n2));
        // By hand: 3.3² (1 - exp(-t / 5 s)) is 0.64 × 0.9² at 0.244 s.
        if (i > 10 && i < 240) {
            EXPECT_NEAR(length(force_n), 3.3, 1e-9) << i;
        }
        if (i == 260) {
            EXPECT_LT(length(force_n), 3.29);
        }
    }
    EXPECT_NEAR(length(state.force_n), 0.9, 1e-6);
    EXPECT_LE(root_mean_square_n, 0.9001);
}

TEST(SafetyLimiter, NoForcesHeatMoreThanTheContinuousOneDoes)
{
    Random random;
    double hottest = 0.0; // root mean square, as a share of the continuous force
    for (int device = 0; device < 40; ++device) {
        const double lasting_n = random.uniform(0.5, 3.0);
        const SafetyLimits limits{.force_n_max = lasting_n * random.uniform(1.0, 8.0),
                                  .force_n_continuous = lasting_n,
                                  .heat_s = random.uniform(1.0, 10.0),
                                  .rate_n_per_s_max = random.uniform(300.0, 3000.0),
                                  .ramp_s = 0.1,
                                  .change_ramp_s = 0.02};
        SafetyState state;
        double squares_n2 = 0.0;
        Vec3 force_n{};
        for (int i = 0; i < 30'000; ++i) {
            const double dt_s = random.uniform(0.5e-3, 1.5e-3);
            // The previous force acts until this tick.
            squares_n2 += dt_s / limits.heat_s * (dot(force_n, force_n) - squares_n2);
            SafetyInput input{.has_changed = random.chance(1e-4)};
            const double strength_n = i / 5'000 % 2 == 0 ? 40.0 : 2.0 * lasting_n;
            input.force_n = {random.uniform(-0.1, 1.0) * strength_n,
                             random.uniform(-0.1, 1.0) * strength_n, 0.0};
            force_n = limitForce(limits, input, state, dt_s).force_n;
            const double share = std::sqrt(squares_n2) / lasting_n;
            ASSERT_LE(share, 1.001) << "device " << device << " tick " << i;
            hottest = std::max(hottest, share);
        }
    }
    std::printf("hottest: %.6f of what the continuous force brings about\n", hottest);
    EXPECT_GT(hottest, 0.95); // otherwise the bound was never reached
}

TEST(SafetyLimiter, WhatMayLastIsNeverTouched)
{
    SafetyState state;
    for (int i = 1; i <= 60'000; ++i) {
        const SafetyOutput output =
            limitForce(kWarmLimits, {.force_n = {0.9, 0.0, 0.0}}, state, kDt);
        if (i > 10) {
            ASSERT_NEAR(output.force_n.x, 0.9, 1e-12);
        }
    }
    // Without a continuous force limit only the peak limit applies.
    SafetyState strong;
    steps(strong, {3.0, 0.0, 0.0}, 60'000);
    EXPECT_NEAR(strong.force_n.x, 3.0, 1e-12);
}

TEST(SafetyLimiter, CoolsDownWhileNothingPushes)
{
    SafetyState state;
    const auto hold = [&state](const Vec3& force_n, ForceOffReason reason, int ticks) {
        for (int i = 0; i < ticks; ++i) {
            limitForce(kWarmLimits, {.force_n = force_n, .reason = reason}, state, kDt);
        }
        return length(state.force_n);
    };
    EXPECT_NEAR(hold({3.3, 0.0, 0.0}, ForceOffReason::None, 30'000), 0.9, 1e-3);
    EXPECT_EQ(hold({3.3, 0.0, 0.0}, ForceOffReason::NotHeld, 1'000), 0.0);
    EXPECT_LT(hold({3.3, 0.0, 0.0}, ForceOffReason::None, 100), 2.5) << "still warm";
    EXPECT_EQ(hold({}, ForceOffReason::NotHeld, 20'000), 0.0);
    EXPECT_NEAR(hold({3.3, 0.0, 0.0}, ForceOffReason::None, 100), 3.3, 1e-9) << "cooled down";
    EXPECT_NEAR(cooledHeat(kWarmLimits, 4.0, 5.0), 4.0 / std::exp(1.0), 1e-12);
    EXPECT_EQ(cooledHeat(kWarmLimits, 4.0, -5.0), 4.0);
}

TEST(SafetyLimiter, AnInvalidHeatCountsAsHot)
{
    for (const double bad : {kNan, kInfinity, -1.0}) {
        SafetyState state{.heat_n2 = bad};
        for (int i = 0; i < 100; ++i) {
            EXPECT_LE(
                length(limitForce(kWarmLimits, {.force_n = {3.3, 0.0, 0.0}}, state, kDt).force_n),
                0.9 + 1e-12);
        }
    }
    for (const double bad : {kNan, 0.0, -1.0}) {
        EXPECT_EQ(warmForceMax({.force_n_max = 3.0, .force_n_continuous = bad}, 0.0), 0.0);
    }
    EXPECT_EQ(warmForceMax({.force_n_max = 3.0, .force_n_continuous = 5.0}, 1e9), 3.0);
}

TEST(SafetyLimiter, EveryReasonHasAName)
{
    for (std::uint8_t i = 0; i < kForceOffReasonCount; ++i) {
        for (std::uint8_t j = 0; j < i; ++j) {
            EXPECT_NE(forceOffReasonName(ForceOffReason{i}), forceOffReasonName(ForceOffReason{j}));
        }
    }
}

// A value that a bug in the caller might produce.
double anyNumber(Random& random)
{
    switch (random.below(10)) {
    case 0:
        return kNan;
    case 1:
        return random.chance(0.5) ? kInfinity : -kInfinity;
    case 2:
        return (random.chance(0.5) ? 1.0 : -1.0) * std::numeric_limits<double>::max();
    case 3:
        return std::numeric_limits<double>::denorm_min();
    case 4:
        return 0.0;
    case 5:
        return std::pow(10.0, random.uniform(-300.0, 300.0));
    default:
        return random.uniform(-10.0, 10.0);
    }
}

TEST(SafetyLimiter, HoldsItsBoundsForAMillionRandomTicks)
{
    Random random;
    SafetyState state;
    SafetyLimits limits;
    Vec3 last{};
    int spoilt = 0;
    double longest = 0.0;
    double fastest = 0.0; // as a share of the limit
    for (int i = 0; i < 1'000'000; ++i) {
        if (i % 10'000 == 0) { // another device
            state = {};
            last = {};
            limits = {.force_n_max = random.uniform(0.1, 40.0),
                      .force_n_continuous =
                          random.chance(0.1) ? anyNumber(random) : random.uniform(0.1, 40.0),
                      .heat_s = random.chance(0.1) ? anyNumber(random) : random.uniform(0.1, 9.0),
                      .rate_n_per_s_max = random.uniform(10.0, 5000.0),
                      .release_n_per_s_max = random.uniform(10.0, 20000.0),
                      .ramp_s = random.chance(0.1) ? anyNumber(random) : random.uniform(0.0, 1.0),
                      .change_ramp_s =
                          random.chance(0.1) ? anyNumber(random) : random.uniform(0.0, 0.3)};
        }
        SafetyInput input{.force_n =
                              random.chance(0.05)
                                  ? Vec3{anyNumber(random), anyNumber(random), anyNumber(random)}
                                  : Vec3{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0),
                                         random.uniform(-9.0, 9.0)},
                          .reason = random.chance(0.01) ? ForceOffReason{static_cast<std::uint8_t>(
                                                              random.below(kForceOffReasonCount))}
                                                        : ForceOffReason::None,
                          .has_changed = random.chance(0.003)};
        const double dt_s = random.chance(0.05)   ? anyNumber(random)
                            : random.chance(0.01) ? random.uniform(0.005, 2.0)
                                                  : random.uniform(0.0, 0.003);
        if (random.chance(0.01)) { // simulates memory corruption by a bug elsewhere
            const std::array fields{&state.force_n.x, &state.force_n.y, &state.force_n.z,
                                    &state.gain,      &state.ramp_s,    &state.heat_n2};
            *fields[random.below(fields.size())] = anyNumber(random);
            last = isFinite(state.force_n) ? state.force_n : Vec3{};
            ++spoilt;
        }
        const SafetyOutput output = limitForce(limits, input, state, dt_s);
        const double magnitude_n = length(output.force_n);
        ASSERT_LE(magnitude_n, limits.force_n_max) << "tick " << i; // false for NaN
        const bool is_time = std::isfinite(dt_s) && dt_s >= 0.0;
        // The real elapsed time, which passes for the motors whatever dt says.
        const double step_s = is_time && dt_s <= 0.01 ? dt_s : 0.001;
        const double rate = output.reason == ForceOffReason::None ? limits.rate_n_per_s_max
                                                                  : limits.release_n_per_s_max;
        const double change_n = length(output.force_n - last);
        if (length(last) <= limits.force_n_max) { // otherwise the magnitude limit comes first
            ASSERT_LE(change_n, rate * step_s + 1e-14 * limits.force_n_max) << "tick " << i;
            fastest = std::max(fastest, step_s > 1e-6 ? change_n / (rate * step_s) : 0.0);
        }
        if (output.reason != ForceOffReason::None) {
            ASSERT_LE(magnitude_n, length(last)) << "tick " << i;
        }
        longest = std::max(longest, magnitude_n / limits.force_n_max);
        last = output.force_n;
    }
    std::printf(
        "largest force %.6f and fastest change %.6f of the limits, state corrupted %d "
        "times\n",
        longest, fastest, spoilt);
    EXPECT_GT(longest, 0.99); // otherwise the bounds were never reached
    EXPECT_GT(fastest, 0.99);
}

} // namespace
} // namespace marsview::test
