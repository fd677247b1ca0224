// Bodies with published maps, and their reference ellipsoids.
#pragma once

#include "core/base/angle.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace marsview {

/// An ellipsoid of revolution. Radii in meters; equatorial_m > 0, polar_m > 0.
struct Ellipsoid {
    double equatorial_m = 0.0;
    double polar_m = 0.0;

    bool isSphere() const noexcept { return equatorial_m == polar_m; }
    double flattening() const noexcept { return (equatorial_m - polar_m) / equatorial_m; }
    bool operator==(const Ellipsoid&) const = default;

    /// Planetocentric latitude from a planetographic (geodetic) one, and the inverse. Angles in
    /// [-90°, 90°]; the poles and the equator are fixed points; error below 8 ulp.
    Angle planetocentric(Angle planetographic_latitude) const;
    Angle planetographic(Angle planetocentric_latitude) const;

    /// Meters on the surface for one radian of longitude, and for one radian of planetocentric or
    /// planetographic latitude, at a planetographic latitude.
    double metersPerRadianOfLongitude(Angle planetographic_latitude) const;
    double metersPerRadianOfPlanetographicLatitude(Angle planetographic_latitude) const;
    double metersPerRadianOfPlanetocentricLatitude(Angle planetographic_latitude) const;
};

/// The kind of latitude that people read and write. In the program, a GeographicPoint is always
/// planetocentric.
enum class LatitudeKind { Planetocentric, Planetographic };

/// The range in which longitudes on the body are usually written.
enum class LongitudeRange { From0To360, From180WestTo180East };

struct Body {
    std::string_view name; // English, as the IAU writes it
    Ellipsoid ellipsoid;   // IAU 2015 best-fit ellipsoid of revolution (Earth: WGS 84)
    LatitudeKind latitude; // the kind of an unqualified latitude: planetographic on Earth,
                           // otherwise planetocentric
    LongitudeRange longitude;
};

/// All known bodies, the larger planets' moons included, in order from the Sun.
std::span<const Body> knownBodies();

/// The body of that name, case-insensitive; also understands older names such as "Terra".
const Body* bodyNamed(std::string_view name);

/// The body mentioned in a text from a file ("GCS_Mars_2000_Sphere", "D_Moon_2000"): the longest
/// body name that is a whole word of the text. Null if none is.
const Body* bodyMentioned(std::string_view text);

/// The body whose equatorial radius is nearest, if within 1 %. Null if none is, or if
/// `equatorial_m` is not positive.
const Body* bodyOfRadius(double equatorial_m);

/// `longitude` wrapped into the range.
Angle wrapLongitude(Angle longitude, LongitudeRange range);

} // namespace marsview
