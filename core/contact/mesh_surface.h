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
#include <utility>

namespace marsview {

/// A vertex, edge or face of a mesh, by Mesh::Index.
template <typename Index>
struct BasicMeshVertex {
    Index index = 0;
    bool operator==(const BasicMeshVertex&) const = default;
};
/// The edge opposite a corner; of the two corners that have it, the lesser.
template <typename Index>
struct BasicMeshEdge {
    Index corner = 0;
    bool operator==(const BasicMeshEdge&) const = default;
};
template <typename Index>
struct BasicMeshSide {
    Index face = 0;
    bool operator==(const BasicMeshSide&) const = default;
};
/// Those of a TriangleMesh.
using MeshVertex = BasicMeshVertex<TriangleMesh::Index>;
using MeshEdge = BasicMeshEdge<TriangleMesh::Index>;
using MeshSide = BasicMeshSide<TriangleMesh::Index>;
/// The position is `scene` + `rest`. Between two goals, `rest` keeps what the coordinates cannot
/// resolve; otherwise events on a path of nanometers far from the origin would be misjudged. `rest`
/// is zero for a goal given by the caller.
struct MeshGoal {
    ScenePoint scene;
    Vec3 rest{};

    Vec3 from(const ScenePoint& point) const noexcept { return (scene - point) + rest; }
};
template <typename Mesh>
using MeshCorners = decltype(std::declval<const Mesh&>().fan(0));
/// A mesh with few edges at a vertex, which computes all of them at once.
template <typename Mesh>
concept MeshWithRings = requires(const Mesh& mesh, const MeshCorners<Mesh>& corners)
{
    mesh.ring(0, ScenePoint{}, corners);
};
template <typename Mesh>
struct MeshRing {};
template <MeshWithRings Mesh>
struct MeshRing<Mesh> {
    decltype(std::declval<const Mesh&>().ring(0, ScenePoint{}, MeshCorners<Mesh>())) edges;
};
/// A mesh of samples, on which a walk finds most vertices by adding (BodyMesh).
template <typename Mesh>
concept MeshOfSamples = requires(const Mesh& mesh)
{
    mesh.stepsFrom(0);
};
template <typename Mesh>
struct MeshSteps {};
template <MeshOfSamples Mesh>
struct MeshSteps<Mesh> {
    decltype(std::declval<const Mesh&>().stepsFrom(0)) at; // of the corners, in their order
};
template <typename Mesh>
struct MeshFan {
    BasicMeshVertex<typename Mesh::Index> vertex;
    ScenePoint point;
    MeshCorners<Mesh> corners; // TriangleMesh::fan
    MeshRing<Mesh> ring{};
};

/// The face that a walk is on. Weights are dot products with `inward`, counted from a corner on
/// their own edge, so that they are exact where the goal is near it.
template <typename Mesh>
struct MeshFacet {
    using Vertex = BasicMeshVertex<typename Mesh::Index>;
    std::array<Vertex, 3> vertices; // counter-clockwise seen from free space
    double scale;                   // |normal|²
    typename Mesh::Index corner;    // of the mesh, the first; kNone: found from `steps`
    [[no_unique_address]] MeshSteps<Mesh> steps;
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
///
///     const MeshSurface surface(mesh);
///     ContinuousWalk walk(surface);
template <typename Mesh>
class BasicMeshSurface {
public:
    using Index = typename Mesh::Index;
    using Vertex = BasicMeshVertex<Index>;
    using Edge = BasicMeshEdge<Index>;
    using Face = BasicMeshSide<Index>;
    using Goal = MeshGoal;
    using Fan = MeshFan<Mesh>;
    using Facet = MeshFacet<Mesh>;
    using EdgeFacets = SurfaceEdgeFacets<BasicMeshSurface>;
    using Contact = SurfaceContact<BasicMeshSurface>;
    using Cast = SurfaceCast<BasicMeshSurface>;
    using Spoke = SurfaceSpoke<BasicMeshSurface>;
    using Wing = SurfaceWing<BasicMeshSurface>;

    static constexpr bool kIsBorderWall = false;
    /// Coordinates beyond this, in meters, are refused as goals, like those that are not finite.
    static constexpr double kGoalMaxM = Mesh::kCoordinateMaxM;

    explicit BasicMeshSurface(std::shared_ptr<const Mesh> mesh);

    const std::shared_ptr<const Mesh>& mesh() const noexcept { return mesh_; }

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
    Vec3 toGoal(const Facet& from, std::size_t i, const Goal& goal) const noexcept
    {
        return goal.from(from.points[i]);
    }
    Vec3 between(const Facet& facet, std::size_t from, std::size_t to) const noexcept
    {
        return facet.points[to] - facet.points[from];
    }
    std::array<Vertex, 3> corners(Face face) const noexcept
    {
        const auto f = mesh_->face(face.face);
        return {Vertex{f[0]}, Vertex{f[1]}, Vertex{f[2]}};
    }
    Facet facet(Face face, std::size_t first) const noexcept
    {
        return facetAt(3 * face.face + static_cast<Index>(first));
    }
    Face faceOf(const Facet& facet) const noexcept { return {Mesh::faceOf(cornerOf(facet, 0))}; }
    EdgeFacets edgeFacets(Edge edge) const noexcept
    {
        EdgeFacets facets{facetAt(edge.corner), {}, false};
        facets.has_right = hasBeyond(facets.left, 0);
        if (facets.has_right) {
            facets.right = beyond(facets.left, 0);
        }
        return facets;
    }
    bool hasBeyond(const Facet& facet, std::size_t opposite) const noexcept
    {
        if constexpr (MeshOfSamples<Mesh>) {
            if (mesh_->isSample(stepOver(facet, opposite))) {
                return true;
            }
        }
        return mesh_->across(cornerOf(facet, opposite)) != Mesh::kNone;
    }
    Facet beyond(const Facet& facet, std::size_t opposite) const noexcept
    {
        const std::size_t second = (opposite + 2) % 3;
        const std::size_t third = (opposite + 1) % 3;
        if constexpr (MeshOfSamples<Mesh>) {
            const auto far = stepOver(facet, opposite);
            if (mesh_->isSample(far)) {
                return facetOf(
                    Mesh::kNone,
                    {Vertex{mesh_->vertexOf(far)}, facet.vertices[second], facet.vertices[third]},
                    {mesh_->pointOf(far), facet.points[second], facet.points[third]},
                    {{far, facet.steps.at[second], facet.steps.at[third]}});
            }
        }
        const Index corner = mesh_->across(cornerOf(facet, opposite));
        if constexpr (MeshOfSamples<Mesh>) {
            return facetAt(corner);
        } else { // only the corner beyond the edge is another one
            const Index far = mesh_->vertexAt(corner);
            return facetOf(corner, {Vertex{far}, facet.vertices[second], facet.vertices[third]},
                           {mesh_->vertex(far), facet.points[second], facet.points[third]}, {});
        }
    }
    static int bend(const Facet& facet, std::size_t opposite, const Facet& beyond) noexcept
    {
        constexpr double kFlat = 16.0 * std::numeric_limits<double>::epsilon();
        const Vec3 to_far = beyond.points[0] - facet.points[(opposite + 1) % 3];
        const double above = dot(facet.normal, to_far);
        return above * above <= kFlat * kFlat * facet.scale * dot(to_far, to_far) ? 0
               : above > 0.0                                                      ? 1
                                                                                  : -1;
    }

    std::array<Vertex, 2> ends(Edge edge) const noexcept
    {
        if constexpr (MeshOfSamples<Mesh>) {
            const auto [from, to] = mesh_->edgeEnds(edge.corner);
            return {Vertex{from}, Vertex{to}};
        }
        return {Vertex{mesh_->vertexAt(Mesh::nextCorner(edge.corner))},
                Vertex{mesh_->vertexAt(Mesh::previousCorner(edge.corner))}};
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
    SurfaceLegs<BasicMeshSurface> legs(const ScenePoint& /*from*/,
                                       const ScenePoint& to) const noexcept
    {
        SurfaceLegs<BasicMeshSurface> legs;
        legs.ends[0] = {to, {}};
        legs.count = 1;
        return legs;
    }

    Fan fan(Vertex v) const noexcept
    {
        const ScenePoint point = mesh_->vertex(v.index);
        const auto corners = mesh_->fan(v.index);
        if constexpr (MeshWithRings<Mesh>) {
            return {v, point, corners, {mesh_->ring(v.index, point, corners)}};
        } else {
            return {v, point, corners, {}};
        }
    }
    template <typename F>
    void eachSpoke(const Fan& fan, F&& function) const noexcept
    {
        if constexpr (MeshWithRings<Mesh>) {
            for (std::size_t i = 0; i < fan.ring.edges.count; ++i) {
                function(spokeAt(fan, i));
            }
            return;
        }
        for (const Index corner : fan.corners) {
            function(spokeTo(fan, mesh_->vertexAt(Mesh::nextCorner(corner))));
        }
        const Index last = fan.corners.back();
        if (mesh_->across(Mesh::nextCorner(last)) == Mesh::kNone) {
            function(spokeTo(fan, mesh_->vertexAt(Mesh::previousCorner(last))));
        }
    }
    template <typename F>
    void eachSector(const Fan& fan, F&& function) const noexcept
    {
        if constexpr (MeshWithRings<Mesh>) {
            std::size_t i = 0;
            for (const Index corner : fan.corners) {
                const std::size_t next = i + 1 < fan.ring.edges.count ? i + 1 : 0;
                function(Face{Mesh::faceOf(corner)}, spokeAt(fan, i), spokeAt(fan, next));
                i = next;
            }
            return;
        }
        // Each sector begins at the spoke at which the one before it ends.
        Spoke begin = spokeTo(fan, mesh_->vertexAt(Mesh::nextCorner(fan.corners.front())));
        for (const Index corner : fan.corners) {
            const Spoke end = spokeTo(fan, mesh_->vertexAt(Mesh::previousCorner(corner)));
            function(Face{Mesh::faceOf(corner)}, begin, end);
            begin = end;
        }
    }

    std::optional<Face> wayOut(const Fan& fan, const Goal& goal) const noexcept;
    std::optional<Face> wayOut(const Contact& contact, const Goal& goal) const noexcept;
    Cast castFrom(const Contact& contact, Face over, const Goal& goal) const noexcept;
    Cast castFree(const Goal& from, const Goal& to) const noexcept;

    /// Calls function(face, corners counter-clockwise) with each face whose box intersects the box
    /// from `low` to `high`.
    template <typename F>
    void eachFaceNear(const ScenePoint& low, const ScenePoint& high, F&& function) const noexcept
    {
        mesh_->tree().inBox(low, high, [&](Index face) {
            const auto points = mesh_->points(face);
            if (mayMeet(points, low, high)) {
                function(Face{face}, points);
            }
        });
    }

    std::uint32_t stepsMax() const noexcept { return steps_max_; }
    std::uint32_t stepsAlong(double /*way*/) const noexcept { return steps_max_; }

private:
    // A tree may find blocks of faces.
    static bool mayMeet(const std::array<ScenePoint, 3>& points,
                        const ScenePoint& low,
                        const ScenePoint& high) noexcept
    {
        const auto [a, b, c] = points;
        return std::min({a.x, b.x, c.x}) <= high.x && std::max({a.x, b.x, c.x}) >= low.x &&
               std::min({a.y, b.y, c.y}) <= high.y && std::max({a.y, b.y, c.y}) >= low.y &&
               std::min({a.z, b.z, c.z}) <= high.z && std::max({a.z, b.z, c.z}) >= low.z;
    }
    static Index turnedCorner(const Facet& facet, std::size_t i) noexcept
    {
        return facet.corner == Mesh::kNone ? Mesh::kNone
               : i == 0                    ? facet.corner
               : i == 1                    ? Mesh::nextCorner(facet.corner)
                                           : Mesh::previousCorner(facet.corner);
    }
    static MeshSteps<Mesh>
    turnedSteps([[maybe_unused]] const Facet& facet,
                [[maybe_unused]] const std::array<std::size_t, 3>& order) noexcept
    {
        if constexpr (MeshOfSamples<Mesh>) {
            const auto& at = facet.steps.at;
            return {{at[order[0]], at[order[1]], at[order[2]]}};
        } else {
            return {};
        }
    }
    Index cornerOf(const Facet& facet, std::size_t i) const noexcept
    {
        if constexpr (MeshOfSamples<Mesh>) {
            if (facet.corner == Mesh::kNone) {
                return mesh_->cornerOf(turnedSteps(facet, {i, (i + 1) % 3, (i + 2) % 3}).at);
            }
        }
        return turnedCorner(facet, i);
    }
    // A template, as spokeAt() is: clang 14 instantiates constrained members with every class.
    template <MeshOfSamples M = Mesh>
    static auto stepOver(const Facet& facet, std::size_t opposite) noexcept
    {
        const auto& at = facet.steps.at;
        return M::step(at[opposite], at[(opposite + 1) % 3], at[(opposite + 2) % 3]);
    }
    Facet facetAt(Index corner) const noexcept
    {
        const Index face = Mesh::faceOf(corner);
        const Index first = corner % 3;
        const Index second = (first + 1) % 3;
        const Index third = (first + 2) % 3;
        const auto all = mesh_->face(face);
        const auto points = mesh_->points(face);
        MeshSteps<Mesh> steps{};
        if constexpr (MeshOfSamples<Mesh>) {
            const auto at = mesh_->stepsFrom(face);
            steps = {{at[first], at[second], at[third]}};
        }
        return facetOf(corner, {Vertex{all[first]}, Vertex{all[second]}, Vertex{all[third]}},
                       {points[first], points[second], points[third]}, steps);
    }
    static Facet facetOf(Index corner,
                         const std::array<Vertex, 3>& vertices,
                         const std::array<ScenePoint, 3>& points,
                         const MeshSteps<Mesh>& steps) noexcept
    {
        const Vec3 a = points[1] - points[0];
        const Vec3 b = points[2] - points[0];
        const Vec3 normal = cross(a, b);
        return {.vertices = vertices,
                .scale = dot(normal, normal),
                .corner = corner,
                .steps = steps,
                .points = points,
                .normal = normal,
                .inward = {cross(normal, b - a), cross(b, normal), cross(normal, a)}};
    }
    Edge edgeOpposite(Index corner) const noexcept
    {
        return {std::min(corner, mesh_->across(corner))};
    }
    static std::optional<Wing> wingAt(Index corner) noexcept
    {
        return corner == Mesh::kNone
                   ? std::nullopt
                   : std::optional(Wing{{Mesh::faceOf(corner)}, static_cast<int>(corner % 3)});
    }
    Spoke spokeTo(const Fan& fan, Index vertex) const noexcept
    {
        return {{vertex}, mesh_->vertex(vertex) - fan.point};
    }
    template <MeshWithRings M = Mesh>
    static Spoke spokeAt(const Fan& fan, std::size_t i) noexcept
    {
        return {{fan.ring.edges.vertices[i]}, fan.ring.edges.along[i]};
    }
    bool isAtBorder(const Fan& fan) const noexcept
    {
        if constexpr (MeshWithRings<Mesh>) {
            return fan.ring.edges.count > fan.corners.size();
        } else {
            return mesh_->across(Mesh::previousCorner(fan.corners.front())) == Mesh::kNone;
        }
    }
    bool isValley(Index corner) const noexcept;
    std::optional<Face> wayOutOfMixed(const Fan& fan, const Goal& goal) const noexcept;
    Contact contactFrom(const BasicMeshPlace<Index>& place) const noexcept;

    std::shared_ptr<const Mesh> mesh_;
    std::uint32_t steps_max_;
};

/// A general mesh. BodySurface (body_surface.h) is that of a map on its body.
using MeshSurface = BasicMeshSurface<TriangleMesh>;

// Instantiated once, in mesh_surface.cpp.
extern template class BasicMeshSurface<TriangleMesh>;

static_assert(ContactSurface<MeshSurface>);

} // namespace marsview
