#include "core/view/cap_steering.h"
#include "tests/core/view/some_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview {
namespace {

using test::someCamera;

const SceneBox kBox{{-1e5, -5e4, -2e3}, {1e5, 5e4, 6e3}};
const NavigationLimits kLimits = navigationLimits(kBox, 30.0);

OrbitCamera pushed(const Vec3& push, double seconds)
{
    return steered(someCamera(), {.push = push, .turn = {}}, seconds, kLimits);
}

OrbitCamera turned(const Vec3& turn, double seconds)
{
    return steered(someCamera(), {.push = {}, .turn = turn}, seconds, kLimits);
}

TEST(CapSpeed, IsZeroInTheDeadZoneAndCubicBeyond)
{
    for (const double rate : {0.0, 0.05, kCapDeadZone}) {
        EXPECT_EQ(capSpeed(rate), 0.0);
        EXPECT_EQ(capSpeed(-rate), 0.0);
    }
    // Halfway from 0.08 to 1 is 0.54.
    EXPECT_NEAR(capSpeed(0.54), 0.125, 1e-15);
    EXPECT_NEAR(capSpeed(-0.54), -0.125, 1e-15);
    EXPECT_NEAR(capSpeed(0.5), 0.0951, 1e-4); // as the header says
    EXPECT_EQ(capSpeed(1.0), 1.0);
    EXPECT_EQ(capSpeed(-7.0), -1.0);
    EXPECT_EQ(capSpeed(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(CapSpeed, StartsSmoothlyAndIsMonotonic)
{
    constexpr double kStep = 1e-3;
    double last = capSpeed(-1.0);
    for (int i = -999; i <= 1000; ++i) {
        const double speed = capSpeed(i * kStep);
        EXPECT_GE(speed, last);
        // The cube is steepest at its end: 3 / (1 - 0.08).
        EXPECT_LE(speed - last, 3.27 * kStep);
        last = speed;
    }
    EXPECT_LT(capSpeed(kCapDeadZone + kStep) / kStep, 1e-5) << "its slope starts at zero";
}

TEST(Steered, PansHorizontallyInTheDirectionOfThePush)
{
    const OrbitCamera before = someCamera();
    const double azimuth = before.azimuth.radians();
    const Vec3 right{std::cos(azimuth), -std::sin(azimuth), 0.0};
    const Vec3 away{std::sin(azimuth), std::cos(azimuth), 0.0};
    for (const auto& [push, way] : {std::pair{Vec3{1.0, 0.0, 0.0}, right},
                                    {Vec3{-1.0, 0.0, 0.0}, right * -1.0},
                                    {Vec3{0.0, 1.0, 0.0}, away},
                                    {Vec3{0.0, -1.0, 0.0}, away * -1.0}}) {
        OrbitCamera after = pushed(push, 0.25);
        // One camera distance per second.
        const Vec3 expected = way * (0.25 * 8e4);
        EXPECT_LT(length(after.target - before.target - expected), 1e-6);
        after.target = before.target;
        EXPECT_EQ(after, before) << "nothing else changes";
    }
}

TEST(Steered, ZoomsInWhenPushedDownAndOutWhenPulledUp)
{
    const OrbitCamera before = someCamera();
    const OrbitCamera down = pushed({0.0, 0.0, -1.0}, 0.5);
    EXPECT_NEAR(down.distance_m, 8e4 / 2.0, 1e-6); // by a factor of four per second
    EXPECT_LT(eyeOf(down).z, eyeOf(before).z);
    const OrbitCamera up = pushed({0.0, 0.0, 1.0}, 0.5);
    EXPECT_NEAR(up.distance_m, 8e4 * 2.0, 1e-6);
    EXPECT_GT(eyeOf(up).z, eyeOf(before).z);
    EXPECT_LT(length(up.target - before.target), 1e-9);
}

TEST(Steered, TurnsWhenTwistedAndLooksUpWhenTippedBack)
{
    // A right-handed rotation about the up axis turns to the left: the content then seen lies
    // further west of north.
    EXPECT_NEAR(turned({0.0, 0.0, 1.0}, 0.2).azimuth.degrees(), -40.0 - 18.0, 1e-9);
    EXPECT_NEAR(turned({0.0, 0.0, -1.0}, 0.2).azimuth.degrees(), -40.0 + 18.0, 1e-9);
    // A right-handed rotation about the right axis lifts the far side, toward the horizon.
    EXPECT_NEAR(turned({1.0, 0.0, 0.0}, 0.2).tilt.degrees(), 50.0 + 9.0, 1e-9);
    EXPECT_NEAR(turned({-1.0, 0.0, 0.0}, 0.2).tilt.degrees(), 50.0 - 9.0, 1e-9);
    EXPECT_EQ(turned({0.0, 1.0, 0.0}, 0.2), someCamera()) << "it does not roll";
    EXPECT_FALSE(doesSteer({.push = {}, .turn = {0.0, 1.0, 0.0}}));
}

TEST(Steered, GivesTheSameResultInOneStepAndInMany)
{
    for (const CapRates& rates : {CapRates{{0.7, -0.4, 0.0}, {}},
                                  {{0.0, 0.0, -0.6}, {}},
                                  {{0.0, 0.0, 0.9}, {}},
                                  {{}, {0.3, 0.0, -0.8}}}) {
        ASSERT_TRUE(doesSteer(rates));
        const OrbitCamera once = steered(someCamera(), rates, 0.4, kLimits);
        OrbitCamera often = someCamera();
        for (int i = 0; i < 40; ++i) {
            often = steered(often, rates, 0.01, kLimits);
        }
        EXPECT_NE(once, someCamera());
        EXPECT_LT(length(often.target - once.target), 1e-6);
        EXPECT_NEAR(often.distance_m, once.distance_m, 1e-6);
        EXPECT_NEAR(often.azimuth.radians(), once.azimuth.radians(), 1e-12);
        EXPECT_NEAR(often.tilt.radians(), once.tilt.radians(), 1e-12);
    }
}

TEST(Steered, StaysWithinTheLimitsOfDistanceAndTilt)
{
    EXPECT_EQ(pushed({0.0, 0.0, -1.0}, 100.0).distance_m, kLimits.distance_min_m);
    EXPECT_EQ(pushed({0.0, 0.0, 1.0}, 100.0).distance_m, kLimits.distance_max_m);
    EXPECT_NEAR(turned({1.0, 0.0, 0.0}, 10.0).tilt.degrees(), 85.0, 1e-9);
    EXPECT_EQ(turned({-1.0, 0.0, 0.0}, 10.0).tilt, Angle{});
}

TEST(Steered, RestsInTheDeadZone)
{
    const CapRates nearly{{0.07, -0.08, 0.05}, {-0.06, 0.9, 0.08}};
    EXPECT_FALSE(doesSteer(nearly));
    EXPECT_FALSE(doesTurn(nearly));
    EXPECT_EQ(steered(someCamera(), nearly, 1.0, kLimits), someCamera());
}

} // namespace
} // namespace marsview
