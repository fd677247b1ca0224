// Named features of Mars, as the Gazetteer of Planetary Nomenclature lists them.
#pragma once

#include <optional>
#include <string>

namespace marsview::test {

struct NamedFeature {
    std::string name;
    double diameter_km = 0.0;
    double latitude_deg = 0.0;       // planetocentric
    double east_longitude_deg = 0.0; // 0 to 360
};

/// The feature with exactly that name; throws if the list does not contain it.
NamedFeature marsFeature(const std::string& name);

/// Great-circle distance in kilometers on a sphere of Mars' mean radius, 3389.5 km.
double marsDistance_km(double latitude_a_deg,
                       double longitude_a_deg,
                       double latitude_b_deg,
                       double longitude_b_deg);

} // namespace marsview::test
