#include "tests/support/nomenclature.h"

#include "tests/support/shared_data.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace marsview::test {

NamedFeature marsFeature(const std::string& name)
{
    std::ifstream file(sharedData() / "oracle" / "mars-nomenclature.csv");
    std::string line;
    // The quotes of the last field are broken, so the four fields before it are split at their
    // commas.
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        std::string field;
        if (!std::getline(fields, field, ',') || field != name) {
            continue;
        }
        NamedFeature feature{.name = field};
        char comma = ',';
        fields >> feature.diameter_km >> comma >> feature.latitude_deg >> comma >>
            feature.east_longitude_deg;
        if (fields) {
            return feature;
        }
    }
    throw std::runtime_error("no feature of Mars is called " + name);
}

double marsDistance_km(double latitude_a_deg,
                       double longitude_a_deg,
                       double latitude_b_deg,
                       double longitude_b_deg)
{
    constexpr double kRadius_km = 3389.5;
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double dlat = (latitude_b_deg - latitude_a_deg) * kDegree;
    const double dlon = (longitude_b_deg - longitude_a_deg) * kDegree;
    const double h = std::pow(std::sin(dlat / 2.0), 2) + std::cos(latitude_a_deg * kDegree) *
                                                             std::cos(latitude_b_deg * kDegree) *
                                                             std::pow(std::sin(dlon / 2.0), 2);
    return 2.0 * kRadius_km * std::asin(std::sqrt(std::min(1.0, h)));
}

} // namespace marsview::test
