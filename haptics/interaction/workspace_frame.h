// The placement of a device's workspace in the scene.
#pragma once

#include "core/base/angle.h"
#include "core/base/rotation.h"
#include "core/geo/frames.h"
#include "core/view/camera.h"
#include "core/view/footprint.h"
#include "core/view/scene_box.h"
#include "haptics/device/recorded_tick.h"
#include "haptics/device/workspace.h"

#include <optional>

namespace marsview {

/// A similarity: translation, scale, and rotation, in the plane about the vertical. The nearest
/// point of a surface is thus the same in both, and forces are stiffness times workspace distance.
/// A small value; all functions except frameForView are for any thread, including the servo thread.
struct WorkspaceFrame {
    WorkspacePoint anchor{};      // this point of the workspace
    ScenePoint place{};           // maps to this point
    double scene_per_meter = 1.0; // scene meters per workspace meter; > 0
    Angle turn{}; // from the workspace's axes to the scene's, counterclockwise seen from above
    /// On a body, whose scene is the body-fixed frame: turns the workspace's axes to the scene's;
    /// `turn` is then 0.
    std::optional<Rotation> body_axes{};

    bool operator==(const WorkspaceFrame&) const = default;

    ScenePoint toScene(const WorkspacePoint& point) const noexcept;
    WorkspacePoint toWorkspace(const ScenePoint& point) const noexcept;
    Vec3 differenceToWorkspace(const Vec3& scene_m) const noexcept;
    Vec3 differenceToScene(const Vec3& workspace_m) const noexcept;

    /// The frame after the map has moved by `shift` in the workspace, as if pulled by a hand.
    WorkspaceFrame panned(const Vec3& shift) const noexcept;
    /// The frame after the map has been magnified by `factor` > 0 about `fixed`.
    WorkspaceFrame zoomed(const WorkspacePoint& fixed, double factor) const noexcept;
    /// The frame after the map has been turned counterclockwise about the vertical through `fixed`.
    WorkspaceFrame turned(const WorkspacePoint& fixed, Angle angle) const noexcept;
    /// The frame after the scene has moved in the workspace as it does from `from` to `to`: `to`,
    /// if this frame is `from`.
    WorkspaceFrame moved(const WorkspaceFrame& from, const WorkspaceFrame& to) const noexcept;
    /// The motion of the camera that this frame's motion from `from` is. Both are in the plane, or
    /// both on a body.
    SceneMotion motionFrom(const WorkspaceFrame& from) const noexcept;
    /// The frame after that motion, one of its scene; a motion of another scene changes nothing.
    WorkspaceFrame after(const SceneMotion& motion) const noexcept;
    /// Whether all numbers are finite and the scale is valid.
    bool isSound() const noexcept;
};

/// Both motions of a scene as one; `last` alone if they are of different scenes.
SceneMotion combined(const SceneMotion& first, const SceneMotion& last) noexcept;

/// The frame in which `reach` covers all of the map that the camera sees, from the lowest to the
/// highest point of `box`: the view's heading is away from the user, and the center of the visible
/// part is the center of the reach. If the camera sees nothing of the map, the frame covers the
/// surroundings of the camera's target, out to the camera's distance.
WorkspaceFrame frameForView(const OrbitCamera& camera,
                            const Viewport& viewport,
                            const MapPlan& map,
                            const SceneBox& box,
                            const WorkspaceBox& reach);

/// The frame in which `reach` covers the whole map, north away from the user.
WorkspaceFrame frameForMap(const SceneBox& box, const WorkspaceBox& reach) noexcept;

} // namespace marsview
