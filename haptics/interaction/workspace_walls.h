// The four walls that keep a hand where its device works, and how the ground gives way to them.
#pragma once

#include "haptics/device/workspace.h"

namespace marsview {

/// Two forces that are stable each need not be so together: where a wall and the ground push along
/// the same line, the hand feels the sum of both stiffnesses. The paper (section 4.2) fades the
/// ground's force to zero faster than the wall's rises. Here it has faded out where the wall
/// begins, so that no place has both. The fade is linear and as wide as this, which keeps what it
/// adds to the ground's stiffness, the force over the width, small for a hand that presses a few
/// millimetres deep.
inline constexpr double kWallFadeM = 0.008;

struct WallContact {
    Vec3 force_n{};             // on the hand; level
    double ground_share = 1.0;  // of the ground's force that is let through
    double penetration_m = 0.0; // 0 within the walls
};

/// Vertical walls at the box's four sides. Continuous in the hand's position. Servo thread.
WallContact
wallsAt(const WorkspaceBox& walls, const WorkspacePoint& hand, double stiffness_n_per_m) noexcept;

/// What a hand within the walls reaches with the ground's whole force.
WorkspaceBox reachWithin(const WorkspaceBox& walls) noexcept;

} // namespace marsview
