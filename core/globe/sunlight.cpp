#include "core/globe/sunlight.h"

#include "core/body/body_positions.h"
#include "core/globe/body_camera.h"

#include <cmath>

namespace marsview {

Vec3 directionToSun(const GeographicPoint& subsolar, const Ellipsoid& ellipsoid)
{
    return footOf(ellipsoid, subsolar).normal;
}

GeographicPoint subsolarPoint(const GeographicPoint& place,
                              Angle azimuth,
                              Angle altitude,
                              const Ellipsoid& ellipsoid)
{
    const LocalAxes axes = localAxes(ellipsoid, place);
    const double level = std::cos(altitude.radians());
    const Vec3 to_sun = axes.east * (level * std::sin(azimuth.radians())) +
                        axes.north * (level * std::cos(azimuth.radians())) +
                        axes.up * std::sin(altitude.radians());
    const Angle planetographic =
        Angle::radians(std::atan2(to_sun.z, std::hypot(to_sun.x, to_sun.y)));
    return {.longitude = Angle::radians(std::atan2(to_sun.y, to_sun.x)),
            .latitude = ellipsoid.planetocentric(planetographic)};
}

} // namespace marsview
