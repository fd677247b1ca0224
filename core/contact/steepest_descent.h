// The way down: from a place on the surface to a local minimum of the distance to a goal at rest.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"

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
/// directions, along its edges and within its faces. Where the straight way to the goal leaves the
/// surface it is followed through free space, which takes a segment cast. The distance never grows.
///
/// A helper of the models for one update: cheap to make. Real-time: allocates nothing, bounded by
/// S::stepsMax(), which is counted as cut short.
template <ContactSurface S>
class SteepestDescent {
public:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Contact = SurfaceContact<S>;
    using Weights = std::array<double, 3>;

    // What is less than this share of an edge from its end is there: another face or edge may lead
    // on from it, which would not be seen from beside it. An edge leads closer from a vertex where
    // its cosine with the goal's direction is more than kCosineMin; half of it is still at the
    // vertex, so that the two cannot contradict each other.
    static constexpr double kShareMin = 1e-12;
    static constexpr double kCosineMin = 1e-13;

    SteepestDescent(const S& surface, ContactCounters& counters) noexcept
        : surface_(surface)
        , counters_(counters)
        , steps_(surface.stepsMax())
    {}

    /// Moves `contact` to a local minimum. True where the way ended at the goal itself, in free
    /// space; then the contact means nothing.
    bool descend(Contact& contact, const Goal& goal) noexcept
    {
        return run(contact, goal, Step::Goes);
    }

    /// The same, beginning with a walk into `face` from a place on it.
    bool descendInto(Contact& contact, Face face, const Weights& weights, const Goal& goal) noexcept
    {
        const auto plane = surface_.facePlane(face);
        return run(contact, goal, walk(contact, face, weights, plane, plane.foot(goal), goal));
    }

    /// Follows the straight way to the goal that leaves the surface over `over`, down again to a
    /// local minimum where it meets the surface.
    bool leave(Contact& contact, Face over, const Goal& goal) noexcept
    {
        return run(contact, goal, fly(contact, over, goal));
    }

private:
    using Plane = decltype(std::declval<const S&>().facePlane(std::declval<Face>()));

    enum class Step : std::uint8_t {
        Goes, // the contact is where the next step begins
        Ends, // it is a local minimum
        Free, // the goal was reached through free space
    };

    // After so many visits of vertices that are no closer to the goal than the one before, to
    // rounding, the last of them is a minimum, to rounding.
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
        if (squared >= vertex_squared_ * (1.0 - 1e-15) && ++stalls_ > kStallsMax) {
            return Step::Ends;
        }
        vertex_squared_ = squared;

        // The squares of how fast the distance falls, times `squared`.
        double steepest = kCosineMin * kCosineMin * squared;
        std::optional<SurfaceSpoke<S>> along;
        double along_share = 0.0;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double towards = dot(to_goal, spoke.along);
            const double length_squared = dot(spoke.along, spoke.along);
            if (towards > kShareMin * length_squared &&
                towards * towards > steepest * length_squared) {
                steepest = towards * towards / length_squared;
                along = spoke;
                along_share = towards / length_squared;
            }
        });
        if (!along) {
            // Within a face, no direction leads closer where neither of its edges does.
            return Step::Ends;
        }
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
                    if (rate > steepest) {
                        steepest = rate;
                        into = face;
                    }
                }
            });
        if (into) {
            // On steep faces the products above cancel: the plane decides.
            const auto plane = surface_.facePlane(*into);
            const SurfaceFoot foot = plane.foot(goal);
            const auto corners = surface_.corners(*into);
            const std::size_t at = corners[0] == here ? 0 : corners[1] == here ? 1 : 2;
            if (foot.weights[(at + 1) % 3] > 0.0 && foot.weights[(at + 2) % 3] > 0.0) {
                Weights weights{};
                weights[at] = 1.0;
                return walk(contact, *into, weights, plane, foot, goal);
            }
        }
        return slide(contact, here, *along, along_share, squared);
    }

    // Along an edge of which no face leads away.
    Step slide(Contact& contact,
               Vertex here,
               const SurfaceSpoke<S>& along,
               double share,
               double squared) noexcept
    {
        const double length_squared = dot(along.along, along.along);
        if (share >= 1.0 - slack(squared, length_squared)) {
            contact.feature = ContactFeature::Vertex;
            contact.vertex = along.end;
            return Step::Goes;
        }
        contact.feature = ContactFeature::Edge;
        contact.edge = surface_.edgeBetween(here, along.end);
        contact.along = surface_.ends(contact.edge)[0] == here ? share : 1.0 - share;
        return Step::Goes; // rounding may have hidden that a face leads closer
    }

    static double slack(double goal_squared, double length_squared) noexcept
    {
        return 0.5 * std::max(kShareMin, kCosineMin * std::sqrt(goal_squared / length_squared));
    }

    Step fromEdge(Contact& contact, const Goal& goal) noexcept
    {
        if (const auto over = surface_.wayOut(contact, goal)) {
            return fly(contact, *over, goal);
        }
        // A foot on the inner side of a face means that the way into it leads closer: the same
        // number decides it as decides, within that face, whether its foot is outside.
        std::optional<SurfaceWing<S>> into;
        std::optional<Plane> plane;
        SurfaceFoot foot{};
        double steepest = 0.0;
        for (const auto& wing : surface_.wings(contact.edge)) {
            if (!wing) {
                continue;
            }
            const Plane candidate = surface_.facePlane(wing->face);
            const SurfaceFoot its_foot = candidate.foot(goal);
            const double weight = its_foot.weights[static_cast<std::size_t>(wing->corner)];
            if (weight > 0.0 && weight * weight > steepest * candidate.scale &&
                isInward(weight, candidate, goal)) {
                steepest = weight * weight / candidate.scale;
                into = wing;
                plane = candidate;
                foot = its_foot;
            }
        }
        const auto [from, to] = surface_.ends(contact.edge);
        if (into) {
            const auto corners = surface_.corners(into->face);
            const auto corner = static_cast<std::size_t>(into->corner);
            Weights weights{};
            weights[(corner + 1) % 3] =
                corners[(corner + 1) % 3] == from ? 1.0 - contact.along : contact.along;
            weights[(corner + 2) % 3] = 1.0 - weights[(corner + 1) % 3];
            return walk(contact, into->face, weights, *plane, foot, goal);
        }
        const Vec3 edge = surface_.between(from, to);
        const Vec3 to_goal = surface_.toGoal(from, goal);
        const double length_squared = dot(edge, edge);
        const double along = dot(to_goal, edge) / length_squared;
        const double least = slack(dot(to_goal, to_goal), length_squared);
        if (along > least && along < 1.0 - least) {
            contact.along = along;
            return Step::Ends;
        }
        contact.feature = ContactFeature::Vertex;
        contact.vertex = along > 0.5 ? to : from;
        return Step::Goes;
    }

    Step fromFace(Contact& contact, const Goal& goal) noexcept
    {
        if (const auto over = surface_.wayOut(contact, goal)) {
            return fly(contact, *over, goal);
        }
        const Plane plane = surface_.facePlane(contact.face);
        return walk(contact, contact.face, contact.weights, plane, plane.foot(goal), goal);
    }

    // Straight towards the foot, from face to face as long as the next one leads closer.
    Step walk(Contact& contact,
              Face face,
              Weights at,
              Plane plane,
              SurfaceFoot foot,
              const Goal& goal) noexcept
    {
        for (;; --steps_) {
            ++counters_.faces;
            if (foot.isInside()) {
                return settle(contact, face, plane, foot, goal);
            }
            const Exit exit = exitTowards(at, foot, plane.scale);
            const std::size_t i = exit.corner;
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            if (!(exit.share > kShareMin && exit.share < 1.0 - kShareMin)) {
                contact.feature = ContactFeature::Vertex;
                contact.vertex = surface_.corners(face)[exit.share > 0.5 ? k : j];
                return Step::Goes;
            }
            const auto wing = surface_.across(face, static_cast<int>(i));
            if (!wing || steps_ <= 1) {
                return stopAtEdge(contact, face, exit);
            }
            const Plane next = surface_.facePlane(wing->face);
            const SurfaceFoot next_foot = next.foot(goal);
            const auto corner = static_cast<std::size_t>(wing->corner);
            if (!isInward(next_foot.weights[corner], next, goal)) {
                return stopAtEdge(contact, face, exit);
            }
            at[corner] = 0.0;
            at[(corner + 1) % 3] = exit.share; // the edge runs the other way around
            at[(corner + 2) % 3] = 1.0 - exit.share;
            face = wing->face;
            plane = next;
            foot = next_foot;
            if (foot.above > 0.0) { // over a sharp ridge
                contact = contactOnFace(surface_, face, at);
                return Step::Goes;
            }
        }
    }

    // Whether a foot of that weight is inside the edge opposite, by more than rounding error.
    static bool isInward(double weight, const Plane& plane, const Goal& goal) noexcept
    {
        constexpr double kClearly = 1e-6; // of the scale: far more than any rounding error
        return weight > kClearly * plane.scale ||
               weight > std::max(kShareMin * plane.scale, plane.error(goal));
    }

    Step settle(Contact& contact,
                Face face,
                const Plane& plane,
                SurfaceFoot foot,
                const Goal& goal) const noexcept
    {
        Weights weights = foot.weights;
        for (double& weight : weights) {
            weight = isInward(weight, plane, goal) ? weight : 0.0;
        }
        const double sum = weights[0] + weights[1] + weights[2];
        for (double& weight : weights) {
            weight /= sum;
        }
        const bool was_here = contact.feature == ContactFeature::Face;
        contact = contactOnFace(surface_, face, weights);
        // From an edge, a face on its other side may lead closer. A ridge may have been crossed.
        return contact.feature == ContactFeature::Face && (was_here || foot.above <= 0.0)
                   ? Step::Ends
                   : Step::Goes;
    }

    // The way within a face to a foot outside leaves through the edge opposite `corner`, at the
    // share of that edge from the corner after to the one before.
    struct Exit {
        std::size_t corner;
        double share;
    };

    static Exit exitTowards(const Weights& at, const SurfaceFoot& foot, double scale) noexcept
    {
        double earliest = std::numeric_limits<double>::infinity();
        std::size_t corner = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (foot.weights[i] < 0.0) {
                const double time = at[i] * scale / (at[i] * scale - foot.weights[i]);
                if (time < earliest) {
                    earliest = time;
                    corner = i;
                }
            }
        }
        const std::size_t j = (corner + 1) % 3;
        const std::size_t k = (corner + 2) % 3;
        const double weight_j = at[j] * scale + earliest * (foot.weights[j] - at[j] * scale);
        const double weight_k = at[k] * scale + earliest * (foot.weights[k] - at[k] * scale);
        return {corner, weight_k / (weight_j + weight_k)};
    }

    Step stopAtEdge(Contact& contact, Face face, const Exit& exit) const noexcept
    {
        const auto corners = surface_.corners(face);
        contact.feature = ContactFeature::Edge;
        contact.edge = surface_.edgeOf(face, static_cast<int>(exit.corner));
        contact.along = surface_.ends(contact.edge)[0] == corners[(exit.corner + 1) % 3]
                            ? exit.share
                            : 1.0 - exit.share;
        return Step::Goes;
    }

    const S& surface_;
    ContactCounters& counters_;
    std::uint32_t steps_;
    double vertex_squared_ = std::numeric_limits<double>::infinity();
    int stalls_ = 0;
};

} // namespace marsview
