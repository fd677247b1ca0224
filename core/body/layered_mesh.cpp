#include "core/body/layered_mesh.h"

#include "core/base/check.h"
#include "core/body/layer_cut.h"

#include <fmt/format.h>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace marsview {
namespace {

// Of a map in tiles: all that the patch has used heights of. A ring of faces around those that are
// cut is pinned too, so that the ways on which they were found are the same with other tiles.
std::vector<BodyIndex> verticesToPin(const LayerPatch& patch, std::size_t index)
{
    const LayerPatch::Map& map = patch.maps()[index];
    std::vector<BodyIndex> vertices;
    const auto isOwnVertex = [&](BodyIndex vertex) {
        return vertex >= map.first_vertex && vertex < map.first_vertex + map.mesh->vertexCount();
    };
    const auto add_face = [&](BodyIndex face) {
        if (face >= map.first_face && face < map.first_face + map.mesh->faceCount()) {
            for (const BodyIndex vertex : map.mesh->face(face - map.first_face)) {
                vertices.push_back(vertex);
            }
        }
    };
    for (const LayerPatch::Face& face : patch.cutFaces()) {
        add_face(face.origin);
        for (const BodyIndex vertex : face.vertices) {
            if (isOwnVertex(vertex)) {
                vertices.push_back(vertex - map.first_vertex);
            }
        }
    }
    for (const auto& [corner, beyond] : patch.links()) {
        add_face(corner / 3);
    }
    const auto sort = [&vertices] {
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    };
    sort();
    for (std::size_t i = 0, count = vertices.size(); i < count; ++i) {
        for (const BodyIndex corner : map.mesh->fan(vertices[i])) {
            const BodyFace around = map.mesh->face(corner / 3);
            vertices.insert(vertices.end(), around.begin(), around.end());
        }
    }
    sort();
    return vertices;
}

} // namespace

Result<std::shared_ptr<const LayeredMesh>>
LayeredMesh::build(const std::vector<std::shared_ptr<const BodyMesh>>& maps,
                   JobMonitor& monitor,
                   const LayerLimits& limits)
{
    MARSVIEW_CHECK(!maps.empty());
    if (maps.size() > kMapsMax) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{} maps lie on top of each other; up to {} can be joined",
                                 maps.size(), kMapsMax)};
    }
    const auto in_tiles = static_cast<std::size_t>(
        std::count_if(maps.begin(), maps.end(), [](const auto& map) { return map->isTiled(); }));
    if (in_tiles > kTiledMax) {
        return Error{
            ErrorCode::TooLarge,
            fmt::format("{} maps in tiles lie on top of each other; up to {} can be joined",
                        in_tiles, kTiledMax)};
    }
    for (std::size_t i = 0; i + 1 < maps.size(); ++i) {
        if (const TileHeights* heights = maps[i]->tileHeights();
            heights != nullptr && !canBeCutOut(*heights)) {
            return Error{
                ErrorCode::Unsupported,
                "a map in tiles with nodata, or without measured bounds, lies above others"};
        }
    }
    LayerPatch patch(maps);
    for (std::size_t i = maps.size() - 1; i-- > 0;) {
        if (Status cut = cutOut(patch, i, limits, monitor); !cut) {
            return std::move(cut).error();
        }
    }
    addWalls(patch);

    std::shared_ptr<LayeredMesh> mesh(new LayeredMesh);
    mesh->map_faces_ = patch.mapFaces();
    mesh->map_vertices_ = patch.mapVertices();
    const auto cut = std::make_shared<Cut>();
    mesh->cut_ = cut;
    cut->vertices = patch.cutVertices();
    std::vector<FaceMarks> linked; // by map
    for (const LayerPatch::Map& map : patch.maps()) {
        mesh->maps_.push_back(
            {.mesh = map.mesh, .first_vertex = map.first_vertex, .first_face = map.first_face});
        linked.push_back(map.is_gone);
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
            cut->faces.push_back(face.vertices);
            cut->across.push_back({renumbered(face.across[0]), renumbered(face.across[1]),
                                   renumbered(face.across[2])});
            cut->is_wall.push_back(face.origin == LayerPatch::kNone);
        }
    }
    for (const auto& [corner, beyond] : patch.links()) {
        const std::size_t index = patch.mapOf(corner / 3);
        const LayerPatch::Map& map = patch.maps()[index];
        if (!map.is_gone[corner / 3 - map.first_face]) {
            linked[index].set(corner / 3 - map.first_face);
            cut->links.push_back({corner, renumbered(beyond)});
        }
    }
    std::sort(cut->links.begin(), cut->links.end(),
              [](const Link& a, const Link& b) { return a.corner < b.corner; });
    const auto shared = [](const FaceMarks& marks) {
        return marks.isAny() ? std::make_shared<const FaceMarks>(marks) : nullptr;
    };
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (maps[i]->isTiled()) {
            mesh->maps_[i].mesh = maps[i]->withPins(verticesToPin(patch, i));
        }
        mesh->maps_[i].gone = shared(patch.maps()[i].is_gone);
        mesh->maps_[i].linked = shared(linked[i]);
    }

    std::vector<std::pair<BodyIndex, BodyIndex>> begins; // a vertex, one of its corners
    for (BodyIndex i = 0; i < cut->faces.size(); ++i) {
        for (BodyIndex k = 0; k < 3; ++k) {
            begins.emplace_back(cut->faces[i][k], 3 * (mesh->map_faces_ + i) + k);
        }
    }
    std::sort(begins.begin(), begins.end());
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const auto [vertex, some] = begins[i];
        if (i > 0 && begins[i - 1].first == vertex) {
            continue;
        }
        cut->fans.push_back({vertex, cut->fan_corners.size()});
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
            cut->fan_corners.push_back(corner);
            const BodyIndex beyond = mesh->across(nextCorner(corner));
            corner = beyond == kNone ? first : nextCorner(beyond);
        } while (corner != first);
    }
    cut->fans.push_back({kNone, cut->fan_corners.size()});

    std::vector<TriangleTree::Bounds> bounds(cut->faces.size());
    for (BodyIndex i = 0; i < bounds.size(); ++i) {
        for (const ScenePoint& point : mesh->points(mesh->map_faces_ + i)) {
            bounds[i].add(point);
        }
    }
    if (!bounds.empty()) {
        cut->tree = TriangleTree(bounds);
    }
    return std::shared_ptr<const LayeredMesh>(std::move(mesh));
}

std::shared_ptr<const LayeredMesh>
LayeredMesh::over(const std::vector<std::shared_ptr<const BodyMesh>>& tiled) const
{
    std::shared_ptr<LayeredMesh> mesh(new LayeredMesh(*this));
    for (const auto& one : tiled) {
        const auto map =
            std::find_if(mesh->maps_.begin(), mesh->maps_.end(), [&one](const Map& own) {
                return own.mesh->pins() && own.mesh->pins() == one->pins();
            });
        MARSVIEW_CHECK(map != mesh->maps_.end());
        map->mesh = one;
    }
    return mesh;
}

std::vector<std::size_t> LayeredMesh::tiledMaps() const
{
    std::vector<std::size_t> tiled;
    for (std::size_t i = 0; i < maps_.size(); ++i) {
        if (maps_[i].mesh->isTiled()) {
            tiled.push_back(i);
        }
    }
    return tiled;
}

BodyIndex LayeredMesh::across(BodyIndex corner) const noexcept
{
    const BodyIndex face = corner / 3;
    if (face >= map_faces_) {
        return cut_->across[face - map_faces_][corner % 3];
    }
    const Map& map = mapOf(face);
    if (map.isLinked(face - map.first_face)) {
        const auto& links = cut_->links;
        const auto link = std::lower_bound(links.begin(), links.end(), corner,
                                           [](const Link& a, BodyIndex b) { return a.corner < b; });
        if (link != links.end() && link->corner == corner) {
            return link->beyond;
        }
    }
    const BodyIndex beyond = map.mesh->across(corner - 3 * map.first_face);
    return beyond == kNone ? kNone : beyond + 3 * map.first_face;
}

LayeredFan LayeredMesh::listedFan(BodyIndex vertex) const noexcept
{
    const auto& fans = cut_->fans;
    const auto fan = std::lower_bound(fans.begin(), fans.end(), vertex,
                                      [](const Fan& a, BodyIndex b) { return a.vertex < b; });
    if (fan == fans.end() || fan->vertex != vertex) {
        return {nullptr, 0};
    }
    return {cut_->fan_corners.data() + fan->begin, (fan + 1)->begin - fan->begin};
}

LayeredFan LayeredMesh::fan(BodyIndex vertex) const noexcept
{
    if (vertex >= map_vertices_) {
        return listedFan(vertex);
    }
    const Map& map = mapOfVertex(vertex);
    const FanCorners corners = map.mesh->fan(vertex - map.first_vertex);
    if (std::any_of(corners.begin(), corners.end(),
                    [&map](BodyIndex corner) { return map.isLinked(corner / 3); })) {
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
