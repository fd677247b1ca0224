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

    bool onFace(const Goal& end) noexcept
    {
        const Face face = contact_.face;
        const auto plane = surface_.facePlane(face);
        const SurfaceFoot last = plane.foot(end);
        if (last.above <= 0.0 && last.isInside()) {
            goal_ = end;
            return settleOnFace(plane, last);
        }
        ++counters_.faces;
        const SurfaceFoot first = plane.foot(goal_);
        Event event;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            event.consider(-first.weights[k], -last.weights[k], i);
        }
        constexpr int kRise = 3;
        event.consider(first.above, last.above, kRise);
        const auto weights = weightsBetween(first, last, event.share);
        if (event.which == kRise) {
            contact_.weights = weights;
            if (const auto over = surface_.wayOut(contact_, end)) {
                advance(event.share, end);
                return leave(*over, end);
            }
            // Above the plane by no more than rounding.
            if (last.isInside()) {
                goal_ = end;
                return settleOnFace(plane, last);
            }
            event = {};
            for (int i = 0; i < 3; ++i) {
                const auto k = static_cast<std::size_t>(i);
                event.consider(-first.weights[k], -last.weights[k], i);
            }
        }
        const bool is_stuck = isStuckAt(event, end);
        return cross(face, event.which, weightsBetween(first, last, event.share), is_stuck, end);
    }

    // The foot has reached the edge of the face opposite `corner`.
    bool cross(Face face,
               int corner,
               const std::array<double, 3>& weights,
               bool is_stuck,
               const Goal& end) noexcept
    {
        const auto i = static_cast<std::size_t>(corner);
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        const double sum = weights[j] + weights[k];
        const double share = sum > 0.0 ? weights[k] / sum : 0.5; // from corner j to corner k
        const Edge edge = surface_.edgeOf(face, corner);
        const auto wing = surface_.across(face, corner);
        const int bend = surface_.bend(edge);
        if (bend > 0 && !is_stuck) {
            contact_.feature = ContactFeature::Edge;
            contact_.edge = edge;
            return false;
        }
        if (bend == 0 && wing && !is_stuck) {
            contact_.feature = ContactFeature::Face;
            contact_.face = wing->face;
            return false;
        }
        // A ridge.
        const auto corners = surface_.corners(face);
        const Vec3 along = surface_.between(corners[j], corners[k]);
        if (is_stuck) {
            nudge_ *= 2.0;
            still_ = 0;
        }
        nudge(dot(along, along), end);
        if (wing && !is_stuck) {
            const auto there = static_cast<std::size_t>(wing->corner);
            std::array<double, 3> at{};
            at[(there + 1) % 3] = share;
            at[(there + 2) % 3] = 1.0 - share;
            is_free_ = Descent(surface_, counters_).descendInto(contact_, wing->face, at, goal_);
            return false;
        }
        contact_.feature = ContactFeature::Edge;
        contact_.edge = edge;
        contact_.along = surface_.ends(edge)[0] == corners[j] ? share : 1.0 - share;
        descend();
        return false;
    }

    bool onEdge(const Goal& end) noexcept
    {
        const auto [from, to] = surface_.ends(contact_.edge);
        const Vec3 edge = surface_.between(from, to);
        const double length_squared = dot(edge, edge);
        const double last_along = dot(surface_.toGoal(from, end), edge);
        const auto wings = surface_.wings(contact_.edge);
        std::array<SurfaceFoot, 2> last{};
        std::array<double, 2> errors{};
        bool is_within = last_along >= 0.0 && last_along <= length_squared;
        for (std::size_t w = 0; w < 2; ++w) {
            if (wings[w]) {
                const auto plane = surface_.facePlane(wings[w]->face);
                last[w] = plane.foot(end);
                const double weight = last[w].weights[static_cast<std::size_t>(wings[w]->corner)];
                if (weight > 0.0) {
                    errors[w] = std::max(Descent::kShareMin * plane.scale, plane.error(end));
                    is_within = is_within && weight <= errors[w];
                }
            }
        }
        if (is_within) {
            contact_.along = last_along / length_squared;
            if (const auto over = surface_.wayOut(contact_, end)) {
                return leaveFromEdge(*over, from, edge, end);
            }
            goal_ = end;
            return settleOnEdge();
        }
        constexpr int kToFrom = 2;
        constexpr int kToTo = 3;
        const double first_along = dot(surface_.toGoal(from, goal_), edge);
        Event event;
        for (std::size_t w = 0; w < 2; ++w) {
            if (wings[w]) {
                const auto corner = static_cast<std::size_t>(wings[w]->corner);
                if (last[w].weights[corner] > errors[w]) {
                    const auto first = surface_.facePlane(wings[w]->face).foot(goal_);
                    event.consider(first.weights[corner], last[w].weights[corner],
                                   static_cast<int>(w));
                }
            }
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
        } else {
            contact_.along = std::clamp((first_along + event.share * (last_along - first_along)) /
                                            length_squared,
                                        0.0, 1.0);
            if (!is_stuck) {
                contact_.feature = ContactFeature::Face;
                contact_.face = wings[static_cast<std::size_t>(event.which)]->face;
            }
        }
        if (is_stuck) {
            unstick(length_squared, end);
        }
        return false;
    }

    // The goal has passed through the edge itself.
    bool leaveFromEdge(Face over, Vertex from, const Vec3& edge, const Goal& end) noexcept
    {
        // It was nearest to the edge somewhere on its way: there it lets go.
        const Vec3 at = surface_.toGoal(from, goal_);
        contact_.along = std::clamp(dot(at, edge) / dot(edge, edge), 0.0, 1.0);
        return leave(over, end);
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

    static std::array<double, 3>
    weightsBetween(const SurfaceFoot& first, const SurfaceFoot& last, double share) noexcept
    {
        std::array<double, 3> weights{};
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            weights[i] =
                std::max(first.weights[i] + share * (last.weights[i] - first.weights[i]), 0.0);
            sum += weights[i];
        }
        for (double& weight : weights) {
            weight /= sum;
        }
        return weights;
    }

    // The end of an update: the contact is told where it is. What lies within rounding of the
    // border of its feature may not be a minimum; from there one last descent is made.
    template <typename Plane>
    bool settleOnFace(const Plane& plane, const SurfaceFoot& foot) noexcept
    {
        const double sum = foot.weights[0] + foot.weights[1] + foot.weights[2];
        const double inverse = 1.0 / sum;
        contact_.weights = {foot.weights[0] * inverse, foot.weights[1] * inverse,
                            foot.weights[2] * inverse};
        constexpr double kClearly = 1e-6;
        const double least =
            std::min({contact_.weights[0], contact_.weights[1], contact_.weights[2]});
        if (least < kClearly &&
            least * plane.scale <= std::max(Descent::kShareMin * plane.scale, plane.error(goal_))) {
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
