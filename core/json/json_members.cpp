#include "core/json/json_members.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace marsview {

double degreesOf(Angle angle)
{
    const double quotient = angle.degrees();
    std::array<double, 3> candidates{quotient,
                                     std::nextafter(quotient, -std::numeric_limits<double>::max()),
                                     std::nextafter(quotient, std::numeric_limits<double>::max())};
    for (const int digits : {15, 16}) {
        const double rounded =
            std::strtod(fmt::format("{:.{}g}", quotient, digits).c_str(), nullptr);
        if (Angle::degrees(rounded) == angle) {
            return rounded;
        }
    }
    const auto* const exact =
        std::find_if(candidates.begin(), candidates.end(),
                     [angle](double degrees) { return Angle::degrees(degrees) == angle; });
    return exact != candidates.end() ? *exact : quotient;
}

} // namespace marsview
