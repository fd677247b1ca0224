// A view and the hand's frame in it, kept together while either moves.
#pragma once

#include "core/view/camera.h"
#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// A camera, and how a device's workspace lies over the scene that it sees.
struct HandView {
    OrbitCamera camera;
    WorkspaceFrame frame;
};

/// The camera after a hand has pulled, zoomed or turned the map from `before.frame` to `frame`: it
/// is where it was as seen from the hand. Tilt and field of view stay. Both frames are sound.
OrbitCamera cameraFollowing(const HandView& before, const WorkspaceFrame& frame) noexcept;

/// The frame after something else has moved the camera to `camera`, whose tilt does not matter: its
/// target is where the other one's was as seen from the hand. Distances are > 0.
WorkspaceFrame frameFollowing(const HandView& before, const OrbitCamera& camera) noexcept;

} // namespace marsview
