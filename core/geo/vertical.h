// Vertical units and vertical datums.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace marsview {

/// A unit of height. `name` is for display ("m", "ft", "US survey ft", "km").
struct VerticalUnit {
    std::string name = "m";
    double meters = 1.0;
    bool operator==(const VerticalUnit&) const = default;
};

/// Understands the spellings met in raster files ("metre", "METERS", "feet", "ftUS", "US survey
/// foot", "km", …), case-insensitive, with a factor in front ("1000*METER", "0.1 m"). A bare foot
/// is the international one of 0.3048 m, which differs from the survey foot by 2 parts in a
/// million. Empty if the text is empty or unknown.
std::optional<VerticalUnit> verticalUnitFrom(std::string_view text);

} // namespace marsview
