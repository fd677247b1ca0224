#include "core/session/measurement_features.h"

#include "core/annotations/annotation_files.h"
#include "core/annotations/drawn_geometry.h"
#include "core/annotations/drawn_json.h"

#include <algorithm>
#include <cmath>
#include <fmt/chrono.h>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace marsview {
namespace {

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
    return measurement.color ? FieldValue(colorText(*measurement.color)) : FieldValue();
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

std::vector<FeaturePart> asPoints(const std::vector<MapPoint>& points)
{
    return {FeaturePart{.points = points, .is_hole = false}};
}

Feature geometryOf(const Measurement& measurement, const DrawnGeometry& geometry, bool is_on_body)
{
    Feature feature;
    switch (measurement.kind) {
    case MeasurementKind::Distance:
    case MeasurementKind::Profile:
        feature.shape = FeatureShape::Line;
        feature.parts = asPoints(geometry.line(measurement.vertices, LineEnds::Open));
        return feature;
    case MeasurementKind::Area:
        feature.shape = FeatureShape::Polygon;
        feature.parts = asPoints(geometry.line(measurement.vertices, LineEnds::Closed));
        return feature;
    case MeasurementKind::Crater:
        if (const auto* crater = valueOf<Crater>(measurement); crater != nullptr && is_on_body) {
            feature.shape = FeatureShape::Polygon;
            feature.parts = asPoints(geometry.closedLine(circleOn(
                geometry.ground(), crater->center, 0.5 * crater->diameter_m, kCirclePositions)));
            return feature;
        }
        break;
    case MeasurementKind::Attitude:
        if (const auto* attitude = valueOf<Attitude>(measurement);
            attitude != nullptr && is_on_body) {
            feature.parts = asPoints({geometry.mapPoint(attitude->center)});
            return feature;
        }
        break;
    case MeasurementKind::Slope:
        break;
    }
    feature.shape = FeatureShape::Point;
    feature.parts = asPoints(geometry.points(measurement.vertices));
    return feature;
}

// Of measurements in the same kind of coordinates; `crs` is null for those of a map without a body.
FeatureCollection collectionOf(const std::vector<const NamedMeasurement*>& measurements,
                               const Crs* crs)
{
    FeatureCollection content;
    if (crs != nullptr) {
        content.body = crs->body();
        content.crs =
            content.body != nullptr ? Crs::geographic(*content.body, *crs->ellipsoid()) : *crs;
    }
    const DrawnGeometry geometry(content.crs);
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
            Feature feature = geometryOf(measurement, geometry, crs != nullptr);
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

std::string resultsText(const Measurement& measurement)
{
    std::string text;
    if (!measurement.result || !measurement.result->values) {
        return text;
    }
    const auto kind = std::find_if(kinds().begin(), kinds().end(),
                                   [&](const Kind& each) { return each.kind == measurement.kind; });
    const std::vector<FieldValue> values = std::visit(ResultValues{}, *measurement.result->values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (const auto* value = std::get_if<double>(&values[i])) {
            fmt::format_to(std::back_inserter(text), "{}{} {}", text.empty() ? "" : "; ",
                           kind->results.at(i), *value);
        }
    }
    return text;
}

Status writeMeasurements(std::span<const NamedMeasurement> measurements,
                         const std::filesystem::path& path)
{
    JobMonitor monitor;
    const auto written = writeCollections(measurementFeatures(measurements), path, monitor);
    return written ? Status(Done{}) : Status(written.error());
}

} // namespace marsview
