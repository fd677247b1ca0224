#include "core/globe/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace marsview {
namespace {

// Poleward of this the heading turns with the ground.
constexpr Angle kPolarLatitude = Angle::degrees(80.0);

constexpr int kHeldRounds = 12;
constexpr int kNewtonRounds = 12;
constexpr double kHeldErrorPx = 1e-3;
constexpr double kNewtonErrorPx = 1e-6;

constexpr double kPanMaxRad = std::numbers::pi / 4.0;

// How much a flight prefers to rise over going far near the ground: what van Wijk and Nuij found
// people to like.
constexpr double kFlightRise = 1.4;

Vec3 direction(const GeographicPoint& place)
{
    const double cosine = std::cos(place.latitude.radians());
    return {cosine * std::cos(place.longitude.radians()),
            cosine * std::sin(place.longitude.radians()), std::sin(place.latitude.radians())};
}

GeographicPoint placeToward(const Vec3& v)
{
    return {.longitude = Angle::radians(std::atan2(v.y, v.x)),
            .latitude = Angle::radians(std::atan2(v.z, std::hypot(v.x, v.y)))};
}

Angle shortest(Angle angle)
{
    return Angle::radians(std::remainder(angle.radians(), 2.0 * std::numbers::pi));
}

// A rotation about an axis of length 1.
struct Rotation {
    Vec3 axis{0.0, 0.0, 1.0};
    double sine = 0.0;
    double cosine = 1.0;

    // The shortest one between two directions; none if they are opposite.
    static Rotation between(const Vec3& from, const Vec3& to)
    {
        const Vec3 normal = cross(from, to);
        const double across = length(normal);
        const double along = dot(from, to);
        const double both = std::hypot(across, along);
        return across > 0.0 ? Rotation{normal * (1.0 / across), across / both, along / both}
                            : Rotation{};
    }
    static Rotation about(const Vec3& axis, double angle_rad)
    {
        return {axis, std::sin(angle_rad), std::cos(angle_rad)};
    }
    Vec3 operator()(const Vec3& v) const
    {
        return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1.0 - cosine));
    }
};

// Turns the target about the body's center. On a sphere the picture turns with it if the heading
// does.
BodyCamera turned(BodyCamera camera, const Rotation& rotation, bool turns_heading)
{
    const auto axes_at = [](const GeographicPoint& place) {
        const double longitude = place.longitude.radians();
        const Vec3 east{-std::sin(longitude), std::cos(longitude), 0.0};
        return std::pair{east, cross(direction(place), east)};
    };
    const auto [east, north] = axes_at(camera.target);
    const Vec3 heading = rotation(east * std::sin(camera.azimuth.radians()) +
                                  north * std::cos(camera.azimuth.radians()));
    camera.target = placeToward(rotation(direction(camera.target)));
    if (turns_heading) {
        const auto [new_east, new_north] = axes_at(camera.target);
        camera.azimuth =
            Angle::radians(std::atan2(dot(heading, new_east), dot(heading, new_north)));
    }
    return camera;
}

bool isPolar(const BodyCamera& camera)
{
    return std::abs(camera.target.latitude.radians()) > kPolarLatitude.radians();
}

// How far an ellipsoid must be scaled to go through a point.
double scaleTo(const Ellipsoid& ellipsoid, const ScenePoint& point)
{
    return std::sqrt((point.x * point.x + point.y * point.y) /
                         (ellipsoid.equatorial_m * ellipsoid.equatorial_m) +
                     point.z * point.z / (ellipsoid.polar_m * ellipsoid.polar_m));
}

// How far the point is from its pixel; nothing if it is not in front of the eye.
std::optional<PixelPoint> missOf(const BodyCamera& camera,
                                 const Ellipsoid& ellipsoid,
                                 const Viewport& viewport,
                                 const HeldPoint& held)
{
    const auto pixel = project(poseOf(camera, ellipsoid), viewport, held.point);
    return pixel ? std::optional(PixelPoint{pixel->x - held.pixel.x, pixel->y - held.pixel.y})
                 : std::nullopt;
}

// Newton steps of the target's two angles: small turns converge slowly where the body turns under
// a heading that stays, and near the poles of a flattened body.
BodyCamera refined(BodyCamera camera,
                   const Ellipsoid& ellipsoid,
                   const Viewport& viewport,
                   const HeldPoint& held,
                   bool turns_heading)
{
    auto miss = missOf(camera, ellipsoid, viewport, held);
    const double probe = 1e-6 * std::min(camera.distance_m / ellipsoid.equatorial_m, 1.0);
    for (int i = 0; miss && i < kNewtonRounds; ++i) {
        const double error_px = std::hypot(miss->x, miss->y);
        if (error_px < kNewtonErrorPx) {
            break;
        }
        const Vec3 up = direction(camera.target);
        const double longitude = camera.target.longitude.radians();
        const Vec3 east{-std::sin(longitude), std::cos(longitude), 0.0};
        const Vec3 north = cross(up, east);
        const auto moved = [&](double east_rad, double north_rad) {
            const Vec3 axis = north * east_rad - east * north_rad;
            const double angle = length(axis);
            return angle > 0.0
                       ? turned(camera, Rotation::about(axis * (1.0 / angle), angle), turns_heading)
                       : camera;
        };
        const auto to_east = missOf(moved(probe, 0.0), ellipsoid, viewport, held);
        const auto to_north = missOf(moved(0.0, probe), ellipsoid, viewport, held);
        if (!to_east || !to_north) {
            break;
        }
        const double a = (to_east->x - miss->x) / probe;
        const double b = (to_north->x - miss->x) / probe;
        const double c = (to_east->y - miss->y) / probe;
        const double d = (to_north->y - miss->y) / probe;
        const double determinant = a * d - b * c;
        double share = 1.0;
        bool is_better = false;
        for (; !is_better && share > 1e-3; share /= 2.0) {
            const BodyCamera next = moved(share * (b * miss->y - d * miss->x) / determinant,
                                          share * (c * miss->x - a * miss->y) / determinant);
            const auto next_miss = missOf(next, ellipsoid, viewport, held);
            is_better = next_miss && std::hypot(next_miss->x, next_miss->y) < error_px;
            if (is_better) {
                camera = next;
                miss = next_miss;
            }
        }
        if (!is_better) {
            break;
        }
    }
    return camera;
}

// Repeats small turns that bring the point to its pixel.
BodyCamera broughtTo(BodyCamera camera,
                     const Ellipsoid& ellipsoid,
                     const Viewport& viewport,
                     const HeldPoint& held,
                     bool turns_heading)
{
    for (int i = 0; i < kHeldRounds; ++i) {
        const Ray ray = pickRay(poseOf(camera, ellipsoid), viewport, held.pixel);
        const ScenePoint there = pointOnBody(ray, ellipsoid, held.point);
        const Rotation rotation = Rotation::between(there, held.point);
        if (std::abs(rotation.sine) < 1e-15 && rotation.cosine > 0.0) {
            break;
        }
        camera = turned(camera, rotation, turns_heading);
    }
    return refined(camera, ellipsoid, viewport, held, turns_heading);
}

} // namespace

BodyCamera
steered(const BodyCamera& camera, const CapRates& rates, double seconds, const BodyLimits& limits)
{
    const double pan_share = kCapPanPerS * seconds;
    BodyCamera next = panned(camera, pan_share * capSpeed(rates.push.x),
                             pan_share * capSpeed(rates.push.y), limits.ellipsoid);
    // Azimuth is clockwise, rotations about the upward axis are counterclockwise.
    next = orbited(next, kCapTurnPerS * (-seconds * capSpeed(rates.turn.z)),
                   kCapTiltPerS * (seconds * capSpeed(rates.turn.x)));
    next.distance_m =
        std::clamp(next.distance_m * std::pow(kCapZoomPerS, seconds * capSpeed(rates.push.z)),
                   limits.distance_min_m, limits.distance_max_m);
    return next;
}

ScenePoint pointOnBody(const Ray& ray, const Ellipsoid& ellipsoid, const ScenePoint& level)
{
    const double polar_scale = ellipsoid.equatorial_m / ellipsoid.polar_m;
    const double radius = scaleTo(ellipsoid, level) * ellipsoid.equatorial_m;
    const auto scaled = [&](const Vec3& v) { return Vec3{v.x, v.y, polar_scale * v.z}; };
    const Vec3 from = scaled(ray.origin);
    const Vec3 along = scaled(ray.direction);
    const double square = dot(along, along);
    const double nearest = -dot(from, along) / square;
    const Vec3 middle = from + along * nearest;
    const double reach_square = (radius * radius - dot(middle, middle)) / square;
    if (reach_square > 0.0 && nearest > 0.0) {
        return ray.at(nearest - std::sqrt(reach_square));
    }
    // The edge is near the point of the ray that is nearest to the center.
    const Vec3 edge = nearest > 0.0 ? middle : from;
    const Vec3 on_edge = edge * (radius / std::max(length(edge), 1e-300));
    return {on_edge.x, on_edge.y, on_edge.z / polar_scale};
}

BodyCamera heldAt(BodyCamera camera,
                  const Ellipsoid& ellipsoid,
                  const Viewport& viewport,
                  const HeldPoint& held)
{
    if (!isPolar(camera)) {
        const BodyCamera level = broughtTo(camera, ellipsoid, viewport, held, false);
        const auto pixel = project(poseOf(level, ellipsoid), viewport, held.point);
        if (pixel && !isPolar(level) &&
            std::hypot(pixel->x - held.pixel.x, pixel->y - held.pixel.y) < kHeldErrorPx) {
            return level;
        }
    }
    return broughtTo(camera, ellipsoid, viewport, held, true);
}

BodyCamera zoomed(BodyCamera camera,
                  double factor,
                  const Viewport& viewport,
                  const HeldPoint& held,
                  const BodyLimits& limits)
{
    const double distance_m = std::clamp(camera.distance_m * factor, limits.distance_min_m,
                                         std::max(limits.distance_max_m, limits.distance_min_m));
    const double share = distance_m / camera.distance_m;
    const double level_m = placeOf(held.point, limits.ellipsoid).height_m;
    camera.height_m = level_m + (camera.height_m - level_m) * share;
    camera.distance_m = distance_m;
    return heldAt(camera, limits.ellipsoid, viewport, held);
}

BodyCamera orbited(BodyCamera camera, Angle azimuth_change, Angle tilt_change)
{
    camera.azimuth = shortest(camera.azimuth + azimuth_change);
    camera.tilt = camera.tilt + tilt_change;
    return camera;
}

BodyCamera
panned(BodyCamera camera, double right_share, double forward_share, const Ellipsoid& ellipsoid)
{
    const double share = std::hypot(right_share, forward_share);
    if (share == 0.0) {
        return camera;
    }
    const double angle = std::min(share * camera.distance_m / ellipsoid.equatorial_m, kPanMaxRad);
    const double heading = camera.azimuth.radians() + std::atan2(right_share, forward_share);
    const Vec3 up = direction(camera.target);
    const double longitude = camera.target.longitude.radians();
    const Vec3 east{-std::sin(longitude), std::cos(longitude), 0.0};
    const Vec3 toward = east * std::sin(heading) + cross(up, east) * std::cos(heading);
    const Rotation rotation = Rotation::about(cross(up, toward), angle);
    const BodyCamera level = turned(camera, rotation, false);
    return isPolar(camera) || isPolar(level) ? turned(camera, rotation, true) : level;
}

BodyCamera flown(const BodyCamera& from, const BodyCamera& to, const Ellipsoid& ellipsoid, double t)
{
    if (t <= 0.0) {
        return from;
    }
    if (t >= 1.0) {
        return to;
    }
    const auto mix = [t](double a, double b) { return a + (b - a) * t; };
    const Vec3 start = direction(from.target);
    const Vec3 end = direction(to.target);
    const Vec3 normal = cross(start, end);
    const double angle = std::atan2(length(normal), dot(start, end));
    const double way_m = angle * ellipsoid.equatorial_m;
    const double w0 = from.distance_m;
    const double w1 = to.distance_m;
    BodyCamera camera = to;
    double share = t;
    if (way_m < 1e-6 * std::min(w0, w1)) {
        camera.distance_m = w0 * std::exp(std::log(w1 / w0) * t);
    } else {
        constexpr double kSquare = kFlightRise * kFlightRise;
        const double difference = w1 * w1 - w0 * w0;
        const double rise = kSquare * way_m * kSquare * way_m;
        const auto place = [](double b) { return -std::asinh(b); };
        const double r0 = place((difference + rise) / (2.0 * w0 * kSquare * way_m));
        const double r1 = place((difference - rise) / (2.0 * w1 * kSquare * way_m));
        const double r = mix(r0, r1);
        camera.distance_m = w0 * std::cosh(r0) / std::cosh(r);
        share = std::clamp(w0 / kSquare * (std::cosh(r0) * std::tanh(r) - std::sinh(r0)) / way_m,
                           0.0, 1.0);
    }
    if (angle > 0.0) {
        // Opposite places have any great circle between them: over a pole.
        const Vec3 axis = length(normal) > 1e-12
                              ? normalized(normal)
                              : Vec3{-std::sin(from.target.longitude.radians()),
                                     std::cos(from.target.longitude.radians()), 0.0} *
                                    -1.0;
        camera.target = placeToward(Rotation::about(axis, share * angle)(start));
    }
    camera.height_m = from.height_m + (to.height_m - from.height_m) * share;
    camera.azimuth = shortest(from.azimuth + shortest(to.azimuth - from.azimuth) * t);
    camera.tilt = Angle::radians(mix(from.tilt.radians(), to.tilt.radians()));
    camera.field_of_view =
        Angle::radians(mix(from.field_of_view.radians(), to.field_of_view.radians()));
    return camera;
}

} // namespace marsview
