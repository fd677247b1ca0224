// The surface of a map on its body straight below a point.
#pragma once

#include "core/contact/body_surface.h"

namespace marsview {

/// The surface straight below or above a point, along the ellipsoid's normal.
struct BodyBelow {
    /// The point, or outside the map about the nearest place over it, at the same height.
    ScenePoint over;
    double clearance_m = 0.0; // of `over`; negative below the surface
    double level_m = 0.0;     // the height of the surface there over the ellipsoid
    bool is_beside = false;   // outside the map
};

/// For the servo thread: about 2 µs over the map. Outside it the border is looked for at `level_m`,
/// the height of the surface where it was left.
BodyBelow
belowOn(const BodySurface& surface, const ScenePoint& point, double level_m = 0.0) noexcept;

} // namespace marsview
