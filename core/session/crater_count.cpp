#include "core/session/crater_count.h"

#include "core/session/measurement_tables.h"

#include <algorithm>
#include <cmath>
#include <fmt/chrono.h>
#include <iterator>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr double kKilometer = 1000.0;

double squareKilometers(double area_m2)
{
    return area_m2 / (kKilometer * kKilometer);
}

double totalArea(const CraterCount& count)
{
    double sum_m2 = 0.0;
    for (const CraterCount::Area& area : count.areas) {
        sum_m2 += area.area_m2;
    }
    return sum_m2;
}

std::vector<GroundPosition> borderOf(const Ground& ground, const Measurement& measurement)
{
    std::vector<GroundPosition> border;
    for (const MeasuredVertex& vertex : measurement.vertices) {
        border.push_back(ground.position(std::get<GeographicPoint>(vertex)));
    }
    return border;
}

std::string dateText(const CraterCount& count)
{
    return fmt::format("{:%F}", std::chrono::floor<std::chrono::seconds>(count.time));
}

} // namespace

// The directions from the position to the border turn once around it if it is inside, against the
// border's own sense for azimuths run clockwise; with it if the antipode is inside.
bool isInside(const Ground& ground, std::span<const GroundPosition> border, GroundPosition position)
{
    double turn_deg = 0.0;
    std::optional<double> last_deg;
    for (std::size_t i = 0; i <= border.size(); ++i) {
        const double azimuth_deg = ground.line(position, border[i % border.size()]).azimuthDeg();
        if (last_deg) {
            turn_deg += std::remainder(azimuth_deg - *last_deg, 360.0);
        }
        last_deg = azimuth_deg;
    }
    const bool is_counterclockwise = ground.polygon(border).area_m2 > 0.0;
    return is_counterclockwise ? turn_deg < -180.0 : turn_deg > 180.0;
}

Result<CraterCount> craterCount(std::span<const NamedMeasurement> measurements)
{
    std::vector<const NamedMeasurement*> craters;
    std::vector<const NamedMeasurement*> areas;
    for (const NamedMeasurement& named : measurements) {
        const auto& result = named.measurement.result;
        if (!result || !result->values) {
            continue;
        }
        if (named.measurement.kind == MeasurementKind::Crater) {
            craters.push_back(&named);
        } else if (named.measurement.kind == MeasurementKind::Area) {
            areas.push_back(&named);
        }
    }
    if (craters.empty()) {
        return Error{ErrorCode::Invalid, "there are no craters to count; measure some first"};
    }
    if (areas.empty()) {
        return Error{ErrorCode::Invalid,
                     "a count of craters needs the area in which they were "
                     "counted; measure it as an area first"};
    }
    const auto ellipsoid_of = [](const NamedMeasurement& named) {
        return named.crs ? named.crs->ellipsoid() : std::nullopt;
    };
    const auto ellipsoid = ellipsoid_of(*craters.front());
    if (!ellipsoid) {
        return Error{ErrorCode::Invalid,
                     "the craters are on a map without a body, so they have no "
                     "longitude and latitude; set its CRS or body"};
    }
    for (const auto* group : {&craters, &areas}) {
        for (const NamedMeasurement* named : *group) {
            if (ellipsoid_of(*named) != ellipsoid) {
                return Error{ErrorCode::Invalid,
                             fmt::format("\"{}\" and \"{}\" are on different bodies; remove those "
                                         "of one body, or save each body's in a project of its own",
                                         craters.front()->measurement.name,
                                         named->measurement.name)};
            }
        }
    }
    const Ground ground = Ground::onEllipsoid(*ellipsoid);
    CraterCount count{.ellipsoid = *ellipsoid, .crs_name = craters.front()->crs->name()};
    std::vector<std::vector<GroundPosition>> borders;
    for (const NamedMeasurement* named : areas) {
        borders.push_back(borderOf(ground, named->measurement));
        const GroundPolygon polygon = ground.polygon(borders.back());
        CraterCount::Area area{.name = named->measurement.name,
                               .border = {},
                               .area_m2 = std::abs(polygon.area_m2),
                               .perimeter_m = polygon.perimeter_m};
        for (const GroundPosition position : borders.back()) {
            area.border.push_back(tablePosition(*named, position));
        }
        count.areas.push_back(std::move(area));
    }
    for (const NamedMeasurement* named : craters) {
        const auto& crater = std::get<Crater>(*named->measurement.result->values);
        if (std::none_of(borders.begin(), borders.end(), [&](const auto& border) {
                return isInside(ground, border, crater.center);
            })) {
            ++count.outside;
            continue;
        }
        count.craters.push_back(
            {.center = tablePosition(*named, crater.center), .diameter_m = crater.diameter_m});
        count.time = std::max(count.time, named->measurement.time);
    }
    if (count.craters.empty()) {
        return Error{ErrorCode::Invalid,
                     "none of the craters lies in the area in which they were "
                     "to be counted; measure another area"};
    }
    return count;
}

std::string sccText(const CraterCount& count)
{
    std::string text = fmt::format(
        "# Spatial crater count\n"
        "#\n"
        "# Date of measurement = {}\n"
        "#\n"
        "# Ellipsoid axes:\n"
        "a_axis_radius = {} <km>\n"
        "b_axis_radius = {} <km>\n"
        "c_axis_radius = {} <km>\n"
        "coordinate_system_name = {}\n"
        "#\n"
        "# area_shapes:\n"
        "unit_boundary = {{vertex, sub_area, tag, lon, lat\n",
        dateText(count), count.ellipsoid.equatorial_m / kKilometer,
        count.ellipsoid.equatorial_m / kKilometer, count.ellipsoid.polar_m / kKilometer,
        count.crs_name);
    auto end = std::back_inserter(text);
    double perimeter_m = 0.0;
    std::size_t vertex = 0;
    for (std::size_t i = 0; i < count.areas.size(); ++i) {
        const CraterCount::Area& area = count.areas[i];
        perimeter_m += area.perimeter_m;
        fmt::format_to(end, "#\n#Area_name{} = {}\n#Area_size{} = {} <km^2>\n#\n", i + 1, area.name,
                       i + 1, squareKilometers(area.area_m2));
        for (std::size_t k = 0; k <= area.border.size(); ++k) { // closed
            const MapPoint& point = area.border[k % area.border.size()];
            fmt::format_to(end, "{}\t{}\text\t{}\t{}\n", ++vertex, i + 1, point.x, point.y);
        }
    }
    fmt::format_to(end,
                   "}}\n"
                   "#\n"
                   "Total_area = {} <km^2>\n"
                   "Total_perimeter = {} <km>\n"
                   "#\n"
                   "# crater_diameters:\n"
                   "crater = {{diam, fraction, lon, lat, topo_scale_factor\n",
                   squareKilometers(totalArea(count)), perimeter_m / kKilometer);
    for (const CountedCrater& crater : count.craters) {
        fmt::format_to(end, "{}\t1\t{}\t{}\t1\n", crater.diameter_m / kKilometer, crater.center.x,
                       crater.center.y);
    }
    return text + "}\n";
}

std::string diamText(const CraterCount& count)
{
    std::string text = fmt::format(
        "# Crater diameters in km\n"
        "# Date of measurement = {}\n"
        "#\n"
        "# Area in km^2\n"
        "area = {}\n"
        "#\n"
        "crater = {{diameter, fraction, lon, lat\n",
        dateText(count), squareKilometers(totalArea(count)));
    for (const CountedCrater& crater : count.craters) {
        fmt::format_to(std::back_inserter(text), "{}\t1\t{}\t{}\n", crater.diameter_m / kKilometer,
                       crater.center.x, crater.center.y);
    }
    return text + "}\n";
}

} // namespace marsview
