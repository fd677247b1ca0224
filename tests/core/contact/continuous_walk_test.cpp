#include "core/contact/continuous_walk.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/surface_walk.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace marsview {
namespace {

using test::distance;
using test::surfaceOver;

using Model = ContinuousWalk<HeightfieldSurface>;

std::shared_ptr<const FilledHeightfield> terrainOf(double (*height)(double x, double y))
{
    std::vector<float> heights;
    for (int r = 0; r < 41; ++r) {
        for (int c = 0; c < 41; ++c) {
            heights.push_back(static_cast<float>(height(c - 20.0, 20.0 - r)));
        }
    }
    return test::filledTerrain(41, heights);
}

// ContinuousWalk::setSurface: what PointProxy::setSurface promises, with closed forms.

TEST(ContinuousWalk, DescendsAgainInContactWhenTheExaggerationChanges)
{
    const auto terrain = terrainOf([](double x, double y) { return 10.0 + x / 2.0 - y / 4.0; });
    Model model(surfaceOver(terrain));
    const ScenePoint at = model.update({1.25, 2.5, 9.0}).proxy;
    model.setSurface(surfaceOver(terrain, 3.0));
    const ContactState kept = model.update({kNan, kNan, kNan});
    EXPECT_TRUE(kept.is_in_contact);
    EXPECT_NEAR(distance(kept.proxy, {at.x, at.y, 3.0 * at.z}), 0.0, 1e-12);
    // The foot of the goal on z = 30 + 1.5 x - 0.75 y, whose normal is (-1.5, 0.75, 1).
    const Vec3 normal{-1.5, 0.75, 1.0};
    const ScenePoint goal{1.25, 2.5, 27.0};
    const double below = 30.0 + 1.5 * goal.x - 0.75 * goal.y - goal.z;
    EXPECT_NEAR(distance(model.update(goal).proxy, goal + normal * (below / dot(normal, normal))),
                0.0, 1e-11);
}

// In contact the proxy keeps its place on the mesh: in the western of two valleys, also below a
// goal that has passed under the ridge between them. To go there, it would first have to climb: the
// slope beside it rises along (1, 0, 1), and the goal is at (5.25, 0, -40) from it.
TEST(ContinuousWalk, KeepsItsBasinWhenTheExaggerationChanges)
{
    const auto terrain = terrainOf([](double x, double) { return std::abs(std::abs(x) - 5.0); });
    Model model(surfaceOver(terrain));
    model.update({-0.25, 2.5, -40.0});
    ASSERT_NEAR(distance(model.update({0.25, 2.5, -40.0}).proxy, {-5.0, 2.5, 0.0}), 0.0, 1e-12);
    model.setSurface(surfaceOver(terrain, 2.0));
    EXPECT_NEAR(distance(model.update({0.25, 2.5, -40.0}).proxy, {-5.0, 2.5, 0.0}), 0.0, 1e-12);
}

TEST(ContinuousWalk, AFreeProxyMovesOnlyIfTheSurfaceRisesAboveIt)
{
    const auto terrain = terrainOf([](double x, double y) { return 10.0 + x / 2.0 - y / 4.0; });
    Model model(surfaceOver(terrain));
    model.setSurface(surfaceOver(terrain, 2.0)); // before it was placed
    EXPECT_EQ(model.update({0.0, 0.0, 40.0}).proxy, (ScenePoint{0.0, 0.0, 40.0}));
    model.setSurface(surfaceOver(terrain, 3.5));
    const ContactState free = model.update({kNan, 0.0, 0.0});
    EXPECT_FALSE(free.is_in_contact);
    EXPECT_EQ(free.proxy, (ScenePoint{0.0, 0.0, 40.0}));
    EXPECT_FALSE(model.contact());
    model.setSurface(surfaceOver(terrain, 5.0));
    const ContactState raised = model.update({kNan, 0.0, 0.0});
    EXPECT_TRUE(raised.is_in_contact);
    EXPECT_EQ(raised.proxy, (ScenePoint{0.0, 0.0, 50.0}));
}

// What defines the model: its proxies are those of a walk whose updates become ever shorter. Where
// the two differ, the walk's next update often still decides between two basins.
TEST(ContinuousWalk, IsTheLimitOfEverShorterUpdates)
{
    const auto terrain = test::filledTerrain(90, test::fractalHeights(90, 90, 12));
    for (const double exaggeration : {1.0, 5.0}) {
        const HeightfieldSurface surface = surfaceOver(terrain, exaggeration);
        Model model(surface);
        SurfaceWalk<HeightfieldSurface> walk(surface);
        test::Random random;
        ScenePoint goal{0.0, 0.0, 0.0};
        constexpr int kUpdates = 400;
        int differ = 0;
        for (int i = 0; i < kUpdates; ++i) {
            const ScenePoint from = goal;
            goal.x = std::clamp(from.x + random.uniform(-4.0, 4.0), -40.0, 40.0);
            goal.y = std::clamp(from.y + random.uniform(-4.0, 4.0), -40.0, 40.0);
            goal.z = surface.height(surface.frame().toGrid(goal)) +
                     exaggeration * random.uniform(-3.0, 0.3);
            constexpr int kPieces = 500;
            for (int piece = 1; piece < kPieces; ++piece) {
                walk.update(from + (goal - from) * (static_cast<double>(piece) / kPieces));
            }
            const ScenePoint limit = walk.update(goal).proxy;
            differ += distance(model.update(goal).proxy, limit) > 1e-6 ? 1 : 0;
        }
        std::printf("exaggeration %g: %d of %d updates differ\n", exaggeration, differ, kUpdates);
        EXPECT_LE(differ, kUpdates / 100);
    }
}

// The same where every edge is a ridge or a valley: where on its ridge a fall begins can decide
// between two basins.
TEST(ContinuousWalk, FallsFromRidgesOfNoiseAsItsLimitDoes)
{
    for (const double relief_m : {0.3, 1.0}) {
        test::Random random;
        std::vector<float> heights(60 * 60);
        for (float& height : heights) {
            height = static_cast<float>(random.uniform(-relief_m, relief_m));
        }
        const HeightfieldSurface surface = surfaceOver(test::filledTerrain(60, heights));
        Model model(surface);
        SurfaceWalk<HeightfieldSurface> walk(surface);
        ScenePoint goal{0.0, 0.0, 0.0};
        constexpr int kUpdates = 20000;
        int differ = 0;
        for (int i = 0; i < kUpdates; ++i) {
            const ScenePoint from = goal;
            goal.x = std::clamp(from.x + random.uniform(-1.0, 1.0), -25.0, 25.0);
            goal.y = std::clamp(from.y + random.uniform(-1.0, 1.0), -25.0, 25.0);
            goal.z =
                surface.height(surface.frame().toGrid(goal)) + relief_m * random.uniform(-3.0, 0.1);
            constexpr int kPieces = 100;
            for (int piece = 1; piece < kPieces; ++piece) {
                walk.update(from + (goal - from) * (static_cast<double>(piece) / kPieces));
            }
            const ScenePoint limit = walk.update(goal).proxy;
            if (distance(model.update(goal).proxy, limit) > 1e-6) {
                ++differ;
                model.place(goal);
                walk.place(goal);
            }
        }
        std::printf("relief %g m: %d of %d updates differ\n", relief_m, differ, kUpdates);
        EXPECT_LE(differ, kUpdates / 5000);
    }
}

} // namespace
} // namespace marsview
