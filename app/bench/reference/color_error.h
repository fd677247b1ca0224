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

/// Compares colors with those of the ramp at the elevations where the rays through the pixel
/// centers meet the surface at full resolution, in the light of the picture. Uses every `stride`-th
/// pixel of every `stride`-th row. Skips pixels in which either shows sky, and those whose light
/// exceeds a byte. Uses all cores.
ColorError measureColorError(const TintedScene& scene,
                             const OrbitCamera& camera,
                             const Viewport& viewport,
                             const ColorPictures& pictures,
                             std::size_t stride);

} // namespace marsview
