#include "core/body/body_mesh.h"
#include "core/mesh/mesh_cast_definitions.h"
#include "core/mesh/triangle_mesh.h"
#include "tests/core/contact/body_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace marsview {
namespace {

class BodyMeshOf : public testing::TestWithParam<test::BodyMap> {};

// TriangleMesh finds the same neighbors from the triangles alone, and refuses meshes with faults.
TEST_P(BodyMeshOf, ItsTrianglesHaveTheNeighborsThatAListOfThemHas)
{
    const auto mesh = test::bodyMesh(GetParam(), 1.0);
    const auto listed = test::listedMesh(*mesh);
    ASSERT_EQ(mesh->faceCount(), listed->faceCount());
    for (std::uint32_t corner = 0; corner < 3 * mesh->faceCount(); ++corner) {
        const std::uint32_t beyond = listed->across(corner);
        ASSERT_EQ(mesh->across(corner),
                  beyond == TriangleMesh::kNone ? BodyMesh::kNone : BodyIndex{beyond})
            << corner;
        ASSERT_EQ(mesh->vertexAt(corner), listed->vertexAt(corner)) << corner;
    }
    for (std::uint32_t vertex = 0; vertex < mesh->vertexCount(); ++vertex) {
        const FanCorners fan = mesh->fan(vertex);
        const auto expected = listed->fan(vertex);
        ASSERT_EQ(std::vector(fan.begin(), fan.end()).size(), expected.size()) << vertex;
        ASSERT_EQ(mesh->isAtBorder(vertex), listed->isAtBorder(vertex));
        // A fan that closes may begin at any corner.
        const auto begin = std::find(fan.begin(), fan.end(), expected.front());
        ASSERT_NE(begin, fan.end()) << vertex;
        std::vector<BodyIndex> turned(begin, fan.end());
        turned.insert(turned.end(), fan.begin(), begin);
        ASSERT_TRUE(std::equal(turned.begin(), turned.end(), expected.begin())) << vertex;
    }
}

// What walks find by adding columns and rows is what the adjacency says.
TEST_P(BodyMeshOf, StepsOverEdgesLeadToTheFaceBeyond)
{
    const auto mesh = test::bodyMesh(GetParam(), 1.0);
    std::size_t steps = 0;
    for (BodyIndex corner = 0; corner < 3 * mesh->faceCount(); ++corner) {
        const BodyIndex next = BodyMesh::nextCorner(corner);
        const BodyIndex previous = BodyMesh::previousCorner(corner);
        const std::array ends{mesh->vertexAt(next), mesh->vertexAt(previous)};
        const BodyIndex beyond = mesh->across(corner);
        ASSERT_EQ(mesh->edgeEnds(corner), ends);
        ASSERT_EQ(mesh->cornerAtEdge(ends[0], ends[1]), std::min(corner, beyond));
        ASSERT_EQ(mesh->cornerAtEdge(ends[1], ends[0]), std::min(corner, beyond));

        const auto at = mesh->stepsFrom(corner / 3);
        const BodySample far = BodyMesh::step(at[corner % 3], at[next % 3], at[previous % 3]);
        if (!mesh->isSample(far)) {
            continue;
        }
        ++steps;
        ASSERT_NE(beyond, BodyMesh::kNone);
        ASSERT_EQ(mesh->vertexOf(far), mesh->vertexAt(beyond));
        ASSERT_EQ(mesh->cornerOf({far, at[previous % 3], at[next % 3]}), beyond);
        ASSERT_EQ(mesh->cornerOf({at[corner % 3], at[next % 3], at[previous % 3]}), corner);
    }
    // Most edges of cells are between cells away from the seam: each has three.
    EXPECT_GE(steps, std::size_t{2} * mesh->cellColumns() * mesh->cellRows() / 2);
}

// From inside the body, from far out, and from beside the map. TriangleMesh has the nearest place
// of its triangles (mesh.NearestPlace), and compares all of a box.
TEST_P(BodyMeshOf, TheNearestPlaceIsThatOfAListOfItsTriangles)
{
    const auto mesh = test::bodyMesh(GetParam(), 1.0);
    const auto listed = test::listedMesh(*mesh);
    std::mt19937 random(26);
    std::uniform_int_distribution<std::size_t> vertex(0, mesh->vertexCount() - 1);
    std::normal_distribution<double> shift(0.0, 1.0);
    for (int i = 0; i < 300; ++i) {
        const ScenePoint on = mesh->vertex(static_cast<BodyIndex>(vertex(random)));
        const double reach_m = length(on) * std::pow(10.0, -1.0 - i % 6);
        const ScenePoint point = on + Vec3{shift(random), shift(random), shift(random)} * reach_m;
        const auto distance = [&](const auto& of) {
            const auto place = nearestPlace(of, point);
            const auto corners = of.points(place.face);
            Vec3 at{};
            for (std::size_t k = 0; k < 3; ++k) {
                at = at + (corners[k] - point) * place.weights[k];
            }
            return length(at);
        };
        const double expected_m = distance(*listed);
        EXPECT_NEAR(distance(*mesh), expected_m, 1e-12 * length(point)) << i;
    }
}

// A map around the body with both poles closed encloses the body: the divergence theorem gives its
// volume, which for a dense grid approaches the ellipsoid's.
TEST(BodyMesh, AMapOfTheWholeBodyEnclosesIt)
{
    test::BodyMap smooth = test::wholeMars(360, 180);
    smooth.relief_m = 0.0;
    const auto mesh = test::bodyMesh(smooth, 1.0);
    double volume_m3 = 0.0;
    for (BodyIndex face = 0; face < mesh->faceCount(); ++face) {
        const auto [a, b, c] = mesh->points(face);
        volume_m3 += dot(a, cross(b, c)) / 6.0;
    }
    const Ellipsoid& body = mesh->positions().ellipsoid();
    const double expected_m3 =
        4.0 / 3.0 * std::numbers::pi * body.equatorial_m * body.equatorial_m * body.polar_m;
    // Triangles of 1° lie below the curve by up to (π / 180)² / 4 of the radius.
    EXPECT_LT(volume_m3 / expected_m3, 1.0);
    EXPECT_GT(volume_m3 / expected_m3, 1.0 - 3.0 * 7.6e-5);
}

// The triangles that close the pole are no steeper than the steepest one between samples.
TEST(BodyMesh, ThePoleOfRoughTerrainHasNoCliffs)
{
    const test::BodyMap rough{"RoughPole", "IAU_2015:49900",           1440,
                              6,           {0, 0.25, 0, 90, 0, -0.25}, 400.0};
    const auto mesh = test::bodyMesh(rough, 1.0);
    const BodyIndex first_of_pole = BodyIndex{2} * mesh->cellColumns() * mesh->cellRows();
    double steepest_of_cells = 0.0;
    double steepest_of_pole = 0.0;
    for (BodyIndex face = 0; face < mesh->faceCount(); ++face) {
        const Vec3 normal = mesh->normal(face);
        const Vec3 up = verticalAt(mesh->ellipsoid(), mesh->points(face)[0]).up;
        const double slope = std::acos(std::min(1.0, dot(normal, up) / length(normal)));
        double& steepest = face < first_of_pole ? steepest_of_cells : steepest_of_pole;
        steepest = std::max(steepest, slope);
    }
    EXPECT_GT(steepest_of_pole, 0.0);
    EXPECT_LE(steepest_of_pole, steepest_of_cells);
}

INSTANTIATE_TEST_SUITE_P(BodyMesh,
                         BodyMeshOf,
                         testing::ValuesIn(test::bodyMaps()),
                         [](const auto& tested) { return tested.param.name; });

} // namespace
} // namespace marsview
