// The proxy-graph contact model exactly as published (Walker and Salisbury, "Large haptic
// topographic maps: MarsView and the proxy graph algorithm", I3D 2003), to compare proxy_graph.h
// with.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/facet_steps.h"
#include "core/contact/point_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace marsview {

/// Every update casts a segment from the proxy to the goal (section 3.2). A proxy on the surface
/// whose way is blocked by the triangle beside it hits that triangle at once. From the vertex of
/// the hit triangle nearest to the goal, the proxy goes along the edge with the smallest gradient
/// (equation 1) as long as the vertex at its end is nearer to the goal. Where it is not, the update
/// ends at the minimum on one of the two triangles of the edge (equation 2), or else on the edge.
/// At each vertex, and at that minimum, the straight path to the goal is tested again. If a
/// triangle of the edge has its minimum beyond its far edge (section 3.3), the proxy continues from
/// the nearer end of the far edge; the second such step from the same vertex ends the update at the
/// triangle's minimum on the far edge.
///
/// Where the paper leaves a choice: a proxy at rest on a vertex begins there; one on an edge hits
/// the triangle on the goal's side. A minimum on a triangle goes before a step over a far edge, and
/// of two of either kind the one nearer to the goal is taken. Starting at a vertex may move away
/// from the goal, so that the same free path can be found again and again: an update ends if the
/// path is free from a position that is not nearer to the goal than the last one from which it was.
template <ContactSurface S>
class ProxyGraph2003Descent {
public:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Face = typename S::Face;
    using Contact = SurfaceContact<S>;

    ProxyGraph2003Descent(const S& surface, ContactCounters& counters) noexcept
        : surface_(surface)
        , counters_(counters)
    {}

    bool descend(Contact& contact, const Goal& goal) noexcept
    {
        contact_ = contact;
        run(goal);
        contact = contact_;
        return is_free_;
    }

private:
    using Facet = typename S::Facet;
    using Steps = FacetSteps<S>;

    void run(const Goal& goal) noexcept
    {
        // A proxy that came through free space has cast its segment and hit the surface here.
        if (counters_.casts == 0 && !casts(goal)) {
            ++counters_.casts;
            ++counters_.cells;
        }
        if (is_free_) {
            return;
        }
        startAtVertex(goal);
        for (std::uint32_t steps = surface_.stepsMax(); steps > 0; --steps) {
            if (isDoneAtVertex(goal)) {
                return;
            }
        }
        counters_.cut_short = 1;
    }

    // Casts a segment to the goal if no adjacent face is in the way; false if one is. Sets is_free_
    // or the contact.
    bool casts(const Goal& goal) noexcept
    {
        const auto over = surface_.wayOut(contact_, goal);
        if (over) {
            castOver(*over, goal);
        }
        return over.has_value();
    }
    void castOver(const Face& over, const Goal& goal) noexcept
    {
        ++counters_.casts;
        const SurfaceCast<S> cast = surface_.castFrom(contact_, over, goal);
        counters_.cells += cast.cells;
        is_free_ = !cast.contact;
        contact_ = cast.contact.value_or(contact_);
    }

    double squaredTo(Vertex vertex, const Goal& goal) const noexcept
    {
        const Vec3 to_goal = surface_.toGoal(vertex, goal);
        return dot(to_goal, to_goal);
    }
    double squaredTo(const Contact& contact, const Goal& goal) const noexcept
    {
        const Vec3 to_goal = surface_.goalPoint(goal) - surface_.point(contact);
        return dot(to_goal, to_goal);
    }
    Vertex nearerOf(Vertex a, Vertex b, const Goal& goal) const noexcept
    {
        return squaredTo(b, goal) < squaredTo(a, goal) ? b : a;
    }

    // From where a cast met the surface: the vertex of that triangle nearest to the goal.
    void startAtVertex(const Goal& goal) noexcept
    {
        if (contact_.feature == ContactFeature::Vertex) {
            return;
        }
        const auto [a, b, c] = surface_.corners(contact_.feature == ContactFeature::Edge
                                                    ? faceBeside(contact_.edge, goal)
                                                    : contact_.face);
        Steps::restOnVertex(contact_, nearerOf(nearerOf(a, b, goal), c, goal));
    }
    Face faceBeside(const typename S::Edge& edge, const Goal& goal) const noexcept
    {
        if constexpr (requires { goal.grid, edge.kind; }) {
            // Over a heightfield, seen from above.
            using Kind = decltype(edge.kind);
            const auto wings = surface_.wings(edge);
            const double columns = goal.grid.column - static_cast<double>(edge.first.column);
            const double rows = goal.grid.row - static_cast<double>(edge.first.row);
            const double to_first = edge.kind == Kind::AlongRow      ? rows
                                    : edge.kind == Kind::AlongColumn ? columns
                                                                     : columns - rows;
            const bool is_first = wings[0] && (to_first >= 0.0 || !wings[1]);
            return is_first ? wings[0]->face : wings[1]->face;
        } else {
            const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(edge);
            const bool is_right =
                facets.has_right && facets.right.foot(goal).weights[0] * facets.left.scale >
                                        facets.left.foot(goal).weights[0] * facets.right.scale;
            return surface_.faceOf(is_right ? facets.right : facets.left);
        }
    }

    // One step from a vertex.
    bool isDoneAtVertex(const Goal& goal) noexcept
    {
        ++counters_.vertices;
        const Vertex here = contact_.vertex;
        const auto fan = surface_.fan(here);
        const Vec3 to_goal = surface_.toGoal(fan, goal);
        const double goal_squared = dot(to_goal, to_goal);
        if (const auto over = surface_.wayOut(fan, goal)) {
            return isDoneBeyond(*over, goal_squared, goal);
        }
        const auto steepest = Steps::steepestSpoke(surface_, fan, to_goal, goal_squared);
        if (!(steepest.towards > 0.0)) {
            return true; // no edge leads closer
        }
        // The difference of the squared distances, with an allowance for rounding: else two
        // vertices at the same distance could each be nearer than the other.
        constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
        const double excess = 2.0 * steepest.towards - steepest.length_squared;
        if (excess > kRounding * std::sqrt(goal_squared * steepest.length_squared)) {
            contact_.vertex = steepest.spoke.end;
            return false;
        }
        Steps::restOnEdge(surface_, contact_, here, steepest.spoke.end,
                          steepest.towards / steepest.length_squared);
        return isDoneOnEdge(here, goal);
    }

    // The proxy is at the minimum on the steepest edge of a vertex.
    bool isDoneOnEdge(Vertex from, const Goal& goal) noexcept
    {
        const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(contact_.edge);
        std::optional<Contact> minimum;
        double minimum_squared = std::numeric_limits<double>::infinity();
        std::optional<Facet> crossed;
        Contact far{};
        double far_squared = std::numeric_limits<double>::infinity();
        bool is_under_all = facets.has_right;
        for (const bool is_right : {false, true}) {
            if (is_right && !facets.has_right) {
                continue;
            }
            const Facet& facet = is_right ? facets.right : facets.left;
            const SurfaceFoot foot = facet.foot(goal);
            ++counters_.faces;
            is_under_all = is_under_all && foot.above <= 0.0;
            if (!Steps::isInward(foot.weights[0], facet, goal)) {
                continue;
            }
            if (foot.isInside()) {
                const Contact at = Steps::contactOnOrBeside(surface_, facet, foot, goal);
                const double squared = squaredTo(at, goal);
                if (squared < minimum_squared) {
                    minimum = at;
                    minimum_squared = squared;
                }
            } else if (foot.weights[facet.vertices[1] == from ? 1 : 2] < 0.0) {
                const Contact at = onFarEdge(facet, from, goal);
                const double squared = squaredTo(at, goal);
                if (squared < far_squared) {
                    crossed = facet;
                    far = at;
                    far_squared = squared;
                }
            }
        }
        if (minimum) {
            contact_ = *minimum;
        } else if (crossed) {
            return isDoneOverFarEdge(*crossed, far, from, goal);
        }
        if (!is_under_all) {
            if (const auto over = surface_.wayOut(contact_, goal)) {
                return isDoneBeyond(*over, squaredTo(contact_, goal), goal);
            }
        }
        return true;
    }

    // The minimum of a triangle on its edge opposite `from`.
    Contact onFarEdge(const Facet& facet, Vertex from, const Goal& goal) const noexcept
    {
        const Vertex ahead = facet.vertices[0];
        const Vertex beside = facet.vertices[facet.vertices[1] == from ? 2 : 1];
        const Vec3 edge = surface_.between(beside, ahead);
        const double share = dot(surface_.toGoal(beside, goal), edge) / dot(edge, edge);
        Contact at;
        if (Steps::isWithinEdge(share)) {
            Steps::restOnEdge(surface_, at, beside, ahead, share);
        } else {
            Steps::restOnVertex(at, share > 0.5 ? ahead : beside);
        }
        return at;
    }

    bool isDoneOverFarEdge(const Facet& facet,
                           const Contact& far,
                           Vertex from,
                           const Goal& goal) noexcept
    {
        ++counters_.far_edges;
        const auto end = crossed_.begin() + static_cast<std::ptrdiff_t>(crossed_count_);
        if (crossed_count_ == crossed_.size() || std::find(crossed_.begin(), end, from) != end) {
            ++counters_.far_loops;
            contact_ = far;
            return true;
        }
        crossed_[crossed_count_++] = from;
        const Vertex beside = facet.vertices[facet.vertices[1] == from ? 2 : 1];
        Steps::restOnVertex(contact_, nearerOf(beside, facet.vertices[0], goal));
        return false;
    }

    // The straight path to the goal leaves the surface over a face.
    bool isDoneBeyond(const Face& over, double squared, const Goal& goal) noexcept
    {
        if (!(squared < left_squared_)) {
            return true;
        }
        left_squared_ = squared;
        castOver(over, goal);
        if (!is_free_) {
            startAtVertex(goal);
        }
        return is_free_;
    }

    const S& surface_;
    ContactCounters& counters_;
    Contact contact_;
    bool is_free_ = false;
    // Of the last position in this update from which the path to the goal was free.
    double left_squared_ = std::numeric_limits<double>::infinity();
    // The paper's "small list of vertices where far edge steps have occurred". A full list counts
    // as a loop.
    std::array<Vertex, 64> crossed_;
    std::size_t crossed_count_ = 0;
};

/// The contact model of the paper, without the changes of ProxyGraph. It moves away from the goal
/// to begin at a vertex, so that the proxy may end farther from a goal at rest than it was, and the
/// distance may grow by more than the goal moves.
template <ContactSurface S>
using ProxyGraph2003 = PointProxy<S, ProxyGraph2003Descent<S>>;

} // namespace marsview
