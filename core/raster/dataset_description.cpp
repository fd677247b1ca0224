#include "core/raster/dataset_description.h"

#include "core/files/exact_crs.h"
#include "core/formats/pds3_placement.h"
#include "core/raster/axis_hints.h"
#include "core/raster/label_elevation.h"
#include "core/raster/metadata_elevation.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace marsview {
namespace {

nlohmann::json jsonDomain(GDALDataset& dataset, const char* domain)
{
    char** entries = dataset.GetMetadata(domain);
    if (entries == nullptr || entries[0] == nullptr) {
        return {};
    }
    nlohmann::json parsed = nlohmann::json::parse(entries[0], nullptr, false);
    return parsed.is_discarded() ? nlohmann::json{} : parsed;
}

// A text value in an object of a PDS3 label; empty if missing or not a text.
std::string labelText(const nlohmann::json& label, const char* object, const char* key)
{
    const auto parent = label.find(object);
    if (parent == label.end() || !parent->is_object()) {
        return "";
    }
    const auto entry = parent->find(key);
    return entry != parent->end() && entry->is_string() ? entry->get<std::string>() : "";
}

void readVertical(GDALDataset& dataset,
                  GDALRasterBand& band,
                  const nlohmann::json& pds3,
                  const std::optional<LabelElevation>& label,
                  RasterInfo& info)
{
    int has_scale = 0;
    int has_offset = 0;
    const double scale = band.GetScale(&has_scale);
    const double offset = band.GetOffset(&has_offset);
    if (info.driver == "FITS") { // GDAL has applied them to the samples
        has_scale = 0;
        has_offset = 0;
    }
    if (has_scale != 0 && std::isfinite(scale) && scale != 0.0) {
        info.scale = scale;
    } else if (has_scale != 0 && !(label && label->hasScale())) {
        info.addNotice(
            fmt::format("the scale {} is invalid for elevations; 1 is used instead", scale),
            {OverrideField::Scale});
    }
    if (has_offset != 0 && std::isfinite(offset)) {
        info.offset = offset;
    }
    std::string unit = band.GetUnitType() != nullptr ? band.GetUnitType() : "";
    if (const auto known = verticalUnitFrom(unit)) {
        info.unit = *known;
        info.is_unit_declared = true;
    }
    if (label) {
        applyLabel(info, *label);
        if (auto notice = noticeOfUnusedScale(dataset, info)) {
            info.addNotice(*std::move(notice), {OverrideField::Scale, OverrideField::Offset});
        }
        unit = unit.empty() ? label->unit : unit;
    } else {
        applyMetadata(dataset, band, info);
    }
    if (!info.is_unit_declared && !unit.empty()) {
        info.addNotice(
            fmt::format("the unit \"{}\" is not a known unit of length; meters are assumed", unit),
            {OverrideField::VerticalUnit});
    } else if (!info.is_unit_declared && info.crs && info.crs->verticalUnit()) {
        info.unit = *info.crs->verticalUnit();
        info.is_unit_declared = true;
    }
    // The vertical datum, if the product declares it.
    if (info.crs && !info.crs->verticalDatumName().empty()) {
        info.vertical_datum = info.crs->verticalDatumName();
    } else if (const char* dted = dataset.GetMetadataItem("DTED_VerticalDatum")) {
        info.vertical_datum = EQUAL(dted, "MSL") ? "mean sea level" : dted;
    } else if (const char* declared = dataset.GetMetadataItem("VERTICAL_DATUM")) {
        info.vertical_datum = declared; // GeoTIFF has no place for datums of other bodies
    } else if (info.driver == "SRTMHGT") {
        info.vertical_datum = "EGM96 geoid";
    } else if (labelText(pds3, "IMAGE", "DESCRIPTION").find("areoid") != std::string::npos) {
        info.vertical_datum = "areoid";
    }
}

bool isPlaced(GDALDataset& dataset)
{
    GeoTransform::Terms terms{};
    return dataset.GetGeoTransform(terms.data()) == CE_None;
}

// The label of a product, or empty.
std::string
labelPathOf(GDALDataset& dataset, const RasterInfo& info, const std::string& known_label)
{
    if (info.driver == "PDS") {
        const CPLStringList files(dataset.GetFileList());
        return files.Count() > 0 ? files[0] : info.path;
    }
    const bool may_have_label = info.driver == "GTiff" || info.driver.starts_with("JP2");
    return known_label.empty() && may_have_label ? labelNextTo(info.path) : known_label;
}

// The label of a TIFF or JPEG2000, where that places it, or of raw samples whose radii GDAL reads
// wrong. A TIFF's own placement goes first, and so does a CRS that only the raster has.
std::shared_ptr<GDALDataset>
placementOf(GDALDataset& dataset, const RasterInfo& info, const std::string& label_path)
{
    if (label_path.empty() || (info.driver == "GTiff" && isPlaced(dataset)) ||
        (info.driver == "PDS" && !hasRadiiInOtherUnits(label_path))) {
        return nullptr;
    }
    std::shared_ptr<GDALDataset> label = openPds3Placement(label_path);
    const bool is_of_same_size = label && label->GetRasterXSize() == dataset.GetRasterXSize() &&
                                 label->GetRasterYSize() == dataset.GetRasterYSize();
    const bool is_placed =
        is_of_same_size && isPlaced(*label) &&
        (label->GetSpatialRef() != nullptr || dataset.GetSpatialRef() == nullptr);
    return is_placed ? label : nullptr;
}

// Where GDAL reads the radii of a PDS3 label in another unit than the label gives.
std::string noticeOfRadii(GDALDataset& dataset, GDALDataset& placed, const std::string& label_path)
{
    const OGRSpatialReference* const wrong = dataset.GetSpatialRef();
    const OGRSpatialReference* const right = placed.GetSpatialRef();
    if (wrong == nullptr || right == nullptr || wrong->GetSemiMajor() == right->GetSemiMajor()) {
        return {};
    }
    return fmt::format("from the label {}: radius {} m (GDAL reads {} m)",
                       CPLGetFilename(label_path.c_str()), right->GetSemiMajor(),
                       wrong->GetSemiMajor());
}

// GDAL's stand-in for a file that names no CRS.
bool isStandIn(const OGRSpatialReference& reference)
{
    const char* unit = nullptr;
    reference.GetLinearUnits(&unit);
    return reference.IsLocal() != 0 && unit != nullptr && EQUAL(unit, "unknown");
}

void readPlacement(GDALDataset& dataset, const nlohmann::json& pds3, RasterInfo& info)
{
    std::optional<Crs> exact = exactCrsOf(dataset);
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    if (exact || (reference != nullptr && !isStandIn(*reference))) {
        Result<Crs> crs =
            exact ? Result<Crs>(std::move(*exact)) : Crs::fromSpatialReference(*reference);
        if (crs) {
            info.crs = std::move(crs).value();
            info.body = info.crs->body();
            for (const std::string& notice : info.crs->notices()) {
                info.addNotice(notice, {OverrideField::Crs});
            }
        } else {
            info.addNotice(fmt::format("{}; the map is placed without a CRS", crs.error().message),
                           {OverrideField::Crs});
        }
    }
    GeoTransform::Terms terms{};
    if (dataset.GetGeoTransform(terms.data()) != CE_None) {
        info.addNotice(
            "no georeferencing in the file: each pixel is placed as one unit "
            "square; give a geotransform to place it",
            {OverrideField::Transform});
        return;
    }
    Result<GeoTransform> transform = GeoTransform::fromTerms(terms);
    if (!transform) {
        info.addNotice(fmt::format("{}: each pixel is placed as one unit square; give "
                                   "another to place it",
                                   transform.error().message),
                       {OverrideField::Transform});
        return;
    }
    info.transform = *transform;
    if (info.crs) {
        const PixelShift shift = pds3PlacementShift(pds3, *info.transform, *info.crs);
        if (!shift.isNone()) {
            info.transform = shifted(*info.transform, shift);
            info.addNotice(fmt::format("shifted by {} column and {} row to match the latitude and "
                                       "longitude limits in the label",
                                       shift.columns, shift.rows),
                           {OverrideField::Transform});
        }
    }
}

void readNodata(GDALRasterBand& band, RasterInfo& info)
{
    int has_nodata = 0;
    double nodata = 0.0;
    if (info.type == SampleType::Int64) {
        nodata = static_cast<double>(band.GetNoDataValueAsInt64(&has_nodata));
    } else if (info.type == SampleType::UInt64) {
        nodata = static_cast<double>(band.GetNoDataValueAsUInt64(&has_nodata));
    } else {
        nodata = band.GetNoDataValue(&has_nodata);
    }
    if (has_nodata != 0) {
        info.nodata = nodata;
    }
    // ISIS3 and PDS4 have several special values, other formats a mask file: only the mask shows
    // those.
    const int flags = band.GetMaskFlags();
    info.has_mask_band = (flags & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

} // namespace

std::string listOfSubdatasets(GDALDataset& dataset)
{
    const CPLStringList entries(CSLDuplicate(dataset.GetMetadata("SUBDATASETS")));
    std::string list;
    for (int i = 1; i <= 8; ++i) {
        const char* name = entries.FetchNameValue(fmt::format("SUBDATASET_{}_NAME", i).c_str());
        if (name == nullptr) {
            break;
        }
        list += (list.empty() ? "" : ", ") + std::string(name);
    }
    return list;
}

namespace {

bool isColor(GDALColorInterp color)
{
    switch (color) {
    case GCI_RedBand:
    case GCI_GreenBand:
    case GCI_BlueBand:
    case GCI_CyanBand:
    case GCI_MagentaBand:
    case GCI_YellowBand:
        return true;
    default:
        return false;
    }
}

} // namespace

bool isPicture(GDALDataset& dataset, GDALRasterBand& band)
{
    return band.GetColorTable() != nullptr ||
           (isColor(band.GetColorInterpretation()) && dataset.GetRasterCount() >= 3);
}

// Some formats have a picture of the elevations in the bands before them.
std::string refusalOfPicture(GDALDataset& dataset, int band)
{
    for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
        GDALRasterBand& other = *dataset.GetRasterBand(i);
        if (!isPicture(dataset, other) && other.GetColorInterpretation() != GCI_AlphaBand) {
            return fmt::format(
                "band {} is part of a color picture; open band {} (--band {}) instead", band, i, i);
        }
    }
    return "is a color picture, not an elevation map";
}

std::string noticeOfLikelyPicture(GDALDataset& dataset, GDALRasterBand& band)
{
    if (isColor(band.GetColorInterpretation())) {
        return "is one band of a color picture, read as elevations; open an elevation map instead";
    }
    const int count = dataset.GetRasterCount();
    if (count < 3 || count > 4) {
        return "";
    }
    for (int i = 1; i <= count; ++i) {
        GDALRasterBand& other = *dataset.GetRasterBand(i);
        const bool is_named = *other.GetDescription() != '\0' || *other.GetUnitType() != '\0' ||
                              other.GetScale() != 1.0 || other.GetOffset() != 0.0;
        if (other.GetRasterDataType() != GDT_Byte || is_named) {
            return "";
        }
    }
    return fmt::format(
        "looks like a color picture: band {} of {} is read as elevations, and all "
        "are 8-bit values without a unit; open an elevation map instead",
        band.GetBand(), count);
}

void describe(GDALDataset& dataset,
              GDALRasterBand& band,
              const DatasetOrigin& origin,
              RasterInfo& info)
{
    const std::string label_path = labelPathOf(dataset, info, origin.label);
    const std::shared_ptr<GDALDataset> label_placement = placementOf(dataset, info, label_path);
    GDALDataset& placed = label_placement ? *label_placement : dataset;
    const nlohmann::json pds3 = jsonDomain(placed, "json:PDS");
    readNodata(band, info);
    readPlacement(placed, pds3, info);
    if (info.driver == "PDS" && label_placement) {
        if (std::string notice = noticeOfRadii(dataset, placed, label_path); !notice.empty()) {
            info.addNotice(std::move(notice),
                           {OverrideField::Crs, OverrideField::Body, OverrideField::Radii});
        }
    }
    if (!info.crs) {
        info.axis_hints = axisHintsOf(dataset, origin.path);
    }
    readVertical(dataset, band, pds3, labelElevationOf(dataset, info, label_path), info);
}

} // namespace marsview
