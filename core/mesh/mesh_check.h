// Faults of triangle meshes that prevent touching them.
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
    MissingVertex,   // a face names a vertex that does not exist
    Degenerate,      // a face without area: its height is below 1e-12 of its longest edge
    Duplicate,       // two faces with the same corners
    NonManifoldEdge, // an edge of more than two faces; two vertices
    TurnedFace,      // two neighbors with opposite orientation; two vertices of their edge
    BowTie,          // a vertex at which several fans of faces meet
    Gap,             // a border vertex on another border, without being part of it: an unwelded
                     // seam or a T-junction; the vertex and one of the other border
    Intersection,    // two faces that intersect outside their shared corners and edges
};

/// The location of one fault.
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

/// Faults grouped by kind, in the order of MeshFaultKind; only kinds that occur. Faces with bad
/// coordinates, missing vertices or no area are excluded from the further checks. Two borders
/// coincide if they are nearer than 1e-4 of the shortest border edge at the vertex; intersections
/// are found without rounding error. If `monitor` cancels, the result is incomplete. `tree`, if
/// given, becomes the hierarchy over the checked faces.
std::vector<MeshFault> findMeshFaults(std::span<const ScenePoint> vertices,
                                      std::span<const MeshFace> faces,
                                      JobMonitor& monitor,
                                      TriangleTree* tree = nullptr);

/// "2 gaps (vertex 3 on the border at vertex 7, at 1, 2.5, 0; …), 1 bow-tie vertex (…)": for
/// messages. Faces and vertices are counted from 1.
std::string describe(std::span<const MeshFault> faults);

} // namespace marsview
