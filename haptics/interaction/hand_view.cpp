#include "haptics/interaction/hand_view.h"

#include <cmath>

namespace marsview {
namespace {

bool isElsewhere(const OrbitCamera& camera, const OrbitCamera& wanted) noexcept
{
    constexpr double kShare = 1e-3;
    return length(camera.target - wanted.target) > kShare * wanted.distance_m ||
           std::abs(camera.distance_m / wanted.distance_m - 1.0) > kShare ||
           std::abs(std::remainder((camera.azimuth - wanted.azimuth).degrees(), 360.0)) > 0.05;
}

} // namespace

OrbitCamera cameraFollowing(const HandView& before, const WorkspaceFrame& frame) noexcept
{
    OrbitCamera camera = before.camera;
    camera.target = frame.toScene(before.frame.toWorkspace(camera.target));
    camera.distance_m *= frame.scene_per_meter / before.frame.scene_per_meter;
    // Headings are clockwise.
    camera.azimuth = camera.azimuth + before.frame.turn + -frame.turn;
    return camera;
}

WorkspaceFrame frameFollowing(const HandView& before, const OrbitCamera& camera) noexcept
{
    const double factor = camera.distance_m / before.camera.distance_m;
    return {.anchor = before.frame.toWorkspace(before.camera.target),
            .place = camera.target,
            .scene_per_meter = before.frame.scene_per_meter * factor,
            .turn = before.frame.turn + before.camera.azimuth + -camera.azimuth};
}

LimitedView limitedView(const HandView& followed, const OrbitCamera& camera) noexcept
{
    OrbitCamera level = camera;
    level.target.z = followed.camera.target.z;
    if (!isElsewhere(level, followed.camera)) {
        return {.view = {.camera = camera, .frame = followed.frame}, .is_moved = false};
    }
    return {.view = {.camera = camera, .frame = frameFollowing(followed, level)}, .is_moved = true};
}

ViewBounds boundsFor(const HandView& view, const NavigationLimits& limits) noexcept
{
    return {.target = view.frame.toWorkspace(view.camera.target),
            .low = limits.box.minimum,
            .high = limits.box.maximum};
}

void boundZoom(const HandView& view, const NavigationLimits& limits, ModeOptions& modes) noexcept
{
    const double scale = view.frame.scene_per_meter / view.camera.distance_m;
    modes.scene_per_meter_min = scale * limits.distance_min_m;
    modes.scene_per_meter_max = scale * limits.distance_max_m;
}

} // namespace marsview
