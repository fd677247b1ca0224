// How a camera that would be below the terrain is tilted and lowered instead.
#pragma once

#include "core/base/angle.h"
#include "core/view/navigation.h"

#include <cmath>

namespace marsview {

/// The maximum height of a camera's target above the terrain at which that terrain is still well
/// inside the picture. Infinite if the view is so steep that it always is.
inline double hangMax(double distance_m, Angle tilt, Angle field_of_view)
{
    const double slope = kGroundLowest * std::tan(field_of_view.radians() / 2.0);
    const double fall = std::sin(tilt.radians()) - slope * std::cos(tilt.radians());
    return fall > 0.0 ? distance_m * slope / fall : HUGE_VAL;
}

/// The largest tilt, at most `tilt`, at which the eye is clear of the terrain: searched in steps,
/// because the terrain may rise and fall under the eye, then by bisection, so that it changes
/// smoothly. The eye counts as clear straight above the target.
template <typename IsClear>
Angle clearTilt(Angle tilt, const IsClear& is_clear_at)
{
    constexpr int kSteps = 32;
    constexpr int kBisections = 24;
    const auto is_clear = [&](double share) { return is_clear_at(tilt * share); };
    int step = kSteps - 1;
    while (step > 0 && !is_clear(static_cast<double>(step) / kSteps)) {
        --step;
    }
    double clear = static_cast<double>(step) / kSteps;
    double blocked = static_cast<double>(step + 1) / kSteps;
    for (int i = 0; i < kBisections; ++i) {
        const double middle = (clear + blocked) / 2.0;
        (is_clear(middle) ? clear : blocked) = middle;
    }
    return tilt * clear;
}

} // namespace marsview
