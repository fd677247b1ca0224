// The modes of a hand with a device over a map on its body.
#pragma once

#include "core/base/rotation.h"
#include "core/geo/body.h"
#include "haptics/interaction/hand_modes.h"

namespace marsview {

struct BodyModeState {
    /// Of a body that the hand has set in motion, about its center, along the workspace's axes.
    Vec3 spin_rad_per_s{};
    /// From the workspace's axes to those at the hand, whose z is the local vertical. Kept while
    /// zooming.
    Rotation level;
};

/// As stepModes(), with the local vertical at the hand in place of the workspace's. Pan: the body
/// rolls under the hand about its center, with inertia, and the hand's height over the ellipsoid is
/// held. Since an ellipsoid is not a sphere, the body is also leveled: neither the local vertical
/// at the hand nor the height there change in the workspace. Zoom: about a point on the vertical
/// through the hand, with twist about that vertical. A released body keeps its axis. `input.frame`
/// has body_axes; `input.clearance_m` is along the vertical.
/// Servo thread.
ModeStep stepBodyModes(const ModeOptions& options,
                       const ModeInput& input,
                       const Ellipsoid& body,
                       ModeState& state,
                       BodyModeState& body_state,
                       double dt_s) noexcept;

/// The frame after the body has turned in the workspace by `turn_rad`, about its center, and has
/// been leveled for a hand there. `frame` has body_axes.
WorkspaceFrame rolled(const WorkspaceFrame& frame,
                      const Ellipsoid& body,
                      const WorkspacePoint& hand,
                      const Vec3& turn_rad) noexcept;

} // namespace marsview
