#include "core/view/scale_bar.h"

#include "core/base/round_numbers.h"

#include <algorithm>
#include <cmath>

namespace marsview {

std::optional<ScaleBar> scaleBar(double meters_per_pixel, double width_max_px)
{
    constexpr double kShortest = 1e-300; // meters
    const double length_max_m = meters_per_pixel * width_max_px;
    if (!(meters_per_pixel > 0.0) || !(width_max_px > 0.0) || !(length_max_m > kShortest) ||
        !std::isfinite(length_max_m)) {
        return std::nullopt;
    }
    const double length_m = roundNumberBelow(length_max_m);
    // Rounding to a round number may make the bar a billionth too long.
    return ScaleBar{.length_m = length_m,
                    .width_px = std::min(length_m / meters_per_pixel, width_max_px)};
}

} // namespace marsview
