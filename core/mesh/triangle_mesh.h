// A sound general triangle mesh with its adjacency.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/mesh/triangle_tree.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace marsview {

/// Unchecked triangles, such as the content of a file.
struct TriangleSoup {
    std::vector<ScenePoint> vertices; // scene meters
    std::vector<MeshFace> faces;      // indices of vertices, counter-clockwise seen from free space
};

/// Seamless triangles in which mesh_check.h finds no fault: open or closed, of any number of
/// objects, one-sided. Vertices without a face are allowed.
///
/// A *corner* is 3 × face + i: corner i of a face, and also the edge opposite, from corner i + 1 to
/// corner i + 2. Immutable, any thread, allocates nothing after construction. About 70 bytes per
/// face.
class TriangleMesh {
public:
    using Index = std::uint32_t; // of a vertex, a face or a corner
    static constexpr Index kNone = std::numeric_limits<Index>::max();
    /// More are refused, so that corner indices fit.
    static constexpr std::size_t kFacesMax = std::size_t{1} << 30U;
    /// Farther coordinates, in meters, are refused.
    static constexpr double kCoordinateMaxM = 1e12;

    /// Refuses triangles with faults; the message counts each kind and names the first locations.
    /// `monitor` can cancel it. Takes about 3 µs per face, on all cores.
    static Result<std::shared_ptr<const TriangleMesh>> build(TriangleSoup soup,
                                                             JobMonitor& monitor);

    std::size_t vertexCount() const noexcept { return vertices_.size(); }
    std::size_t faceCount() const noexcept { return faces_.size(); }
    std::size_t byteCount() const noexcept;

    const ScenePoint& vertex(std::uint32_t index) const noexcept { return vertices_[index]; }
    const MeshFace& face(std::uint32_t index) const noexcept { return faces_[index]; }
    std::array<ScenePoint, 3> points(std::uint32_t face) const noexcept
    {
        const MeshFace& f = faces_[face];
        return {vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]};
    }
    /// The normal, not of length 1: twice the area.
    Vec3 normal(std::uint32_t face) const noexcept
    {
        const MeshFace& f = faces_[face];
        return cross(vertices_[f[1]] - vertices_[f[0]], vertices_[f[2]] - vertices_[f[0]]);
    }

    /// The corner beyond the edge opposite a corner; kNone at the border.
    std::uint32_t across(std::uint32_t corner) const noexcept { return across_[corner]; }
    /// The corners at a vertex, counter-clockwise seen from free space, each beginning where the
    /// last one ended. At the border the first begins there; elsewhere the last ends where the
    /// first begins. Empty if no face has the vertex.
    std::span<const std::uint32_t> fan(std::uint32_t vertex) const noexcept
    {
        return {fan_corners_.data() + fan_begins_[vertex],
                fan_corners_.data() + fan_begins_[vertex + 1]};
    }
    bool isAtBorder(std::uint32_t vertex) const noexcept
    {
        const auto corners = fan(vertex);
        return corners.empty() || across_[previousCorner(corners.front())] == kNone;
    }

    const TriangleTree& tree() const noexcept { return tree_; }

    static std::uint32_t faceOf(std::uint32_t corner) noexcept { return corner / 3; }
    static std::uint32_t nextCorner(std::uint32_t corner) noexcept
    {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }
    static std::uint32_t previousCorner(std::uint32_t corner) noexcept
    {
        return corner % 3 == 0 ? corner + 2 : corner - 1;
    }
    std::uint32_t vertexAt(std::uint32_t corner) const noexcept
    {
        return faces_[corner / 3][corner % 3];
    }

private:
    TriangleMesh() = default;

    void connect();

    std::vector<ScenePoint> vertices_;
    std::vector<MeshFace> faces_;
    std::vector<std::uint32_t> across_;
    std::vector<std::uint32_t> fan_begins_;
    std::vector<std::uint32_t> fan_corners_;
    TriangleTree tree_;
};

} // namespace marsview
