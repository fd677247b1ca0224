// What of the scene a hand at a device is to reach.
#pragma once

#include "core/session/scene_surface.h"
#include "core/view/camera.h"
#include "haptics/interaction/workspace_frame.h"

#include <optional>

namespace marsview {

/// The frame in which a hand within `walls` reaches all of the ground that the camera sees, from
/// its lowest to its highest place and a little beyond. `ground` is not empty.
WorkspaceFrame frameForSight(const OrbitCamera& sight,
                             const Viewport& viewport,
                             const SceneSurface& ground,
                             double exaggeration,
                             const WorkspaceBox& walls);

/// The rectangle of the workspace, level and within `reach`, above which all of the terrain lies
/// well inside the picture and takes up most of it: a simulated hand that strokes there stays in
/// sight. Empty if the camera sees hardly any terrain. Terrain that hides other terrain is not
/// considered.
std::optional<WorkspaceBox> strokesInSight(const OrbitCamera& camera,
                                           const Viewport& viewport,
                                           const SceneSurface& ground,
                                           double exaggeration,
                                           const WorkspaceFrame& frame,
                                           const WorkspaceBox& reach);

/// The highest terrain in a rectangle of the workspace, in workspace meters; the rectangle's lower
/// side if there is none.
double highestTerrainIn(const WorkspaceBox& rectangle,
                        const SceneSurface& ground,
                        double exaggeration,
                        const WorkspaceFrame& frame);

} // namespace marsview
