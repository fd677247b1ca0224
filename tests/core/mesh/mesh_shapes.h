// Meshes for contact tests, and reference values from sums over all their triangles.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "tests/support/random.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace marsview::test {

TriangleSoup tetrahedron();
/// From -1 to 1, two triangles per side.
TriangleSoup cube();
/// Radius 1, 20 × 4^level triangles.
TriangleSoup icosphere(int level);
/// Around the z axis, radii 1 and 0.4.
TriangleSoup torus(int around, int across);
/// An icosphere of level 2 with each original corner and edge midpoint pulled out or pushed in:
/// concave, with sharp spikes and deep pits.
TriangleSoup star();
/// A block with a notch whose walls meet at the given angle: a valley of any sharpness.
TriangleSoup notchedBlock(double angle_rad);
/// Vertices (c, r, height(c, r)), facing up, each cell cut from (c, r) to (c+1, r+1) with rows
/// counting toward -y.
TriangleSoup sheet(int columns, int rows, const std::function<double(int, int)>& height);

/// All vertices multiplied by `scale`, then rotated by a fixed odd angle if requested, then
/// translated.
enum class Turned : bool { No, Yes };
TriangleSoup
placed(TriangleSoup soup, double scale, const Vec3& offset, Turned turned = Turned::No);
/// Both as independent objects.
TriangleSoup joined(TriangleSoup a, const TriangleSoup& b);

std::shared_ptr<const TriangleMesh> meshOf(TriangleSoup soup);

struct NamedMesh {
    std::string name;
    std::shared_ptr<const TriangleMesh> mesh;
    double size_m; // of the whole mesh
    ScenePoint middle;
};
/// Closed meshes of all kinds, small and large, near and far from the origin.
std::vector<NamedMesh> closedMeshes();

/// The winding number of the faces around `point`: 1 inside a closed object, 0 outside. By solid
/// angles (A. van Oosterom and J. Strackee, 1983), in long double.
double windingNumber(const TriangleMesh& mesh, const ScenePoint& point);

/// In long double.
double bruteDistance(const std::array<ScenePoint, 3>& triangle, const ScenePoint& point);
/// The distance from `point` to the nearest triangle, in long double.
double bruteDistance(const TriangleMesh& mesh, const ScenePoint& point);

/// The longest edge of the mesh.
double longestEdge(const TriangleMesh& mesh);

Vec3 randomDirection(Random& random);

} // namespace marsview::test
