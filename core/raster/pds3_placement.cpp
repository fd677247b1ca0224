#include "core/raster/pds3_placement.h"

#include "core/base/check.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace marsview {
namespace {

// A label's numbers are rounded (MAP_SCALE to five digits), which is worth 1 % of a pixel at the
// far edge of a global map; a real shift is a whole pixel.
constexpr double kPixelTolerance = 0.1;

// Numbers stand bare or with their unit: 90.0, or {"value": 90.0, "unit": "DEGREE"}.
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

} // namespace

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
    dx -= turn * std::round(dx / turn); // the label may count longitudes in another turn
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
