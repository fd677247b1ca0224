#include "haptics/interaction/body_view.h"

#include "core/globe/body_motion.h"
#include "haptics/interaction/body_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

BodyCamera
cameraFollowing(const BodyHandView& before, const WorkspaceFrame& frame, const Ellipsoid& body)
{
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

WorkspaceFrame
frameFollowing(const BodyHandView& before, const BodyCamera& camera, const Ellipsoid& body)
{
    const double factor = camera.distance_m / before.camera.distance_m;
    const Rotation turn = axesAtTarget(camera, body) * axesAtTarget(before.camera, body).inverse();
    return {.anchor = before.frame.toWorkspace(targetOf(before.camera, body)),
            .place = targetOf(camera, body),
            .scene_per_meter = before.frame.scene_per_meter * factor,
            .body_axes = (turn * *before.frame.body_axes).orthonormal()};
}

LimitedBodyView
limitedView(const BodyHandView& followed, const BodyCamera& camera, const Ellipsoid& body)
{
    if (!isElsewhere(camera, followed.camera, body)) {
        return {.view = {.camera = camera, .frame = followed.frame}, .is_moved = false};
    }
    BodyCamera level = camera;
    level.height_m = followed.camera.height_m;
    return {.view = {.camera = camera, .frame = frameFollowing(followed, level, body)},
            .is_moved = true};
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
    constexpr int kSteps = 12;
    for (int row = 0; row <= kSteps; ++row) {
        for (int column = 0; column <= kSteps; ++column) {
            const PixelPoint pixel{viewport.width * column / static_cast<double>(kSteps),
                                   viewport.height * row / static_cast<double>(kSteps)};
            BodyPlace place =
                placeOf(pointOnBody(pickRay(pose, viewport, pixel), body, target), body);
            const double height_m = ground(place.foot);
            place.height_m = std::isfinite(height_m) ? height_m : camera.height_m;
            const Vec3 seen =
                to_site *
                (targetOf({.target = place.foot, .height_m = place.height_m}, body) - foot);
            box.minimum = {std::min(box.minimum.x, seen.x), std::min(box.minimum.y, seen.y),
                           std::min(box.minimum.z, seen.z)};
            box.maximum = {std::max(box.maximum.x, seen.x), std::max(box.maximum.y, seen.y),
                           std::max(box.maximum.z, seen.z)};
        }
    }
    return frameOverSite(body, site, box, reach);
}

void boundZoom(const BodyHandView& view, const BodyLimits& limits, ModeOptions& modes) noexcept
{
    const double scale = view.frame.scene_per_meter / view.camera.distance_m;
    modes.scene_per_meter_min = scale * limits.distance_min_m;
    modes.scene_per_meter_max = scale * limits.distance_max_m;
}

} // namespace marsview
