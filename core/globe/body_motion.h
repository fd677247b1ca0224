// Motions of the camera over a body: pure functions from one camera to the next.
//
// None of them keeps the camera within the limits; call constrained() (body_navigation.h) once at
// the end.
#pragma once

#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "core/view/cap_steering.h"

namespace marsview {

/// A point of the ground and where it shall be in the picture.
struct HeldPoint {
    ScenePoint point; // in the body-fixed frame
    PixelPoint pixel;
};

/// Moves the target so that the point is at the pixel, to 1e-3 pixels; a pixel beside the body
/// counts as the nearest one on it. The heading stays, except near the poles, where it turns with
/// the ground. Height, distance and tilt stay.
BodyCamera heldAt(BodyCamera camera,
                  const Ellipsoid& ellipsoid,
                  const Viewport& viewport,
                  const HeldPoint& held);

/// Zooms in (factor < 1) or out with the point at its pixel. The limits of distance bound the
/// factor.
BodyCamera zoomed(BodyCamera camera,
                  double factor,
                  const Viewport& viewport,
                  const HeldPoint& held,
                  const BodyLimits& limits);

/// Rotates the camera around the target.
BodyCamera orbited(BodyCamera camera, Angle azimuth_change, Angle tilt_change);

/// Moves along a great circle by fractions of the camera's distance: to the right and away from the
/// viewer, but by no more than an eighth of a turn.
BodyCamera
panned(BodyCamera camera, double right_share, double forward_share, const Ellipsoid& ellipsoid);

/// The camera `seconds` later, moved as if a cap were the viewer (core/view/cap_steering.h): pans
/// are along great circles.
BodyCamera
steered(const BodyCamera& camera, const CapRates& rates, double seconds, const BodyLimits& limits);

/// Where the ray through a pixel meets the body, with the ellipsoid raised to go through `level`;
/// beside the body, the nearest point on its edge.
ScenePoint pointOnBody(const Ray& ray, const Ellipsoid& ellipsoid, const ScenePoint& level);

/// Between two cameras, t in [0, 1]: along the great circle between the targets, rising on the way
/// as far as the distance needs (J. van Wijk and W. Nuij, "Smooth and efficient zooming and
/// panning", 2003). Azimuth takes the shorter direction.
BodyCamera
flown(const BodyCamera& from, const BodyCamera& to, const Ellipsoid& ellipsoid, double t);

} // namespace marsview
