// Orientations of planes taken together: their mean pole and its spread, the stereonet on which
// geologists read them, and the rose of their strikes.
#pragma once

#include "core/measure/attitude.h"

#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

/// A plane by strike (right-hand rule, clockwise from north) and dip, in degrees.
struct PlaneOrientation {
    double strike_deg = 0.0; // any for a level plane
    double dip_deg = 0.0;    // in [0°, 90°]
};

/// NaN strikes of level planes become 0.
PlaneOrientation orientationOf(const Attitude& attitude);

/// Unit vector east, north, up to the pole in the lower hemisphere.
Vec3 poleOf(const PlaneOrientation& plane);

/// Fisher statistics of poles: R. A. Fisher (1953), Dispersion on a sphere, Proc. R. Soc. A 217,
/// 295–305. Poles are axes: those of steep planes count on the side on which most lie.
struct OrientationStatistics {
    std::size_t count = 0;
    // The mean pole, in the lower hemisphere.
    double trend_deg = 0.0; // in [0°, 360°)
    double plunge_deg = 0.0;
    PlaneOrientation mean;       // the plane of that pole
    double kappa = 0.0;          // (n - 1) / (n - R); NaN for fewer than two, infinite if all agree
    double confidence_deg = 0.0; // half angle of the cone of 95 % confidence; NaN like kappa
};

/// For one plane or more.
OrientationStatistics orientationStatistics(std::span<const PlaneOrientation> planes);

/// A point of the equal-area net (Schmidt) of the lower hemisphere: in a circle of radius 1, north
/// up.
struct NetPoint {
    double right = 0.0;
    double up = 0.0;
};

/// Of a direction east, north, up of length 1, or of its opposite if it points up.
NetPoint netPoint(const Vec3& direction);
/// The plane as a line from rim to rim.
std::vector<NetPoint> greatCircle(const PlaneOrientation& plane);
/// The ellipse of confidence around the pole. Several pieces where it crosses the rim; none without
/// an estimate of errors.
std::vector<std::vector<NetPoint>> poleEllipse(const Attitude& attitude);

/// The share of strikes in each of `sectors` equal sectors, clockwise from the one that begins at
/// north. A strike counts in both of its directions: the second half equals the first. `sectors` is
/// even. Level planes have no strike and are left out.
std::vector<double> strikeRose(std::span<const PlaneOrientation> planes, std::size_t sectors);

} // namespace marsview
