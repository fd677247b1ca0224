// A mark at the edge of the picture for a place outside it.
#pragma once

#include "core/view/camera.h"

#include <optional>

namespace marsview {

/// The line on which marks lie: inside the picture, all around.
struct EdgeLine {
    Viewport viewport{};
    double inset_px = 0.0;   // from all sides
    double covered_px = 0.0; // what cannot be seen of the picture at its top
};

/// Where a mark is and which way it points: `right` and `down` have length 1 together.
struct EdgeMark {
    PixelPoint at{};
    double right = 0.0;
    double down = 0.0;
};

/// Nothing where the place is in the picture. Otherwise the mark, the middle of the picture and the
/// place lie on a line; a view that turns that way comes to see the place, also where it is behind
/// the eye. Straight behind is down. Where the line leaves no room, the mark is in its middle.
std::optional<EdgeMark>
edgeMark(const OrbitCamera& camera, const ScenePoint& place, const EdgeLine& line);

} // namespace marsview
