#include "core/mesh/triangle_mesh.h"
#include "tests/core/mesh/mesh_shapes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace marsview {
namespace {

std::vector<test::NamedMesh> closedAndOpenMeshes()
{
    auto all = test::closedMeshes();
    test::Random random;
    const auto rough = [&random](int, int) { return random.uniform(0.0, 3.0); };
    all.push_back({"sheet", test::meshOf(test::sheet(30, 20, rough)), 30.0, {}});
    all.push_back({"one triangle",
                   test::meshOf({{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 3}}}),
                   1.0,
                   {}});
    return all;
}

TEST(TriangleMesh, ShapesAreClosedAndFaceOutward)
{
    for (const auto& [name, mesh, size, middle] : test::closedMeshes()) {
        int border = 0;
        for (std::uint32_t corner = 0; corner < 3 * mesh->faceCount(); ++corner) {
            border += mesh->across(corner) == TriangleMesh::kNone ? 1 : 0;
        }
        EXPECT_EQ(border, 0) << name;
        EXPECT_NEAR(test::windingNumber(*mesh, middle + Vec3{10.0 * size, size, size}), 0.0, 1e-9)
            << name;
        // Slightly behind the first face.
        const auto [a, b, c] = mesh->points(0);
        const Vec3 inward = -normalized(mesh->normal(0));
        const ScenePoint inside = (a + b + c) * (1.0 / 3.0) + inward * (1e-4 * length(b - a));
        EXPECT_NEAR(test::windingNumber(*mesh, inside), 1.0, 1e-9) << name;
    }
}

TEST(TriangleMesh, AcrossAnEdgeIsTheFaceWithTheSameEdgeTurned)
{
    for (const auto& [name, mesh, size, middle] : closedAndOpenMeshes()) {
        for (std::uint32_t corner = 0; corner < 3 * mesh->faceCount(); ++corner) {
            const auto from = mesh->vertexAt(TriangleMesh::nextCorner(corner));
            const auto to = mesh->vertexAt(TriangleMesh::previousCorner(corner));
            const std::uint32_t beyond = mesh->across(corner);
            std::vector<std::uint32_t> truth;
            for (std::uint32_t other = 0; other < 3 * mesh->faceCount() && truth.empty(); ++other) {
                if (mesh->vertexAt(TriangleMesh::nextCorner(other)) == to &&
                    mesh->vertexAt(TriangleMesh::previousCorner(other)) == from) {
                    truth.push_back(other);
                }
            }
            if (beyond == TriangleMesh::kNone) {
                ASSERT_TRUE(truth.empty()) << name;
            } else {
                ASSERT_THAT(truth, testing::ElementsAre(beyond)) << name;
                ASSERT_EQ(mesh->across(beyond), corner) << name;
            }
        }
    }
}

TEST(TriangleMesh, FansAreAllFacesOfAVertexInTurn)
{
    for (const auto& [name, mesh, size, middle] : closedAndOpenMeshes()) {
        for (std::uint32_t v = 0; v < mesh->vertexCount(); ++v) {
            std::set<std::uint32_t> truth;
            for (std::uint32_t corner = 0; corner < 3 * mesh->faceCount(); ++corner) {
                if (mesh->vertexAt(corner) == v) {
                    truth.insert(corner);
                }
            }
            const auto fan = mesh->fan(v);
            ASSERT_EQ(std::set<std::uint32_t>(fan.begin(), fan.end()), truth) << name;
            ASSERT_EQ(fan.size(), truth.size()) << name;
            bool is_closed = !fan.empty();
            for (std::size_t i = 0; i < fan.size(); ++i) {
                const std::uint32_t next = fan[(i + 1) % fan.size()];
                const bool is_joined = mesh->vertexAt(TriangleMesh::previousCorner(fan[i])) ==
                                       mesh->vertexAt(TriangleMesh::nextCorner(next));
                ASSERT_TRUE(is_joined || i + 1 == fan.size()) << name;
                is_closed = is_closed && is_joined;
            }
            ASSERT_EQ(mesh->isAtBorder(v), !is_closed) << name;
        }
    }
}

TEST(TriangleMesh, RefusesAMeshWithoutTriangles)
{
    JobMonitor monitor;
    EXPECT_EQ(TriangleMesh::build({}, monitor).error().message, "the mesh has no triangles");
}

TEST(TriangleMesh, RefusesFaultsWithTheirPositions)
{
    JobMonitor monitor;
    TriangleSoup soup = test::cube();
    soup.faces.push_back({0, 1, 0});
    const auto mesh = TriangleMesh::build(soup, monitor);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().message,
              "the mesh cannot be touched: 1 triangle without area (face 13 "
              "at -1, -1, -1)");
}

TEST(TriangleMesh, CanBeCanceled)
{
    JobMonitor monitor;
    monitor.cancel();
    EXPECT_EQ(TriangleMesh::build(test::cube(), monitor).error().code, ErrorCode::Canceled);
}

TEST(TriangleTree, BoxQueriesFindAllFacesThatIntersectThem)
{
    test::Random random;
    for (const auto& [name, mesh, size, middle] : closedAndOpenMeshes()) {
        for (int i = 0; i < 300; ++i) {
            const ScenePoint a = middle + test::randomDirection(random) * random.uniform(0.0, size);
            const Vec3 reach = Vec3{random.unit(), random.unit(), random.unit()} *
                               (size * (random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.5)));
            std::set<std::uint32_t> found;
            mesh->tree().inBox(a - reach, a + reach,
                               [&found](std::uint32_t f) { ASSERT_TRUE(found.insert(f).second); });
            for (std::uint32_t f = 0; f < mesh->faceCount(); ++f) {
                const auto p = mesh->points(f);
                const auto meets = [&](auto coordinate) {
                    const auto [low, high] =
                        std::minmax({coordinate(p[0]), coordinate(p[1]), coordinate(p[2])});
                    return low <= coordinate(a + reach) && high >= coordinate(a - reach);
                };
                const bool is_met = meets([](const Vec3& v) { return v.x; }) &&
                                    meets([](const Vec3& v) { return v.y; }) &&
                                    meets([](const Vec3& v) { return v.z; });
                ASSERT_TRUE(!is_met || found.contains(f)) << name;
            }
        }
    }
}

TEST(TriangleTree, EveryFaceIsInTheTreeOnce)
{
    for (const auto& [name, mesh, size, middle] : closedAndOpenMeshes()) {
        std::vector<int> seen(mesh->faceCount(), 0);
        const Vec3 reach{20.0 * size, 20.0 * size, 20.0 * size};
        mesh->tree().inBox(middle - reach, middle + reach, [&seen](std::uint32_t f) { ++seen[f]; });
        EXPECT_THAT(seen, testing::Each(1)) << name;
    }
}

TEST(TriangleTree, ManyCoincidentFacesDoNotMakeItDeep)
{
    // Centers at equal positions, and at distances that double: cases that mislead spatial
    // splitting.
    TriangleSoup soup;
    for (int i = 0; i < 3000; ++i) {
        const double s = std::ldexp(1.0, i % 60 - 30);
        const double z = i < 1500 ? 0.0 : s;
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), {{-s, -s, z}, {2 * s, -s, z}, {-s, 2 * s, z}});
        soup.faces.push_back({first, first + 1, first + 2});
    }
    std::vector<std::uint32_t> which(soup.faces.size());
    for (std::uint32_t i = 0; i < which.size(); ++i) {
        which[i] = i;
    }
    const TriangleTree tree(soup.vertices, soup.faces, which); // checks its depth
    std::size_t count = 0;
    tree.inBox({-1e12, -1e12, -1e12}, {1e12, 1e12, 1e12}, [&count](std::uint32_t) { ++count; });
    EXPECT_EQ(count, which.size());
}

} // namespace
} // namespace marsview
