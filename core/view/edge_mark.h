// A mark at the edge of the picture for a point outside it.
#pragma once

#include "core/view/camera.h"

#include <optional>

namespace marsview {

/// The line on which marks are placed, around the inside of the picture.
struct EdgeLine {
    Viewport viewport{};
    double inset_px = 0.0;   // from all sides
    double covered_px = 0.0; // hidden strip at the top of the picture
};

/// The position and direction of a mark; (`right`, `down`) has length 1.
struct EdgeMark {
    PixelPoint at{};
    double right = 0.0;
    double down = 0.0;
};

/// Empty if the point is in the picture. Otherwise the mark, the middle of the picture and the
/// point lie on a line; turning the view in that direction brings the point into the picture, even
/// from behind the eye. A point straight behind is marked at the bottom. If the line has no extent,
/// the mark is in its middle.
std::optional<EdgeMark>
edgeMark(const CameraPose& camera, const ScenePoint& place, const EdgeLine& line);

} // namespace marsview
