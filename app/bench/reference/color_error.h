// The difference between the colors of a picture and those of the surface at full resolution.
#pragma once

#include "app/bench/reference/picture_error.h"
#include "core/terrain/min_max_pyramid.h"
#include "core/view/color_ramp.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace marsview {

/// Over all channels of all compared pixels, in levels of 255.
struct ColorError {
    std::size_t pixel_count = 0;
    double mean_levels = 0.0;
    double p99_levels = 0.0;
    double max_levels = 0.0;
    /// Against means only: 99 % of the colors at the centers of the pixels are within this of them.
    double center_p99_levels = 0.0;
};

/// What the color of a pixel is compared with.
enum class ColorReference {
    Center, // the color of the surface on the ray through the center
    Mean,   // the mean of those on 4 × 4 rays spread evenly over the pixel
};

/// Every `stride`-th pixel of every `stride`-th row.
struct ColorSampling {
    ColorReference reference = ColorReference::Center;
    std::size_t stride = 1;
};

/// The content of a picture in the mode Tint.
struct TintedScene {
    DrawnScene drawn;
    const MinMaxPyramid& bounds; // of the heightfield
    const ColorRamp& ramp;
    HeightRange range; // the stretch of the ramp
};

/// Two pictures of the same view, width × height × 3 bytes from the top left.
struct ColorPictures {
    std::span<const std::uint8_t> tint;  // mode Tint
    std::span<const std::uint8_t> light; // mode Hillshade
    std::span<const double> depths_m;    // along the view axis, infinite in the sky
};

/// Compares colors with those of the ramp at the elevations where rays meet the surface at full
/// resolution, in the light of the picture. The color at one point represents a pixel if the
/// surface hardly changes within it. A pixel that covers many samples shows their mean: means are
/// taken of colors as they are displayed, in sRGB. Skips pixels in which the picture or a ray shows
/// sky, and those whose light exceeds a byte. Uses all cores.
ColorError measureColorError(const TintedScene& scene,
                             const OrbitCamera& camera,
                             const Viewport& viewport,
                             const ColorPictures& pictures,
                             const ColorSampling& sampling);

} // namespace marsview
