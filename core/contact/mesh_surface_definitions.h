// The definitions of mesh_surface.h, for the files that instantiate them.
#pragma once

#include "core/base/check.h"
#include "core/contact/mesh_surface.h"

#include <utility>

namespace marsview {
namespace mesh_surface {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// From a vertex or out of a valley, a path that rises less than this over a face, as a sine, does
// not leave it: rounding of the neighbors' corners could turn it into the surface.
inline constexpr double kRiseMin = 1e-13;

// A path that leaves a face or an edge begins by this share of its size above it, so that rounding
// cannot let it begin below. mesh_cast.cpp relies on it.
inline constexpr double kLift = 64.0 * kEpsilon;

inline MeshEnd endAt(const MeshGoal& goal) noexcept
{
    return {goal.scene, goal.rest};
}

} // namespace mesh_surface

template <typename Mesh>
BasicMeshSurface<Mesh>::BasicMeshSurface(std::shared_ptr<const Mesh> mesh)
    : mesh_(std::move(mesh))
{
    MARSVIEW_CHECK(mesh_ && mesh_->faceCount() > 0);
    // A straight path could meet all faces and edges.
    const auto faces =
        static_cast<std::uint32_t>(std::min(mesh_->faceCount(), std::size_t{1} << 28U));
    steps_max_ = 4096U + 8U * faces;
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::contactFrom(const BasicMeshPlace<Index>& place) const noexcept
    -> Contact
{
    return contactOnFace(*this, Face{place.face}, place.weights);
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::contactAt(const Goal& goal) const noexcept -> Contact
{
    if constexpr (requires { mesh_->highAbove(goal.scene); }) {
        const auto down =
            castSegment(*mesh_, {.base = mesh_->highAbove(goal.scene)}, mesh_surface::endAt(goal));
        if (down.hit) {
            return contactFrom(*down.hit);
        }
    }
    return contactFrom(nearestPlace(*mesh_, goal.scene));
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::initialContact() const noexcept -> Contact
{
    Contact contact;
    contact.feature = ContactFeature::Vertex;
    contact.vertex = {mesh_->face(0)[0]};
    return contact;
}

template <typename Mesh>
ScenePoint BasicMeshSurface<Mesh>::point(const Contact& contact) const noexcept
{
    if (contact.feature == ContactFeature::Vertex) {
        return mesh_->vertex(contact.vertex.index);
    }
    if (contact.feature == ContactFeature::Edge) {
        const auto [from, to] = ends(contact.edge);
        return mesh_->vertex(from.index) + between(from, to) * contact.along;
    }
    const auto points = mesh_->points(contact.face.face);
    return points[0] + ((points[1] - points[0]) * contact.weights[1] +
                        (points[2] - points[0]) * contact.weights[2]);
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::edgeBetween(Vertex a, Vertex b) const noexcept -> Edge
{
    if constexpr (MeshOfSamples<Mesh>) {
        return {mesh_->cornerAtEdge(a.index, b.index)};
    }
    for (const Index corner : mesh_->fan(a.index)) {
        const Index next = Mesh::nextCorner(corner);
        const Index previous = Mesh::previousCorner(corner);
        if (mesh_->vertexAt(next) == b.index) {
            return edgeOpposite(previous);
        }
        if (mesh_->vertexAt(previous) == b.index) {
            return edgeOpposite(next);
        }
    }
    return {}; // not edges of one face
}

// Whether the edge opposite a corner, which is not at the border, is a valley or flat. Exact, like
// the side of its faces on which the goal is: together they decide what counts as free space.
template <typename Mesh>
bool BasicMeshSurface<Mesh>::isValley(Index corner) const noexcept
{
    return sideOf(*mesh_, Mesh::faceOf(corner),
                  {mesh_->vertex(mesh_->vertexAt(mesh_->across(corner)))}) >= 0;
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::wayOut(const Fan& fan, const Goal& goal) const noexcept
    -> std::optional<Face>
{
    // In front of all faces is free space, behind all is not. In between, the nearest face decides.
    const Vec3 to_goal = goal.from(fan.point);
    const double goal_squared = dot(to_goal, to_goal);
    bool is_over_all = true;
    bool is_over_any = false;
    eachSector(fan, [&](Face, const Spoke& a, const Spoke& b) {
        const Vec3 normal = cross(a.along, b.along);
        const double above = dot(normal, to_goal);
        const bool is_over = above > 0.0 && above * above > mesh_surface::kRiseMin *
                                                                mesh_surface::kRiseMin *
                                                                goal_squared * dot(normal, normal);
        is_over_all = is_over_all && is_over;
        is_over_any = is_over_any || is_over;
    });
    if (is_over_all) {
        return Face{Mesh::faceOf(fan.corners.front())};
    }
    if ((!is_over_any && !isAtBorder(fan)) || goal_squared == 0.0) {
        return std::nullopt;
    }
    return wayOutOfMixed(fan, goal);
}

// Whether a face, an edge or the vertex itself is nearest to the goal if the faces of the vertex
// extended without end.
template <typename Mesh>
auto BasicMeshSurface<Mesh>::wayOutOfMixed(const Fan& fan, const Goal& goal) const noexcept
    -> std::optional<Face>
{
    struct Sector {
        Vec3 a;
        Vec3 b;
        Vec3 normal; // of length 1
        double above;
    };
    const Vec3 to_goal = goal.from(fan.point);
    const double goal_length = length(to_goal);
    const auto sector_at = [&](Index corner) {
        Sector sector{};
        sector.a = mesh_->vertex(mesh_->vertexAt(Mesh::nextCorner(corner))) - fan.point;
        sector.b = mesh_->vertex(mesh_->vertexAt(Mesh::previousCorner(corner))) - fan.point;
        sector.normal = normalized(cross(sector.a, sector.b));
        sector.above = dot(sector.normal, to_goal);
        return sector;
    };
    const double rise_min = mesh_surface::kRiseMin * goal_length;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double nearest_free = kInfinity;
    double nearest_blocked = kInfinity;
    Face over{Mesh::faceOf(fan.corners.front())};
    const auto offer = [&](double distance, bool is_free, Face face) {
        if (!is_free || distance <= rise_min) {
            nearest_blocked = std::min(nearest_blocked, distance);
        } else if (distance < nearest_free) {
            nearest_free = distance;
            over = face;
        }
    };
    // The distance from a spoke, if the goal is not beyond the vertex.
    const auto from_spoke = [&](const Vec3& spoke) {
        return dot(spoke, to_goal) > 0.0 ? length(cross(spoke, to_goal)) / length(spoke)
                                         : kInfinity;
    };
    const bool is_at_border = isAtBorder(fan);
    Vec3 pseudonormal{};
    for (const Index corner : fan.corners) {
        const Face face{Mesh::faceOf(corner)};
        const Sector sector = sector_at(corner);
        pseudonormal = pseudonormal + sector.normal * std::atan2(length(cross(sector.a, sector.b)),
                                                                 dot(sector.a, sector.b));
        if (dot(cross(sector.normal, sector.a), to_goal) >= 0.0 &&
            dot(cross(sector.b, sector.normal), to_goal) >= 0.0) {
            offer(std::abs(sector.above), sector.above > rise_min, face);
        }
        // The spoke that the sector ends at, and the first one of a border.
        const double distance = from_spoke(sector.b);
        const Index beyond = mesh_->across(Mesh::nextCorner(corner));
        if (beyond == Mesh::kNone) {
            offer(distance, true, face);
        } else if (distance < kInfinity) {
            const bool is_here = sector.above > rise_min;
            const bool is_there = sector_at(Mesh::nextCorner(beyond)).above > rise_min;
            offer(distance, isValley(beyond) ? is_here && is_there : is_here || is_there,
                  is_here ? face : Face{Mesh::faceOf(beyond)});
        }
        if (is_at_border && corner == fan.corners.front()) {
            offer(from_spoke(sector.a), true, face);
        }
    }
    if (nearest_free == kInfinity && nearest_blocked == kInfinity) { // the vertex itself
        return is_at_border || dot(pseudonormal, to_goal) > rise_min ? std::optional(over)
                                                                     : std::nullopt;
    }
    // Between the walls of a narrow crack, rounding hides which of them is nearer.
    return nearest_free + 16.0 * mesh_surface::kEpsilon * goal_length < nearest_blocked
               ? std::optional(over)
               : std::nullopt;
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::wayOut(const Contact& contact, const Goal& goal) const noexcept
    -> std::optional<Face>
{
    if (contact.feature == ContactFeature::Vertex) {
        return wayOut(fan(contact.vertex), goal);
    }
    if (contact.feature == ContactFeature::Face) {
        return sideOf(*mesh_, contact.face.face, mesh_surface::endAt(goal)) > 0
                   ? std::optional(contact.face)
                   : std::nullopt;
    }
    const Index corner = contact.edge.corner;
    const Index beyond = mesh_->across(corner);
    const Face here{Mesh::faceOf(corner)};
    const int above_here = sideOf(*mesh_, here.face, mesh_surface::endAt(goal));
    if (beyond == Mesh::kNone) {
        if (above_here > 0) {
            return here;
        }
        // Falls off if the face does not lead closer, for example onto its own foot.
        const Facet facet = facetAt(corner);
        const double weight = facet.foot(goal).weights[0];
        const double error = facet.error(goal);
        const bool is_off = weight < -error || (weight <= error && above_here < 0);
        return is_off ? std::optional(here) : std::nullopt;
    }
    const Face there{Mesh::faceOf(beyond)};
    const int above_there = sideOf(*mesh_, there.face, mesh_surface::endAt(goal));
    if (above_here <= 0 && above_there <= 0) {
        return std::nullopt;
    }
    const Face over = above_here > 0 ? here : there;
    if (!isValley(corner)) {
        return over;
    }
    if (above_here <= 0 || above_there <= 0) {
        return std::nullopt;
    }
    const auto rises = [&](Index face) {
        const Vec3 normal = mesh_->normal(face);
        const Vec3 to_goal = goal.from(mesh_->vertex(mesh_->face(face)[0]));
        const double above = dot(normal, to_goal);
        return above > 0.0 && above * above > mesh_surface::kRiseMin * mesh_surface::kRiseMin *
                                                  dot(normal, normal) * dot(to_goal, to_goal);
    };
    return rises(here.face) && rises(there.face) ? std::optional(over) : std::nullopt;
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::castFrom(const Contact& contact,
                                      Face over,
                                      const Goal& goal) const noexcept -> Cast
{
    MeshStart<Index> start;
    const auto size_of = [this](Index face) {
        const auto [a, b, c] = mesh_->points(face);
        return std::sqrt(std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)}));
    };
    if (contact.feature == ContactFeature::Vertex) {
        start.base = mesh_->vertex(contact.vertex.index);
        start.skipped_vertex = contact.vertex.index;
    } else if (contact.feature == ContactFeature::Edge) {
        const auto [from, to] = ends(contact.edge);
        start.base = mesh_->vertex(from.index);
        const Index here = Mesh::faceOf(contact.edge.corner);
        const Index beyond = mesh_->across(contact.edge.corner);
        start.skipped_faces[0] = here;
        start.size_m = size_of(here);
        const Vec3 normal = normalized(mesh_->normal(here));
        Vec3 lift = normal;
        if (beyond != Mesh::kNone) {
            const Index there = Mesh::faceOf(beyond);
            start.skipped_faces[1] = there;
            start.size_m = std::max(start.size_m, size_of(there));
            const Vec3 other = normalized(mesh_->normal(there));
            // By the same amount above both, unless they fold onto each other.
            lift = (normal + other) * (1.0 / std::max(1.0 + dot(normal, other), 1e-6));
        }
        start.offset =
            between(from, to) * contact.along + lift * (mesh_surface::kLift * start.size_m);
    } else {
        const auto points = mesh_->points(over.face);
        start.base = points[0];
        start.skipped_faces[0] = over.face;
        start.size_m = size_of(over.face);
        const Vec3 a = points[1] - points[0];
        const Vec3 b = points[2] - points[0];
        start.offset = (a * contact.weights[1] + b * contact.weights[2]) +
                       normalized(cross(a, b)) * (mesh_surface::kLift * start.size_m);
    }
    const auto cast = castSegment(*mesh_, start, mesh_surface::endAt(goal));
    return {cast.hit ? std::optional(contactFrom(*cast.hit)) : std::nullopt, cast.faces};
}

template <typename Mesh>
auto BasicMeshSurface<Mesh>::castFree(const Goal& from, const Goal& to) const noexcept -> Cast
{
    const auto cast =
        castSegment(*mesh_, {.base = from.scene, .offset = from.rest}, mesh_surface::endAt(to));
    return {cast.hit ? std::optional(contactFrom(*cast.hit)) : std::nullopt, cast.faces};
}

} // namespace marsview
