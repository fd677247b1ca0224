#include "core/view/color_ramp.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

double linearFrom(std::uint8_t component)
{
    const double c = component / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::uint8_t componentFrom(double linear)
{
    const double bounded = std::clamp(linear, 0.0, 1.0);
    const double c =
        bounded <= 0.0031308 ? bounded * 12.92 : 1.055 * std::pow(bounded, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(c * 255.0));
}

Rgb8 rgbFrom(const Oklab& color)
{
    const auto cubed = [](double x) { return x * x * x; };
    const double l = cubed(color.l + 0.3963377774 * color.a + 0.2158037573 * color.b);
    const double m = cubed(color.l - 0.1055613458 * color.a - 0.0638541728 * color.b);
    const double s = cubed(color.l - 0.0894841775 * color.a - 1.2914855480 * color.b);
    return {.red = componentFrom(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            .green = componentFrom(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            .blue = componentFrom(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

// Designed in Oklab. The lightness of each even ramp rises by equal amounts from stop to stop
// (tested), from dark enough to stand out against white text to light enough to keep hill shading
// visible.
constexpr std::array kDawn{
    ColorStop{0.0, {33, 65, 116}},   ColorStop{0.2, {39, 105, 115}},
    ColorStop{0.4, {94, 137, 99}},   ColorStop{0.6, {164, 160, 86}},
    ColorStop{0.8, {241, 171, 111}}, ColorStop{1.0, {255, 210, 201}},
};
constexpr std::array kRust{
    ColorStop{0.0, {90, 46, 54}},    ColorStop{0.2, {133, 68, 55}},
    ColorStop{0.4, {175, 93, 57}},   ColorStop{0.6, {209, 126, 74}},
    ColorStop{0.8, {234, 165, 110}}, ColorStop{1.0, {251, 206, 162}},
};
constexpr std::array kGray{
    ColorStop{0.0, {77, 77, 79}},
    ColorStop{1.0, {234, 232, 228}},
};

// Through purple and red to straw, in equal steps of lightness, chroma and hue turning slowly.
constexpr std::array kEmber{
    ColorStop{0.0, {64, 26, 79}},   ColorStop{0.2, {124, 41, 94}},  ColorStop{0.4, {183, 67, 84}},
    ColorStop{0.6, {226, 112, 65}}, ColorStop{0.8, {242, 173, 87}}, ColorStop{1.0, {247, 229, 159}},
};
// From violet through teal to lime.
constexpr std::array kLagoon{
    ColorStop{0.0, {56, 24, 95}},    ColorStop{0.2, {57, 74, 133}},
    ColorStop{0.4, {41, 124, 147}},  ColorStop{0.6, {76, 169, 146}},
    ColorStop{0.8, {142, 209, 128}}, ColorStop{1.0, {231, 238, 112}},
};
// Blue and red-brown are a pair that every kind of color vision can distinguish.
constexpr std::array kDatum{
    ColorStop{0.0, {18, 59, 117}},   ColorStop{0.25, {86, 148, 199}},
    ColorStop{0.5, {233, 232, 223}}, ColorStop{0.75, {198, 119, 67}},
    ColorStop{1.0, {103, 37, 20}},
};
// Familiar from atlases. Its lightness is not monotonic, so it shows steps that do not exist, and
// many people cannot distinguish its greens and browns.
constexpr std::array kHypsometric{
    ColorStop{0.0, {38, 84, 64}},     ColorStop{0.25, {98, 140, 80}},
    ColorStop{0.45, {190, 178, 110}}, ColorStop{0.65, {160, 110, 70}},
    ColorStop{0.82, {120, 84, 68}},   ColorStop{1.0, {245, 243, 240}},
};

constexpr std::array kRamps{
    ColorRamp{.name = "dawn", .stops = kDawn},
    ColorRamp{.name = "rust", .stops = kRust},
    ColorRamp{.name = "grey", .stops = kGray},
    ColorRamp{.name = "ember", .stops = kEmber},
    ColorRamp{.name = "lagoon", .stops = kLagoon},
    ColorRamp{.name = "datum",
              .stops = kDatum,
              .evenness = RampEvenness::EvenToSides,
              .is_centered_on_datum = true},
    ColorRamp{.name = "hypsometric",
              .stops = kHypsometric,
              .evenness = RampEvenness::Uneven,
              .is_color_blind_safe = false},
};

// Airless bodies whose surface looks gray.
constexpr std::array<std::string_view, 6> kGrayBodies{"Moon",  "Mercury", "Ceres",
                                                      "Vesta", "Phobos",  "Deimos"};

} // namespace

std::span<const ColorRamp> colorRamps()
{
    return kRamps;
}

const ColorRamp* colorRampNamed(std::string_view name)
{
    const auto hit = std::find_if(kRamps.begin(), kRamps.end(),
                                  [name](const ColorRamp& ramp) { return ramp.name == name; });
    return hit != kRamps.end() ? &*hit : nullptr;
}

const ColorRamp& defaultColorRamp(std::string_view body_name)
{
    if (body_name == "Mars") {
        return kRamps[1];
    }
    const bool is_gray =
        std::find(kGrayBodies.begin(), kGrayBodies.end(), body_name) != kGrayBodies.end();
    return is_gray ? kRamps[2] : kRamps[0];
}

Oklab oklabFrom(Rgb8 color)
{
    const double r = linearFrom(color.red);
    const double g = linearFrom(color.green);
    const double b = linearFrom(color.blue);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {.l = 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            .a = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            .b = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

HeightRange tintedRange(const ColorRamp& ramp, const HeightRange& heights)
{
    if (!ramp.is_centered_on_datum) {
        return heights;
    }
    const double reach_m = std::max(std::abs(heights.minimum_m), std::abs(heights.maximum_m));
    return {.minimum_m = -reach_m, .maximum_m = reach_m};
}

double lightness(Rgb8 color)
{
    return oklabFrom(color).l;
}

std::array<Rgb8, 256> sampledRamp(const ColorRamp& ramp)
{
    std::array<Rgb8, 256> colors{};
    std::size_t next = 1;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const double position = static_cast<double>(i) / 255.0;
        while (next + 1 < ramp.stops.size() && ramp.stops[next].position < position) {
            ++next;
        }
        const ColorStop& a = ramp.stops[next - 1];
        const ColorStop& b = ramp.stops[next];
        const double t = std::clamp((position - a.position) / (b.position - a.position), 0.0, 1.0);
        const Oklab from = oklabFrom(a.color);
        const Oklab to = oklabFrom(b.color);
        colors[i] = rgbFrom({.l = from.l + (to.l - from.l) * t,
                             .a = from.a + (to.a - from.a) * t,
                             .b = from.b + (to.b - from.b) * t});
    }
    return colors;
}

} // namespace marsview
