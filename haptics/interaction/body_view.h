// Keeps the camera over a body and the workspace frame on it consistent while either moves.
#pragma once

#include "core/globe/body_navigation.h"
#include "haptics/interaction/hand_modes.h"
#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// A camera, and the placement of a device's workspace on the body that it shows.
struct BodyHandView {
    BodyCamera camera;
    WorkspaceFrame frame; // with body_axes
};

/// The camera after a hand has rolled, zoomed or turned the body from `before.frame` to `frame`:
/// the target's position relative to the hand does not change. Tilt and field of view are kept, and
/// the camera stays level. Both frames are sound.
BodyCamera
cameraFollowing(const BodyHandView& before, const WorkspaceFrame& frame, const Ellipsoid& body);

/// The frame after something else has moved the camera to `camera`, whose tilt has no effect: the
/// target's position relative to the hand does not change, and the local vertical at the target
/// keeps its direction in the workspace.
WorkspaceFrame
frameFollowing(const BodyHandView& before, const BodyCamera& camera, const Ellipsoid& body);

/// The view after the camera's limits have been applied to a view that follows the hand.
struct LimitedBodyView {
    BodyHandView view;
    bool is_moved = false; // the frame: the body moves in the workspace
};

/// `camera` is `followed.camera` within its limits. Another height of its target alone does not
/// move the body under the hand. Otherwise the body returns to the camera.
LimitedBodyView
limitedView(const BodyHandView& followed, const BodyCamera& camera, const Ellipsoid& body);

/// The frame in which `reach` covers what the camera sees of the body, from its lowest to its
/// highest visible place: the heading is away from the user, and the local vertical at the camera's
/// target is up. Heights are exaggerated; where there is no terrain, the target's height counts.
WorkspaceFrame frameForBodyView(const BodyCamera& camera,
                                const Viewport& viewport,
                                const BodyGround& ground,
                                const Ellipsoid& body,
                                const WorkspaceBox& reach);

/// Limits the zoom of `modes` to the camera's limits of distance.
void boundZoom(const BodyHandView& view, const BodyLimits& limits, ModeOptions& modes) noexcept;

} // namespace marsview
