#include "core/view/exaggeration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

TEST(DefaultExaggeration, RaisesPlanetsAndKeepsMountains)
{
    EXPECT_EQ(defaultExaggeration(2.13e7, 2.92e4), 10.0) << "all of Mars";
    EXPECT_EQ(defaultExaggeration(1.4e4, 1.86e3), 1.0) << "a volcano";
    EXPECT_EQ(defaultExaggeration(1e7, 1.0), 20.0) << "all but flat";
}

TEST(DefaultExaggeration, FlattensMapsWithoutScale)
{
    const double degrees_over_meters = defaultExaggeration(360.0, 18000.0);
    EXPECT_LT(degrees_over_meters, 0.01);
    EXPECT_GT(degrees_over_meters, 0.001);
}

TEST(DefaultExaggeration, IsOneForUnknownSizes)
{
    EXPECT_EQ(defaultExaggeration(1e3, 0.0), 1.0);
    EXPECT_EQ(defaultExaggeration(0.0, 0.0), 1.0);
    EXPECT_EQ(defaultExaggeration(0.0, 5.0), 1.0);
    EXPECT_EQ(defaultExaggeration(1e3, std::nan("")), 1.0);
}

TEST(SteppedExaggeration, GoesThroughRoundNumbersAndBack)
{
    EXPECT_EQ(steppedExaggeration(1.0, 1), 1.5);
    EXPECT_EQ(steppedExaggeration(7.0, 1), 10.0);
    EXPECT_EQ(steppedExaggeration(10.0, 1), 15.0);
    EXPECT_DOUBLE_EQ(steppedExaggeration(1.0, -1), 0.7);
    EXPECT_EQ(steppedExaggeration(1.0, 0), 1.0);
    for (int steps = -20; steps <= 20; ++steps) {
        const double there = steppedExaggeration(1.0, steps);
        EXPECT_NEAR(steppedExaggeration(there, -steps), 1.0, 1e-12) << steps;
    }
}

TEST(SteppedExaggeration, RoundsOddFactorsToTheNextRoundOne)
{
    EXPECT_EQ(steppedExaggeration(4.0, 1), 5.0);
    EXPECT_EQ(steppedExaggeration(4.0, -1), 3.0);
}

TEST(ExaggerationRange, ExtendsBeyondUnusualSuitableFactors)
{
    for (const double suitable : {0.1, 0.5, 1.0, 20.0, 100.0}) {
        EXPECT_EQ(exaggerationRange(suitable).least, 0.1) << suitable;
        EXPECT_EQ(exaggerationRange(suitable).most, 100.0) << suitable;
    }
    EXPECT_DOUBLE_EQ(exaggerationRange(0.002).least, 0.0002); // degrees against meters
    EXPECT_EQ(exaggerationRange(0.002).most, 100.0);
    EXPECT_DOUBLE_EQ(exaggerationRange(300.0).most, 3000.0);
}

TEST(Reexaggerated, LooksAtTheSameTerrain)
{
    const OrbitCamera camera{.target = {10.0, 20.0, 300.0}, .distance_m = 1000.0};
    const OrbitCamera after = reexaggerated(camera, 2.0, 10.0);
    EXPECT_DOUBLE_EQ(after.target.z, 1500.0);
    EXPECT_EQ(after.distance_m, camera.distance_m);
}

} // namespace
} // namespace marsview
