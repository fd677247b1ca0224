// Keeps the camera and the workspace frame consistent while either moves.
#pragma once

#include "core/view/camera.h"
#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// A camera, and the placement of a device's workspace in its scene.
struct HandView {
    OrbitCamera camera;
    WorkspaceFrame frame;
};

/// The camera after a hand has moved, zoomed or turned the map from `before.frame` to `frame`: its
/// position relative to the hand does not change. Tilt and field of view are kept. Both frames are
/// sound.
OrbitCamera cameraFollowing(const HandView& before, const WorkspaceFrame& frame) noexcept;

/// The frame after something else has moved the camera to `camera`, whose tilt has no effect: the
/// target's position relative to the hand does not change. Distances are > 0.
WorkspaceFrame frameFollowing(const HandView& before, const OrbitCamera& camera) noexcept;

} // namespace marsview
