#include "core/raster/metadata_elevation.h"

#include "core/base/plain_number.h"

#include <gdal_priv.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace marsview {
namespace {

// Letter case is ignored.
constexpr std::array kScaleNames{"SCALE_FACTOR", "SCALING_FACTOR"};
constexpr std::array kOffsetNames{"ADD_OFFSET"};
constexpr std::array kUnitNames{"UNITS", "UNIT", "UNITTYPE"};

std::string textIn(GDALMajorObject& object, std::span<const char* const> names)
{
    for (const char* const name : names) {
        if (const char* const text = object.GetMetadataItem(name)) {
            return text;
        }
    }
    return {};
}

std::optional<double> numberIn(GDALMajorObject& object, std::span<const char* const> names)
{
    const std::optional<double> number = parseNumber(textIn(object, names));
    return number && std::isfinite(*number) ? number : std::nullopt;
}

struct DeclaredScale {
    std::optional<double> scale;
    std::optional<double> offset;

    bool changes() const { return scale.value_or(1.0) != 1.0 || offset.value_or(0.0) != 0.0; }
};

DeclaredScale declaredScale(GDALMajorObject& object)
{
    DeclaredScale declared{numberIn(object, kScaleNames), numberIn(object, kOffsetNames)};
    if (declared.scale == 0.0) {
        declared.scale.reset();
    }
    if (!declared.offset && textIn(object, std::array{"SCALING_FACTOR"}) != "") {
        // On its own, the name is also that of a position in a file.
        declared.offset = numberIn(object, std::array{"OFFSET"});
    }
    return declared;
}

// "Scale factor" is also a parameter of map projections.
bool isOfProjection(GDALDataset& dataset, double scale)
{
    const OGRSpatialReference* const crs = dataset.GetSpatialRef();
    return crs != nullptr && crs->IsProjected() != 0 &&
           crs->GetProjParm(SRS_PP_SCALE_FACTOR, 1.0) == scale;
}

DeclaredScale declaredScale(GDALDataset& dataset, GDALRasterBand& band)
{
    int has_scale = 0;
    int has_offset = 0;
    band.GetScale(&has_scale);
    band.GetOffset(&has_offset);
    if (has_scale != 0 || has_offset != 0) {
        return {};
    }
    const DeclaredScale of_band = declaredScale(static_cast<GDALMajorObject&>(band));
    if (of_band.scale || of_band.offset) {
        return of_band;
    }
    DeclaredScale of_raster = declaredScale(static_cast<GDALMajorObject&>(dataset));
    if (of_raster.scale && isOfProjection(dataset, *of_raster.scale)) {
        of_raster.scale.reset();
    }
    return of_raster;
}

void applyScale(RasterInfo& info, const DeclaredScale& declared)
{
    const bool is_integer =
        dispatchSampleType(info.type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
    if (!is_integer) {
        info.addNotice(
            fmt::format("the file's metadata give scale {} and offset {}, which are not applied to "
                        "floating-point samples; set scale and offset if they should be "
                        "(--scale, --offset)",
                        declared.scale.value_or(1.0), declared.offset.value_or(0.0)),
            {OverrideField::Scale, OverrideField::Offset});
        return;
    }
    const auto apply = [&info](OverrideField field, const char* what,
                               const std::optional<double>& value, double& applied) {
        if (value && *value != applied) {
            info.label_corrections.push_back(
                {field, fmt::format("{} {}", what, *value), fmt::format("{} {}", what, applied)});
            applied = *value;
        }
    };
    apply(OverrideField::Scale, "scale", declared.scale, info.scale);
    apply(OverrideField::Offset, "offset", declared.offset, info.offset);
}

void applyUnit(RasterInfo& info, const std::string& text)
{
    const std::optional<VerticalUnit> unit = verticalUnitFrom(text);
    if (!unit) {
        return; // of the map, or of other values
    }
    if (*unit != info.unit) {
        info.label_corrections.push_back(
            {OverrideField::VerticalUnit, "unit " + text, "unit none"});
    }
    info.unit = *unit;
    info.is_unit_declared = true;
}

} // namespace

void applyMetadata(GDALDataset& dataset, GDALRasterBand& band, RasterInfo& info)
{
    if (const DeclaredScale declared = declaredScale(dataset, band); declared.changes()) {
        applyScale(info, declared);
    }
    if (!info.is_unit_declared && (band.GetUnitType() == nullptr || *band.GetUnitType() == '\0')) {
        const std::string of_band = textIn(band, kUnitNames);
        applyUnit(info, of_band.empty() ? textIn(dataset, kUnitNames) : of_band);
    }
    if (std::string notice = info.labelNotice(); !notice.empty()) {
        info.notices.push_back(std::move(notice));
    }
}

} // namespace marsview
