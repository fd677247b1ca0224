#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "tests/core/contact/contact_judge.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace marsview {
namespace {

using test::distance;
using test::surfaceOver;

using Model = ProxyGraph<HeightfieldSurface>;

constexpr double kInf = std::numeric_limits<double>::infinity();

test::Findings
wander(const HeightfieldSurface& surface, test::Random& random, int updates, double step_cells)
{
    Model model(surface);
    test::Judge<Model> judge(surface);
    test::judgeWandering(judge, model, surface, random, updates, step_cells);
    return judge.findings();
}

TEST(ProxyGraph, MeetsItsGuaranteesOnEverySyntheticTerrain)
{
    test::Random random;
    test::Findings sum;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        SCOPED_TRACE(name);
        const HeightfieldSurface surface = surfaceOver(terrain);
        for (const double step_cells : {0.1, 1.0, 12.0}) {
            sum.add(wander(surface, random, 3000, step_cells));
        }
    }
    sum.print("synthetic terrains");
    EXPECT_GT(sum.contacts, 0);
}

TEST(ProxyGraph, MeetsItsGuaranteesInShearedFramesAndAtAnyExaggeration)
{
    test::Random random;
    const auto terrain = test::filledTerrain(90, test::fractalHeights(90, 110, 8));
    test::Findings sum;
    for (int i = 0; i < 40; ++i) {
        const auto [frame, cell_m] = test::shearedFrame(*terrain, random, i % 2 == 0);
        const HeightfieldSurface surface(terrain, frame, cell_m * random.uniform(0.1, 20.0));
        sum.add(wander(surface, random, 1500, 2.0));
    }
    sum.print("sheared frames");
    EXPECT_GT(sum.contacts, 0);
}

TEST(ProxyGraph, MeetsItsGuaranteesOnTheBundledMaps)
{
    test::Random random;
    test::Findings sum;
    for (const auto& [name, terrain, frame] : test::bundledMaps()) {
        SCOPED_TRACE(name);
        for (const double exaggeration : {0.1, 1.0, 5.0, 20.0}) {
            const HeightfieldSurface surface(terrain, frame, exaggeration);
            sum.add(wander(surface, random, 4000, 0.5));
            sum.add(wander(surface, random, 4000, 10.0));
        }
    }
    sum.print("bundled maps");
    EXPECT_GT(sum.contacts, 0);
}

TEST(ProxyGraph, EndsLoopsOfFarEdgesInAMinimum)
{
    // Loops need long, thin triangles and luck: a search over six million updates on random
    // terrains in sheared frames found this one.
    const auto terrain =
        test::filledTerrain(3, {-1.21333F, 3.49152F, -0.913293F, 4.44917F, -4.16928F, 3.62006F,
                                2.66074F, 0.927445F, -1.91758F});
    SceneFrame frame = test::unitFrame(*terrain);
    frame.east_per_row = 0.107905;
    frame.north_per_row = -0.118043;
    const HeightfieldSurface surface(terrain, frame, 1.0);
    Model model(surface);
    test::Judge<Model> judge(surface);
    test::Random random;
    for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
        judge.check(model, frame.toScene({random.uniform(0.0, 2.0), random.uniform(0.0, 2.0)},
                                         random.uniform(-18.0, 4.0)));
        judge.check(model, ScenePoint{-0.73034, -0.10105, 0.15222} +
                               Vec3{random.uniform(-0.2, 0.2), random.uniform(-0.02, 0.02),
                                    random.uniform(-0.2, 0.2)});
    }
    judge.findings().print("far-edge loops");
    EXPECT_GT(judge.findings().far_loops, 10);
}

TEST(ProxyGraph, RestsWhileTheGoalRests)
{
    test::Random random;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        SCOPED_TRACE(name);
        const HeightfieldSurface surface = surfaceOver(terrain);
        Model model(surface);
        ScenePoint goal{};
        for (int i = 0; i < 1000; ++i) {
            goal = test::wanderingGoal(random, surface, goal, 5.0);
            const ContactState first = model.update(goal);
            const ContactState second = model.update(goal);
            const ContactState third = model.update(goal);
            ASSERT_NEAR(distance(first.proxy, second.proxy), 0.0,
                        1e-9 * (1.0 + std::abs(first.proxy.z)));
            ASSERT_EQ(second.proxy, third.proxy);
            ASSERT_EQ(first.is_in_contact, second.is_in_contact);
            ASSERT_EQ(second.counters.far_edges, 0U);
        }
    }
}

TEST(ProxyGraph, IsFreeAtTheGoalAboveTheSurface)
{
    const auto terrain = test::filledTerrain(41, test::fractalHeights(41, 41, 1));
    const HeightfieldSurface surface = surfaceOver(terrain);
    Model model(surface);
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const ScenePoint goal{random.uniform(-20, 20), random.uniform(-20, 20), 30.0};
        const ContactState state = model.update(goal);
        EXPECT_FALSE(state.is_in_contact);
        EXPECT_EQ(state.proxy, goal);
        EXPECT_EQ(state.counters.cells, 0U) << "far above, no cell needs a test";
    }
}

TEST(ProxyGraph, RestsStraightAboveTheGoalOnFlatGround)
{
    const auto terrain = test::filledTerrain(41, std::vector<float>(std::size_t{41} * 41, 7.0F));
    Model model(surfaceOver(terrain));
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const ScenePoint goal{random.uniform(-20, 20), random.uniform(-20, 20), 3.0};
        const ContactState state = model.update(goal);
        EXPECT_TRUE(state.is_in_contact);
        EXPECT_NEAR(distance(state.proxy, {goal.x, goal.y, 7.0}), 0.0, 1e-12);
    }
}

std::vector<float> heightsOver(std::size_t side, double (*height)(double x, double y))
{
    std::vector<float> heights;
    const double half = static_cast<double>(side - 1) / 2.0;
    for (std::size_t r = 0; r < side; ++r) {
        for (std::size_t c = 0; c < side; ++c) {
            heights.push_back(static_cast<float>(
                height(static_cast<double>(c) - half, half - static_cast<double>(r))));
        }
    }
    return heights;
}

TEST(ProxyGraph, RestsAtTheFootOfThePerpendicularOnAPlane)
{
    // z = x / 2 - y / 4, whose upward normal is (-1/2, 1/4, 1).
    const auto terrain = test::filledTerrain(
        61, heightsOver(61, [](double x, double y) { return x / 2.0 - y / 4.0; }));
    Model model(surfaceOver(terrain));
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const ScenePoint foot{random.uniform(-25, 25), random.uniform(-25, 25), 0.0};
        const Vec3 on{foot.x, foot.y, foot.x / 2.0 - foot.y / 4.0};
        const ContactState state = model.update(on - Vec3{-0.5, 0.25, 1.0} * random.uniform(0, 4));
        EXPECT_TRUE(state.is_in_contact);
        EXPECT_NEAR(distance(state.proxy, on), 0.0, 1e-11);
    }
}

TEST(ProxyGraph, SlidesDownARidge)
{
    const auto terrain =
        test::filledTerrain(41, heightsOver(41, [](double x, double) { return -std::abs(x); }));
    Model model(surfaceOver(terrain));
    // From (1, -5) the slope z = -x is 4 / √2 away, at (3, -3).
    const ContactState state = model.update({1.0, 4.25, -5.0});
    EXPECT_NEAR(distance(state.proxy, {3.0, 4.25, -3.0}), 0.0, 1e-12);
    EXPECT_TRUE(state.is_in_contact);
    // Below the ridge, on its other side, the proxy cannot follow: the ridge is higher than the
    // foot. It stays on its slope, where it is nearest to the goal.
    const ContactState other = model.update({-1.0, 4.25, -5.0});
    EXPECT_NEAR(distance(other.proxy, {2.0, 4.25, -2.0}), 0.0, 1e-12);
}

TEST(ProxyGraph, StaysInTheBottomOfAValley)
{
    const auto terrain =
        test::filledTerrain(41, heightsOver(41, [](double x, double) { return std::abs(x); }));
    Model model(surfaceOver(terrain));
    // Below the bottom, between the normals of the two slopes.
    const ContactState edge = model.update({1.0, 4.25, -5.0});
    EXPECT_NEAR(distance(edge.proxy, {0.0, 4.25, 0.0}), 0.0, 1e-12);
    EXPECT_EQ(edge.feature, ContactFeature::Edge);
    const ContactState vertex = model.update({1.0, 4.0, -5.0});
    EXPECT_EQ(vertex.proxy, (ScenePoint{0.0, 4.0, 0.0}));
    EXPECT_EQ(vertex.feature, ContactFeature::Vertex);
    // Beyond the normal of the eastern slope, (6.5, 4) is 2.5 / √2 below it.
    const ContactState slope = model.update({6.5, 4.25, 4.0});
    EXPECT_NEAR(distance(slope.proxy, {5.25, 4.25, 5.25}), 0.0, 1e-12);
    EXPECT_EQ(slope.feature, ContactFeature::Face);
}

TEST(ProxyGraph, LeavesTheSurfaceWithTheGoal)
{
    test::Random random;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        SCOPED_TRACE(name);
        const HeightfieldSurface surface = surfaceOver(terrain);
        Model model(surface);
        ScenePoint goal{};
        for (int i = 0; i < 300; ++i) {
            goal = test::wanderingGoal(random, surface, goal, 3.0);
            const ContactState held = model.update(goal);
            const ScenePoint lifted = held.proxy + Vec3{0.0, 0.0, 0.25};
            const ContactState state = model.update(lifted);
            ASSERT_FALSE(state.is_in_contact);
            ASSERT_NEAR(distance(state.proxy, lifted), 0.0, 1e-9);
        }
    }
}

TEST(ProxyGraph, IsPlacedStraightAboveTheFirstGoal)
{
    // Two valleys. The goal is below the ridge between them, slightly on the western side. From
    // there the descent leads west, wherever the model was before.
    const auto terrain = test::filledTerrain(
        41, heightsOver(41, [](double x, double) { return std::abs(std::abs(x) - 5.0); }));
    Model model(surfaceOver(terrain));
    const ContactState first = model.update({-0.25, 2.5, -40.0});
    EXPECT_NEAR(first.proxy.x, -5.0, 1e-12);
    const ContactState again = model.place({0.25, 2.5, -40.0});
    EXPECT_NEAR(again.proxy.x, 5.0, 1e-12);
    EXPECT_FALSE(model.place({0.25, 2.5, 40.0}).is_in_contact);
}

TEST(ProxyGraph, StaysOnTheMapForGoalsOutsideIt)
{
    const auto terrain =
        test::filledTerrain(41, heightsOver(41, [](double x, double) { return -x; }));
    const HeightfieldSurface surface = surfaceOver(terrain);
    Model model(surface);
    const ContactState below = model.update({500.0, 300.0, -200.0});
    EXPECT_EQ(below.proxy, (ScenePoint{20.0, 20.0, -20.0}));
    EXPECT_TRUE(below.is_in_contact);
    const ContactState above = model.update({500.0, 3.0, 10.0});
    EXPECT_EQ(above.proxy, (ScenePoint{20.0, 3.0, 10.0}))
        << "free, at the goal clamped to the grid";
    EXPECT_FALSE(above.is_in_contact);
}

TEST(ProxyGraph, KeepsTheProxyForAnInvalidGoal)
{
    const auto terrain = test::filledTerrain(41, test::fractalHeights(41, 41, 3));
    const HeightfieldSurface surface = surfaceOver(terrain);
    Model model(surface);
    const ContactState unplaced = model.update({kNan, 0.0, 0.0});
    EXPECT_TRUE(unplaced.is_in_contact);
    EXPECT_EQ(unplaced.proxy, surface.point(surface.initialContact()));
    const ContactState held = model.update({1.5, 2.5, -10.0});
    for (const double bad : {kNan, kInf, -kInf}) {
        for (const ScenePoint goal :
             {ScenePoint{bad, 1.0, 1.0}, ScenePoint{1.0, bad, 1.0}, ScenePoint{1.0, 1.0, bad}}) {
            const ContactState state = model.update(goal);
            EXPECT_EQ(state.proxy, held.proxy);
            EXPECT_EQ(state.feature, held.feature);
            EXPECT_EQ(state.counters.vertices + state.counters.faces + state.counters.casts, 0U);
        }
    }
    const ContactState free = model.update({1.5, 2.5, 30.0});
    EXPECT_EQ(model.update({kNan, kNan, kNan}).proxy, free.proxy);
    EXPECT_FALSE(model.update({0.0, 0.0, kInf}).is_in_contact);
}

TEST(ProxyGraph, IsTheSameInRotatedAndMirroredFrames)
{
    const auto terrain = test::filledTerrain(130, test::fractalHeights(130, 97, 4));
    const SceneFrame plain = test::unitFrame(*terrain);
    for (const double exaggeration : {1.0, 5.0}) {
        for (int turn = 0; turn < 8; ++turn) {
            for (const double mirror : {1.0, -1.0}) {
                test::Random random;
                const double angle = 0.77 * turn;
                SceneFrame frame = plain;
                frame.east_per_column = std::cos(angle);
                frame.north_per_column = std::sin(angle);
                frame.east_per_row = mirror * std::sin(angle);
                frame.north_per_row = -mirror * std::cos(angle);
                const HeightfieldSurface one(terrain, plain, exaggeration);
                const HeightfieldSurface two(terrain, frame, exaggeration);
                Model first(one);
                Model second(two);
                ScenePoint goal{};
                for (int i = 0; i < 2000; ++i) {
                    goal = {goal.x + random.uniform(-2.0, 2.0), goal.y + random.uniform(-2.0, 2.0),
                            0.0};
                    const GridPoint grid = plain.toGrid(goal);
                    goal.z = one.height(grid) + random.uniform(-6.0, 1.0);
                    const ContactState a = first.update(goal);
                    const ContactState b = second.update(frame.toScene(grid, goal.z));
                    const GridPoint at_a = plain.toGrid(a.proxy);
                    const GridPoint at_b = frame.toGrid(b.proxy);
                    ASSERT_NEAR(at_a.column, at_b.column, 1e-9) << i;
                    ASSERT_NEAR(at_a.row, at_b.row, 1e-9);
                    ASSERT_NEAR(a.proxy.z, b.proxy.z, 1e-9);
                    ASSERT_EQ(a.is_in_contact, b.is_in_contact);
                }
            }
        }
    }
}

TEST(ProxyGraph, MovesWithTheSurfaceWhenTheExaggerationChanges)
{
    const auto terrain = test::filledTerrain(
        41, heightsOver(41, [](double x, double y) { return 10.0 + x / 2.0 - y / 4.0; }));
    Model model(surfaceOver(terrain));
    const ScenePoint at = model.update({1.25, 2.5, 9.0}).proxy;
    model.setSurface(surfaceOver(terrain, 3.0));
    const ContactState kept = model.update({kNan, kNan, kNan});
    EXPECT_TRUE(kept.is_in_contact);
    EXPECT_NEAR(distance(kept.proxy, {at.x, at.y, 3.0 * at.z}), 0.0, 1e-12);
    // Free: it stays where it is, unless the surface rises above it.
    model.update({0.0, 0.0, 40.0});
    model.setSurface(surfaceOver(terrain, 3.5));
    EXPECT_EQ(model.update({kNan, 0, 0}).proxy, (ScenePoint{0.0, 0.0, 40.0}));
    model.setSurface(surfaceOver(terrain, 5.0));
    const ContactState raised = model.update({kNan, 0, 0});
    EXPECT_TRUE(raised.is_in_contact);
    EXPECT_EQ(raised.proxy, (ScenePoint{0.0, 0.0, 50.0}));
}

} // namespace
} // namespace marsview
