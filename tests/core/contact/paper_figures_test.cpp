// The figures of the paper (Walker and Salisbury, I3D 2003) as claims about the models.
#include "core/contact/continuous_walk.h"
#include "core/contact/facet_steps.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/proxy_graph_2003.h"
#include "core/contact/surface_walk.h"
#include "tests/core/contact/contact_judge.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

using test::distance;

using Graph = ProxyGraph<HeightfieldSurface>;
using Published = ProxyGraph2003<HeightfieldSurface>;
using Walk = SurfaceWalk<HeightfieldSurface>;
using Continuous = ContinuousWalk<HeightfieldSurface>;

HeightfieldSurface surfaceOf(std::size_t columns, const std::vector<float>& heights)
{
    const auto terrain = test::filledTerrain(columns, heights);
    return {terrain, test::unitFrame(*terrain), 1.0};
}

// Places the model above the surface, then moves the goal; both updates are checked.
template <typename Model>
ContactState moved(Model& model, const ScenePoint& from, const ScenePoint& to)
{
    test::Judge<Model> judge(model.surface());
    judge.check(model, from);
    judge.check(model, to);
    return model.state();
}

// Figure 3: the proxy starts at 1, collides at 2 and slides to the local minimum at 3.

template <typename Model>
void slidesToTheMinimum()
{
    // z = x / 2, and from 3 m east of the middle on z = 3/2 + 2 (x - 3).
    std::vector<float> heights;
    for (int r = 0; r < 21; ++r) {
        for (int c = 0; c < 21; ++c) {
            const double x = c - 10.0;
            heights.push_back(static_cast<float>(x < 3.0 ? x / 2.0 : 1.5 + 2.0 * (x - 3.0)));
        }
    }
    const HeightfieldSurface surface = surfaceOf(21, heights);
    const ScenePoint start{-4.0, 0.25, 4.0};
    const ScenePoint goal{1.0, 0.25, -6.0};
    const auto cast = surface.castFree(*surface.goal(start), *surface.goal(goal));
    ASSERT_TRUE(cast.contact.has_value());
    const double t = 6.0 / (10.0 + 2.5); // z - x / 2 is 6 at the start and falls by 12.5
    EXPECT_NEAR(distance(surface.point(*cast.contact), start + (goal - start) * t), 0.0, 1e-12)
        << "2";
    Model model(surface);
    // The foot of the goal on the plane: (x, x/2) - goal is orthogonal to (1, 1/2).
    const double x = (1.0 + 0.5 * -6.0) / 1.25;
    EXPECT_NEAR(distance(moved(model, start, goal).proxy, {x, 0.25, x / 2.0}), 0.0, 1e-12) << "3";
}

TEST(PaperFigures, Figure3TheProxySlidesFromTheCollisionToTheMinimum)
{
    slidesToTheMinimum<Graph>();
    slidesToTheMinimum<Walk>();
    slidesToTheMinimum<Continuous>();
}

// Figure 5: a) free motion and motion on the surface alternate within an update; b) on a flat
// triangulation the proxy takes a zigzag of edges to the place that a straight path leads to.

template <typename Model>
void alternates()
{
    // z = 5 - x/5 up to a brink at x = 0, a cliff down to x = 1, then z = (x - 1) / 5.
    std::vector<float> heights;
    for (int r = 0; r < 21; ++r) {
        for (int c = 0; c < 21; ++c) {
            const double x = c - 10.0;
            heights.push_back(static_cast<float>(x <= 0.0 ? 5.0 - x / 5.0 : (x - 1.0) / 5.0));
        }
    }
    const HeightfieldSurface surface = surfaceOf(21, heights);
    Model model(surface);
    model.place({-4.0, 0.25, 8.0});
    // Meets the upper slope, slides to the brink, falls straight to (26/11, 3/11) on the lower
    // slope, and slides to the goal's foot there: ((4, -3) - (x, (x - 1) / 5)) is orthogonal to
    // (1, 1/5).
    const ContactState state = model.update({4.0, 0.25, -3.0});
    const double x = 3.44 / 1.04;
    EXPECT_NEAR(distance(state.proxy, {x, 0.25, (x - 1.0) / 5.0}), 0.0, 1e-6);
    EXPECT_EQ(state.counters.casts, 2U) << "one to the upper slope, one over the cliff";
}

TEST(PaperFigures, Figure5aFreeAndConstrainedMotionAlternateWithinAnUpdate)
{
    alternates<Graph>();
    alternates<Published>();
    alternates<Walk>();
}

TEST(PaperFigures, Figure5bOnFlatGroundTheProxyFollowsEdgesToTheEndOfTheStraightPath)
{
    const HeightfieldSurface surface =
        surfaceOf(41, std::vector<float>(std::size_t{41} * 41, 0.0F));
    constexpr double kDepth = 3.0;
    test::Random random;
    int traced = 0;
    for (int i = 0; i < 300; ++i) {
        const ScenePoint p{random.uniform(-18.0, 18.0), random.uniform(-18.0, 18.0), 0.0};
        // From vertex to vertex along the edge that makes the smallest angle with the way to p, as
        // long as that is nearer; one column to the right is +x, one row down is -y.
        ScenePoint at{};
        double walked = 0.0;
        std::uint32_t vertices = 1;
        while (true) {
            ScenePoint best = at;
            double most = 0.0;
            for (const Vec3& edge : {Vec3{1, 0, 0}, Vec3{1, -1, 0}, Vec3{0, -1, 0}, Vec3{-1, 0, 0},
                                     Vec3{-1, 1, 0}, Vec3{0, 1, 0}}) {
                const double cosine = dot(p - at, edge) / (length(p - at) * length(edge));
                if (cosine > most) {
                    most = cosine;
                    best = at + edge;
                }
            }
            if (!(distance(best, p) < distance(at, p))) {
                break;
            }
            walked += distance(best, at);
            at = best;
            ++vertices;
        }
        Published published(surface);
        Graph graph(surface);
        published.place({0.0, 0.0, -kDepth});
        graph.place({0.0, 0.0, -kDepth});
        const ContactState end = published.update({p.x, p.y, -kDepth});
        EXPECT_NEAR(distance(end.proxy, p), 0.0, 1e-11);
        EXPECT_NEAR(distance(graph.update({p.x, p.y, -kDepth}).proxy, p), 0.0, 1e-11);
        EXPECT_GE(walked + distance(at, p), length(p)) << "no shorter than the straight path";
        if (end.counters.far_edges == 0) {
            ++traced;
            EXPECT_EQ(end.counters.vertices, vertices);
        }
    }
    EXPECT_GT(traced, 250);
}

// Figure 6: a small error of vertex tracing leads to another local minimum.

// Starts where a segment hits the surface and descends in steps of a thousandth of a cell, each in
// the best of many directions. Uses heights only.
ScenePoint crawled(const HeightfieldSurface& surface, ScenePoint at, const ScenePoint& goal)
{
    constexpr int kDirections = 720;
    constexpr double kStep = 1e-3;
    for (int step = 0; step < 20000; ++step) {
        ScenePoint best = at;
        for (int i = 0; i < kDirections; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / kDirections;
            const ScenePoint to{at.x + kStep * std::cos(angle), at.y + kStep * std::sin(angle),
                                0.0};
            GridPoint grid = surface.frame().toGrid(to);
            const double last = static_cast<double>(surface.terrain()->columns()) - 1.0;
            if (grid.column < 0.0 || grid.row < 0.0 || grid.column > last || grid.row > last) {
                continue;
            }
            const ScenePoint on = surface.frame().toScene(grid, test::bruteHeight(surface, grid));
            // The steepest descent per meter of surface, not the longest step.
            const double gain = distance(at, goal) - distance(on, goal);
            const double best_gain = distance(at, goal) - distance(best, goal);
            if (gain > 0.0 &&
                (best == at || gain * distance(best, at) > best_gain * distance(on, at))) {
                best = on;
            }
        }
        if (best == at) {
            break;
        }
        at = best;
    }
    return at;
}

struct SixthFigure {
    HeightfieldSurface surface;
    ScenePoint start;
    ScenePoint goal;
    ScenePoint collision;
    ScenePoint third;
    ScenePoint fourth;

    SixthFigure(const std::vector<float>& heights, GridPoint from, GridPoint to, double goal_m)
        : surface(surfaceOf(4, heights))
        , start(surface.frame().toScene(from, 5.0))
        , goal(surface.frame().toScene(to, goal_m))
    {
        const auto cast = surface.castFree(*surface.goal(start), *surface.goal(goal));
        EXPECT_EQ(cast.contact->feature, ContactFeature::Face);
        collision = surface.point(*cast.contact);
        Walk walk(surface);
        third = moved(walk, start, goal).proxy;
    }
    ScenePoint at(double column, double row) const
    {
        return surface.frame().toScene({column, row}, surface.height({column, row}));
    }
};

TEST(PaperFigures, Figure6TracingFromTheNearestVertexEndsInAnotherMinimum)
{
    const SixthFigure figure({2, 0, 3, 3, 0, 1, 1, 1, 2, 2, 1, 1, 0, 3, 0, 0}, {1.75, 1.75},
                             {1.5, 2.0}, -0.5);
    EXPECT_NEAR(distance(figure.third, figure.at(1.75, 1.75)), 0.0, 1e-12);
    EXPECT_NEAR(distance(crawled(figure.surface, figure.collision, figure.goal), figure.third), 0.0,
                5e-3)
        << "the descent from the collision leads to 3";
    // As in the paper, from the vertex of the collision triangle nearest to the goal.
    const ScenePoint vertex = figure.at(2.0, 2.0);
    for (const ScenePoint& other : {figure.at(1.0, 1.0), figure.at(1.0, 2.0)}) {
        ASSERT_LT(distance(vertex, figure.goal), distance(other, figure.goal));
    }
    Graph traced(figure.surface);
    const ScenePoint fourth = moved(traced, vertex, figure.goal).proxy;
    EXPECT_NEAR(distance(fourth, figure.at(2.0, 2.75)), 0.0, 1e-12) << "4 is a local minimum too";
    // Our model walks from the collision to the first vertex or edge, and reaches 3.
    Graph graph(figure.surface);
    EXPECT_NEAR(distance(moved(graph, figure.start, figure.goal).proxy, figure.third), 0.0, 1e-12);
}

TEST(PaperFigures, Figure6VertexTracingStillDiffersFromExactDescentNowAndThen)
{
    // The difference: the walk over the collision face ends at an edge where the surface continues
    // into the next face, between two edges. The graph takes the steeper edge instead, which leads
    // into another basin.
    const SixthFigure figure({3, 3, 1, 0, 3, 0, 1, 1, 1, 3, 2, 2, 1, 1, 2, 2}, {1.25, 1.75},
                             {3.0, 1.75}, -2.5);
    EXPECT_NEAR(distance(figure.third, figure.at(3.0, 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(distance(crawled(figure.surface, figure.collision, figure.goal), figure.third), 0.0,
                5e-3);
    Graph graph(figure.surface);
    const ContactState state = moved(graph, figure.start, figure.goal);
    EXPECT_NEAR(distance(state.proxy, figure.at(1.0, 1.0)), 0.0, 1e-12) << "4";
    Continuous continuous(figure.surface);
    const ScenePoint limit = moved(continuous, figure.start, figure.goal).proxy;
    std::printf("figure 6: 3 is %.3f m from the goal, 4 %.3f m, the continuous walk ends %.3f m\n",
                distance(figure.third, figure.goal), distance(state.proxy, figure.goal),
                distance(limit, figure.goal));
}

// Figure 8: an edge's gradient is the cosine of the angle between the edge and the vector from the
// goal to the vertex; the most negative one decreases the distance fastest.

TEST(PaperFigures, Figure8TheSmallestEdgeGradientDecreasesTheDistanceFastest)
{
    const HeightfieldSurface surface = surfaceOf(12, test::fractalHeights(12, 12, 8));
    using Steps = FacetSteps<HeightfieldSurface>;
    test::Random random;
    int minima = 0;
    for (int i = 0; i < 3000; ++i) {
        const HeightfieldVertex here{3 + static_cast<int>(random.below(6)),
                                     3 + static_cast<int>(random.below(6))};
        const auto at = [&](HeightfieldVertex v) {
            return surface.frame().toScene(
                {static_cast<double>(v.column), static_cast<double>(v.row)},
                surface.terrain()->sample(static_cast<std::size_t>(v.column),
                                          static_cast<std::size_t>(v.row)));
        };
        const ScenePoint a = at(here);
        const ScenePoint goal =
            a + Vec3{random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5), random.uniform(-4, 0)};
        double smallest = 0.0;
        double fastest = 0.0;
        HeightfieldVertex by_gradient = here;
        HeightfieldVertex by_distance = here;
        for (const auto& [columns, rows] :
             {std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}, std::pair{-1, 0},
              std::pair{-1, -1}, std::pair{0, -1}}) {
            const HeightfieldVertex to{here.column + columns, here.row + rows};
            const Vec3 edge = at(to) - a;
            const double gradient = dot(edge, a - goal) / (length(edge) * length(a - goal));
            if (gradient < smallest) {
                smallest = gradient;
                by_gradient = to;
            }
            // The change of the distance over a millionth of a meter.
            constexpr double kStep = 1e-6;
            const double change =
                distance(a + edge * (kStep / length(edge)), goal) - distance(a, goal);
            ASSERT_NEAR(change / kStep, gradient, 1e-5);
            if (change < fastest) {
                fastest = change;
                by_distance = to;
            }
        }
        const auto fan = surface.fan(here);
        const Vec3 to_goal = surface.toGoal(fan, *surface.goal(goal));
        const auto steepest = Steps::steepestSpoke(surface, fan, to_goal, dot(to_goal, to_goal));
        if (smallest == 0.0) {
            ++minima;
            EXPECT_EQ(steepest.towards, 0.0) << "no edge has a negative gradient";
            continue;
        }
        EXPECT_EQ(steepest.spoke.end, by_gradient);
        if (smallest < -1e-3) {
            EXPECT_EQ(steepest.spoke.end, by_distance);
        }
        EXPECT_NEAR(-steepest.towards / std::sqrt(steepest.length_squared) / length(to_goal),
                    smallest, 1e-12);
    }
    EXPECT_GT(minima, 0);
}

// Figures 9 and 10: a triangle ABC with an obtuse angle at A and AB twice as long as AC, which
// leaves room for area d.

class Triangle {
public:
    enum class Beyond { Flat, RisesBehindAB, RisesBehindBC };

    explicit Triangle(Beyond beyond)
        : b_{2.0, 0.0, 0.0}
        , c_{std::cos(1.9), std::sin(1.9), 0.0}
    {
        // A is the sample in the middle, B the next in its row, and C the one directly below, so
        // one row down is C - B.
        std::vector<float> heights;
        for (int row = -kHalf; row <= kHalf; ++row) {
            for (int column = -kHalf; column <= kHalf; ++column) {
                // Rows away from AB; columns beyond the line BC.
                const double rise = beyond == Beyond::RisesBehindAB   ? -row
                                    : beyond == Beyond::RisesBehindBC ? column - 1
                                                                      : 0.0;
                heights.push_back(static_cast<float>(2.0 * std::max(rise, 0.0)));
            }
        }
        const auto terrain = test::filledTerrain(2 * kHalf + 1, heights);
        const SceneFrame frame{.origin = {kHalf, kHalf},
                               .east_per_column = b_.x,
                               .east_per_row = c_.x - b_.x,
                               .north_per_column = b_.y,
                               .north_per_row = c_.y - b_.y};
        surface_.emplace(terrain, frame, 1.0);
    }

    const HeightfieldSurface& surface() const { return *surface_; }
    ScenePoint b() const { return b_; }
    ScenePoint c() const { return c_; }
    // The projected minimum's shares of A, B and C.
    std::array<double, 3> shares(const ScenePoint& p) const
    {
        const double area = cross(b_, c_).z;
        const double of_b = cross(p, c_).z / area;
        const double of_c = cross(b_, p).z / area;
        return {1.0 - of_b - of_c, of_b, of_c};
    }
    // The edges at A in the plane, AB first.
    std::array<Vec3, 6> edges() const { return {b_, c_, c_ - b_, -b_, -c_, b_ - c_}; }

    // From A, where the proxy rests, to a goal whose foot on the plane is `p`.
    ContactState fromA(const ScenePoint& p, double depth) const
    {
        Graph graph(*surface_);
        test::Judge<Graph> judge(*surface_);
        judge.check(graph, {0.0, 0.0, -depth});
        EXPECT_EQ(graph.state().feature, ContactFeature::Vertex);
        EXPECT_EQ(graph.state().proxy, (ScenePoint{}));
        judge.check(graph, {p.x, p.y, -depth});
        return graph.state();
    }

private:
    static constexpr int kHalf = 5;

    ScenePoint b_;
    ScenePoint c_;
    std::optional<HeightfieldSurface> surface_;
};

TEST(PaperFigures, Figure9TheProxyCrossesTheFarEdge)
{
    const Triangle flat(Triangle::Beyond::Flat);
    const ScenePoint p{0.9, 0.85, 0.0}; // the projected minimum
    const auto shares = flat.shares(p);
    ASSERT_TRUE(shares[0] < 0.0 && shares[1] > 0.0 && shares[2] > 0.0) << "beyond BC alone";
    for (const Vec3& edge : flat.edges()) {
        ASSERT_LE(dot(p, edge) / length(edge), dot(p, flat.b()) / 2.0) << "AB is the steepest";
    }
    constexpr double kDepth = 4.0;
    const ScenePoint goal{p.x, p.y, -kDepth};
    const ScenePoint e{p.x, 0.0, 0.0}; // the minimum on the edge AB
    ASSERT_TRUE(e.x > 0.0 && e.x < 2.0);
    const ContactState state = flat.fromA(p, kDepth);
    EXPECT_EQ(state.counters.far_edges, 1U);
    EXPECT_EQ(state.counters.far_loops, 0U);
    EXPECT_NEAR(distance(state.proxy, p), 0.0, 1e-12);
    EXPECT_LT(distance(state.proxy, goal), distance(e, goal));

    // Where the surface rises behind BC, the farther minimum lies on BC itself.
    const Triangle valley(Triangle::Beyond::RisesBehindBC);
    const Vec3 bc = valley.c() - valley.b();
    const ScenePoint nearest = valley.b() + bc * (dot(p - valley.b(), bc) / dot(bc, bc));
    const ContactState on_far_edge = valley.fromA(p, kDepth);
    EXPECT_EQ(on_far_edge.counters.far_edges, 1U);
    EXPECT_EQ(on_far_edge.feature, ContactFeature::Edge);
    EXPECT_NEAR(distance(on_far_edge.proxy, nearest), 0.0, 1e-12);
    EXPECT_LT(distance(on_far_edge.proxy, goal), distance(e, goal));
}

TEST(PaperFigures, Figure10EachAreaOfTheTriangleEndsAsThePaperSays)
{
    const Triangle flat(Triangle::Beyond::Flat);
    const Triangle valley(Triangle::Beyond::RisesBehindAB);
    constexpr double kDepth = 9.0;
    std::array<int, 4> met{};
    for (int i = -40; i <= 80; ++i) {
        for (int j = -40; j <= 40; ++j) {
            // Avoids the lines between the areas.
            const ScenePoint p{0.05 * i + 0.0123, 0.05 * j + 0.0071, 0.0};
            const double towards_b = dot(p, flat.b()) / 2.0;
            bool is_steepest = towards_b > 0.0;
            for (const Vec3& edge : flat.edges()) {
                is_steepest = is_steepest && dot(p, edge) / length(edge) <= towards_b;
            }
            if (!is_steepest) {
                continue; // the paper's premise: AB is the edge with the smallest gradient
            }
            SCOPED_TRACE(testing::Message() << "projected minimum " << p.x << ", " << p.y);
            const auto shares = flat.shares(p);
            const ContactState state = flat.fromA(p, kDepth);
            // On the plane the projected minimum is the only one.
            EXPECT_NEAR(distance(state.proxy, p), 0.0, 1e-11);
            const bool is_beyond_bisector = towards_b > 1.0; // line 2, of AB
            if (is_beyond_bisector && shares[0] < 0.0) {
                ++met[0]; // a: B is closer
                EXPECT_LT(distance(p, flat.b()), length(p));
                if (towards_b >= 2.0) {
                    EXPECT_GE(state.counters.vertices, 2U) << "continues from B";
                }
            } else if (shares[2] < 0.0) {
                ++met[1]; // b: on the adjacent face, or, in a valley, on AB
                const ContactState in_valley = valley.fromA(p, kDepth);
                EXPECT_EQ(in_valley.counters.far_edges, 0U);
                EXPECT_EQ(in_valley.feature, ContactFeature::Edge);
                EXPECT_NEAR(distance(in_valley.proxy, {towards_b, 0.0, 0.0}), 0.0, 1e-11);
            } else if (shares[0] >= 0.0 && shares[1] >= 0.0) {
                ++met[2]; // c: within ABC
                EXPECT_EQ(state.feature, ContactFeature::Face);
                EXPECT_EQ(state.counters.far_edges, 0U);
                EXPECT_EQ(state.counters.vertices, 1U);
            } else {
                ++met[3]; // d
                ASSERT_LT(shares[0], 0.0);
                EXPECT_GE(state.counters.far_edges, 1U);
                EXPECT_EQ(state.counters.far_loops, 0U);
            }
        }
    }
    std::printf("figure 10: %d projected minima in a, %d in b, %d in c, %d in d\n", met[0], met[1],
                met[2], met[3]);
    for (const int count : met) {
        EXPECT_GT(count, 20);
    }
}

// Figure 11: a) a cast visits only the cells along its path; b) cells and blocks that lie below the
// path need no test.

TEST(PaperFigures, Figure11aACastVisitsTheCellsAlongItsPathUpToTheHit)
{
    // One block, so that a single needle in a corner keeps it from being skipped as a whole.
    std::vector<float> heights = test::fractalHeights(31, 31, 5);
    heights[0] = 500.0F;
    const HeightfieldSurface surface = surfaceOf(31, heights);
    test::Random random;
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto above = [&](double low, double high) {
            const GridPoint grid{random.uniform(2.0, 29.0), random.uniform(2.0, 29.0)};
            return surface.frame().toScene(grid, surface.height(grid) + random.uniform(low, high));
        };
        const ScenePoint from = above(0.1, 4.0);
        const ScenePoint to = above(-4.0, 4.0);
        const auto cast = surface.castFree(*surface.goal(from), *surface.goal(to));
        const ScenePoint end = cast.contact ? surface.point(*cast.contact) : to;
        hits += cast.contact ? 1 : 0;
        const GridPoint a = surface.frame().toGrid(from);
        const GridPoint b = surface.frame().toGrid(end);
        const double lines = std::abs(std::floor(a.column) - std::floor(b.column)) +
                             std::abs(std::floor(a.row) - std::floor(b.row));
        EXPECT_EQ(cast.cells, 1U + static_cast<std::uint32_t>(lines)) << i;
    }
    EXPECT_GT(hits, 500);
}

TEST(PaperFigures, Figure11bWhatLiesBelowThePathNeedsNoTest)
{
    // Flat ground of 8 × 8 blocks of 32 × 32 cells with one peak, of height 10.
    std::vector<float> heights(std::size_t{257} * 257, 0.0F);
    heights[std::size_t{136} * 257 + 140] = 10.0F;
    const HeightfieldSurface surface = surfaceOf(257, heights);
    const auto cells = [&](double z) {
        const auto at = [&](double column) {
            return *surface.goal(surface.frame().toScene({column, 136.3}, z));
        };
        const auto cast = surface.castFree(at(3.5), at(250.5));
        EXPECT_EQ(cast.contact.has_value(), z < 7.0); // the surface below the path is 7 high
        return cast.cells;
    };
    EXPECT_EQ(cells(10.5), 0U) << "above the whole map";
    EXPECT_EQ(cells(8.5), 32U) << "only the block of the peak, from column 128 to 160";
    EXPECT_LE(cells(5.0), 12U) << "up to the hit before column 140";
}

// Section 3.4: the distance never grows by more than the endpoint moves, because every update ends
// in a local minimum. All steps except far-edge ones decrease the distance.

TEST(PaperFigures, Section34TheDistanceGrowsAtMostAsTheEndpointMoves)
{
    test::Random random;
    for (const double scale : {1.0, 5.0, 20.0}) {
        std::vector<float> heights = test::fractalHeights(60, 60, 3);
        for (float& height : heights) {
            height *= static_cast<float>(scale);
        }
        const HeightfieldSurface surface = surfaceOf(60, heights);
        Graph graph(surface);
        test::Judge<Graph> judge(surface); // checks every update against the claim
        ScenePoint goal{0.0, 0.0, -3.0};
        for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
            const double step = i % 100 == 0 ? 5.0 : 0.05; // small steps, as of a hand, and jumps
            goal = {std::clamp(goal.x + random.uniform(-step, step), -28.0, 28.0),
                    std::clamp(goal.y + random.uniform(-step, step), -28.0, 28.0), 0.0};
            goal.z = surface.height(surface.frame().toGrid(goal)) -
                     (2.0 + std::sin(0.01 * i)) * scale * 0.5;
            judge.check(graph, goal);
        }
        judge.findings().print("section 3.4, heights × " + std::to_string(scale));
        EXPECT_GT(judge.findings().contacts, 15000);
    }
}

} // namespace
} // namespace marsview
