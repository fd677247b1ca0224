// Four walls that keep the hand within the device's workspace, and the fade of the surface force.
#pragma once

#include "haptics/device/workspace.h"

namespace marsview {

/// Two forces that are each stable can be unstable together: where a wall and the surface push
/// along the same line, the hand feels the sum of both stiffnesses. The paper (section 4.2) fades
/// the surface force to zero faster than the wall's force rises. Here it has faded out where the
/// wall begins, so that the two never overlap. The fade is linear over this width, which keeps the
/// stiffness that it adds, force divided by width, small for a hand that presses a few millimeters
/// deep.
inline constexpr double kWallFadeM = 0.008;

struct WallContact {
    Vec3 force_n{};             // on the hand; horizontal
    double ground_share = 1.0;  // fraction of the surface force that is let through
    double penetration_m = 0.0; // 0 within the walls
};

/// Vertical walls at the box's four sides. Continuous in the hand's position. Servo thread.
WallContact
wallsAt(const WorkspaceBox& walls, const WorkspacePoint& hand, double stiffness_n_per_m) noexcept;

/// The part of the workspace with the full surface force; at least the middle half of its width and
/// depth, where walls are closer together than 32 mm.
WorkspaceBox reachWithin(const WorkspaceBox& walls) noexcept;

} // namespace marsview
