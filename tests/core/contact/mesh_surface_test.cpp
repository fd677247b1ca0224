#include "core/contact/continuous_walk.h"
#include "core/contact/mesh_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/support/fractal_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

template <typename M>
class MeshModel : public testing::Test {};

static_assert(noexcept(std::declval<ContinuousWalk<MeshSurface>&>().update(ScenePoint{})));

struct Names {
    template <typename M>
    static std::string GetName(int /*index*/) // NOLINT(readability-identifier-naming)
    {
        return std::is_same_v<M, ProxyGraph<MeshSurface>>    ? "ProxyGraph"
               : std::is_same_v<M, SurfaceWalk<MeshSurface>> ? "SurfaceWalk"
                                                             : "ContinuousWalk";
    }
};

using Models =
    testing::Types<ProxyGraph<MeshSurface>, SurfaceWalk<MeshSurface>, ContinuousWalk<MeshSurface>>;
TYPED_TEST_SUITE(MeshModel, Models, Names);

double cosine(const Vec3& a, const Vec3& b)
{
    const double lengths = length(a) * length(b);
    return lengths > 0.0 ? dot(a, b) / lengths : 0.0;
}

// The properties of every update on a closed mesh, checked with sums over all triangles.
class Judge {
public:
    Judge(const test::NamedMesh& named)
        : mesh_(*named.mesh)
        , size_m_(named.size_m)
        , ulp_m_(4.0 * std::numeric_limits<double>::epsilon() *
                 (length(named.middle) + named.size_m))
    {}

    // Never inside; on the surface if in contact.
    void checkPlace(const ContactState& state, const ScenePoint& goal)
    {
        ++updates_;
        contacts_ += state.is_in_contact ? 1 : 0;
        cut_short_ += state.counters.cut_short;
        vertices_ += state.counters.vertices;
        faces_ += state.counters.faces;
        casts_ += state.counters.casts;
        const double distance = test::bruteDistance(mesh_, state.proxy);
        if (state.is_in_contact) {
            off_surface_m_ = std::max(off_surface_m_, distance);
            ASSERT_LE(distance, 1e-9 * size_m_ + ulp_m_);
        } else {
            ASSERT_EQ(state.proxy, goal);
            const double tolerance = 1e-12 * (size_m_ + length(goal)) + ulp_m_;
            if (distance > tolerance) {
                ASSERT_LT(test::windingNumber(mesh_, goal), 0.5)
                    << "free within the object, " << distance << " m from the surface";
            }
        }
    }

    // No direction leads closer to the goal: neither along the adjacent faces nor into free space.
    void checkMinimum(const ContactState& state, const ScenePoint& goal, test::Random& random)
    {
        if (!state.is_in_contact) {
            return;
        }
        const Vec3 to_goal = goal - state.proxy;
        const double distance = length(to_goal);
        // Coordinates are rounded, which changes the direction.
        const double blur = 1e-6 + 64.0 * ulp_m_ / std::max(distance, 1e-300);
        if (distance < 1e-9 * size_m_ || blur > 1e-2) {
            return;
        }
        ++judged_;
        const double on = 1e-11 * size_m_ + 2.0 * ulp_m_;
        for (std::uint32_t f = 0; f < mesh_.faceCount(); ++f) {
            const auto corners = mesh_.points(f);
            if (!isOn(corners, state.proxy, on)) {
                continue;
            }
            // The directions within a face are the cone spanned by the directions to its corners.
            // The steepest one leads to the foot if that is inside.
            for (const ScenePoint& corner : corners) {
                const Vec3 along = corner - state.proxy;
                if (length(along) > 1e3 * on) {
                    const double c = cosine(to_goal, along) - 2.0 * on / length(along);
                    worst_cosine_ = std::max(worst_cosine_, c);
                    ASSERT_LE(c, blur) << "along face " << f;
                }
            }
            const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
            const Vec3 slide = to_goal - normal * dot(to_goal, normal);
            const double step = 1e-4 * length(corners[1] - corners[0]);
            if (length(slide) > blur * distance &&
                isOn(corners, state.proxy + normalized(slide) * step, on)) {
                ASSERT_LE(length(slide) / distance, blur) << "within face " << f;
            }
        }
        // Into free space: a step that leads closer to the goal ends inside the object.
        const double step =
            std::min({1e-5 * size_m_, 0.1 * distance, 0.1 * clearance(state.proxy, on)});
        if (step < 1e3 * ulp_m_) {
            return;
        }
        for (int i = 0; i < 12; ++i) {
            Vec3 way = normalized(to_goal);
            if (i > 0) {
                way = normalized(way + test::randomDirection(random) * 0.99);
            }
            const ScenePoint there = state.proxy + way * step;
            if (cosine(way, to_goal) < 0.1 ||
                test::bruteDistance(mesh_, there) < 1e-3 * step + 4.0 * ulp_m_) {
                continue;
            }
            ++ways_;
            ASSERT_GT(test::windingNumber(mesh_, there), 0.5) << "a free direction leads closer";
        }
    }

    void print(const std::string& name) const
    {
        const double n = static_cast<double>(updates_);
        std::printf(
            "%s: %ld updates, %ld in contact, off the surface by %.2g m at most; %ld "
            "minima judged, worst cosine %.2g, %ld ways into free space; a time %.2f "
            "vertices, %.2f faces, %.2f casts; %ld cut short\n",
            name.c_str(), updates_, contacts_, off_surface_m_, judged_, worst_cosine_, ways_,
            vertices_ / n, faces_ / n, casts_ / n, cut_short_);
    }
    long contacts() const { return contacts_; }
    long cutShort() const { return cut_short_; }

private:
    // The distance to the nearest face or edge that does not contain the point.
    double clearance(const ScenePoint& p, double on) const
    {
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t f = 0; f < mesh_.faceCount(); ++f) {
            const auto corners = mesh_.points(f);
            for (std::size_t i = 0; i < 3; ++i) {
                const ScenePoint& a = corners[i];
                const Vec3 edge = corners[(i + 1) % 3] - a;
                const double share = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
                const double to_edge = length((p - a) - edge * share);
                least = to_edge > on ? std::min(least, to_edge) : least;
            }
            if (!isOn(corners, p, on)) {
                const auto w = nearestWeights(corners[0] - p, corners[1] - p, corners[2] - p);
                least = std::min(least, length((corners[0] - p) * w[0] + (corners[1] - p) * w[1] +
                                               (corners[2] - p) * w[2]));
            }
        }
        return least;
    }

    static bool isOn(const std::array<ScenePoint, 3>& corners, const ScenePoint& p, double on)
    {
        const auto weights = nearestWeights(corners[0] - p, corners[1] - p, corners[2] - p);
        const Vec3 rest = (corners[0] - p) * weights[0] + (corners[1] - p) * weights[1] +
                          (corners[2] - p) * weights[2];
        return length(rest) <= on;
    }

    const TriangleMesh& mesh_;
    double size_m_;
    double ulp_m_;
    long updates_ = 0;
    long contacts_ = 0;
    long judged_ = 0;
    long ways_ = 0;
    long cut_short_ = 0;
    double vertices_ = 0.0;
    double faces_ = 0.0;
    double casts_ = 0.0;
    double off_surface_m_ = 0.0;
    double worst_cosine_ = 0.0;
};

// A goal that moves in small and large steps, into and out of the object, and sometimes onto its
// vertices, edges and faces.
ScenePoint wander(test::Random& random, const test::NamedMesh& named, const ScenePoint& last)
{
    const double size = named.size_m;
    if (random.chance(0.01)) {
        return named.middle + test::randomDirection(random) * random.uniform(0.0, 2.0 * size);
    }
    if (random.chance(0.03)) {
        const auto corners =
            named.mesh->points(static_cast<std::uint32_t>(random.below(named.mesh->faceCount())));
        const double share = random.below(3) == 0 ? 0.0 : random.unit();
        const ScenePoint at = corners[0] + (corners[1] - corners[0]) * share;
        return random.chance(0.5) ? at : at + (corners[2] - at) * random.unit();
    }
    const double step = size * std::pow(10.0, random.uniform(-4.0, -0.5));
    ScenePoint goal = last + test::randomDirection(random) * step;
    const Vec3 away = goal - named.middle;
    if (length(away) > 1.1 * size) {
        goal = named.middle + away * (1.0 * size / length(away));
    }
    return goal;
}

TYPED_TEST(MeshModel, StaysOutsideClosedMeshesAtALocalMinimum)
{
    test::Random random;
    for (const test::NamedMesh& named : test::closedMeshes()) {
        SCOPED_TRACE(named.name);
        const MeshSurface surface(named.mesh);
        TypeParam model(surface);
        Judge judge(named);
        ScenePoint goal = named.middle + Vec3{2.0 * named.size_m, 0.0, 0.0};
        model.update(goal);
        // Fewer updates for larger meshes, because the sums run over all triangles.
        const int updates = named.mesh->faceCount() < 50 ? 10000 : 3000;
        for (int i = 0; i < updates && !testing::Test::HasFatalFailure(); ++i) {
            goal = wander(random, named, goal);
            const ContactState state = model.update(goal);
            judge.checkPlace(state, goal);
            if (i % 10 == 0) {
                judge.checkMinimum(state, goal, random);
            }
        }
        judge.print(named.name);
        EXPECT_GT(judge.contacts(), updates / 10);
        EXPECT_EQ(judge.cutShort(), 0);
    }
}

TYPED_TEST(MeshModel, ManyFastUpdatesNeverEndInside)
{
    // Only every tenth update is checked, and contacts only by position, which allows many more
    // updates.
    test::Random random;
    long updates = 0;
    for (const test::NamedMesh& named : test::closedMeshes()) {
        SCOPED_TRACE(named.name);
        TypeParam model{MeshSurface(named.mesh)};
        Judge judge(named);
        ScenePoint goal = named.middle + Vec3{2.0 * named.size_m, 0.0, 0.0};
        model.update(goal);
        for (int i = 0; i < 20000 && !testing::Test::HasFatalFailure(); ++i) {
            goal = wander(random, named, goal);
            const ContactState state = model.update(goal);
            ++updates;
            if (i % 10 == 0) {
                judge.checkPlace(state, goal);
            }
            ASSERT_EQ(state.counters.cut_short, 0U);
        }
    }
    std::printf("%ld updates\n", updates);
}

// Steps from the size of the mesh down to below rounding error, often onto its features or less
// than a micrometer away; cracks down to a nanometer.
ScenePoint torment(test::Random& random, const test::NamedMesh& named, const ScenePoint& last)
{
    const double size = named.size_m;
    if (!random.chance(0.2)) {
        return wander(random, named,
                      last + test::randomDirection(random) *
                                 (size * std::pow(10.0, random.uniform(-16.0, -4.0))));
    }
    const auto corners =
        named.mesh->points(static_cast<std::uint32_t>(random.below(named.mesh->faceCount())));
    ScenePoint at = corners[0];
    if (random.chance(0.7)) {
        at = at + (corners[1] - corners[0]) * random.unit();
    }
    if (random.chance(0.5)) {
        at = at + (corners[2] - at) * random.unit();
    }
    return at + test::randomDirection(random) *
                    (random.chance(0.5) ? 0.0 : size * std::pow(10.0, random.uniform(-17.0, -3.0)));
}

TYPED_TEST(MeshModel, StaysOutsideWhereRoundingMatters)
{
    test::Random random;
    auto meshes = test::closedMeshes();
    for (const double angle : {1e-6, 1e-9}) {
        meshes.push_back({"crack of " + std::to_string(angle * 1e9) + " nm",
                          test::meshOf(test::placed(test::notchedBlock(angle), 1.0, {0.3, 0.1, 0.7},
                                                    test::Turned::Yes)),
                          2.0,
                          {0.3, 0.1, 0.7}});
    }
    for (const test::NamedMesh& named : meshes) {
        SCOPED_TRACE(named.name);
        TypeParam model{MeshSurface(named.mesh)};
        Judge judge(named);
        ScenePoint goal = named.middle + Vec3{2.0 * named.size_m, 0.0, 0.0};
        model.update(goal);
        const int updates = named.mesh->faceCount() < 50 ? 20000 : 1500;
        for (int i = 0; i < updates && !testing::Test::HasFatalFailure(); ++i) {
            goal = torment(random, named, goal);
            judge.checkPlace(model.update(goal), goal);
        }
        judge.print(named.name);
        EXPECT_GT(judge.contacts(), updates / 5);
        EXPECT_LE(judge.cutShort(), updates / 1000);
    }
}

TYPED_TEST(MeshModel, FallsOffTheBorderOfAnOpenMesh)
{
    const auto mesh = test::meshOf(test::sheet(5, 5, [](int, int) { return 0.0; }));
    TypeParam model{MeshSurface(mesh)};
    EXPECT_FALSE(model.update({2.2, -2.4, 1.0}).is_in_contact);
    ContactState state = model.update({2.2, -2.4, -1.0});
    EXPECT_TRUE(state.is_in_contact);
    EXPECT_NEAR(length(state.proxy - ScenePoint{2.2, -2.4, 0.0}), 0.0, 1e-12);
    // Slides along the underside of the sheet to its border and beyond.
    state = model.update({3.9, -2.4, -1.0});
    EXPECT_TRUE(state.is_in_contact);
    EXPECT_NEAR(length(state.proxy - ScenePoint{3.9, -2.4, 0.0}), 0.0, 1e-12);
    state = model.update({4.1, -2.4, -1.0});
    EXPECT_FALSE(state.is_in_contact);
    EXPECT_EQ(state.proxy, (ScenePoint{4.1, -2.4, -1.0}));
    // From below it passes through the back side.
    state = model.update({2.2, -2.4, -1.0});
    EXPECT_FALSE(state.is_in_contact);
    state = model.update({2.2, -2.4, 1.0});
    EXPECT_FALSE(state.is_in_contact);
    EXPECT_TRUE(model.update({2.2, -2.4, -0.5}).is_in_contact);
    // Past a corner as well.
    EXPECT_FALSE(model.update({-0.5, 0.5, -0.5}).is_in_contact);
}

TYPED_TEST(MeshModel, OpenMeshesAreNeverPassedFromTheFront)
{
    // The space below a rough sheet with a level border can be reached only around the border,
    // where the foot of the goal is straight above it.
    test::Random random;
    std::vector<double> heights(400);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const bool is_inner = i % 20 > 3 && i % 20 < 16 && i / 20 > 3 && i / 20 < 16;
        heights[i] = is_inner ? random.uniform(0.0, 1.5) : 0.0;
    }
    const auto mesh = test::meshOf(test::sheet(20, 20, [&heights](int c, int r) {
        return heights[static_cast<std::size_t>(20 * r + c)];
    }));
    const MeshSurface surface(mesh);
    TypeParam model{surface};
    int contacts = 0;
    int falls = 0;
    ScenePoint goal{9.5, -9.5, 3.0};
    ContactState last = model.update(goal);
    for (int i = 0; i < 20000; ++i) {
        goal = goal + test::randomDirection(random) * (random.chance(0.1) ? 3.0 : 0.2);
        goal = {std::clamp(goal.x, -2.0, 21.0), std::clamp(goal.y, -21.0, 2.0),
                std::clamp(goal.z, -2.0, 3.0)};
        const ContactState state = model.update(goal);
        contacts += state.is_in_contact ? 1 : 0;
        if (state.is_in_contact) {
            ASSERT_LT(test::bruteDistance(*mesh, state.proxy), 1e-12);
        } else {
            ASSERT_EQ(state.proxy, goal);
            // It got below without being pulled through the front side.
            if (last.is_in_contact && state.proxy.z < 0.0) {
                ++falls;
                ASSERT_TRUE(goal.x < 0.0 || goal.x > 19.0 || goal.y > 0.0 || goal.y < -19.0)
                    << goal.x << ", " << goal.y;
            }
        }
        ASSERT_EQ(state.counters.cut_short, 0U);
        last = state;
    }
    std::printf("%d contacts, %d falls\n", contacts, falls);
    EXPECT_GT(contacts, 2000);
    EXPECT_GT(falls, 10);
}

TYPED_TEST(MeshModel, RefusesGoalsThatAreNone)
{
    TypeParam model{MeshSurface(test::meshOf(test::cube()))};
    model.update({0.2, 0.3, 3.0});
    const ContactState before = model.update({0.2, 0.3, 0.5});
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1.1e12}) {
        const ContactState state = model.update({bad, 0.0, 0.0});
        EXPECT_EQ(state.proxy, before.proxy);
        EXPECT_TRUE(state.is_in_contact);
        EXPECT_EQ(state.counters.refused, 1U);
    }
    // The farthest goals that are accepted, there and back.
    EXPECT_FALSE(model.update({1e12, -1e12, 1e12}).is_in_contact);
    const ContactState through = model.update({-1e12, 1e12, -1e12});
    EXPECT_LT(test::bruteDistance(*test::meshOf(test::cube()), through.proxy) *
                  (through.is_in_contact ? 1.0 : 0.0),
              1e-9);
}

TYPED_TEST(MeshModel, PlacesAtTheNearestSide)
{
    test::Random random;
    for (const test::NamedMesh& named : test::closedMeshes()) {
        SCOPED_TRACE(named.name);
        const MeshSurface surface(named.mesh);
        TypeParam model{surface};
        for (int i = 0; i < 1000; ++i) {
            const ScenePoint goal = named.middle + test::randomDirection(random) *
                                                       random.uniform(0, 1.3 * named.size_m);
            const double distance = test::bruteDistance(*named.mesh, goal);
            if (distance < 1e-6 * named.size_m) {
                continue;
            }
            const bool is_inside = test::windingNumber(*named.mesh, goal) > 0.5;
            ASSERT_EQ(surface.isAbove({goal, {}}), !is_inside);
            const ContactState state = model.place(goal);
            ASSERT_EQ(state.is_in_contact, is_inside);
            if (is_inside) {
                ASSERT_NEAR(length(state.proxy - goal), distance,
                            1e-9 * named.size_m + 4e-16 * length(goal));
            }
        }
    }
}

// The same samples as a heightfield and as a mesh.
template <template <typename> typename Model>
void expectSameAsHeightfield(double scale, double step_cells, int updates)
{
    constexpr int kSide = 60;
    test::Random random;
    std::vector<float> heights = test::fractalHeights(kSide, kSide, 4);
    for (float& height : heights) {
        height *= static_cast<float>(scale);
    }
    const auto terrain = test::filledTerrain(kSide, heights);
    const HeightfieldSurface field(terrain, test::unitFrame(*terrain), 1.0);
    TriangleSoup soup = test::sheet(kSide, kSide, [&](int c, int r) {
        return static_cast<double>(heights[static_cast<std::size_t>(kSide * r + c)]);
    });
    for (ScenePoint& v : soup.vertices) {
        v = field.frame().toScene({v.x, -v.y}, v.z);
    }
    const MeshSurface surface(test::meshOf(std::move(soup)));
    Model<HeightfieldSurface> truth(field);
    Model<MeshSurface> model(surface);
    constexpr double kReach = kSide / 2.0 - 8.0; // far enough from the border
    ScenePoint goal{0.1, 0.2, 100.0};
    truth.update(goal);
    model.update(goal);
    long contacts = 0;
    double worst = 0.0;
    int differ = 0;
    for (int i = 0; i < updates; ++i) {
        goal.x = std::clamp(goal.x + random.uniform(-step_cells, step_cells), -kReach, kReach);
        goal.y = std::clamp(goal.y + random.uniform(-step_cells, step_cells), -kReach, kReach);
        goal.z = field.height(field.frame().toGrid(goal)) + random.uniform(-4.0, 0.5);
        const ContactState a = truth.update(goal);
        const ContactState b = model.update(goal);
        contacts += a.is_in_contact ? 1 : 0;
        const double apart = length(a.proxy - b.proxy);
        if (apart > 1e-9 || a.is_in_contact != b.is_in_contact) {
            ++differ;
            // Both continue from the same place, so that each update is compared independently.
            goal = {goal.x, goal.y, 100.0};
            truth.place(goal);
            model.place(goal);
        } else {
            worst = std::max(worst, apart);
        }
    }
    std::printf("scale %g: %ld contacts in %d updates, %d differ, others by %.2g m at most\n",
                scale, contacts, updates, differ, worst);
    EXPECT_GT(contacts, updates / 2);
    EXPECT_EQ(differ, 0);
}

TEST(MeshSurface, ProxyGraphMovesAsOverTheSameHeightfield)
{
    expectSameAsHeightfield<ProxyGraph>(1.0, 1.0, 20000);
    expectSameAsHeightfield<ProxyGraph>(5.0, 3.0, 20000);
    expectSameAsHeightfield<ProxyGraph>(1.0, 15.0, 5000);
}

TEST(MeshSurface, SurfaceWalkMovesAsOverTheSameHeightfield)
{
    expectSameAsHeightfield<SurfaceWalk>(1.0, 1.0, 20000);
    expectSameAsHeightfield<SurfaceWalk>(5.0, 3.0, 20000);
    expectSameAsHeightfield<SurfaceWalk>(1.0, 15.0, 5000);
}

TEST(MeshSurface, ContinuousWalkMovesAsOverTheSameHeightfield)
{
    expectSameAsHeightfield<ContinuousWalk>(1.0, 1.0, 20000);
    expectSameAsHeightfield<ContinuousWalk>(5.0, 3.0, 20000);
    expectSameAsHeightfield<ContinuousWalk>(1.0, 15.0, 5000);
}

TEST(MeshSurface, FacetsKnowTheirNeighbors)
{
    const auto mesh = test::meshOf(test::star());
    const MeshSurface surface(mesh);
    for (std::uint32_t f = 0; f < mesh->faceCount(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto facet = surface.facet({f}, i);
            EXPECT_EQ(facet.vertices[0], surface.corners({f})[i]);
            EXPECT_EQ(surface.faceOf(facet), (MeshSide{f}));
            for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_TRUE(surface.hasBeyond(facet, k));
                const auto beyond = surface.beyond(facet, k);
                EXPECT_EQ(beyond.vertices[1], facet.vertices[(k + 2) % 3]);
                EXPECT_EQ(beyond.vertices[2], facet.vertices[(k + 1) % 3]);
                EXPECT_EQ(surface.beyond(beyond, 0).vertices[0], facet.vertices[k]);
                const double above = dot(facet.normal, beyond.points[0] - facet.points[k]);
                EXPECT_EQ(surface.bend(facet, k, beyond), above > 0.0 ? 1 : -1);
                const auto both =
                    surface.edgeFacets(surface.edgeBetween(beyond.vertices[1], beyond.vertices[2]));
                EXPECT_TRUE(both.has_right);
                const bool is_left = both.left.vertices[0] == facet.vertices[k];
                EXPECT_EQ((is_left ? both.right : both.left).vertices[0], beyond.vertices[0]);
                EXPECT_EQ((is_left ? both.left : both.right).vertices[0], facet.vertices[k]);
            }
            // The foot is the projection of the goal, by weights.
            const MeshGoal goal{{0.3, -0.2, 0.1}, {}};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t to = (k + i + 1) % 3;
                EXPECT_EQ(surface.between(facet, k, to),
                          surface.between(facet.vertices[k], facet.vertices[to]));
                EXPECT_EQ(surface.toGoal(facet, k, goal), surface.toGoal(facet.vertices[k], goal));
            }
            const SurfaceFoot foot = facet.foot(goal);
            EXPECT_NEAR(foot.weights[0] + foot.weights[1] + foot.weights[2], facet.scale,
                        1e-12 * facet.scale * 100.0);
            const ScenePoint at =
                (facet.points[0] * foot.weights[0] + facet.points[1] * foot.weights[1] +
                 facet.points[2] * foot.weights[2]) *
                (1.0 / facet.scale);
            const Vec3 to_goal = goal.scene - at;
            EXPECT_NEAR(length(cross(to_goal, facet.normal)) / length(facet.normal), 0.0, 1e-10);
            EXPECT_EQ(foot.above > 0.0, dot(to_goal, facet.normal) > 0.0);
        }
    }
}

// Between two goals nanometers apart, a million meters from the origin: the position is the nearest
// number, and the rest is what it lacks, exact to a few units in the last place of the way.
// A goal on one of an edge's faces, or in the plane of both, is on the surface: the segment to it
// lies in a face. z = bend |x - 1| is flat, a valley, a ridge.
TEST(MeshSurface, NoWayLeadsOutOfAnEdgeToAGoalOnItsFaces)
{
    for (const double bend : {0.0, 1.0, -1.0}) {
        const MeshSurface surface(
            test::meshOf(test::sheet(3, 3, [bend](int c, int) { return bend * std::abs(c - 1); })));
        SurfaceContact<MeshSurface> contact;
        contact.feature = ContactFeature::Edge;
        contact.edge = surface.edgeBetween({1}, {4}); // from (1, 0) to (1, -1)
        contact.along = 0.5;
        for (const double x : {0.25, 0.5, 1.5, 1.75}) {
            const double z = bend * std::abs(x - 1.0);
            const auto goal = [&](double height) { return *surface.goal({x, -0.5, z + height}); };
            EXPECT_FALSE(surface.wayOut(contact, goal(0.0))) << bend << " " << x;
            EXPECT_FALSE(surface.wayOut(contact, goal(-0.125))) << bend << " " << x;
            EXPECT_TRUE(surface.wayOut(contact, goal(0.125))) << bend << " " << x;
        }
    }
}

TEST(MeshSurface, RefusesGoalsWithAnyCoordinateTooFarAway)
{
    const MeshSurface surface(test::meshOf(test::cube()));
    EXPECT_TRUE(surface.goal({2.0, -3.0, 4.0}));
    for (double ScenePoint::*axis : {&ScenePoint::x, &ScenePoint::y, &ScenePoint::z}) {
        for (const double value :
             {1e300, -1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
            ScenePoint point{2.0, -3.0, 4.0};
            point.*axis = value;
            EXPECT_FALSE(surface.goal(point)) << value;
        }
    }
}

TEST(MeshSurface, GoalsOnAPathOfNanometersKeepTheirRests)
{
    const MeshSurface surface(test::meshOf(test::star()));
    const MeshGoal from{{1e6, -2e6, 3e6}, {1e-11, -2e-11, 3e-11}};
    const MeshGoal to{{1e6 + 0x1p-30, -2e6 - 0x1p-31, 3e6 + 0x1p-29}, {}};
    const Vec3 way = (to.scene - from.scene) + (to.rest - from.rest);
    for (const double share : {0.001, 0.25, 0.7, 0.999}) {
        const MeshGoal at = surface.along(from, to, share);
        const Vec3 gone = (at.scene - from.scene) + (at.rest - from.rest);
        EXPECT_NEAR(length(gone - way * share), 0.0, 1e-15 * length(way)) << share;
        EXPECT_LE(length(at.rest), 0x1p-31 + 6e-11) << "half a unit in the last place, and rests";
        EXPECT_EQ(surface.goalPoint(at), at.scene);
    }
    for (const double share : {0.0, 1.0}) {
        const MeshGoal at = surface.along(from, to, share);
        EXPECT_EQ(at.scene, (share > 0.0 ? to : from).scene);
        EXPECT_EQ(at.rest, (share > 0.0 ? to : from).rest);
    }
    // A long path is resolved by the positions alone.
    const MeshGoal middle = surface.along({{0.0, 0.0, 0.0}, {}}, {{8.0, 4.0, -2.0}, {}}, 0.25);
    EXPECT_EQ(middle.scene, (ScenePoint{2.0, 1.0, -0.5}));
    EXPECT_EQ(middle.rest, Vec3{});
}

} // namespace
} // namespace marsview
