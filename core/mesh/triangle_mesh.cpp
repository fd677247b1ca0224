#include "core/mesh/triangle_mesh.h"

#include "core/mesh/mesh_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace marsview {

Result<std::shared_ptr<const TriangleMesh>> TriangleMesh::build(TriangleSoup soup,
                                                                JobMonitor& monitor)
{
    if (soup.faces.empty()) {
        return Error{ErrorCode::Invalid, "the mesh has no triangles"};
    }
    if (soup.faces.size() > kFacesMax || soup.vertices.size() >= kNone) {
        return Error{
            ErrorCode::TooLarge,
            fmt::format("the mesh has {} triangles and {} vertices; the limits are {} and {}",
                        soup.faces.size(), soup.vertices.size(), kFacesMax, kNone - 1)};
    }
    std::shared_ptr<TriangleMesh> mesh(new TriangleMesh);
    const auto faults = findMeshFaults(soup.vertices, soup.faces, monitor, &mesh->tree_);
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "checking the mesh was canceled"};
    }
    if (!faults.empty()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("the mesh cannot be touched: {}", describe(faults))};
    }
    mesh->vertices_ = std::move(soup.vertices);
    mesh->faces_ = std::move(soup.faces);
    mesh->connect();
    return std::shared_ptr<const TriangleMesh>(std::move(mesh));
}

std::size_t TriangleMesh::byteCount() const noexcept
{
    const std::size_t indices = across_.size() + fan_begins_.size() + fan_corners_.size();
    return vertices_.size() * sizeof(ScenePoint) + faces_.size() * sizeof(MeshFace) +
           indices * sizeof(std::uint32_t) + tree_.byteCount();
}

void TriangleMesh::connect()
{
    // All corners of a vertex, in any order at first.
    fan_begins_.assign(vertices_.size() + 1, 0);
    for (const MeshFace& face : faces_) {
        for (const std::uint32_t v : face) {
            ++fan_begins_[v + 1];
        }
    }
    std::partial_sum(fan_begins_.begin(), fan_begins_.end(), fan_begins_.begin());
    fan_corners_.resize(3 * faces_.size());
    std::vector<std::uint32_t> fill(fan_begins_.begin(), fan_begins_.end() - 1);
    const auto corner_count = static_cast<std::uint32_t>(3 * faces_.size());
    for (std::uint32_t corner = 0; corner < corner_count; ++corner) {
        fan_corners_[fill[vertexAt(corner)]++] = corner;
    }
    // The face beyond an edge is among the faces of the edge's end, where its own edge begins.
    across_.assign(corner_count, kNone);
    for (std::uint32_t corner = 0; corner < corner_count; ++corner) {
        const std::uint32_t from = vertexAt(nextCorner(corner));
        const std::uint32_t to = vertexAt(previousCorner(corner));
        for (const std::uint32_t at_end : fan(to)) {
            if (vertexAt(nextCorner(at_end)) == from) {
                across_[corner] = previousCorner(at_end);
                break;
            }
        }
    }
    // Then in order: from corner c on, the next is beyond the edge from the vertex to the corner
    // before c.
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
        const auto begin = fan_corners_.begin() + fan_begins_[v];
        const auto end = fan_corners_.begin() + fan_begins_[v + 1];
        const auto border = std::find_if(begin, end, [this](std::uint32_t corner) {
            return across_[previousCorner(corner)] == kNone;
        });
        if (begin == end) {
            continue;
        }
        std::uint32_t corner = border == end ? *begin : *border;
        for (auto at = begin; at != end; ++at) {
            *at = corner;
            const std::uint32_t beyond = across_[nextCorner(corner)];
            if (beyond != kNone) {
                corner = nextCorner(beyond);
            }
        }
    }
}

} // namespace marsview
