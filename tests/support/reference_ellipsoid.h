// Closed formulas on the ellipsoid in long double, written from their definitions.
#pragma once

namespace marsview::test {

/// tan(centric) = (b/a)² tan(graphic), in degrees; the poles and the equator are fixed points.
long double centricLatitude_deg(long double equatorial, long double polar, long double graphic_deg);
long double graphicLatitude_deg(long double equatorial, long double polar, long double centric_deg);

/// Radii of the parallel and of the meridian's curvature at a planetographic latitude.
long double parallelRadius(long double equatorial, long double polar, long double graphic_deg);
long double meridianRadius(long double equatorial, long double polar, long double graphic_deg);

/// The difference of two longitudes, without whole turns, in degrees in [-180, 180].
long double turnlessDifference_deg(long double a_deg, long double b_deg);

} // namespace marsview::test
