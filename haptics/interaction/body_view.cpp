#include "haptics/interaction/body_view.h"

#include "core/globe/body_motion.h"
#include "haptics/interaction/body_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

// Right, away and up at the target.
Rotation axesAtTarget(const BodyCamera& camera, const Ellipsoid& body)
{
    return axesAt(body, {.place = camera.target, .heading = camera.azimuth});
}

bool isElsewhere(const BodyCamera& camera, const BodyCamera& wanted, const Ellipsoid& body)
{
    constexpr double kShare = 1e-3;
    constexpr double kTurnDeg = 0.05;
    BodyCamera level = camera;
    level.height_m = wanted.height_m;
    // At a pole headings depend on the longitude: the axes are compared.
    const Vec3 ahead = axesAtTarget(level, body).y;
    const Vec3 wanted_ahead = axesAtTarget(wanted, body).y;
    const double way_m = length(targetOf(level, body) - targetOf(wanted, body));
    return way_m > kShare * wanted.distance_m ||
           std::abs(camera.distance_m / wanted.distance_m - 1.0) > kShare ||
           (length(ahead - wanted_ahead) > Angle::degrees(kTurnDeg).radians() &&
            std::abs(std::remainder((camera.azimuth - wanted.azimuth).degrees(), 360.0)) >
                kTurnDeg);
}

} // namespace

BodyCamera cameraFollowing(const BodyHandView& before, const WorkspaceFrame& frame)
{
    const Ellipsoid& body = before.body;
    const ScenePoint target =
        frame.toScene(before.frame.toWorkspace(targetOf(before.camera, body)));
    const Vec3 ahead = *frame.body_axes *
                       (before.frame.body_axes->inverse() * axesAtTarget(before.camera, body).y);
    const BodyPlace place = placeOf(target, body);
    const LocalAxes local = localAxes(body, place.foot);
    BodyCamera camera = before.camera;
    camera.target = place.foot;
    camera.height_m = place.height_m;
    camera.distance_m *= frame.scene_per_meter / before.frame.scene_per_meter;
    camera.azimuth = Angle::radians(std::atan2(dot(ahead, local.east), dot(ahead, local.north)));
    return camera;
}

WorkspaceFrame frameFollowing(const BodyHandView& before, const BodyCamera& camera)
{
    const Ellipsoid& body = before.body;
    const double factor = camera.distance_m / before.camera.distance_m;
    const Rotation turn = axesAtTarget(camera, body) * axesAtTarget(before.camera, body).inverse();
    return {.anchor = before.frame.toWorkspace(targetOf(before.camera, body)),
            .place = targetOf(camera, body),
            .scene_per_meter = before.frame.scene_per_meter * factor,
            .body_axes = (turn * *before.frame.body_axes).orthonormal()};
}

LimitedBodyView limitedView(const BodyHandView& followed, const BodyCamera& camera)
{
    BodyHandView view{.camera = camera, .frame = followed.frame, .body = followed.body};
    if (!isElsewhere(camera, followed.camera, followed.body)) {
        return {.view = view, .is_moved = false};
    }
    BodyCamera level = camera;
    level.height_m = followed.camera.height_m;
    view.frame = frameFollowing(followed, level);
    return {.view = view, .is_moved = true};
}

WorkspaceFrame frameForBodyView(const BodyCamera& camera,
                                const Viewport& viewport,
                                const BodyGround& ground,
                                const Ellipsoid& body,
                                const WorkspaceBox& reach)
{
    const BodySite site{.place = camera.target, .heading = camera.azimuth};
    const Rotation to_site = axesAt(body, site).inverse();
    const Vec3 foot = targetOf({.target = camera.target}, body);
    const CameraPose pose = poseOf(camera, body);
    const ScenePoint target = targetOf(camera, body);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    SceneBox box{.minimum = {kFar, kFar, kFar}, .maximum = {-kFar, -kFar, -kFar}};
    double lowest_m = kFar;
    double highest_m = -kFar;
    double fall_m = 0.0; // of the ellipsoid below the horizontal at the site
    constexpr int kSteps = 12;
    for (int row = 0; row <= kSteps; ++row) {
        for (int column = 0; column <= kSteps; ++column) {
            const PixelPoint pixel{viewport.width * column / static_cast<double>(kSteps),
                                   viewport.height * row / static_cast<double>(kSteps)};
            BodyPlace place =
                placeOf(pointOnBody(pickRay(pose, viewport, pixel), body, target), body);
            const double height_m = ground(place.foot);
            place.height_m = std::isfinite(height_m) ? height_m : camera.height_m;
            lowest_m = std::min(lowest_m, place.height_m);
            highest_m = std::max(highest_m, place.height_m);
            fall_m =
                std::max(fall_m, -(to_site * (targetOf({.target = place.foot}, body) - foot)).z);
            const Vec3 seen =
                to_site *
                (targetOf({.target = place.foot, .height_m = place.height_m}, body) - foot);
            box.minimum = {std::min(box.minimum.x, seen.x), std::min(box.minimum.y, seen.y),
                           std::min(box.minimum.z, seen.z)};
            box.maximum = {std::max(box.maximum.x, seen.x), std::max(box.maximum.y, seen.y),
                           std::max(box.maximum.z, seen.z)};
        }
    }
    // To hover over the terrain and to press into it. Of a ball, the side that faces up is then at
    // half the height of the workspace, where hands begin.
    const Vec3 extent = box.maximum - box.minimum;
    const double room_m = 0.15 * (highest_m - lowest_m) + 0.03 * std::hypot(extent.x, extent.y);
    box.minimum.z -= room_m;
    box.maximum.z += room_m + fall_m;
    return frameOverSite(body, site, box, reach);
}

std::optional<ScenePoint> terrainAlong(const WorkspaceFrame& frame,
                                       const WorkspacePoint& at,
                                       const BodyGround& ground,
                                       const Ellipsoid& body)
{
    const Vec3 down = -frame.body_axes->z;
    // From above all terrain.
    const Ray ray{frame.toScene(at) - down * (4.0 * body.equatorial_m), down};
    ScenePoint point{body.equatorial_m, 0.0, 0.0}; // on the ellipsoid, to begin with
    constexpr int kSteps = 4;
    for (int i = 0; i < kSteps; ++i) {
        const ScenePoint met = pointOnBody(ray, body, point);
        const Vec3 way = met - ray.origin;
        constexpr double kBeside = 1e-6;
        if (length(way - down * dot(way, down)) > kBeside * body.equatorial_m) {
            return std::nullopt; // the nearest point of a body beside the line
        }
        const GeographicPoint foot = placeOf(met, body).foot;
        const double height_m = ground(foot);
        if (!std::isfinite(height_m)) {
            return std::nullopt;
        }
        point = targetOf({.target = foot, .height_m = height_m}, body);
    }
    return point;
}

std::optional<ViewBounds> boundsFor(const BodyHandView& view, const BodyLimits& limits) noexcept
{
    if (!(limits.area.reach.radians() < std::numbers::pi)) {
        return std::nullopt;
    }
    const double latitude = limits.area.middle.latitude.radians();
    const double longitude = limits.area.middle.longitude.radians();
    return ViewBounds{.target = view.frame.toWorkspace(targetOf(view.camera, view.body)),
                      .middle = {std::cos(latitude) * std::cos(longitude),
                                 std::cos(latitude) * std::sin(longitude), std::sin(latitude)},
                      .reach_rad = limits.area.reach.radians()};
}

void boundZoom(const BodyHandView& view, const BodyLimits& limits, ModeOptions& modes) noexcept
{
    const double scale = view.frame.scene_per_meter / view.camera.distance_m;
    modes.scene_per_meter_min = scale * limits.distance_min_m;
    modes.scene_per_meter_max = scale * limits.distance_max_m;
}

} // namespace marsview
