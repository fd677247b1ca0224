#include "core/body/layered_mesh.h"

#include "core/base/check.h"
#include "core/body/layer_cut.h"

#include <fmt/format.h>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace marsview {

Result<std::shared_ptr<const LayeredMesh>>
LayeredMesh::build(const std::vector<std::shared_ptr<const BodyMesh>>& maps, JobMonitor& monitor)
{
    MARSVIEW_CHECK(!maps.empty());
    if (maps.size() > kMapsMax) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{} maps lie on top of each other; up to {} can be joined",
                                 maps.size(), kMapsMax)};
    }
    LayerPatch patch(maps);
    for (std::size_t i = maps.size() - 1; i-- > 0;) {
        if (Status cut = cutOut(patch, i, monitor); !cut) {
            return std::move(cut).error();
        }
    }
    addWalls(patch);

    std::shared_ptr<LayeredMesh> mesh(new LayeredMesh);
    mesh->map_faces_ = patch.mapFaces();
    mesh->map_vertices_ = patch.mapVertices();
    mesh->cut_vertices_ = patch.cutVertices();
    for (const LayerPatch::Map& map : patch.maps()) {
        mesh->maps_.push_back(
            {.mesh = map.mesh, .first_vertex = map.first_vertex, .first_face = map.first_face});
        mesh->maps_.back().is_gone = map.is_gone;
        mesh->maps_.back().is_linked = map.is_gone;
    }
    // Cut faces that are not gone, by new numbers.
    std::vector<BodyIndex> numbers(patch.cutFaces().size(), kNone);
    BodyIndex count = mesh->map_faces_;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = patch.cutFaces()[i].is_gone ? kNone : count++;
    }
    const auto renumbered = [&](BodyIndex corner) {
        return corner == kNone || corner / 3 < mesh->map_faces_
                   ? corner
                   : 3 * numbers[corner / 3 - mesh->map_faces_] + corner % 3;
    };
    for (const LayerPatch::Face& face : patch.cutFaces()) {
        if (!face.is_gone) {
            mesh->cut_faces_.push_back(face.vertices);
            mesh->cut_across_.push_back({renumbered(face.across[0]), renumbered(face.across[1]),
                                         renumbered(face.across[2])});
            mesh->is_wall_.push_back(face.origin == LayerPatch::kNone);
        }
    }
    for (const auto& [corner, beyond] : patch.links()) {
        Map& map = mesh->maps_[patch.mapOf(corner / 3)];
        if (!map.is_gone[corner / 3 - map.first_face]) {
            map.is_linked[corner / 3 - map.first_face] = true;
            mesh->links_.push_back({corner, renumbered(beyond)});
        }
    }
    std::sort(mesh->links_.begin(), mesh->links_.end(),
              [](const Link& a, const Link& b) { return a.corner < b.corner; });
    for (Map& map : mesh->maps_) {
        const auto is_any = [](const std::vector<bool>& bits) {
            return std::find(bits.begin(), bits.end(), true) != bits.end();
        };
        if (!is_any(map.is_gone)) {
            map.is_gone = {};
        }
        if (!is_any(map.is_linked)) {
            map.is_linked = {};
        }
    }

    std::vector<std::pair<BodyIndex, BodyIndex>> begins; // a vertex, one of its corners
    for (BodyIndex i = 0; i < mesh->cut_faces_.size(); ++i) {
        for (BodyIndex k = 0; k < 3; ++k) {
            begins.emplace_back(mesh->cut_faces_[i][k], 3 * (mesh->map_faces_ + i) + k);
        }
    }
    std::sort(begins.begin(), begins.end());
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const auto [vertex, some] = begins[i];
        if (i > 0 && begins[i - 1].first == vertex) {
            continue;
        }
        mesh->fans_.push_back({vertex, mesh->fan_corners_.size()});
        BodyIndex first = some;
        for (BodyIndex before = mesh->across(previousCorner(first)); before != kNone;
             before = mesh->across(previousCorner(first))) {
            first = previousCorner(before);
            if (first == some) {
                break;
            }
        }
        BodyIndex corner = first;
        do {
            mesh->fan_corners_.push_back(corner);
            const BodyIndex beyond = mesh->across(nextCorner(corner));
            corner = beyond == kNone ? first : nextCorner(beyond);
        } while (corner != first);
    }
    mesh->fans_.push_back({kNone, mesh->fan_corners_.size()});

    std::vector<TriangleTree::Bounds> bounds(mesh->cut_faces_.size());
    for (BodyIndex i = 0; i < bounds.size(); ++i) {
        for (const ScenePoint& point : mesh->points(mesh->map_faces_ + i)) {
            bounds[i].add(point);
        }
    }
    if (!bounds.empty()) {
        mesh->cut_tree_ = TriangleTree(bounds);
    }
    return std::shared_ptr<const LayeredMesh>(std::move(mesh));
}

BodyIndex LayeredMesh::across(BodyIndex corner) const noexcept
{
    const BodyIndex face = corner / 3;
    if (face >= map_faces_) {
        return cut_across_[face - map_faces_][corner % 3];
    }
    const Map& map = mapOf(face);
    if (!map.is_linked.empty() && map.is_linked[face - map.first_face]) {
        const auto link = std::lower_bound(links_.begin(), links_.end(), corner,
                                           [](const Link& a, BodyIndex b) { return a.corner < b; });
        if (link != links_.end() && link->corner == corner) {
            return link->beyond;
        }
    }
    const BodyIndex beyond = map.mesh->across(corner - 3 * map.first_face);
    return beyond == kNone ? kNone : beyond + 3 * map.first_face;
}

LayeredFan LayeredMesh::listedFan(BodyIndex vertex) const noexcept
{
    const auto fan = std::lower_bound(fans_.begin(), fans_.end(), vertex,
                                      [](const Fan& a, BodyIndex b) { return a.vertex < b; });
    if (fan == fans_.end() || fan->vertex != vertex) {
        return {nullptr, 0};
    }
    return {fan_corners_.data() + fan->begin, (fan + 1)->begin - fan->begin};
}

LayeredFan LayeredMesh::fan(BodyIndex vertex) const noexcept
{
    if (vertex >= map_vertices_) {
        return listedFan(vertex);
    }
    const Map& map = mapOfVertex(vertex);
    const FanCorners corners = map.mesh->fan(vertex - map.first_vertex);
    if (!map.is_linked.empty() &&
        std::any_of(corners.begin(), corners.end(),
                    [&map](BodyIndex corner) { return map.is_linked[corner / 3]; })) {
        if (const LayeredFan listed = listedFan(vertex); listed.size() > 0) {
            return listed;
        }
    }
    return {corners, 3 * map.first_face};
}

ScenePoint LayeredMesh::highAbove(const ScenePoint& point) const noexcept
{
    ScenePoint highest = maps_.front().mesh->highAbove(point);
    for (const Map& map : maps_) {
        const ScenePoint high = map.mesh->highAbove(point);
        if (dot(high - point, high - point) > dot(highest - point, highest - point)) {
            highest = high;
        }
    }
    return highest;
}

} // namespace marsview
