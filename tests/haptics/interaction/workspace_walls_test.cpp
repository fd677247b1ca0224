#include "haptics/interaction/workspace_walls.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

constexpr WorkspaceBox kBox{{-0.08, -0.06, -0.05}, {0.08, 0.06, 0.05}};
constexpr double kStiffness = 500.0;

TEST(WorkspaceWalls, NothingIsFeltInTheMiddle)
{
    const WallContact walls = wallsAt(kBox, {0.0, 0.0, 0.0}, kStiffness);
    EXPECT_EQ(walls.force_n, Vec3{});
    EXPECT_EQ(walls.ground_share, 1.0);
}

TEST(WorkspaceWalls, PushBackStraightAndLevel)
{
    const WallContact walls = wallsAt(kBox, {0.083, -0.064, 0.2}, kStiffness);
    EXPECT_NEAR(walls.force_n.x, -1.5, 1e-12); // 3 mm of 500 N/m
    EXPECT_NEAR(walls.force_n.y, 2.0, 1e-12);
    EXPECT_EQ(walls.force_n.z, 0.0);
    EXPECT_NEAR(walls.penetration_m, 0.005, 1e-12);
}

TEST(WorkspaceWalls, TheTerrainForceFadesOutBeforeAWallPushes)
{
    Random random;
    for (int i = 0; i < 100'000; ++i) {
        const WorkspacePoint hand{random.uniform(-0.1, 0.1), random.uniform(-0.08, 0.08), 0.0};
        const WallContact walls = wallsAt(kBox, hand, kStiffness);
        EXPECT_GE(walls.ground_share, 0.0);
        EXPECT_LE(walls.ground_share, 1.0);
        EXPECT_TRUE(walls.ground_share == 0.0 || walls.force_n == Vec3{});
    }
}

TEST(WorkspaceWalls, BothAreContinuousAndTheFadeIsLinear)
{
    constexpr double kStepM = 1e-6;
    for (double x = -0.1; x < 0.1; x += kStepM * 7.3) {
        const WallContact a = wallsAt(kBox, {x, 0.055, 0.0}, kStiffness);
        const WallContact b = wallsAt(kBox, {x + kStepM, 0.055, 0.0}, kStiffness);
        EXPECT_LE(length(b.force_n - a.force_n), kStiffness * kStepM * 1.001);
        EXPECT_LE(std::abs(b.ground_share - a.ground_share), kStepM / kWallFadeM * 1.001);
    }
    const double half = wallsAt(kBox, {0.08 - 0.5 * kWallFadeM, 0.0, 0.0}, kStiffness).ground_share;
    EXPECT_NEAR(half, 0.5, 1e-9);
}

TEST(WorkspaceWalls, TheReachableAreaHasTheFullTerrainForce)
{
    const WorkspaceBox reach = reachWithin(kBox);
    for (const WorkspacePoint& corner :
         {WorkspacePoint{reach.low.x, reach.low.y, 0.0}, {reach.high.x, reach.high.y, 0.0}}) {
        EXPECT_NEAR(wallsAt(kBox, corner, kStiffness).ground_share, 1.0, 1e-9);
    }
    EXPECT_EQ(reach.low.z, kBox.low.z);
}

// The fade of 8 mm on both sides would leave nothing of 16 mm.
TEST(WorkspaceWalls, OfANarrowWorkspaceTheMiddleHalfIsReachable)
{
    const WorkspaceBox reach = reachWithin({{0.10, -0.03, -0.05}, {0.11, 0.03, 0.05}});
    EXPECT_NEAR(reach.low.x, 0.1025, 1e-12);
    EXPECT_NEAR(reach.high.x, 0.1075, 1e-12);
    EXPECT_NEAR(reach.low.y, -0.03 + kWallFadeM, 1e-12);
    EXPECT_NEAR(reach.high.y, 0.03 - kWallFadeM, 1e-12);
}

TEST(WorkspaceWalls, ADeviceWithoutAnExtentHasNoWalls)
{
    const WallContact walls = wallsAt({}, {0.3, -0.2, 0.1}, kStiffness);
    EXPECT_EQ(walls.force_n, Vec3{});
    EXPECT_EQ(walls.ground_share, 1.0);
}

} // namespace
} // namespace marsview::test
