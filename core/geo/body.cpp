#include "core/geo/body.h"

#include <GeographicLib/Ellipsoid.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace marsview {
namespace {

constexpr Body planet(std::string_view name, double equatorial_km, double polar_km)
{
    return {name,
            {equatorial_km * 1e3, polar_km * 1e3},
            LatitudeKind::Planetocentric,
            LongitudeRange::From0To360};
}

// Radii: Archinal et al. (2018), Report of the IAU Working Group on Cartographic Coordinates and
// Rotational Elements: 2015, Celest. Mech. Dyn. Astron. 130:22, tables 4 to 6. For triaxial bodies
// the equatorial radius is the mean of the two. Earth: WGS 84.
constexpr std::array kBodies{
    planet("Mercury", 2440.53, 2438.26),
    planet("Venus", 6051.8, 6051.8),
    Body{"Earth",
         {6378137.0, 6356752.314245179},
         LatitudeKind::Planetographic,
         LongitudeRange::From180WestTo180East},
    Body{"Moon",
         {1737400.0, 1737400.0},
         LatitudeKind::Planetocentric,
         LongitudeRange::From180WestTo180East},
    planet("Mars", 3396.19, 3376.2),
    planet("Phobos", 12.2, 9.1),
    planet("Deimos", 6.95, 5.1),
    planet("Eros", 11.3, 5.5),
    planet("Vesta", 284.5, 229.0),
    planet("Ceres", 487.3, 446.0),
    planet("Io", 1824.4, 1815.7),
    planet("Europa", 1561.45, 1559.5),
    planet("Ganymede", 2631.2, 2631.2),
    planet("Callisto", 2410.3, 2410.3),
    planet("Mimas", 202.2, 190.6),
    planet("Enceladus", 254.0, 248.3),
    planet("Tethys", 533.35, 526.3),
    planet("Dione", 562.6, 559.6),
    planet("Rhea", 764.05, 762.4),
    planet("Titan", 2574.965, 2574.47),
    planet("Iapetus", 745.7, 712.1),
    planet("Miranda", 237.0, 232.9),
    planet("Ariel", 579.5, 577.7),
    planet("Umbriel", 584.7, 584.7),
    planet("Titania", 788.9, 788.9),
    planet("Oberon", 761.4, 761.4),
    planet("Triton", 1352.6, 1352.6),
    planet("Pluto", 1188.3, 1188.3),
    planet("Charon", 606.0, 606.0),
};

struct Alias {
    std::string_view word;
    std::string_view body;
};

// Words in CRS names that imply a body without its name.
constexpr std::array kAliases{
    Alias{"Lunar", "Moon"},   Alias{"Luna", "Moon"},      Alias{"Terra", "Earth"},
    Alias{"WGS84", "Earth"},  Alias{"WGS", "Earth"},      Alias{"NAD27", "Earth"},
    Alias{"NAD83", "Earth"},  Alias{"ETRS89", "Earth"},   Alias{"Mercurian", "Mercury"},
    Alias{"Martian", "Mars"}, Alias{"Venusian", "Venus"},
};

constexpr double kRadiusTolerance = 0.01;

bool isSameLetter(char a, char b)
{
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
}

bool isLetter(char c)
{
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Digits and underscores end a word: "D_MARS_2000", "Mars2000".
bool hasWord(std::string_view text, std::string_view word)
{
    auto from = text.begin();
    while (true) {
        const auto hit = std::search(from, text.end(), word.begin(), word.end(), isSameLetter);
        if (hit == text.end()) {
            return false;
        }
        const auto after = hit + static_cast<std::ptrdiff_t>(word.size());
        const bool starts_word = hit == text.begin() || !isLetter(*(hit - 1));
        const bool ends_word = after == text.end() || !isLetter(*after);
        if (starts_word && ends_word) {
            return true;
        }
        from = hit + 1;
    }
}

GeographicLib::Ellipsoid geodesyOf(const Ellipsoid& e)
{
    return {e.equatorial_m, e.flattening()};
}

} // namespace

Angle Ellipsoid::planetocentric(Angle planetographic_latitude) const
{
    if (isSphere()) {
        return planetographic_latitude;
    }
    return Angle::degrees(geodesyOf(*this).GeocentricLatitude(planetographic_latitude.degrees()));
}

Angle Ellipsoid::planetographic(Angle planetocentric_latitude) const
{
    if (isSphere()) {
        return planetocentric_latitude;
    }
    return Angle::degrees(
        geodesyOf(*this).InverseGeocentricLatitude(planetocentric_latitude.degrees()));
}

double Ellipsoid::metersPerRadianOfLongitude(Angle planetographic_latitude) const
{
    return geodesyOf(*this).CircleRadius(planetographic_latitude.degrees());
}

double Ellipsoid::metersPerRadianOfPlanetographicLatitude(Angle planetographic_latitude) const
{
    return geodesyOf(*this).MeridionalCurvatureRadius(planetographic_latitude.degrees());
}

double Ellipsoid::metersPerRadianOfPlanetocentricLatitude(Angle planetographic_latitude) const
{
    // tan(centric) = (b/a)² tan(graphic), hence d(graphic)/d(centric) =
    // (cos²(graphic) + q² sin²(graphic)) / q with q = (b/a)².
    const double q = (polar_m / equatorial_m) * (polar_m / equatorial_m);
    const double c = std::cos(planetographic_latitude.radians());
    const double s = std::sin(planetographic_latitude.radians());
    return metersPerRadianOfPlanetographicLatitude(planetographic_latitude) *
           (c * c + q * q * s * s) / q;
}

std::span<const Body> knownBodies()
{
    return kBodies;
}

const Body* bodyNamed(std::string_view name)
{
    const auto is_name = [name](std::string_view candidate) {
        return std::equal(candidate.begin(), candidate.end(), name.begin(), name.end(),
                          isSameLetter);
    };
    for (const Body& body : kBodies) {
        if (is_name(body.name)) {
            return &body;
        }
    }
    for (const Alias& alias : kAliases) {
        if (is_name(alias.word)) {
            return bodyNamed(alias.body);
        }
    }
    return nullptr;
}

const Body* bodyMentioned(std::string_view text)
{
    const Body* found = nullptr;
    for (const Body& body : kBodies) {
        if (hasWord(text, body.name) &&
            (found == nullptr || body.name.size() > found->name.size())) {
            found = &body;
        }
    }
    if (found != nullptr) {
        return found;
    }
    for (const Alias& alias : kAliases) {
        if (hasWord(text, alias.word)) {
            return bodyNamed(alias.body);
        }
    }
    return nullptr;
}

const Body* bodyOfRadius(double equatorial_m)
{
    const auto deviation = [equatorial_m](const Body& body) {
        return std::abs(body.ellipsoid.equatorial_m / equatorial_m - 1.0);
    };
    if (!(equatorial_m > 0.0)) {
        return nullptr;
    }
    const auto nearest =
        std::min_element(kBodies.begin(), kBodies.end(),
                         [&](const Body& a, const Body& b) { return deviation(a) < deviation(b); });
    return deviation(*nearest) <= kRadiusTolerance ? &*nearest : nullptr;
}

Angle wrapLongitude(Angle longitude, LongitudeRange range)
{
    const double low = range == LongitudeRange::From0To360 ? 0.0 : -180.0;
    const double degrees = longitude.degrees();
    if (degrees >= low && degrees < low + 360.0) {
        return longitude;
    }
    double wrapped = std::fmod(degrees - low, 360.0);
    if (wrapped < 0.0) {
        wrapped += 360.0;
    }
    return Angle::degrees(low + (wrapped < 360.0 ? wrapped : 0.0));
}

} // namespace marsview
