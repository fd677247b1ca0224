#include "app/bench/reference/reference_proxy.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

using test::distance;
using test::surfaceOver;

constexpr double kInf = std::numeric_limits<double>::infinity();

template <typename Height>
HeightfieldSurface sampledSurface(int samples, const Height& height)
{
    std::vector<float> heights;
    for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
            heights.push_back(static_cast<float>(height(column, row)));
        }
    }
    return surfaceOver(test::filledTerrain(static_cast<std::size_t>(samples), heights));
}

// A goal that turns slowly at a constant speed within `reach` meters of the middle.
class Wanderer {
public:
    Wanderer(test::Random& random, double speed_m, double reach_m)
        : random_(random)
        , speed_m_(speed_m)
        , reach_m_(reach_m)
    {}
    ScenePoint next()
    {
        heading_ += random_.uniform(-0.1, 0.1);
        if (std::hypot(at_.x + speed_m_ * std::cos(heading_),
                       at_.y + speed_m_ * std::sin(heading_)) > reach_m_) {
            heading_ = std::atan2(-at_.y, -at_.x) + random_.uniform(-0.7, 0.7);
        }
        at_.x += speed_m_ * std::cos(heading_);
        at_.y += speed_m_ * std::sin(heading_);
        return at_;
    }

private:
    test::Random& random_;
    double speed_m_;
    double reach_m_;
    double heading_ = 0.3;
    ScenePoint at_;
};

} // namespace

TEST(ReferenceProxy, EndsInALocalMinimumOnOrAboveTheSurface)
{
    test::Random random;
    double worst_cosine = -1.0;
    double worst_below = 0.0;
    long contacts = 0;
    for (const test::NamedTerrain& named : test::syntheticTerrains()) {
        SCOPED_TRACE(named.name);
        const HeightfieldSurface surface = surfaceOver(named.terrain);
        ReferenceProxy reference(surface, 1.0 / 16.0);
        ScenePoint goal{};
        for (int i = 0; i < 400; ++i) {
            goal = test::wanderingGoal(random, surface, goal, i % 2 == 0 ? 0.3 : 3.0);
            const ReferenceProxy::State state = reference.update(goal);
            const ScenePoint clamped = test::clampedGoal(surface, goal);
            const double scale = 1.0 + std::abs(state.proxy.z);
            const double over =
                state.proxy.z - test::bruteHeight(surface, surface.frame().toGrid(state.proxy));
            worst_below = std::min(worst_below, over / scale);
            if (state.is_in_contact) {
                ++contacts;
                EXPECT_NEAR(over / scale, 0.0, 1e-8);
                // For goals closer than rounding error, directions are meaningless.
                if (distance(state.proxy, clamped) > 1e-6 * scale) {
                    const double cosine = test::steepestCosine(surface, state.proxy, clamped);
                    worst_cosine = std::max(worst_cosine, cosine);
                    EXPECT_LE(cosine, 1e-7) << "update " << i;
                }
            } else {
                EXPECT_LE(distance(state.proxy, clamped), 1e-9 * (1.0 + length(clamped)));
            }
        }
        EXPECT_EQ(reference.unfinishedCount(), 0U);
    }
    EXPECT_GT(contacts, 4000);
    EXPECT_GE(worst_below, -1e-8);
    std::printf("worst cosine %.2e, worst depth %.2e of its height, %ld contacts\n", worst_cosine,
                -worst_below, contacts);
}

TEST(ReferenceProxy, RestsOnAPlaneAtTheFootOfTheGoal)
{
    const HeightfieldSurface surface =
        sampledSurface(65, [](int c, int r) { return 0.5 * c - 0.25 * r; });
    // North is opposite to the row direction.
    const Vec3 normal = normalized({-0.5, -0.25, 1.0});
    const ScenePoint on_plane{0.0, 0.0, 0.5 * 32.0 - 0.25 * 32.0};
    test::Random random;
    Wanderer hand(random, 1.7, 20.0);
    ReferenceProxy reference(surface);
    for (int i = 0; i < 300; ++i) {
        const ScenePoint at = hand.next();
        const ScenePoint above = at + Vec3{0.0, 0.0, on_plane.z + 0.5 * at.x + 0.25 * at.y};
        const ScenePoint goal = above + normal * random.uniform(-4.0, 1.0);
        const double depth = dot(goal - on_plane, normal);
        const ReferenceProxy::State state = reference.update(goal);
        EXPECT_EQ(state.is_in_contact, depth < 0.0);
        EXPECT_LE(distance(state.proxy, depth < 0.0 ? goal - normal * depth : goal), 1e-12);
    }
}

TEST(ReferenceProxy, RestsInAValleyAtTheClosestPointOfTheFreeSpace)
{
    const HeightfieldSurface surface =
        sampledSurface(65, [](int c, int) { return std::abs(c - 32.0); });
    test::Random random;
    Wanderer hand(random, 0.9, 20.0);
    ReferenceProxy reference(surface);
    int in_the_valley = 0;
    for (int i = 0; i < 400; ++i) {
        ScenePoint goal = hand.next();
        goal.z = std::abs(goal.x) - random.uniform(0.1, 12.0);
        // The free space is convex: the minimum is on one of the two slopes, or where they meet.
        ScenePoint closest{0.0, goal.y, 0.0};
        const double foot = (std::abs(goal.x) + goal.z) / 2.0;
        if (foot > 0.0) {
            closest.x = std::copysign(foot, goal.x);
            closest.z = foot;
        } else {
            ++in_the_valley;
        }
        EXPECT_LE(distance(reference.update(goal).proxy, closest), 1e-12) << "update " << i;
    }
    EXPECT_GT(in_the_valley, 50);
    EXPECT_LT(in_the_valley, 350);
}

TEST(ReferenceProxy, StaysOnItsSideOfARidgeUntilTheFootOfTheGoalPassesIt)
{
    constexpr double kSlope = 0.5;
    const HeightfieldSurface surface =
        sampledSurface(65, [](int c, int) { return -kSlope * std::abs(c - 32.0); });
    ReferenceProxy reference(surface);
    ScenePoint goal{-6.0, 3.0, -4.0};
    reference.place(goal);
    double side = -1.0;
    int passes = 0;
    test::Random random;
    for (int i = 0; i < 2000; ++i) {
        goal.x = std::clamp(goal.x + random.uniform(-1.5, 1.5), -7.0, 7.0);
        goal.y = random.uniform(-3.0, 3.0);
        const auto foot = [&] {
            return (goal.x - side * kSlope * goal.z) / (1.0 + kSlope * kSlope);
        };
        // The path is straight: if its end does not pass the edge, no point on it does.
        if (side * foot() < 0.0) {
            side = -side;
            ++passes;
        }
        EXPECT_LE(
            distance(reference.update(goal).proxy, {foot(), goal.y, -kSlope * std::abs(foot())}),
            1e-12)
            << "update " << i;
    }
    EXPECT_GT(passes, 10);
}

TEST(ReferenceProxy, FollowsTheMeridiansOfAConeAsFinelyAsItIsSampled)
{
    constexpr double kSlope = 0.6;
    for (const double sign : {-1.0, 1.0}) { // a hill, a funnel
        const HeightfieldSurface surface = sampledSurface(
            201, [sign](int c, int r) { return sign * kSlope * std::hypot(c - 100.0, r - 100.0); });
        ReferenceProxy reference(surface);
        double worst = 0.0;
        for (int i = 0; i <= 400; ++i) {
            const double angle = i * std::numbers::pi / 200.0;
            const double radius = 60.0 + 8.0 * std::sin(5.0 * angle);
            const double foot = radius + sign * kSlope * 3.0;
            // 3 m along the normal below the place on the cone at `foot`.
            const ScenePoint goal{radius * std::cos(angle), radius * std::sin(angle),
                                  sign * kSlope * foot - 3.0};
            const double expected = (radius + sign * kSlope * goal.z) / (1.0 + kSlope * kSlope);
            const ReferenceProxy::State state = reference.update(goal);
            const ScenePoint closest{expected * std::cos(angle), expected * std::sin(angle),
                                     sign * kSlope * expected};
            worst = std::max(worst, distance(state.proxy, closest));
        }
        // The chord of a cell departs from the circle by 1/8 of the curvature, 1/500 cell at radius
        // 60. Feet on facets are displaced sideways by the error of the normals, 1/60, times the
        // depth.
        EXPECT_LE(worst, 0.1);
        EXPECT_GT(worst, 1e-6);
    }
}

TEST(ReferenceProxy, ConvergesAsThePiecesBecomeShorter)
{
    const auto terrain = test::filledTerrain(512, test::fractalHeights(512, 512, 77));
    test::Random random;
    Wanderer hand(random, 10.0, 200.0);
    const HeightfieldSurface surface = surfaceOver(terrain, 5.0);
    std::vector<ScenePoint> goals;
    for (int i = 0; i < 400; ++i) {
        ScenePoint goal = hand.next();
        goal.z =
            test::bruteHeight(surface, surface.frame().toGrid(goal)) - random.uniform(2.0, 5.0);
        goals.push_back(goal);
    }
    const auto proxies = [&](double piece) {
        ReferenceProxy reference(surface, piece);
        std::vector<ScenePoint> found;
        for (const ScenePoint& goal : goals) {
            found.push_back(reference.update(goal).proxy);
        }
        return found;
    };
    const std::vector<ScenePoint> finest = proxies(1.0 / 1024.0);
    int differing_before = 0;
    for (const double piece : {8.0, 1.0, 1.0 / 8.0, 1.0 / 128.0}) {
        const std::vector<ScenePoint> found = proxies(piece);
        int differing = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            differing += distance(found[i], finest[i]) > 1e-5 ? 1 : 0;
        }
        std::printf("pieces of %g cells: %d of %zu differ\n", piece, differing, found.size());
        if (piece < 8.0) {
            EXPECT_LE(differing, differing_before);
        }
        differing_before = differing;
    }
    EXPECT_LE(differing_before, 4);
}

TEST(ReferenceProxy, DoesNotMoveForARefusedGoal)
{
    const HeightfieldSurface surface = sampledSurface(33, [](int c, int) { return 0.1 * c; });
    ReferenceProxy reference(surface);
    const ScenePoint proxy = reference.place({3.0, 4.0, -5.0}).proxy;
    for (const ScenePoint& goal : {ScenePoint{kNan, 0.0, 0.0}, ScenePoint{0.0, kInf, 0.0},
                                   ScenePoint{0.0, 0.0, -kInf}, ScenePoint{0.0, 0.0, 2e12}}) {
        EXPECT_EQ(reference.update(goal).proxy, proxy);
    }
    EXPECT_FALSE(reference.update({0.0, 0.0, 50.0}).is_in_contact);
}

TEST(ReferenceProxy, FollowsAGoalOutsideTheMapAlongTheBorder)
{
    const HeightfieldSurface surface =
        sampledSurface(33, [](int c, int r) { return 0.1 * c + std::sin(r * 0.7); });
    ReferenceProxy reference(surface);
    reference.place({0.0, 0.0, -3.0});
    // The goal leaves across the eastern border, goes far out, and returns across the northern one.
    for (const ScenePoint& goal : {ScenePoint{40.0, 3.0, -3.0}, ScenePoint{1e5, 90.0, -3.0},
                                   ScenePoint{4.0, 900.0, -3.0}, ScenePoint{4.0, 3.0, -3.0}}) {
        const ScenePoint clamped = test::clampedGoal(surface, goal);
        const ReferenceProxy::State state = reference.update(goal);
        EXPECT_LE(test::steepestCosine(surface, state.proxy, clamped), 1e-9);
        EXPECT_LE(std::abs(state.proxy.x), 16.0);
        EXPECT_LE(std::abs(state.proxy.y), 16.0);
    }
}

} // namespace marsview
