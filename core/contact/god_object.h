// The god-object contact model (Zilles and Salisbury, "A constraint-based god-object method for
// haptic display", IROS 1995), as sections 2.2 and 2.3 of the MarsView paper describe it.
//
// Notation. p is the proxy, g the goal, n_i the unit normals of the active constraint planes, all
// of which hold p. The constrained goal is p + s where s is closest to g - p with n_i·s = 0. With
// Lagrange multipliers λ that is the linear system
//
//   | 1   N | | s |   | g - p |
//   | Nᵀ  0 | | λ | = |   0   |         N: a column for each of one, two or three planes.
//
// Eliminating λ leaves for s: g - p without its part along n_1 (one plane), its part along
// n_1 × n_2 (two), zero (three). That is how it is solved here.
#pragma once

#include "core/contact/border_walls.h"
#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/facet_steps.h"
#include "core/contact/surface_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

enum class GodObjectConstraints : std::uint8_t {
    /// Constraints last until the end of an update, at most three of them. The proxy may float
    /// beyond a ridge and stick in a valley (figure 4 of the paper), so that it lags behind fast
    /// goals.
    Kept,
    /// A constraint lasts as long as the proxy touches its triangle. Every update ends in a local
    /// minimum.
    Released,
};

/// A point that cannot pass through a surface. Within an update it moves straight to the goal, or
/// to the constrained goal, the point closest to the goal on the planes of the faces that stopped
/// it. Constraints end with the update: the next update begins with those of the faces that the
/// proxy then touches and that are in the way.
///
/// With constraints kept, an update may end off the surface and short of the goal. It is then
/// reported as in contact, with the feature that matches the constraints: a face for one plane, an
/// edge for two. In both modes, Free means that the proxy is at the goal.
///
/// With constraints released, each slide within a face or along a valley is followed by a separate
/// cast, as in the paper. On a mesh without intersecting faces the cast never hits; it is the cost
/// of an algorithm that does not rely on that, and the proxy graph saves it.
template <ContactSurface S>
class GodObject : public SurfaceProxy<GodObject<S>, S> {
    using Base = SurfaceProxy<GodObject, S>;
    friend Base;

public:
    /// The proxy begins at S::initialContact(); the first update places it.
    GodObject(S surface, GodObjectConstraints constraints) noexcept
        : Base(std::move(surface))
        , walls_(borderWalls(surface_))
        , constraints_(constraints)
        , contact_(surface_.initialContact())
    {}

    /// Another surface with the same mesh, such as another exaggeration. In contact, the proxy
    /// stays where it is on the mesh and moves with it; where it floats, it is put onto the surface
    /// straight above or below. A free proxy keeps its scene coordinates; if it would be below the
    /// surface, it is moved straight up onto it.
    void setSurface(S surface) noexcept
    {
        surface_ = std::move(surface);
        walls_ = borderWalls(surface_);
        if (off_) {
            off_ = surface_.goal(surface_.goalPoint(*off_));
            if (off_ && (held_by_ != ContactFeature::Free || !surface_.isAbove(*off_))) {
                contact_ = surface_.contactAt(*off_);
                off_.reset();
            }
        }
    }

    /// Where the proxy touches; empty while it is free or floats.
    std::optional<SurfaceContact<S>> contact() const noexcept
    {
        return off_ ? std::nullopt : std::optional(contact_);
    }

private:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Contact = SurfaceContact<S>;
    using Base::counters_;
    using Base::surface_;

    // A plane stops motion into it above this sine of the angle.
    static constexpr double kSineMin = 1e-9;
    static constexpr double kNormalError = 1e-12; // of the way to the goal
    static constexpr double kCoordinateError = 8.0 * std::numeric_limits<double>::epsilon();
    // This many steps without progress beyond rounding end an update: enough to turn around a
    // vertex.
    static constexpr int kStallsMax = 32;
    static constexpr int kKeptStallsMax = 4;

    void placeAt(const Goal& goal, const ScenePoint& /*aimed*/) noexcept
    {
        held_by_ = ContactFeature::Free;
        if (surface_.isAbove(goal)) {
            off_ = goal;
        } else {
            off_.reset();
            contact_ = surface_.contactAt(goal);
            minimise(goal);
        }
    }
    void moveTo(const Goal& goal, const ScenePoint& /*aimed*/) noexcept { minimise(goal); }

    ContactFeature feature() const noexcept { return off_ ? held_by_ : contact_.feature; }
    ScenePoint position() const noexcept
    {
        return off_ ? surface_.goalPoint(*off_) : surface_.point(contact_);
    }

    void take(const SurfaceCast<S>& cast, const Goal& goal) noexcept
    {
        ++counters_.casts;
        counters_.cells += cast.cells;
        if (cast.contact) {
            contact_ = *cast.contact;
            off_.reset();
        } else {
            off_ = goal;
        }
    }

    void minimise(const Goal& goal) noexcept
    {
        held_by_ = ContactFeature::Free;
        if (constraints_ == GodObjectConstraints::Kept) {
            keep(goal);
        } else {
            release(goal);
        }
    }

    // --- directions of the surface around a position

    // A direction on the surface, from a vertex: within a face, or along the edge to `end`.
    struct Way {
        double rate = -std::numeric_limits<double>::infinity(); // progress in the direction
        bool is_edge = true;
        Face face{};
        Vertex end{};
        double length_squared = 1.0; // of the edge
    };

    // The surface direction nearest to a given direction; it is the steepest descent if that leads
    // to the goal.
    template <typename Fan>
    Way nearestWay(const Fan& fan, const Vec3& direction) const noexcept
    {
        Way nearest;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double length_squared = dot(spoke.along, spoke.along);
            const double rate = dot(direction, spoke.along) / std::sqrt(length_squared);
            if (rate > nearest.rate) {
                nearest.rate = rate;
                nearest.end = spoke.end;
                nearest.length_squared = length_squared;
            }
        });
        surface_.eachSector(fan, [&](const Face& face, const SurfaceSpoke<S>& a,
                                     const SurfaceSpoke<S>& b) {
            const Vec3 normal = cross(a.along, b.along);
            if (dot(cross(direction, b.along), normal) <= 0.0 ||
                dot(cross(a.along, direction), normal) <= 0.0) {
                return;
            }
            const double up = dot(direction, normal);
            const double rate =
                std::sqrt(std::max(dot(direction, direction) - up * up / dot(normal, normal), 0.0));
            if (rate > nearest.rate) {
                nearest.rate = rate;
                nearest.is_edge = false;
                nearest.face = face;
            }
        });
        return nearest;
    }

    Vec3 normalOf(const Face& face) const noexcept
    {
        const auto corners = surface_.corners(face);
        return normalized(cross(surface_.between(corners[0], corners[1]),
                                surface_.between(corners[0], corners[2])));
    }

    struct Side {
        Face face;
        Vec3 normal;
    };

    // The face below a direction. It blocks the direction if that leads below its plane; otherwise
    // the path leaves over it.
    Side sideUnder(const Vec3& direction) const noexcept
    {
        if (contact_.feature == ContactFeature::Face) {
            return {contact_.face, normalOf(contact_.face)};
        }
        Edge edge = contact_.edge;
        if (contact_.feature == ContactFeature::Vertex) {
            const Way way = nearestWay(surface_.fan(contact_.vertex), direction);
            if (!way.is_edge) {
                return {way.face, normalOf(way.face)};
            }
            edge = surface_.edgeBetween(contact_.vertex, way.end);
        }
        const auto [from, to] = surface_.ends(edge);
        const Vec3 along = surface_.between(from, to);
        std::array<Side, 2> sides{};
        std::array<Vec3, 2> inward{}; // across the face, from the edge
        std::size_t count = 0;
        double rise = 0.0; // of the second face above the plane of the first
        for (const auto& wing : surface_.wings(edge)) {
            if (!wing) {
                continue;
            }
            const Vertex corner =
                surface_.corners(wing->face)[static_cast<std::size_t>(wing->corner)];
            const Vec3 to_corner = surface_.between(from, corner);
            sides[count] = {wing->face, normalOf(wing->face)};
            inward[count] = cross(sides[count].normal, along);
            if (dot(inward[count], to_corner) < 0.0) {
                inward[count] = -inward[count];
            }
            rise = dot(sides[0].normal, to_corner);
            ++count;
        }
        if (count == 1) {
            return sides[0];
        }
        // In a valley the face that blocks more, on a ridge the nearer one.
        const bool is_second =
            rise > 0.0 ? dot(sides[1].normal, direction) < dot(sides[0].normal, direction)
                       : dot(inward[1], direction) > dot(inward[0], direction);
        return sides[is_second ? 1 : 0];
    }

    // Of the touched faces, the one that blocks the direction most.
    std::optional<Side> sideAgainst(const Vec3& direction) const noexcept
    {
        std::optional<Side> most;
        double against = kSineMin * length(direction);
        const auto look = [&](const Face& face) {
            const Vec3 normal = normalOf(face);
            if (-dot(normal, direction) > against) {
                against = -dot(normal, direction);
                most = Side{face, normal};
            }
        };
        if (contact_.feature == ContactFeature::Face) {
            look(contact_.face);
        } else if (contact_.feature == ContactFeature::Edge) {
            for (const auto& wing : surface_.wings(contact_.edge)) {
                if (wing) {
                    look(wing->face);
                }
            }
        } else {
            surface_.eachSector(surface_.fan(contact_.vertex),
                                [&](const Face& face, const SurfaceSpoke<S>&,
                                    const SurfaceSpoke<S>&) { look(face); });
        }
        return most;
    }

    // --- constraints kept

    struct Planes {
        std::array<Vec3, 3> normals;
        std::size_t count = 0;

        // s of the notation above.
        Vec3 constrained(const Vec3& to_goal) const noexcept
        {
            if (count == 0) {
                return to_goal;
            }
            if (count == 1) {
                // Twice, or the remainder of a steep path keeps a component along the normal.
                const Vec3 once = to_goal - normals[0] * dot(normals[0], to_goal);
                return once - normals[0] * dot(normals[0], once);
            }
            if (count == 2) {
                const Vec3 line = normalized(cross(normals[0], normals[1]));
                return line * dot(line, to_goal);
            }
            return {};
        }
        void add(const Vec3& normal) noexcept { normals[count++] = normal; }
    };

    void keep(const Goal& goal) noexcept
    {
        Planes planes;
        int stalls = 0;
        bool is_done = false;
        // Where faces are coplanar up to rounding, as between the samples of coarse terrain, each
        // step may be tiny: across the largest maps the steps would take seconds.
        const double way = length(surface_.goalPoint(goal) - position());
        for (std::uint32_t steps = surface_.stepsAlong(way); steps > 0 && !is_done; --steps) {
            is_done = planes.count == 3 || stalls > kKeptStallsMax || advance(goal, planes, stalls);
        }
        counters_.cut_short = is_done ? 0 : 1;
        if (off_ && planes.count > 0) {
            held_by_ = planes.count == 1   ? ContactFeature::Face
                       : planes.count == 2 ? ContactFeature::Edge
                                           : ContactFeature::Vertex;
        }
    }

    // One iteration of the algorithm of section 2.3: a move towards the constrained goal, or one
    // more constraint. True if the constrained goal is reached.
    bool advance(const Goal& goal, Planes& planes, int& stalls) noexcept
    {
        const ScenePoint end = surface_.goalPoint(goal);
        const ScenePoint here = position();
        const Vec3 step = planes.constrained(end - here);
        const double size = length(step);
        // Only the errors of the normals and of the coordinates may remain.
        const double error =
            kNormalError * length(end - here) +
            kCoordinateError * (std::abs(here.x) + std::abs(here.y) + std::abs(here.z));
        if (size <= error) {
            return true;
        }
        std::optional<Side> under;
        if (!off_) {
            under = sideUnder(step);
            if (dot(under->normal, step) < -kSineMin * size) {
                ++counters_.faces;
                planes.add(under->normal);
                return false;
            }
            if (planes.count == 2 && slideAlongEdge(step)) {
                return false;
            }
        }
        // The border of the map counts as a face.
        double share = 1.0;
        const BorderWall* wall = nullptr;
        for (const BorderWall& each : walls_) {
            const double into = -dot(each.normal, step);
            if (into > kSineMin * size && each.distance(here) < share * into) {
                share = std::max(each.distance(here), 0.0) / into;
                wall = &each;
            }
        }
        if (wall != nullptr && share * size <= walls_.tolerance_m) {
            planes.add(wall->normal);
            return false;
        }
        const auto target = planes.count == 0 && wall == nullptr
                                ? std::optional(goal)
                                : surface_.goal(here + step * share);
        if (!target) {
            return true;
        }
        if (under) {
            take(surface_.castFrom(contact_, under->face, *target), *target);
        } else {
            const Goal from = *off_;
            take(surface_.castFree(from, *target), *target);
        }
        if (off_) {
            if (wall != nullptr) {
                planes.add(wall->normal);
                return false;
            }
            if (under && planes.count == 1) {
                settle(under->face, goal);
            }
            return true;
        }
        const Vec3 moved = position() - here;
        if (under && length(moved) <= kNormalError * size) {
            // Something blocks from the start although it is not nearest, as faces at a vertex may.
            // Or it is rounding, and the next iteration begins from the face that was hit.
            if (const auto side = sideAgainst(step)) {
                ++counters_.faces;
                planes.add(side->normal);
            } else {
                ++stalls;
            }
        }
        return false;
    }

    // Along the line of the planes if that is an edge of the mesh; rounding would stray from it.
    // False if it is not.
    bool slideAlongEdge(const Vec3& step) noexcept
    {
        if (contact_.feature != ContactFeature::Edge) {
            return false;
        }
        const auto [from, to] = surface_.ends(contact_.edge);
        const Vec3 edge = surface_.between(from, to);
        const Vec3 across = cross(edge, step);
        const double length_squared = dot(edge, edge);
        if (dot(across, across) > kSineMin * kSineMin * length_squared * dot(step, step)) {
            return false;
        }
        Contact end = contact_;
        end.along += dot(step, edge) / length_squared;
        if (!(end.along > 0.0 && end.along < 1.0)) {
            end.feature = ContactFeature::Vertex;
            end.vertex = end.along > 0.5 ? to : from;
        }
        const auto wings = surface_.wings(contact_.edge);
        const ScenePoint here = surface_.point(contact_);
        slide(wings[0] ? wings[0]->face : wings[1]->face, end);
        const Vec3 moved = surface_.point(contact_) - here;
        return dot(moved, moved) > 1e-24 * dot(step, step);
    }

    // Puts a slide that ended above the face only by rounding onto that face.
    void settle(const Face& face, const Goal& goal) noexcept
    {
        const auto foot = footOn(face, goal);
        if (foot.isInside()) {
            contact_ = contactOnFace(surface_, face, foot.weights);
            off_.reset();
        }
    }

    // --- constraints released

    struct Foot {
        std::array<double, 3> weights; // of the corners; negative: beyond the edge opposite
        double scale;

        bool isInside() const noexcept
        {
            return weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
        }
    };

    Foot footOn(const Face& face, const Goal& goal) const noexcept
    {
        const auto facet = surface_.facet(face, 0);
        const SurfaceFoot scaled = facet.foot(goal);
        const double error = std::max(kEdgeShareMin, facet.error(goal) / facet.scale);
        Foot foot{};
        foot.scale = facet.scale;
        for (std::size_t i = 0; i < 3; ++i) {
            const double weight = scaled.weights[i] / facet.scale;
            foot.weights[i] = std::abs(weight) <= error ? 0.0 : weight;
        }
        return foot;
    }

    // Ends an update when the distance stops decreasing.
    struct Progress {
        double distance_squared = std::numeric_limits<double>::infinity();
        ScenePoint point;
        Vec3 rest;
        int stalls = 0;

        bool hasStalled(const ScenePoint& now, const Vec3& now_rest) noexcept
        {
            const double squared = dot(now_rest, now_rest);
            const Vec3 step = now - std::exchange(point, now);
            const Vec3 towards = now_rest + std::exchange(rest, now_rest);
            if (squared < distance_squared * (1.0 - 1e-15)) {
                distance_squared = squared;
                stalls = 0;
                return false;
            }
            // For a far goal the squared distances are equal everywhere; the step from the last
            // position is not.
            const double rounding =
                kCoordinateError * (std::abs(now.x) + std::abs(now.y) + std::abs(now.z));
            return !(dot(step, towards) > rounding * length(towards)) && ++stalls > kStallsMax;
        }
    };

    void release(const Goal& goal) noexcept
    {
        if (off_) {
            const Goal from = *off_;
            take(surface_.castFree(from, goal), goal);
        }
        Progress progress;
        for (std::uint32_t steps = surface_.stepsMax(); steps > 0; --steps) {
            if (off_) {
                return;
            }
            const bool is_done = contact_.feature == ContactFeature::Vertex ? leaveVertex(goal)
                                 : contact_.feature == ContactFeature::Edge ? leaveEdge(goal)
                                                                            : leaveFace(goal);
            if (is_done) {
                return;
            }
            if (!off_) {
                const ScenePoint here = surface_.point(contact_);
                if (progress.hasStalled(here, surface_.goalPoint(goal) - here)) {
                    return;
                }
            }
        }
        counters_.cut_short = 1;
    }

    // Removes the constraints if the path to the goal is free.
    bool leaves(const std::optional<Face>& over, const Goal& goal) noexcept
    {
        if (over) {
            take(surface_.castFrom(contact_, *over, goal), goal);
        }
        return over.has_value();
    }

    // Slides to `end` of the same face, along its plane.
    void slide(const Face& face, const Contact& end) noexcept
    {
        if (const auto target = surface_.goal(surface_.point(end))) {
            const SurfaceCast<S> cast = surface_.castFrom(contact_, face, *target);
            ++counters_.casts;
            counters_.cells += cast.cells;
        }
        contact_ = end;
    }

    // Each of these takes one step and returns whether the update is complete.

    // One constraint: to its foot, or to the border of the face. `weights` are those of the proxy.
    bool slideOn(const Face& face, const std::array<double, 3>& weights, const Foot& foot) noexcept
    {
        ++counters_.faces;
        if (foot.isInside()) {
            slide(face, contactOnFace(surface_, face, foot.weights));
            // On its border another face or edge may lead on.
            return contact_.feature == ContactFeature::Face;
        }
        double share = std::numeric_limits<double>::infinity();
        std::size_t corner = 0; // opposite the edge through which the foot lies outside
        for (std::size_t i = 0; i < 3; ++i) {
            if (foot.weights[i] < 0.0) {
                const double at = weights[i] / (weights[i] - foot.weights[i]);
                if (at < share) {
                    share = at;
                    corner = i;
                }
            }
        }
        const std::size_t j = (corner + 1) % 3;
        const std::size_t k = (corner + 2) % 3;
        const double weight_j = weights[j] + share * (foot.weights[j] - weights[j]);
        const double weight_k = weights[k] + share * (foot.weights[k] - weights[k]);
        std::array<double, 3> end{};
        end[j] = std::clamp(weight_j / (weight_j + weight_k), 0.0, 1.0);
        end[k] = 1.0 - end[j];
        slide(face, contactOnFace(surface_, face, end));
        return false;
    }

    bool leaveFace(const Goal& goal) noexcept
    {
        if (leaves(surface_.wayOut(contact_, goal), goal)) {
            return false;
        }
        return slideOn(contact_.face, contact_.weights, footOn(contact_.face, goal));
    }

    bool leaveEdge(const Goal& goal) noexcept
    {
        if (leaves(surface_.wayOut(contact_, goal), goal)) {
            return false;
        }
        // A foot on the inner side of a face means that the way into it leads closer: the same
        // number decides within that face whether its foot is outside.
        const auto [from, to] = surface_.ends(contact_.edge);
        std::optional<SurfaceWing<S>> into;
        std::optional<SurfaceWing<S>> any;
        Foot foot{};
        double steepest = 0.0;
        for (const auto& wing : surface_.wings(contact_.edge)) {
            if (!wing) {
                continue;
            }
            any = wing;
            const Foot candidate = footOn(wing->face, goal);
            const double weight = candidate.weights[static_cast<std::size_t>(wing->corner)];
            const double descent_squared = weight * weight * candidate.scale;
            if (weight > 0.0 && descent_squared > steepest) {
                steepest = descent_squared;
                into = wing;
                foot = candidate;
            }
        }
        if (into) {
            const auto corners = surface_.corners(into->face);
            const auto corner = static_cast<std::size_t>(into->corner);
            std::array<double, 3> weights{};
            weights[(corner + 1) % 3] =
                corners[(corner + 1) % 3] == from ? 1.0 - contact_.along : contact_.along;
            weights[(corner + 2) % 3] = 1.0 - weights[(corner + 1) % 3];
            return slideOn(into->face, weights, foot);
        }
        // Two constraints, along their line.
        ++counters_.faces;
        const Vec3 edge = surface_.between(from, to);
        const Vec3 to_goal = surface_.toGoal(from, goal);
        const double length_squared = dot(edge, edge);
        const double along = dot(to_goal, edge) / length_squared;
        const double slack =
            0.5 * std::max(kEdgeShareMin,
                           kEdgeCosineMin * std::sqrt(dot(to_goal, to_goal) / length_squared));
        Contact end = contact_;
        end.along = along;
        if (!(along > slack && along < 1.0 - slack)) {
            end.feature = ContactFeature::Vertex;
            end.vertex = along > 0.5 ? to : from;
        }
        slide(any->face, end);
        // The next feature after an edge depends on the goal alone, not on the position on the
        // edge.
        return end.feature == ContactFeature::Edge;
    }

    bool leaveVertex(const Goal& goal) noexcept
    {
        ++counters_.vertices;
        const Vertex here = contact_.vertex;
        const auto fan = surface_.fan(here);
        if (leaves(surface_.wayOut(fan, goal), goal)) {
            return false;
        }
        const Vec3 to_goal = surface_.toGoal(fan, goal);
        const Way way = nearestWay(fan, to_goal);
        if (!way.is_edge) {
            const Foot foot = footOn(way.face, goal);
            const auto corners = surface_.corners(way.face);
            std::array<double, 3> weights{};
            std::size_t at = 0;
            while (at < 2 && !(corners[at] == here)) {
                ++at;
            }
            weights[at] = 1.0;
            const double one = foot.weights[(at + 1) % 3];
            const double other = foot.weights[(at + 2) % 3];
            if (one > 0.0 && other > 0.0) {
                return slideOn(way.face, weights, foot);
            }
            if (one <= 0.0 && other <= 0.0) {
                return true; // only by rounding
            }
            return startAlong(here, corners[(at + (one > 0.0 ? 1 : 2)) % 3]);
        }
        if (way.rate * way.rate > kEdgeCosineMin * kEdgeCosineMin * dot(to_goal, to_goal) &&
            way.rate > kEdgeShareMin * std::sqrt(way.length_squared)) {
            return startAlong(here, way.end);
        }
        return true;
    }

    // The next feature is the same all along the edge.
    bool startAlong(const Vertex& here, const Vertex& end) noexcept
    {
        contact_.feature = ContactFeature::Edge;
        contact_.edge = surface_.edgeBetween(here, end);
        contact_.along = surface_.ends(contact_.edge)[0] == here ? 0.0 : 1.0;
        return false;
    }

    BorderWalls walls_;
    GodObjectConstraints constraints_;
    std::optional<Goal> off_;                       // the proxy's position while it does not touch
    Contact contact_;                               // the proxy's position otherwise
    ContactFeature held_by_ = ContactFeature::Free; // the feature that meanwhile keeps it from the
                                                    // goal
};

} // namespace marsview
