// The continuous-walk contact model: the limit of infinitely many, infinitely small updates.
//
// Notation. The goal moves straight from g to q. While the proxy rests on a feature, its position
// is the foot of the goal on that feature. Every condition for resting there is linear in the goal:
// if it holds at both ends of the path, it holds everywhere on it; otherwise it ends at the
// fraction of the path where its value is zero. This is an event. The earliest event determines
// where the proxy continues:
// - from a face, over an edge: in a valley the proxy stays on the edge, over a flat edge it
//   continues on the next face, over a ridge its minimum has become unstable;
// - from a valley's edge, to one of its ends or into one of its faces;
// - from a vertex, to the edge that first leads closer; it can only be a valley;
// - from a face below a goal that rises through its plane, into free space.
// An unstable proxy falls, at once and while the goal rests, down the steepest way to another
// minimum. The fall begins slightly beyond the event, where the branch that the goal's motion takes
// can be distinguished from the others.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/facet_steps.h"
#include "core/contact/steepest_descent.h"
#include "core/contact/surface_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

/// Keeps a proxy, which cannot pass through a surface, at a local minimum of the distance to a goal
/// that moves straight from one update's position to the next: the limit of cutting the motion into
/// ever smaller updates. It differs from that limit only where rounding decides the outcome.
///
/// While the goal does not move, neither does the proxy. Its position is computed from its feature
/// and the goal, so nothing drifts.
template <ContactSurface S>
class ContinuousWalk : public SurfaceProxy<ContinuousWalk<S>, S> {
    using Base = SurfaceProxy<ContinuousWalk, S>;
    friend Base;

public:
    /// The proxy begins at S::initialContact(); the first update places it.
    explicit ContinuousWalk(S surface) noexcept
        : Base(std::move(surface))
        , contact_(surface_.initialContact())
    {}

    /// As PointProxy::setSurface. A proxy in contact descends again in the next update.
    void setSurface(S surface) noexcept
    {
        surface_ = std::move(surface);
        is_known_ = false;
        if (!Base::isPlaced()) {
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

    /// Where the proxy touches; empty while it is free.
    std::optional<SurfaceContact<S>> contact() const noexcept
    {
        return is_free_ ? std::nullopt : std::optional(contact_);
    }

private:
    using Goal = typename S::Goal;
    using Vertex = typename S::Vertex;
    using Edge = typename S::Edge;
    using Face = typename S::Face;
    using Facet = typename S::Facet;
    using Contact = SurfaceContact<S>;
    using Steps = FacetSteps<S>;
    using Descent = SteepestDescent<S>;
    using Base::counters_;
    using Base::surface_;

    // A fall begins this fraction of an edge beyond its event, in motion of the goal.
    static constexpr double kNudge = 1e-9;
    // After this many consecutive events that are equal to rounding, the goal is nudged ahead,
    // twice as far each time, and the proxy falls.
    static constexpr int kStillMax = 24;
    static constexpr double kStill = 1e-11; // of the leg

    // The earliest of the events before the end of a leg: where a value that must not be positive
    // becomes positive, or already is. The values are given at both ends of the leg, which are
    // known before the position of the last event: the processor can start on the next event before
    // it has finished the last.
    class Event {
    public:
        void consider(double at_begin, double at_end, int index) noexcept
        {
            if (at_end > 0.0) {
                const double held = std::max(-at_begin, 0.0);
                if (which < 0 || held * end_ < held_ * at_end) {
                    held_ = held;
                    end_ = at_end;
                    which = index;
                }
            }
        }
        // The fraction of the leg, not before `at`.
        double share(double at) const noexcept { return std::max(held_ / (held_ + end_), at); }

        int which = -1;

    private:
        double held_ = 0.0;
        double end_ = 1.0;
    };

    void placeAt(const Goal& goal, const ScenePoint& aimed) noexcept
    {
        is_at_rest_ = true;
        is_known_ = false;
        aimed_ = aimed;
        goal_ = goal;
        is_free_ = surface_.isAbove(goal);
        if (!is_free_) {
            contact_ = surface_.contactAt(goal);
            descend();
        }
    }

    void moveTo(const Goal& goal, const ScenePoint& aimed) noexcept
    {
        events_ = surface_.stepsMax();
        if (!std::exchange(is_at_rest_, true)) {
            descend(); // to where the goal was
        }
        // Goals that need no clamping are joined by a single leg.
        if (surface_.goalPoint(goal_) == aimed_ && surface_.goalPoint(goal) == aimed) {
            follow(goal);
        } else {
            const SurfaceLegs<S> legs = surface_.legs(aimed_, aimed);
            for (std::size_t i = 0; i < legs.count; ++i) {
                follow(legs.ends[i]);
            }
        }
        aimed_ = aimed;
    }

    ContactFeature feature() const noexcept
    {
        return is_free_ ? ContactFeature::Free : contact_.feature;
    }
    ScenePoint position() const noexcept
    {
        return is_free_ ? surface_.goalPoint(goal_) : surface_.point(contact_);
    }

    Facet& left() noexcept { return facets_[left_at_]; }
    Facet& right() noexcept { return facets_[1 - left_at_]; }

    void descend() noexcept
    {
        is_known_ = false;
        is_free_ = Descent(surface_, counters_).descend(contact_, goal_);
    }

    // Moves the goal to `end`.
    void follow(const Goal& end) noexcept
    {
        begin_ = goal_;
        at_ = 0.0;
        nudge_ = 0.0;
        still_ = 0;
        while (true) {
            if (is_free_) {
                ++counters_.casts;
                locateGoal(end);
                if (!take(surface_.castFree(goal_, end), end)) {
                    return;
                }
            }
            const bool is_done = contact_.feature == ContactFeature::Face   ? onFacet(end)
                                 : contact_.feature == ContactFeature::Edge ? onEdge(end)
                                                                            : atVertex(end);
            if (is_done) {
                return;
            }
            if (events_ == 0) {
                // Out of steps: straight to the end, as in the surface walk.
                counters_.cut_short = 1;
                if (is_known_) {
                    locateGoal(end);
                    rest();
                }
                goal_ = end;
                descend();
                return;
            }
            --events_;
        }
    }

    // Applies the result of a cast towards the end of the leg. False if it hit nothing: the goal is
    // there.
    bool take(const SurfaceCast<S>& cast, const Goal& end) noexcept
    {
        counters_.cells += cast.cells;
        is_free_ = !cast.contact;
        if (is_free_) {
            goal_ = end;
            return false;
        }
        contact_ = *cast.contact;
        is_known_ = false;
        // While free, the proxy is where the goal is.
        const ScenePoint from = surface_.goalPoint(begin_);
        const ScenePoint way = surface_.goalPoint(end) - from;
        const double share = dot(surface_.point(contact_) - from, way) / dot(way, way);
        at_ = share > at_ ? std::min(share, 1.0) : at_;
        return true;
    }

    // Leaves the surface over `over`, starting at contact_.
    bool leave(Face over, const Goal& end) noexcept
    {
        ++counters_.casts;
        return !take(surface_.castFrom(contact_, over, end), end);
    }

    // Too many events close together mean that rounding causes an endless loop. The proxy then
    // falls from slightly farther along.
    bool isStuck(double share) noexcept
    {
        still_ = share - at_ > kStill ? 0 : still_ + 1;
        return still_ > kStillMax;
    }

    void locateGoal(const Goal& end) noexcept { goal_ = surface_.along(begin_, end, at_); }

    // Moves the goal to that fraction of the leg and slightly farther. `edge` is a nearby edge.
    void advanceBeyond(double share, const Vec3& edge, const Goal& end) noexcept
    {
        if (nudge_ == 0.0) {
            const ScenePoint way = surface_.goalPoint(end) - surface_.goalPoint(begin_);
            const double squared = dot(way, way);
            nudge_ = squared > 0.0 ? kNudge * std::sqrt(dot(edge, edge) / squared) : 1.0;
        }
        at_ = std::min(share + nudge_, 1.0);
        locateGoal(end);
    }

    // Falls from contact_, from farther on each time.
    void unstick(double share, const Vec3& edge, const Goal& end) noexcept
    {
        advanceBeyond(share, edge, end);
        nudge_ *= 2.0;
        still_ = 0;
        descend();
    }

    // Each of these follows the goal while the proxy rests on that kind of feature, and over
    // further features of that kind. True if the goal is at the end, at a minimum; otherwise
    // contact_.feature says where to continue: if is_known_, on left() or the edge between left()
    // and right(); else as contact_ says.
    bool onFacet(const Goal& end) noexcept
    {
        constexpr int kRise = 3;
        if (!std::exchange(is_known_, true)) {
            remake(left(), [&] { return surface_.facet(contact_.face, 0); });
        }
        const SurfaceFoot last = left().foot(end);
        if (last.above <= 0.0 && last.isInside()) {
            goal_ = end;
            return settleOnFacet(last);
        }
        ++counters_.faces;
        const SurfaceFoot first = left().foot(begin_);
        Event event;
        event.consider(-first.weights[0], -last.weights[0], 0);
        event.consider(-first.weights[1], -last.weights[1], 1);
        event.consider(-first.weights[2], -last.weights[2], 2);
        if (last.above > 0.0) {
            const Event over_edge = event;
            event.consider(first.above, last.above, kRise);
            if (event.which == kRise) {
                const double share = event.share(at_);
                restOnFacet(footBetween(first, last, share));
                if (const auto over = surface_.wayOut(contact_, end)) {
                    at_ = share;
                    return leave(*over, end);
                }
                // Above the plane only by rounding error.
                event = over_edge;
                if (event.which < 0) {
                    goal_ = end;
                    return settleOnFacet(last);
                }
            }
        }
        // The foot reaches the edge opposite that corner.
        switch (event.which) {
        case 0:
            return crossTo<0>(event.share(at_), first, last, end);
        case 1:
            return crossTo<1>(event.share(at_), first, last, end);
        default:
            return crossTo<2>(event.share(at_), first, last, end);
        }
    }

    // The rest is purely geometric.
    template <std::size_t kCorner>
    bool crossTo(double share,
                 const SurfaceFoot& first,
                 const SurfaceFoot& last,
                 const Goal& end) noexcept
    {
        constexpr std::size_t kJ = (kCorner + 1) % 3;
        constexpr std::size_t kK = (kCorner + 2) % 3;
        const bool is_stuck = isStuck(share);
        const bool has_beyond = surface_.hasBeyond(left(), kCorner);
        if (has_beyond) {
            remake(right(), [&] { return surface_.beyond(left(), kCorner); });
        }
        const int bend = has_beyond         ? surface_.bend(left(), kCorner, right())
                         : S::kIsBorderWall ? 1
                                            : -1;
        if (bend > 0 && !is_stuck) {
            at_ = share;
            left_corner_ = kCorner;
            has_right_ = has_beyond;
            contact_.feature = ContactFeature::Edge;
            return alongEdge(last, end);
        }
        if (bend == 0 && !is_stuck) {
            at_ = share;
            left_at_ = 1 - left_at_;
            return false;
        }
        // A ridge: the proxy falls from where the foot is on the edge.
        const auto weight_of = [&](std::size_t corner) {
            return std::max(first.weights[corner] +
                                share * (last.weights[corner] - first.weights[corner]),
                            0.0);
        };
        const double at_k = weight_of(kK);
        const double sum = weight_of(kJ) + at_k;
        const double to_k = sum > 0.0 ? at_k / sum : 0.5;
        const Vec3 edge = surface_.between(left(), kJ, kK);
        if (is_stuck || !has_beyond) {
            restOnEdge(left().vertices[kJ], left().vertices[kK], to_k);
            unstick(share, edge, end);
            return false;
        }
        advanceBeyond(share, edge, end);
        Descent descent(surface_, counters_);
        is_free_ = descent.descendOver(contact_, right(), 1.0 - to_k, goal_);
        is_known_ = descent.facet().has_value();
        if (is_known_) {
            left() = *descent.facet();
            contact_.feature = ContactFeature::Face;
        }
        return false;
    }

    bool onEdge(const Goal& end) noexcept
    {
        if (!std::exchange(is_known_, true)) {
            const SurfaceEdgeFacets<S> facets = surface_.edgeFacets(contact_.edge);
            left() = facets.left;
            left_corner_ = 0;
            right() = facets.right;
            has_right_ = facets.has_right;
        }
        return alongEdge(left().foot(end), end);
    }

    // On the edge between left() and right(); `last_left` is the foot of `end` on left().
    bool alongEdge(const SurfaceFoot& last_left, const Goal& end) noexcept
    {
        constexpr int kToRight = 1;
        constexpr int kToFrom = 2;
        constexpr int kToTo = 3;
        const std::size_t from_corner = (left_corner_ + 1) % 3;
        const std::size_t to_corner = (left_corner_ + 2) % 3;
        const Vertex from = left().vertices[from_corner];
        const Vertex to = left().vertices[to_corner];
        const Vec3 edge = surface_.between(left(), from_corner, to_corner);
        const double length_squared = dot(edge, edge);
        const double last_along = dot(surface_.toGoal(left(), from_corner, end), edge);
        const SurfaceFoot last_right = has_right_ ? right().foot(end) : SurfaceFoot{};
        const bool is_into_left = Steps::isInward(last_left.weights[left_corner_], left(), end);
        const bool is_into_right =
            has_right_ && Steps::isInward(last_right.weights[0], right(), end);
        if (last_along >= 0.0 && last_along <= length_squared && !is_into_left && !is_into_right) {
            restOnEdge(from, to, last_along / length_squared);
            if (last_left.above > 0.0 || last_right.above > 0.0 || !has_right_) {
                if (const auto over = surface_.wayOut(contact_, end)) {
                    // The goal has passed through the edge itself. The proxy leaves the surface
                    // where the goal's path is nearest to the edge.
                    locateGoal(end);
                    const double at =
                        dot(surface_.toGoal(left(), from_corner, goal_), edge) / length_squared;
                    restOnEdge(from, to, std::clamp(at, 0.0, 1.0));
                    return leave(*over, end);
                }
            }
            goal_ = end;
            return settleOnEdge();
        }
        const double first_along = dot(surface_.toGoal(left(), from_corner, begin_), edge);
        Event event;
        if (is_into_left) {
            event.consider(left().foot(begin_).weights[left_corner_],
                           last_left.weights[left_corner_], 0);
        }
        if (is_into_right) {
            event.consider(right().foot(begin_).weights[0], last_right.weights[0], kToRight);
        }
        event.consider(-first_along, -last_along, kToFrom);
        event.consider(first_along - length_squared, last_along - length_squared, kToTo);
        const double share = event.share(at_);
        if (isStuck(share)) {
            const double at = first_along + share * (last_along - first_along);
            restOnEdge(from, to, std::clamp(at / length_squared, 0.0, 1.0));
            unstick(share, edge, end);
            return false;
        }
        at_ = share;
        if (event.which == kToFrom || event.which == kToTo) {
            contact_.feature = ContactFeature::Vertex;
            contact_.vertex = event.which == kToFrom ? from : to;
            return arriveAtVertex(edge, end);
        }
        if (event.which == kToRight) {
            left_at_ = 1 - left_at_;
        }
        contact_.feature = ContactFeature::Face;
        return false;
    }

    // Sets contact_ from the known feature of a proxy at rest.
    void rest() noexcept
    {
        if (contact_.feature == ContactFeature::Face) {
            restOnFacet(left().foot(goal_));
        } else if (contact_.feature == ContactFeature::Edge) {
            const Vertex from = left().vertices[(left_corner_ + 1) % 3];
            const Vertex to = left().vertices[(left_corner_ + 2) % 3];
            const Vec3 edge = surface_.between(from, to);
            const double along = dot(surface_.toGoal(from, goal_), edge);
            restOnEdge(from, to, std::clamp(along / dot(edge, edge), 0.0, 1.0));
        }
    }

    void restOnEdge(Vertex from, Vertex to, double share) noexcept
    {
        Steps::restOnEdge(surface_, contact_, from, to, share);
    }

    // The foot is inside left(), but for rounding.
    void restOnFacet(const SurfaceFoot& foot) noexcept
    {
        contact_.feature = ContactFeature::Face;
        contact_.face = surface_.faceOf(left());
        contact_.weights = Steps::weightsOnFace(surface_, contact_.face, left(), foot);
    }

    // Along an edge: the vertex at its end may not be a minimum, if the valley continues downward.
    bool arriveAtVertex(const Vec3& edge, const Goal& end) noexcept
    {
        const auto fan = surface_.fan(contact_.vertex);
        locateGoal(end);
        const Vec3 to_goal = surface_.toGoal(fan, goal_);
        const double squared = dot(to_goal, to_goal);
        bool is_minimum = true;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            is_minimum = is_minimum && !Steps::leads(dot(to_goal, spoke.along),
                                                     dot(spoke.along, spoke.along), squared);
        });
        if (is_minimum) {
            return restAtVertex(fan, end);
        }
        ++counters_.vertices;
        advanceBeyond(at_, edge, end);
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
        is_known_ = false;
        const Vec3 last = surface_.toGoal(fan, end);
        const double last_squared = dot(last, last);
        const Vec3 first = surface_.toGoal(fan, begin_);
        Event event;
        SurfaceSpoke<S> towards{};
        bool pulls = false;
        surface_.eachSpoke(fan, [&](const SurfaceSpoke<S>& spoke) {
            const double at_end = dot(last, spoke.along);
            pulls = pulls || at_end > 0.0;
            if (Steps::leads(at_end, dot(spoke.along, spoke.along), last_squared)) {
                const Event before = event;
                event.consider(dot(first, spoke.along), at_end, before.which + 1);
                if (event.which != before.which) {
                    towards = spoke;
                }
            }
        });
        if (event.which < 0) {
            if (const auto over = surface_.wayOut(fan, end)) {
                return leave(*over, end);
            }
            goal_ = end;
            if (pulls) {
                descend(); // between two edges of a sliver a path may lead closer than along either
            }
            return true;
        }
        const double share = event.share(at_);
        if (isStuck(share)) {
            unstick(share, towards.along, end);
            return false;
        }
        at_ = share;
        contact_.edge = surface_.edgeBetween(contact_.vertex, towards.end);
        contact_.feature = ContactFeature::Edge;
        return false;
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

    // The end of an update: sets contact_. A position within rounding of its feature's border may
    // not be a minimum; one last descent starts from there.
    bool settleOnFacet(const SurfaceFoot& foot) noexcept
    {
        const auto& [first, second, third] = foot.weights;
        restOnFacet(foot);
        if (!Steps::isInward(std::min({first, second, third}), left(), goal_)) {
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

    Goal goal_{};        // reached so far
    ScenePoint aimed_{}; // the last requested goal, before it was clamped to the map
    Contact contact_;    // while not free
    bool is_free_ = false;
    bool is_at_rest_ = true; // at a minimum of the distance to goal_
    // Of the current leg:
    std::uint32_t events_ = 0; // remaining in this update
    Goal begin_{};
    double at_ = 0.0;    // the goal's fraction of the leg
    double nudge_ = 0.0; // the next one; 0: not yet known
    int still_ = 0;      // events in a row that did not move the goal
    // If is_known_, also from one update to the next, the face or, with the edge opposite
    // left_corner_, the faces of the contact.
    bool is_known_ = false;
    bool has_right_ = false;
    std::size_t left_corner_ = 0;
    std::size_t left_at_ = 0; // in facets_; copying would cost more than an event
    std::array<Facet, 2> facets_{};
};

} // namespace marsview
