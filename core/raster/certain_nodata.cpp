#include "core/raster/certain_nodata.h"

namespace marsview {

std::optional<double> certainNodata(const RasterInfo& info)
{
    // The highest place known is Olympus Mons, 21.2 km. Deep-sea trenches reach to -10.9 km, but a
    // map whose lowest sample there is exactly -9999 m is not to be expected.
    constexpr double kLowestM = -9990.0;
    constexpr double kHighestM = 25000.0;
    if (!info.nodata_suggestion) {
        return std::nullopt;
    }
    const double height_m = info.elevationScale().height(*info.nodata_suggestion);
    return height_m > kLowestM && height_m < kHighestM ? std::nullopt : info.nodata_suggestion;
}

} // namespace marsview
