#include "core/raster/raster_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

// Heights of a planetary raster are radii where they are this near to the body's radius.
constexpr double kRadiusShareMax = 0.2;

// Below this radius a height may well be as large as the radius, so that nothing can be concluded
// from a sample; an offset in the file's header still can.
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
    if (!info.transform) {
        return false;
    }
    const double columns = static_cast<double>(info.columns);
    const double rows = static_cast<double>(info.rows);
    const MapPoint first = info.transform->toMap({0.0, 0.0});
    const MapPoint last = info.transform->toMap({columns - 1.0, rows - 1.0});
    return std::max(std::abs(first.x), std::abs(last.x)) <= 540.0 &&
           std::abs(last.x - first.x) <= 361.0 &&
           std::max(std::abs(first.y), std::abs(last.y)) <= 90.0;
}

} // namespace

ElevationScale RasterInfo::elevationScale() const noexcept
{
    return {scale * unit.metres, offset * unit.metres - reference_radius_m.value_or(0.0)};
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
    const double offset_m = info.offset * info.unit.metres;
    if (isNearRadius(offset_m, *radius)) {
        info.reference_radius_m = offset_m;
    } else if (info.typical_raw && *radius > kBodyRadiusMinM &&
               isNearRadius((*info.typical_raw * info.scale + info.offset) * info.unit.metres,
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
        info.notices.push_back(fmt::format("holds no height: all of its {} samples are void",
                                           statistics.sample_count));
        return;
    }
    constexpr std::array kUsualVoidMarks{-32768.0, -32767.0, -9999.0, -99999.0,
                                         -3.4028234663852886e38};
    const bool is_usual_mark = std::find(kUsualVoidMarks.begin(), kUsualVoidMarks.end(),
                                         statistics.raw_minimum) != kUsualVoidMarks.end();
    constexpr double kHeightMaxM = 1e6; // where no body is known
    const double height_max_m = bodyRadius(info).value_or(kHeightMaxM);
    for (const double raw : {statistics.raw_minimum, statistics.raw_maximum}) {
        const double height_m = info.elevationScale().height(raw);
        if (!(std::abs(height_m) <= height_max_m)) {
            info.notices.push_back(
                fmt::format("a height of {} m is larger than any body's; if it "
                            "marks voids, give {} as nodata, or tell the unit",
                            height_m, raw));
            break;
        }
    }
    if (!info.nodata && is_usual_mark) {
        info.notices.push_back(
            fmt::format("the lowest sample, {}, is a usual mark for voids, but "
                        "the file declares none; if it is one, give it as nodata",
                        statistics.raw_minimum));
    }
}

void notePlacement(RasterInfo& info)
{
    if (!info.transform) {
        return; // told when the file was opened
    }
    if (!info.crs) {
        info.notices.emplace_back(
            "no CRS: map units are taken as metres; tell its CRS or body to "
            "get longitude and latitude");
        return;
    }
    if (info.crs->kind() != CrsKind::Geographic) {
        return;
    }
    const double columns = static_cast<double>(info.columns);
    const double rows = static_cast<double>(info.rows);
    const double turn = *info.crs->turn();
    for (const GridPoint corner :
         {GridPoint{0.0, 0.0}, GridPoint{columns - 1.0, 0.0}, GridPoint{0.0, rows - 1.0},
          GridPoint{columns - 1.0, rows - 1.0}}) {
        const MapPoint p = info.transform->toMap(corner);
        if (std::abs(p.y) > turn / 4.0 + info.transform->pixelHeight() ||
            std::abs(p.x) > 2.0 * turn) {
            info.notices.push_back(fmt::format(
                "its corner ({}, {}) is no longitude and latitude, so CRS \"{}\" cannot "
                "be right; tell another one",
                p.x, p.y, info.crs->name()));
            return;
        }
    }
}

Result<RasterInfo> withOverrides(RasterInfo info, const RasterOverrides& overrides)
{
    if (overrides.vertical_unit) {
        const auto unit = verticalUnitFrom(*overrides.vertical_unit);
        if (!unit) {
            return Error{ErrorCode::Invalid,
                         fmt::format("vertical unit: \"{}\" is not known; use m, km, ft or "
                                     "\"US survey ft\"",
                                     *overrides.vertical_unit)};
        }
        info.unit = *unit;
        info.is_unit_declared = true;
    }
    if (overrides.nodata) {
        info.nodata = overrides.nodata;
    }
    if (overrides.transform) {
        Result<GeoTransform> transform = GeoTransform::fromTerms(*overrides.transform);
        if (!transform) {
            return std::move(transform).error();
        }
        info.transform = *transform;
    }
    if (overrides.crs) {
        Result<Crs> crs = Crs::fromText(*overrides.crs);
        if (!crs) {
            return Error{crs.error().code, "CRS: " + crs.error().message};
        }
        info.crs = std::move(crs).value();
        info.body = info.crs->body();
    }
    if (overrides.ellipsoid && !isOblate(*overrides.ellipsoid)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("radii: {} m and {} m are not those of an oblate ellipsoid",
                                 overrides.ellipsoid->equatorial_m, overrides.ellipsoid->polar_m)};
    }
    if (overrides.body || overrides.ellipsoid) {
        const Body* body = overrides.body ? bodyNamed(*overrides.body) : info.body;
        if (overrides.body && body == nullptr) {
            return Error{ErrorCode::Invalid,
                         fmt::format("body: \"{}\" is not known; give its radii instead, or a name "
                                     "such as Mars, Moon, Earth, Vesta or Titan",
                                     *overrides.body)};
        }
        constexpr double kFactorMax = 1.3; // small bodies are irregular
        const auto suits = [](const Body& candidate, const Ellipsoid& e) {
            const double ratio = e.equatorial_m / candidate.ellipsoid.equatorial_m;
            return ratio < kFactorMax && ratio > 1.0 / kFactorMax;
        };
        if (!overrides.body && (body == nullptr || !suits(*body, *overrides.ellipsoid))) {
            body = bodyOfRadius(overrides.ellipsoid->equatorial_m);
        }
        const Ellipsoid ellipsoid = overrides.ellipsoid ? *overrides.ellipsoid : body->ellipsoid;
        const bool is_other_ellipsoid = overrides.ellipsoid || body != info.body;
        if (info.crs && is_other_ellipsoid) {
            Result<Crs> crs = info.crs->onEllipsoid(
                ellipsoid, body != nullptr ? std::string(body->name) : "unnamed body");
            if (!crs) {
                return std::move(crs).error();
            }
            info.crs = std::move(crs).value();
        } else if (!info.crs && body != nullptr && fitsInDegrees(info)) {
            info.crs = Crs::geographic(*body, ellipsoid);
            info.notices.push_back(
                fmt::format("no CRS in the file: its extent is read as degrees on {}", body->name));
        }
        info.body = body;
    }
    deduceHeightReference(info);
    notePlacement(info);
    return info;
}

} // namespace marsview
