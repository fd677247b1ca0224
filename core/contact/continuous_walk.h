// The continuous-walk contact model: what infinitely many infinitely small updates would do.
//
// Notation. The goal moves straight from g to q. While the proxy rests on a feature, its place is
// the foot of the goal on that feature, and every condition under which it rests there is a number
// that is linear in the goal: it holds all the way where it holds at both ends; otherwise it ends
// at the share of the way where the number is zero, an event. The earliest event tells where the
// proxy goes on:
// - from a face, over an edge: in a valley the proxy stays on the edge, over a flat one it goes on
//   to the next face, over a ridge its minimum has become unstable;
// - from a valley's edge, to one of its ends or into one of its faces;
// - from a vertex, to the edge that first leads closer; it can only be a valley;
// - from a face below a goal that rises through its plane, into free space.
// An unstable proxy falls, at once and while the goal rests, down the steepest way to another
// minimum. It does so a little beyond the event, where the branch that the goal's motion takes can
// be told from the others.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/steepest_descent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

/// Holds a proxy that cannot pass through a surface, at a local minimum of the distance to a goal
/// that moves straight from each update's place to the next: the limit of cutting the motion into
/// ever smaller updates. Differs from that limit only where its outcome hangs on rounding.
///
/// Where the goal stays put, so does the proxy. Its place is computed from the feature it is on and
/// the goal, so nothing drifts.
///
/// A value, for one thread at a time. `update` and `place` allocate, lock and throw nothing and are
/// bounded by S::stepsMax(): they are for the servo thread.
template <ContactSurface S>
class ContinuousWalk {
public:
    /// The proxy begins at S::initialContact(); the first update places it.
    explicit ContinuousWalk(S surface) noexcept
        : surface_(std::move(surface))
        , contact_(surface_.initialContact())
    {}

    const S& surface() const noexcept { return surface_; }

    /// As PointProxy::setSurface. A proxy in contact descends anew in the next update.
    void setSurface(S surface) noexcept
    {
        surface_ = std::move(surface);
        if (!is_placed_) {
            return;
        }
        if (const auto g = surface_.goal(aimed_)) {
            goal_ = *g;
            if (is_free_ && !surface_.isAbove(goal_)) {
                is_free_ = false;
                contact_ = surface_.contactAt(goal_);
            }
        }
        is_at_rest_ = is_free_;
    }

    /// As PointProxy::place.
    ContactState place(const ScenePoint& goal) noexcept
    {
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            is_placed_ = true;
            is_at_rest_ = true;
            aimed_ = goal;
            goal_ = *g;
            is_free_ = surface_.isAbove(goal_);
            if (!is_free_) {
                contact_ = surface_.contactAt(goal_);
                descend();
            }
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// As PointProxy::update.
    ContactState update(const ScenePoint& goal) noexcept
    {
        if (!is_placed_) {
            return place(goal);
        }
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            events_ = surface_.stepsMax();
            if (!std::exchange(is_at_rest_, true)) {
                descend(); // to where the goal was
            }
            // Between goals that are aimed at as they are, there is but one leg.
            if (surface_.goalPoint(goal_) == aimed_ && surface_.goalPoint(*g) == goal) {
                follow(*g);
            } else {
                const SurfaceLegs<S> legs = surface_.legs(aimed_, goal);
                for (std::size_t i = 0; i < legs.count; ++i) {
                    follow(legs.ends[i]);
                }
            }
            aimed_ = goal;
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// Where the proxy touches; nothing while it is free.
    std::optional<SurfaceContact<S>> contact() const noexcept
    {
        return is_free_ ? std::nullopt : std::optional(contact_);
    }

    /// Where the proxy is, with the counters of the last update.
    ContactState state() const noexcept
    {
        ContactState state;
        state.is_in_contact = !is_free_;
        state.feature = is_free_ ? ContactFeature::Free : contact_.feature;
        state.proxy = is_free_ ? surface_.goalPoint(goal_) : surface_.point(contact_);
        state.counters = counters_;
        return state;
    }

private:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Facet = typename S::Facet;
    using Contact = SurfaceContact<S>;
    using Descent = SteepestDescent<S>;

    // A fall begins that much of the edge it falls from beyond the event, in motion of the goal.
    static constexpr double kNudge = 1e-9;
    // After so many events in a row that are no more than rounding apart, the goal is nudged on,
    // twice as far each time, and the proxy falls.
    static constexpr int kStillMax = 24;
    static constexpr double kStill = 1e-11; // of the leg

    // The earliest of the events before the end of a leg.
    struct Event {
        double share = std::numeric_limits<double>::infinity(); // of the way from goal_ to the end
        int which = -1;

        // A condition holds while the number is not positive.
        void consider(double begin, double end, int index) noexcept
        {
            if (end > 0.0) {
                const double held = std::max(-begin, 0.0);
                const double at = held / (held + end);
                if (at < share) {
                    share = at;
                    which = index;
                }
            }
        }
    };

    void descend() noexcept { is_free_ = Descent(surface_, counters_).descend(contact_, goal_); }

    // Moves the goal to `end`.
    void follow(const Goal& end) noexcept
    {
        const ScenePoint way = surface_.goalPoint(end) - surface_.goalPoint(goal_);
        leg_squared_ = dot(way, way);
        still_ = 0;
        nudge_ = kNudge;
        while (true) {
            if (is_free_) {
                ++counters_.casts;
                const SurfaceCast<S> cast = surface_.castFree(goal_, end);
                if (!take(cast, end)) {
                    return;
                }
            }
            const bool is_done = contact_.feature == ContactFeature::Face     ? onFace(end)
                                 : contact_.feature == ContactFeature::Vertex ? atVertex(end)
                                                                              : onEdge(end);
            if (is_done) {
                return;
            }
            if (events_ == 0) {
                // Out of steps: straight to the end, as the surface walk.
                counters_.cut_short = 1;
                goal_ = end;
                descend();
                return;
            }
            --events_;
        }
    }

    // What a cast towards the end of the leg met. False where it met nothing: the goal is there.
    bool take(const SurfaceCast<S>& cast, const Goal& end) noexcept
    {
        counters_.cells += cast.cells;
        is_free_ = !cast.contact;
        if (is_free_) {
            goal_ = end;
            return false;
        }
        contact_ = *cast.contact;
        // While free, the proxy is where the goal is.
        const ScenePoint from = surface_.goalPoint(goal_);
        const ScenePoint way = surface_.goalPoint(end) - from;
        const double squared = dot(way, way);
        const double share = dot(surface_.point(contact_) - from, way) / squared;
        advance(share > 0.0 ? std::min(share, 1.0) : 0.0, end);
        return true;
    }

    // Lets go of the surface over `over`; contact_ is where.
    bool leave(Face over, const Goal& end) noexcept
    {
        ++counters_.casts;
        return !take(surface_.castFrom(contact_, over, end), end);
    }

    void advance(double share, const Goal& end) noexcept
    {
        goal_ = surface_.along(goal_, end, share);
    }

    // The goal goes on to an event. Where too many of them are too close to each other, rounding
    // goes around in circles: then the proxy falls from a little farther on, and true is returned.
    bool isStuckAt(const Event& event, const Goal& end) noexcept
    {
        advance(event.share, end);
        if (event.share > kStill) {
            still_ = 0;
            return false;
        }
        return ++still_ > kStillMax;
    }

    // Moves the goal on by the share `nudge_` of a length, at most to the end.
    void nudge(double length_squared, const Goal& end) noexcept
    {
        const ScenePoint way = surface_.goalPoint(end) - surface_.goalPoint(goal_);
        const double way_squared = dot(way, way);
        const double share =
            way_squared > 0.0 ? nudge_ * std::sqrt(length_squared / way_squared) : 1.0;
        advance(share, end);
    }

    void unstick(double length_squared, const Goal& end) noexcept
    {
        nudge_ *= 2.0;
        still_ = 0;
        nudge(length_squared, end);
        descend();
    }

    bool onFace(const Goal& end) noexcept { return onFacet(surface_.facet(contact_.face, 0), end); }

    bool onEdge(const Goal& end) noexcept
    {
        const auto wings = surface_.wings(contact_.edge);
        const auto facetOf = [this](const SurfaceWing<S>& wing) {
            return surface_.facet(wing.face, static_cast<std::size_t>(wing.corner));
        };
        if (wings[0] && wings[1]) {
            return onEdge(facetOf(*wings[0]), facetOf(*wings[1]), end);
        }
        return onEdge(facetOf(wings[0] ? *wings[0] : *wings[1]), std::nullopt, end);
    }

    // Each of these follows the goal while the proxy rests on that kind of feature, and over as
    // many of the kind as it comes to. True where the goal is at the end, at a minimum; otherwise
    // contact_ tells where to go on.
    bool onFacet(Facet facet, const Goal& end) noexcept
    {
        constexpr int kRise = 3;
        while (true) {
            const SurfaceFoot last = facet.foot(end);
            if (last.above <= 0.0 && last.isInside()) {
                goal_ = end;
                return settleOnFacet(facet, last);
            }
            ++counters_.faces;
            const SurfaceFoot first = facet.foot(goal_);
            Event event;
            event.consider(-first.weights[0], -last.weights[0], 0);
            event.consider(-first.weights[1], -last.weights[1], 1);
            event.consider(-first.weights[2], -last.weights[2], 2);
            if (last.above > 0.0) {
                const Event over_edge = event;
                event.consider(first.above, last.above, kRise);
                if (event.which == kRise) {
                    restOnFacet(facet, footBetween(first, last, event.share));
                    if (const auto over = surface_.wayOut(contact_, end)) {
                        advance(event.share, end);
                        return leave(*over, end);
                    }
                    // Above the plane by no more than rounding.
                    event = over_edge;
                    if (event.which < 0) {
                        goal_ = end;
                        return settleOnFacet(facet, last);
                    }
                }
            }
            // The foot reaches the edge opposite that corner.
            const auto i = static_cast<std::size_t>(event.which);
            const bool is_stuck = isStuckAt(event, end);
            const bool has_beyond = surface_.hasBeyond(facet, i);
            const int bend = has_beyond ? surface_.bend(facet, i) : S::kIsBorderWall ? 1 : -1;
            if (bend > 0 && !is_stuck) {
                return onEdge(rotated(facet, i),
                              has_beyond ? std::optional(surface_.beyond(facet, i)) : std::nullopt,
                              end);
            }
            if (bend == 0 && !is_stuck) {
                facet = surface_.beyond(facet, i);
                if (events_ == 0) {
                    restOnFacet(facet, facet.foot(goal_));
                    return false;
                }
                --events_;
                continue;
            }
            // A ridge.
            fall(facet, i, footBetween(first, last, event.share), is_stuck, end);
            return false;
        }
    }

    // Falls from the edge opposite corner i, where `foot` is.
    void fall(const Facet& facet,
              std::size_t i,
              const SurfaceFoot& foot,
              bool is_stuck,
              const Goal& end) noexcept
    {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const Vec3 edge = surface_.between(facet.vertices[j], facet.vertices[k]);
        if (is_stuck) {
            nudge_ *= 2.0;
            still_ = 0;
        }
        nudge(dot(edge, edge), end);
        const double at_j = std::max(foot.weights[j], 0.0);
        const double at_k = std::max(foot.weights[k], 0.0);
        const double share = at_j + at_k > 0.0 ? at_k / (at_j + at_k) : 0.5; // from j to k
        Descent descent(surface_, counters_);
        if (surface_.hasBeyond(facet, i) && !is_stuck) {
            is_free_ = descent.descendOver(contact_, surface_.beyond(facet, i), 1.0 - share, goal_);
            return;
        }
        restOnEdge(facet.vertices[j], facet.vertices[k], share);
        is_free_ = descent.descend(contact_, goal_);
    }

    // The edge is the one opposite the first corner of both facets.
    bool onEdge(const Facet& left, const std::optional<Facet>& right, const Goal& end) noexcept
    {
        constexpr int kToRight = 1;
        constexpr int kToFrom = 2;
        constexpr int kToTo = 3;
        const Vertex from = left.vertices[1];
        const Vertex to = left.vertices[2];
        const Vec3 edge = surface_.between(from, to);
        const double length_squared = dot(edge, edge);
        const double last_along = dot(surface_.toGoal(from, end), edge);
        const double last_left = inward(left, end);
        const double last_right = right ? inward(*right, end) : 0.0;
        if (last_along >= 0.0 && last_along <= length_squared && last_left <= 0.0 &&
            last_right <= 0.0) {
            restOnEdge(from, to, last_along / length_squared);
            if (const auto over = surface_.wayOut(contact_, end)) {
                // The goal has passed through the edge itself. It was nearest to it somewhere on
                // its way: there the proxy lets go.
                const double at = dot(surface_.toGoal(from, goal_), edge) / length_squared;
                restOnEdge(from, to, std::clamp(at, 0.0, 1.0));
                return leave(*over, end);
            }
            goal_ = end;
            return settleOnEdge();
        }
        const double first_along = dot(surface_.toGoal(from, goal_), edge);
        Event event;
        if (last_left > 0.0) {
            event.consider(left.foot(goal_).weights[0], last_left, 0);
        }
        if (last_right > 0.0) {
            event.consider(right->foot(goal_).weights[0], last_right, kToRight);
        }
        event.consider(-first_along, -last_along, kToFrom);
        event.consider(first_along - length_squared, last_along - length_squared, kToTo);
        const bool is_stuck = isStuckAt(event, end);
        if (event.which == kToFrom || event.which == kToTo) {
            contact_.feature = ContactFeature::Vertex;
            contact_.vertex = event.which == kToFrom ? from : to;
            if (!is_stuck) {
                return arriveAtVertex(length_squared, end);
            }
        } else if (!is_stuck) {
            contact_.feature = ContactFeature::Face;
            contact_.face = surface_.faceOf(event.which == kToRight ? *right : left);
        } else {
            const double at = first_along + event.share * (last_along - first_along);
            restOnEdge(from, to, std::clamp(at / length_squared, 0.0, 1.0));
        }
        if (is_stuck) {
            unstick(length_squared, end);
        }
        return false;
    }

    // How far inside the edge opposite the facet's first corner the foot of the goal is, times
    // something; 0 where it is outside, or inside by no more than rounding error.
    static double inward(const Facet& facet, const Goal& goal) noexcept
    {
        const double weight = facet.foot(goal).weights[0];
        return weight > 0.0 && Descent::isInward(weight, facet, goal) ? weight : 0.0;
    }

    Facet rotated(const Facet& facet, std::size_t first) const noexcept
    {
        if (first == 0) {
            return facet;
        }
        return surface_.rotated(facet, first);
    }

    void restOnEdge(Vertex from, Vertex to, double share) noexcept
    {
        contact_.feature = ContactFeature::Edge;
        contact_.edge = surface_.edgeBetween(from, to);
        contact_.along = surface_.ends(contact_.edge)[0] == from ? share : 1.0 - share;
    }

    // The foot is inside the facet, but for rounding.
    void restOnFacet(const Facet& facet, const SurfaceFoot& foot) noexcept
    {
        contact_.feature = ContactFeature::Face;
        contact_.face = surface_.faceOf(facet);
        contact_.weights = Descent::weightsOnFace(surface_, contact_.face, facet, foot);
    }

    // Along an edge: the vertex at its end may be no minimum, where the valley goes on downward.
    bool arriveAtVertex(double length_squared, const Goal& end) noexcept
    {
        const auto fan = surface_.fan(contact_.vertex);
        const Vec3 to_goal = surface_.toGoal(fan, goal_);
        const double squared = dot(to_goal, to_goal);
        bool is_minimum = true;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            is_minimum = is_minimum && !leads(dot(to_goal, spoke.along), spoke.along, squared);
        });
        if (is_minimum) {
            return restAtVertex(fan, end);
        }
        ++counters_.vertices;
        nudge(length_squared, end);
        descend();
        return false;
    }

    bool atVertex(const Goal& end) noexcept
    {
        return restAtVertex(surface_.fan(contact_.vertex), end);
    }

    bool restAtVertex(const typename S::Fan& fan, const Goal& end) noexcept
    {
        ++counters_.vertices;
        const Vec3 first = surface_.toGoal(fan, goal_);
        const Vec3 last = surface_.toGoal(fan, end);
        const double last_squared = dot(last, last);
        Event event;
        Vertex towards{};
        double length_squared = 0.0;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double at_end = dot(last, spoke.along);
            if (leads(at_end, spoke.along, last_squared)) {
                const double share = event.share;
                event.consider(dot(first, spoke.along), at_end, 0);
                if (event.share < share) {
                    towards = spoke.end;
                    length_squared = dot(spoke.along, spoke.along);
                }
            }
        });
        if (event.which < 0) {
            if (const auto over = surface_.wayOut(fan, end)) {
                return leave(*over, end);
            }
            goal_ = end;
            return true;
        }
        if (isStuckAt(event, end)) {
            unstick(length_squared, end);
            return false;
        }
        contact_.edge = surface_.edgeBetween(contact_.vertex, towards);
        contact_.feature = ContactFeature::Edge;
        return false;
    }

    // Whether an edge leads closer, by more than rounding error: as SteepestDescent decides it.
    static bool leads(double towards, const Vec3& along, double goal_squared) noexcept
    {
        if (towards <= 0.0) {
            return false;
        }
        const double length_squared = dot(along, along);
        return towards > Descent::kShareMin * length_squared &&
               towards * towards >
                   Descent::kCosineMin * Descent::kCosineMin * goal_squared * length_squared;
    }

    static SurfaceFoot
    footBetween(const SurfaceFoot& first, const SurfaceFoot& last, double share) noexcept
    {
        const auto between = [share](double a, double b) { return a + share * (b - a); };
        return {{between(first.weights[0], last.weights[0]),
                 between(first.weights[1], last.weights[1]),
                 between(first.weights[2], last.weights[2])},
                between(first.above, last.above)};
    }

    // The end of an update: the contact is told where it is. What lies within rounding of the
    // border of its feature may not be a minimum; from there one last descent is made.
    bool settleOnFacet(const Facet& facet, const SurfaceFoot& foot) noexcept
    {
        const auto& [first, second, third] = foot.weights;
        restOnFacet(facet, foot);
        if (!Descent::isInward(std::min({first, second, third}), facet, goal_)) {
            contact_ = contactOnFace(surface_, contact_.face, contact_.weights);
            descend();
        }
        return true;
    }

    bool settleOnEdge() noexcept
    {
        constexpr double kClearly = 1e-6;
        if (!(contact_.along > kClearly && contact_.along < 1.0 - kClearly)) {
            descend();
        }
        return true;
    }

    S surface_;
    Goal goal_{};        // reached so far
    ScenePoint aimed_{}; // what was last aimed at, before it was clamped to the map
    Contact contact_;    // while not free
    ContactCounters counters_;
    bool is_placed_ = false;
    bool is_free_ = false;
    bool is_at_rest_ = true; // at a minimum of the distance to goal_
    // Of the leg that is followed:
    std::uint32_t events_ = 0; // that it may still take
    double leg_squared_ = 0.0;
    int still_ = 0;
    double nudge_ = kNudge;
};

} // namespace marsview
