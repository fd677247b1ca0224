// The steps of descents over a mesh, and their thresholds for rounding error.
#pragma once

#include "core/contact/contact_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

namespace marsview {

/// A position closer to the end of an edge than this fraction is at the vertex: another face or
/// edge may lead on from there, which would not be found from next to it.
inline constexpr double kEdgeShareMin = 1e-12;
/// An edge leads closer to the goal from a vertex if the cosine between its direction and the
/// goal's is more than this.
inline constexpr double kEdgeCosineMin = 1e-13;

/// `place` becomes make(), which is built there. Copying a large facet that has just been written,
/// two numbers at a time, waits for each of them.
template <typename T, typename F>
void remake(T& place, F&& make) noexcept
{
    static_assert(std::is_trivially_destructible_v<T>);
    ::new (static_cast<void*>(&place)) T(make());
}

/// Free functions over one kind of surface. Real-time safe.
template <ContactSurface S>
struct FacetSteps {
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Face = typename S::Face;
    using Facet = typename S::Facet;
    using Contact = SurfaceContact<S>;
    using Weights = std::array<double, 3>; // of a face's corners

    /// Whether a foot of that weight is inside the edge opposite, by more than rounding error. Seen
    /// from the next face, the same number shows that the path into this one leads closer.
    static bool isInward(double weight, const Facet& facet, const Goal& goal) noexcept
    {
        constexpr double kClearly = 1e-6; // of the scale: far more than any rounding error
        return weight > kClearly * facet.scale ||
               (weight > 0.0 && weight > std::max(kEdgeShareMin * facet.scale, facet.error(goal)));
    }

    /// Whether an edge `along` leads closer from its beginning, by more than rounding error.
    static bool leads(double towards, double length_squared, double goal_squared) noexcept
    {
        return towards > kEdgeShareMin * length_squared &&
               towards * towards > kEdgeCosineMin * kEdgeCosineMin * goal_squared * length_squared;
    }

    /// A position within this fraction of an edge from its end is at the vertex, for a goal at that
    /// distance from it. Half the threshold of leads(), so that the two cannot contradict each
    /// other.
    static double endShare(double goal_squared, double length_squared) noexcept
    {
        return 0.5 *
               std::max(kEdgeShareMin, kEdgeCosineMin * std::sqrt(goal_squared / length_squared));
    }

    /// The edge of a vertex that leads closer fastest (the paper's least edge gradient).
    struct Steepest {
        SurfaceSpoke<S> spoke{};
        double towards = 0.0; // dot product with the vector to the goal; 0: no edge leads closer
        double length_squared = 1.0;
        bool pulls = false; // an edge leads closer, possibly only by rounding
    };
    static Steepest steepestSpoke(const S& surface,
                                  const typename S::Fan& fan,
                                  const Vec3& to_goal,
                                  double goal_squared) noexcept
    {
        Steepest steepest;
        surface.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double towards = dot(to_goal, spoke.along);
            const double length_squared = dot(spoke.along, spoke.along);
            steepest.pulls = steepest.pulls || towards > 0.0;
            if (towards * towards * steepest.length_squared >
                    steepest.towards * steepest.towards * length_squared &&
                leads(towards, length_squared, goal_squared)) {
                steepest = {spoke, towards, length_squared, true};
            }
        });
        return steepest;
    }

    /// The weights of a face's corners at a foot, with negative weights clamped to 0.
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

    /// The position of a foot inside a facet.
    static Contact contactOn(const S& surface, const Facet& facet, const SurfaceFoot& foot) noexcept
    {
        const Face face = surface.faceOf(facet);
        return contactOnFace(surface, face, weightsOnFace(surface, face, facet, foot));
    }
    /// The same; a foot within rounding error of an edge is put on the edge.
    static Contact contactOnOrBeside(const S& surface,
                                     const Facet& facet,
                                     SurfaceFoot foot,
                                     const Goal& goal) noexcept
    {
        for (double& weight : foot.weights) {
            weight = isInward(weight, facet, goal) ? weight : 0.0;
        }
        return contactOn(surface, facet, foot);
    }
    static void
    restOnEdge(const S& surface, Contact& contact, Vertex from, Vertex to, double share) noexcept
    {
        contact.feature = ContactFeature::Edge;
        contact.edge = surface.edgeBetween(from, to);
        contact.along = surface.ends(contact.edge)[0] == from ? share : 1.0 - share;
    }
    static void restOnVertex(Contact& contact, Vertex vertex) noexcept
    {
        contact.feature = ContactFeature::Vertex;
        contact.vertex = vertex;
    }

    /// Where the straight path from a position on a facet to a foot outside leaves it: over the
    /// edge opposite `corner`, at the fraction `share` from the corner after it to the one before
    /// it.
    struct Exit {
        std::size_t corner;
        double share;
    };
    static Exit exitFrom(const Facet& facet, const Weights& at, const SurfaceFoot& foot) noexcept
    {
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
        const auto weight_at = [&](std::size_t corner) {
            const double begin = at[corner] * facet.scale;
            return begin + earliest * (foot.weights[corner] - begin);
        };
        const double before = weight_at((i + 2) % 3);
        return {i, before / (before + weight_at((i + 1) % 3))};
    }

    /// The same from a position on the edge opposite the first corner, at the fraction `share` from
    /// the second corner to the third, to a foot on the inner side of it: over one of the edges
    /// that meet in the first corner, the one to the third or to the second.
    struct ExitAhead {
        bool is_to_third;
        double share; // from that corner to the first one
    };
    static ExitAhead exitAhead(double share, const SurfaceFoot& foot) noexcept
    {
        const auto& [ahead, second, third] = foot.weights;
        // The sign gives the side on which the path passes the first corner.
        const double side = (1.0 - share) * third - share * second;
        const bool is_to_third = side >= 0.0;
        const double of_first = (is_to_third ? 1.0 - share : share) * ahead;
        return {is_to_third, of_first / (of_first + std::abs(side))};
    }

    static bool isWithinEdge(double share) noexcept
    {
        return share > kEdgeShareMin && share < 1.0 - kEdgeShareMin;
    }
};

} // namespace marsview
