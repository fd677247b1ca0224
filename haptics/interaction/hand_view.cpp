#include "haptics/interaction/hand_view.h"

namespace marsview {

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

} // namespace marsview
