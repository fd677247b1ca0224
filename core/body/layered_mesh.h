// The triangles of several maps on top of each other on a body, as one surface.
#pragma once

#include "core/body/body_mesh.h"
#include "core/body/face_marks.h"
#include "core/body/layer_limits.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// The corners at a vertex, as in TriangleMesh::fan(): few, or those of a stored list.
class LayeredFan {
public:
    LayeredFan(const FanCorners& corners, BodyIndex first) noexcept
        : size_(corners.size())
    {
        std::transform(corners.begin(), corners.end(), few_.begin(),
                       [first](BodyIndex corner) { return corner + first; });
    }
    LayeredFan(const BodyIndex* corners, std::size_t count) noexcept
        : listed_(corners)
        , size_(count)
    {}

    const BodyIndex* begin() const noexcept { return listed_ != nullptr ? listed_ : few_.data(); }
    const BodyIndex* end() const noexcept { return begin() + size_; }
    BodyIndex front() const noexcept { return *begin(); }
    BodyIndex back() const noexcept { return *(end() - 1); }
    std::size_t size() const noexcept { return size_; }

private:
    std::array<BodyIndex, FanCorners::kCountMax> few_{};
    const BodyIndex* listed_ = nullptr;
    std::size_t size_;
};

/// At each place the surface is that of the uppermost map with data there, and where no map has
/// data, the filled one of the lowest map. Where a map ends over another one, at its border or at
/// its voids, a vertical wall joins the two: the surface has no gaps, and nothing lies below it.
/// There the triangles of both are cut, where they lie. Vertices of the border are put onto those
/// of the map below within 1e-5 of the border's shortest edge, and the foot of a wall follows the
/// border to a few thousandths of how far a cell lies below the curved surface: c² / 8R. All other
/// triangles are those of BodyMesh, which stores none of them.
///
/// Several maps may be in tiles. Their samples along the borders of the maps are pinned, so that
/// the stored triangles do not depend on the tiles in memory. Such a mesh is as constant as the
/// terrains of these maps, and for the thread that has them: each user gets one by over().
///
/// The same queries as TriangleMesh. Otherwise immutable, any thread; allocates nothing after
/// construction. About 150 bytes per edge of a border, up to two bits per face that is covered, and
/// 32 to 64 bytes per pinned sample.
class LayeredMesh {
public:
    using Index = BodyIndex;
    static constexpr Index kNone = BodyMesh::kNone;
    static constexpr double kCoordinateMaxM = BodyMesh::kCoordinateMaxM;
    static constexpr std::size_t kMapsMax = 32;
    /// Of these, in tiles: a thread loads the tiles of each while they are touched.
    static constexpr std::size_t kTiledMax = 8;

    /// The uppermost map first; all with the same ellipsoid and exaggeration. Maps in tiles are
    /// over a WaitingTerrain, whose error() makes the result worthless; only tiles along borders
    /// are read. Errors: Unsupported where the border of a map leads beyond the maps below it, or
    /// cannot be cut out of them, and for maps in tiles that cannot be cut out; TooLarge above
    /// kMapsMax maps or kTiledMax in tiles, and beyond the limits; Canceled.
    static Result<std::shared_ptr<const LayeredMesh>>
    build(const std::vector<std::shared_ptr<const BodyMesh>>& maps,
          JobMonitor& monitor,
          const LayerLimits& limits = {});

    /// Whether a map in tiles can lie above others. The lowest may be any.
    static bool canBeCutOut(const TileHeights& heights) noexcept
    {
        return heights.filledMaxima().empty();
    }

    /// The same with maps in tiles over other terrains: each of `tiled` has the pins of one of the
    /// maps. The stored triangles are shared.
    std::shared_ptr<const LayeredMesh>
    over(const std::vector<std::shared_ptr<const BodyMesh>>& tiled) const;

    /// Faces that are cut or covered are counted, but none of the queries finds them.
    std::size_t faceCount() const noexcept { return map_faces_ + cut_->faces.size(); }
    std::size_t vertexCount() const noexcept { return map_vertices_ + cut_->vertices.size(); }
    std::size_t mapCount() const noexcept { return maps_.size(); }
    const std::shared_ptr<const BodyMesh>& map(std::size_t index) const noexcept
    {
        return maps_[index].mesh;
    }
    /// The indices of the maps in tiles, the uppermost first.
    std::vector<std::size_t> tiledMaps() const;
    double exaggeration() const noexcept { return maps_.front().mesh->exaggeration(); }
    const Ellipsoid& ellipsoid() const noexcept
    {
        return maps_.front().mesh->positions().ellipsoid();
    }
    bool isGone(BodyIndex face) const noexcept
    {
        if (face >= map_faces_) {
            return false;
        }
        const Map& map = mapOf(face);
        return map.isGone(face - map.first_face);
    }
    /// Cut faces and walls: those from here on.
    BodyIndex firstCutFace() const noexcept { return map_faces_; }
    /// Whether a face is part of a wall.
    bool isWall(BodyIndex face) const noexcept
    {
        return face >= map_faces_ && cut_->is_wall[face - map_faces_];
    }

    ScenePoint vertex(BodyIndex index) const noexcept
    {
        if (index >= map_vertices_) {
            return cut_->vertices[index - map_vertices_];
        }
        const Map& map = mapOfVertex(index);
        return map.mesh->vertex(index - map.first_vertex);
    }
    BodyFace face(BodyIndex index) const noexcept
    {
        if (index >= map_faces_) {
            return cut_->faces[index - map_faces_];
        }
        const Map& map = mapOf(index);
        const BodyFace own = map.mesh->face(index - map.first_face);
        return {own[0] + map.first_vertex, own[1] + map.first_vertex, own[2] + map.first_vertex};
    }
    std::array<ScenePoint, 3> points(BodyIndex face) const noexcept
    {
        if (face >= map_faces_) {
            const BodyFace& f = cut_->faces[face - map_faces_];
            return {vertex(f[0]), vertex(f[1]), vertex(f[2])};
        }
        const Map& map = mapOf(face);
        return map.mesh->points(face - map.first_face);
    }
    Vec3 normal(BodyIndex face) const noexcept
    {
        const auto [a, b, c] = points(face);
        return cross(b - a, c - a);
    }
    BodyIndex across(BodyIndex corner) const noexcept;
    LayeredFan fan(BodyIndex vertex) const noexcept;
    bool isAtBorder(BodyIndex vertex) const noexcept
    {
        return across(previousCorner(fan(vertex).front())) == kNone;
    }
    BodyIndex vertexAt(BodyIndex corner) const noexcept { return face(corner / 3)[corner % 3]; }
    static BodyIndex faceOf(BodyIndex corner) noexcept { return corner / 3; }
    static BodyIndex nextCorner(BodyIndex corner) noexcept { return BodyMesh::nextCorner(corner); }
    static BodyIndex previousCorner(BodyIndex corner) noexcept
    {
        return BodyMesh::previousCorner(corner);
    }

    /// Where a vertical path down to `point` begins above all maps.
    ScenePoint highAbove(const ScenePoint& point) const noexcept;

    /// As BodyMesh::Tree, over all maps.
    class Tree {
    public:
        const ScenePoint& middle() const noexcept { return mesh_.map(0)->tree().middle(); }
        template <typename F>
        void
        pointsAlong(const Vec3& from, const Vec3& along, double slack, F&& visit) const noexcept
        {
            double t_least = 1.0;
            const auto look_at = [&](BodyIndex face, const std::array<ScenePoint, 3>& at,
                                     double& t_max) {
                t_max = std::min(t_max, t_least);
                visit(face, at, t_max);
                t_least = std::min(t_max, t_least);
            };
            for (const Map& map : mesh_.maps_) {
                const auto tree = map.mesh->tree();
                tree.pointsAlong(from + (middle() - tree.middle()), along, slack,
                                 [&](BodyIndex face, const auto& at, double& t_max) {
                                     if (!map.isGone(face)) {
                                         look_at(face + map.first_face, at, t_max);
                                     }
                                 });
            }
            mesh_.cut_->tree.alongSegment(from + (middle() - mesh_.cut_->tree.middle()), along,
                                          slack, [&](BodyIndex face, double& t_max) {
                                              look_at(face + mesh_.map_faces_,
                                                      mesh_.points(face + mesh_.map_faces_), t_max);
                                          });
        }
        template <typename F>
        void pointsNearest(const ScenePoint& point, F&& visit) const noexcept
        {
            double least = std::numeric_limits<double>::infinity();
            const auto look_at = [&](BodyIndex face, const std::array<ScenePoint, 3>& at,
                                     double& limit) {
                limit = std::min(limit, least);
                visit(face, at, limit);
                least = std::min(limit, least);
            };
            for (const Map& map : mesh_.maps_) {
                map.mesh->tree().pointsNearest(point,
                                               [&](BodyIndex face, const auto& at, double& limit) {
                                                   if (!map.isGone(face)) {
                                                       look_at(face + map.first_face, at, limit);
                                                   }
                                               });
            }
            mesh_.cut_->tree.nearestFirst(point, [&](BodyIndex face, double& limit) {
                look_at(face + mesh_.map_faces_, mesh_.points(face + mesh_.map_faces_), limit);
            });
        }
        template <typename F>
        void inBox(const ScenePoint& low, const ScenePoint& high, F&& visit) const noexcept
        {
            for (const Map& map : mesh_.maps_) {
                map.mesh->tree().inBox(low, high, [&](BodyIndex face) {
                    if (!map.isGone(face)) {
                        visit(face + map.first_face);
                    }
                });
            }
            mesh_.cut_->tree.inBox(low, high,
                                   [&](BodyIndex face) { visit(face + mesh_.map_faces_); });
        }

    private:
        friend class LayeredMesh;
        explicit Tree(const LayeredMesh& mesh)
            : mesh_(mesh)
        {}
        const LayeredMesh& mesh_;
    };
    Tree tree() const noexcept { return Tree(*this); }

private:
    struct Map {
        std::shared_ptr<const BodyMesh> mesh;
        BodyIndex first_vertex = 0;
        BodyIndex first_face = 0;
        // Null if the map is neither cut nor covered.
        std::shared_ptr<const FaceMarks> gone{};
        std::shared_ptr<const FaceMarks> linked{}; // gone, or `links` has one of its corners

        // By the map's own numbers.
        bool isGone(BodyIndex face) const noexcept { return gone && (*gone)[face]; }
        bool isLinked(BodyIndex face) const noexcept { return linked && (*linked)[face]; }
    };
    struct Link {
        BodyIndex corner;
        BodyIndex beyond;
    };
    struct Fan {
        BodyIndex vertex;
        BodyIndex begin; // in fan_corners
    };
    // The stored triangles, along borders.
    struct Cut {
        std::vector<ScenePoint> vertices;
        std::vector<BodyFace> faces;
        std::vector<std::array<BodyIndex, 3>> across;
        std::vector<bool> is_wall;
        std::vector<Link> links; // of corners of maps whose neighbors are cut faces, by corner
        std::vector<Fan> fans;   // of the vertices of cut faces, by vertex, and an end
        std::vector<BodyIndex> fan_corners;
        TriangleTree tree;
    };

    LayeredMesh() = default;

    // At most kMapsMax steps.
    const Map& mapOf(BodyIndex face) const noexcept
    {
        std::size_t map = maps_.size() - 1;
        while (face < maps_[map].first_face) {
            --map;
        }
        return maps_[map];
    }
    const Map& mapOfVertex(BodyIndex vertex) const noexcept
    {
        std::size_t map = maps_.size() - 1;
        while (vertex < maps_[map].first_vertex) {
            --map;
        }
        return maps_[map];
    }
    LayeredFan listedFan(BodyIndex vertex) const noexcept;

    std::vector<Map> maps_;
    BodyIndex map_faces_ = 0;
    BodyIndex map_vertices_ = 0;
    std::shared_ptr<const Cut> cut_;
};

} // namespace marsview
