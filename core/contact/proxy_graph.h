// The proxy-graph contact model (Walker and Salisbury, "Large haptic topographic maps: MarsView and
// the proxy graph algorithm", I3D 2003, sections 3 to 3.5).
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/facet_steps.h"
#include "core/contact/point_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

/// Moves the proxy as close to the goal as it gets without ever moving away: down the distance
/// along the mesh's edges, from vertex to vertex, to a minimum on a vertex, edge or face, and
/// straight through free space where the path to the goal leaves the surface.
///
/// Differences from the paper, which all make it follow the goal more closely:
/// - A descent that begins within a face or edge (where a cast landed, or where the last update
///   ended) walks across faces to the first vertex it meets, instead of jumping to the nearest
///   vertex, which may lie farther from the goal, in another basin.
/// - The proxy leaves a vertex for the next one only if the goal projects beyond the whole edge.
/// - A loop of far-edge steps ends with such a walk from the far edge, so that the end is a
///   minimum. Far-edge steps are thus the only ones that may increase the distance to the goal.
template <ContactSurface S>
class ProxyGraphDescent {
public:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Contact = SurfaceContact<S>;

    ProxyGraphDescent(const S& surface, ContactCounters& counters) noexcept
        : surface_(surface)
        , counters_(counters)
    {}

    bool descend(Contact& contact, const Goal& goal) noexcept
    {
        contact_ = contact;
        minimise(goal);
        contact = contact_;
        return is_free_;
    }

private:
    using Facet = typename S::Facet;
    using Steps = FacetSteps<S>;

    // Vertices from which far-edge steps were taken within this update. More than this count as a
    // loop; a million updates on fractals use only a handful.
    static constexpr std::size_t kFarListMax = 64;
    // A descent whose distance stops decreasing, to rounding, ends after this many steps: enough to
    // turn around a vertex through steps of length zero.
    static constexpr int kStallsMax = 32;
    // The state of one descent.
    struct FarList {
        std::array<Vertex, kFarListMax> vertices;
        std::size_t count = 0;

        // False if it is in the list already or the list is full.
        bool add(Vertex vertex) noexcept
        {
            const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(count);
            if (count == kFarListMax || std::find(vertices.begin(), end, vertex) != end) {
                return false;
            }
            vertices[count++] = vertex;
            return true;
        }
    };
    struct Descent {
        std::optional<FarList> far_list; // created for the first far-edge step, which is rare
        bool walks_only = false;         // after a loop of far-edge steps
        std::optional<Vertex> origin;    // the vertex whose steepest edge the proxy is on
        double distance_squared = std::numeric_limits<double>::infinity();
        int stalls = 0;

        bool hasStalled(double squared) noexcept
        {
            if (squared < distance_squared * (1.0 - 1e-15)) {
                distance_squared = squared;
                stalls = 0;
                return false;
            }
            return ++stalls > kStallsMax;
        }
    };

    void minimise(const Goal& goal) noexcept
    {
        Descent descent;
        for (std::uint32_t steps = surface_.stepsMax(); steps > 0; --steps) {
            const bool is_done = contact_.feature == ContactFeature::Vertex
                                     ? atVertex(goal, descent)
                                 : contact_.feature == ContactFeature::Edge ? onEdge(goal, descent)
                                                                            : onFace(goal, descent);
            if (is_done) {
                return;
            }
        }
        counters_.cut_short = 1;
    }

    // The paper's free-space test: only the adjacent faces can block the beginning of the path.
    // True if the proxy has left its position.
    bool leaves(const std::optional<Face>& over, const Goal& goal) noexcept
    {
        if (!over) {
            return false;
        }
        ++counters_.casts;
        const SurfaceCast<S> cast = surface_.castFrom(contact_, *over, goal);
        counters_.cells += cast.cells;
        is_free_ = !cast.contact;
        contact_ = cast.contact.value_or(contact_);
        return true;
    }

    // Each of these moves the proxy one step and returns whether the update is complete.
    bool atVertex(const Goal& goal, Descent& descent) noexcept
    {
        ++counters_.vertices;
        descent.origin.reset();
        const Vertex here = contact_.vertex;
        const auto fan = surface_.fan(here);
        if (leaves(surface_.wayOut(fan, goal), goal)) {
            return is_free_;
        }
        const Vec3 to_goal = surface_.toGoal(fan, goal);
        const auto steepest = Steps::steepestSpoke(surface_, fan, to_goal, dot(to_goal, to_goal));
        if (!(steepest.towards > 0.0)) {
            return true;
        }
        if (steepest.towards >= steepest.length_squared) {
            contact_.vertex = steepest.spoke.end;
            return false;
        }
        Steps::restOnEdge(surface_, contact_, here, steepest.spoke.end, 0.0);
        descent.origin = here;
        return false;
    }

    bool onEdge(const Goal& goal, Descent& descent) noexcept
    {
        const auto origin = std::exchange(descent.origin, std::nullopt);
        const auto [from, to] = surface_.ends(contact_.edge);
        const Vec3 edge = surface_.between(from, to);
        const Vec3 to_goal = surface_.toGoal(from, goal);
        const double length_squared = dot(edge, edge);
        const double along = dot(to_goal, edge) / length_squared;
        const Vec3 rest = to_goal - edge * std::clamp(along, 0.0, 1.0);
        const bool has_stalled = descent.hasStalled(dot(rest, rest));
        const double least = Steps::endShare(dot(to_goal, to_goal), length_squared);
        if (!(along > least && along < 1.0 - least)) {
            Steps::restOnVertex(contact_, along > 0.5 ? to : from);
            return has_stalled;
        }
        contact_.along = along;
        const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(contact_.edge);
        const SurfaceFoot left = facets.left.foot(goal);
        const SurfaceFoot right = facets.has_right ? facets.right.foot(goal) : SurfaceFoot{};
        if (!has_stalled && (left.above > 0.0 || right.above > 0.0 || !facets.has_right) &&
            leaves(surface_.wayOut(contact_, goal), goal)) {
            return is_free_;
        }
        // The steeper of the paths into the faces.
        const bool is_left = Steps::isInward(left.weights[0], facets.left, goal);
        const bool is_right =
            facets.has_right && Steps::isInward(right.weights[0], facets.right, goal) &&
            !(is_left && left.weights[0] * left.weights[0] * facets.right.scale >=
                             right.weights[0] * right.weights[0] * facets.left.scale);
        if (!(is_left || is_right) || has_stalled) {
            return true;
        }
        ++counters_.faces;
        const Facet& facet = is_right ? facets.right : facets.left;
        const SurfaceFoot& foot = is_right ? right : left;
        if (foot.isInside()) {
            contact_ = Steps::contactOnOrBeside(surface_, facet, foot, goal);
            return false; // the goal may be above the face, or its foot on another edge
        }
        const double share = facet.vertices[1] == from ? along : 1.0 - along;
        const auto exit = Steps::exitAhead(share, foot);
        const Vertex ahead = facet.vertices[0];
        const Vertex beside = facet.vertices[exit.is_to_third ? 2 : 1];
        if (Steps::isWithinEdge(exit.share)) {
            Steps::restOnEdge(surface_, contact_, beside, ahead, exit.share);
        } else {
            Steps::restOnVertex(contact_, exit.share > 0.5 ? ahead : beside);
        }
        const Vertex opposite = facet.vertices[exit.is_to_third ? 1 : 2];
        if (origin && opposite == *origin) {
            crossFarEdge(goal, opposite, ahead, beside, descent);
        }
        return false;
    }

    // The paper's far-edge crossing (section 3.3): continues from the end of the far edge that is
    // closer to the goal, although it may be farther than the vertex from which the trace came. A
    // second crossing from the same vertex would loop forever: the proxy then stays on the far
    // edge, closer than every position before, and walks.
    void
    crossFarEdge(const Goal& goal, Vertex opposite, Vertex a, Vertex b, Descent& descent) noexcept
    {
        if (descent.walks_only) {
            return;
        }
        ++counters_.far_edges;
        if (!descent.far_list) {
            descent.far_list.emplace();
        }
        if (!descent.far_list->add(opposite)) {
            ++counters_.far_loops;
            descent.walks_only = true;
            return;
        }
        const Vec3 from_a = surface_.toGoal(a, goal);
        const Vec3 from_b = surface_.toGoal(b, goal);
        contact_.feature = ContactFeature::Vertex;
        contact_.vertex = dot(from_a, from_a) <= dot(from_b, from_b) ? a : b;
        descent.distance_squared = std::numeric_limits<double>::infinity();
        descent.stalls = 0;
    }

    bool onFace(const Goal& goal, Descent& descent) noexcept
    {
        descent.origin.reset();
        ++counters_.faces;
        const Facet facet = surface_.facet(contact_.face, 0);
        const SurfaceFoot foot = facet.foot(goal);
        if (foot.above > 0.0 && leaves(surface_.wayOut(contact_, goal), goal)) {
            return is_free_;
        }
        if (foot.isInside()) {
            contact_ = Steps::contactOnOrBeside(surface_, facet, foot, goal);
            return contact_.feature == ContactFeature::Face;
        }
        const auto exit = Steps::exitFrom(facet, contact_.weights, foot);
        const Vertex from = facet.vertices[(exit.corner + 1) % 3];
        const Vertex to = facet.vertices[(exit.corner + 2) % 3];
        if (Steps::isWithinEdge(exit.share)) {
            Steps::restOnEdge(surface_, contact_, from, to, exit.share);
        } else {
            Steps::restOnVertex(contact_, exit.share > 0.5 ? to : from);
        }
        const ScenePoint rest = surface_.goalPoint(goal) - surface_.point(contact_);
        return descent.hasStalled(dot(rest, rest));
    }

    const S& surface_;
    ContactCounters& counters_;
    Contact contact_;
    bool is_free_ = false;
};

/// The contact model of the paper.
template <ContactSurface S>
using ProxyGraph = PointProxy<S, ProxyGraphDescent<S>>;

} // namespace marsview
