#include "core/session/measurement_features.h"

#include "core/files/raster_path.h"
#include "core/measure/ground.h"
#include "core/vector/vector_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/chrono.h>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace marsview {
namespace {

constexpr double kPieceDeg = 0.5; // of arc, between positions of a line
constexpr std::size_t kCirclePositions = 180;

struct Kind {
    MeasurementKind kind;
    const char* layer;
    std::vector<const char*> results; // all are numbers
};

const std::vector<Kind>& kinds()
{
    static const std::vector<Kind> kKinds{
        {MeasurementKind::Distance,
         "distances",
         {"length_m", "terrain_length_m", "straight_m", "rise_m", "no_data_m"}},
        {MeasurementKind::Profile, "profiles", {"length_m", "min_m", "max_m"}},
        {MeasurementKind::Area,
         "areas",
         {"area_m2", "terrain_area_m2", "perimeter_m", "min_m", "max_m", "mean_m",
          "volume_above_m3", "volume_below_m3"}},
        {MeasurementKind::Attitude,
         "attitudes",
         {"strike_deg", "dip_deg", "dip_direction_deg", "strike_error_deg", "dip_error_deg",
          "rms_m"}},
        {MeasurementKind::Crater,
         "craters",
         {"diameter_m", "depth_m", "depth_to_diameter", "rim_m", "floor_m", "rms_m"}},
        {MeasurementKind::Slope, "points", {"elevation_m", "slope_deg", "aspect_deg"}},
    };
    return kKinds;
}

FieldValue number(double value)
{
    return std::isfinite(value) ? FieldValue(value) : FieldValue();
}

FieldValue number(const std::optional<double>& value)
{
    return value ? number(*value) : FieldValue();
}

FieldValue text(const std::string& value)
{
    return value.empty() ? FieldValue() : FieldValue(value);
}

FieldValue colorOf(const Measurement& measurement)
{
    const auto& color = measurement.color;
    return color ? FieldValue(
                       fmt::format("#{:02x}{:02x}{:02x}", color->red, color->green, color->blue))
                 : FieldValue();
}

// In the order of Kind::results.
struct ResultValues {
    std::vector<FieldValue> operator()(const Distance& d) const
    {
        return {number(d.geodesic_m), number(d.surface_m), number(d.straight_m), number(d.rise_m),
                number(d.void_m)};
    }
    std::vector<FieldValue> operator()(const Profile& p) const
    {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const ProfilePoint& point : p.points) {
            if (!std::isnan(point.elevation_m)) {
                low = std::min(low, point.elevation_m);
                high = std::max(high, point.elevation_m);
            }
        }
        const double length_m = p.points.empty() ? 0.0 : p.points.back().distance_m;
        return {number(length_m), number(low), number(high)};
    }
    std::vector<FieldValue> operator()(const TerrainArea& a) const
    {
        return {number(a.geodesic_m2),     number(a.surface_m2),     number(a.perimeter_m),
                number(a.min_m),           number(a.max_m),          number(a.mean_m),
                number(a.volume_above_m3), number(a.volume_below_m3)};
    }
    std::vector<FieldValue> operator()(const Attitude& a) const
    {
        return {number(a.strike_deg),
                number(a.dip_deg),
                number(a.dip_direction_deg),
                number(a.uncertainty.strike_error_deg),
                number(a.uncertainty.dip_error_deg),
                number(a.rms_m)};
    }
    std::vector<FieldValue> operator()(const Crater& c) const
    {
        return {number(c.diameter_m), number(c.depth_m), number(c.depth_m / c.diameter_m),
                number(c.rim_m),      number(c.floor_m), number(c.rms_m)};
    }
    std::vector<FieldValue> operator()(const std::vector<TerrainSlope>& slopes) const
    {
        if (slopes.empty()) {
            return {};
        }
        const TerrainSlope& first = slopes.front();
        return {number(first.elevation_m), number(first.slope_deg), number(first.aspect_deg)};
    }
};

template <typename T>
const T* valueOf(const Measurement& measurement)
{
    return measurement.result && measurement.result->values
               ? std::get_if<T>(&*measurement.result->values)
               : nullptr;
}

// Geometry on a body, as longitude and latitude of `crs`.
class BodyGeometry {
public:
    explicit BodyGeometry(const Crs& crs)
        : crs_(crs)
        , ground_(Ground::onEllipsoid(*crs.ellipsoid()))
        , piece_m_(crs.ellipsoid()->equatorial_m * kPieceDeg * std::numbers::pi / 180.0)
    {}

    std::vector<MapPoint> vertices(const Measurement& measurement) const
    {
        std::vector<MapPoint> points;
        for (const GroundPosition position : positions(measurement)) {
            points.push_back(mapPoint(position));
        }
        return points;
    }

    std::vector<MapPoint> line(const Measurement& measurement, bool is_closed) const
    {
        std::vector<GroundPosition> corners = positions(measurement);
        if (is_closed) {
            corners.push_back(corners.front());
        }
        return between(corners);
    }

    std::vector<MapPoint> circle(const Crater& crater) const
    {
        std::vector<GroundPosition> corners =
            circleOn(ground_, crater.center, 0.5 * crater.diameter_m, kCirclePositions);
        corners.push_back(corners.front());
        return between(corners);
    }

    MapPoint mapPoint(GroundPosition position) const
    {
        return crs_.toMap(ground_.geographic(position)).value_or(MapPoint{position.x, position.y});
    }

private:
    std::vector<GroundPosition> positions(const Measurement& measurement) const
    {
        std::vector<GroundPosition> positions;
        for (const MeasuredVertex& vertex : measurement.vertices) {
            positions.push_back(ground_.position(std::get<GeographicPoint>(vertex)));
        }
        return positions;
    }

    std::vector<MapPoint> between(const std::vector<GroundPosition>& corners) const
    {
        std::vector<MapPoint> points{mapPoint(corners.front())};
        double turn = 0.0; // so that longitudes continue from one leg to the next
        for (std::size_t i = 1; i < corners.size(); ++i) {
            const GroundLine leg = ground_.line(corners[i - 1], corners[i]);
            const auto pieces = static_cast<int>(std::ceil(leg.lengthM() / piece_m_));
            for (int piece = 1; piece <= std::max(1, pieces); ++piece) {
                GroundPosition position = piece == pieces || pieces < 1
                                              ? leg.at(leg.lengthM())
                                              : leg.at(piece * leg.lengthM() / pieces);
                position.x += turn;
                points.push_back(mapPoint(position));
            }
            const double end = leg.at(leg.lengthM()).x;
            turn += end - corners[i].x;
        }
        return points;
    }

    Crs crs_;
    Ground ground_;
    double piece_m_;
};

std::vector<FeaturePart> asPoints(const std::vector<MapPoint>& points)
{
    return {FeaturePart{.points = points, .is_hole = false}};
}

Feature geometryOf(const Measurement& measurement, const BodyGeometry* body)
{
    Feature feature;
    std::vector<MapPoint> vertices;
    if (body != nullptr) {
        vertices = body->vertices(measurement);
    } else {
        for (const MeasuredVertex& vertex : measurement.vertices) {
            vertices.push_back(std::get<MapPoint>(vertex));
        }
    }
    switch (measurement.kind) {
    case MeasurementKind::Distance:
    case MeasurementKind::Profile:
        feature.shape = FeatureShape::Line;
        feature.parts = asPoints(body != nullptr ? body->line(measurement, false) : vertices);
        return feature;
    case MeasurementKind::Area:
        feature.shape = FeatureShape::Polygon;
        if (body == nullptr) {
            vertices.push_back(vertices.front());
        }
        feature.parts = asPoints(body != nullptr ? body->line(measurement, true) : vertices);
        return feature;
    case MeasurementKind::Crater:
        if (const auto* crater = valueOf<Crater>(measurement); crater != nullptr && body) {
            feature.shape = FeatureShape::Polygon;
            feature.parts = asPoints(body->circle(*crater));
            return feature;
        }
        break;
    case MeasurementKind::Attitude:
        if (const auto* attitude = valueOf<Attitude>(measurement); attitude != nullptr && body) {
            feature.parts = asPoints({body->mapPoint(attitude->center)});
            return feature;
        }
        break;
    case MeasurementKind::Slope:
        break;
    }
    feature.shape = FeatureShape::Point;
    feature.parts = asPoints(vertices);
    return feature;
}

// Of measurements in the same kind of coordinates; `crs` is null for those of a map without a body.
FeatureCollection collectionOf(const std::vector<const NamedMeasurement*>& measurements,
                               const Crs* crs)
{
    FeatureCollection content;
    std::optional<BodyGeometry> geometry;
    if (crs != nullptr) {
        content.body = crs->body();
        content.crs =
            content.body != nullptr ? Crs::geographic(*content.body, *crs->ellipsoid()) : *crs;
        geometry.emplace(*content.crs);
    }
    for (const Kind& kind : kinds()) {
        FeatureLayer layer{.name = kind.layer,
                           .fields = {{.name = "name", .type = FieldType::Text},
                                      {.name = "note", .type = FieldType::Text},
                                      {.name = "color", .type = FieldType::Text},
                                      {.name = "layer", .type = FieldType::Text},
                                      {.name = "time", .type = FieldType::Text}},
                           .features = {}};
        for (const char* result : kind.results) {
            layer.fields.push_back({.name = result, .type = FieldType::Real});
        }
        for (const NamedMeasurement* named : measurements) {
            const Measurement& measurement = named->measurement;
            if (measurement.kind != kind.kind) {
                continue;
            }
            Feature feature = geometryOf(measurement, geometry ? &*geometry : nullptr);
            const auto seconds = std::chrono::floor<std::chrono::seconds>(measurement.time);
            feature.values = {measurement.name, text(measurement.note), colorOf(measurement),
                              named->layer_name, fmt::format("{:%FT%T}Z", seconds)};
            if (measurement.result && measurement.result->values) {
                for (FieldValue& value : std::visit(ResultValues{}, *measurement.result->values)) {
                    feature.values.push_back(std::move(value));
                }
            }
            feature.values.resize(layer.fields.size());
            layer.features.push_back(std::move(feature));
        }
        if (!layer.features.empty()) {
            content.layers.push_back(std::move(layer));
        }
    }
    return content;
}

} // namespace

std::vector<FeatureCollection> measurementFeatures(std::span<const NamedMeasurement> measurements)
{
    struct Group {
        std::optional<Ellipsoid> ellipsoid;
        const Crs* crs = nullptr;
        std::vector<const NamedMeasurement*> measurements;
    };
    std::vector<Group> groups;
    for (const NamedMeasurement& named : measurements) {
        const std::vector<MeasuredVertex>& vertices = named.measurement.vertices;
        if (vertices.empty()) {
            continue;
        }
        const bool is_on_body = std::holds_alternative<GeographicPoint>(vertices.front());
        const bool has_body = named.crs && named.crs->ellipsoid();
        if (is_on_body && !has_body) {
            continue; // its layer has lost its CRS
        }
        const auto ellipsoid = is_on_body ? named.crs->ellipsoid() : std::nullopt;
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.ellipsoid == ellipsoid; });
        if (group == groups.end()) {
            groups.push_back({.ellipsoid = ellipsoid,
                              .crs = is_on_body ? &*named.crs : nullptr,
                              .measurements = {}});
            group = std::prev(groups.end());
        }
        group->measurements.push_back(&named);
    }
    std::vector<FeatureCollection> collections;
    for (const Group& group : groups) {
        collections.push_back(collectionOf(group.measurements, group.crs));
    }
    return collections;
}

Status writeMeasurements(std::span<const NamedMeasurement> measurements,
                         const std::filesystem::path& path)
{
    const std::vector<FeatureCollection> collections = measurementFeatures(measurements);
    std::vector<std::string> names;
    JobMonitor monitor;
    for (const FeatureCollection& content : collections) {
        std::string name = path.string();
        if (collections.size() > 1) {
            std::filesystem::path beside = path;
            beside.replace_extension();
            name = fmt::format("{}-{}", beside.string(),
                               content.body != nullptr ? lowerCase(std::string(content.body->name))
                               : content.crs           ? "body"
                                                       : "map");
            const auto same = std::count(names.begin(), names.end(), name);
            names.push_back(name);
            name += same > 0 ? fmt::format("-{}.gpkg", same + 1) : ".gpkg";
        }
        if (const auto written = writeVectorFile(name, content, monitor); !written) {
            return written.error();
        }
    }
    return Done{};
}

} // namespace marsview
