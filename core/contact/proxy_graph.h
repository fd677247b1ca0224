// The proxy-graph contact model (Walker and Salisbury, "Large haptic topographic maps: MarsView and
// the proxy graph algorithm", I3D 2003, sections 3 to 3.5).
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
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
/// straight through free space where the way to the goal leaves the surface.
///
/// Differences from the paper, all of which make it follow the goal more closely:
/// - A descent that begins within a face or edge (where a cast landed, or where the last update
///   ended) walks across faces to the first vertex it meets, instead of jumping to the nearest
///   vertex, which may lie farther from the goal, in another basin.
/// - A vertex is left for the next one only where the goal projects beyond the whole edge.
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
    // The goal projected onto the plane of a face.
    struct Foot {
        std::array<double, 3> weights; // of the corners; negative: beyond the edge opposite
        double scale;

        bool isInside() const
        {
            return weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
        }
    };

    // The way within a face to the foot outside it: where it leaves, and through which edge.
    struct Exit {
        int corner; // opposite the edge
        std::array<double, 3> weights;
    };

    // Vertices from which far-edge steps were taken within this update. More than this are treated
    // as a loop; in a million updates on fractals not more than a handful are met.
    static constexpr std::size_t kFarListMax = 64;
    // A descent whose distance no longer gets less, to rounding, ends after so many steps: enough
    // to turn around a vertex through steps of length zero.
    static constexpr int kStallsMax = 32;
    // What is less than rounding error from an end of an edge, or from the border of a face, is
    // there: another face or edge may lead on from it, which would not be seen from beside it. The
    // error grows with the distance to the goal. An edge leads closer from a vertex where it leads
    // by more than this; half of it is still at the vertex, so that the two cannot contradict.
    static constexpr double kShareMin = 1e-12;  // of the edge
    static constexpr double kCosineMin = 1e-13; // between edge and goal
    static constexpr double kFootError = 4e-15; // of the distance to the goal, times the slope

    // What one update remembers while it descends.
    struct Descent {
        std::array<Vertex, kFarListMax> far_vertices;
        std::size_t far_count = 0;
        bool walks_only = false;      // after a loop of far-edge steps
        std::optional<Vertex> origin; // the vertex whose steepest edge the proxy is on
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

    // The paper's free-space test: only the adjacent faces can obstruct the beginning of the way.
    // True where the proxy left the place it was at.
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

    // Each of these moves the proxy one step and tells whether the update is over.
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
        // The largest squared cosine times |to_goal|², which is the paper's edge gradient, of those
        // edges that lead closer.
        double steepest = kCosineMin * kCosineMin * dot(to_goal, to_goal);
        Vertex end{};
        bool is_found = false;
        bool is_beyond = false;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double towards = dot(to_goal, spoke.along);
            const double length_squared = dot(spoke.along, spoke.along);
            if (towards > kShareMin * length_squared &&
                towards * towards > steepest * length_squared) {
                steepest = towards * towards / length_squared;
                end = spoke.end;
                is_beyond = towards >= length_squared;
                is_found = true;
            }
        });
        if (!is_found) {
            return true;
        }
        if (is_beyond) {
            contact_.vertex = end;
            return false;
        }
        contact_.feature = ContactFeature::Edge;
        contact_.edge = surface_.edgeBetween(here, end);
        contact_.along = surface_.ends(contact_.edge)[0] == here ? 0.0 : 1.0;
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
        const double slack =
            0.5 *
            std::max(kShareMin, kCosineMin * std::sqrt(dot(to_goal, to_goal) / length_squared));
        if (!(along > slack && along < 1.0 - slack)) {
            contact_.feature = ContactFeature::Vertex;
            contact_.vertex = along > 0.5 ? to : from;
            return has_stalled;
        }
        contact_.along = along;
        if (leaves(surface_.wayOut(contact_, goal), goal)) {
            return is_free_;
        }
        // A foot on the inner side of a face means that the way into it leads closer: the same
        // number decides it as decides, within that face, whether its foot is outside.
        std::optional<SurfaceWing<S>> into;
        Foot foot{};
        double steepest = 0.0;
        for (const auto& wing : surface_.wings(contact_.edge)) {
            if (!wing) {
                continue;
            }
            const Foot candidate = footOn(wing->face, goal);
            const double weight = candidate.weights[static_cast<std::size_t>(wing->corner)];
            const double descent_squared = weight * weight * candidate.scale;
            if (weight > 0.0 && descent_squared > steepest) {
                steepest = descent_squared;
                into = wing;
                foot = candidate;
            }
        }
        if (!into || has_stalled) {
            return true;
        }
        ++counters_.faces;
        if (foot.isInside()) {
            contact_ = contactOnFace(surface_, into->face, foot.weights);
            return false; // the goal may be above the face, or its foot on another edge
        }
        const auto corners = surface_.corners(into->face);
        const auto corner = static_cast<std::size_t>(into->corner);
        std::array<double, 3> weights{};
        weights[(corner + 1) % 3] = corners[(corner + 1) % 3] == from ? 1.0 - along : along;
        weights[(corner + 2) % 3] = 1.0 - weights[(corner + 1) % 3];
        const Exit exit = exitTowards(weights, foot);
        contact_ = contactOnFace(surface_, into->face, exit.weights);
        if (origin && corners[static_cast<std::size_t>(exit.corner)] == *origin) {
            crossFarEdge(goal, corners, static_cast<std::size_t>(exit.corner), descent);
        }
        return false;
    }

    // The paper's far-edge crossing (section 3.3): goes on from the end of the far edge that is
    // closer to the goal, although that may be farther than the vertex from which the trace came.
    // A second crossing from one vertex would go on for ever: then the proxy stays on the far edge,
    // closer than all before, and walks.
    void crossFarEdge(const Goal& goal,
                      const std::array<Vertex, 3>& corners,
                      std::size_t corner,
                      Descent& descent) noexcept
    {
        if (descent.walks_only) {
            return;
        }
        ++counters_.far_edges;
        const auto end =
            descent.far_vertices.begin() + static_cast<std::ptrdiff_t>(descent.far_count);
        if (descent.far_count == kFarListMax ||
            std::find(descent.far_vertices.begin(), end, corners[corner]) != end) {
            ++counters_.far_loops;
            descent.walks_only = true;
            return;
        }
        descent.far_vertices[descent.far_count++] = corners[corner];
        const Vertex a = corners[(corner + 1) % 3];
        const Vertex b = corners[(corner + 2) % 3];
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
        if (leaves(surface_.wayOut(contact_, goal), goal)) {
            return is_free_;
        }
        const Foot foot = footOn(contact_.face, goal);
        if (foot.isInside()) {
            contact_ = contactOnFace(surface_, contact_.face, foot.weights);
            return contact_.feature == ContactFeature::Face;
        }
        contact_ =
            contactOnFace(surface_, contact_.face, exitTowards(contact_.weights, foot).weights);
        const ScenePoint rest = surface_.goalPoint(goal) - surface_.point(contact_);
        return descent.hasStalled(dot(rest, rest));
    }

    Foot footOn(const Face& face, const Goal& goal) const noexcept
    {
        const auto facet = surface_.facet(face, 0);
        const SurfaceFoot scaled = facet.foot(goal);
        Foot foot{};
        foot.scale = facet.scale;
        for (std::size_t i = 0; i < 3; ++i) {
            foot.weights[i] = scaled.weights[i] / facet.scale;
        }
        const double error = std::max(kShareMin, facet.error(goal) / facet.scale);
        for (double& weight : foot.weights) {
            weight = std::abs(weight) <= error ? 0.0 : weight;
        }
        return foot;
    }

    // `weights` are those of a place in the face, the foot is outside.
    static Exit exitTowards(const std::array<double, 3>& weights, const Foot& foot) noexcept
    {
        double share = std::numeric_limits<double>::infinity();
        std::size_t corner = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (foot.weights[i] < 0.0) {
                const double at = weights[i] / (weights[i] - foot.weights[i]);
                if (at < share) {
                    share = at;
                    corner = i;
                }
            }
        }
        Exit exit{static_cast<int>(corner), {}};
        const std::size_t j = (corner + 1) % 3;
        const std::size_t k = (corner + 2) % 3;
        const double weight_j = weights[j] + share * (foot.weights[j] - weights[j]);
        const double weight_k = weights[k] + share * (foot.weights[k] - weights[k]);
        exit.weights[j] = std::clamp(weight_j / (weight_j + weight_k), 0.0, 1.0);
        exit.weights[k] = 1.0 - exit.weights[j];
        return exit;
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
