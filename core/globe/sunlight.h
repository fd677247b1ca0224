// Light that is fixed on a body: the sun stands over a place of it.
#pragma once

#include "core/base/vec.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"

namespace marsview {

/// The direction to the sun, of length 1, in the body-fixed frame: the normal of the ellipsoid at
/// the subsolar point, where the sun is overhead. It is the same everywhere on the body: the sun is
/// infinitely far away.
Vec3 directionToSun(const GeographicPoint& subsolar, const Ellipsoid& ellipsoid);

/// The subsolar point of a sun that is seen from a place at an azimuth, clockwise from north, and
/// an altitude above the horizon of the ellipsoid there. Longitude in [-180°, 180°].
GeographicPoint subsolarPoint(const GeographicPoint& place,
                              Angle azimuth,
                              Angle altitude,
                              const Ellipsoid& ellipsoid);

} // namespace marsview
