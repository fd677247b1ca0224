#include "core/mesh/mesh_check.h"
#include "tests/core/mesh/mesh_shapes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace marsview {
namespace {

using Kind = MeshFaultKind;

std::vector<MeshFault> faultsOf(const TriangleSoup& soup)
{
    JobMonitor monitor;
    return findMeshFaults(soup.vertices, soup.faces, monitor);
}

// Expects only faults of this kind, `count` of them; returns the indices of their places.
std::vector<std::array<std::uint32_t, 2>>
onlyFault(const TriangleSoup& soup, Kind kind, std::size_t count)
{
    const auto faults = faultsOf(soup);
    if (faults.size() != 1 || faults[0].kind != kind || faults[0].count != count) {
        ADD_FAILURE() << "found: " << describe(faults);
        return {};
    }
    std::vector<std::array<std::uint32_t, 2>> numbers;
    for (const MeshFaultPlace& place : faults[0].first) {
        numbers.push_back(place.numbers);
    }
    return numbers;
}

using testing::ElementsAre;
using Numbers = std::array<std::uint32_t, 2>;

TriangleSoup flatSheet(int columns, int rows)
{
    return test::sheet(columns, rows, [](int, int) { return 0.0; });
}

TEST(MeshCheck, SoundMeshesHaveNoFaults)
{
    for (const auto& soup :
         {test::tetrahedron(), test::cube(), test::icosphere(3), test::torus(20, 10), test::star(),
          test::notchedBlock(1e-6), flatSheet(10, 10),
          test::joined(test::cube(), test::placed(test::cube(), 0.5, {})),
          test::placed(test::star(), 0.01, {5e6, -5e6, 100.0}, test::Turned::Yes),
          test::placed(test::torus(20, 10), 1e9, {}, test::Turned::Yes)}) {
        EXPECT_EQ(describe(faultsOf(soup)), "");
    }
}

TEST(MeshCheck, FindsInvalidCoordinates)
{
    TriangleSoup soup = flatSheet(4, 4);
    soup.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
    soup.vertices[7].z = -std::numeric_limits<double>::infinity();
    soup.vertices[8].x = 1.1e12;
    EXPECT_THAT(onlyFault(soup, Kind::BadCoordinate, 3),
                ElementsAre(Numbers{2, 2}, Numbers{7, 7}, Numbers{8, 8}));
}

TEST(MeshCheck, FindsMissingVertices)
{
    TriangleSoup soup = flatSheet(3, 3);
    soup.faces[5][1] = 9;
    soup.faces[6][2] = 4000000000U;
    EXPECT_THAT(onlyFault(soup, Kind::MissingVertex, 2),
                ElementsAre(Numbers{5, 9}, Numbers{6, 4000000000U}));
}

TEST(MeshCheck, FindsTrianglesWithoutArea)
{
    TriangleSoup soup = test::cube();
    soup.vertices.push_back({3.0, 0.0, 0.0});
    soup.vertices.push_back({4.0, 1.0, 7.0});
    soup.vertices.push_back({5.0, 2.0, 14.0});
    soup.vertices.push_back({3.0, 0.0, 0.0});
    soup.faces.push_back({8, 9, 10});  // corners on a line
    soup.faces.push_back({8, 9, 9});   // a corner twice
    soup.faces.push_back({8, 11, 10}); // two corners at one place
    EXPECT_THAT(onlyFault(soup, Kind::Degenerate, 3),
                ElementsAre(Numbers{12, 12}, Numbers{13, 13}, Numbers{14, 14}));
}

TEST(MeshCheck, FindsDuplicateTriangles)
{
    TriangleSoup soup = test::icosphere(1);
    const auto [a, b, c] = soup.faces[7];
    soup.faces.push_back({b, c, a});
    soup.faces.push_back({b, a, c}); // rotated, but the same corners
    soup.faces.push_back(soup.faces[3]);
    EXPECT_THAT(onlyFault(soup, Kind::Duplicate, 3),
                ElementsAre(Numbers{80, 7}, Numbers{81, 7}, Numbers{82, 3}));
}

TEST(MeshCheck, FindsEdgesOfMoreThanTwoFaces)
{
    TriangleSoup soup = flatSheet(3, 3);
    soup.vertices.push_back({0.3, -0.7, 5.0});
    soup.faces.push_back({0, 4, 9}); // on the diagonal of the first cell
    EXPECT_THAT(onlyFault(soup, Kind::NonManifoldEdge, 1), ElementsAre(Numbers{0, 4}));
}

TEST(MeshCheck, FindsFacesTurnedTheOtherWay)
{
    TriangleSoup soup = test::tetrahedron();
    std::swap(soup.faces[2][0], soup.faces[2][1]);
    EXPECT_THAT(onlyFault(soup, Kind::TurnedFace, 3),
                ElementsAre(Numbers{0, 2}, Numbers{0, 3}, Numbers{2, 3}));
}

TEST(MeshCheck, FindsBowTies)
{
    // Two sheets that share one corner.
    TriangleSoup soup = flatSheet(2, 2);
    soup.vertices.insert(soup.vertices.end(), {{2, -1, 0}, {1, -2, 0}, {2, -2, 0}});
    soup.faces.push_back({3, 6, 4});
    soup.faces.push_back({3, 5, 6});
    EXPECT_THAT(onlyFault(soup, Kind::BowTie, 1), ElementsAre(Numbers{3, 3}));
}

TEST(MeshCheck, FindsSeamsThatAreNotWelded)
{
    // Two adjacent sheets, each with its own vertices along the common border.
    const TriangleSoup left = flatSheet(3, 3);
    for (const double shift : {0.0, 1e-7, -1e-7}) {
        const TriangleSoup soup =
            test::joined(left, test::placed(left, 1.0, {2.0 + shift, 0.0, 0.0}));
        EXPECT_THAT(onlyFault(soup, Kind::Gap, 6),
                    ElementsAre(Numbers{2, 9}, Numbers{5, 12}, Numbers{8, 15}))
            << shift;
    }
    // Farther apart they are two objects.
    EXPECT_EQ(describe(faultsOf(test::joined(left, test::placed(left, 1.0, {2.01, 0.0, 0.0})))),
              "");
}

TEST(MeshCheck, FindsVerticesOnForeignEdges)
{
    // A sheet next to one with half the cell size: at every second vertex of the fine border a T.
    const TriangleSoup coarse = flatSheet(2, 2);
    const TriangleSoup fine = test::placed(flatSheet(3, 3), 0.5, {1.0, 0.0, 0.0});
    // The corners are left out; they would be unwelded.
    TriangleSoup soup = test::joined(coarse, fine);
    for (MeshFace& face : soup.faces) {
        for (std::uint32_t& v : face) {
            v = v == 4 ? 1 : v == 10 ? 3 : v;
        }
    }
    // At these two corners the sheets share no edge.
    const auto faults = faultsOf(soup);
    ASSERT_EQ(faults.size(), 2U) << describe(faults);
    EXPECT_EQ(faults[0].kind, Kind::BowTie);
    EXPECT_EQ(faults[0].count, 2U);
    EXPECT_EQ(faults[1].kind, Kind::Gap);
    EXPECT_EQ(faults[1].count, 1U);
    EXPECT_EQ(faults[1].first[0].numbers[0], 7U);
}

TEST(MeshCheck, FindsIntersections)
{
    // A spike through a sheet: its sides cut the cells it passes.
    TriangleSoup soup = flatSheet(2, 2);
    soup.vertices.insert(soup.vertices.end(), {{0.2, -0.1, 1}, {0.6, -0.1, 1}, {0.5, -0.1, -1}});
    soup.faces.push_back({4, 5, 6});
    EXPECT_THAT(onlyFault(soup, Kind::Intersection, 1), ElementsAre(Numbers{0, 2}));
}

TEST(MeshCheck, FindsFacesThatOnlyTouch)
{
    TriangleSoup soup = flatSheet(2, 2);
    // A corner within a face, from above.
    soup.vertices.insert(soup.vertices.end(), {{0.5, -0.25, 0}, {1, 0, 3}, {0, 0, 3}});
    soup.faces.push_back({4, 5, 6});
    EXPECT_THAT(onlyFault(soup, Kind::Intersection, 1), ElementsAre(Numbers{0, 2}));
    // Above it by the smallest possible distance.
    soup.vertices[4].z = 0x1p-300;
    EXPECT_EQ(describe(faultsOf(soup)), "");
    // In the plane of the sheet, overlapping it.
    soup = test::joined(flatSheet(2, 2), test::placed(flatSheet(2, 2), 0.25, {0.6, -0.05, 0.0}));
    EXPECT_EQ(faultsOf(soup).at(0).kind, Kind::Intersection);
    EXPECT_EQ(faultsOf(soup).size(), 1U);
}

TEST(MeshCheck, FindsNeighborsThatFoldOntoEachOther)
{
    // Sharing an edge, folded back in the plane.
    TriangleSoup soup{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1.2, 0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    EXPECT_THAT(onlyFault(soup, Kind::Intersection, 1), ElementsAre(Numbers{0, 1}));
    soup.vertices[3].z = 1e-9;
    EXPECT_EQ(describe(faultsOf(soup)), "");
    // Sharing a vertex of a fan, one face cut by another.
    soup = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {1, 1, 1}, {1, 1, -1}},
            {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}}};
    const auto faults = faultsOf(soup);
    ASSERT_EQ(faults.size(), 2U) << describe(faults); // their own fan is a bow-tie too
    EXPECT_EQ(faults[0].kind, Kind::BowTie);
    EXPECT_EQ(faults[1].kind, Kind::Intersection);
    EXPECT_EQ(faults[1].count, 1U);
    EXPECT_EQ(faults[1].first[0].numbers, (Numbers{0, 2}));
}

TEST(MeshCheck, ReportsEachKindWithCountAndPositions)
{
    TriangleSoup soup = test::cube();
    soup.vertices[0].x = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 5; ++i) {
        soup.faces.push_back({3, 3, static_cast<std::uint32_t>(i + 3)});
    }
    EXPECT_EQ(describe(faultsOf(soup)),
              "1 coordinate that is not a number within 1e12 m (vertex 1, nan, -1, -1), "
              "5 triangles without area (face 13 at 1, 1, -1; face 14 at 1, 1, -1; face 15 at 1, "
              "1, -1; …)");
}

TEST(MeshCheck, CountsIntersectionsLikeATestOfAllPairs)
{
    // Random triangles at integer coordinates, where contact is common. The truth comes from exact
    // integer segment-triangle tests.
    test::Random random;
    using Whole = std::int64_t;
    using Point = std::array<Whole, 3>;
    const auto minus = [](const Point& a, const Point& b) {
        return Point{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto cross_of = [](const Point& a, const Point& b) {
        return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot_of = [](const Point& a, const Point& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    // Two closed convex sets are disjoint if one of these axes separates them; if coplanar, also if
    // a normal of an edge within the plane does.
    const auto are_apart = [&](const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
        const Point n = cross_of(minus(p[1], p[0]), minus(p[2], p[0]));
        const Point m = cross_of(minus(q[1], q[0]), minus(q[2], q[0]));
        std::vector<Point> axes{n, m};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point e = minus(p[(i + 1) % 3], p[i]);
            const Point f = minus(q[(i + 1) % 3], q[i]);
            axes.push_back(cross_of(e, n));
            axes.push_back(cross_of(f, m));
            for (std::size_t j = 0; j < 3; ++j) {
                axes.push_back(cross_of(e, minus(q[(j + 1) % 3], q[j])));
            }
        }
        return std::any_of(axes.begin(), axes.end(), [&](const Point& axis) {
            const auto [p_low, p_high] =
                std::minmax({dot_of(axis, p[0]), dot_of(axis, p[1]), dot_of(axis, p[2])});
            const auto [q_low, q_high] =
                std::minmax({dot_of(axis, q[0]), dot_of(axis, q[1]), dot_of(axis, q[2])});
            return p_high < q_low || q_high < p_low;
        });
    };
    std::size_t met = 0;
    std::size_t apart = 0;
    while (met + apart < 20000) {
        std::array<std::array<Point, 3>, 2> t{};
        TriangleSoup soup;
        for (auto& triangle : t) {
            for (Point& p : triangle) {
                for (Whole& x : p) {
                    x = static_cast<Whole>(random.below(6));
                }
                soup.vertices.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]),
                                         static_cast<double>(p[2])});
            }
        }
        soup.faces = {{0, 1, 2}, {3, 4, 5}};
        bool is_degenerate = false;
        for (const auto& [a, b, c] : t) {
            is_degenerate = is_degenerate || cross_of(minus(b, a), minus(c, a)) == Point{};
        }
        if (is_degenerate) {
            continue;
        }
        const bool truth = !are_apart(t[0], t[1]);
        (truth ? met : apart) += 1;
        const auto faults = faultsOf(soup);
        ASSERT_EQ(!faults.empty(), truth) << describe(faults);
    }
    std::printf("%zu met, %zu apart\n", met, apart);
    EXPECT_GT(met, 3000U);
    EXPECT_GT(apart, 3000U);
}

} // namespace
} // namespace marsview
