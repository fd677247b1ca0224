// A general triangle mesh as contact models see it (contact_surface.h).
#pragma once

#include "core/contact/contact_surface.h"
#include "core/mesh/mesh_cast.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace marsview {

/// A vertex, edge or face of a TriangleMesh.
struct MeshVertex {
    std::uint32_t index = 0;
    bool operator==(const MeshVertex&) const = default;
};
/// The edge opposite a corner; of the two corners that have it, the lesser.
struct MeshEdge {
    std::uint32_t corner = 0;
    bool operator==(const MeshEdge&) const = default;
};
struct MeshSide {
    std::uint32_t face = 0;
    bool operator==(const MeshSide&) const = default;
};
/// The position is `scene` + `rest`. Between two goals, `rest` keeps what the coordinates cannot
/// resolve; otherwise events on a path of nanometers far from the origin would be misjudged. `rest`
/// is zero for a goal given by the caller.
struct MeshGoal {
    ScenePoint scene;
    Vec3 rest{};

    Vec3 from(const ScenePoint& point) const noexcept { return (scene - point) + rest; }
};
struct MeshFan {
    MeshVertex vertex;
    ScenePoint point;
    std::span<const std::uint32_t> corners; // TriangleMesh::fan
};

/// The face that a walk is on. Weights are dot products with `inward`, counted from a corner on
/// their own edge, so that they are exact where the goal is near it.
struct MeshFacet {
    std::array<MeshVertex, 3> vertices; // counter-clockwise seen from free space
    double scale;                       // |normal|²
    std::uint32_t corner;               // of the mesh, the first
    std::array<ScenePoint, 3> points;
    Vec3 normal;
    std::array<Vec3, 3> inward; // from the edge opposite corner i to it, times |normal|²

    SurfaceFoot foot(const MeshGoal& goal) const noexcept
    {
        const Vec3 from_first = goal.from(points[0]);
        return {{weight(goal.from(points[1]), inward[0]), weight(goal.from(points[2]), inward[1]),
                 weight(from_first, inward[2])},
                dot(from_first, normal)};
    }
    double error(const MeshGoal& goal) const noexcept
    {
        constexpr double kTolerance = 16.0 * std::numeric_limits<double>::epsilon();
        const Vec3 to_goal = goal.from(points[0]);
        const double longest_squared = std::max(
            {dot(inward[0], inward[0]), dot(inward[1], inward[1]), dot(inward[2], inward[2])});
        return kTolerance * (scale + std::sqrt(longest_squared * dot(to_goal, to_goal)));
    }

private:
    // Weights within rounding error are 0, so that a goal on the edge between two flat faces is
    // within one of them.
    static double weight(const Vec3& to_goal, const Vec3& inward) noexcept
    {
        constexpr double kTolerance = 8.0 * std::numeric_limits<double>::epsilon();
        const double x = to_goal.x * inward.x;
        const double y = to_goal.y * inward.y;
        const double z = to_goal.z * inward.z;
        const double sum = x + y + z;
        return std::abs(sum) <= kTolerance * (std::abs(x) + std::abs(y) + std::abs(z)) ? 0.0 : sum;
    }
};

/// One-sided: the proxy passes through the back of faces. Goals are scene points, nowhere clamped:
/// at the border of an open mesh the proxy falls off where no face leads closer. Placing treats a
/// point as above the surface if it is not behind the nearest point of the mesh (J. A. Baerentzen
/// and H. Aanaes, "Signed distance computation using the angle weighted pseudonormal", IEEE TVCG
/// 11, 2005).
///
/// A small immutable value that shares the mesh. Any thread; allocates nothing after construction.
class MeshSurface {
public:
    using Vertex = MeshVertex;
    using Edge = MeshEdge;
    using Face = MeshSide;
    using Goal = MeshGoal;
    using Fan = MeshFan;
    using Facet = MeshFacet;
    using EdgeFacets = SurfaceEdgeFacets<MeshSurface>;
    using Contact = SurfaceContact<MeshSurface>;
    using Cast = SurfaceCast<MeshSurface>;
    using Spoke = SurfaceSpoke<MeshSurface>;
    using Wing = SurfaceWing<MeshSurface>;

    static constexpr bool kIsBorderWall = false;
    /// Coordinates beyond this, in meters, are refused as goals, like those that are not finite.
    static constexpr double kGoalMaxM = TriangleMesh::kCoordinateMaxM;

    explicit MeshSurface(std::shared_ptr<const TriangleMesh> mesh);

    const std::shared_ptr<const TriangleMesh>& mesh() const noexcept { return mesh_; }

    std::optional<Goal> goal(const ScenePoint& point) const noexcept
    {
        const bool is_aimed_at = std::abs(point.x) <= kGoalMaxM && std::abs(point.y) <= kGoalMaxM &&
                                 std::abs(point.z) <= kGoalMaxM;
        return is_aimed_at ? std::optional(Goal{point, {}}) : std::nullopt;
    }
    ScenePoint goalPoint(const Goal& goal) const noexcept { return goal.scene; }
    bool isAbove(const Goal& goal) const noexcept
    {
        return wayOut(contactAt(goal), goal).has_value();
    }
    /// The nearest point.
    Contact contactAt(const Goal& goal) const noexcept;
    /// A corner of the first face.
    Contact initialContact() const noexcept;
    ScenePoint point(const Contact& contact) const noexcept;

    Vec3 toGoal(Vertex from, const Goal& goal) const noexcept
    {
        return goal.from(mesh_->vertex(from.index));
    }
    Vec3 toGoal(const Fan& from, const Goal& goal) const noexcept { return goal.from(from.point); }
    Vec3 between(Vertex from, Vertex to) const noexcept
    {
        return mesh_->vertex(to.index) - mesh_->vertex(from.index);
    }
    std::array<Vertex, 3> corners(Face face) const noexcept
    {
        const MeshFace& f = mesh_->face(face.face);
        return {Vertex{f[0]}, Vertex{f[1]}, Vertex{f[2]}};
    }
    Facet facet(Face face, std::size_t first) const noexcept
    {
        return facetAt(3 * face.face + static_cast<std::uint32_t>(first));
    }
    Facet rotated(const Facet& facet, std::size_t first) const noexcept
    {
        return facetAt(cornerOf(facet, first));
    }
    Face faceOf(const Facet& facet) const noexcept { return {facet.corner / 3}; }
    EdgeFacets edgeFacets(Edge edge) const noexcept
    {
        EdgeFacets facets{facetAt(edge.corner), {}, false};
        const std::uint32_t beyond = mesh_->across(edge.corner);
        if (beyond != TriangleMesh::kNone) {
            facets.right = facetAt(beyond);
            facets.has_right = true;
        }
        return facets;
    }
    bool hasBeyond(const Facet& facet, std::size_t opposite) const noexcept
    {
        return mesh_->across(cornerOf(facet, opposite)) != TriangleMesh::kNone;
    }
    Facet beyond(const Facet& facet, std::size_t opposite) const noexcept
    {
        return facetAt(mesh_->across(cornerOf(facet, opposite)));
    }
    int bend(const Facet& facet, std::size_t opposite) const noexcept
    {
        constexpr double kFlat = 16.0 * std::numeric_limits<double>::epsilon();
        const std::uint32_t far = mesh_->across(cornerOf(facet, opposite));
        const Vec3 to_far = mesh_->vertex(mesh_->vertexAt(far)) - facet.points[(opposite + 1) % 3];
        const double above = dot(facet.normal, to_far);
        return above * above <= kFlat * kFlat * facet.scale * dot(to_far, to_far) ? 0
               : above > 0.0                                                      ? 1
                                                                                  : -1;
    }

    std::array<Vertex, 2> ends(Edge edge) const noexcept
    {
        return {Vertex{mesh_->vertexAt(TriangleMesh::nextCorner(edge.corner))},
                Vertex{mesh_->vertexAt(TriangleMesh::previousCorner(edge.corner))}};
    }
    Edge edgeBetween(Vertex a, Vertex b) const noexcept;
    std::array<std::optional<Wing>, 2> wings(Edge edge) const noexcept
    {
        return {wingAt(edge.corner), wingAt(mesh_->across(edge.corner))};
    }

    Goal along(const Goal& from, const Goal& to, double share) const noexcept
    {
        if (!(share > 0.0 && share < 1.0)) {
            return share > 0.0 ? to : from;
        }
        const Vec3 step = ((to.scene - from.scene) + (to.rest - from.rest)) * share;
        const ScenePoint scene = from.scene + step;
        return {scene, from.rest + (step - (scene - from.scene))};
    }
    SurfaceLegs<MeshSurface> legs(const ScenePoint& /*from*/, const ScenePoint& to) const noexcept
    {
        SurfaceLegs<MeshSurface> legs;
        legs.ends[0] = {to, {}};
        legs.count = 1;
        return legs;
    }

    Fan fan(Vertex v) const noexcept { return {v, mesh_->vertex(v.index), mesh_->fan(v.index)}; }
    template <typename F>
    void eachSpoke(const Fan& fan, F&& function) const noexcept
    {
        for (const std::uint32_t corner : fan.corners) {
            function(spokeTo(fan, mesh_->vertexAt(TriangleMesh::nextCorner(corner))));
        }
        const std::uint32_t last = fan.corners.back();
        if (mesh_->across(TriangleMesh::nextCorner(last)) == TriangleMesh::kNone) {
            function(spokeTo(fan, mesh_->vertexAt(TriangleMesh::previousCorner(last))));
        }
    }
    template <typename F>
    void eachSector(const Fan& fan, F&& function) const noexcept
    {
        for (const std::uint32_t corner : fan.corners) {
            function(Face{TriangleMesh::faceOf(corner)},
                     spokeTo(fan, mesh_->vertexAt(TriangleMesh::nextCorner(corner))),
                     spokeTo(fan, mesh_->vertexAt(TriangleMesh::previousCorner(corner))));
        }
    }

    std::optional<Face> wayOut(const Fan& fan, const Goal& goal) const noexcept;
    std::optional<Face> wayOut(const Contact& contact, const Goal& goal) const noexcept;
    Cast castFrom(const Contact& contact, Face over, const Goal& goal) const noexcept;
    Cast castFree(const Goal& from, const Goal& to) const noexcept;

    /// Calls function(face, corners counter-clockwise) with each face whose box intersects the box
    /// from `low` to `high`; occasionally also with one whose box misses it by a rounding error.
    template <typename F>
    void eachFaceNear(const ScenePoint& low, const ScenePoint& high, F&& function) const noexcept
    {
        mesh_->tree().inBox(low, high,
                            [&](std::uint32_t face) { function(Face{face}, mesh_->points(face)); });
    }

    std::uint32_t stepsMax() const noexcept { return steps_max_; }
    std::uint32_t stepsAlong(double /*way*/) const noexcept { return steps_max_; }

private:
    static std::uint32_t cornerOf(const Facet& facet, std::size_t i) noexcept
    {
        return i == 0   ? facet.corner
               : i == 1 ? TriangleMesh::nextCorner(facet.corner)
                        : TriangleMesh::previousCorner(facet.corner);
    }
    Facet facetAt(std::uint32_t corner) const noexcept
    {
        const std::uint32_t second = TriangleMesh::nextCorner(corner);
        const std::uint32_t third = TriangleMesh::previousCorner(corner);
        Facet facet;
        facet.vertices = {Vertex{mesh_->vertexAt(corner)}, Vertex{mesh_->vertexAt(second)},
                          Vertex{mesh_->vertexAt(third)}};
        for (std::size_t i = 0; i < 3; ++i) {
            facet.points[i] = mesh_->vertex(facet.vertices[i].index);
        }
        const Vec3 a = facet.points[1] - facet.points[0];
        const Vec3 b = facet.points[2] - facet.points[0];
        facet.normal = cross(a, b);
        facet.inward = {cross(facet.normal, b - a), cross(b, facet.normal), cross(facet.normal, a)};
        facet.scale = dot(facet.normal, facet.normal);
        facet.corner = corner;
        return facet;
    }
    Edge edgeOpposite(std::uint32_t corner) const noexcept
    {
        return {std::min(corner, mesh_->across(corner))};
    }
    static std::optional<Wing> wingAt(std::uint32_t corner) noexcept
    {
        return corner == TriangleMesh::kNone ? std::nullopt
                                             : std::optional(Wing{{TriangleMesh::faceOf(corner)},
                                                                  static_cast<int>(corner % 3)});
    }
    Spoke spokeTo(const Fan& fan, std::uint32_t vertex) const noexcept
    {
        return {{vertex}, mesh_->vertex(vertex) - fan.point};
    }
    bool isValley(std::uint32_t corner) const noexcept;
    std::optional<Face> wayOutOfMixed(const Fan& fan, const Goal& goal) const noexcept;
    Contact contactFrom(const MeshPlace& place) const noexcept;

    std::shared_ptr<const TriangleMesh> mesh_;
    std::uint32_t steps_max_;
};

static_assert(ContactSurface<MeshSurface>);

} // namespace marsview
