// A cap with six axes, pushed and turned, steers the camera: rates and a time to the next camera.
#pragma once

#include "core/base/angle.h"
#include "core/base/vec.h"
#include "core/view/navigation.h"

namespace marsview {

/// How far a cap is pushed and turned, as shares of what it can be, -1 to 1. Axes as the viewer has
/// them: x right, y away, z up; turns about them by the right hand.
struct CapRates {
    Vec3 push;
    Vec3 turn;
};

/// So near to rest a cap does nothing: it never comes back to the very same place, and a push along
/// one axis is always a little one along the others.
constexpr double kCapDeadZone = 0.08;

// At full push.
constexpr double kCapPanPerS = 1.0;  // camera distances
constexpr double kCapZoomPerS = 4.0; // factor of the distance
constexpr Angle kCapTurnPerS = Angle::degrees(90.0);
constexpr Angle kCapTiltPerS = Angle::degrees(45.0);

/// The share of the full speed, -1 to 1, for a rate: 0 in the dead zone, from its edge on the cube
/// of the way to full push, so that it sets in without a jerk and is fine near rest: half a push is
/// a tenth of the speed. Odd and monotonic; rates beyond -1 and 1 count as these, NaN as 0.
double capSpeed(double rate);

/// Whether the cap moves the camera at all, and whether it turns or tilts it. The camera does not
/// roll.
bool doesSteer(const CapRates& rates);
bool doesTurn(const CapRates& rates);

/// The camera `seconds` later, where the cap is the viewer: to the right and away it goes level,
/// down it goes nearer and up further, it turns as the cap is twisted, and looks up as the cap's
/// front is lifted. Level speed is by the camera's distance. Turns and zooms are about the target.
OrbitCamera steered(const OrbitCamera& camera,
                    const CapRates& rates,
                    double seconds,
                    const NavigationLimits& limits);

} // namespace marsview
