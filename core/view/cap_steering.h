// Steers the camera with a six-axis cap: from rates and a time step to the next camera.
#pragma once

#include "core/base/angle.h"
#include "core/base/vec.h"
#include "core/view/navigation.h"

namespace marsview {

/// The deflection of a cap as a fraction of its maximum, -1 to 1. Axes relative to the viewer: x
/// right, y away, z up; rotations about them by the right-hand rule.
struct CapRates {
    Vec3 push;
    Vec3 turn;
};

/// Dead zone around rest: a cap never returns exactly to its rest position, and a push along one
/// axis always moves the others slightly.
constexpr double kCapDeadZone = 0.08;

// At full deflection.
constexpr double kCapPanPerS = 1.0;  // camera distances
constexpr double kCapZoomPerS = 4.0; // factor of the distance
constexpr Angle kCapTurnPerS = Angle::degrees(90.0);
constexpr Angle kCapTiltPerS = Angle::degrees(45.0);

/// The fraction of the full speed, -1 to 1, for a rate: 0 in the dead zone, beyond it the cube of
/// the remaining deflection, so that motion starts smoothly and is fine near rest: half a
/// deflection gives a tenth of the speed. Odd and monotonic; rates are clamped to [-1, 1], NaN
/// counts as 0.
double capSpeed(double rate);

/// Whether the cap moves the camera at all, and whether it turns or tilts it. The camera does not
/// roll.
bool doesSteer(const CapRates& rates);
bool doesTurn(const CapRates& rates);

/// The camera `seconds` later, moved as if the cap were the viewer: right and away pan
/// horizontally, down zooms in and up zooms out, twisting turns the view, and lifting the cap's
/// front looks up. The pan speed is proportional to the camera's distance. Rotation and zoom are
/// about the target.
OrbitCamera steered(const OrbitCamera& camera,
                    const CapRates& rates,
                    double seconds,
                    const NavigationLimits& limits);

} // namespace marsview
