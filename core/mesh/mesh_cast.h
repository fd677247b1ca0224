// The first hit of a segment on a mesh, and the nearest point of a mesh. A mesh is a TriangleMesh
// or a type with the same queries.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace marsview {

/// A position on a mesh. A weight of exactly 0 puts it on the edge opposite, two of them on a
/// corner.
template <typename Index>
struct BasicMeshPlace {
    Index face = 0;
    std::array<double, 3> weights{}; // of the corners; >= 0, sum 1
};
using MeshPlace = BasicMeshPlace<TriangleMesh::Index>;

/// The start of a segment: an offset from `base`, which keeps the precision of a position on a
/// small face far from the origin, and the faces that are known not to be hit.
template <typename Index>
struct MeshStart {
    static constexpr Index kNone = std::numeric_limits<Index>::max();
    ScenePoint base;
    Vec3 offset{};
    /// The rounding error of the offset is a few 1e-16 of this many meters.
    double size_m = 0.0;
    std::array<Index, 2> skipped_faces{kNone, kNone};
    Index skipped_vertex = kNone; // all its faces are skipped
};

template <typename Index>
struct BasicMeshCast {
    std::optional<BasicMeshPlace<Index>> hit; // empty: the goal was reached
    std::uint32_t faces = 0;                  // tested
};
using MeshCast = BasicMeshCast<TriangleMesh::Index>;

/// The end of a segment: `point` + `rest`, where `rest` is less than the rounding error of `point`.
struct MeshEnd {
    ScenePoint point;
    Vec3 rest{};
};

/// The side of a face's plane on which the end is: 1 in front, 0 on it, -1 behind. Without rounding
/// error.
template <typename Mesh>
int sideOf(const Mesh& mesh, typename Mesh::Index face, const MeshEnd& end) noexcept;

/// The first face that the segment to `goal` hits from the front and whose plane the goal is on or
/// behind, according to sideOf(). Watertight: the hit is that of the exact segment with the mesh
/// whose vertices are each moved by a few 1e-16 of their distance from the nearer end of the
/// segment, edges and vertices included. A start that rounding has put onto a face or behind it, by
/// less than about 1e-13 of the sizes there, hits that face at once. All coordinates are within
/// TriangleMesh::kCoordinateMaxM.
template <typename Mesh>
BasicMeshCast<typename Mesh::Index> castSegment(const Mesh& mesh,
                                                const MeshStart<typename Mesh::Index>& start,
                                                const MeshEnd& goal) noexcept;

/// The nearest position to `point`, any of them if there are several; accurate to about 1e-15 of
/// the distance and the size of the face.
template <typename Mesh>
BasicMeshPlace<typename Mesh::Index> nearestPlace(const Mesh& mesh,
                                                  const ScenePoint& point) noexcept;

/// The weights of the point of a triangle that is nearest to the origin.
std::array<double, 3> nearestWeights(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

} // namespace marsview
