#include "core/session/measurement_tables.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <variant>

namespace marsview {
namespace {

// As short as it can be for the number to be read back to the bit.
std::string digits(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : std::string("nan");
}

template <typename T>
const T* valueOf(const NamedMeasurement& named)
{
    const auto& result = named.measurement.result;
    return result && result->values ? std::get_if<T>(&*result->values) : nullptr;
}

} // namespace

MapPoint tablePosition(const NamedMeasurement& measurement, GroundPosition position)
{
    const auto ellipsoid = measurement.crs ? measurement.crs->ellipsoid() : std::nullopt;
    const Body* const body = measurement.crs ? measurement.crs->body() : nullptr;
    const bool is_planetographic =
        body != nullptr && body->latitude == LatitudeKind::Planetographic;
    const bool is_sphere = ellipsoid && ellipsoid->equatorial_m == ellipsoid->polar_m;
    if (!ellipsoid || is_planetographic || is_sphere) {
        return {position.x, position.y};
    }
    return {position.x, ellipsoid->planetocentric(Angle::degrees(position.y)).degrees()};
}

MapPoint tablePosition(const NamedMeasurement& measurement, const MeasuredVertex& vertex)
{
    const auto* point = std::get_if<GeographicPoint>(&vertex);
    const auto ellipsoid = measurement.crs ? measurement.crs->ellipsoid() : std::nullopt;
    if (point == nullptr) {
        return std::get<MapPoint>(vertex);
    }
    const MapPoint centric{point->longitude.degrees(), point->latitude.degrees()};
    const Body* const body = measurement.crs ? measurement.crs->body() : nullptr;
    const bool is_planetographic =
        body != nullptr && body->latitude == LatitudeKind::Planetographic;
    return ellipsoid && is_planetographic
               ? MapPoint{centric.x, ellipsoid->planetographic(point->latitude).degrees()}
               : centric;
}

std::string pointsText(const NamedMeasurement& measurement)
{
    const auto& vertices = measurement.measurement.vertices;
    const auto& result = measurement.measurement.result;
    std::string text;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const MapPoint place = tablePosition(measurement, vertices[i]);
        const double elevation_m = result && i < result->elevations_m.size()
                                       ? result->elevations_m[i]
                                       : std::numeric_limits<double>::quiet_NaN();
        fmt::format_to(std::back_inserter(text), "{}{} {} {}", i > 0 ? "; " : "", digits(place.x),
                       digits(place.y), digits(elevation_m));
    }
    return text;
}

std::string csvField(const std::string& text)
{
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

std::string profileCsv(const NamedMeasurement& profile)
{
    std::string text = "distance_m,lon,lat,elevation_m\n";
    if (const auto* values = valueOf<Profile>(profile)) {
        for (const ProfilePoint& point : values->points) {
            const MapPoint place = tablePosition(profile, point.position);
            fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", digits(point.distance_m),
                           digits(place.x), digits(place.y), digits(point.elevation_m));
        }
    }
    return text;
}

std::string hypsometryCsv(const Hypsometry& hypsometry)
{
    std::string text = "from_m,to_m,area_m2,share,area_above_m2,share_above\n";
    const double total_m2 = hypsometry.totalM2();
    double above_m2 = total_m2;
    for (std::size_t i = 0; i < hypsometry.area_m2.size(); ++i) {
        const double area_m2 = hypsometry.area_m2[i];
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n",
                       digits(hypsometry.boundM(i)), digits(hypsometry.boundM(i + 1)),
                       digits(area_m2), digits(area_m2 / total_m2), digits(above_m2),
                       digits(above_m2 / total_m2));
        above_m2 = std::max(0.0, above_m2 - area_m2);
    }
    return text;
}

std::string attitudesCsv(std::span<const NamedMeasurement> measurements)
{
    std::string text =
        "name,lon,lat,elevation_m,strike,dip,dip_direction,strike_error,dip_error,"
        "rms_m,points,layer,note\n";
    for (const NamedMeasurement& named : measurements) {
        if (const auto* attitude = valueOf<Attitude>(named)) {
            const MapPoint place = tablePosition(named, attitude->center);
            fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                           csvField(named.measurement.name), digits(place.x), digits(place.y),
                           digits(attitude->center_elevation_m), digits(attitude->strike_deg),
                           digits(attitude->dip_deg), digits(attitude->dip_direction_deg),
                           digits(attitude->uncertainty.strike_error_deg),
                           digits(attitude->uncertainty.dip_error_deg), digits(attitude->rms_m),
                           attitude->points, csvField(named.layer_name),
                           csvField(named.measurement.note));
        }
    }
    return text;
}

} // namespace marsview
