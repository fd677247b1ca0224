#include "haptics/interaction/zoom_detents.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

constexpr ZoomOptions kOptions{
    .meters_per_doubling = 0.04, .detents_per_doubling = 2.0, .detent_n_per_m = 50.0};

TEST(ZoomDetents, LiftingTheHandEnlarges)
{
    EXPECT_NEAR(zoomFactor(kOptions, 0.04), 2.0, 1e-12);
    EXPECT_NEAR(zoomFactor(kOptions, -0.08), 0.25, 1e-12);
    EXPECT_EQ(zoomFactor(kOptions, 0.0), 1.0);
}

TEST(ZoomDetents, AreWhereTheZoomIsAPowerOfTheRootOfTwo)
{
    for (int i = -20; i <= 20; ++i) {
        EXPECT_NEAR(aboveDetent(kOptions, std::exp2(0.5 * i)), 0.0, 1e-12);
    }
    // A device that has risen by 3 mm from a detent is 3 mm above it.
    EXPECT_NEAR(aboveDetent(kOptions, 1024.0 / zoomFactor(kOptions, 0.003)), 0.003, 1e-12);
}

TEST(ZoomDetents, PullTowardsTheNearestWeaklyAndLinearly)
{
    EXPECT_EQ(detentForce(kOptions, 0.0), 0.0);
    EXPECT_NEAR(detentForce(kOptions, 0.002), -0.1, 1e-12);
    EXPECT_NEAR(detentForce(kOptions, -0.004), 0.2, 1e-12);
    for (double above_m = 1e-4; above_m < 0.0099; above_m += 1e-4) {
        EXPECT_LT(detentForce(kOptions, above_m), 0.0);
        EXPECT_EQ(detentForce(kOptions, -above_m), -detentForce(kOptions, above_m));
        EXPECT_LE(std::abs(detentForce(kOptions, above_m)), 0.25 + 1e-12);
    }
}

// The device rises through several detents: the force has no step, not even halfway between them.
TEST(ZoomDetents, AreContinuousAndConservative)
{
    constexpr double kStepM = 1e-6;
    double last_n = 0.0;
    double work_j = 0.0;
    for (int i = 1; i <= 200'000; ++i) { // ten detents of 20 mm
        const double rise_m = i * kStepM;
        const double force_n =
            detentForce(kOptions, aboveDetent(kOptions, 1.0 / zoomFactor(kOptions, rise_m)));
        ASSERT_LE(std::abs(force_n - last_n), kOptions.detent_n_per_m * kStepM * 1.01) << rise_m;
        work_j += 0.5 * (force_n + last_n) * kStepM;
        last_n = force_n;
    }
    EXPECT_NEAR(work_j, 0.0, 1e-9); // from detent to detent
}

TEST(ZoomDetents, AreTheStableRestsAndHalfWayIsTheUnstableOne)
{
    const auto forceAt = [](double rise_m) {
        return detentForce(kOptions, aboveDetent(kOptions, 1.0 / zoomFactor(kOptions, rise_m)));
    };
    for (int i = 0; i < 10; ++i) {
        EXPECT_GT(forceAt(0.02 * i - 1e-3), 0.0);
        EXPECT_LT(forceAt(0.02 * i + 1e-3), 0.0);
        EXPECT_LT(forceAt(0.02 * i + 0.01 - 1e-3), 0.0);
        EXPECT_GT(forceAt(0.02 * i + 0.01 + 1e-3), 0.0);
    }
}

} // namespace
} // namespace marsview::test
