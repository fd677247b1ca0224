#include "core/view/terrain_look.h"

#include "core/base/round_numbers.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr double kLinesMost = 30.0;     // over the whole range
constexpr double kRise = 0.1;           // the slope at which lines are well separated
constexpr double kPixelsBetween = 40.0; // at least, at that slope

} // namespace

double automaticContourInterval(const HeightRange& range, double meters_per_pixel)
{
    const double relief_m = range.maximum_m - range.minimum_m;
    if (!(relief_m > 0.0) || !(meters_per_pixel > 0.0) || !std::isfinite(relief_m) ||
        !std::isfinite(meters_per_pixel)) {
        return 0.0;
    }
    return roundNumberAbove(
        std::min(relief_m / kLinesMost, kRise * kPixelsBetween * meters_per_pixel));
}

double contourInterval(const TerrainLook& look,
                       const HeightRange& range,
                       double meters_per_pixel,
                       double exaggeration)
{
    if (!look.has_contours) {
        return 0.0;
    }
    return look.contour_interval_m > 0.0
               ? look.contour_interval_m
               : automaticContourInterval(range, meters_per_pixel / std::min(1.0, exaggeration));
}

} // namespace marsview
