// The virtual-proxy contact model (Ruspini, Kolarov and Khatib, "The haptic display of complex
// graphical environments", SIGGRAPH 1997): a sphere that cannot pass through a surface.
//
// The sphere's center moves as a point in configuration space, among obstacles that are the faces,
// edges and vertices grown by its radius. A grown triangle is convex, so:
// - The distance from a triangle is a convex function along any straight path. A sphere that
//   touches it and does not move towards it never enters it on that path.
// - Where the center touches, the grown triangle lies behind one tangent plane, and the free
//   directions are those in front of all tangent planes, a convex cone. The point in it closest to
//   the goal, with one, two or three tangent planes active, is the constrained goal. If that is the
//   center itself, the center is at a local minimum.
// - A face counts as touched if it stops a sweep, not by its distance. A sphere that rolls over a
//   flat edge is within rounding error of the face ahead long before it is above it; there, still
//   next to it, the tangent plane would lean against the motion by the square root of that error.
#pragma once

#include "core/base/check.h"
#include "core/contact/border_walls.h"
#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/faces_near.h"
#include "core/contact/surface_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace marsview {

/// A surface whose vertical is the ellipsoid's normal. Elsewhere it is the z axis of the scene.
template <typename S>
concept SurfaceOnBody = requires(const S& s, const ScenePoint& p)
{
    s.mesh()->highAbove(p);
    verticalAt(s.mesh()->ellipsoid(), p);
    clearanceOver(s, p);
};

/// Within an update the sphere is swept straight to the goal, then from touch to touch to the
/// constrained goals, until none is closer. The reported proxy is its center. It is in contact if
/// the surface keeps it from the goal; the feature is the one nearest to the center.
///
/// The distance of the center from a triangle is never below the radius by more than tolerance();
/// in contact it is not above it by more. The tolerance is 1e-9 of the radius, the square roots of
/// rounding errors in nearly tangent sweeps, plus the resolution of double coordinates. Goals and
/// the center are clamped to the map; the sphere may reach beyond.
///
/// Placing puts the center at the goal if the sphere is free there, otherwise straight above it
/// where the sphere comes to rest from above. The time of an update grows with the number of faces
/// that the sphere covers. Reaching a bound is counted in ContactCounters::cut_short. Counters:
/// `casts` are sweeps, `cells` the nodes and cells visited to find the faces near the path, `faces`
/// the faces tested against the sphere or its sweep, `vertices` tangent planes.
template <ContactSurface S>
class VirtualProxy : public SurfaceProxy<VirtualProxy<S>, S> {
    using Base = SurfaceProxy<VirtualProxy, S>;
    friend Base;

public:
    /// `radius_m` > 0 and finite. The first update places the sphere; until then it is reported at
    /// S::initialContact().
    VirtualProxy(S surface, double radius_m)
        : Base(std::move(surface))
        , walls_(borderWalls(surface_))
        , radius_m_(radius_m)
        , reach_m_(4.0 * radius_m)
    {
        MARSVIEW_CHECK(radius_m > 0.0 && std::isfinite(radius_m));
    }

    double radius() const noexcept { return radius_m_; }

    /// Another surface with the same mesh, such as another exaggeration. In contact, the sphere is
    /// moved straight up or down onto it. A free sphere keeps its scene coordinates; if it would
    /// penetrate the surface, it is lifted straight up until it touches.
    void setSurface(S surface) noexcept
    {
        surface_ = std::move(surface);
        walls_ = borderWalls(surface_);
        if (!Base::isPlaced()) {
            return;
        }
        const ScenePoint before = center_;
        const bool is_in_contact = feature_ != ContactFeature::Free;
        center_ = lifted(is_in_contact ? straightBelow(before) : before);
        if (!(center_ == before)) {
            rest();
        }
    }

    /// In meters, for a center at `p`.
    double tolerance(const ScenePoint& p) const noexcept { return 1e-9 * radius_m_ + ulps(p); }

private:
    using Goal = typename S::Goal;
    using Base::counters_;
    using Base::surface_;

    // No terrain stops the sphere at one position with more tangent planes than this. Further ones
    // are ignored, and the update is cut short.
    static constexpr std::size_t kPlanesMax = 32;
    // Two tangent planes meet in a line if the squared sine between them exceeds this.
    static constexpr double kSineSquaredMin = 1e-26;
    // Fraction of the distance to the goal: rounding errors across a tangent direction.
    static constexpr double kTangentError = 4e-15;
    static constexpr double kSweepError = 2.0 * kTangentError; // larger, so that the two agree
    // A step to a constrained goal is at most this many radii, or rounding errors across it would
    // exceed the tolerance.
    static constexpr double kStepRadii = 1e4;
    static constexpr double kDistanceError = 8e-15; // of the radius
    // A touch at most this far beyond the end of an edge, in radii, is on it: the distance is the
    // same to rounding.
    static constexpr double kBeside = 3e-8;
    // A sweep that moves at most this far, in radii, was stopped where it began.
    static constexpr double kAtOnce = 1e-12;
    // Fraction of the distance to the goal: a constrained goal nearer than this is reached.
    static constexpr double kStill = 1e-9;
    // This many steps of at most lean() times the distance to the goal end an update.
    static constexpr int kLeansMax = 6;
    static constexpr double kSlowRatio = 0.5;
    static constexpr double kLeapRadii = 0.5;
    static constexpr int kTrialSweepsMax = 8;
    static constexpr double kFar = std::numeric_limits<double>::max();
    static constexpr int kStallsMax = 32;
    static constexpr int kPushesMax = 8;
    static constexpr std::uint32_t kLooks = 256; // for a piece of a sweep
    static constexpr std::uint32_t kLooksAll = std::numeric_limits<std::uint32_t>::max();

    struct Nearest {
        Vec3 to; // from the center
        double squared;
        ContactFeature feature;
    };

    // The tangent planes that stopped the sphere where it is, by their normals towards its center.
    struct Planes {
        std::array<Vec3, kPlanesMax> normals;
        std::size_t count = 0;

        void add(const Vec3& normal) noexcept
        {
            if (count < kPlanesMax) {
                normals[count++] = normal;
            }
        }
    };

    struct Touch {
        double distance = std::numeric_limits<double>::infinity(); // from the center
        Vec3 normal;                                               // towards it
        ContactFeature feature = ContactFeature::Free;
    };

    // The end of a sweep.
    struct Swept {
        double share;     // of the sweep
        Touch stopped_by; // seen from there; Free if nothing did
        bool is_at_once;  // stopped where it began
    };

    // A triangle seen from the center.
    struct Triangle {
        Vec3 a;
        Vec3 b;
        Vec3 c;
        Vec3 normal; // as long as twice the area
        double normal_squared;

        Triangle(const std::array<ScenePoint, 3>& corners, const ScenePoint& center) noexcept
            : a(corners[0] - center)
            , b(corners[1] - center)
            , c(corners[2] - center)
            , normal(cross(b - a, c - a))
            , normal_squared(dot(normal, normal))
        {}
        void move(const Vec3& by) noexcept
        {
            a = a + by;
            b = b + by;
            c = c + by;
        }
        // Times the length of the normal.
        double above() const noexcept { return -dot(normal, a); }
        // Whether the foot of the center lies inside.
        bool isBelow() const noexcept
        {
            return dot(cross(b - a, -a), normal) >= 0.0 && dot(cross(c - b, -b), normal) >= 0.0 &&
                   dot(cross(a - c, -c), normal) >= 0.0;
        }
    };

    void placeAt(const Goal& goal, const ScenePoint& /*aimed*/) noexcept
    {
        center_ = lifted(surface_.goalPoint(goal));
        minimise(surface_.goalPoint(goal));
    }
    void moveTo(const Goal& goal, const ScenePoint& /*aimed*/) noexcept
    {
        minimise(surface_.goalPoint(goal));
    }

    ContactFeature feature() const noexcept
    {
        return Base::isPlaced() ? feature_ : ContactFeature::Vertex;
    }
    ScenePoint position() const noexcept
    {
        return Base::isPlaced() ? center_ : surface_.point(surface_.initialContact());
    }

    // The resolution of double coordinates, times a small factor.
    static double ulps(const ScenePoint& p) noexcept
    {
        constexpr double kUlps = 32.0 * std::numeric_limits<double>::epsilon();
        return kUlps * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    }

    // Distances up to this equal the radius, to rounding, for a center at `p`.
    double touching(const ScenePoint& p) const noexcept
    {
        return radius_m_ * (1.0 + kDistanceError) + 0.125 * ulps(p);
    }

    // How far a tangent plane may lean the wrong way: next to an edge, by the square root of the
    // rounding error of the distance.
    double lean() const noexcept { return 1e-7 + std::sqrt(ulps(center_) / radius_m_); }

    SceneBounds around(const ScenePoint& p, const ScenePoint& q) const noexcept
    {
        const double margin = radius_m_ + 2.0 * std::max(tolerance(p), tolerance(q));
        return {
            {std::min(p.x, q.x) - margin, std::min(p.y, q.y) - margin, std::min(p.z, q.z) - margin},
            {std::max(p.x, q.x) + margin, std::max(p.y, q.y) + margin,
             std::max(p.z, q.z) + margin}};
    }

    template <typename F>
    bool eachTriangle(const SceneBounds& box,
                      const ScenePoint& center,
                      std::uint32_t looks,
                      const F& function) noexcept
    {
        const std::uint32_t before = looks;
        const bool is_done =
            eachFaceNear(surface_, box, looks,
                         [&](const typename S::Face&, const std::array<ScenePoint, 3>& corners) {
                             ++counters_.faces;
                             return function(Triangle(corners, center));
                         });
        counters_.cells += before - looks;
        return is_done;
    }

    static Nearest nearest(const Triangle& t) noexcept
    {
        const Vec3 foot = t.normal * (-t.above() / t.normal_squared);
        if (t.isBelow()) {
            return {foot, dot(foot, foot), ContactFeature::Face};
        }
        Nearest best{{}, std::numeric_limits<double>::infinity(), ContactFeature::Vertex};
        const auto look = [&best](const Vec3& from, const Vec3& to) {
            const Vec3 edge = to - from;
            const double along = -dot(from, edge) / dot(edge, edge);
            const bool is_within = along > 0.0 && along < 1.0;
            const Vec3 at = is_within ? from + edge * along : along > 0.5 ? to : from;
            const double squared = dot(at, at);
            if (squared < best.squared) {
                best = {at, squared, is_within ? ContactFeature::Edge : ContactFeature::Vertex};
            }
        };
        look(t.a, t.b);
        look(t.b, t.c);
        look(t.c, t.a);
        return best;
    }

    // The nearest feature to the center, if it is within reach.
    Touch touchAt(const ScenePoint& center) noexcept
    {
        Touch touch;
        const double reach = radius_m_ + tolerance(center);
        eachTriangle(around(center, center), center, kLooksAll, [&](const Triangle& triangle) {
            const double above = triangle.above();
            if (above * above <= reach * reach * triangle.normal_squared) {
                const Nearest at = nearest(triangle);
                if (at.squared <= reach * reach && at.squared < touch.distance * touch.distance) {
                    touch = touchOf(at);
                }
            }
            return true;
        });
        return touch;
    }

    static Touch touchOf(const Nearest& at) noexcept
    {
        const double distance = std::sqrt(at.squared);
        return {distance, at.to * (-1.0 / distance), at.feature};
    }

    // The point closest to `to_goal` in front of all tangent planes. One, two or three active
    // planes give the candidates; of those in front of the other planes, it is the longest vector,
    // since each is a projection of `to_goal`.
    static Vec3 constrained(const Planes& planes, const Vec3& to_goal) noexcept
    {
        const double tolerance = kTangentError * length(to_goal);
        const auto is_free = [&](const Vec3& step) {
            for (std::size_t i = 0; i < planes.count; ++i) {
                if (dot(planes.normals[i], step) < -tolerance) {
                    return false;
                }
            }
            return true;
        };
        if (is_free(to_goal)) {
            return to_goal;
        }
        Vec3 best{};
        double best_squared = 0.0;
        const auto consider = [&](const Vec3& step) {
            const double squared = dot(step, step);
            if (squared > best_squared && is_free(step)) {
                best = step;
                best_squared = squared;
            }
        };
        for (std::size_t i = 0; i < planes.count; ++i) {
            const Vec3& n = planes.normals[i];
            const double into = dot(n, to_goal);
            if (into < 0.0) {
                const Vec3 once = to_goal - n * into;
                consider(once - n * dot(n, once));
            }
        }
        if (best_squared > 0.0) {
            return best; // one plane leaves more freedom than two
        }
        for (std::size_t i = 0; i < planes.count; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                // Not along the cross product, which is inaccurate where the planes are nearly the
                // same.
                const Vec3& n = planes.normals[i];
                Vec3 m = planes.normals[j] - n * dot(n, planes.normals[j]);
                const double squared = dot(m, m);
                if (squared > kSineSquaredMin) {
                    m = m * (1.0 / std::sqrt(squared));
                    m = normalized(m - n * dot(n, m));
                    Vec3 step = to_goal;
                    for (int twice = 0; twice < 2; ++twice) {
                        step = step - n * dot(n, step);
                        step = step - m * dot(m, step);
                    }
                    consider(step);
                }
            }
        }
        return best;
    }

    // The fraction of `way` after which the sphere touches a triangle and begins to enter it, if
    // less than `share`. The sweep may enter a triangle that the sphere touches at its beginning by
    // `slack`.
    double enters(
        const Triangle& t, const Vec3& way, double share, double slack, double touch) const noexcept
    {
        // For most faces the sphere does not reach the plane.
        const double start = t.above();
        const double least = std::min(start, start + share * dot(t.normal, way));
        if (least > 0.0 && least * least > radius_m_ * radius_m_ * t.normal_squared) {
            return share;
        }
        const double size = std::sqrt(t.normal_squared);
        double above = start / size;
        double rising = dot(t.normal, way) / size;
        if (above < 0.0) {
            above = -above;
            rising = -rising;
        }
        if (std::min(above, above + share * rising) > radius_m_) {
            return share;
        }
        if (above <= touch) {
            const Nearest at = nearest(t);
            if (at.squared <= touch * touch) {
                return dot(at.to, way) > slack * std::sqrt(at.squared) ? 0.0 : share;
            }
        }
        if (above > radius_m_) {
            const double at = (above - radius_m_) / -rising;
            if (at < share) {
                Triangle there = t;
                there.move(way * -at);
                if (nearest(there).squared <= touch * touch) {
                    return at;
                }
            }
        }
        share = entersEdge(t.a, t.b, way, share);
        share = entersEdge(t.b, t.c, way, share);
        share = entersEdge(t.c, t.a, way, share);
        share = entersVertex(t.a, way, share);
        share = entersVertex(t.b, way, share);
        return entersVertex(t.c, way, share);
    }

    // The first root of |m + s way|² = r² for a start outside.
    static double root(double way_squared, double m_way, double m_squared, double radius) noexcept
    {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        if (m_way >= 0.0) {
            return kNever;
        }
        const double rest = std::max(m_squared - radius * radius, 0.0);
        const double discriminant = m_way * m_way - way_squared * rest;
        return discriminant < 0.0 ? kNever : rest / (std::sqrt(discriminant) - m_way);
    }

    double entersVertex(const Vec3& vertex, const Vec3& way, double share) const noexcept
    {
        return std::min(share,
                        root(dot(way, way), -dot(vertex, way), dot(vertex, vertex), radius_m_));
    }

    double
    entersEdge(const Vec3& from, const Vec3& to, const Vec3& way, double share) const noexcept
    {
        const Vec3 edge = to - from;
        const double length_squared = dot(edge, edge);
        const double start = -dot(from, edge) / length_squared;
        const double along = dot(way, edge) / length_squared;
        const Vec3 m = -(from + edge * start);
        const Vec3 across = way - edge * along;
        const double at = root(dot(across, across), dot(m, across), dot(m, m), radius_m_);
        if (!(at < share)) {
            return share;
        }
        const double where = start + at * along;
        const double slack = kBeside * radius_m_ / std::sqrt(length_squared);
        return where >= -slack && where <= 1.0 + slack ? at : share;
    }

    // Sweeps the sphere from `from` along `way` until it begins to enter something. Long sweeps are
    // split into pieces with few faces near each, so that no sweep visits a whole map.
    Swept sweep(const ScenePoint& from, const Vec3& way, double slack) noexcept
    {
        ++counters_.casts;
        const double size = length(way);
        const double at_once = kAtOnce * radius_m_ + 0.125 * ulps(from);
        const double touch = touching(from);
        double done = 0.0;
        for (std::uint32_t pieces = surface_.stepsMax(); pieces > 0; --pieces) {
            const bool is_last = reach_m_ >= (1.0 - done) * size;
            const double piece = is_last ? 1.0 - done : reach_m_ / size;
            const ScenePoint start = from + way * done;
            const Vec3 part = way * piece;
            const bool is_short = piece * size <= radius_m_;
            double share = 1.0;
            std::optional<Triangle> hit;
            const bool is_complete =
                eachTriangle(around(start, start + part), start, is_short ? kLooksAll : kLooks,
                             [&](const Triangle& triangle) {
                                 const double at = enters(triangle, part, share, slack, touch);
                                 if (at < share) {
                                     share = at;
                                     hit = triangle;
                                 }
                                 return true;
                             });
            if (!is_complete) {
                reach_m_ = std::max(0.5 * std::min(reach_m_, piece * size), 0.25 * radius_m_);
                continue;
            }
            if (hit) {
                hit->move(part * -share);
                const double total = done + share * piece;
                // The next sweep will not be much longer.
                reach_m_ = std::clamp(2.0 * total * size, 0.25 * radius_m_, reach_m_);
                return {total, touchOf(nearest(*hit)), total * size <= at_once};
            }
            if (is_last) {
                return {1.0, {}, false};
            }
            done += piece;
            reach_m_ *= 2.0;
        }
        counters_.cut_short = 1;
        return {done, {}, false};
    }

    // The steps with one number of active planes.
    struct Pace {
        double step_m; // the last one
        double leap_m; // the longest leap to try
    };

    // A trial leap.
    struct Trial {
        ScenePoint from;
        double enough; // the squared distance from the goal that normal steps would not reach
        std::size_t pace;
        int sweeps; // remaining
    };

    // The state of one update.
    struct Descent {
        Planes planes; // touched at the center's position
        std::array<Pace, 3> paces;
        std::optional<Trial> trial;
        int stalls = 0;
        int leans = 0;
    };

    void minimise(const ScenePoint& goal) noexcept
    {
        Descent descent;
        descent.paces.fill({0.0, kLeapRadii * radius_m_});
        for (std::uint32_t steps = surface_.stepsMax(); steps > 0; --steps) {
            if (descent.stalls > kStallsMax) {
                if (!descent.trial) {
                    break;
                }
                endTrial(descent, false);
            }
            if (advance(goal, descent)) {
                return;
            }
        }
        if (descent.trial) {
            center_ = descent.trial->from;
        }
        counters_.cut_short = 1;
        rest();
    }

    // One sweep towards the goal or the constrained goal. True if no direction is left.
    bool advance(const ScenePoint& goal, Descent& descent) noexcept
    {
        Planes& planes = descent.planes;
        const Vec3 whole = goal - center_;
        const double distance = length(whole);
        const bool is_cut = planes.count > 0 && distance > kStepRadii * radius_m_;
        const Vec3 to_goal = is_cut ? whole * (kStepRadii * radius_m_ / distance) : whole;
        const double slack = kSweepError * length(to_goal);
        const Vec3 step = constrained(planes, to_goal);
        const bool is_free = step == whole;
        if (descent.trial) {
            if (distance * distance < descent.trial->enough) {
                endTrial(descent, true);
            } else if (descent.trial->sweeps-- == 0) {
                endTrial(descent, false);
                return false;
            }
        }
        if (distance == 0.0) {
            feature_ = ContactFeature::Free;
            return true;
        }
        double within = 1.0;
        if (!is_free) {
            // Planes not met yet shorten the step further.
            const double size = length(step);
            if (size <= kStill * length(to_goal) + ulps(center_) ||
                (size <= lean() * length(to_goal) && ++descent.leans > kLeansMax)) {
                if (descent.trial) {
                    endTrial(descent, false);
                    return false;
                }
                rest();
                return true;
            }
            // The goal is within the walls, but constrained goals need not be.
            const WallStop stop = wallStop(step, slack);
            if (stop.wall != nullptr && stop.share * size <= walls_.tolerance_m) {
                planes.add(stop.wall->normal);
                ++descent.stalls;
                return false;
            }
            within = stop.share;
            if (!descent.trial && leapAlong(goal, step, slack, descent)) {
                return false;
            }
        }
        const Vec3 way = step * within;
        const Swept swept = sweep(center_, way, slack);
        const bool is_stopped = swept.stopped_by.feature != ContactFeature::Free;
        if (is_free && !is_stopped && swept.share >= 1.0) {
            center_ = goal;
            feature_ = ContactFeature::Free;
            return true;
        }
        if (swept.is_at_once) {
            ++descent.stalls;
        } else {
            center_ = withinWalls(center_ + way * swept.share);
            planes.count = 0;
            descent.stalls = 0;
        }
        // After a long sweep rounding may leave a gap for the next sweep to close.
        if (is_stopped && (swept.is_at_once || swept.stopped_by.distance <= touching(center_))) {
            planes.add(swept.stopped_by.normal);
            const double depth = radius_m_ - swept.stopped_by.distance;
            if (depth > 0.25 * tolerance(center_)) {
                center_ = center_ + swept.stopped_by.normal * depth;
            }
        }
        return false;
    }

    // Around an edge close to the goal, the planes make steps short, each nearly the same fraction
    // of the one before. The limit is extrapolated, up to a fraction of a turn, and tried. The step
    // would reduce the squared distance by `size`², since it is at a right angle to the remaining
    // vector.
    bool
    leapAlong(const ScenePoint& goal, const Vec3& step, double slack, Descent& descent) noexcept
    {
        const double size = length(step);
        const std::size_t index = std::min(descent.planes.count, descent.paces.size()) - 1;
        Pace& pace = descent.paces[index];
        const double ratio = size / pace.step_m;
        pace.step_m = size;
        const double far = ratio < 1.0 ? 1.0 / (1.0 - ratio) : kFar;
        // Otherwise it would enter a touched face by more than a fraction of the tolerance.
        const double most = 0.01 * tolerance(center_) / slack;
        const double longer = std::min({far, pace.leap_m / size, most});
        if (!(ratio > kSlowRatio && ratio < 1.0 / kSlowRatio && longer > 1.0 / kSlowRatio)) {
            pace.leap_m = std::min(1.5 * pace.leap_m, kLeapRadii * radius_m_);
            return false;
        }
        const Vec3 to_goal = goal - center_;
        descent.trial = Trial{center_, dot(to_goal, to_goal) - size * size, index, kTrialSweepsMax};
        const Vec3 leap = step * longer;
        const Vec3 way = leap * wallStop(leap, slack * longer).share;
        center_ = withinWalls(center_ + way * sweep(center_, way, slack * longer).share);
        descent.planes.count = 0;
        descent.stalls = 0;
        return true;
    }

    void endTrial(Descent& descent, bool is_closer) noexcept
    {
        Pace& pace = descent.paces[descent.trial->pace];
        if (is_closer) {
            pace.leap_m = std::min(2.0 * pace.leap_m, kLeapRadii * radius_m_);
        } else {
            pace.leap_m *= 0.25;
            center_ = descent.trial->from;
            descent.planes.count = 0;
            descent.stalls = 0;
        }
        descent.trial.reset();
    }

    struct WallStop {
        double share; // of the sweep
        const BorderWall* wall;
    };

    WallStop wallStop(const Vec3& way, double slack) const noexcept
    {
        WallStop stop{1.0, nullptr};
        for (const BorderWall& wall : walls_) {
            const double into = -dot(wall.normal, way);
            if (into > slack && into * stop.share > wall.distance(center_)) {
                stop = {std::max(wall.distance(center_), 0.0) / into, &wall};
            }
        }
        return stop;
    }

    // The sphere has come to rest. Corrects a distance that rounding has made too small.
    void rest() noexcept
    {
        Touch touch = touchAt(center_);
        for (int pushes = 0;
             pushes < kPushesMax && touch.distance < radius_m_ - 0.5 * tolerance(center_);
             ++pushes) {
            center_ = center_ + touch.normal * (radius_m_ - touch.distance);
            touch = touchAt(center_);
        }
        feature_ = touch.feature;
    }

    // Rounding may lead outside.
    ScenePoint withinWalls(const ScenePoint& p) const noexcept
    {
        for (const BorderWall& wall : walls_) {
            if (wall.distance(p) < 0.0) {
                const auto inside = surface_.goal(p);
                return inside ? surface_.goalPoint(*inside) : p;
            }
        }
        return p;
    }

    bool isFreeAt(const ScenePoint& p) noexcept
    {
        const auto goal = surface_.goal(p);
        return goal && surface_.isAbove(*goal) &&
               touchAt(p).distance >= radius_m_ - 0.5 * tolerance(p);
    }

    // The surface straight above or below `p`, or `p` where there is none.
    ScenePoint straightBelow(const ScenePoint& p) const noexcept
    {
        if constexpr (SurfaceOnBody<S>) {
            const double clearance_m = clearanceOver(surface_, p);
            return std::isfinite(clearance_m)
                       ? p - verticalAt(surface_.mesh()->ellipsoid(), p).up * clearance_m
                       : p;
        } else {
            const auto goal = surface_.goal(p);
            return goal ? surface_.point(surface_.contactAt(*goal)) : p;
        }
    }

    // `p` if the sphere is free there, otherwise where a sphere lowered from above all faces comes
    // to rest above it.
    ScenePoint lifted(const ScenePoint& p) noexcept
    {
        if (isFreeAt(p)) {
            return p;
        }
        if constexpr (SurfaceOnBody<S>) {
            // All faces are lower than the first point, so the sphere begins free.
            const Vec3 up = verticalAt(surface_.mesh()->ellipsoid(), p).up;
            ScenePoint at = surface_.mesh()->highAbove(p) + up * radius_m_;
            // After a long sweep rounding may leave a gap for the next one to close.
            constexpr int kSweepsMax = 4;
            for (int i = 0; i < kSweepsMax; ++i) {
                const Vec3 down = p - at;
                const Swept swept = sweep(at, down, 0.0);
                at = at + down * swept.share;
                if (swept.is_at_once || swept.stopped_by.feature == ContactFeature::Free) {
                    break;
                }
            }
            return at;
        } else {
            return liftedAlongZ(p);
        }
    }

    ScenePoint liftedAlongZ(const ScenePoint& p) noexcept
    {
        ScenePoint top = p;
        if (const auto goal = surface_.goal(p)) {
            top.z = std::max(top.z, surface_.point(surface_.contactAt(*goal)).z + radius_m_);
        }
        double step = radius_m_;
        constexpr int kDoublingsMax = 128;
        for (int i = 0; i < kDoublingsMax; ++i) {
            SceneBounds box = around(top, top);
            box.high.z = std::numeric_limits<double>::max();
            if (eachTriangle(box, top, kLooksAll, [](const Triangle&) { return false; })) {
                break;
            }
            top.z += step;
            step *= 2.0;
        }
        const Vec3 down{0.0, 0.0, p.z - top.z};
        return top + down * sweep(top, down, 0.0).share;
    }

    BorderWalls walls_;
    double radius_m_;
    double reach_m_; // the initial length of a sweep's piece
    ScenePoint center_;
    ContactFeature feature_ = ContactFeature::Free;
};

} // namespace marsview
