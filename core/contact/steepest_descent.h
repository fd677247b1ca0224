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
    using Facet = typename S::Facet;
    using Contact = SurfaceContact<S>;
    using Weights = std::array<double, 3>;

    // What is less than this share of an edge from its end is there: another face or edge may lead
    // on from it, which would not be seen from beside it. An edge leads closer from a vertex where
    // its cosine with the goal's direction is more than kCosineMin; half of it is still at the
    // vertex, so that the two cannot contradict each other.
    static constexpr double kShareMin = 1e-12;
    static constexpr double kCosineMin = 1e-13;

    /// Whether a foot of that weight is inside the edge opposite, by more than rounding error.
    static bool isInward(double weight, const Facet& facet, const Goal& goal) noexcept
    {
        constexpr double kClearly = 1e-6; // of the scale: far more than any rounding error
        return weight > kClearly * facet.scale ||
               weight > std::max(kShareMin * facet.scale, facet.error(goal));
    }

    /// The weights of a face's corners at a foot; what is negative counts as 0.
    static Weights weightsOnFace(const S& surface,
                                 const Face& face,
                                 const Facet& facet,
                                 const SurfaceFoot& foot) noexcept
    {
        const auto corners = surface.corners(face);
        const std::size_t first = corners[0] == facet.vertices[0]   ? 0
                                  : corners[1] == facet.vertices[0] ? 1
                                                                    : 2;
        Weights weights{};
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            weights[(first + i) % 3] = std::max(foot.weights[i], 0.0);
            sum += weights[(first + i) % 3];
        }
        const double inverse = 1.0 / sum;
        for (double& weight : weights) {
            weight *= inverse;
        }
        return weights;
    }

    SteepestDescent(const S& surface, ContactCounters& counters) noexcept
        : surface_(surface)
        , counters_(counters)
        , steps_(surface.stepsMax())
    {}

    /// Moves `contact` to a local minimum. True where the way ended at the goal itself, in free
    /// space; then the contact means nothing.
    bool descend(Contact& contact, const Goal& goal) noexcept
    {
        const bool is_free = run(contact, goal, Step::Goes);
        if (facet_) {
            contact = contactOn(*facet_, foot_);
        }
        return is_free;
    }

    /// The same, beginning with a walk over `facet` from its edge opposite its first corner, at
    /// the share `share` of the way from its second corner to its third. Where the minimum is
    /// within a face, facet() tells which, and `contact` means nothing.
    bool descendOver(Contact& contact, const Facet& facet, double share, const Goal& goal) noexcept
    {
        return run(contact, goal, cross(contact, facet, share, facet.foot(goal), goal));
    }
    const std::optional<Facet>& facet() const noexcept { return facet_; }

private:
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
            const auto corners = surface_.corners(*into);
            const std::size_t at = corners[0] == here ? 0 : corners[1] == here ? 1 : 2;
            const Facet facet = surface_.facet(*into, at);
            const SurfaceFoot foot = facet.foot(goal);
            if (foot.weights[1] > 0.0 && foot.weights[2] > 0.0) {
                return walk(contact, facet, {1.0, 0.0, 0.0}, foot, goal);
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
        const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(contact.edge);
        const SurfaceFoot left = facets.left.foot(goal);
        const SurfaceFoot right = facets.has_right ? facets.right.foot(goal) : SurfaceFoot{};
        if (left.above > 0.0 || right.above > 0.0 || !facets.has_right) {
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        // A foot on the inner side of a face means that the way into it leads closer: the same
        // number decides it as decides, within that face, whether its foot is outside. The steeper
        // way is taken.
        const auto [from, to] = surface_.ends(contact.edge);
        const bool is_left = isInward(left.weights[0], facets.left, goal);
        const bool is_right =
            facets.has_right && isInward(right.weights[0], facets.right, goal) &&
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
        const Facet facet = surface_.facet(contact.face, 0);
        const SurfaceFoot foot = facet.foot(goal);
        if (foot.above > 0.0) {
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        return walk(contact, facet, contact.weights, foot, goal);
    }

    // From a place on a facet straight towards the foot.
    Step walk(Contact& contact,
              const Facet& facet,
              const Weights& at,
              const SurfaceFoot& foot,
              const Goal& goal) noexcept
    {
        if (foot.isInside()) {
            ++counters_.faces;
            return settle(contact, facet, foot, goal);
        }
        double earliest = std::numeric_limits<double>::infinity();
        std::size_t i = 0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (foot.weights[corner] < 0.0) {
                const double begin = at[corner] * facet.scale;
                const double time = begin / (begin - foot.weights[corner]);
                if (time < earliest) {
                    earliest = time;
                    i = corner;
                }
            }
        }
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const auto weightAt = [&](std::size_t corner) {
            const double begin = at[corner] * facet.scale;
            return begin + earliest * (foot.weights[corner] - begin);
        };
        const double of_k = weightAt(k);
        return goBeyond(contact, facet, i, of_k / (of_k + weightAt(j)), goal);
    }

    // A walk leaves a facet over the edge opposite corner i, at the share `share` of the way from
    // corner i + 1 to corner i + 2.
    Step goBeyond(Contact& contact,
                  const Facet& facet,
                  std::size_t i,
                  double share,
                  const Goal& goal) noexcept
    {
        ++counters_.faces;
        if (!(share > kShareMin && share < 1.0 - kShareMin)) {
            return stopAtVertex(contact, facet.vertices[(i + (share > 0.5 ? 2 : 1)) % 3]);
        }
        if (surface_.hasBeyond(facet, i)) {
            const Facet next = surface_.beyond(facet, i);
            const SurfaceFoot foot = next.foot(goal);
            if (foot.above <= 0.0 && isInward(foot.weights[0], next, goal)) {
                return cross(contact, next, 1.0 - share, foot, goal);
            }
        }
        return stopAtEdge(contact, facet.vertices[(i + 1) % 3], facet.vertices[(i + 2) % 3], share);
    }

    // From facet to facet, each entered over the edge opposite its first corner, as long as the
    // next one leads closer. The foot is on the inner side of that edge.
    Step cross(Contact& contact,
               Facet facet,
               double share, // of the way from its second corner to its third
               SurfaceFoot foot,
               const Goal& goal) noexcept
    {
        while (true) {
            ++counters_.faces;
            const auto& [ahead, second, third] = foot.weights;
            if (second >= 0.0 && third >= 0.0) {
                return settle(contact, facet, foot, goal);
            }
            // The sign tells on which side of the corner ahead the way passes: over the edge from
            // it to the third corner, or to the second.
            const double side = (1.0 - share) * third - share * second;
            const bool is_third = side >= 0.0;
            const double of_ahead = (is_third ? 1.0 - share : share) * ahead;
            const double ahead_share = of_ahead / (of_ahead + std::abs(side));
            const Vertex corner = facet.vertices[0];
            const Vertex beside = is_third ? facet.vertices[2] : facet.vertices[1];
            if (!(ahead_share > kShareMin && ahead_share < 1.0 - kShareMin)) {
                return stopAtVertex(contact, ahead_share > 0.5 ? corner : beside);
            }
            if (!(is_third ? surface_.hasBeyond(facet, 1) : surface_.hasBeyond(facet, 2)) ||
                steps_ <= 1) {
                return stopAtEdge(contact, corner, beside, 1.0 - ahead_share);
            }
            // The next facet's second corner is the one ahead, or the one beside.
            share = is_third ? 1.0 - ahead_share : ahead_share;
            facet = is_third ? surface_.beyond(facet, 1) : surface_.beyond(facet, 2);
            foot = facet.foot(goal);
            // Above the next plane, over a sharp ridge, the proxy may let go.
            if (foot.above > 0.0 || !isInward(foot.weights[0], facet, goal)) {
                return stopAtEdge(contact, corner, beside, 1.0 - ahead_share);
            }
            --steps_;
        }
    }

    // The foot is inside.
    Step
    settle(Contact& contact, const Facet& facet, const SurfaceFoot& foot, const Goal& goal) noexcept
    {
        const auto& [first, second, third] = foot.weights;
        if (!isInward(std::min({first, second, third}), facet, goal)) {
            // From an edge, a face on its other side may lead closer.
            SurfaceFoot inside = foot;
            for (double& weight : inside.weights) {
                weight = isInward(weight, facet, goal) ? weight : 0.0;
            }
            contact = contactOn(facet, inside);
            return Step::Goes;
        }
        if (foot.above > 0.0) { // a sharp ridge was crossed, or it is rounding error
            contact = contactOn(facet, foot);
            if (const auto over = surface_.wayOut(contact, goal)) {
                return fly(contact, *over, goal);
            }
        }
        facet_ = facet;
        foot_ = foot;
        return Step::Ends;
    }

    Contact contactOn(const Facet& facet, const SurfaceFoot& foot) const noexcept
    {
        const Face face = surface_.faceOf(facet);
        return contactOnFace(surface_, face, weightsOnFace(surface_, face, facet, foot));
    }

    static Step stopAtVertex(Contact& contact, Vertex vertex) noexcept
    {
        contact.feature = ContactFeature::Vertex;
        contact.vertex = vertex;
        return Step::Goes;
    }

    Step stopAtEdge(Contact& contact, Vertex from, Vertex to, double share) const noexcept
    {
        contact.feature = ContactFeature::Edge;
        contact.edge = surface_.edgeBetween(from, to);
        contact.along = surface_.ends(contact.edge)[0] == from ? share : 1.0 - share;
        return Step::Goes;
    }

    const S& surface_;
    ContactCounters& counters_;
    std::uint32_t steps_;
    std::optional<Facet> facet_; // where the descent ended within a face
    SurfaceFoot foot_{};
    double vertex_squared_ = std::numeric_limits<double>::infinity();
    int stalls_ = 0;
};

} // namespace marsview
