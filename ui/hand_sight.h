// What of the scene a hand at a device is to reach.
#pragma once

#include "core/session/scene_surface.h"
#include "core/view/camera.h"
#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// The frame in which a hand within `walls` reaches all of the ground that the camera sees, from
/// its lowest to its highest place and a little beyond. `ground` is not empty.
WorkspaceFrame frameForSight(const OrbitCamera& camera,
                             const Viewport& viewport,
                             const SceneSurface& ground,
                             double exaggeration,
                             const WorkspaceBox& walls);

} // namespace marsview
