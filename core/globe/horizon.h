// What the curvature of a body hides.
#pragma once

#include "core/base/oriented_box.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"

namespace marsview {

/// What is behind the horizon of a body: behind the ellipsoid, lowered so far that all terrain is
/// above it.
class Horizon {
public:
    /// `lowest_m`: the exaggerated height of the lowest terrain.
    Horizon(const Ellipsoid& ellipsoid, double lowest_m);

    /// True only if no point of the box can be seen.
    bool hides(const OrientedBox& box, const ScenePoint& eye) const noexcept;
    bool hides(const ScenePoint& point, const ScenePoint& eye) const noexcept;

private:
    double polar_scale_;   // of z, which makes the ellipsoid a sphere
    double radius_square_; // of the lowered sphere
};

} // namespace marsview
