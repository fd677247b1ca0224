// A small shaded picture of a whole map, computed without a graphics card.
#pragma once

#include "core/base/angle.h"
#include "core/base/grid_view.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"
#include "core/view/color_ramp.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// Red, green, blue and opacity of each pixel, rows from the top as in the raster. Voids are 0, 0,
/// 0, 0; everything else is opaque.
struct MapPreview {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<std::uint8_t> rgba;
};

struct PreviewStyle {
    std::array<Rgb8, 256> ramp{}; // from sampledRamp()
    HeightRange tint_range{};     // range of the ramp; if empty: the ramp's middle
    Angle light_azimuth = Angle::degrees(315.0);
    Angle light_altitude = Angle::degrees(45.0);
    double exaggeration = 1.0; // for shading
};

/// The frame of a picture of columns × rows pixels that covers the pixels of the whole raster, edge
/// to edge: pixel centers at integers, as in the raster's own frame.
SceneFrame previewFrame(const SceneFrame& frame,
                        std::size_t raster_columns,
                        std::size_t raster_rows,
                        std::size_t columns,
                        std::size_t rows);

/// One pixel per height (meters, NaN for void), colored and lit like the terrain on screen: tint ×
/// (0.28 + 0.84 × max(normal · light, 0)). Slopes are central differences, one-sided at edges and
/// voids, level for an isolated height. `frame` is that of the heights' grid. An empty grid gives
/// an empty picture. Any thread.
MapPreview
mapPreview(GridView<const float> heights_m, const SceneFrame& frame, const PreviewStyle& style);

} // namespace marsview
