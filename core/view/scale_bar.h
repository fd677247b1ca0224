// The length of the scale bar.
#pragma once

#include "core/view/camera.h"

#include <optional>

namespace marsview {

struct ScaleBar {
    double length_m = 0.0; // 1, 2 or 5 times a power of ten
    double width_px = 0.0; // its length in the picture
};

/// The longest round bar that is at most `width_max_px` wide; it is wider than two fifths of that.
/// Empty if an argument is not positive or the length is beyond the range of doubles.
std::optional<ScaleBar> scaleBar(double meters_per_pixel, double width_max_px);

} // namespace marsview
