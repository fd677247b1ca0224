#include "core/view/cap_steering.h"

#include <algorithm>
#include <cmath>

namespace marsview {

double capSpeed(double rate)
{
    const double beyond = std::abs(rate) - kCapDeadZone;
    if (!(beyond > 0.0)) {
        return 0.0; // also for NaN
    }
    const double share = std::min(beyond / (1.0 - kCapDeadZone), 1.0);
    return std::copysign(share * share * share, rate);
}

bool doesSteer(const CapRates& rates)
{
    return capSpeed(rates.push.x) != 0.0 || capSpeed(rates.push.y) != 0.0 ||
           capSpeed(rates.push.z) != 0.0 || doesTurn(rates);
}

bool doesTurn(const CapRates& rates)
{
    return capSpeed(rates.turn.x) != 0.0 || capSpeed(rates.turn.z) != 0.0;
}

OrbitCamera steered(const OrbitCamera& camera,
                    const CapRates& rates,
                    double seconds,
                    const NavigationLimits& limits)
{
    const double pan_share = kCapPanPerS * seconds;
    OrbitCamera next =
        panned(camera, pan_share * capSpeed(rates.push.x), pan_share * capSpeed(rates.push.y));
    // Azimuth is clockwise, rotations about the upward axis are counterclockwise.
    next = orbited(next, kCapTurnPerS * (-seconds * capSpeed(rates.turn.z)),
                   kCapTiltPerS * (seconds * capSpeed(rates.turn.x)));
    return zoomed(next, std::pow(kCapZoomPerS, seconds * capSpeed(rates.push.z)), next.target,
                  limits);
}

} // namespace marsview
