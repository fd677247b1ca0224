// Colours for heights, as data.
#pragma once

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

/// A named run of colours. Lightness grows evenly from end to end, so equal steps of height look
/// equally far apart, in grey and to colour-blind eyes too.
struct ColorRamp {
    std::string_view name; // stable, for files; not shown
    std::span<const ColorStop> stops;
};

std::span<const ColorRamp> colorRamps();
const ColorRamp* colorRampNamed(std::string_view name);
/// The ramp that suits a body by name: rust for Mars, grey for airless bodies, else the general
/// one. An empty name is any other body.
const ColorRamp& defaultColorRamp(std::string_view body_name);

/// Perceived lightness of a colour, 0 (black) … 1 (white): the L of Oklab.
double lightness(Rgb8 color);

/// 256 colours along the ramp, mixed in Oklab (Björn Ottosson, "A perceptual color space for image
/// processing", 2020) so that they neither darken nor grey between the stops.
std::array<Rgb8, 256> sampledRamp(const ColorRamp& ramp);

} // namespace marsview
