#include "core/raster/raster_info.h"

#include "core/geo/known_elevations.h"
#include "core/raster/sample_suggestions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace marsview {
namespace {

// Values of a planetary raster count as radii if they are this near to the body's radius.
constexpr double kRadiusShareMax = 0.2;

// Below this radius a height may be as large as the radius, so a sample is not conclusive; an
// offset in the file's header still is.
constexpr double kBodyRadiusMinM = 10e3;

bool isOblate(const Ellipsoid& e)
{
    return std::isfinite(e.equatorial_m) && e.polar_m > 0.0 && e.equatorial_m >= e.polar_m;
}

bool isNearRadius(double value_m, double radius_m)
{
    return radius_m > 0.0 && std::abs(value_m / radius_m - 1.0) < kRadiusShareMax;
}

std::optional<double> bodyRadius(const RasterInfo& info)
{
    if (info.crs && info.crs->ellipsoid()) {
        return info.crs->ellipsoid()->equatorial_m;
    }
    if (info.body != nullptr) {
        return info.body->ellipsoid.equatorial_m;
    }
    return std::nullopt;
}

bool fitsInDegrees(const RasterInfo& info)
{
    if (!info.transform || !canBeAngles(info)) {
        return false;
    }
    const double columns = static_cast<double>(info.columns);
    const double rows = static_cast<double>(info.rows);
    const MapPoint first = info.transform->toMap({0.0, 0.0});
    const MapPoint last = info.transform->toMap({columns - 1.0, rows - 1.0});
    return std::max(std::abs(first.x), std::abs(last.x)) <= 540.0 &&
           std::abs(last.x - first.x) <= 361.0;
}

struct FieldName {
    OverrideField field;
    std::string_view name;
};

constexpr std::array kFieldNames{
    FieldName{OverrideField::Crs, "CRS"},
    FieldName{OverrideField::Body, "body"},
    FieldName{OverrideField::Radii, "radii"},
    FieldName{OverrideField::Transform, "geotransform"},
    FieldName{OverrideField::VerticalUnit, "vertical unit"},
    FieldName{OverrideField::Scale, "scale"},
    FieldName{OverrideField::Offset, "offset"},
    FieldName{OverrideField::VerticalDatum, "vertical datum"},
    FieldName{OverrideField::Nodata, "nodata"},
};

Error refusal(OverrideField field, const std::string& why, ErrorCode code = ErrorCode::Invalid)
{
    const auto* const known =
        std::find_if(kFieldNames.begin(), kFieldNames.end(),
                     [field](const FieldName& name) { return name.field == field; });
    // Messages from other modules may begin with the name already.
    const std::string name = std::string(known->name) + " ";
    return {code, fmt::format("{}: {}", known->name,
                              why.starts_with(name) ? why.substr(name.size()) : why)};
}

Status applyVertical(RasterInfo& info, const RasterOverrides& overrides)
{
    if (overrides.vertical_unit) {
        const auto unit = verticalUnitFrom(*overrides.vertical_unit);
        if (!unit) {
            return refusal(OverrideField::VerticalUnit,
                           fmt::format("\"{}\" is unknown; use m, km, ft or \"US survey ft\"",
                                       *overrides.vertical_unit));
        }
        info.unit = *unit;
        info.is_unit_declared = true;
    }
    if (overrides.scale) {
        if (!std::isfinite(*overrides.scale) || *overrides.scale == 0.0) {
            return refusal(OverrideField::Scale,
                           fmt::format("{} cannot scale elevations; use a finite number other "
                                       "than 0",
                                       *overrides.scale),
                           ErrorCode::OutOfRange);
        }
        info.scale = *overrides.scale;
    }
    if (overrides.offset) {
        if (!std::isfinite(*overrides.offset)) {
            return refusal(OverrideField::Offset,
                           fmt::format("{} cannot be added to elevations; use a finite number",
                                       *overrides.offset),
                           ErrorCode::OutOfRange);
        }
        info.offset = *overrides.offset;
    }
    const ElevationScale scale = info.elevationScale();
    if (!std::isfinite(scale.gain) || !std::isfinite(scale.offset_m)) {
        return refusal(overrides.scale ? OverrideField::Scale : OverrideField::Offset,
                       fmt::format("is too large for elevations in {}", info.unit.name),
                       ErrorCode::OutOfRange);
    }
    if (overrides.vertical_datum &&
        overrides.vertical_datum->find_first_not_of(" \t\r\n") == std::string::npos) {
        return refusal(OverrideField::VerticalDatum, "the name is empty");
    }
    if (overrides.nodata) {
        info.nodata = overrides.nodata;
    }
    return Done{};
}

Status applyTransform(RasterInfo& info, const RasterOverrides& overrides)
{
    if (!overrides.transform) {
        return Done{};
    }
    Result<GeoTransform> transform = GeoTransform::fromTerms(*overrides.transform);
    if (!transform) {
        return refusal(OverrideField::Transform, transform.error().message, transform.error().code);
    }
    info.transform = *transform;
    info.axis_hints.degree_axes.clear(); // those of the file's own placement
    return Done{};
}

Status applyCrs(RasterInfo& info, const RasterOverrides& overrides)
{
    if (!overrides.crs) {
        return Done{};
    }
    Result<Crs> crs = Crs::fromText(*overrides.crs);
    if (!crs) {
        return refusal(OverrideField::Crs, crs.error().message, crs.error().code);
    }
    info.crs = std::move(crs).value();
    info.body = info.crs->body();
    return Done{};
}

// Of degrees, a grid in meters would be a line; the meters are certain. The body still is that of
// the CRS.
Status dropUnusableCrs(RasterInfo& info, const RasterOverrides& overrides)
{
    if (overrides.crs || overrides.transform) {
        return Done{}; // refused if they do not fit each other
    }
    info.unused_crs_notice = noticeOfUnusedCrs(info);
    if (!info.unused_crs_notice.empty()) {
        info.notices.push_back(info.unused_crs_notice);
        info.crs.reset();
    }
    return Done{};
}

// Small bodies are irregular: their radii may differ this much from the body's.
bool areRadiiOf(const Body& body, const Ellipsoid& ellipsoid)
{
    constexpr double kFactorMax = 1.3;
    const double ratio = ellipsoid.equatorial_m / body.ellipsoid.equatorial_m;
    return ratio < kFactorMax && ratio > 1.0 / kFactorMax;
}

Status applyBody(RasterInfo& info, const RasterOverrides& overrides)
{
    if (overrides.ellipsoid && !isOblate(*overrides.ellipsoid)) {
        return refusal(
            OverrideField::Radii,
            fmt::format("an equatorial radius of {} m and a polar radius of {} m are impossible; "
                        "give a polar radius above 0 and not above the equatorial one",
                        overrides.ellipsoid->equatorial_m, overrides.ellipsoid->polar_m),
            ErrorCode::OutOfRange);
    }
    if (!overrides.body && !overrides.ellipsoid) {
        return Done{};
    }
    const Body* body = overrides.body ? bodyNamed(*overrides.body) : info.body;
    if (overrides.body && body == nullptr) {
        return refusal(OverrideField::Body,
                       fmt::format("\"{}\" is unknown; give its radii instead, or a name such as "
                                   "Mars, Moon, Earth, Vesta or Titan",
                                   *overrides.body));
    }
    if (!overrides.body && (body == nullptr || !areRadiiOf(*body, *overrides.ellipsoid))) {
        body = bodyOfRadius(overrides.ellipsoid->equatorial_m);
    }
    const Ellipsoid ellipsoid = overrides.ellipsoid ? *overrides.ellipsoid : body->ellipsoid;
    const bool is_other_ellipsoid = overrides.ellipsoid || body != info.body;
    if (!info.crs && overrides.ellipsoid && !fitsInDegrees(info)) {
        return refusal(OverrideField::Radii,
                       "the raster has no CRS to which they could apply, and its grid cannot "
                       "be in degrees; set the CRS, too");
    }
    if (info.crs && is_other_ellipsoid) {
        Result<Crs> crs = info.crs->onEllipsoid(ellipsoid, body != nullptr ? std::string(body->name)
                                                                           : "unnamed body");
        if (!crs) {
            return refusal(overrides.ellipsoid ? OverrideField::Radii : OverrideField::Body,
                           crs.error().message, crs.error().code);
        }
        info.crs = std::move(crs).value();
    } else if (!info.crs && fitsInDegrees(info)) {
        const Body unnamed{.name = "a body of these radii",
                           .ellipsoid = ellipsoid,
                           .latitude = LatitudeKind::Planetocentric,
                           .longitude = LongitudeRange{}};
        const Body& of_degrees = body != nullptr ? *body : unnamed;
        info.crs = Crs::geographic(of_degrees, ellipsoid);
        info.notices.push_back(fmt::format(
            "no CRS in the file: its extent is read as degrees on {}", of_degrees.name));
    }
    info.body = body;
    return Done{};
}

bool isOverridden(const RasterOverrides& overrides, OverrideField field)
{
    switch (field) {
    case OverrideField::Crs:
        return overrides.crs.has_value();
    case OverrideField::Body:
        return overrides.body.has_value();
    case OverrideField::Radii:
        return overrides.ellipsoid.has_value();
    case OverrideField::Transform:
        return overrides.transform.has_value();
    case OverrideField::VerticalUnit:
        return overrides.vertical_unit.has_value();
    case OverrideField::Scale:
        return overrides.scale.has_value();
    case OverrideField::Offset:
        return overrides.offset.has_value();
    case OverrideField::VerticalDatum:
        return overrides.vertical_datum.has_value();
    case OverrideField::Nodata:
        return overrides.nodata.has_value();
    }
    return false;
}

// Notices about values of the file that are not used, or that are set as they ask.
void dropSettledNotices(RasterInfo& info, const RasterOverrides& overrides)
{
    const auto is_overridden = [&overrides](OverrideField field) {
        return isOverridden(overrides, field);
    };
    std::erase_if(info.field_notices, [&](const FieldNotice& notice) {
        const bool is_settled =
            std::any_of(notice.settled_by.begin(), notice.settled_by.end(), is_overridden);
        if (is_settled) {
            std::erase(info.notices, notice.text);
        }
        return is_settled;
    });
    const auto label_notice =
        std::find(info.notices.begin(), info.notices.end(), info.labelNotice());
    std::erase_if(info.label_corrections, [&](const LabelCorrection& correction) {
        return is_overridden(correction.field);
    });
    if (label_notice != info.notices.end()) {
        *label_notice = info.labelNotice();
        std::erase(info.notices, std::string());
    }
}

bool isPlausible(const RasterInfo& info, double elevation_m)
{
    constexpr double kHeightMaxM = 1e6; // if the body is unknown
    return std::abs(elevation_m) <= bodyRadius(info).value_or(kHeightMaxM) &&
           (info.body == nullptr || canBeOn(*info.body, elevation_m, info.reference_radius_m));
}

// A value that programs write where they have no elevation.
std::optional<double> undeclaredNodata(const RasterInfo& info, const SampleStatistics& statistics)
{
    if (info.nodata) {
        return std::nullopt;
    }
    constexpr double kFloatMax = 3.4028234663852886e38;
    constexpr double kNetcdfFill = 9.969209968386869e36;
    constexpr std::array kLowMarks{-32768.0, -32767.0, -9999.0, -99999.0, -kFloatMax};
    constexpr std::array kHighMarks{1e20, kNetcdfFill, kFloatMax};
    const auto is_one_of = [](const auto& marks, double raw) {
        return std::find(marks.begin(), marks.end(), raw) != marks.end();
    };
    // Larger elevations than the type holds may have been cut off at its end. They follow on the
    // rest, and nodata does not; that it was smoothed into its surroundings is more likely where
    // the other end of the range is that of elevations.
    constexpr double kNearShare = 0.002;
    const bool is_cut_off_low =
        info.type == SampleType::Int16 && statistics.raw_minimum == -32768.0 &&
        !isIsolated(statistics, SampleEnd::Lowest, kNearShare) &&
        !isPlausible(info, info.elevationScale().height(statistics.raw_maximum));
    if (is_one_of(kLowMarks, statistics.raw_minimum) && !is_cut_off_low) {
        return statistics.raw_minimum;
    }
    const bool is_highest =
        ((info.type == SampleType::Int16 && statistics.raw_maximum == 32767.0) ||
         (info.type == SampleType::UInt16 && statistics.raw_maximum == 65535.0)) &&
        isIsolated(statistics, SampleEnd::Highest, kNearShare);
    if (is_highest || is_one_of(kHighMarks, statistics.raw_maximum)) {
        return statistics.raw_maximum;
    }
    return std::nullopt;
}

} // namespace

void RasterInfo::addNotice(std::string text, std::vector<OverrideField> settled_by)
{
    notices.push_back(text);
    field_notices.push_back({std::move(text), std::move(settled_by)});
}

std::string RasterInfo::replacementNotice() const
{
    const std::string opened = std::filesystem::path(path).filename().string();
    const std::string asked = std::filesystem::path(requested).filename().string();
    return asked.empty() || asked == opened || !in_archive.empty()
               ? std::string()
               : fmt::format("opened {} in place of {}", opened, asked);
}

std::string RasterInfo::labelNotice() const
{
    std::string ours;
    std::string theirs;
    for (const LabelCorrection& correction : label_corrections) {
        const char* const separator = ours.empty() ? "" : ", ";
        ours += separator + correction.label;
        theirs += separator + correction.gdal;
    }
    return ours.empty() ? std::string()
                        : fmt::format("from {}: {} (GDAL reads {})",
                                      label_name.empty() ? std::string("the file's metadata")
                                                         : "the label " + label_name,
                                      ours, theirs);
}

ElevationScale RasterInfo::elevationScale() const noexcept
{
    return {scale * unit.meters, offset * unit.meters - reference_radius_m.value_or(0.0)};
}

std::string RasterInfo::voidSettings() const
{
    std::string settings = nodata ? fmt::format("nodata {}", *nodata) : std::string();
    for (const double value : other_nodata) {
        settings += fmt::format(", {}", value);
    }
    return settings;
}

std::uint64_t RasterInfo::triangleCount() const noexcept
{
    return 2 * static_cast<std::uint64_t>(columns - 1) * static_cast<std::uint64_t>(rows - 1);
}

void deduceHeightReference(RasterInfo& info)
{
    static constexpr std::string_view kRadiusDatum = "sphere of radius ";
    info.reference_radius_m.reset();
    if (info.vertical_datum.starts_with(kRadiusDatum)) {
        info.vertical_datum.clear();
    }
    const std::optional<double> radius = bodyRadius(info);
    if (!radius) {
        return;
    }
    const double offset_m = info.offset * info.unit.meters;
    if (isNearRadius(offset_m, *radius)) {
        info.reference_radius_m = offset_m;
    } else if (info.typical_raw && *radius > kBodyRadiusMinM &&
               isNearRadius((*info.typical_raw * info.scale + info.offset) * info.unit.meters,
                            *radius)) {
        info.reference_radius_m = *radius;
    }
    if (info.reference_radius_m) {
        info.vertical_datum = fmt::format("{}{} m", kRadiusDatum, *info.reference_radius_m);
    }
}

void noteSuspiciousSamples(RasterInfo& info, const SampleStatistics& statistics)
{
    if (!statistics.hasSamples()) {
        info.notices.push_back(fmt::format(
            "contains no elevations: all of its {} samples are nodata", statistics.sample_count));
        return;
    }
    info.nodata_suggestion = undeclaredNodata(info, statistics);
    if (info.nodata_suggestion) {
        info.notices.push_back(noticeOfNodata(*info.nodata_suggestion));
    }
    noteElevations(info, statistics);
    if (info.unit_suggestion || info.elevation_misfit) {
        return;
    }
    for (const double raw : {statistics.raw_minimum, statistics.raw_maximum}) {
        const double height_m = info.elevationScale().height(raw);
        if (!isPlausible(info, height_m) && raw != info.nodata_suggestion) {
            info.notices.push_back(
                fmt::format("the sample {} makes an elevation of {} m, which is implausible; set "
                            "it as nodata, or set the unit or the scale",
                            raw, height_m));
            break;
        }
    }
}

std::string noticeOfNodata(double raw)
{
    return fmt::format(
        "samples of {} at an end of the range often mark nodata, but the file "
        "declares no nodata value; if they do, set it as nodata",
        raw);
}

void notePlacement(RasterInfo& info)
{
    info.crs_suggestion = info.crs ? suggestDegreesInstead(info) : suggestCrs(info);
    if (info.crs_suggestion) {
        info.notices.push_back(noticeOf(*info.crs_suggestion));
    } else if (!info.transform || !info.unused_crs_notice.empty()) {
        return; // reported already
    } else if (!info.crs) {
        info.notices.emplace_back(
            "no CRS: map units are read as meters; set its CRS or body to "
            "get longitude and latitude");
    } else {
        std::string misfit = angularMisfit(info);
        misfit = misfit.empty() ? projectedMisfit(info) : misfit;
        std::string doubt = doubtAboutPixels(info);
        if (!misfit.empty()) {
            info.notices.push_back("CRS " + misfit);
        } else if (!doubt.empty()) {
            info.notices.push_back(std::move(doubt));
        }
    }
}

std::optional<OverrideField> refusedField(const Error& error)
{
    // The sentence follows the last path, which may contain any words.
    const std::string& message = error.message;
    for (std::size_t at = 0; at != std::string::npos;) {
        const std::string_view rest = std::string_view(message).substr(at);
        for (const FieldName& known : kFieldNames) {
            if (rest.starts_with(known.name) && rest.substr(known.name.size()).starts_with(": ")) {
                return known.field;
            }
        }
        at = message.find(": ", at);
        at = at == std::string::npos ? at : at + 2;
    }
    return std::nullopt;
}

Result<RasterInfo> withOverrides(RasterInfo info, const RasterOverrides& overrides)
{
    std::optional<RasterInfo> as_read; // if the file's own description matters
    if (overrides.crs && !overrides.transform) {
        as_read = info;
        as_read->crs_suggestion = suggestCrs(info);
    }
    for (const auto apply : {applyVertical, applyTransform, applyCrs, dropUnusableCrs, applyBody}) {
        if (Status applied = apply(info, overrides); !applied) {
            return std::move(applied).error();
        }
    }
    dropSettledNotices(info, overrides);
    if (overrides.crs || overrides.transform) {
        std::string misfit = angularMisfit(info);
        misfit = misfit.empty() ? projectedMisfit(info) : misfit;
        if (misfit.empty() && as_read) {
            misfit = projectedMisfit(info, *as_read);
        }
        if (!misfit.empty()) {
            return overrides.crs ? refusal(OverrideField::Crs, misfit)
                                 : refusal(OverrideField::Transform, "CRS " + misfit);
        }
        if (std::string doubt = doubtAboutExtent(info); !doubt.empty()) {
            info.notices.push_back(std::move(doubt));
        }
    }
    deduceHeightReference(info);
    if (overrides.vertical_datum) {
        info.vertical_datum = *overrides.vertical_datum;
    }
    notePlacement(info);
    return info;
}

Status checkIsSurface(const std::string& path, const RasterInfo& info)
{
    if (info.columns >= 2 && info.rows >= 2) {
        return Done{};
    }
    return Error{ErrorCode::Invalid,
                 fmt::format("{}: {} × {} samples are not a surface; at least 2 × 2 are needed",
                             path, info.columns, info.rows)};
}

} // namespace marsview
