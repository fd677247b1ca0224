#include "core/annotations/drawn_json.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <utility>
#include <variant>

namespace marsview {
namespace {

constexpr std::size_t kPointsMax = 10000000;

constexpr std::array kShapeNames{
    Named<FeatureShape>{FeatureShape::Point, "point"},
    Named<FeatureShape>{FeatureShape::Line, "line"},
    Named<FeatureShape>{FeatureShape::Polygon, "polygon"},
};

// Two finite numbers.
std::optional<std::array<double, 2>> pairFrom(const Json& json)
{
    if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) {
        return std::nullopt;
    }
    const std::array<double, 2> pair{json[0].get<double>(), json[1].get<double>()};
    return std::isfinite(pair[0]) && std::isfinite(pair[1]) ? std::optional(pair) : std::nullopt;
}

// Of positions on a body: its radii, or those of its name.
DrawnBody bodyFrom(Members& members)
{
    DrawnBody body;
    members.text("body", body.name);
    Ellipsoid ellipsoid;
    if (const Body* known = bodyNamed(body.name); known != nullptr) {
        ellipsoid = known->ellipsoid;
    }
    const auto is_radius = [](double radius) { return radius > 0.0; };
    members.number("equatorial_radius_m", ellipsoid.equatorial_m, is_radius, "a length above 0");
    members.number("polar_radius_m", ellipsoid.polar_m, is_radius, "a length above 0");
    if (ellipsoid.equatorial_m <= 0.0 || ellipsoid.polar_m <= 0.0) {
        members.refuse("body", "a known body, and its radii are not stated");
    }
    body.ellipsoid = ellipsoid;
    return body;
}

} // namespace

std::string colorText(const Rgb8& color)
{
    return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

std::optional<Rgb8> colorNamed(const std::string& text)
{
    unsigned rgb = 0;
    char rest = '\0';
    if (text.size() != 7 || std::sscanf(text.c_str(), "#%6x%c", &rgb, &rest) != 1) { // NOLINT
        return std::nullopt;
    }
    return Rgb8{static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
                static_cast<std::uint8_t>(rgb)};
}

std::optional<Rgb8> colorFrom(Members& members)
{
    std::string text;
    members.text("color", text);
    const std::optional<Rgb8> color = colorNamed(text);
    if (!color && members.has("color")) {
        members.refuse("color", "a color such as #ffdd40");
    }
    return color;
}

std::string timeText(DrawnTime time)
{
    const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
    return fmt::format("{:%FT%T}.{:03}Z", seconds, (time - seconds).count());
}

std::optional<DrawnTime> timeNamed(const std::string& text)
{
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    double second = 0.0;
    char zone = '\0';
    if (std::sscanf(text.c_str(), "%d-%u-%uT%d:%d:%lf%c", &year, &month, &day, &hour, &minute,
                    &second, &zone) != 7) { // NOLINT: every conversion is checked
        return std::nullopt;
    }
    namespace chrono = std::chrono;
    const chrono::year_month_day date{chrono::year{year}, chrono::month{month}, chrono::day{day}};
    if (zone != 'Z' || !date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
        !(second >= 0.0 && second < 61.0)) {
        return std::nullopt;
    }
    return chrono::sys_days{date} + chrono::hours{hour} + chrono::minutes{minute} +
           chrono::milliseconds{std::llround(1000.0 * second)};
}

DrawnTime timeFrom(Members& members)
{
    std::string text = timeText({});
    members.text("time", text);
    const auto time = timeNamed(text);
    if (!time) {
        members.refuse("time", "a time such as 2026-05-17T09:30:00Z");
    }
    return time.value_or(DrawnTime{});
}

void putVertices(Json& json, const std::vector<DrawnVertex>& vertices)
{
    Json degrees = Json::array();
    Json points = Json::array();
    for (const DrawnVertex& vertex : vertices) {
        if (const auto* geographic = std::get_if<GeographicPoint>(&vertex)) {
            degrees.push_back(
                Json::array({degreesOf(geographic->longitude), degreesOf(geographic->latitude)}));
        } else {
            const auto& point = std::get<MapPoint>(vertex);
            points.push_back(Json::array({point.x, point.y}));
        }
    }
    if (!degrees.empty()) {
        json["longitudes_latitudes_deg"] = std::move(degrees);
    }
    if (!points.empty()) {
        json["map_points"] = std::move(points);
    }
}

std::vector<DrawnVertex> verticesFrom(Members& members)
{
    std::vector<DrawnVertex> vertices;
    const char* const what = "a list of pairs of numbers";
    members.list("longitudes_latitudes_deg", kPointsMax, what,
                 [&](const Json& json, const std::string& /*place*/) {
                     const auto pair = pairFrom(json);
                     if (!pair || std::abs((*pair)[1]) > 90.0) {
                         members.refuse("longitudes_latitudes_deg",
                                        "a list of longitudes and latitudes");
                         return;
                     }
                     vertices.emplace_back(GeographicPoint{.longitude = Angle::degrees((*pair)[0]),
                                                           .latitude = Angle::degrees((*pair)[1])});
                 });
    if (members.has("map_points") && !vertices.empty()) {
        members.refuse("map_points", "absent where there are longitudes and latitudes");
        return vertices;
    }
    members.list("map_points", kPointsMax, what,
                 [&](const Json& json, const std::string& /*place*/) {
                     const auto pair = pairFrom(json);
                     if (!pair) {
                         members.refuse("map_points", what);
                         return;
                     }
                     vertices.emplace_back(MapPoint{(*pair)[0], (*pair)[1]});
                 });
    return vertices;
}

Json annotationJson(const Annotation& annotation)
{
    Json json = Json::object();
    json["name"] = annotation.name;
    if (!annotation.note.empty()) {
        json["note"] = annotation.note;
    }
    if (annotation.color) {
        json["color"] = colorText(*annotation.color);
    }
    json["shape"] = nameIn(kShapeNames, annotation.shape);
    if (annotation.shape == FeatureShape::Point) {
        json["symbol"] = symbolName(annotation.symbol);
    }
    if (!annotation.body.name.empty()) {
        json["body"] = annotation.body.name;
    }
    if (annotation.body.ellipsoid) {
        json["equatorial_radius_m"] = annotation.body.ellipsoid->equatorial_m;
        json["polar_radius_m"] = annotation.body.ellipsoid->polar_m;
    }
    json["time"] = timeText(annotation.time);
    putVertices(json, annotation.vertices);
    return json;
}

Annotation annotationFrom(Members& members)
{
    Annotation annotation;
    members.text("name", annotation.name);
    members.text("note", annotation.note);
    annotation.color = colorFrom(members);
    members.choice("shape", kShapeNames, annotation.shape);
    if (std::string name; members.has("symbol")) {
        members.text("symbol", name);
        const auto symbol = symbolNamed(name);
        if (!symbol) {
            members.refuse("symbol", "a known symbol");
        }
        annotation.symbol = symbol.value_or(MarkSymbol::Circle);
    }
    annotation.time = timeFrom(members);
    annotation.vertices = verticesFrom(members);
    const std::size_t needed = verticesNeeded(annotation.shape);
    const bool is_point = annotation.shape == FeatureShape::Point;
    if (annotation.vertices.size() < needed || (is_point && annotation.vertices.size() != 1)) {
        members.refuse("shape", "possible with so few or so many positions");
    } else if (std::holds_alternative<GeographicPoint>(annotation.vertices.front())) {
        annotation.body = bodyFrom(members);
    }
    return annotation;
}

} // namespace marsview
