#include "core/measure/measured_digits.h"

#include "core/measure/attitude.h"
#include "core/measure/constants.h"
#include "core/measure/crater.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr int kDigitsMin = 2;
constexpr int kDigitsMax = 6;
constexpr int kDigitsUnknown = 4;

// The power of ten of the first digit. Rounding errors of values such as 999.9999999999999 do not
// count.
int firstPlace(double value)
{
    return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
}

} // namespace

int lastPlace(double value, double uncertainty)
{
    const bool is_number = std::isfinite(value) && value != 0.0;
    if (!(uncertainty > 0.0) || !std::isfinite(uncertainty)) {
        return is_number ? firstPlace(value) - kDigitsUnknown + 1 : 0;
    }
    const int place = firstPlace(uncertainty) - 1;
    return is_number ? std::clamp(place, firstPlace(value) - kDigitsMax + 1,
                                  firstPlace(value) - kDigitsMin + 1)
                     : place;
}

WrittenNumber writtenNumber(double value, int last_place, int unit_power)
{
    // Powers of ten below 1 are not exact: 0.1 is not a number of the machine, 10 is.
    const double power = std::pow(10.0, std::abs(last_place));
    const double rounded =
        last_place > 0 ? std::round(value / power) * power : std::round(value * power) / power;
    const double unit = std::pow(10.0, unit_power);
    return {.value = rounded / unit, .decimals = std::max(0, unit_power - last_place)};
}

MeasuredResolution
resolutionOf(const Georeference& georeference, const RasterInfo& info, double elevation_m)
{
    const double ground_m =
        std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters());
    const double step_m =
        std::isfinite(elevation_m) ? 2.0 * elevationStepError(info, elevation_m) : 0.0;
    return {.ground_m = ground_m, .height_m = std::max(step_m, std::min(1.0, 0.1 * ground_m))};
}

// A level of 0 is a place like others: its digits do not depend on its size.
int MeasuredDigits::elevation(double elevation_m) const
{
    return resolution_.height_m > 0.0 ? firstPlace(resolution_.height_m) - 1
                                      : lastPlace(elevation_m, 0.0);
}

int MeasuredDigits::area(double area_m2, double perimeter_m) const
{
    return lastPlace(area_m2, resolution_.ground_m * perimeter_m);
}

int MeasuredDigits::volume(double volume_m3, double area_m2) const
{
    return lastPlace(volume_m3, resolution_.height_m * area_m2);
}

int MeasuredDigits::diameter(double diameter_m, double rms_m) const
{
    return lastPlace(diameter_m, rms_m > 0.0 ? std::max(rms_m, 0.1 * resolution_.ground_m)
                                             : resolution_.ground_m);
}

double MeasuredDigits::depthError(const Crater& crater) const
{
    const double away_m =
        std::max(resolution_.ground_m, crater.hasResiduals() ? crater.rms_m : 0.0);
    return resolution_.height_m + 2.0 * std::abs(crater.depth_m) * away_m / crater.diameter_m;
}

int MeasuredDigits::depth(const Crater& crater) const
{
    return lastPlace(crater.depth_m, depthError(crater));
}

int MeasuredDigits::depthToDiameter(const Crater& crater) const
{
    const double ratio = crater.depth_m / crater.diameter_m;
    const double uncertainty =
        (depthError(crater) + std::abs(ratio) * resolution_.ground_m) / crater.diameter_m;
    const int second_digit = lastPlace(ratio, std::abs(ratio));
    return std::clamp(lastPlace(ratio, uncertainty), std::min(-3, second_digit), -2);
}

int MeasuredDigits::direction(double length_m) const
{
    return resolution_.ground_m > 0.0
               ? anglePlace(std::atan2(resolution_.ground_m, length_m) * kDegreesPerRadian)
               : kSlopePlace;
}

int anglePlace(double uncertainty_deg)
{
    return uncertainty_deg > 0.0 && std::isfinite(uncertainty_deg)
               ? std::clamp(firstPlace(uncertainty_deg) - 1, -2, 0)
               : kSlopePlace;
}

} // namespace marsview
