// Color ramps for elevations, as data.
#pragma once

#include "core/terrain/heightfield.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace marsview {

/// Components in sRGB.
struct Rgb8 {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    constexpr bool operator==(const Rgb8&) const = default;
};

struct ColorStop {
    double position = 0.0; // 0 … 1, ascending
    Rgb8 color;
};

/// How a ramp shows equal steps of elevation.
enum class RampEvenness {
    Even,        // lightness rises evenly from end to end: equal steps look equally large
    EvenToSides, // likewise from the middle outwards, with lightness falling evenly
    Uneven,      // some elevations stand out without reason; for illustration, not for analysis
};

/// A named color ramp.
struct ColorRamp {
    std::string_view name; // stable, for files; not shown
    std::span<const ColorStop> stops;
    RampEvenness evenness = RampEvenness::Even;
    /// Positions an eighth of the ramp apart are distinguishable for people who lack one type of
    /// cone.
    bool is_color_blind_safe = true;
    /// The middle is the datum: elevations above and below differ in hue (see tintedRange()).
    bool is_centered_on_datum = false;
};

/// The even ramps with rising lightness (dawn, rust, grey, ember, lagoon), then "datum", blue below
/// and red above, and "hypsometric", the green, brown and white of school atlases.
std::span<const ColorRamp> colorRamps();
const ColorRamp* colorRampNamed(std::string_view name);
/// The default ramp for a body by name: rust for Mars, grey for airless bodies, otherwise the
/// general one. An empty name means any other body.
const ColorRamp& defaultColorRamp(std::string_view body_name);

/// The elevations at the ends of a ramp on a map with these elevations: their range or, for a ramp
/// centered on the datum, the symmetric range around 0 m that encloses them.
HeightRange tintedRange(const ColorRamp& ramp, const HeightRange& heights);

/// A color in Oklab: lightness 0 … 1, green to red, blue to yellow. Distances are approximately
/// perceptual; 0.02 is about the just-noticeable difference.
struct Oklab {
    double l = 0.0;
    double a = 0.0;
    double b = 0.0;
};

Oklab oklabFrom(Rgb8 color);

/// Perceived lightness of a color, 0 (black) … 1 (white): the L of Oklab.
double lightness(Rgb8 color);

/// 256 colors along the ramp, mixed in Oklab (Björn Ottosson, "A perceptual color space for image
/// processing", 2020) so that they neither darken nor turn gray between the stops.
std::array<Rgb8, 256> sampledRamp(const ColorRamp& ramp);

} // namespace marsview
