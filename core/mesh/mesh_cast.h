// What a segment meets of a mesh, and what of it is nearest to a point.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <optional>

namespace marsview {

/// A place on a mesh. A weight of exactly 0 puts it on the edge opposite, two of them on a corner.
struct MeshPlace {
    std::uint32_t face = 0;
    std::array<double, 3> weights{}; // of the corners; >= 0, sum 1
};

/// Where a segment begins: beside `base`, so that nothing is lost of a place on a small face far
/// from the origin, and which faces are known not to be met.
struct MeshStart {
    ScenePoint base;
    Vec3 offset{};
    /// The rounding error of the offset is a few 1e-16 of this many metres.
    double size_m = 0.0;
    std::array<std::uint32_t, 2> skipped_faces{TriangleMesh::kNone, TriangleMesh::kNone};
    std::uint32_t skipped_vertex = TriangleMesh::kNone; // all its faces are skipped
};

struct MeshCast {
    std::optional<MeshPlace> hit; // nothing: the goal was reached
    std::uint32_t faces = 0;      // looked at
};

/// Where it ends: at `point` + `rest`, which is less than the rounding error of `point`.
struct MeshEnd {
    ScenePoint point;
    Vec3 rest{};
};

/// The side of the plane of a face that an end is on: 1 in front, 0 on it, -1 behind. Without
/// rounding error.
int sideOf(const TriangleMesh& mesh, std::uint32_t face, const MeshEnd& end) noexcept;

/// The first face whose front the segment to `goal` comes from and whose plane the goal is on or
/// behind, as sideOf() tells. Nothing slips through: what is met is what the exact
/// segment meets of the mesh with each vertex moved by a few 1e-16 of its distance from the nearer
/// end of the segment, edges and vertices included. A start that rounding has put onto a face or
/// behind it, by less than about 1e-13 of the sizes there, is stopped by it at once. All
/// coordinates are within TriangleMesh::kCoordinateMaxM.
MeshCast
castSegment(const TriangleMesh& mesh, const MeshStart& start, const MeshEnd& goal) noexcept;

/// The place nearest to `point`, one of them where there are several; to about 1e-15 of the
/// distance and the size of the face.
MeshPlace nearestPlace(const TriangleMesh& mesh, const ScenePoint& point) noexcept;

/// The weights of the point of a triangle that is nearest to the origin.
std::array<double, 3> nearestWeights(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

} // namespace marsview
