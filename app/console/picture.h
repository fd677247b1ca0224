// A picture of a map: what `render` and the Python module draw.
#pragma once

#include "app/console/scene.h"
#include "core/view/terrain_look.h"
#include "ui/render/offscreen_picture.h"

#include <array>
#include <optional>

namespace marsview {

struct PictureOptions {
    Viewport viewport{.width = 1280, .height = 800};
    std::optional<MapPoint> look_at{};    // map CRS; by default the middle of the map
    std::optional<double> distance_m{};   // > 0, of the camera; by default the whole map is visible
    double azimuth_deg = 0.0;             // heading, clockwise from north
    std::optional<double> tilt_deg{};     // 0 to 85; 0 looks straight down
    std::optional<double> exaggeration{}; // > 0; by default one that suits the map
    double error_px = 1.0;                // > 0, of the surface
    bool has_every_sample = false;
    /// 1 to 16 per pixel, for anti-aliasing; by default 4, or 9 where neighboring pixels differ
    /// much.
    std::optional<int> samples{};
    ShadingMode shading = ShadingMode::Tint;
    std::array<double, 2> light_deg{315.0, 45.0}; // azimuth and altitude
    /// On the body, in place of that light: where the sun is overhead.
    std::optional<GeographicPoint> subsolar{};
    bool has_contours = false;
};

/// Draws the map of the scene, and waits for its tiles. On the thread that opened the scene.
/// OutOfRange if `look_at` is not on the map; an error if a part of the terrain would be coarser
/// than requested.
Result<OffscreenPicture> drawPicture(const Scene& scene, const PictureOptions& options);

} // namespace marsview
