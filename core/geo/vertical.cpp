#include "core/geo/vertical.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace marsview {
namespace {

constexpr double kInternationalFootM = 0.3048;
constexpr double kUsSurveyFootM = 1200.0 / 3937.0;

struct Spelling {
    std::string_view text; // lower case, letters only
    std::string_view name;
    double metres;
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

} // namespace

std::optional<VerticalUnit> verticalUnitFrom(std::string_view text)
{
    std::string letters;
    for (const char c : text) {
        if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    const auto hit = std::find_if(kSpellings.begin(), kSpellings.end(),
                                  [&](const Spelling& s) { return s.text == letters; });
    if (hit == kSpellings.end()) {
        return std::nullopt;
    }
    return VerticalUnit{std::string(hit->name), hit->metres};
}

} // namespace marsview
