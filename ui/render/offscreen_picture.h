// Pictures for files and measurements, drawn without a window.
#pragma once

#include "core/files/picture_file.h"
#include "ui/render/terrain_renderer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace marsview {

/// Colors and depths of the same frame.
struct OffscreenPicture {
    Picture colors;
    /// Distance along the view axis in scene meters, row by row from the top; infinite where
    /// nothing but sky is seen. Empty where it was not asked for, or with several samples a pixel.
    std::vector<double> depths_m;
    DrawReport report;
};

enum class DepthUse { No, Yes };

/// Pixels a side that the driver of the current context draws.
int offscreenSideMax();

/// Rows of red, green and blue from the top, into a larger picture.
struct PartTarget {
    std::uint8_t* first = nullptr;  // of the part's top left pixel
    std::ptrdiff_t line_length = 0; // bytes from one row of the picture to the next
};

/// Draws `request.part`, which must be set, with `request.samples` a pixel, and reads it back. By
/// what there is: where the report says that it is incomplete, the target is left as it was.
/// `draw_over` may draw over it before it is read: into the bound frame buffer, which has the
/// part's size and depths. OutOfRange where the driver has no frame buffer of that size.
Result<DrawReport> drawPart(TerrainRenderer& renderer,
                            const DrawRequest& request,
                            const DrawStyle& style,
                            const PartTarget& target,
                            const std::function<void()>& draw_over = {});

/// Draws `request` whole and reads it back. OutOfRange where the driver has no frame buffer of that
/// size.
Result<OffscreenPicture> drawOffscreen(TerrainRenderer& renderer,
                                       const DrawRequest& request,
                                       const DrawStyle& style,
                                       DepthUse depth_use);

} // namespace marsview
