// Steepest descent from a position on the surface to a local minimum of the distance to a fixed
// goal.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/facet_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace marsview {

/// Follows the gradient of the distance to the goal over faces, along edges and through vertices,
/// exactly and by adjacency: straight across a face towards the foot of the goal on its plane;
/// along an edge where both faces lead towards it (a valley); from a vertex in the steepest of all
/// directions, along its edges and within its faces. Where the straight path to the goal leaves the
/// surface, the descent follows it through free space with a segment cast. The distance never
/// increases.
///
/// A helper for one update of a model: cheap to construct. Real-time: allocates nothing and is
/// bounded by S::stepsMax(); reaching the bound is counted as cut_short.
template <ContactSurface S>
class SteepestDescent {
public:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Facet = typename S::Facet;
    using Contact = SurfaceContact<S>;

    SteepestDescent(const S& surface, ContactCounters& counters) noexcept
        : surface_(surface)
        , counters_(counters)
        , steps_(surface.stepsMax())
    {}

    /// Moves `contact` to a local minimum. True if the descent ended at the goal itself, in free
    /// space; the contact is then meaningless.
    bool descend(Contact& contact, const Goal& goal) noexcept
    {
        const bool is_free = run(contact, goal, Step::Goes);
        if (facet_) {
            contact = Steps::contactOn(surface_, *facet_, foot_);
        }
        return is_free;
    }

    /// The same, beginning with a walk over `facet` from its edge opposite its first corner, at the
    /// fraction `share` from its second corner to its third. If the minimum is within a face,
    /// facet() returns that face and `contact` is meaningless.
    bool descendOver(Contact& contact, const Facet& facet, double share, const Goal& goal) noexcept
    {
        const SurfaceFoot foot = facet.foot(goal);
        if (foot.above <= 0.0) {
            return run(contact, goal, cross(contact, facet, share, foot, goal));
        }
        // Over a sharp ridge, the proxy may leave the surface.
        Steps::restOnEdge(surface_, contact, facet.vertices[1], facet.vertices[2], share);
        return run(contact, goal, Step::Goes);
    }
    const std::optional<Facet>& facet() const noexcept { return facet_; }

private:
    using Steps = FacetSteps<S>;

    enum class Step : std::uint8_t {
        Goes, // the contact is where the next step begins
        Ends, // it is a local minimum
        Free, // the goal was reached through free space
    };

    // After this many visits of vertices that are not closer to the goal than the one before, to
    // rounding, the last of them counts as a minimum.
    static constexpr int kStallsMax = 8;

    bool run(Contact& contact, const Goal& goal, Step step) noexcept
    {
        while (step == Step::Goes) {
            if (steps_ == 0) {
                counters_.cut_short = 1;
                return false;
            }
            --steps_;
            switch (contact.feature) {
            case ContactFeature::Vertex:
                step = fromVertex(contact, goal);
                break;
            case ContactFeature::Edge:
                step = fromEdge(contact, goal);
                break;
            default:
                step = fromFace(contact, goal);
                break;
            }
        }
        return step == Step::Free;
    }

    Step fly(Contact& contact, Face over, const Goal& goal) noexcept
    {
        ++counters_.casts;
        const SurfaceCast<S> cast = surface_.castFrom(contact, over, goal);
        counters_.cells += cast.cells;
        if (!cast.contact) {
            return Step::Free;
        }
        contact = *cast.contact;
        // For a goal above the surface only by rounding, the descent would leave and meet the
        // surface forever.
        const ScenePoint rest = surface_.goalPoint(goal) - surface_.point(contact);
        const double squared = dot(rest, rest);
        if (squared >= flight_squared_ * (1.0 - 1e-15) && ++stalls_ > kStallsMax) {
            return Step::Ends;
        }
        flight_squared_ = squared;
        return Step::Goes;
    }

    Step fromVertex(Contact& contact, const Goal& goal) noexcept
    {
        ++counters_.vertices;
        const Vertex here = contact.vertex;
        const auto fan = surface_.fan(here);
        if (const auto over = surface_.wayOut(fan, goal)) {
            return fly(contact, *over, goal);
        }
        const Vec3 to_goal = surface_.toGoal(fan, goal);
        const double squared = dot(to_goal, to_goal);
        // For a far goal the squared distances are equal at every vertex; the step from the last is
        // not.
        if (squared >= vertex_squared_ * (1.0 - 1e-15) && !isCloser(here, to_goal) &&
            ++stalls_ > kStallsMax) {
            return Step::Ends;
        }
        vertex_squared_ = squared;
        vertex_ = here;
        vertex_to_goal_ = to_goal;

        const auto steepest = Steps::steepestSpoke(surface_, fan, to_goal, squared);
        if (!steepest.pulls) {
            // Within a face, no direction leads closer if neither of its edges does.
            return Step::Ends;
        }
        // The squared rates of decrease of the distance, times `squared`.
        double best_rate = steepest.towards > 0.0
                               ? steepest.towards * steepest.towards / steepest.length_squared
                               : 1e-26 * squared;
        std::optional<Face> into;
        surface_.eachSector(
            fan, [&](const Face& face, const SurfaceSpoke<S>& a, const SurfaceSpoke<S>& b) {
                const double ga = dot(to_goal, a.along);
                const double gb = dot(to_goal, b.along);
                if (ga <= 0.0 && gb <= 0.0) {
                    return;
                }
                const double aa = dot(a.along, a.along);
                const double bb = dot(b.along, b.along);
                const double ab = dot(a.along, b.along);
                const double weight_a = ga * bb - gb * ab;
                const double weight_b = gb * aa - ga * ab;
                const double area_squared = aa * bb - ab * ab;
                if (weight_a > 0.0 && weight_b > 0.0 && area_squared > 0.0) {
                    const double rate = (ga * weight_a + gb * weight_b) / area_squared;
                    if (rate > best_rate) {
                        best_rate = rate;
                        into = face;
                    }
                }
            });
        if (into) {
            // On steep faces the products above cancel: the plane decides.
            const auto corners = surface_.corners(*into);
            const std::size_t at = corners[0] == here ? 0 : corners[1] == here ? 1 : 2;
            const Facet facet = surface_.facet(*into, at);
            const SurfaceFoot foot = facet.foot(goal);
            if (foot.weights[1] > 0.0 && foot.weights[2] > 0.0) {
                return walk(contact, facet, {1.0, 0.0, 0.0}, foot, goal);
            }
        }
        if (!(steepest.towards > 0.0)) {
            return Step::Ends;
        }
        // Along an edge that no face leads away from.
        const double share = steepest.towards / steepest.length_squared;
        if (share >= 1.0 - Steps::endShare(squared, steepest.length_squared)) {
            Steps::restOnVertex(contact, steepest.spoke.end);
        } else {
            Steps::restOnEdge(surface_, contact, here, steepest.spoke.end, share);
        }
        return Step::Goes; // rounding may have hidden that a face leads closer
    }

    // Whether a vertex is closer to the goal than the last one.
    bool isCloser(Vertex vertex, const Vec3& to_goal) const noexcept
    {
        const auto point_of = [this](Vertex of) {
            Contact at;
            Steps::restOnVertex(at, of);
            return surface_.point(at);
        };
        return dot(point_of(vertex) - point_of(vertex_), vertex_to_goal_ + to_goal) > 0.0;
    }

    Step fromEdge(Contact& contact, const Goal& goal) noexcept
    {
        const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(contact.edge);
        const SurfaceFoot left = facets.left.foot(goal);
        const SurfaceFoot right = facets.has_right ? facets.right.foot(goal) : SurfaceFoot{};
        if (left.above > 0.0 || right.above > 0.0 || !facets.has_right) {
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        // A foot on the inner side of a face means that the way into it leads closer: the same
        // number decides within that face whether its foot is outside. The steeper path is taken.
        const auto [from, to] = surface_.ends(contact.edge);
        const bool is_left = Steps::isInward(left.weights[0], facets.left, goal);
        const bool is_right =
            facets.has_right && Steps::isInward(right.weights[0], facets.right, goal) &&
            !(is_left && left.weights[0] * left.weights[0] * facets.right.scale >=
                             right.weights[0] * right.weights[0] * facets.left.scale);
        if (is_right || is_left) {
            const Facet& into = is_right ? facets.right : facets.left;
            const double share = into.vertices[1] == from ? contact.along : 1.0 - contact.along;
            return cross(contact, into, share, is_right ? right : left, goal);
        }
        const Vec3 edge = surface_.between(from, to);
        const Vec3 to_goal = surface_.toGoal(from, goal);
        const double length_squared = dot(edge, edge);
        const double along = dot(to_goal, edge) / length_squared;
        const double least = Steps::endShare(dot(to_goal, to_goal), length_squared);
        if (along > least && along < 1.0 - least) {
            contact.along = along;
            return Step::Ends;
        }
        Steps::restOnVertex(contact, along > 0.5 ? to : from);
        return Step::Goes;
    }

    Step fromFace(Contact& contact, const Goal& goal) noexcept
    {
        const Facet facet = surface_.facet(contact.face, 0);
        const SurfaceFoot foot = facet.foot(goal);
        if (foot.above > 0.0) {
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        return walk(contact, facet, contact.weights, foot, goal);
    }

    // From a position on a facet straight towards the foot.
    Step walk(Contact& contact,
              const Facet& facet,
              const std::array<double, 3>& at,
              const SurfaceFoot& foot,
              const Goal& goal) noexcept
    {
        ++counters_.faces;
        if (foot.isInside()) {
            return settle(contact, facet, foot, goal);
        }
        const auto exit = Steps::exitFrom(facet, at, foot);
        const Vertex from = facet.vertices[(exit.corner + 1) % 3];
        const Vertex to = facet.vertices[(exit.corner + 2) % 3];
        if (!Steps::isWithinEdge(exit.share)) {
            Steps::restOnVertex(contact, exit.share > 0.5 ? to : from);
            return Step::Goes;
        }
        if (surface_.hasBeyond(facet, exit.corner)) {
            const Facet next = surface_.beyond(facet, exit.corner);
            const SurfaceFoot its_foot = next.foot(goal);
            if (its_foot.above <= 0.0 && Steps::isInward(its_foot.weights[0], next, goal)) {
                return cross(contact, next, 1.0 - exit.share, its_foot, goal);
            }
        }
        Steps::restOnEdge(surface_, contact, from, to, exit.share);
        return Step::Goes;
    }

    // From facet to facet, each entered over the edge opposite its first corner, as long as the
    // next one leads closer. The foot is on the inner side of that edge.
    Step cross(Contact& contact,
               const Facet& first,
               double share, // of the way from its second corner to its third
               SurfaceFoot foot,
               const Goal& goal) noexcept
    {
        // Small facets stay in registers, large ones take turns in two places.
        constexpr bool kIsLarge = sizeof(Facet) > 192;
        std::array<Facet, kIsLarge ? 2 : 1> facets{first};
        std::size_t at = 0;
        while (true) {
            const Facet& facet = facets[kIsLarge ? at : 0];
            ++counters_.faces;
            if (foot.weights[1] >= 0.0 && foot.weights[2] >= 0.0) {
                return settle(contact, facet, foot, goal);
            }
            const auto exit = Steps::exitAhead(share, foot);
            const Vertex ahead = facet.vertices[0];
            const Vertex beside = exit.is_to_third ? facet.vertices[2] : facet.vertices[1];
            if (!Steps::isWithinEdge(exit.share)) {
                Steps::restOnVertex(contact, exit.share > 0.5 ? ahead : beside);
                return Step::Goes;
            }
            const bool has_next =
                exit.is_to_third ? surface_.hasBeyond(facet, 1) : surface_.hasBeyond(facet, 2);
            if (has_next && steps_ > 1) {
                --steps_;
                if constexpr (kIsLarge) {
                    remake(facets[1 - at], [&] {
                        return exit.is_to_third ? surface_.beyond(facet, 1)
                                                : surface_.beyond(facet, 2);
                    });
                    at = 1 - at;
                } else {
                    facets[0] =
                        exit.is_to_third ? surface_.beyond(facet, 1) : surface_.beyond(facet, 2);
                }
                const Facet& next = facets[kIsLarge ? at : 0];
                foot = next.foot(goal);
                // The next facet's second corner is the one ahead, or the one to the side. Above
                // its plane, over a sharp ridge, the proxy may leave the surface.
                if (foot.above <= 0.0 && Steps::isInward(foot.weights[0], next, goal)) {
                    share = exit.is_to_third ? 1.0 - exit.share : exit.share;
                    continue;
                }
            }
            Steps::restOnEdge(surface_, contact, beside, ahead, exit.share);
            return Step::Goes;
        }
    }

    // The foot is inside.
    Step
    settle(Contact& contact, const Facet& facet, const SurfaceFoot& foot, const Goal& goal) noexcept
    {
        const auto& [first, second, third] = foot.weights;
        if (!Steps::isInward(std::min({first, second, third}), facet, goal)) {
            // From an edge, a face on its other side may lead closer.
            contact = Steps::contactOnOrBeside(surface_, facet, foot, goal);
            return Step::Goes;
        }
        if (foot.above > 0.0) { // a sharp ridge was crossed, or it is rounding error
            contact = Steps::contactOn(surface_, facet, foot);
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        facet_ = facet;
        foot_ = foot;
        return Step::Ends;
    }

    const S& surface_;
    ContactCounters& counters_;
    std::uint32_t steps_;
    std::optional<Facet> facet_; // where the descent ended within a face
    SurfaceFoot foot_{};
    double flight_squared_ = std::numeric_limits<double>::infinity();
    double vertex_squared_ = std::numeric_limits<double>::infinity();
    Vertex vertex_{}; // the last one visited
    Vec3 vertex_to_goal_;
    int stalls_ = 0;
};

} // namespace marsview
