#include "core/contact/god_object.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace marsview {
namespace {

using test::distance;
using test::surfaceOver;

using Model = GodObject<HeightfieldSurface>;

constexpr auto kKept = GodObjectConstraints::Kept;
constexpr auto kReleased = GodObjectConstraints::Released;

// Every instantiation, for all sample types.
static_assert(noexcept(
    std::declval<GodObject<PlainHeightfieldSurface<std::int16_t>>&>().update(ScenePoint{})));
static_assert(
    noexcept(std::declval<GodObject<PlainHeightfieldSurface<float>>&>().update(ScenePoint{})));

// Terrain that is constant along y: a cross section as in the paper's figures.
std::vector<float> heightsOver(std::size_t side, double (*height)(double x))
{
    std::vector<float> heights;
    const double half = static_cast<double>(side - 1) / 2.0;
    for (std::size_t r = 0; r < side; ++r) {
        for (std::size_t c = 0; c < side; ++c) {
            heights.push_back(static_cast<float>(height(static_cast<double>(c) - half)));
        }
    }
    return heights;
}

struct Tally {
    long updates = 0;
    long contacts = 0;
    long floats = 0;
    long casts = 0;
    long faces = 0;
    long cut_short = 0;
    long not_minimal = 0;
    double worst_cosine = 0.0;
    double worst_growth_m = 0.0;

    void add(const Tally& other)
    {
        updates += other.updates;
        contacts += other.contacts;
        floats += other.floats;
        casts += other.casts;
        faces += other.faces;
        cut_short += other.cut_short;
        not_minimal += other.not_minimal;
        worst_cosine = std::max(worst_cosine, other.worst_cosine);
        worst_growth_m = std::max(worst_growth_m, other.worst_growth_m);
    }
    void print(const std::string& name) const
    {
        const double n = static_cast<double>(std::max(contacts, 1L));
        std::printf(
            "%s: %ld updates, %ld in contact, %ld floating; %.2f faces, %.2f casts a "
            "contact; %ld not minimal, %ld cut short (worst cosine %.2g, growth %.2g m)\n",
            name.c_str(), updates, contacts, floats, static_cast<double>(faces) / n,
            static_cast<double>(casts) / n, not_minimal, cut_short, worst_cosine, worst_growth_m);
    }
};

// The largest step between neighboring samples, in scene meters.
double steepnessOf(const HeightfieldSurface& surface)
{
    const FilledHeightfield& terrain = *surface.terrain();
    double step = 0.0;
    for (std::size_t r = 0; r + 1 < terrain.rows(); ++r) {
        for (std::size_t c = 0; c + 1 < terrain.columns(); ++c) {
            const CellHeights z = terrain.cell(c, r);
            step = std::max(
                {step, std::abs(z.upper_right - z.upper_left),
                 std::abs(z.lower_left - z.upper_left), std::abs(z.lower_right - z.upper_left),
                 std::abs(z.lower_right - z.upper_right), std::abs(z.lower_right - z.lower_left)});
        }
    }
    return step * surface.exaggeration();
}

// Checks one update against all required properties.
class Judge {
public:
    Judge(const HeightfieldSurface& surface, GodObjectConstraints constraints)
        : surface_(surface)
        , is_released_(constraints == kReleased)
        , steepness_(steepnessOf(surface))
    {}

    void check(Model& model, const ScenePoint& goal)
    {
        const ContactState state = model.update(goal);
        const ScenePoint seen = test::clampedGoal(surface_, goal);
        const double to_goal = distance(state.proxy, seen);
        const GridPoint grid = surface_.frame().toGrid(state.proxy);
        const double height = test::bruteHeight(surface_, grid);
        const double tolerance = 1e-9 * (1.0 + std::abs(height)) + 1e-11 * steepness_;
        ++tally_.updates;
        tally_.casts += state.counters.casts;
        tally_.faces += state.counters.faces;
        tally_.cut_short += state.counters.cut_short;
        ASSERT_GE(state.proxy.z, height - tolerance) << "below the surface";
        EXPECT_EQ(state.is_in_contact, state.feature != ContactFeature::Free);
        if (!state.is_in_contact) {
            ASSERT_TRUE(state.proxy == seen || to_goal < 1e-9 * (1.0 + std::abs(height)));
        } else if (model.contact()) {
            ++tally_.contacts;
            ASSERT_NEAR(state.proxy.z, height, tolerance) << "off the surface";
        } else {
            ++tally_.contacts;
            ++tally_.floats;
            ASSERT_FALSE(is_released_) << "floats";
        }
        if (is_released_ && state.is_in_contact) {
            const double cosine = to_goal < 1e-9 * (1.0 + std::abs(height))
                                      ? 0.0
                                      : test::steepestCosine(surface_, state.proxy, seen);
            tally_.worst_cosine = std::max(tally_.worst_cosine, cosine);
            if (cosine > 1e-6 + 1e-12 * steepness_ / to_goal) {
                ++tally_.not_minimal;
                ADD_FAILURE() << "cosine " << cosine << " at " << grid.column << ", " << grid.row
                              << ", feature " << static_cast<int>(state.feature) << ", goal "
                              << surface_.frame().toGrid(seen).column << ", "
                              << surface_.frame().toGrid(seen).row << ", " << seen.z << " m, proxy "
                              << state.proxy.z << " m";
            }
        }
        // Section 3.4 of the paper: the distance grows by no more than the goal moves.
        if (has_last_) {
            const double growth = (to_goal - last_distance_) - distance(seen, last_goal_);
            tally_.worst_growth_m = std::max(tally_.worst_growth_m, growth);
            ASSERT_LE(growth, 1e-9 * (1.0 + to_goal));
        }
        has_last_ = true;
        last_goal_ = seen;
        last_distance_ = to_goal;
    }
    const Tally& tally() const { return tally_; }

private:
    const HeightfieldSurface& surface_;
    bool is_released_;
    double steepness_;
    Tally tally_;
    ScenePoint last_goal_;
    double last_distance_ = 0.0;
    bool has_last_ = false;
};

Tally wander(const HeightfieldSurface& surface,
             GodObjectConstraints constraints,
             test::Random& random,
             int updates,
             double step_cells)
{
    Model model(surface, constraints);
    Judge judge(surface, constraints);
    test::judgeWandering(judge, model, surface, random, updates, step_cells);
    return judge.tally();
}

class GodObjectTest : public testing::TestWithParam<GodObjectConstraints> {};

std::string nameOf(GodObjectConstraints constraints)
{
    return constraints == kKept ? "Kept" : "Released";
}

INSTANTIATE_TEST_SUITE_P(Constraints,
                         GodObjectTest,
                         testing::Values(kKept, kReleased),
                         [](const auto& test) { return nameOf(test.param); });

TEST_P(GodObjectTest, MeetsItsGuaranteesOnEverySyntheticTerrain)
{
    test::Random random;
    Tally sum;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        SCOPED_TRACE(name);
        const HeightfieldSurface surface = surfaceOver(terrain);
        for (const double step_cells : {0.1, 1.0, 12.0}) {
            sum.add(wander(surface, GetParam(), random, 2000, step_cells));
        }
    }
    sum.print("synthetic terrains, " + nameOf(GetParam()));
    EXPECT_EQ(sum.not_minimal, 0);
    EXPECT_EQ(sum.cut_short, 0);
}

TEST_P(GodObjectTest, MeetsItsGuaranteesInShearedFramesAndAtAnyExaggeration)
{
    test::Random random;
    const auto terrain = test::filledTerrain(90, test::fractalHeights(90, 110, 8));
    Tally sum;
    for (int i = 0; i < 40; ++i) {
        const auto [frame, cell_m] = test::shearedFrame(*terrain, random, i % 2 == 0);
        const HeightfieldSurface surface(terrain, frame, cell_m * random.uniform(0.1, 20.0));
        sum.add(wander(surface, GetParam(), random, 1000, 2.0));
    }
    sum.print("sheared frames, " + nameOf(GetParam()));
    EXPECT_EQ(sum.not_minimal, 0);
    EXPECT_EQ(sum.cut_short, 0);
}

TEST_P(GodObjectTest, MeetsItsGuaranteesOnTheBundledMaps)
{
    test::Random random;
    Tally sum;
    for (const auto& [name, terrain, frame] : test::bundledMaps()) {
        SCOPED_TRACE(name);
        for (const double exaggeration : {0.1, 1.0, 5.0, 20.0}) {
            const HeightfieldSurface surface(terrain, frame, exaggeration);
            sum.add(wander(surface, GetParam(), random, 3000, 0.5));
            sum.add(wander(surface, GetParam(), random, 3000, 10.0));
        }
    }
    sum.print("bundled maps, " + nameOf(GetParam()));
    EXPECT_EQ(sum.not_minimal, 0);
    EXPECT_EQ(sum.cut_short, 0);
}

// Figure 3: one constraint. From 1 toward the goal, against the surface at 2, along it to 3.
TEST_P(GodObjectTest, SlidesToTheFootOfTheGoalOnAPlane)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, [](double x) { return 0.5 * x; }));
    Model model(surfaceOver(terrain), GetParam());
    const ContactState one = model.update({-3.0, 0.25, 5.0});
    EXPECT_FALSE(one.is_in_contact);
    EXPECT_EQ(one.proxy, (ScenePoint{-3.0, 0.25, 5.0}));
    // The foot of the goal on the plane x = 2 z, whose normal is (-1, 0, 2).
    const Vec3 three{4.0, 0.25, 2.0};
    const ContactState at = model.update(three - Vec3{-1.0, 0.0, 2.0} * 1.5);
    EXPECT_TRUE(at.is_in_contact);
    EXPECT_NEAR(distance(at.proxy, three), 0.0, 1e-12);
    EXPECT_GE(at.counters.casts, 2U) << "one to the surface, one along it";
}

// Figure 4a: the surface slopes away from the constraint. West of the ridge at x = 0 it is level.
double awayFromTheRidge(double x)
{
    return x <= 0.0 ? 0.0 : -x;
}

TEST(GodObject, FloatsBeyondARidgeWhileConstraintsAreKept)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, awayFromTheRidge));
    Model model(surfaceOver(terrain), kKept);
    model.update({-3.25, 0.25, -1.0});
    const ContactState two = model.update({3.25, 0.25, -6.0});
    EXPECT_NEAR(distance(two.proxy, {3.25, 0.25, 0.0}), 0.0, 1e-12) << "on the level plane";
    EXPECT_TRUE(two.is_in_contact) << "not at the goal";
    EXPECT_EQ(two.feature, ContactFeature::Face) << "held by one plane";
    EXPECT_FALSE(model.contact());
    EXPECT_GT(two.proxy.z, awayFromTheRidge(3.25) + 3.0) << "off the surface";
    // The next update starts without constraints.
    const ContactState three = model.update({3.25, 0.25, -6.0});
    EXPECT_NEAR(distance(three.proxy, {4.625, 0.25, -4.625}), 0.0, 1e-12);
    EXPECT_TRUE(model.contact());
}

TEST(GodObject, FollowsTheSurfaceBeyondARidgeOnceConstraintsAreReleased)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, awayFromTheRidge));
    Model model(surfaceOver(terrain), kReleased);
    model.update({-3.25, 0.25, -1.0});
    const ContactState three = model.update({3.25, 0.25, -6.0});
    EXPECT_NEAR(distance(three.proxy, {4.625, 0.25, -4.625}), 0.0, 1e-12);
}

// Figure 4b: the surface slopes toward the constraint. East of the valley at x = 0 it rises.
double upFromTheValley(double x)
{
    return x <= 0.0 ? 0.0 : 0.5 * x;
}

TEST(GodObject, SticksInAValleyWhileConstraintsAreKept)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, upFromTheValley));
    Model model(surfaceOver(terrain), kKept);
    model.update({-3.25, 0.25, -1.0});
    const Vec3 foot{4.25, 0.25, 2.125};
    const ScenePoint goal = foot - Vec3{-1.0, 0.0, 2.0} * 1.5; // also below the level plane
    const ContactState two = model.update(goal);
    EXPECT_NEAR(distance(two.proxy, {0.0, 0.25, 0.0}), 0.0, 1e-12) << "in the valley";
    EXPECT_NEAR(distance(model.update(goal).proxy, foot), 0.0, 1e-12);
}

TEST(GodObject, ContinuesUpAValleyOnceConstraintsAreReleased)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, upFromTheValley));
    Model model(surfaceOver(terrain), kReleased);
    model.update({-3.25, 0.25, -1.0});
    const Vec3 foot{4.25, 0.25, 2.125};
    EXPECT_NEAR(distance(model.update(foot - Vec3{-1.0, 0.0, 2.0} * 1.5).proxy, foot), 0.0, 1e-12);
}

TEST(GodObject, RestsInAPitOfThreeConstraints)
{
    const auto terrain =
        test::filledTerrain(41, heightsOver(41, [](double x) { return std::abs(x); }));
    for (const auto constraints : {kKept, kReleased}) {
        Model model(surfaceOver(terrain), constraints);
        // Two: along the valley to the foot of the goal on its line.
        model.update({0.5, 3.75, -1.0});
        const ContactState line = model.update({0.25, -2.75, -5.0});
        EXPECT_NEAR(distance(line.proxy, {0.0, -2.75, 0.0}), 0.0, 1e-12);
        EXPECT_TRUE(line.is_in_contact);
    }
    const auto pit =
        test::filledTerrain(3, {1.0F, 1.0F, 1.0F, 1.0F, -1.0F, 1.0F, 1.0F, 1.0F, 1.0F});
    for (const auto constraints : {kKept, kReleased}) {
        Model model(surfaceOver(pit), constraints);
        ContactState state = model.update({0.3, -0.4, -9.0});
        for (int i = 0; i < 8; ++i) {
            state = model.update({0.1, -0.05, -9.0});
        }
        EXPECT_NEAR(distance(state.proxy, {0.0, 0.0, -1.0}), 0.0, 1e-12) << nameOf(constraints);
    }
}

TEST_P(GodObjectTest, StaysWithinTheBorderOfTheMap)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, [](double x) { return -x; }));
    Model model(surfaceOver(terrain), GetParam());
    ContactState state = model.update({0.0, 0.0, -2.0});
    for (int i = 0; i < 60; ++i) {
        state = model.update({500.0, 300.0, -200.0});
    }
    EXPECT_NEAR(distance(state.proxy, {20.0, 20.0, -20.0}), 0.0, 1e-9);
    EXPECT_TRUE(state.is_in_contact);
    const ContactState above = model.update({500.0, 3.0, 10.0});
    EXPECT_EQ(above.proxy, (ScenePoint{20.0, 3.0, 10.0}));
    EXPECT_FALSE(above.is_in_contact);
}

TEST_P(GodObjectTest, KeepsTheProxyForAnInvalidGoal)
{
    const auto terrain = test::filledTerrain(41, test::fractalHeights(41, 41, 3));
    const HeightfieldSurface surface = surfaceOver(terrain);
    Model model(surface, GetParam());
    const ContactState unplaced = model.update({kNan, 0.0, 0.0});
    EXPECT_EQ(unplaced.proxy, surface.point(surface.initialContact()));
    EXPECT_EQ(unplaced.counters.refused, 1U);
    const ContactState held = model.update({1.5, 2.5, -10.0});
    for (const double bad : {kNan, std::numeric_limits<double>::infinity(), -1e300}) {
        const ContactState state = model.update({1.0, 1.0, bad});
        EXPECT_EQ(state.proxy, held.proxy);
        EXPECT_EQ(state.feature, held.feature);
        EXPECT_EQ(state.counters.refused, 1U);
        EXPECT_EQ(state.counters.casts, 0U);
    }
}

TEST_P(GodObjectTest, MovesWithTheSurfaceWhenTheExaggerationChanges)
{
    const auto terrain =
        test::filledTerrain(41, heightsOver(41, [](double x) { return 10.0 + x / 2.0; }));
    Model model(surfaceOver(terrain), GetParam());
    const ScenePoint at = model.update({1.25, 2.5, 9.0}).proxy;
    model.setSurface(surfaceOver(terrain, 3.0));
    const ContactState kept = model.update({kNan, kNan, kNan});
    EXPECT_TRUE(kept.is_in_contact);
    EXPECT_NEAR(distance(kept.proxy, {at.x, at.y, 3.0 * at.z}), 0.0, 1e-12);
    model.update({0.0, 0.0, 40.0});
    model.setSurface(surfaceOver(terrain, 5.0));
    EXPECT_EQ(model.update({kNan, 0, 0}).proxy, (ScenePoint{0.0, 0.0, 50.0}));
}

TEST(GodObject, FallsOntoASurfaceThatSinksWhileItFloats)
{
    const auto terrain = test::filledTerrain(41, heightsOver(41, awayFromTheRidge));
    Model model(surfaceOver(terrain), kKept);
    model.update({-3.25, 0.25, -1.0});
    const ContactState floating = model.update({3.25, 0.25, -6.0});
    ASSERT_FALSE(model.contact());
    for (const double exaggeration : {0.1, 2.0}) {
        Model other = model;
        const HeightfieldSurface surface = surfaceOver(terrain, exaggeration);
        other.setSurface(surface);
        const ContactState state = other.update({kNan, kNan, kNan});
        EXPECT_TRUE(state.is_in_contact);
        EXPECT_NEAR(distance(state.proxy, {floating.proxy.x, floating.proxy.y,
                                           exaggeration * awayFromTheRidge(floating.proxy.x)}),
                    0.0, 1e-12);
    }
}

// The viscosity of section 2.3: a goal that moves by v cells per update leaves kept constraints
// behind. The lag is the distance that a long wait at the last goal would still recover.
TEST(GodObject, LagsBehindFastSwipesWhileConstraintsAreKept)
{
    const auto terrain = test::filledTerrain(1025, test::fractalHeights(1025, 1025, 20031));
    const HeightfieldSurface surface = surfaceOver(terrain);
    double last_lag = 0.0;
    for (const double v : {1.0, 10.0, 50.0}) {
        double mean_kept = 0.0;
        double worst_released = 0.0;
        int count = 0;
        for (const auto constraints : {kKept, kReleased}) {
            Model model(surface, constraints);
            ScenePoint goal{};
            double heading = 0.3;
            count = 0;
            for (int i = 0; i < 2000; ++i) {
                heading += 0.05 * std::sin(0.7 * i);
                if (std::abs(goal.x + v * std::cos(heading)) > 450.0 ||
                    std::abs(goal.y + v * std::sin(heading)) > 450.0) {
                    heading = std::atan2(-goal.y, -goal.x) + 0.4;
                }
                goal.x += v * std::cos(heading);
                goal.y += v * std::sin(heading);
                goal.z = surface.height(surface.frame().toGrid(goal)) - 3.0;
                const ContactState moving = model.update(goal);
                if (i % 20 == 19) {
                    Model waiting = model;
                    ScenePoint settled = moving.proxy;
                    for (int wait = 0; wait < 1000; ++wait) {
                        settled = waiting.update(goal).proxy;
                    }
                    const double lag = distance(settled, moving.proxy);
                    ++count;
                    if (constraints == kKept) {
                        mean_kept += lag;
                    } else {
                        worst_released = std::max(worst_released, lag);
                    }
                }
            }
        }
        mean_kept /= count;
        std::printf("v = %g: kept lags %.3f cells on average, released at most %.2g\n", v,
                    mean_kept, worst_released);
        EXPECT_LT(worst_released, 1e-9);
        EXPECT_GT(mean_kept, last_lag);
        last_lag = mean_kept;
    }
    EXPECT_GT(last_lag, 5.0);
}

} // namespace
} // namespace marsview
