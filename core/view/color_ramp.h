// Colours for heights, as data.
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

/// What a ramp promises of equal steps of height.
enum class RampEvenness {
    Even,        // lightness rises evenly from end to end: equal steps look equally far apart
    EvenToSides, // so do they from the middle outwards, where lightness falls evenly
    Uneven,      // some heights stand out that are not special; for looking, not for judging
};

/// A named run of colours.
struct ColorRamp {
    std::string_view name; // stable, for files; not shown
    std::span<const ColorStop> stops;
    RampEvenness evenness = RampEvenness::Even;
    /// No two places an eighth of the ramp apart look alike to people who lack one kind of cones.
    bool is_color_blind_safe = true;
    /// The middle is the datum: heights above and below differ in hue (see tintedRange()).
    bool is_centred_on_datum = false;
};

/// The even ramps that climb (dawn, rust, grey, ember, lagoon), then "datum", blue below and red
/// above, and "hypsometric", the green, brown and white of school atlases.
std::span<const ColorRamp> colorRamps();
const ColorRamp* colorRampNamed(std::string_view name);
/// The ramp that suits a body by name: rust for Mars, grey for airless bodies, else the general
/// one. An empty name is any other body.
const ColorRamp& defaultColorRamp(std::string_view body_name);

/// The heights that the ends of a ramp stand for on a map of these heights: the same, or for a ramp
/// centred on the datum the range around 0 m that encloses them.
HeightRange tintedRange(const ColorRamp& ramp, const HeightRange& heights);

/// A colour in Oklab: lightness 0 … 1, green to red, blue to yellow. Distances in it are about as
/// large as they look; 0.02 is about what is just noticed.
struct Oklab {
    double l = 0.0;
    double a = 0.0;
    double b = 0.0;
};

Oklab oklabFrom(Rgb8 color);

/// Perceived lightness of a colour, 0 (black) … 1 (white): the L of Oklab.
double lightness(Rgb8 color);

/// 256 colours along the ramp, mixed in Oklab (Björn Ottosson, "A perceptual color space for image
/// processing", 2020) so that they neither darken nor grey between the stops.
std::array<Rgb8, 256> sampledRamp(const ColorRamp& ramp);

} // namespace marsview
