#include "core/view/navigation.h"

#include "core/base/check.h"
#include "core/view/clear_tilt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

// Outside the map, a zoom anchors on a point at most this many camera distances away.
constexpr double kAnchorReach = 2.0;

constexpr double kPixelsNearest = 2.0;
constexpr double kDiagonalsFarthest = 4.0;

// A drag towards the horizon moves the map by at most this many camera distances.
constexpr double kDragReach = 4.0;

Angle wrapped(Angle azimuth)
{
    return Angle::radians(std::remainder(azimuth.radians(), 2.0 * std::numbers::pi));
}

// How much the eye is too low. Negative if it is high enough or not above terrain.
double clearanceMissing(const OrbitCamera& camera, const GroundQuery& ground)
{
    const ScenePoint eye = eyeOf(camera);
    const double ground_z = ground(eye.x, eye.y);
    return std::isfinite(ground_z) ? ground_z + kClearanceShare * camera.distance_m - eye.z : -1.0;
}

// The first point accepted by `accepts` on rings around `center`, from `radius_min_m` on. Radii
// grow by a quarter, so the point is nearly the nearest.
template <typename Accepts>
std::optional<ScenePoint> findAround(const ScenePoint& center,
                                     double radius_min_m,
                                     double radius_max_m,
                                     const Accepts& accepts)
{
    constexpr int kHeadings = 16;
    double radius_m = radius_min_m;
    // Elevations of 1e200 m, which only nodata has, make boxes of infinite size.
    while (radius_m <= radius_max_m && std::isfinite(radius_m)) {
        for (int i = 0; i < kHeadings; ++i) {
            const double heading = 2.0 * std::numbers::pi * i / kHeadings;
            const ScenePoint p =
                center + Vec3{std::sin(heading), std::cos(heading), 0.0} * radius_m;
            if (accepts(p)) {
                return p;
            }
        }
        radius_m *= 1.25;
    }
    return std::nullopt;
}

// Whether there is terrain in the picture near the target, although not under it.
bool seesGround(const OrbitCamera& camera, double radius_min_m, const GroundQuery& ground)
{
    constexpr Viewport kNarrow{1, 2}; // representative of any window; wide ones show more
    const auto is_seen = [&](const ScenePoint& p) {
        const double ground_z = ground(p.x, p.y);
        if (!std::isfinite(ground_z)) {
            return false;
        }
        const auto pixel = project(camera, kNarrow, {p.x, p.y, ground_z});
        return pixel && pixel->x > 0.05 && pixel->x < 0.95 && pixel->y > 0.1 && pixel->y < 1.9;
    };
    return findAround(camera.target, radius_min_m, 0.5 * camera.distance_m, is_seen).has_value();
}

// Lowers the target so that the terrain under it stays in the picture, and raises the eye clear of
// the terrain. The eye rises with the target as far as that allows, and beyond that over the
// target; otherwise the picture would show only sky.
OrbitCamera cleared(OrbitCamera camera, const SceneBox& box, const GroundQuery& ground)
{
    const double ground_z = ground(camera.target.x, camera.target.y);
    double highest = box.maximum.z;
    if (std::isfinite(ground_z)) {
        highest =
            std::clamp(highest, ground_z,
                       ground_z + hangMax(camera.distance_m, camera.tilt, camera.field_of_view));
    }
    camera.target.z = std::min(camera.target.z, highest);
    const double missing = clearanceMissing(camera, ground);
    if (missing > 0.0) {
        // The surplus compensates for rounding.
        camera.target.z = std::min(camera.target.z + missing + 1e-6 * camera.distance_m, highest);
        if (clearanceMissing(camera, ground) > 0.0) {
            camera.tilt = clearTilt(camera.tilt, [&](Angle tilt) {
                OrbitCamera tilted = camera;
                tilted.tilt = tilt;
                return clearanceMissing(tilted, ground) <= 0.0;
            });
        }
    }
    return camera;
}

// The position of the eye, along and across the view axis, at which all points lie between two
// planes that open by the tangent `slope` to either side. For each plane, the farthest point
// decides.
struct Fit {
    double across = 0.0;
    double depth = 0.0;
};

Fit fitBetween(std::span<const ScenePoint> points,
               const Vec3& across,
               const Vec3& forward,
               double slope)
{
    double positive = -HUGE_VAL;
    double negative = -HUGE_VAL;
    for (const ScenePoint& p : points) {
        const double a = dot(p, across);
        const double d = dot(p, forward);
        positive = std::max(positive, a - slope * d);
        negative = std::max(negative, -a - slope * d);
    }
    return {.across = (positive - negative) / 2.0, .depth = -(positive + negative) / (2.0 * slope)};
}

// The distance along a line that goes through the box to where it leaves the box.
double exitFrom(const SceneBox& box, const ScenePoint& from, const Vec3& forward)
{
    double exit = std::numeric_limits<double>::infinity();
    const auto meet = [&exit](double minimum, double maximum, double at, double step) {
        if (step != 0.0) {
            exit = std::min(exit, ((step > 0.0 ? maximum : minimum) - at) / step);
        }
    };
    meet(box.minimum.x, box.maximum.x, from.x, forward.x);
    meet(box.minimum.y, box.maximum.y, from.y, forward.y);
    meet(box.minimum.z, box.maximum.z, from.z, forward.z);
    return exit;
}

struct HomeView {
    OrbitCamera camera;
    double spare_m = 0.0; // how much nearer the eye could be if only the picture's height counted
};

// With all of `points`, which lie in `box`, in the picture.
HomeView homeView(std::span<const ScenePoint> points,
                  const SceneBox& box,
                  const Viewport& viewport,
                  const ViewDirection& from,
                  Angle field_of_view)
{
    OrbitCamera camera;
    camera.field_of_view = field_of_view;
    camera.azimuth = from.azimuth;
    camera.tilt = from.tilt;
    const CameraAxes axes = axesOf(camera);
    const double slope = std::tan(field_of_view.radians() / 2.0) / kHomeMargin;
    const Fit across = fitBetween(points, axes.right, axes.forward, slope * viewport.aspect());
    const Fit upward = fitBetween(points, axes.up, axes.forward, slope);
    const ScenePoint eye = axes.right * across.across + axes.up * upward.across +
                           axes.forward * std::min(across.depth, upward.depth);
    // The target lies where the axis leaves the box: constrained() would lower a target high above
    // the terrain next to a cliff, and part of the map would leave the picture at the top.
    const double distance_m = std::max(exitFrom(box, eye, axes.forward), 1e-3 * box.diagonal_m());
    camera.distance_m = distance_m;
    camera.target = eye + axes.forward * distance_m;
    return {.camera = camera, .spare_m = upward.depth - across.depth};
}

} // namespace

NavigationLimits navigationLimits(const SceneBox& box, double pixel_m)
{
    const double nearest = std::max(kPixelsNearest * pixel_m, 1e-6 * box.diagonal_m());
    return {.box = box,
            .distance_min_m = nearest,
            .distance_max_m = std::max(kDiagonalsFarthest * box.diagonal_m(), nearest)};
}

OrbitCamera
constrained(OrbitCamera camera, const NavigationLimits& limits, const GroundQuery& ground)
{
    const SceneBox& box = limits.box;
    camera.target = {std::clamp(camera.target.x, box.minimum.x, box.maximum.x),
                     std::clamp(camera.target.y, box.minimum.y, box.maximum.y),
                     std::clamp(camera.target.z, box.minimum.z, box.maximum.z)};
    camera.distance_m = std::clamp(camera.distance_m, limits.distance_min_m, limits.distance_max_m);
    camera.tilt = std::clamp(camera.tilt, Angle{}, kTiltMax);
    camera.azimuth = wrapped(camera.azimuth);
    if (!ground) {
        return camera;
    }
    const double radius_min_m = limits.distance_min_m / 4.0; // half a pixel
    const OrbitCamera found = cleared(camera, box, ground);
    const auto has_ground = [&](const ScenePoint& p) { return std::isfinite(ground(p.x, p.y)); };
    if (has_ground(found.target) || seesGround(found, radius_min_m, ground)) {
        return found;
    }
    // In the middle of a hole, or outside a rotated map: back to the nearest terrain.
    const auto nearest =
        findAround(camera.target, radius_min_m, 1.25 * box.diagonal_m(), has_ground);
    camera.target = nearest.value_or(camera.target);
    return cleared(camera, box, ground);
}

OrbitCamera orbited(OrbitCamera camera, Angle azimuth_change, Angle tilt_change)
{
    camera.azimuth = wrapped(camera.azimuth + azimuth_change);
    camera.tilt = std::clamp(camera.tilt + tilt_change, Angle{}, kTiltMax);
    return camera;
}

OrbitCamera
zoomed(OrbitCamera camera, double factor, const ScenePoint& anchor, const NavigationLimits& limits)
{
    const double distance_m =
        std::clamp(camera.distance_m * factor, limits.distance_min_m, limits.distance_max_m);
    camera.target = anchor + (camera.target - anchor) * (distance_m / camera.distance_m);
    camera.distance_m = distance_m;
    return camera;
}

ScenePoint anchorBesideMap(const OrbitCamera& camera, const Ray& ray)
{
    return ray.direction.z < 0.0
               ? pointOnLevel(ray, camera.target.z, kAnchorReach * camera.distance_m)
               : camera.target;
}

OrbitCamera dragged(OrbitCamera camera, const Viewport& viewport, const Drag& drag)
{
    const double reach_m = kDragReach * camera.distance_m;
    const ScenePoint from =
        pointOnLevel(pickRay(camera, viewport, drag.from), drag.grabbed_z_m, reach_m);
    const ScenePoint to =
        pointOnLevel(pickRay(camera, viewport, drag.to), drag.grabbed_z_m, reach_m);
    camera.target.x += from.x - to.x;
    camera.target.y += from.y - to.y;
    return camera;
}

OrbitCamera panned(OrbitCamera camera, double right_share, double forward_share)
{
    const double sin_a = std::sin(camera.azimuth.radians());
    const double cos_a = std::cos(camera.azimuth.radians());
    camera.target.x += camera.distance_m * (right_share * cos_a + forward_share * sin_a);
    camera.target.y += camera.distance_m * (forward_share * cos_a - right_share * sin_a);
    return camera;
}

OrbitCamera retargeted(OrbitCamera camera, double distance_m)
{
    const ScenePoint eye = eyeOf(camera);
    camera.target = eye + axesOf(camera).forward * distance_m;
    camera.distance_m = distance_m;
    return camera;
}

OrbitCamera homeCamera(const SceneBox& box, const Viewport& viewport, Angle field_of_view)
{
    return homeView(box.corners(), box, viewport, {}, field_of_view).camera;
}

OrbitCamera homeCamera(const SceneBox& box, const Viewport& viewport, const ViewDirection& from)
{
    return homeView(box.corners(), box, viewport, from, OrbitCamera{}.field_of_view).camera;
}

OrbitCamera
fillingCamera(std::span<const SceneBox> boxes, const Viewport& viewport, Angle field_of_view)
{
    MARSVIEW_CHECK(!boxes.empty());
    SceneBox all = boxes.front();
    std::vector<ScenePoint> points;
    for (const SceneBox& box : boxes) {
        all = united(all, box);
        const auto corners = box.corners();
        points.insert(points.end(), corners.begin(), corners.end());
    }
    // A steeper view takes more of the picture's height. Halved until a step is not seen.
    constexpr int kHalvings = 10;
    Angle low = kFillingTiltMin;
    Angle high = kFillingTiltMax;
    for (int i = 0; i < kHalvings; ++i) {
        const Angle middle = (low + high) * 0.5;
        const bool is_wide =
            homeView(points, all, viewport, {.tilt = middle}, field_of_view).spare_m > 0.0;
        (is_wide ? high : low) = middle;
    }
    return homeView(points, all, viewport, {.tilt = (low + high) * 0.5}, field_of_view).camera;
}

namespace {

constexpr Angle kOpeningTilt = Angle::degrees(52.0);
// The widest picture that is filled, and how far it reaches toward the edges of the map.
constexpr double kOpeningAspect = 2.0;
constexpr double kOpeningShare = 0.85;

// Between the Tharsis volcanoes (247° E) and the canyons of Valles Marineris (255° to 310° E).
std::optional<OrbitCamera> openingCameraOfMars(const Georeference& georeference)
{
    const auto grid = georeference.toGrid(
        GeographicPoint{.longitude = Angle::degrees(266.0), .latitude = Angle::degrees(-1.0)});
    const double last_column = static_cast<double>(georeference.columns() - 1);
    const double last_row = static_cast<double>(georeference.rows() - 1);
    if (!grid || grid->column < 0.0 || grid->column > last_column || grid->row < 0.0 ||
        grid->row > last_row) {
        return std::nullopt;
    }
    OrbitCamera camera;
    camera.target = georeference.sceneFrame().toScene(*grid, 0.0);
    camera.distance_m = 5.6e6;
    camera.azimuth = Angle::degrees(-28.0);
    camera.tilt = kOpeningTilt;
    return camera;
}

} // namespace

bool hasOpeningPlace(const Georeference& georeference)
{
    const Body* body = georeference.body();
    return body != nullptr && georeference.wrapsAround() && body->name == "Mars" &&
           openingCameraOfMars(georeference);
}

std::optional<OrbitCamera> openingCamera(const Georeference& georeference)
{
    if (georeference.body() == nullptr || !georeference.wrapsAround()) {
        return std::nullopt;
    }
    if (hasOpeningPlace(georeference)) {
        return openingCameraOfMars(georeference);
    }
    const SceneFrame frame = georeference.sceneFrame();
    const ScenePoint first = frame.toScene(GridPoint{0.0, 0.0}, 0.0);
    const ScenePoint last = frame.toScene(GridPoint{static_cast<double>(georeference.columns() - 1),
                                                    static_cast<double>(georeference.rows() - 1)},
                                          0.0);
    const double width_m = std::abs(last.x - first.x);
    const double height_m = std::abs(last.y - first.y);
    OrbitCamera camera;
    camera.tilt = kOpeningTilt;
    // From the near to the far edge of the picture, along the ground, in camera distances.
    const double half_field = 0.5 * camera.field_of_view.radians();
    const double tilt = camera.tilt.radians();
    const double near_edge = std::cos(tilt) * (std::tan(tilt - half_field) - std::tan(tilt));
    const double far_edge = std::cos(tilt) * (std::tan(tilt + half_field) - std::tan(tilt));
    const double far_width = 2.0 * kOpeningAspect * std::tan(half_field) * std::cos(tilt) *
                             std::cos(half_field) / std::cos(tilt + half_field);
    camera.distance_m =
        kOpeningShare * std::min(height_m / (far_edge - near_edge), width_m / far_width);
    camera.target = {0.5 * (first.x + last.x),
                     0.5 * (first.y + last.y) - 0.5 * (near_edge + far_edge) * camera.distance_m,
                     0.0};
    return camera;
}

ScenePoint pointOnLevel(const Ray& ray, double level_m, double distance_max_m)
{
    const double t = (level_m - ray.origin.z) / ray.direction.z;
    return ray.at(t > 0.0 && t < distance_max_m ? t : distance_max_m);
}

OrbitCamera interpolated(const OrbitCamera& from, const OrbitCamera& to, double t)
{
    if (t <= 0.0) {
        return from;
    }
    if (t >= 1.0) {
        return to;
    }
    const auto mix = [](double a, double b, double share) { return a + (b - a) * share; };
    const double k = std::log(to.distance_m / from.distance_m);
    const double share = std::abs(k) < 1e-6 ? t : std::expm1(k * t) / std::expm1(k);
    OrbitCamera camera = from;
    camera.distance_m = from.distance_m * std::exp(k * t);
    camera.target = from.target + (to.target - from.target) * share;
    camera.azimuth = wrapped(from.azimuth + wrapped(to.azimuth - from.azimuth) * t);
    camera.tilt = Angle::radians(mix(from.tilt.radians(), to.tilt.radians(), t));
    camera.field_of_view =
        Angle::radians(mix(from.field_of_view.radians(), to.field_of_view.radians(), t));
    return camera;
}

} // namespace marsview
