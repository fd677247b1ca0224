// How far the colors of a picture are from those of the surface at full resolution.
#pragma once

#include "app/bench/reference/picture_error.h"
#include "core/terrain/min_max_pyramid.h"
#include "core/view/color_ramp.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace marsview {

/// Over all channels of all pixels looked at, in levels of 255.
struct ColorError {
    std::size_t pixel_count = 0;
    double mean_levels = 0.0;
    double p99_levels = 0.0;
    double max_levels = 0.0;
};

/// What a picture in the mode Tint shows.
struct TintedScene {
    DrawnScene drawn;
    const MinMaxPyramid& bounds; // of the heightfield
    const ColorRamp& ramp;
    HeightRange range; // over which the ramp is spread
};

/// Two pictures of the same view, width × height × 3 bytes from the top left.
struct ColorPictures {
    std::span<const std::uint8_t> tint;  // mode Tint
    std::span<const std::uint8_t> light; // mode Hillshade
    std::span<const double> depths_m;    // along the view axis, infinite in the sky
};

/// Compares colors with those of the ramp at the elevations where the rays through the centers of
/// the pixels meet the surface at full resolution, in the light of the picture. Every `stride`-th
/// pixel of every `stride`-th row. Pixels where either shows sky, and those whose light is too
/// bright for a byte, are left out. On all cores.
ColorError measureColorError(const TintedScene& scene,
                             const OrbitCamera& camera,
                             const Viewport& viewport,
                             const ColorPictures& pictures,
                             std::size_t stride);

} // namespace marsview
