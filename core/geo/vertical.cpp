#include "core/geo/vertical.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>

namespace marsview {
namespace {

constexpr double kInternationalFootM = 0.3048;
constexpr double kUsSurveyFootM = 1200.0 / 3937.0;

struct Spelling {
    std::string_view text; // lower case, letters only
    std::string_view name;
    double meters;
};

constexpr std::array kSpellings{
    Spelling{"m", "m", 1.0},
    Spelling{"meter", "m", 1.0},
    Spelling{"meters", "m", 1.0},
    Spelling{"metre", "m", 1.0},
    Spelling{"metres", "m", 1.0},
    Spelling{"ft", "ft", kInternationalFootM},
    Spelling{"foot", "ft", kInternationalFootM},
    Spelling{"feet", "ft", kInternationalFootM},
    Spelling{"internationalfoot", "ft", kInternationalFootM},
    Spelling{"internationalfeet", "ft", kInternationalFootM},
    Spelling{"ftus", "US survey ft", kUsSurveyFootM},
    Spelling{"usft", "US survey ft", kUsSurveyFootM},
    Spelling{"ussurveyft", "US survey ft", kUsSurveyFootM},
    Spelling{"ussurveyfoot", "US survey ft", kUsSurveyFootM},
    Spelling{"ussurveyfeet", "US survey ft", kUsSurveyFootM},
    Spelling{"footus", "US survey ft", kUsSurveyFootM},
    Spelling{"km", "km", 1000.0},
    Spelling{"kilometer", "km", 1000.0},
    Spelling{"kilometers", "km", 1000.0},
    Spelling{"kilometre", "km", 1000.0},
    Spelling{"kilometres", "km", 1000.0},
    Spelling{"cm", "cm", 0.01},
    Spelling{"centimeter", "cm", 0.01},
    Spelling{"centimeters", "cm", 0.01},
    Spelling{"centimetre", "cm", 0.01},
    Spelling{"centimetres", "cm", 0.01},
    Spelling{"dm", "dm", 0.1},
    Spelling{"decimeter", "dm", 0.1},
    Spelling{"decimetre", "dm", 0.1},
    Spelling{"yd", "yd", 0.9144},
    Spelling{"yard", "yd", 0.9144},
    Spelling{"fathom", "fathom", 1.8288},
    Spelling{"fathoms", "fathom", 1.8288},
};

std::string_view withoutLeading(std::string_view text, std::string_view characters)
{
    text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
    return text;
}

// A unit without a factor. Digits and operators make another unit of it: m/s, m^2, 10**3 m.
std::optional<VerticalUnit> plainUnitFrom(std::string_view text)
{
    if (text.find_first_of("0123456789*/^") != std::string_view::npos) {
        return std::nullopt;
    }
    std::string letters;
    for (const char c : text) {
        if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    const auto* const hit = std::find_if(kSpellings.begin(), kSpellings.end(),
                                         [&](const Spelling& s) { return s.text == letters; });
    if (hit == kSpellings.end()) {
        return std::nullopt;
    }
    return VerticalUnit{std::string(hit->name), hit->meters};
}

// 1000 m is 1 km; other multiples keep their factor as a name.
VerticalUnit multipleOf(const VerticalUnit& unit, double factor)
{
    const double meters = factor * unit.meters;
    const auto* const known = std::find_if(kSpellings.begin(), kSpellings.end(),
                                           [&](const Spelling& s) { return s.meters == meters; });
    return known != kSpellings.end()
               ? VerticalUnit{std::string(known->name), meters}
               : VerticalUnit{fmt::format("{} {}", factor, unit.name), meters};
}

} // namespace

std::optional<VerticalUnit> verticalUnitFrom(std::string_view text)
{
    constexpr std::string_view kSpace = " \t\r\n";
    text = withoutLeading(text, kSpace);
    double factor = 1.0;
    const auto number = std::from_chars(text.data(), text.data() + text.size(), factor);
    if (number.ec != std::errc{}) {
        return plainUnitFrom(text);
    }
    std::string_view rest(number.ptr,
                          text.size() - static_cast<std::size_t>(number.ptr - text.data()));
    rest = withoutLeading(rest, kSpace);
    if (rest.starts_with('*')) {
        rest = withoutLeading(rest.substr(1), kSpace);
    }
    const std::optional<VerticalUnit> unit = plainUnitFrom(rest);
    if (!unit || !std::isfinite(factor) || factor <= 0.0) {
        return std::nullopt;
    }
    return multipleOf(*unit, factor);
}

} // namespace marsview
