#include "core/geo/known_elevations.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace marsview {
namespace {

struct KnownBody {
    std::string_view body;
    KnownElevations elevations;
};

constexpr std::array kKnownBodies{
    // MESSENGER's global map above 2440 km: Becker et al. (2016), 47th LPSC, 2959. The radii in use
    // differ by less than 2.5 km.
    KnownBody{"Mercury",
              {.lowest_m = -5380.0, .highest_m = 4480.0, .floor_m = -8000.0, .ceiling_m = 8000.0}},
    // The Challenger Deep and Mount Everest (2020 survey). 1 % for the datum and for noise of
    // single samples.
    KnownBody{"Earth",
              {.lowest_m = -10935.0,
               .highest_m = 8849.0,
               .floor_m = -10935.0 * 1.01,
               .ceiling_m = 8849.0 * 1.01}},
    // LOLA above 1737.4 km: Smith et al. (2017), Icarus 283, 70-91. Other radii differ by less than
    // 1.4 km.
    KnownBody{
        "Moon",
        {.lowest_m = -9129.0, .highest_m = 10786.0, .floor_m = -11000.0, .ceiling_m = 12500.0}},
    // MOLA above the areoid: Smith et al. (2001), J. Geophys. Res. 106, 23689-23722. Above a sphere
    // of 3396.19 km the lowest place is at -22.8 km, near the north pole; above one of 3389.5 km
    // the highest is at 27 km.
    KnownBody{
        "Mars",
        {.lowest_m = -8528.0, .highest_m = 21229.0, .floor_m = -25000.0, .ceiling_m = 29000.0}},
};

} // namespace

std::optional<KnownElevations> knownElevations(const Body& body)
{
    const auto* const entry =
        std::find_if(kKnownBodies.begin(), kKnownBodies.end(),
                     [&body](const KnownBody& candidate) { return candidate.body == body.name; });
    return entry != kKnownBodies.end() ? std::optional(entry->elevations) : std::nullopt;
}

bool canBeOn(const Body& body, double elevation_m, std::optional<double> sphere_m)
{
    const std::optional<KnownElevations> known = knownElevations(body);
    const Ellipsoid& ellipsoid = body.ellipsoid;
    const double flattening_m = sphere_m ? ellipsoid.equatorial_m - ellipsoid.polar_m : 0.0;
    return !known || (elevation_m >= known->floor_m - flattening_m &&
                      elevation_m <= known->ceiling_m + flattening_m);
}

} // namespace marsview
