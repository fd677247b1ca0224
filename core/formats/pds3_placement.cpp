#include "core/formats/pds3_placement.h"

#include "core/base/check.h"
#include "core/base/plain_number.h"
#include "core/files/gdal_runtime.h"
#include "core/formats/odl_label.h"
#include "core/geo/vertical.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

// A label's numbers are rounded (MAP_SCALE to five digits), which amounts to 1 % of a pixel at the
// far edge of a global map; a real shift is a whole pixel.
constexpr double kPixelTolerance = 0.1;

// Numbers are plain or have a unit: 90.0, or {"value": 90.0, "unit": "DEGREE"}.
std::optional<double> numberAt(const nlohmann::json& object, const char* key)
{
    const auto entry = object.find(key);
    if (entry == object.end()) {
        return std::nullopt;
    }
    if (entry->is_number()) {
        return entry->get<double>();
    }
    if (entry->is_object()) {
        return numberAt(*entry, "value");
    }
    return std::nullopt;
}

int wholePixels(double pixels)
{
    const double whole = std::round(pixels);
    return std::abs(whole) == 1.0 && std::abs(pixels - whole) < kPixelTolerance
               ? static_cast<int>(whole)
               : 0;
}

// Names of raw images, which GDAL opens before it reads the rest of the label.
void appendPointers(const OdlStatement& group, std::vector<std::string>& names)
{
    for (const OdlStatement& statement : group.statements) {
        if (statement.is_group) {
            appendPointers(statement, names);
        } else if (statement.name.starts_with("^")) {
            names.push_back(odlItems(statement.value).front());
        }
    }
}

// Without objects of compressed files, and with an image under the name that GDAL expects.
std::string asOfRawImage(std::string text)
{
    constexpr std::string_view kEnd = "_IMAGE";
    const std::size_t pointer = text.find('^');
    const std::size_t end = text.find_first_of(" \t\r\n=", pointer);
    if (text.find("^IMAGE") == std::string::npos && end != std::string::npos) {
        const std::string name = text.substr(pointer + 1, end - pointer - 1);
        for (std::size_t at = name.ends_with(kEnd) ? text.find(name) : std::string::npos;
             at != std::string::npos; at = text.find(name, at + 1)) {
            text.replace(at, name.size(), "IMAGE");
        }
    }
    constexpr std::string_view kCompressed = "COMPRESSED_FILE";
    for (std::size_t at = text.find(kCompressed); at != std::string::npos;
         at = text.find(kCompressed, at + 1)) {
        if (at == 0 || std::isalpha(static_cast<unsigned char>(text[at - 1])) == 0) {
            text[at] = 'X';
        }
    }
    return text;
}

void writeMemoryFile(const std::string& path, const std::string& content)
{
    VSILFILE* const file = VSIFOpenL(path.c_str(), "wb");
    if (file != nullptr) {
        VSIFWriteL(content.data(), 1, content.size(), file);
        VSIFCloseL(file);
    }
}

std::string labelText(const std::string& path)
{
    constexpr std::size_t kBytesMax = std::size_t{1} << 20;
    std::string text(kBytesMax, '\0');
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    text.resize(file != nullptr ? VSIFReadL(text.data(), 1, text.size(), file) : 0);
    if (file != nullptr) {
        VSIFCloseL(file);
    }
    return text;
}

struct RadiusText {
    std::size_t begin = 0; // of the number
    std::size_t end = 0;   // after the number and its unit
    double value = 0.0;
    std::string unit; // empty if missing
};

// The number after "A_AXIS_RADIUS"; `at` is the position after that name.
std::optional<RadiusText> radiusAt(const std::string& label, std::size_t at)
{
    constexpr std::string_view kSpace = " \t\r\n\"";
    RadiusText radius;
    const std::size_t equals = label.find_first_not_of(kSpace, at);
    if (equals == std::string::npos || label[equals] != '=') {
        return std::nullopt;
    }
    radius.begin = label.find_first_not_of(kSpace, equals + 1);
    radius.end = std::min(label.find_first_of(" \t\r\n\"<", radius.begin), label.size());
    if (radius.begin >= radius.end) {
        return std::nullopt;
    }
    const auto value = parseNumber(label.substr(radius.begin, radius.end - radius.begin));
    const std::size_t unit = label.find_first_not_of(kSpace, radius.end);
    const std::size_t unit_end = label.find('>', unit);
    if (unit != std::string::npos && label[unit] == '<' && unit_end != std::string::npos) {
        radius.unit = label.substr(unit + 1, unit_end - unit - 1);
        radius.end = unit_end + 1;
    }
    radius.value = value.value_or(0.0);
    return value ? std::optional(radius) : std::nullopt;
}

double metersOf(const RadiusText& radius)
{
    constexpr double kKilometer = 1e3;
    constexpr double kLargestKm = 1e5; // Jupiter has 71 492
    if (const auto unit = verticalUnitFrom(radius.unit)) {
        return radius.value * unit->meters;
    }
    return radius.unit.empty() && radius.value > kLargestKm ? radius.value
                                                            : radius.value * kKilometer;
}

} // namespace

std::string withRadiiInKilometers(const std::string& label)
{
    std::string text = label;
    for (const char* name : {"A_AXIS_RADIUS", "B_AXIS_RADIUS", "C_AXIS_RADIUS"}) {
        const std::size_t length = std::string_view(name).size();
        for (std::size_t at = text.find(name); at != std::string::npos;
             at = text.find(name, at + length)) {
            const std::optional<RadiusText> radius = radiusAt(text, at + length);
            const double kilometers = radius ? metersOf(*radius) / 1e3 : 0.0;
            if (radius && kilometers != radius->value) {
                text.replace(radius->begin, radius->end - radius->begin,
                             fmt::format("{} <KM>", kilometers));
            }
        }
    }
    return text;
}

bool hasRadiiInOtherUnits(const std::string& label_path)
{
    const std::string text = labelText(label_path);
    return withRadiiInKilometers(text) != text;
}

std::shared_ptr<GDALDataset> openPds3Placement(const std::string& label_path)
{
    const std::string text = labelText(label_path);
    const std::optional<OdlStatement> root = parseOdl(text);
    if (!root) {
        return nullptr;
    }
    static std::atomic<unsigned> count{0};
    const std::string folder = fmt::format("/vsimem/marsview_label_{}", count++);
    std::vector<std::string> names{"image"};
    appendPointers(*root, names);
    for (const std::string& name : names) {
        writeMemoryFile(folder + "/" + CPLGetFilename(name.c_str()), " ");
    }
    const std::string label = folder + "/marsview_placement.lbl";
    writeMemoryFile(label, asOfRawImage(withRadiiInKilometers(text)));
    const GdalMessages messages;
    const char* const drivers[] = {"PDS", nullptr};
    std::shared_ptr<GDALDataset> dataset(GDALDataset::Open(label.c_str(), GDAL_OF_RASTER, drivers),
                                         [folder](GDALDataset* opened) {
                                             GDALClose(opened);
                                             VSIRmdirRecursive(folder.c_str());
                                         });
    return dataset.get() != nullptr ? dataset : nullptr;
}

PixelShift
pds3PlacementShift(const nlohmann::json& label, const GeoTransform& transform, const Crs& crs)
{
    const auto projection = label.find("IMAGE_MAP_PROJECTION");
    if (projection == label.end() || !projection->is_object() || !crs.turn()) {
        return {};
    }
    const auto direction = projection->find("POSITIVE_LONGITUDE_DIRECTION");
    if (direction != projection->end() && *direction != "EAST") {
        return {};
    }
    const std::optional<double> north = numberAt(*projection, "MAXIMUM_LATITUDE");
    const std::optional<double> west = numberAt(*projection, "WESTERNMOST_LONGITUDE");
    if (!north || !west) {
        return {};
    }
    const std::optional<MapPoint> expected =
        crs.toMap({Angle::degrees(*west), Angle::degrees(*north)});
    if (!expected) {
        return {};
    }
    constexpr GridPoint kOuterCorner{-0.5, -0.5};
    const MapPoint actual = transform.toMap(kOuterCorner);
    const double turn = *crs.turn();
    double dx = expected->x - actual.x;
    dx -= turn * std::round(dx / turn); // the label may use another turn of longitude
    const GeoTransform::Terms& t = transform.terms();
    return {.columns = wholePixels(dx / t[1]),
            .rows = wholePixels((expected->y - actual.y) / t[5])};
}

GeoTransform shifted(const GeoTransform& transform, PixelShift shift)
{
    GeoTransform::Terms t = transform.terms();
    t[0] += shift.columns * t[1] + shift.rows * t[2];
    t[3] += shift.columns * t[4] + shift.rows * t[5];
    Result<GeoTransform> moved = GeoTransform::fromTerms(t);
    MARSVIEW_CHECK(moved.has_value());
    return *moved;
}

} // namespace marsview
