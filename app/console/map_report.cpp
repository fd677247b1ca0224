#include "app/console/map_report.h"

#include "app/console/text_output.h"
#include "core/raster/open_raster.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Json textOrNull(const std::string& text)
{
    return text.empty() ? Json(nullptr) : Json(text);
}

// Longitude and latitude in degrees of the outer corners, the way people of that body count them.
Json cornersOf(const Georeference& georeference, LatitudeKind latitude_kind)
{
    const double right = static_cast<double>(georeference.columns()) - 0.5;
    const double below = static_cast<double>(georeference.rows()) - 0.5;
    Json corners = Json::object();
    for (const auto& [name, grid] : {std::pair{"upper_left", GridPoint{-0.5, -0.5}},
                                     std::pair{"upper_right", GridPoint{right, -0.5}},
                                     std::pair{"lower_left", GridPoint{-0.5, below}},
                                     std::pair{"lower_right", GridPoint{right, below}}}) {
        const auto point = georeference.toGeographic(grid);
        if (!point) {
            corners[name] = nullptr;
            continue;
        }
        const Angle latitude =
            latitude_kind == LatitudeKind::Planetographic
                ? georeference.crs()->ellipsoid()->planetographic(point->latitude)
                : point->latitude;
        corners[name] = {point->longitude.degrees(), latitude.degrees()};
    }
    return corners;
}

Json suggestionOf(const RasterInfo& info)
{
    if (!info.crs_suggestion) {
        return nullptr;
    }
    Json choices = Json::array();
    for (const CrsChoice& choice : info.crs_suggestion->choices) {
        choices.push_back({{"body", choice.body}, {"crs", choice.crs}});
    }
    return {{"reason", info.crs_suggestion->reason},
            {"is_certain", info.crs_suggestion->is_certain},
            {"choices", std::move(choices)}};
}

} // namespace

Json mapReport(const RasterInfo& info,
               const std::optional<SampleStatistics>& statistics,
               LatitudeKind latitude_kind)
{
    const Georeference georeference = georeferenceOf(info);
    const ElevationScale scale = info.elevationScale();
    const bool has_samples = statistics && statistics->hasSamples();
    double low = has_samples ? scale.height(statistics->raw_minimum) : kNone;
    double high = has_samples ? scale.height(statistics->raw_maximum) : kNone;
    if (low > high) {
        std::swap(low, high);
    }
    Json json;
    json["file"] = info.path;
    json["driver"] = info.driver;
    json["columns"] = info.columns;
    json["rows"] = info.rows;
    json["band"] = info.band;
    json["band_count"] = info.band_count;
    json["sample_type"] = sampleTypeName(info.type);
    json["nodata"] = info.nodata ? asJson(*info.nodata) : Json(nullptr);
    if (info.nodata && std::isnan(*info.nodata)) {
        json["nodata"] = "nan";
    }
    json["other_nodata"] = info.other_nodata;
    json["has_mask"] = info.has_mask_band;
    json["void_count"] = statistics ? Json(statistics->void_count) : Json(nullptr);
    json["minimum"] = asJson(low);
    json["maximum"] = asJson(high);
    json["raw_minimum"] = asJson(has_samples ? statistics->raw_minimum : kNone);
    json["raw_maximum"] = asJson(has_samples ? statistics->raw_maximum : kNone);
    json["scale"] = info.scale;
    json["offset"] = info.offset;
    json["vertical_unit"] = info.unit.name;
    json["is_vertical_unit_declared"] = info.is_unit_declared;
    json["vertical_unit_suggestion"] =
        info.unit_suggestion ? Json(info.unit_suggestion->unit.name) : Json(nullptr);
    json["vertical_datum"] = textOrNull(info.vertical_datum);
    json["reference_radius_m"] =
        info.reference_radius_m ? asJson(*info.reference_radius_m) : Json(nullptr);
    json["crs_name"] = info.crs ? Json(info.crs->name()) : Json(nullptr);
    json["crs_unit"] = info.crs ? Json(info.crs->unitName()) : Json(nullptr);
    json["crs_wkt"] = info.crs ? Json(info.crs->wkt()) : Json(nullptr);
    json["crs_suggestion"] = suggestionOf(info);
    json["body"] = info.body != nullptr ? Json(info.body->name) : Json(nullptr);
    const auto ellipsoid = info.crs ? info.crs->ellipsoid() : std::nullopt;
    json["radii_m"] = ellipsoid ? Json{ellipsoid->equatorial_m, ellipsoid->polar_m} : Json(nullptr);
    const GeoTransform& transform = georeference.transform();
    json["pixel_size"] = {transform.pixelWidth(), transform.pixelHeight()};
    json["pixel_size_m"] = {georeference.pixelWidthMeters(), georeference.pixelHeightMeters()};
    json["geotransform"] = info.transform ? Json(info.transform->terms()) : Json(nullptr);
    json["latitude_kind"] =
        latitude_kind == LatitudeKind::Planetographic ? "planetographic" : "planetocentric";
    json["corners_lonlat"] = info.crs ? cornersOf(georeference, latitude_kind) : Json(nullptr);
    json["wraps_around"] = georeference.wrapsAround();
    json["triangle_count"] = info.triangleCount();
    json["notices"] = info.notices;
    return json;
}

} // namespace marsview
