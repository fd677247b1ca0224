// The triangles of several maps on a body while they are cut to one surface.
#pragma once

#include "core/body/body_mesh.h"
#include "core/body/face_marks.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace marsview {

/// Faces and vertices are numbered through all maps, the uppermost first, then come *cut* ones,
/// which are stored. A face of a map becomes a cut one when it changes. The *place* of a vertex is
/// the ellipsoid's normal through it, so that vertices straight above each other have one place.
/// Edges are great circles between places, whatever the small way by which straight ones in space
/// deviate: all decisions are about places, and cut edges stay where they are in space.
/// Where faces meet that belong to different maps, their edge is a *cliff*: it has two vertices at
/// each end, which are *twins*. A corner is as in TriangleMesh.
class LayerPatch {
public:
    static constexpr BodyIndex kNone = BodyMesh::kNone;

    struct Map {
        std::shared_ptr<const BodyMesh> mesh;
        BodyIndex first_vertex = 0;
        BodyIndex first_face = 0;
        FaceMarks is_gone; // cut or covered
    };
    struct Face {
        std::array<BodyIndex, 3> vertices;
        std::array<BodyIndex, 3> across;
        BodyIndex origin = kNone; // the face of a map that it is part of; none for a wall
        bool is_gone = false;
    };

    explicit LayerPatch(const std::vector<std::shared_ptr<const BodyMesh>>& maps);

    const std::vector<Map>& maps() const noexcept { return maps_; }
    const std::vector<Face>& cutFaces() const noexcept { return cut_; }
    const std::vector<ScenePoint>& cutVertices() const noexcept { return points_; }
    const std::unordered_map<BodyIndex, BodyIndex>& links() const noexcept { return links_; }
    const Ellipsoid& ellipsoid() const noexcept
    {
        return maps_.front().mesh->positions().ellipsoid();
    }
    BodyIndex mapFaces() const noexcept { return map_faces_; }
    BodyIndex mapVertices() const noexcept { return map_vertices_; }
    bool isCut(BodyIndex face) const noexcept { return face >= map_faces_; }
    bool isGone(BodyIndex face) const noexcept;
    std::size_t mapOf(BodyIndex face) const noexcept;
    std::size_t mapOfVertex(BodyIndex vertex) const noexcept;

    BodyFace face(BodyIndex face) const noexcept;
    BodyIndex vertexAt(BodyIndex corner) const noexcept { return face(corner / 3)[corner % 3]; }
    ScenePoint point(BodyIndex vertex) const noexcept;
    /// The place of a vertex.
    Vec3 up(BodyIndex vertex) const;
    BodyIndex across(BodyIndex corner) const noexcept;
    /// A corner at the vertex, of a face that is not gone; kNone without one.
    BodyIndex cornerAt(BodyIndex vertex) const noexcept;
    /// The next corner at the same place, counter-clockwise or clockwise; kNone at a border.
    BodyIndex turned(BodyIndex corner) const noexcept;
    BodyIndex turnedBack(BodyIndex corner) const noexcept;
    /// One vertex of all that are twins.
    BodyIndex placeOf(BodyIndex vertex) const noexcept;

    void setAcross(BodyIndex corner, BodyIndex beyond);
    void removeFace(BodyIndex face);
    /// All faces of a map, cut ones included.
    void removeMap(std::size_t index);
    void setTwins(BodyIndex a, BodyIndex b);
    void setVertex(BodyIndex corner, BodyIndex vertex);
    BodyIndex addVertex(const ScenePoint& point, const Vec3& up);
    BodyIndex addFace(const Face& face);
    /// To be called after faces have been removed, so that cornerAt() finds others.
    void noteAll();
    /// The corner of a cut face that replaces a face of a map, or `corner` if that is one.
    BodyIndex cutCorner(BodyIndex corner);
    /// Of a face of a map that was cut, or the face itself: the corner opposite the edge from one
    /// vertex to the other; kNone if there is no such edge.
    BodyIndex partAtEdge(BodyIndex face, BodyIndex from, BodyIndex to) const;
    /// The corner opposite the edge from one place to the other; kNone if there is no such edge.
    BodyIndex cornerAtEdge(BodyIndex from, BodyIndex to) const;

    /// Puts a vertex with the place `up` on the edge opposite a corner, at a share of the way from
    /// the edge's first end, on both of its sides. Returns its corner in the face of its second
    /// half.
    BodyIndex splitEdge(BodyIndex corner, double share, const Vec3& up);
    /// The same at the share at which the edge passes the place.
    BodyIndex splitEdgeAt(BodyIndex corner, const Vec3& up);
    /// The share of the way along the edge opposite a corner at which it passes a place.
    double shareBeside(BodyIndex corner, const Vec3& up) const;
    /// The face straight above or below a place, found from another face.
    std::optional<BodyIndex> walkTo(BodyIndex face, const Vec3& up) const;
    /// The same among faces of the maps from `first` on.
    std::optional<BodyIndex> find(std::size_t first, const ScenePoint& point) const;
    /// A vertex straight above or below a place in a face; an existing one within `tolerance`.
    BodyIndex insert(BodyIndex face, const Vec3& up, double tolerance);
    /// Inserts edges along the straight way between two vertices. Returns the vertices on it, the
    /// first one included; nothing if it leads over a border.
    std::optional<std::vector<BodyIndex>> connect(BodyIndex from, BodyIndex to, double tolerance);

private:
    void note(BodyIndex face);

    std::vector<Map> maps_;
    BodyIndex map_faces_ = 0;
    BodyIndex map_vertices_ = 0;
    std::vector<Face> cut_;
    std::vector<ScenePoint> points_;
    std::vector<Vec3> ups_;
    std::unordered_map<BodyIndex, BodyIndex> links_;   // of corners of maps: across
    std::unordered_map<BodyIndex, BodyIndex> corners_; // some corner of a vertex
    std::unordered_map<BodyIndex, BodyIndex> twins_;
    std::unordered_map<BodyIndex, std::vector<BodyIndex>> parts_; // of faces of maps
};

/// Twice the area of the triangle between three directions; positive if counter-clockwise.
inline double areaOf(const Vec3& a, const Vec3& b, const Vec3& c) noexcept
{
    return dot(a, cross(b - a, c - a));
}

} // namespace marsview
