#include "tests/support/reference_ellipsoid.h"

#include <cmath>
#include <numbers>

namespace marsview::test {
namespace {

constexpr long double kDegree = std::numbers::pi_v<long double> / 180.0L;

// y·cos and x·sin instead of a tangent: exact at the equator, and accurate to the last digit near
// the poles.
long double scaledLatitude(long double latitude_deg, long double ratio)
{
    if (std::abs(latitude_deg) == 90.0L) {
        return latitude_deg;
    }
    const long double rad = latitude_deg * kDegree;
    return std::atan2(ratio * std::sin(rad), std::cos(rad)) / kDegree;
}

} // namespace

long double centricLatitude_deg(long double equatorial, long double polar, long double graphic_deg)
{
    return scaledLatitude(graphic_deg, (polar / equatorial) * (polar / equatorial));
}

long double graphicLatitude_deg(long double equatorial, long double polar, long double centric_deg)
{
    return scaledLatitude(centric_deg, (equatorial / polar) * (equatorial / polar));
}

// The ellipse as a curve of the angle φ of its normal: p = a² cos φ / w, z = b² sin φ / w, w² = a²
// cos² φ + b² sin² φ; its radius of curvature is a² b² / w³.
long double parallelRadius(long double equatorial, long double polar, long double graphic_deg)
{
    const long double phi = graphic_deg * kDegree;
    const long double w = std::hypot(equatorial * std::cos(phi), polar * std::sin(phi));
    return equatorial * equatorial * std::cos(phi) / w;
}

long double meridianRadius(long double equatorial, long double polar, long double graphic_deg)
{
    const long double phi = graphic_deg * kDegree;
    const long double w = std::hypot(equatorial * std::cos(phi), polar * std::sin(phi));
    return (equatorial * polar / w) * (equatorial * polar / w) / w;
}

long double turnlessDifference_deg(long double a_deg, long double b_deg)
{
    return std::remainder(a_deg - b_deg, 360.0L);
}

} // namespace marsview::test
