#include "core/names/names_file.h"

#include "core/base/bundled_file.h"
#include "core/base/plain_number.h"
#include "core/names/search_text.h"
#include "core/vector/vector_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace marsview {
namespace {

constexpr double kMetersPerKilometer = 1000.0;

// A line of resources/names: name,diameter_km,latitude,longitude. Empty for the header.
std::optional<PlaceName> bundledName(std::string_view line)
{
    std::array<double, 3> numbers{};
    for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
        const std::size_t comma = line.rfind(',');
        const auto value =
            comma != std::string_view::npos ? parseNumber(line.substr(comma + 1)) : std::nullopt;
        if (!value) {
            return std::nullopt;
        }
        *number = *value;
        line = line.substr(0, comma);
    }
    const auto [diameter_km, latitude, longitude] = numbers;
    // In the IAU's lists craters have no descriptor, nor have albedo features, which have no size.
    const PlaceKind kind = kindOfName(line);
    const bool is_crater = kind == PlaceKind::Other && diameter_km > 0.0;
    return PlaceName{.name = std::string(line),
                     .position = {Angle::degrees(longitude), Angle::degrees(latitude)},
                     .diameter_m = diameter_km * kMetersPerKilometer,
                     .kind = is_crater ? PlaceKind::Crater : kind};
}

std::shared_ptr<const Gazetteer> readBundled(const Body& body, const std::filesystem::path& path)
{
    std::ifstream file(path);
    std::vector<PlaceName> names;
    for (std::string line; std::getline(file, line);) {
        if (auto name = bundledName(line)) {
            names.push_back(std::move(*name));
        }
    }
    return names.empty() ? nullptr : std::make_shared<const Gazetteer>(&body, std::move(names));
}

struct SizeField {
    std::size_t index = 0;
    double meters = 1.0; // in one unit
};

std::optional<std::size_t> fieldNamed(const FeatureLayer& layer,
                                      std::span<const std::string_view> names)
{
    for (const std::string_view name : names) {
        const auto found = std::find_if(
            layer.fields.begin(), layer.fields.end(),
            [name](const FeatureField& field) { return searchText(field.name) == name; });
        if (found != layer.fields.end()) {
            return static_cast<std::size_t>(found - layer.fields.begin());
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> nameField(const FeatureLayer& layer)
{
    constexpr std::array<std::string_view, 3> kNames{"name", "feature_name", "clean_name"};
    if (const auto named = fieldNamed(layer, kNames)) {
        return named;
    }
    const auto text =
        std::find_if(layer.fields.begin(), layer.fields.end(),
                     [](const FeatureField& field) { return field.type == FieldType::Text; });
    return text != layer.fields.end()
               ? std::optional(static_cast<std::size_t>(text - layer.fields.begin()))
               : std::nullopt;
}

std::optional<SizeField> sizeField(const FeatureLayer& layer)
{
    constexpr std::array<std::string_view, 1> kMeters{"diameter_m"};
    constexpr std::array<std::string_view, 3> kKilometers{"diameter", "diameter_km", "size_km"};
    if (const auto index = fieldNamed(layer, kMeters)) {
        return SizeField{.index = *index, .meters = 1.0};
    }
    if (const auto index = fieldNamed(layer, kKilometers)) {
        return SizeField{.index = *index, .meters = kMetersPerKilometer};
    }
    return std::nullopt;
}

double numberIn(const FieldValue& value)
{
    if (const auto* real = std::get_if<double>(&value)) {
        return *real;
    }
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*whole);
    }
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? parseNumber(*text).value_or(0.0) : 0.0;
}

std::string textIn(const FieldValue& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) {
        return *text;
    }
    const auto* whole = std::get_if<std::int64_t>(&value);
    return whole != nullptr ? fmt::format("{}", *whole) : std::string();
}

// Where the points of a file are on the body.
class Placement {
public:
    Placement(const FeatureCollection& content, const Body* body)
        : crs_(content.crs)
        , body_(body)
    {}

    std::optional<GeographicPoint> operator()(const MapPoint& point) const
    {
        if (crs_) {
            return crs_->toGeographic(point);
        }
        if (!(std::abs(point.y) <= 90.0) || !(std::abs(point.x) <= 360.0)) {
            return std::nullopt;
        }
        const Angle latitude = Angle::degrees(point.y);
        const bool is_planetographic =
            body_ != nullptr && body_->latitude == LatitudeKind::Planetographic;
        return GeographicPoint{Angle::degrees(point.x),
                               is_planetographic ? body_->ellipsoid.planetocentric(latitude)
                                                 : latitude};
    }

private:
    std::optional<Crs> crs_;
    const Body* body_;
};

} // namespace

std::shared_ptr<const Gazetteer> bundledGazetteer(const Body& body)
{
    const std::string file = body.name == "Mars"   ? "names/mars.csv"
                             : body.name == "Moon" ? "names/moon.csv"
                                                   : "";
    if (file.empty()) {
        return nullptr;
    }
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const Gazetteer>> read;
    const std::lock_guard lock(mutex);
    auto [entry, is_new] = read.try_emplace(file);
    if (is_new) {
        entry->second = readBundled(body, bundledFile(file));
    }
    return entry->second;
}

Result<std::shared_ptr<const Gazetteer>>
readGazetteer(const std::string& path, const Body* body, JobMonitor& monitor)
{
    Result<VectorFile> file = readVectorFile(path, monitor);
    if (!file) {
        return std::move(file).error();
    }
    const FeatureCollection& content = file->content;
    const Placement place(content, body);
    if (!content.crs && body == nullptr) {
        return Error{ErrorCode::Invalid,
                     path + ": does not state its body; open a map on that body first"};
    }
    std::vector<PlaceName> names;
    bool has_points = false;
    for (const FeatureLayer& layer : content.layers) {
        const auto name_field = nameField(layer);
        const auto size_field = sizeField(layer);
        for (const Feature& feature : layer.features) {
            if (feature.shape != FeatureShape::Point || feature.parts.empty() ||
                feature.parts.front().points.empty()) {
                continue;
            }
            has_points = true;
            std::string name = name_field ? textIn(feature.values[*name_field]) : std::string();
            if (name.empty()) {
                continue;
            }
            const MapPoint& point = feature.parts.front().points.front();
            const auto position = place(point);
            if (!position) {
                return Error{ErrorCode::Invalid,
                             fmt::format("{}: the position {}, {} of \"{}\" is not a longitude and "
                                         "latitude in degrees; save the file with its CRS, for "
                                         "example as a GeoPackage",
                                         path, asText(point.x), asText(point.y), name)};
            }
            const double size = size_field ? numberIn(feature.values[size_field->index]) : 0.0;
            const PlaceKind kind = kindOfName(name);
            names.push_back(
                {.name = std::move(name),
                 .position = *position,
                 .diameter_m = size > 0.0 && std::isfinite(size) ? size * size_field->meters : 0.0,
                 .kind = kind});
        }
    }
    if (names.empty()) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: has no {}; choose a file of points with a field \"name\", for "
                        "example a CSV file with the columns name, lon and lat",
                        path, has_points ? "names" : "points")};
    }
    return std::make_shared<const Gazetteer>(content.crs ? content.body : body, std::move(names));
}

} // namespace marsview
