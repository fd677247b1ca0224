// What is wrong with triangles that are to be touched.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace marsview {

enum class MeshFaultKind : std::uint8_t {
    BadCoordinate,   // not finite, or farther than TriangleMesh::kCoordinateMaxM; a vertex
    MissingVertex,   // a face names a vertex that is not there
    Degenerate,      // a face without area: its height is below 1e-12 of its longest edge
    Duplicate,       // two faces with the same corners
    NonManifoldEdge, // an edge of more than two faces; two vertices
    TurnedFace,      // two neighbours of which one shows its back; two vertices of their edge
    BowTie,          // a vertex at which several fans of faces meet
    Gap,             // a border vertex on another border, without being part of it: an unwelded
                     // seam or a T-junction; the vertex and one of the other border
    Intersection,    // two faces that meet other than in what they share
};

/// One place where a kind of fault was found.
struct MeshFaultPlace {
    std::array<std::uint32_t, 2> numbers{}; // of faces or vertices, counted from 0
    ScenePoint at;
};

struct MeshFault {
    static constexpr std::size_t kFirstMax = 3;

    MeshFaultKind kind = MeshFaultKind::BadCoordinate;
    std::size_t count = 0;
    std::vector<MeshFaultPlace> first; // kFirstMax at most, in ascending order
};

/// Faults in the order of their kinds, none of a kind that was not found. Faces with bad
/// coordinates, missing vertices or without area take no further part. Two borders are one where
/// they are nearer than 1e-4 of the shortest border edge at the vertex; intersections are found
/// without rounding error. Where `monitor` cancels, what is returned is incomplete.
/// `tree`, if given, becomes the hierarchy over the faces that took part.
std::vector<MeshFault> findMeshFaults(std::span<const ScenePoint> vertices,
                                      std::span<const MeshFace> faces,
                                      JobMonitor& monitor,
                                      TriangleTree* tree = nullptr);

/// "2 gaps (vertex 3 on the border at vertex 7, at 1, 2.5, 0; …), 1 bow-tie vertex (…)": for
/// messages. Faces and vertices are counted from 1.
std::string describe(std::span<const MeshFault> faults);

} // namespace marsview
