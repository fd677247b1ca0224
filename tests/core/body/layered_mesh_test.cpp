#include "core/body/layered_mesh.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace marsview {
namespace {

using test::NestedMaps;

// Where the borders of two maps cross over a third, walls of straight edges may intersect by a
// little.
class PairMesh : public testing::TestWithParam<NestedMaps> {};
class NestedMesh : public testing::TestWithParam<NestedMaps> {};

// mesh_check.h finds gaps, T-junctions, turned faces, bow ties and faces that intersect, without
// rounding error. It does not share code with what cuts the maps.
TEST_P(PairMesh, IsAClosedSurfaceWithoutFaults)
{
    const auto maps = test::meshesOf(GetParam());
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const TriangleSoup soup = test::listOf(**mesh);
    const auto listed = TriangleMesh::build(soup, monitor);
    ASSERT_TRUE(listed) << listed.error().message;
    // A sphere: V - E + F = 2, and an edge has two faces.
    std::set<BodyIndex> vertices;
    for (const MeshFace& face : soup.faces) {
        vertices.insert(face.begin(), face.end());
    }
    EXPECT_EQ(soup.faces.size() % 2, 0U);
    EXPECT_EQ(static_cast<long>(vertices.size()) - static_cast<long>(soup.faces.size() / 2), 2);
}

TEST_P(NestedMesh, ItsCornersAreNeighborsOfEachOther)
{
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(test::meshesOf(GetParam()), monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const LayeredMesh& m = **mesh;
    std::map<BodyIndex, std::size_t> corners; // of a vertex
    for (BodyIndex face = 0; face < m.faceCount(); ++face) {
        if (m.isGone(face)) {
            continue;
        }
        for (BodyIndex corner = 3 * face; corner < 3 * face + 3; ++corner) {
            const BodyIndex beyond = m.across(corner);
            ASSERT_NE(beyond, LayeredMesh::kNone);
            ASSERT_FALSE(m.isGone(beyond / 3));
            ASSERT_EQ(m.across(beyond), corner);
            ASSERT_EQ(m.vertexAt(LayeredMesh::nextCorner(corner)),
                      m.vertexAt(LayeredMesh::previousCorner(beyond)));
            ASSERT_EQ(m.vertexAt(LayeredMesh::previousCorner(corner)),
                      m.vertexAt(LayeredMesh::nextCorner(beyond)));
            ++corners[m.vertexAt(corner)];
        }
    }
    for (const auto& [vertex, count] : corners) {
        const LayeredFan fan = m.fan(vertex);
        ASSERT_EQ(fan.size(), count);
        for (std::size_t i = 0; i < fan.size(); ++i) {
            const BodyIndex corner = fan.begin()[i];
            ASSERT_EQ(m.vertexAt(corner), vertex);
            const BodyIndex next = fan.begin()[(i + 1) % fan.size()];
            ASSERT_EQ(LayeredMesh::nextCorner(m.across(LayeredMesh::nextCorner(corner))), next);
        }
    }
}

// Straight below a place lies the uppermost map with data there: each map asked by itself.
TEST_P(NestedMesh, LiesAtEachPlaceWhereTheUppermostMapLies)
{
    const auto maps = test::meshesOf(GetParam());
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    test::Random random(17);
    const double cell_m = test::cellOf(*maps.front());
    // An edge that is straight in space is not quite one over the ellipsoid: by a share of how far
    // it lies below that.
    const double sag_m = cell_m * cell_m / (8.0 * 3396190.0);
    const double exact_m = 1e-6 * cell_m + 3e-4 * sag_m;
    int upper = 0;
    int near_border = 0;
    constexpr int kPlaces = 100;
    for (int i = 0; i < kPlaces; ++i) {
        const ScenePoint place = test::placeNear(*maps.front(), random);
        const auto found = test::below(**mesh, place);
        ASSERT_TRUE(found) << i;
        const auto expected = test::uppermostBelow(maps, place);
        ASSERT_TRUE(expected) << i;
        upper += expected->map == 0 ? 1 : 0;
        if (std::abs(found->height_m - expected->height_m) > exact_m) {
            ++near_border;
            EXPECT_LT(test::distanceToRim(*maps.front(), place), 0.003 * cell_m)
                << found->height_m << " " << expected->height_m;
        }
    }
    EXPECT_GT(upper, kPlaces / 10);
    EXPECT_LT(upper, kPlaces);
    EXPECT_LE(near_border, kPlaces / 50);
}

const auto kNameOf = [](const auto& tested) { return tested.param.name; };

INSTANTIATE_TEST_SUITE_P(LayeredMesh, PairMesh, testing::ValuesIn(test::nestedMaps()), kNameOf);
INSTANTIATE_TEST_SUITE_P(LayeredMesh, NestedMesh, testing::ValuesIn(test::nestedMaps()), kNameOf);
INSTANTIATE_TEST_SUITE_P(ThreeMaps, NestedMesh, testing::Values(test::crossingMaps()), kNameOf);

TEST(LayeredMesh, RefusesABorderThatLeadsBeyondTheMapsBelow)
{
    const auto maps = test::meshesOf(test::beyondMaps());
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::Unsupported);
    // In the other order too; what does not meet is joined as it is.
    EXPECT_FALSE(LayeredMesh::build({maps[1], maps[0]}, monitor));
    monitor.cancel();
    const auto canceled = LayeredMesh::build(test::meshesOf(test::levelStep()), monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

TEST(LayeredMesh, AMapOverAllOfAnotherHidesIt)
{
    auto maps = test::meshesOf(test::levelStep());
    std::swap(maps[0], maps[1]);
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(test::listOf(**mesh).faces.size(), maps[0]->faceCount());
}

} // namespace
} // namespace marsview
