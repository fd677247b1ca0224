#include "core/mesh/mesh_cast.h"
#include "core/mesh/predicates.h"
#include "tests/core/mesh/mesh_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

using Real = long double;

struct Exact {
    Real x;
    Real y;
    Real z;
};
Exact from(const Vec3& a, const Vec3& b)
{
    return {static_cast<Real>(b.x) - static_cast<Real>(a.x),
            static_cast<Real>(b.y) - static_cast<Real>(a.y),
            static_cast<Real>(b.z) - static_cast<Real>(a.z)};
}
Real volume(const Exact& a, const Exact& b, const Exact& c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
}

// Where the segment enters through the front of a face, and with which margin: signed volumes in
// long double, the smallest of them relative to its largest possible value.
struct BruteHit {
    Real t = 2;
    Real margin = 1; // of the closest decision, over all faces
    std::uint32_t face = 0;
};

BruteHit bruteCast(const TriangleMesh& mesh, const ScenePoint& start, const ScenePoint& goal)
{
    BruteHit hit;
    const Exact along = from(start, goal);
    const auto length_of = [](const Exact& a) {
        return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    };
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
        const auto p = mesh.points(f);
        const Exact a = from(start, p[0]);
        const Exact b = from(start, p[1]);
        const Exact c = from(start, p[2]);
        const Real la = length_of(a);
        const Real lb = length_of(b);
        const Real lc = length_of(c);
        const Real ld = length_of(along);
        const std::array<Real, 3> w{volume(along, c, b) / (ld * lc * lb),
                                    volume(along, a, c) / (ld * la * lc),
                                    volume(along, b, a) / (ld * lb * la)};
        const Exact ab = from(p[0], p[1]);
        const Exact ac = from(p[0], p[2]);
        const Real scale = length_of(ab) * length_of(ac);
        const Real above = -volume(a, ab, ac) / (scale * std::max({la, lb, lc}));
        const Exact to_goal = from(p[0], goal);
        const Real at_goal = volume(to_goal, ab, ac) / (scale * std::max(length_of(to_goal), lc));
        const bool is_hit = w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && above > 0 && at_goal <= 0;
        // A decision counts only if the others do not already rule the hit out.
        const Real worst = std::min({w[0], w[1], w[2], above, -at_goal});
        hit.margin = std::min(hit.margin, std::abs(worst));
        if (is_hit) {
            const Real up = -volume(a, ab, ac);
            const Real t = up / (up - volume(to_goal, ab, ac));
            if (t < hit.t) {
                hit.t = t;
                hit.face = f;
            }
        }
    }
    return hit;
}

ScenePoint pointOf(const TriangleMesh& mesh, const MeshPlace& place)
{
    const auto [a, b, c] = mesh.points(place.face);
    return a + ((b - a) * place.weights[1] + (c - a) * place.weights[2]);
}

std::vector<test::NamedMesh> meshes()
{
    auto all = test::closedMeshes();
    test::Random random;
    const auto rough = [&random](int, int) { return random.uniform(0.0, 3.0); };
    all.push_back({"sheet", test::meshOf(test::sheet(20, 20, rough)), 15.0, {9.5, -9.5, 1.0}});
    return all;
}

TEST(MeshCast, MatchesATestOfAllTriangles)
{
    test::Random random;
    int compared = 0;
    int hits = 0;
    for (const auto& [name, mesh, size, middle] : meshes()) {
        for (int i = 0; i < 3000; ++i) {
            const double reach = random.chance(0.2) ? 30.0 * size : 1.5 * size;
            const ScenePoint start =
                middle + test::randomDirection(random) * random.uniform(0, reach);
            const ScenePoint goal =
                middle + test::randomDirection(random) * random.uniform(0, reach);
            const BruteHit truth = bruteCast(*mesh, start, goal);
            if (truth.margin < 1e-12) {
                continue; // closer than double precision; the tests below cover these
            }
            ++compared;
            const MeshCast cast = castSegment(*mesh, {.base = start}, {goal});
            ASSERT_EQ(cast.hit.has_value(), truth.t <= 1) << name;
            if (cast.hit) {
                ++hits;
                const ScenePoint met = start + (goal - start) * static_cast<double>(truth.t);
                ASSERT_LT(length(pointOf(*mesh, *cast.hit) - met), 1e-9 * (size + length(met)))
                    << name;
                ASSERT_EQ(cast.hit->face, truth.face) << name;
            }
        }
    }
    std::printf("%d compared, %d hits\n", compared, hits);
    EXPECT_GT(compared, 30000);
    EXPECT_GT(hits, 8000);
}

// From outside a closed mesh to inside it, aimed through vertices, edges and along faces.
TEST(MeshCast, NothingSlipsIntoAClosedMesh)
{
    test::Random random;
    int casts = 0;
    for (const auto& [name, mesh, size, middle] : test::closedMeshes()) {
        // Points deep inside, far from every face.
        std::vector<ScenePoint> inside;
        for (int i = 0; i < 4000 && inside.size() < 20; ++i) {
            const ScenePoint p =
                middle + test::randomDirection(random) * random.uniform(0, 1.2 * size);
            if (test::windingNumber(*mesh, p) > 0.5 &&
                test::bruteDistance(*mesh, p) > 1e-3 * size) {
                inside.push_back(p);
            }
        }
        ASSERT_FALSE(inside.empty()) << name;
        for (int i = 0; i < 4000; ++i) {
            const ScenePoint goal = inside[random.below(inside.size())];
            const auto corners =
                mesh->points(static_cast<std::uint32_t>(random.below(mesh->faceCount())));
            const std::size_t kind = random.below(3);
            ScenePoint through = corners[random.below(3)];
            if (kind > 0) {
                const double share = random.chance(0.3) ? 0.5 : random.unit();
                through = corners[0] + (corners[1] - corners[0]) * share;
            }
            if (kind > 1) {
                through = through + (corners[2] - through) * random.unit();
            }
            // Start, vertex and goal are exactly in line, as often as rounding allows.
            const double times = std::ldexp(1.0, static_cast<int>(random.below(12)));
            const ScenePoint start = goal + (through - goal) * (1.0 + times);
            if (test::windingNumber(*mesh, start) > 0.5 ||
                test::bruteDistance(*mesh, start) < 1e-6 * size) {
                continue;
            }
            ++casts;
            const MeshCast cast = castSegment(*mesh, {.base = start}, {goal});
            ASSERT_TRUE(cast.hit) << name;
            const ScenePoint met = pointOf(*mesh, *cast.hit);
            ASSERT_LT(test::bruteDistance(*mesh, met), 1e-12 * (size + length(met))) << name;
            // It lies on the segment.
            const Vec3 along = normalized(goal - start);
            ASSERT_LT(length(cross(met - start, along)),
                      1e-10 * (size + length(met) + length(goal - start)))
                << name;
        }
    }
    std::printf("%d casts\n", casts);
    EXPECT_GT(casts, 20000);
}

TEST(MeshCast, HitsEdgesAndVerticesOfAGridExactly)
{
    // Straight down onto whole and half coordinates: no rounding.
    const auto mesh = test::meshOf(
        test::sheet(9, 9, [](int c, int r) { return static_cast<double>((3 * c + 5 * r) % 4); }));
    for (int i = 0; i <= 16; ++i) {
        for (int j = 0; j <= 16; ++j) {
            const double x = 0.5 * i;
            const double y = -0.5 * j;
            for (const Vec3& slant :
                 {Vec3{0, 0, 0}, Vec3{1, 2, 0}, Vec3{-3, 1, 0}, Vec3{0, 1, 0}}) {
                const ScenePoint start = ScenePoint{x, y, 32.0} + slant * 0.125;
                const ScenePoint goal = ScenePoint{x, y, -32.0} - slant * 0.125;
                const MeshCast cast = castSegment(*mesh, {.base = start}, {goal});
                const bool is_inner = i > 0 && i < 16 && j > 0 && j < 16;
                ASSERT_TRUE(cast.hit || !is_inner) << x << ", " << y;
                if (!(slant == Vec3{})) {
                    continue;
                }
                ASSERT_TRUE(cast.hit);
                const auto zeros =
                    std::count(cast.hit->weights.begin(), cast.hit->weights.end(), 0);
                EXPECT_EQ(zeros, i % 2 == 0 && j % 2 == 0 ? 2 : 1) << x << ", " << y;
                EXPECT_EQ(pointOf(*mesh, *cast.hit).x, x);
                EXPECT_EQ(pointOf(*mesh, *cast.hit).y, y);
            }
        }
    }
}

TEST(MeshCast, HitsFacesFromTheFrontOnly)
{
    const auto mesh = test::meshOf(test::sheet(3, 3, [](int, int) { return 0.0; }));
    EXPECT_TRUE(castSegment(*mesh, {.base = {0.7, -0.4, 1}}, {{0.7, -0.4, -1}}).hit);
    EXPECT_FALSE(castSegment(*mesh, {.base = {0.7, -0.4, -1}}, {{0.7, -0.4, 1}}).hit);
    // A segment that ends on the plane hits; one within the plane, or past the border, does not.
    EXPECT_TRUE(castSegment(*mesh, {.base = {0.7, -0.4, 1}}, {{0.7, -0.4, 0}}).hit);
    EXPECT_FALSE(castSegment(*mesh, {.base = {0.7, -0.4, 1}}, {{0.7, -0.4, 0x1p-80}}).hit);
    EXPECT_FALSE(castSegment(*mesh, {.base = {-1, -0.4, 0.5}}, {{1, -0.4, 0.5}}).hit);
    EXPECT_FALSE(castSegment(*mesh, {.base = {2.1, -0.4, 1}}, {{2.1, -0.4, -1}}).hit);
    EXPECT_FALSE(castSegment(*mesh, {.base = {0.7, -0.4, 1}}, {{0.7, -0.4, 1}}).hit);
}

TEST(MeshCast, AStartThatRoundingPutBehindAFaceIsStoppedByIt)
{
    test::Random random;
    for (const auto& [name, mesh, size, middle] : test::closedMeshes()) {
        for (int i = 0; i < 2000; ++i) {
            const auto face = static_cast<std::uint32_t>(random.below(mesh->faceCount()));
            const auto [a, b, c] = mesh->points(face);
            const double u = random.unit();
            const double v = random.unit() * (1.0 - u);
            // The start is rounded: behind the face as often as in front.
            const ScenePoint start = a + ((b - a) * u + (c - a) * v);
            const double edge = length(b - a);
            if (length(start) * 0x1p-52 > 1e-15 * edge) {
                continue; // the rounding error is too large for the face
            }
            const ScenePoint goal =
                start - normalized(mesh->normal(face)) * (edge * random.uniform(1e-6, 1.0)) +
                (b - a) * random.uniform(-1e-3, 1e-3);
            if (sideOfPlane(a, b, c, goal) > 0) {
                continue;
            }
            const MeshCast cast = castSegment(*mesh, {.base = start}, {goal});
            ASSERT_TRUE(cast.hit) << name;
            ASSERT_LT(length(pointOf(*mesh, *cast.hit) - start), 1e-11 * size) << name;
        }
    }
}

TEST(NearestPlace, MatchesTheNearestOfAllTriangles)
{
    test::Random random;
    for (const auto& [name, mesh, size, middle] : meshes()) {
        for (int i = 0; i < 1000; ++i) {
            const double reach = random.chance(0.1) ? 1e4 * size : 1.5 * size;
            const ScenePoint p = middle + test::randomDirection(random) * random.uniform(0, reach);
            const MeshPlace place = nearestPlace(*mesh, p);
            const double truth = test::bruteDistance(*mesh, p);
            ASSERT_NEAR(length(pointOf(*mesh, place) - p), truth,
                        1e-13 * (truth + size) + 4e-16 * length(middle))
                << name;
        }
    }
}

} // namespace
} // namespace marsview
