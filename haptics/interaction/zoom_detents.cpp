#include "haptics/interaction/zoom_detents.h"

#include <cmath>

namespace marsview {

double zoomFactor(const ZoomOptions& options, double rise_m) noexcept
{
    return std::exp2(rise_m / options.meters_per_doubling);
}

double detentStep(const ZoomOptions& options) noexcept
{
    return options.meters_per_doubling / options.detents_per_doubling;
}

double aboveDetent(const ZoomOptions& options, double scene_per_meter) noexcept
{
    const double steps = -std::log2(scene_per_meter) * options.detents_per_doubling;
    return (steps - std::round(steps)) * detentStep(options);
}

double detentForce(const ZoomOptions& options, double above_m) noexcept
{
    const double half_m = 0.5 * detentStep(options);
    const double distance_m = std::abs(above_m);
    const double lever_m = distance_m < 0.5 * half_m ? distance_m
                           : distance_m < half_m     ? half_m - distance_m
                                                     : 0.0;
    return -std::copysign(options.detent_n_per_m * lever_m, above_m);
}

} // namespace marsview
