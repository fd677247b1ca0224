#include "haptics/drivers/simulated/simulated_hand.h"
#include "tests/haptics/tick_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

TEST(SimulatedHand, OscillatesAsAMassOnASpring)
{
    // m = 0.1 kg, k = 40 N/m: 20 rad/s. Released 10 mm from its rest.
    SimulatedHand hand(
        {.mass_kg = 0.1, .damping_n_s_per_m = 0.0, .grip_n_per_m = 40.0, .grip_n_s_per_m = 0.0},
        {0.01, 0.0, 0.0});
    hand.aimAt({});
    double worst_m = 0.0;
    for (int i = 1; i <= 1000; ++i) {
        hand.advance(kDt);
        worst_m = std::max(worst_m, std::abs(hand.position().x - 0.01 * std::cos(20.0 * i * kDt)));
    }
    EXPECT_LT(worst_m, 5e-4); // implicit steps of 0.1 ms lose 2 % of the energy per second
}

TEST(SimulatedHand, GivesWayToAForceAsItsGripDoes)
{
    SimulatedHand hand({.grip_n_per_m = 200.0});
    hand.push({0.0, 0.0, 1.0});
    for (int i = 0; i < 3000; ++i) {
        hand.advance(kDt);
    }
    EXPECT_NEAR(hand.position().z, 0.005, 1e-6); // 1 N / 200 N/m
    EXPECT_NEAR(length(hand.velocity()), 0.0, 1e-6);
}

TEST(SimulatedHand, FeelsAForceAfterItsDelayAndNotBefore)
{
    SimulatedHand hand({.delay_s = 0.003});
    hand.push({1.0, 0.0, 0.0});
    for (int i = 0; i < 3; ++i) {
        hand.advance(kDt);
        EXPECT_EQ(hand.position().x, 0.0) << i;
    }
    hand.advance(kDt);
    EXPECT_GT(hand.position().x, 0.0);
}

TEST(SimulatedHand, TellsPositionsInStepsOfItsEncoder)
{
    SimulatedHand hand({.encoder_m = 1e-4}, {0.00123, -0.00049, 0.00051});
    EXPECT_NEAR(hand.measured().x, 0.0012, 1e-12);
    EXPECT_NEAR(hand.measured().y, -0.0005, 1e-12);
    EXPECT_NEAR(hand.measured().z, 0.0005, 1e-12);
}

TEST(SimulatedHand, IsTheSameForTheSameSeedAndAnotherForAnother)
{
    const auto endOf = [](std::uint64_t seed) {
        SimulatedHand hand({.tremor_m = 1e-3, .seed = seed});
        for (int i = 0; i < 500; ++i) {
            hand.advance(kDt);
        }
        return hand.position();
    };
    EXPECT_EQ(endOf(3), endOf(3));
    EXPECT_FALSE(endOf(3) == endOf(4));
}

TEST(SimulatedHand, TrembleStaysNearItsAim)
{
    SimulatedHand hand({.tremor_m = 1e-4});
    double most_m = 0.0;
    for (int i = 0; i < 5000; ++i) {
        hand.advance(kDt);
        most_m = std::max(most_m, std::abs(hand.position().x));
    }
    EXPECT_GT(most_m, 1e-5);
    EXPECT_LT(most_m, 3e-4);
}

TEST(SimulatedHand, LosesEnergyWhenNobodyPushes)
{
    SimulatedHand hand({}, {0.02, -0.01, 0.03});
    hand.aimAt({});
    double last_j = hand.energyJ();
    EXPECT_GT(last_j, 0.0);
    for (int i = 0; i < 2000; ++i) {
        hand.advance(kDt);
        EXPECT_LE(hand.energyJ(), last_j * (1.0 + 1e-12));
        last_j = hand.energyJ();
    }
    EXPECT_LT(last_j, 1e-6);
}

} // namespace
} // namespace marsview::test
