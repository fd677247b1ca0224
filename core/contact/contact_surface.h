// The interface of a surface for contact models: a seamless triangle mesh and a segment cast.
//
// Models are templates over this concept, so that the heightfield, whose mesh is implied by its
// samples, and any other mesh share them and the inner loops stay inlined. All of it is called from
// the servo thread: nothing here may allocate, lock, throw or loop without a bound.
//
//     const HeightfieldSurface surface(filled, frame, exaggeration); // a map in memory
//     ContinuousWalk walk(surface);
//     walk.place(goal);
//     const ContactState contact = walk.update(next_goal);
#pragma once

#include "core/base/vec.h"
#include "core/contact/contact.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>

namespace marsview {

/// A position on the surface, stored as a feature and the position on it, so that no drift can push
/// it through: its coordinates are computed from the mesh on every request. Only the fields that
/// belong to the feature are meaningful.
template <typename S>
struct SurfaceContact {
    ContactFeature feature = ContactFeature::Vertex; // never Free
    typename S::Vertex vertex{};
    typename S::Edge edge{};
    double along = 0.0; // 0 at the edge's first end, 1 at its second
    typename S::Face face{};
    std::array<double, 3> weights{}; // of the face's corners; >= 0, sum 1
};

/// An edge seen from one of its ends.
template <typename S>
struct SurfaceSpoke {
    typename S::Vertex end;
    Vec3 along; // from here to `end`, in scene meters
};

/// The goal's foot on the plane of a facet (equation 2 of the paper) and the side of the plane on
/// which the goal is. All of it is linear in the goal, with coefficients that depend only on the
/// face: a condition that holds at two goals holds at every goal between them.
struct SurfaceFoot {
    /// Of the face's corners, times the facet's `scale`; their sum is `scale`. Negative: the foot
    /// lies beyond the edge opposite the corner.
    std::array<double, 3> weights;
    /// Positive: the goal is in front of the plane, in free space; the distance from it in meters,
    /// times a factor that depends on the face.
    double above;

    bool isInside() const noexcept
    {
        return weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
    }
};

/// A face seen from one of its edges.
template <typename S>
struct SurfaceWing {
    typename S::Face face;
    int corner; // opposite the edge
};

/// The one or two faces of an edge, each with the corner opposite the edge first.
template <typename S>
struct SurfaceEdgeFacets {
    typename S::Facet left{};
    typename S::Facet right{}; // if has_right
    bool has_right = false;
};

/// The first hit of a segment through free space.
template <typename S>
struct SurfaceCast {
    std::optional<SurfaceContact<S>> contact; // empty: the goal was reached
    std::uint32_t cells = 0;
};

/// The straight legs of the goal's path to its end.
template <typename S>
struct SurfaceLegs {
    static constexpr std::size_t kLegsMax = 5;
    std::array<typename S::Goal, kLegsMax> ends;
    std::size_t count = 0;
};

/// The mesh: vertices, edges and faces are small values. Vectors are in scene meters. A facet is
/// the face that a walk is on, with the data that the walk needs, read once:
///   vertices           its corners, counter-clockwise seen from free space
///   foot(g), scale     the foot of the goal on its plane; `scale` > 0 is the square of the face's
///                      area times a factor that is the same for all faces
///   error(g)           a weight of that foot below this is rounding error
///
///   kIsBorderWall      whether goals are clamped to above and below the mesh, so that its border
///   stops
///                      the proxy; otherwise it falls off there
///   goal(p)            the goal that models use for the point p; empty if p cannot be used
///   goalPoint(g)       the position of that goal
///   isAbove(g)         whether the goal is in free space
///   contactAt(g)       the position on the surface where a model placed at g begins
///   initialContact()   where a model begins without a goal
///   point(c)           the coordinates of a position on the surface
///   toGoal(v, g)       from a vertex to the goal
///   between(a, b)      from one vertex to another of the same face
///   toGoal(t, i, g), between(t, i, j)  the same from corner i of a facet
///   corners(f)         three vertices, counter-clockwise seen from free space
///   facet(f, i)        the face for walking, its corner i (0 to 2) first
///   faceOf(t)          the face of a facet
///   edgeFacets(e)      the facets of an edge
///   hasBeyond(t, i)    whether there is a face beyond the edge opposite corner i of a facet
///   beyond(t, i)       that face, if any; its first corner is opposite that edge, so that its
///                      second is corner i + 2 of the other
///   bend(t, i, b)      how the surface bends there, where b is beyond(t, i). Positive: a valley,
///                      free space fills less than half the angle around the edge; 0: flat, to
///                      rounding; negative: a ridge
///   ends(e)            the two vertices of an edge, in its order
///   edgeBetween(a, b)  the edge between two vertices of a face
///   wings(e)           the one or two faces of an edge
///   fan(v)             the neighborhood of a vertex, read once
///   eachSpoke(fan, fn) calls fn with each edge of a vertex, in a fixed order
///   eachSector(fan, fn) calls fn(f, a, b) with each face of a vertex and its two spokes
///   wayOut(c, g)       the adjacent face over which the straight path from a position on the
///   surface
///                      to the goal leaves the surface; empty if an adjacent face is in the way. A
///                      path that leaves by less than rounding error does not count as leaving
///   castFrom(c, f, g)  follows that path
///   castFree(p, g)     the same from a goal reached earlier, which was above the surface
///   along(g, h, t)     the goal at the fraction t of the straight path from g to h; g and h
///   exactly at
///                      0 and 1
///   legs(p, q)         how the goal moves while the aimed-at point moves straight from p to q,
///   both
///                      of which must be valid: the ends of at most kLegsMax straight legs, the
///                      last of which is goal(q)
///   stepsMax()         the step limit of an update, in features; several times the number of steps
///                      that cross the whole mesh
///   stepsAlong(w)      the same for a path of w scene meters; at most stepsMax()
// clang-format off: version 14 puts every token of a compound requirement on its own line.
template <typename S>
concept ContactSurface = requires(const S& s,
                                  const typename S::Goal& g,
                                  typename S::Vertex v,
                                  typename S::Edge e,
                                  typename S::Face f,
                                  const typename S::Fan& fan,
                                  const typename S::Facet& facet,
                                  const SurfaceContact<S>& c,
                                  const ScenePoint& p)
{
    requires std::equality_comparable<typename S::Vertex>;
    {
        s.goal(p)
    }
    noexcept->std::same_as<std::optional<typename S::Goal>>;
    {
        s.goalPoint(g)
    }
    noexcept->std::same_as<ScenePoint>;
    {
        s.isAbove(g)
    }
    noexcept->std::same_as<bool>;
    {
        s.contactAt(g)
    }
    noexcept->std::same_as<SurfaceContact<S>>;
    {
        s.initialContact()
    }
    noexcept->std::same_as<SurfaceContact<S>>;
    {
        s.point(c)
    }
    noexcept->std::same_as<ScenePoint>;
    {
        s.toGoal(v, g)
    }
    noexcept->std::same_as<Vec3>;
    {
        s.between(v, v)
    }
    noexcept->std::same_as<Vec3>;
    {
        s.toGoal(facet, std::size_t{0}, g)
    }
    noexcept->std::same_as<Vec3>;
    {
        s.between(facet, std::size_t{0}, std::size_t{0})
    }
    noexcept->std::same_as<Vec3>;
    {
        s.corners(f)
    }
    noexcept->std::same_as<std::array<typename S::Vertex, 3>>;
    {
        s.facet(f, std::size_t{0})
    }
    noexcept->std::same_as<typename S::Facet>;
    {
        s.faceOf(facet)
    }
    noexcept->std::same_as<typename S::Face>;
    {
        s.beyond(facet, std::size_t{0})
    }
    noexcept->std::same_as<typename S::Facet>;
    {
        s.edgeFacets(e)
    }
    noexcept->std::same_as<SurfaceEdgeFacets<S>>;
    {
        s.hasBeyond(facet, std::size_t{0})
    }
    noexcept->std::same_as<bool>;
    {
        s.bend(facet, std::size_t{0}, facet)
    }
    noexcept->std::same_as<int>;
    {
        facet.vertices
        } -> std::convertible_to<std::array<typename S::Vertex, 3>>;
    {
        facet.scale
        } -> std::convertible_to<double>;
    {
        facet.foot(g)
    }
    noexcept->std::same_as<SurfaceFoot>;
    {
        facet.error(g)
    }
    noexcept->std::same_as<double>;
    {
        s.along(g, g, 0.5)
    }
    noexcept->std::same_as<typename S::Goal>;
    {
        s.legs(p, p)
    }
    noexcept->std::same_as<SurfaceLegs<S>>;
    {
        S::kIsBorderWall
        } -> std::convertible_to<bool>;
    {
        s.ends(e)
    }
    noexcept->std::same_as<std::array<typename S::Vertex, 2>>;
    {
        s.edgeBetween(v, v)
    }
    noexcept->std::same_as<typename S::Edge>;
    {
        s.wings(e)
    }
    noexcept->std::same_as<std::array<std::optional<SurfaceWing<S>>, 2>>;
    {
        s.fan(v)
    }
    noexcept->std::same_as<typename S::Fan>;
    {
        s.toGoal(fan, g)
    }
    noexcept->std::same_as<Vec3>;
    {
        s.eachSpoke(fan, [](const SurfaceSpoke<S>&) {})
    }
    noexcept;
    {
        s.eachSector(fan,
                     [](const typename S::Face&, const SurfaceSpoke<S>&, const SurfaceSpoke<S>&) {})
    }
    noexcept;
    {
        s.wayOut(fan, g)
    }
    noexcept->std::same_as<std::optional<typename S::Face>>;
    {
        s.wayOut(c, g)
    }
    noexcept->std::same_as<std::optional<typename S::Face>>;
    {
        s.castFrom(c, f, g)
    }
    noexcept->std::same_as<SurfaceCast<S>>;
    {
        s.castFree(g, g)
    }
    noexcept->std::same_as<SurfaceCast<S>>;
    {
        s.stepsMax()
    }
    noexcept->std::same_as<std::uint32_t>;
};
// clang-format on

/// Reduces a position within a face to its actual feature: one zero weight makes it an edge, two
/// make it a vertex.
template <typename S>
SurfaceContact<S> contactOnFace(const S& surface,
                                typename S::Face face,
                                const std::array<double, 3>& weights) noexcept
{
    SurfaceContact<S> contact;
    const auto corners = surface.corners(face);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        if (weights[i] == 0.0) {
            if (weights[j] == 0.0 || weights[k] == 0.0) {
                contact.feature = ContactFeature::Vertex;
                contact.vertex = corners[weights[j] == 0.0 ? k : j];
                return contact;
            }
            contact.feature = ContactFeature::Edge;
            contact.edge = surface.edgeBetween(corners[j], corners[k]);
            const bool ends_at_k = surface.ends(contact.edge)[1] == corners[k];
            contact.along = weights[ends_at_k ? k : j] / (weights[j] + weights[k]);
            return contact;
        }
    }
    contact.feature = ContactFeature::Face;
    contact.face = face;
    contact.weights = weights;
    return contact;
}

} // namespace marsview
