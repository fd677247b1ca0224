#include "core/raster/crs_suggestion.h"

#include "core/geo/crs.h"
#include "core/raster/raster_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr double kTurn = 360.0;
constexpr double kPole = 90.0;

struct MapExtent {
    double west, east, south, north; // map units
    double width() const { return east - west; }
    MapPoint center() const { return {0.5 * (west + east), 0.5 * (south + north)}; }
};

// Of the positions from half a sample before the first to half a sample behind the last, or of
// those `inset` samples further in.
MapExtent extentOf(const RasterInfo& info, double inset = 0.0)
{
    const GeoTransform transform = info.transform.value_or(GeoTransform{});
    const double right = static_cast<double>(info.columns) - 0.5 - inset;
    const double below = static_cast<double>(info.rows) - 0.5 - inset;
    const double first = inset - 0.5;
    std::array<MapPoint, 4> corners{
        transform.toMap({first, first}), transform.toMap({right, first}),
        transform.toMap({first, below}), transform.toMap({right, below})};
    const auto [west, east] =
        std::minmax_element(corners.begin(), corners.end(),
                            [](const MapPoint& a, const MapPoint& b) { return a.x < b.x; });
    const auto [south, north] =
        std::minmax_element(corners.begin(), corners.end(),
                            [](const MapPoint& a, const MapPoint& b) { return a.y < b.y; });
    return {west->x, east->x, south->y, north->y};
}

MapExtent sampleExtentOf(const RasterInfo& info)
{
    return extentOf(info, 0.5);
}

// A full turn of longitude, over most latitudes or up to a pole.
bool isGlobal(const RasterInfo& info)
{
    const MapExtent extent = extentOf(info);
    const double pixel = info.transform->pixelWidth();
    constexpr double kLatitudesMin = 100.0; // global maps may omit the poles
    const double to_pole = kPole - std::max(std::abs(extent.south), std::abs(extent.north));
    return std::abs(extent.width() - kTurn) < 1.5 * pixel &&
           (extent.north - extent.south > kLatitudesMin || std::abs(to_pole) <= pixel);
}

// Pixels below a centimeter if the grid were in meters: no planetary elevation data is that fine.
bool hasTinyPixels(const RasterInfo& info)
{
    constexpr double kFinePixel = 0.01;
    return std::min(info.transform->pixelWidth(), info.transform->pixelHeight()) <= kFinePixel;
}

bool isNearlyWhole(double value)
{
    constexpr double kTolerance = 1e-3; // files round to 0.000833333
    return value > 0.5 && std::abs(value - std::round(value)) < kTolerance * value;
}

// Small grids in meters begin at 0 or are centered on it.
bool isLocal(const RasterInfo& info)
{
    const MapExtent extent = extentOf(info);
    const double pixel = std::min(info.transform->pixelWidth(), info.transform->pixelHeight());
    const auto beginsAtZero = [pixel](double low, double high) {
        return std::min(std::abs(low), std::abs(high)) <= pixel;
    };
    const auto isAroundZero = [pixel](double low, double high) {
        return std::abs(low + high) <= 2.0 * pixel;
    };
    return (beginsAtZero(extent.west, extent.east) || isAroundZero(extent.west, extent.east)) &&
           (beginsAtZero(extent.south, extent.north) || isAroundZero(extent.south, extent.north));
}

// Grids in degrees have a whole number of samples per degree, such as 1200 or 12, or of arc seconds
// per sample.
bool looksLikeDegrees(const RasterInfo& info)
{
    const double pixel = std::min(info.transform->pixelWidth(), info.transform->pixelHeight());
    constexpr double kSecondsADegree = 3600.0;
    const bool is_usual = isNearlyWhole(1.0 / pixel) || isNearlyWhole(pixel * kSecondsADegree);
    return pixel < 1.0 && (is_usual || hasTinyPixels(info)) && !isLocal(info);
}

std::string longitudeRange(const MapExtent& extent)
{
    const auto text = [&extent](double degrees) {
        const double shown = std::round(degrees * 1e4) / 1e4;
        if (extent.west >= -0.1) { // a sample placed at 0 has its edge before 0
            return fmt::format("{}{}°", shown < 0.0 ? "−" : "", std::abs(shown));
        }
        return fmt::format("{}°{}", std::abs(shown), shown < 0.0 ? " W" : shown > 0.0 ? " E" : "");
    };
    return text(extent.west) + " – " + text(extent.east);
}

std::string latitudeRange(const MapExtent& extent)
{
    const auto text = [](double degrees) {
        const double shown = std::round(degrees * 1e4) / 1e4;
        return fmt::format("{}°{}", std::abs(shown), shown < 0.0 ? " S" : shown > 0.0 ? " N" : "");
    };
    return text(extent.south) + " – " + text(extent.north);
}

// Latitudes as with `--body`: planetocentric except on Earth.
CrsChoice choiceFor(const Body& body)
{
    struct Code {
        std::string_view body;
        const char* crs;
    };
    constexpr std::array kCodes{Code{"Earth", "EPSG:4326"}, Code{"Mars", "IAU_2015:49902"},
                                Code{"Moon", "IAU_2015:30100"}};
    const auto* const code =
        std::find_if(kCodes.begin(), kCodes.end(),
                     [&body](const Code& candidate) { return candidate.body == body.name; });
    return {std::string(body.name),
            code != kCodes.end() ? code->crs : Crs::geographic(body, body.ellipsoid).wkt()};
}

bool isCode(const CrsChoice& choice)
{
    return choice.crs.find('[') == std::string::npos;
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    return text;
}

RasterInfo withoutCrs(RasterInfo info)
{
    info.crs.reset();
    return info;
}

// Whether a position of small numbers may be one of a projected CRS. Without a registered area of
// use, one near the origin of the projection may be.
bool canBeInArea(const Crs& crs, MapPoint position)
{
    if (!crs.areaOfUse()) {
        constexpr double kFarM = 1e5;
        const MapPoint origin = crs.falseOrigin();
        return std::hypot(origin.x, origin.y) * crs.unit() < kFarM;
    }
    const std::optional<GeographicPoint> place = crs.toGeographic(position);
    return place && crs.areaOfUse()->contains(*place);
}

// With the digits that people need to recognize a grid.
std::string coordinateText(double value)
{
    constexpr double kWholeMin = 1000.0;
    return std::abs(value) >= kWholeMin ? fmt::format("{:.0f}", value)
                                        : fmt::format("{:.6g}", value);
}

// "x 376314 to 380000 and y 3340000 to 3350820"
std::string coverageOf(const MapExtent& extent)
{
    return fmt::format("x {} to {} and y {} to {}", coordinateText(extent.west),
                       coordinateText(extent.east), coordinateText(extent.south),
                       coordinateText(extent.north));
}

std::string misfitOfDegrees(const Crs& crs, const RasterInfo& degrees)
{
    const MapExtent extent = extentOf(degrees);
    return fmt::format(
        "\"{}\" (unit {}) cannot place a grid in degrees ({}, {}); choose a CRS of "
        "longitude and latitude, or set a geotransform in its unit",
        crs.name(), crs.unitName(), longitudeRange(extent), latitudeRange(extent));
}

std::string misfitOf(const CrsSuggestion& suggestion)
{
    return fmt::format(
        "the CRS \"{}\" (unit {}) does not fit the grid, which looks like longitude "
        "and latitude in degrees",
        suggestion.unfit_crs, suggestion.unfit_unit);
}

constexpr const char* kUntilThen = "until then, map units are read as meters";

} // namespace

bool canBeAngles(const RasterInfo& info, double turn)
{
    const MapExtent samples = sampleExtentOf(info);
    const double degree = turn / kTurn;
    const double pixel = info.transform.value_or(GeoTransform{}).pixelHeight();
    const double beyond = std::min(0.5 * pixel, degree) + 1e-6 * degree;
    return std::max(std::abs(samples.south), std::abs(samples.north)) <= kPole * degree + beyond &&
           std::max(std::abs(samples.west), std::abs(samples.east)) <= 2.0 * turn;
}

std::optional<CrsSuggestion> suggestCrs(const RasterInfo& info)
{
    if (info.crs || !info.transform || !canBeAngles(info)) {
        return std::nullopt;
    }
    const MapExtent extent = extentOf(info);
    if (extent.width() > kTurn + 2.0 * std::abs(info.transform->pixelWidth())) {
        return std::nullopt;
    }
    CrsSuggestion suggestion;
    const bool is_declared = !info.axis_hints.degree_axes.empty();
    suggestion.is_certain = is_declared || isGlobal(info);
    if (!suggestion.is_certain && !looksLikeDegrees(info)) {
        return std::nullopt;
    }
    suggestion.reason = is_declared ? info.axis_hints.degree_axes
                                    : fmt::format("its extent is {}, {}", longitudeRange(extent),
                                                  latitudeRange(extent));
    if (info.axis_hints.body != nullptr) {
        suggestion.choices.push_back(choiceFor(*info.axis_hints.body));
    } else {
        for (const char* name : {"Earth", "Mars", "Moon"}) {
            suggestion.choices.push_back(choiceFor(*bodyNamed(name)));
        }
    }
    return suggestion;
}

std::optional<CrsSuggestion> suggestDegreesInstead(const RasterInfo& info)
{
    if (!info.crs || info.crs->kind() != CrsKind::Projected) {
        return std::nullopt;
    }
    RasterInfo bare = withoutCrs(info);
    if (bare.axis_hints.body == nullptr) {
        bare.axis_hints.body = info.body;
    }
    std::optional<CrsSuggestion> suggestion = suggestCrs(bare);
    if (!suggestion || !suggestion->is_certain) {
        return std::nullopt;
    }
    suggestion->unfit_crs = info.crs->name();
    suggestion->unfit_unit = info.crs->unitName();
    return suggestion;
}

std::string noticeOf(const CrsSuggestion& suggestion)
{
    std::vector<std::string> choices;
    for (const CrsChoice& choice : suggestion.choices) {
        choices.push_back(isCode(choice) ? fmt::format("{} ({})", choice.crs, choice.body)
                                         : fmt::format("the body {}", choice.body));
    }
    if (!suggestion.unfit_crs.empty()) {
        return fmt::format("{} ({}): set {}", misfitOf(suggestion), suggestion.reason,
                           joined(choices));
    }
    return fmt::format(
        "no CRS, but it looks like longitude and latitude in degrees ({}): set {}; {}",
        suggestion.reason, joined(choices), kUntilThen);
}

std::string optionNoticeOf(const CrsSuggestion& suggestion)
{
    std::vector<std::string> choices;
    for (const CrsChoice& choice : suggestion.choices) {
        choices.push_back(isCode(choice) ? fmt::format("--crs {} ({})", choice.crs, choice.body)
                                         : fmt::format("--body {}", choice.body));
    }
    if (!suggestion.unfit_crs.empty()) {
        return fmt::format("{} ({}); set the CRS with {}", misfitOf(suggestion), suggestion.reason,
                           joined(choices));
    }
    return fmt::format(
        "no CRS, but it looks like longitude and latitude in degrees ({}); set the "
        "CRS with {}; {}",
        suggestion.reason, joined(choices), kUntilThen);
}

std::string angularMisfit(const RasterInfo& info)
{
    if (!info.crs || info.crs->kind() != CrsKind::Geographic ||
        canBeAngles(info, *info.crs->turn())) {
        return {};
    }
    return fmt::format(
        "\"{}\" (unit {}) cannot place a grid that covers {}; "
        "choose a projected CRS, or set a geotransform in degrees",
        info.crs->name(), info.crs->unitName(), coverageOf(extentOf(info)));
}

std::string noticeOfUnusedCrs(const RasterInfo& info)
{
    return angularMisfit(info).empty()
               ? std::string()
               : fmt::format(
                     "the CRS \"{}\" of the file is not used: it is in {}s, but the grid "
                     "covers {}; set the CRS; {}",
                     info.crs->name(), info.crs->unitName(), coverageOf(extentOf(info)),
                     kUntilThen);
}

std::string projectedMisfit(const RasterInfo& info)
{
    if (!info.crs || info.crs->kind() != CrsKind::Projected || !info.transform) {
        return {};
    }
    const std::optional<CrsSuggestion> suggestion = suggestCrs(withoutCrs(info));
    if (suggestion && (suggestion->is_certain || hasTinyPixels(info))) {
        return misfitOfDegrees(*info.crs, info);
    }
    if (!canBeAngles(info) || canBeInArea(*info.crs, extentOf(info).center())) {
        return {};
    }
    return fmt::format(
        "\"{}\" (unit {}) cannot place a grid that covers {}: that is far "
        "from the area that it is made for, and can be degrees; choose a CRS of longitude and "
        "latitude, or set a geotransform in its unit",
        info.crs->name(), info.crs->unitName(), coverageOf(extentOf(info)));
}

std::string projectedMisfit(const RasterInfo& info, const RasterInfo& as_read)
{
    if (!info.crs || info.crs->kind() == CrsKind::Geographic) {
        return {};
    }
    const bool is_in_degrees =
        as_read.crs ? as_read.crs->kind() == CrsKind::Geographic && as_read.transform &&
                          canBeAngles(as_read, *as_read.crs->turn())
                    : as_read.crs_suggestion &&
                          (as_read.crs_suggestion->is_certain || hasTinyPixels(as_read));
    return is_in_degrees ? misfitOfDegrees(*info.crs, as_read) : std::string();
}

std::string doubtAboutExtent(const RasterInfo& info)
{
    if (!info.crs || info.crs->kind() != CrsKind::Projected || !info.transform ||
        !canBeAngles(info) || isLocal(info)) {
        return {};
    }
    const MapExtent extent = extentOf(info);
    return fmt::format(
        "the grid looks like longitude and latitude in degrees (its extent is {}, "
        "{}); check that the CRS \"{}\" is meant",
        longitudeRange(extent), latitudeRange(extent), info.crs->name());
}

std::string doubtAboutPixels(const RasterInfo& info)
{
    if (!info.crs || info.crs->kind() != CrsKind::Projected || !info.transform) {
        return {};
    }
    // An arc second is 0.00028 degrees, and three are 0.00083.
    constexpr double kMillimeter = 1e-3;
    const double pixel = std::min(info.transform->pixelWidth(), info.transform->pixelHeight());
    return pixel * info.crs->unit() < kMillimeter
               ? fmt::format(
                     "its pixels have a size of {} {}, as if it were in degrees; check the "
                     "geotransform and the CRS \"{}\"",
                     pixel, info.crs->unitName(), info.crs->name())
               : std::string();
}

} // namespace marsview
