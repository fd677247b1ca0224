// How a device's workspace lies over the scene.
#pragma once

#include "core/base/angle.h"
#include "core/geo/frames.h"
#include "core/view/camera.h"
#include "core/view/footprint.h"
#include "core/view/scene_box.h"
#include "haptics/device/workspace.h"

namespace marsview {

/// A similarity: shift, scale, and a turn about the vertical. The nearest place of a surface is
/// thus the same in both, and forces are stiffness times workspace distance. A small value; all but
/// frameForView is for any thread, the servo's too.
struct WorkspaceFrame {
    WorkspacePoint anchor{};      // this point of the workspace
    ScenePoint place{};           // lies here
    double scene_per_metre = 1.0; // scene metres in one of the workspace; > 0
    Angle turn{}; // from the workspace's axes to the scene's, counter-clockwise seen from above

    bool operator==(const WorkspaceFrame&) const = default;

    ScenePoint toScene(const WorkspacePoint& point) const noexcept;
    WorkspacePoint toWorkspace(const ScenePoint& point) const noexcept;
    Vec3 differenceToWorkspace(const Vec3& scene_m) const noexcept;
    Vec3 differenceToScene(const Vec3& workspace_m) const noexcept;

    /// The map moved by `shift` in the workspace, as if pulled by a hand.
    WorkspaceFrame panned(const Vec3& shift) const noexcept;
    /// The map seen `factor` > 0 times as large, the place at `fixed` staying there.
    WorkspaceFrame zoomed(const WorkspacePoint& fixed, double factor) const noexcept;
    /// The map turned counter-clockwise about the vertical through `fixed`.
    WorkspaceFrame turned(const WorkspacePoint& fixed, Angle angle) const noexcept;
    /// Whether all of its numbers are finite and the scale is one.
    bool isSound() const noexcept;
};

/// The frame in which a hand within `reach` gets to everything that the camera sees of the map, and
/// up to the highest and down to the lowest of `box`: the view's heading is away from the user, and
/// the middle of what is seen is the middle of the reach. Where the camera sees nothing of the map,
/// around its target, as far as the camera is away.
WorkspaceFrame frameForView(const OrbitCamera& camera,
                            const Viewport& viewport,
                            const MapPlan& map,
                            const SceneBox& box,
                            const WorkspaceBox& reach);

/// The frame in which a hand within `reach` gets to all of the map, north away from the user.
WorkspaceFrame frameForMap(const SceneBox& box, const WorkspaceBox& reach) noexcept;

} // namespace marsview
