// Keeps the camera and the workspace frame consistent while either moves.
#pragma once

#include "core/view/camera.h"
#include "core/view/navigation.h"
#include "haptics/interaction/hand_modes.h"
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

/// The view after the camera's limits have been applied to a view that follows the hand.
struct LimitedView {
    HandView view;
    bool is_moved = false; // the frame: the map moves in the workspace
};

/// `camera` is `followed.camera` within its limits. Another height of its target alone, as over a
/// rising terrain, does not move the map under the hand. Otherwise the map returns to the camera.
LimitedView limitedView(const HandView& followed, const OrbitCamera& camera) noexcept;

/// Where the camera's target may be while the hand moves the map. The tick keeps to it, so that the
/// map comes to rest at the limit instead of being moved back by the view.
struct ViewBounds {
    WorkspacePoint target{}; // the camera's target, constant while the camera follows the hand
    ScenePoint low{};        // horizontally, in the plane
    ScenePoint high{};
    // On a body, instead: an angle from a direction, a unit vector from its center.
    Vec3 middle{};
    double reach_rad = 0.0;
};

/// The bounds of a view, until something else than the hand moves it.
ViewBounds boundsFor(const HandView& view, const NavigationLimits& limits) noexcept;

/// Limits the zoom of `modes` to the camera's limits of distance.
void boundZoom(const HandView& view, const NavigationLimits& limits, ModeOptions& modes) noexcept;

} // namespace marsview
