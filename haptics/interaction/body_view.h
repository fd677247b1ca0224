// Keeps the camera over a body and the workspace frame on it consistent while either moves.
#pragma once

#include "core/globe/body_navigation.h"
#include "haptics/interaction/hand_modes.h"
#include "haptics/interaction/hand_view.h"
#include "haptics/interaction/workspace_frame.h"

#include <optional>

namespace marsview {

/// A camera, and the placement of a device's workspace on the body that it shows.
struct BodyHandView {
    BodyCamera camera;
    WorkspaceFrame frame; // with body_axes
    Ellipsoid body;
};

/// The camera after a hand has rolled, zoomed or turned the body from `before.frame` to `frame`:
/// the target's position relative to the hand does not change. Tilt and field of view are kept, and
/// the camera stays level. Both frames are sound.
BodyCamera cameraFollowing(const BodyHandView& before, const WorkspaceFrame& frame);

/// The frame after something else has moved the camera to `camera`, whose tilt has no effect: the
/// target's position relative to the hand does not change, and the local vertical at the target
/// keeps its direction in the workspace.
WorkspaceFrame frameFollowing(const BodyHandView& before, const BodyCamera& camera);

/// The view after the camera's limits have been applied to a view that follows the hand.
struct LimitedBodyView {
    BodyHandView view;
    bool is_moved = false; // the frame: the body moves in the workspace
};

/// `camera` is `followed.camera` within its limits. Another height of its target alone does not
/// move the body under the hand. Otherwise the body returns to the camera.
LimitedBodyView limitedView(const BodyHandView& followed, const BodyCamera& camera);

/// The frame in which `reach` covers what the camera sees of the body, from its lowest visible
/// place to as far above the terrain: the heading is away from the user, and the local vertical at
/// the camera's target is up. Heights are exaggerated; where there is no terrain, the target's
/// height counts.
WorkspaceFrame frameForBodyView(const BodyCamera& camera,
                                const Viewport& viewport,
                                const BodyGround& ground,
                                const Ellipsoid& body,
                                const WorkspaceBox& reach);

/// The terrain on a line along the workspace's vertical, on the side that faces up: where a hand at
/// `at` meets it as it goes straight down or up. Empty beside the body and without terrain.
/// `ground` is exaggerated. To about a hundredth of a cell where the terrain is level; near the
/// edge of a body the line may meet other terrain first.
std::optional<ScenePoint> terrainAlong(const WorkspaceFrame& frame,
                                       const WorkspacePoint& at,
                                       const BodyGround& ground,
                                       const Ellipsoid& body);

/// The bounds of a view, until something else than the hand moves it; empty for all of the body.
std::optional<ViewBounds> boundsFor(const BodyHandView& view, const BodyLimits& limits) noexcept;

/// Limits the zoom of `modes` to the camera's limits of distance.
void boundZoom(const BodyHandView& view, const BodyLimits& limits, ModeOptions& modes) noexcept;

} // namespace marsview
