#include "core/raster/raster_file.h"

#include "core/files/archive_rasters.h"
#include "core/files/exact_crs.h"
#include "core/files/gdal_runtime.h"
#include "core/files/open_guard.h"
#include "core/files/opening_job.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/raster/axis_hints.h"
#include "core/raster/gdal_types.h"
#include "core/raster/label_elevation.h"
#include "core/raster/large_blocks.h"
#include "core/raster/mosaic.h"
#include "core/raster/netcdf_extent.h"
#include "core/raster/pds3_placement.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <unistd.h>

namespace marsview {
namespace {

// Samples are read in bands of whole rows of about this size: large enough that the cost of the
// call is negligible, small enough for prompt progress and cancellation.
constexpr std::size_t kBandBytes = std::size_t{8} << 20;

// A row of blocks larger than this is read in parts, though its blocks are then decoded again.
constexpr std::size_t kBandBytesMax = std::size_t{64} << 20;

// Larger blocks are not decoded for statistics: with a copy in GDAL's cache and the compressed
// bytes they would take 300 MB.
constexpr std::size_t kScannedBlockBytesMax = std::size_t{96} << 20;

using Dataset = GDALDatasetUniquePtr;

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

// A raster of several color bands, or with one palette band, is a picture.
bool isPicture(GDALDataset& dataset, GDALRasterBand& band)
{
    if (band.GetColorTable() != nullptr) {
        return true;
    }
    switch (band.GetColorInterpretation()) {
    case GCI_RedBand:
    case GCI_GreenBand:
    case GCI_BlueBand:
    case GCI_CyanBand:
    case GCI_MagentaBand:
    case GCI_YellowBand:
        return dataset.GetRasterCount() >= 3;
    default:
        return false;
    }
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

struct OpenedDataset {
    Dataset dataset;
    std::string name;
    std::optional<RemoteVersion> remote{};  // for a raster on a server
    std::shared_ptr<const Mosaic> mosaic{}; // of a folder of rasters
    std::string label{};                    // of a product whose samples are in a TIFF or JPEG2000
    bool prints = false;                    // a library prints lines to stderr
};

// Opens the first possible of GDAL's names; errors as for openFirst().
Result<OpenedDataset> openLocal(const std::vector<std::string>& names)
{
    Result<GuardedDataset> opened = openFirst(names);
    if (!opened) {
        return std::move(opened).error();
    }
    OpenedDataset result{.dataset = std::move(opened->dataset),
                         .name = names[opened->name],
                         .prints = opened->prints};
    if (hasLargePlainStrips(*result.dataset)) {
        const DirectReads scope;
        if (Dataset direct = reopen(result.name, *opened)) {
            result.dataset = std::move(direct);
        }
    }
    return result;
}

// The virtual raster of a mosaic, whose parts were opened before.
Result<Dataset> openMosaic(const Mosaic& mosaic)
{
    const GdalMessages messages;
    Dataset dataset(GDALDataset::Open(mosaic.vrt.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
    if (!dataset) {
        return Error{ErrorCode::Unsupported, messages.firstFailure("")};
    }
    return dataset;
}

// The raster of a label with samples in a TIFF or JPEG2000, which GDAL would read as raw samples.
// Empty for everything else.
std::optional<Result<OpenedDataset>> openEncodedImage(const std::string& name)
{
    const std::string image =
        lowerCase(name).ends_with(".lbl") ? encodedImageOf(name) : std::string();
    if (image.empty()) {
        return std::nullopt;
    }
    Result<OpenedDataset> opened = openLocal({image});
    if (!opened) {
        return Error{opened.error().code, fmt::format("{}: {}", image, opened.error().message)};
    }
    opened->label = name;
    return opened;
}

Result<OpenedDataset> openFolder(const std::string& path, int band)
{
    Result<std::shared_ptr<const Mosaic>> mosaic = mosaicOf(path, band);
    if (!mosaic) {
        return std::move(mosaic).error();
    }
    Result<Dataset> dataset = openMosaic(**mosaic);
    if (!dataset) {
        return Error{dataset.error().code, fmt::format("{}: {}", path, dataset.error().message)};
    }
    return OpenedDataset{
        .dataset = std::move(dataset).value(), .name = path, .mosaic = std::move(mosaic).value()};
}

// Opens it on the condition that its version is `version`.
Result<Dataset> openRemote(const std::string& name, const RemoteVersion& version)
{
    const GdalMessages messages;
    const RemoteScope scope(name, version);
    constexpr std::array<const char*, 2> kTiff{"GTiff", nullptr};
    Dataset dataset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER, kTiff.data()));
    if (!dataset && !messages.hasFailed()) {
        Result<GuardedDataset> opened = openFirst({name});
        if (opened) {
            dataset = std::move(opened->dataset);
        } else if (opened.error().code != ErrorCode::Unsupported) {
            return Error{opened.error().code,
                         fmt::format("{}: {}", addressOf(name), opened.error().message)};
        }
    }
    if (!dataset) {
        return remoteFailure(
            name, version, messages,
            fmt::format("is not a raster that GDAL can read, or {}", kConnectionLost));
    }
    return dataset;
}

Result<OpenedDataset> openRemoteOnce(const std::string& name)
{
    Result<RemoteVersion> version = askRemote(name);
    if (!version) {
        return std::move(version).error();
    }
    Result<Dataset> dataset = openRemote(name, *version);
    if (!dataset) {
        return std::move(dataset).error();
    }
    return OpenedDataset{
        .dataset = std::move(dataset).value(), .name = name, .remote = std::move(version).value()};
}

// Retries a lost connection, which GDAL does only for some responses, but not a server that is slow
// to fail.
Result<OpenedDataset> openRemote(const std::string& name)
{
    using Clock = std::chrono::steady_clock;
    constexpr int kAttempts = 3;
    constexpr std::chrono::milliseconds kPause{300};
    constexpr std::chrono::seconds kAtOnce{2};
    for (int attempt = 1;; ++attempt) {
        const Clock::time_point start = Clock::now();
        Result<OpenedDataset> opened = openRemoteOnce(name);
        if (opened || opened.error().code != ErrorCode::Unreadable || attempt == kAttempts ||
            Clock::now() - start > kAtOnce) {
            return opened;
        }
        std::this_thread::sleep_for(attempt * kPause);
    }
}

Result<OpenedDataset> openDataset(const std::string& path, int band)
{
    Result<std::vector<std::string>> names = rasterNamesFor(path);
    if (!names) {
        return std::move(names).error();
    }
    if (remoteNameFor(names->front())) {
        return openRemote(names->front());
    }
    for (std::size_t i = 0; i < names->size(); ++i) {
        if (auto image = openEncodedImage((*names)[i])) {
            if (i > 0) {
                if (auto before = openLocal(
                        {names->begin(), names->begin() + static_cast<std::ptrdiff_t>(i)})) {
                    return before;
                }
            }
            return *std::move(image);
        }
    }
    Result<OpenedDataset> opened = openLocal(*names);
    if (opened) {
        return opened;
    }
    std::string first_failure = opened.error().message;
    if (opened.error().code != ErrorCode::Unsupported) {
        return Error{opened.error().code, fmt::format("{}: {}", path, first_failure)};
    }
    if (isFolder(path)) {
        return openFolder(path, band);
    }
    const auto says = [&first_failure](const char* words) {
        return first_failure.find(words) != std::string::npos;
    };
    if (says("not recognized") || first_failure.empty()) {
        first_failure =
            "is not a raster that GDAL can read, or is damaged; convert it to GeoTIFF or fetch it "
            "again";
    } else if (says("No such file or directory")) {
        first_failure = fmt::format(
            "names a data file that is missing; put it next to this file ({})", first_failure);
    }
    return Error{ErrorCode::Unsupported, fmt::format("{}: {}", path, first_failure)};
}

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
    if (has_scale != 0 && std::isfinite(scale) && scale != 0.0) {
        info.scale = scale;
    } else if (has_scale != 0 && !(label && label->scale)) {
        info.notices.push_back(
            fmt::format("the scale {} is invalid for elevations; 1 is used instead", scale));
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
            info.notices.push_back(*std::move(notice));
        }
        unit = unit.empty() ? label->unit : unit;
    }
    if (!info.is_unit_declared && !unit.empty()) {
        info.notices.push_back(
            fmt::format("the unit \"{}\" is not a known unit of length; meters are assumed", unit));
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

void readPlacement(GDALDataset& dataset, const nlohmann::json& pds3, RasterInfo& info)
{
    std::optional<Crs> exact = exactCrsOf(dataset);
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    if (exact || reference != nullptr) {
        Result<Crs> crs =
            exact ? Result<Crs>(std::move(*exact)) : Crs::fromSpatialReference(*reference);
        if (crs) {
            info.crs = std::move(crs).value();
            info.body = info.crs->body();
            for (const std::string& notice : info.crs->notices()) {
                info.notices.push_back(notice);
            }
        } else {
            info.notices.push_back(
                fmt::format("{}; the map is placed without a CRS", crs.error().message));
        }
    }
    GeoTransform::Terms terms{};
    if (dataset.GetGeoTransform(terms.data()) != CE_None) {
        info.notices.emplace_back(
            "no georeferencing in the file: each pixel is placed as one unit "
            "square; give a geotransform to place it");
        return;
    }
    Result<GeoTransform> transform = GeoTransform::fromTerms(terms);
    if (!transform) {
        info.notices.push_back(
            fmt::format("{}: each pixel is placed as one unit square; give "
                        "another to place it",
                        transform.error().message));
        return;
    }
    info.transform = *transform;
    if (info.crs) {
        const PixelShift shift = pds3PlacementShift(pds3, *info.transform, *info.crs);
        if (!shift.isNone()) {
            info.transform = shifted(*info.transform, shift);
            info.notices.push_back(fmt::format(
                "shifted by {} column and {} row to match the latitude and longitude limits in the "
                "label",
                shift.columns, shift.rows));
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

struct NetcdfExtent {
    std::string path;
    std::int64_t bytes = 0;
};

std::optional<NetcdfExtent> netcdfExtentOf(GDALDataset& dataset, const std::string& driver)
{
    const CPLStringList files(driver == "netCDF" ? dataset.GetFileList() : nullptr);
    if (files.Count() == 0) {
        return std::nullopt;
    }
    const auto bytes = classicNetcdfBytes(files[0]);
    return bytes ? std::optional<NetcdfExtent>({files[0], static_cast<std::int64_t>(*bytes)})
                 : std::nullopt;
}

} // namespace

struct RasterFile::Impl {
    Dataset dataset;
    GDALRasterBand* band = nullptr;
    std::optional<NetcdfExtent> netcdf;   // for classic netCDF files
    std::optional<RemoteVersion> remote;  // for a raster on a server
    std::shared_ptr<const Mosaic> mosaic; // of a folder of rasters
    RasterInfo info;
    // If present, whole rows are read through these.
    mutable std::optional<TiffStrips> strips;
    bool has_plain_strips = false; // read without caching more than requested
    // After a read that failed, GDAL 3.6 silently returns wrong samples.
    mutable bool is_spoilt = false;
    bool prints = false; // a library prints lines to stderr

    Status renew();

    Status readRows(GDALRasterBand& from,
                    SampleGrid& grid,
                    const GridWindow& window,
                    std::size_t grid_row) const;
    Status markMasked(GDALRasterBand& from,
                      SampleGrid& grid,
                      const GridWindow& window,
                      std::size_t grid_row) const;
    Result<LoadedSamples>
    readFrom(GDALRasterBand& from, const GridWindow& window, const VoidRule& voids) const;
    Status checkExtent(const GridWindow& window) const;
    Error readFailure(const GdalMessages& messages, const GridWindow& window) const;
    Error readFailure(const std::string& why, const GridWindow& window) const;
    std::size_t rowsPerBand() const;
    Result<GridSize> scanStep() const;
    bool isStored(const GridWindow& window) const;
    Result<SampleStatistics> scanUnstored(const GridWindow& window, const VoidRule& voids) const;
    std::optional<double> findTypicalSample();
};

RasterFile::RasterFile(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

const RasterInfo& RasterFile::info() const noexcept
{
    return impl_->info;
}

Result<RasterFile> RasterFile::open(const std::string& path, int band)
{
    ensureGdal();
    Result<OpenedDataset> opened = openDataset(path, band);
    if (!opened) {
        return std::move(opened).error();
    }
    auto impl = std::make_unique<Impl>();
    impl->dataset = std::move(opened->dataset);
    impl->prints = opened->prints;
    const QuietOutput quiet(impl->prints);
    if (opened->mosaic) {
        impl->info = opened->mosaic->info;
        impl->info.path = path;
        impl->band = impl->dataset->GetRasterBand(1);
        impl->mosaic = std::move(opened->mosaic);
        return RasterFile(std::move(impl));
    }
    GDALDataset& dataset = *impl->dataset;
    RasterInfo& info = impl->info;
    info.path = opened->name;
    impl->remote = std::move(opened->remote);
    if (impl->remote) {
        info.remote_version = impl->remote->text();
        info.has_named_version = impl->remote->isNamed();
    }
    const auto refuse = [&path](ErrorCode code, const std::string& why) {
        return Error{code, fmt::format("{}: {}", path, why)};
    };
    if (info.path != path && !impl->remote) {
        const std::string archive = archiveNameFor(path);
        const std::string notice =
            archive.empty() ? std::string() : archiveNotice(rastersInArchive(archive), info.path);
        info.notices.push_back(notice.empty()
                                   ? fmt::format("opened in place of {}",
                                                 std::filesystem::path(path).filename().string())
                                   : notice);
    }
    info.driver = dataset.GetDriverName();
    info.band_count = dataset.GetRasterCount();
    if (info.band_count == 0) {
        const std::string subdatasets = listOfSubdatasets(dataset);
        if (!subdatasets.empty()) {
            return refuse(ErrorCode::Unsupported,
                          "holds several rasters; open one of " + subdatasets);
        }
        return refuse(ErrorCode::Unsupported, "holds no raster band");
    }
    if (band < 1 || band > info.band_count) {
        return refuse(
            ErrorCode::OutOfRange,
            fmt::format("has bands 1 to {}, but band {} was requested", info.band_count, band));
    }
    info.band = band;
    impl->band = dataset.GetRasterBand(band);
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    info.columns = static_cast<std::size_t>(columns);
    info.rows = static_cast<std::size_t>(rows);
    if (Status size = checkMapSize(info.columns, info.rows); !size) {
        return refuse(size.error().code, size.error().message);
    }
    const std::optional<SampleType> type = sampleTypeOf(*impl->band);
    if (!type) {
        return refuse(ErrorCode::Unsupported,
                      fmt::format("holds {} samples, but elevations are real numbers",
                                  GDALGetDataTypeName(impl->band->GetRasterDataType())));
    }
    info.type = *type;
    if (isPicture(dataset, *impl->band)) {
        return refuse(ErrorCode::Unsupported, refusalOfPicture(dataset, band));
    }
    if (info.band_count > 1) {
        info.notices.push_back(fmt::format("band {} of {} is read", band, info.band_count));
    }
    impl->has_plain_strips = !impl->remote && hasLargePlainStrips(dataset);
    if (!impl->remote && !impl->has_plain_strips) {
        impl->strips = largeStripsOf(*impl->band, info);
        if (auto notice = noticeOfLargeBlock(*impl->band)) {
            info.notices.push_back(*std::move(notice));
        }
    }
    const GdalMessages messages;
    std::optional<CPLConfigOptionSetter> no_listing; // of the folder at the server
    if (impl->remote) {
        no_listing.emplace("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false);
    }
    const std::string label_path = labelPathOf(dataset, info, opened->label);
    const std::shared_ptr<GDALDataset> label_placement = placementOf(dataset, info, label_path);
    GDALDataset& placed = label_placement ? *label_placement : dataset;
    const nlohmann::json pds3 = jsonDomain(placed, "json:PDS");
    impl->netcdf = netcdfExtentOf(dataset, info.driver);
    readNodata(*impl->band, info);
    readPlacement(placed, pds3, info);
    if (info.driver == "PDS" && label_placement) {
        if (std::string notice = noticeOfRadii(dataset, placed, label_path); !notice.empty()) {
            info.notices.push_back(std::move(notice));
        }
    }
    if (!info.crs) {
        info.axis_hints = axisHintsOf(dataset, path);
    }
    readVertical(dataset, *impl->band, pds3, labelElevationOf(dataset, info, label_path), info);
    if (Status complete = impl->checkExtent({0, 0, info.columns, info.rows}); !complete) {
        return std::move(complete).error();
    }
    info.typical_raw = impl->findTypicalSample();
    if (impl->strips) {
        impl->strips->rest();
    }
    deduceHeightReference(info);
    return RasterFile(std::move(impl));
}

std::vector<std::string> RasterFile::files() const
{
    if (impl_->mosaic) {
        return impl_->mosaic->files;
    }
    std::vector<std::string> files;
    const CPLStringList listed(impl_->remote ? nullptr : impl_->dataset->GetFileList());
    for (int i = 0; i < listed.Count(); ++i) {
        files.emplace_back(listed[i]);
    }
    return files;
}

Status RasterFile::checkComplete() const
{
    return impl_->checkExtent({0, 0, impl_->info.columns, impl_->info.rows});
}

// One sample that is not void, from a few rows: enough to distinguish radii from heights. Only
// called if the type can hold a radius in meters.
std::optional<double> RasterFile::Impl::findTypicalSample()
{
    const bool can_hold_radius = sampleBytes(info.type) >= 4 || info.scale != 1.0 ||
                                 info.offset != 0.0 || info.unit.meters != 1.0;
    if (!can_hold_radius || (!info.crs && remote)) {
        return std::nullopt;
    }
    if (const int overviews = band->GetOverviewCount(); remote && overviews > 0) {
        // The smallest: whole rows of a map on a server take hundreds of requests.
        GDALRasterBand& smallest = *band->GetOverview(overviews - 1);
        const auto loaded =
            readFrom(smallest,
                     {0, 0, static_cast<std::size_t>(smallest.GetXSize()),
                      std::min<std::size_t>(static_cast<std::size_t>(smallest.GetYSize()), 64)},
                     {info.nodata});
        if (loaded && loaded->statistics.hasSamples()) {
            return loaded->statistics.raw_maximum;
        }
    }
    for (const std::size_t row : {info.rows / 2, info.rows / 4, info.rows - 1 - info.rows / 4}) {
        Result<SampleGrid> grid = SampleGrid::create(info.type, info.columns, 1);
        if (!grid) {
            return std::nullopt;
        }
        const GridWindow window{0, row, info.columns, 1};
        if (!readRows(*band, *grid, window, 0)) {
            return std::nullopt; // reading the samples reports the error
        }
        grid->markValues(info.other_nodata, 0, 1);
        const SampleStatistics statistics = grid->applyRule({info.nodata}, 0, 1);
        if (statistics.hasSamples()) {
            return statistics.raw_maximum;
        }
    }
    return std::nullopt;
}

std::size_t RasterFile::Impl::rowsPerBand() const
{
    int block_columns = 0;
    int block_rows = 0;
    band->GetBlockSize(&block_columns, &block_rows);
    const std::size_t row_bytes = info.columns * sampleBytes(info.type);
    const std::size_t wanted = std::max<std::size_t>(1, kBandBytes / row_bytes);
    // Whole rows of blocks, so that no block is decoded twice.
    const std::size_t block = strips || has_plain_strips
                                  ? 1
                                  : std::max<std::size_t>(1, static_cast<std::size_t>(block_rows));
    std::size_t rows = std::max<std::size_t>(1, wanted / block) * block;
    if (rows * row_bytes > kBandBytesMax) {
        rows = std::max<std::size_t>(1, kBandBytesMax / row_bytes);
    }
    return std::min(rows, info.rows);
}

// The rows of a part add nothing to the rows of the whole.
static std::string withoutRows(const std::string& failure)
{
    constexpr std::string_view kEnd = " failed: ";
    const std::size_t begin = failure.find(": reading rows ");
    const std::size_t end = begin == std::string::npos ? begin : failure.find(kEnd, begin);
    return end == std::string::npos
               ? failure
               : failure.substr(0, begin) + ": " + failure.substr(end + kEnd.size());
}

Error RasterFile::Impl::readFailure(const GdalMessages& messages, const GridWindow& window) const
{
    is_spoilt = true;
    if (remote) {
        return remoteFailure(info.path, *remote, messages,
                             fmt::format("reading rows {} to {} failed, {}; try again", window.row,
                                         window.row + window.rows - 1, kConnectionLost));
    }
    const std::string of_part = mosaic ? withoutRows(mosaic->failureIn(window)) : std::string();
    return readFailure(
        of_part.empty() ? messages.firstFailure("the file is cut short or damaged; fetch it again")
                        : of_part,
        window);
}

// Reopens the dataset after a failed read.
Status RasterFile::Impl::renew()
{
    if (!is_spoilt) {
        return Done{};
    }
    Dataset fresh;
    if (remote) {
        Result<RemoteVersion> now = askRemote(info.path);
        if (!now) {
            return std::move(now).error();
        }
        const GdalMessages none;
        Result<Dataset> opened = *now == *remote
                                     ? openRemote(info.path, *remote)
                                     : Result<Dataset>(remoteFailure(info.path, *remote, none, ""));
        if (!opened) {
            return std::move(opened).error();
        }
        fresh = std::move(opened).value();
    } else {
        const auto open_again = [this]() -> Result<Dataset> {
            if (mosaic) {
                return openMosaic(*mosaic);
            }
            Result<OpenedDataset> opened = openLocal({info.path});
            return opened ? Result<Dataset>(std::move(opened->dataset))
                          : Result<Dataset>(std::move(opened).error());
        };
        Result<Dataset> opened = open_again();
        if (!opened) {
            const std::string& why = opened.error().message;
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: {}", info.path, why.empty() ? "is gone" : why)};
        }
        fresh = std::move(opened).value();
    }
    const int number = mosaic ? 1 : info.band;
    GDALRasterBand* const same =
        number <= fresh->GetRasterCount() ? fresh->GetRasterBand(number) : nullptr;
    if (same == nullptr || same->GetXSize() != band->GetXSize() ||
        same->GetYSize() != band->GetYSize() ||
        same->GetRasterDataType() != band->GetRasterDataType() ||
        same->GetOverviewCount() != band->GetOverviewCount()) {
        if (remote && remote->isNamed()) { // and the version is unchanged: the response was
                                           // truncated
            const GdalMessages none;
            return remoteFailure(info.path, *remote, none,
                                 fmt::format("{}; try again", kConnectionLost));
        }
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: has changed since it was opened; open it again",
                                 addressOf(info.path))};
    }
    dataset = std::move(fresh);
    band = same;
    is_spoilt = false;
    return Done{};
}

Error RasterFile::Impl::readFailure(const std::string& why, const GridWindow& window) const
{
    return Error{ErrorCode::Unreadable,
                 fmt::format("{}: reading rows {} to {} failed: {}", addressOf(info.path),
                             window.row, window.row + window.rows - 1, why)};
}

// GDAL reads zeros beyond the end of raw data, in some of its code paths silently.
Status RasterFile::Impl::checkExtent(const GridWindow& window) const
{
    const auto cut_short = [&](std::int64_t present, std::int64_t promised) {
        return readFailure(fmt::format("it is cut short, {} of the {} bytes that its header "
                                       "promises are present; fetch it again",
                                       present, promised),
                           window);
    };
    VSIStatBufL status{};
    if (netcdf && VSIStatL(netcdf->path.c_str(), &status) == 0 &&
        static_cast<std::int64_t>(status.st_size) < netcdf->bytes) {
        return cut_short(static_cast<std::int64_t>(status.st_size), netcdf->bytes);
    }
    GDALDataset::RawBinaryLayout layout;
    // A TIFF without bytes for its first block is sparse: it need not be as long as its samples.
    const bool is_sparse =
        info.driver == "GTiff" && band->GetMetadataItem("BLOCK_OFFSET_0_0", "TIFF") == nullptr;
    if (is_sparse || !dataset->GetRawBinaryLayout(layout) ||
        VSIStatL(layout.osRawFilename.c_str(), &status) != 0) {
        return Done{};
    }
    const auto end_of_row = [&](std::size_t row) {
        return static_cast<std::int64_t>(layout.nImageOffset) +
               static_cast<std::int64_t>(layout.nBandOffset) * (info.band - 1) +
               static_cast<std::int64_t>(layout.nLineOffset) * static_cast<std::int64_t>(row) +
               static_cast<std::int64_t>(layout.nPixelOffset) *
                   static_cast<std::int64_t>(info.columns - 1) +
               static_cast<std::int64_t>(sampleBytes(info.type));
    };
    const auto bytes = static_cast<std::int64_t>(status.st_size);
    if (std::max(end_of_row(window.row), end_of_row(window.row + window.rows - 1)) > bytes) {
        return cut_short(bytes, std::max(end_of_row(0), end_of_row(info.rows - 1)));
    }
    return Done{};
}

Status RasterFile::Impl::readRows(GDALRasterBand& from,
                                  SampleGrid& grid,
                                  const GridWindow& window,
                                  std::size_t grid_row) const
{
    if (&from == band) {
        if (Status complete = checkExtent(window); !complete) {
            return complete;
        }
    }
    if (strips && &from == band && window.columns == info.columns) {
        const Status read = strips->read(window.row, window.rows, grid.rowData(grid_row));
        return read ? read : readFailure(read.error().message, window);
    }
    const GdalMessages messages;
    const QuietOutput quiet(prints);
    const CPLErr outcome =
        from.RasterIO(GF_Read, static_cast<int>(window.column), static_cast<int>(window.row),
                      static_cast<int>(window.columns), static_cast<int>(window.rows),
                      grid.rowData(grid_row), static_cast<int>(window.columns),
                      static_cast<int>(window.rows), band->GetRasterDataType(), 0, 0, nullptr);
    if (outcome != CE_None || messages.hasFailed()) {
        return readFailure(messages, window);
    }
    return Done{};
}

Status RasterFile::Impl::markMasked(GDALRasterBand& from,
                                    SampleGrid& grid,
                                    const GridWindow& window,
                                    std::size_t grid_row) const
{
    grid.markValues(info.other_nodata, grid_row, window.rows);
    if (!info.has_mask_band) {
        return Done{};
    }
    const GdalMessages messages;
    std::vector<std::uint8_t> mask(window.columns * window.rows);
    const CPLErr outcome = from.GetMaskBand()->RasterIO(
        GF_Read, static_cast<int>(window.column), static_cast<int>(window.row),
        static_cast<int>(window.columns), static_cast<int>(window.rows), mask.data(),
        static_cast<int>(window.columns), static_cast<int>(window.rows), GDT_Byte, 0, 0, nullptr);
    if (outcome != CE_None || messages.hasFailed()) {
        return readFailure(messages, window);
    }
    for (std::size_t r = 0; r < window.rows; ++r) {
        for (std::size_t c = 0; c < window.columns; ++c) {
            if (mask[r * window.columns + c] == 0) {
                grid.markVoid(c, grid_row + r);
            }
        }
    }
    return Done{};
}

Result<LoadedSamples> RasterFile::readWindow(const GridWindow& window, const VoidRule& voids)
{
    if (Status renewed = impl_->renew(); !renewed) {
        return std::move(renewed).error();
    }
    return impl_->readFrom(*impl_->band, window, voids);
}

Result<LoadedSamples> RasterFile::Impl::readFrom(GDALRasterBand& from,
                                                 const GridWindow& window,
                                                 const VoidRule& voids) const
{
    MARSVIEW_CHECK(window.column + window.columns <= static_cast<std::size_t>(from.GetXSize()));
    MARSVIEW_CHECK(window.row + window.rows <= static_cast<std::size_t>(from.GetYSize()));
    Result<SampleGrid> grid = SampleGrid::create(info.type, window.columns, window.rows);
    if (!grid) {
        return std::move(grid).error();
    }
    std::optional<ExactRanges> exact_ranges;
    if (remote) {
        exact_ranges.emplace();
    }
    if (Status read = readRows(from, *grid, window, 0); !read) {
        return std::move(read).error();
    }
    if (Status masked = markMasked(from, *grid, window, 0); !masked) {
        return std::move(masked).error();
    }
    const SampleStatistics statistics = grid->applyRule(voids, 0, window.rows);
    return LoadedSamples{std::move(*grid), statistics};
}

std::size_t RasterFile::overviewCount() const noexcept
{
    return static_cast<std::size_t>(std::max(0, impl_->band->GetOverviewCount()));
}

GridSize RasterFile::overviewSize(std::size_t overview) const
{
    MARSVIEW_CHECK(overview < overviewCount());
    GDALRasterBand& band = *impl_->band->GetOverview(static_cast<int>(overview));
    return {static_cast<std::size_t>(band.GetXSize()), static_cast<std::size_t>(band.GetYSize())};
}

Result<LoadedSamples>
RasterFile::readOverview(std::size_t overview, const GridWindow& window, const VoidRule& voids)
{
    MARSVIEW_CHECK(overview < overviewCount());
    if (Status renewed = impl_->renew(); !renewed) {
        return std::move(renewed).error();
    }
    return impl_->readFrom(*impl_->band->GetOverview(static_cast<int>(overview)), window, voids);
}

GridSize RasterFile::blockSize() const
{
    int columns = 0;
    int rows = 0;
    impl_->band->GetBlockSize(&columns, &rows);
    return {static_cast<std::size_t>(columns),
            impl_->has_plain_strips ? 1 : static_cast<std::size_t>(rows)};
}

bool RasterFile::hasCheapRows() const noexcept
{
    return impl_->strips || impl_->has_plain_strips;
}

Result<LoadedSamples>
RasterFile::readAll(JobMonitor& monitor, const VoidRule& voids, std::size_t memory_bytes_max)
{
    const RasterInfo& info = impl_->info;
    const std::size_t bytes = info.columns * info.rows * sampleBytes(info.type);
    if (Status renewed = impl_->renew(); !renewed) {
        return std::move(renewed).error();
    }
    if (bytes > memory_bytes_max) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{}: {} × {} samples take {:.1f} GB, more than the {:.1f} GB that "
                                 "one map may use",
                                 addressOf(info.path), info.columns, info.rows,
                                 static_cast<double>(bytes) / 1e9,
                                 static_cast<double>(memory_bytes_max) / 1e9)};
    }
    Result<SampleGrid> grid = SampleGrid::create(info.type, info.columns, info.rows);
    if (!grid) {
        return Error{grid.error().code,
                     fmt::format("{}: {}", addressOf(info.path), grid.error().message)};
    }
    SampleStatistics statistics;
    const std::size_t step = impl_->rowsPerBand();
    for (std::size_t row = 0; row < info.rows; row += step) {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled,
                         fmt::format("{}: reading was canceled", addressOf(info.path))};
        }
        const GridWindow window{0, row, info.columns, std::min(step, info.rows - row)};
        if (Status read = impl_->readRows(*impl_->band, *grid, window, row); !read) {
            return std::move(read).error();
        }
        if (Status masked = impl_->markMasked(*impl_->band, *grid, window, row); !masked) {
            return std::move(masked).error();
        }
        statistics.merge(grid->applyRule(voids, row, window.rows));
        monitor.report(static_cast<double>(row + window.rows) / static_cast<double>(info.rows));
    }
    return LoadedSamples{std::move(*grid), statistics};
}

// Whole blocks, about kBandBytes of them, so that none is decoded twice.
Result<GridSize> RasterFile::Impl::scanStep() const
{
    int block_columns = 0;
    int block_rows = 0;
    band->GetBlockSize(&block_columns, &block_rows);
    const std::size_t sample_bytes = sampleBytes(info.type);
    if (strips || has_plain_strips) {
        // Each read restarts at one of some hundred seek points in an archive.
        const std::size_t bytes = info.path.starts_with("/vsi") ? kBandBytesMax : kBandBytes;
        const std::size_t row_bytes = info.columns * sample_bytes;
        return GridSize{info.columns, std::clamp<std::size_t>(bytes / row_bytes, 1, info.rows)};
    }
    const auto columns = static_cast<std::size_t>(std::max(1, block_columns));
    const auto rows = static_cast<std::size_t>(std::max(1, block_rows));
    const std::size_t block_bytes = columns * rows * sample_bytes;
    if (block_bytes > kScannedBlockBytesMax) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{}: is stored in blocks of {} × {} samples, {:.1f} GB each; "
                                 "gdal_translate -co TILED=YES makes a file whose statistics can "
                                 "be computed in little memory",
                                 addressOf(info.path), columns, rows,
                                 static_cast<double>(block_bytes) / 1e9)};
    }
    const std::size_t across = std::max<std::size_t>(1, kBandBytes / block_bytes);
    const std::size_t step_columns = std::min(info.columns, across * columns);
    const std::size_t down =
        std::max<std::size_t>(1, kBandBytes / (step_columns * rows * sample_bytes));
    return GridSize{step_columns, std::min(info.rows, down * rows)};
}

// Whether a file has bytes for any sample of a window: sparse files leave out blocks, of which all
// samples are alike.
bool RasterFile::Impl::isStored(const GridWindow& window) const
{
    if (info.has_mask_band || remote) {
        return true;
    }
    const GdalMessages ignored;
    const int status =
        band->GetDataCoverageStatus(static_cast<int>(window.column), static_cast<int>(window.row),
                                    static_cast<int>(window.columns), static_cast<int>(window.rows),
                                    GDAL_DATA_COVERAGE_STATUS_DATA);
    return status != GDAL_DATA_COVERAGE_STATUS_EMPTY;
}

Result<SampleStatistics> RasterFile::Impl::scanUnstored(const GridWindow& window,
                                                        const VoidRule& voids) const
{
    const Result<LoadedSamples> one = readFrom(*band, {window.column, window.row, 1, 1}, voids);
    if (!one) {
        return one.error();
    }
    SampleStatistics statistics = one->statistics;
    statistics.sample_count *= window.columns * window.rows;
    statistics.void_count *= window.columns * window.rows;
    return statistics;
}

Result<SampleStatistics> RasterFile::scan(JobMonitor& monitor, const VoidRule& voids)
{
    const RasterInfo& info = impl_->info;
    const Result<GridSize> step = impl_->scanStep();
    if (!step) {
        return step.error();
    }
    SampleStatistics statistics;
    for (std::size_t row = 0; row < info.rows; row += step->rows) {
        const std::size_t rows = std::min(step->rows, info.rows - row);
        for (std::size_t column = 0; column < info.columns; column += step->columns) {
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled,
                             fmt::format("{}: reading was canceled", addressOf(info.path))};
            }
            const GridWindow window{column, row, std::min(step->columns, info.columns - column),
                                    rows};
            if (!impl_->is_spoilt && !impl_->isStored(window)) {
                const Result<SampleStatistics> part = impl_->scanUnstored(window, voids);
                if (!part) {
                    return part.error();
                }
                statistics.merge(*part);
                continue;
            }
            Result<LoadedSamples> loaded = readWindow(window, voids);
            if (!loaded) {
                return std::move(loaded).error();
            }
            statistics.merge(loaded->statistics);
        }
        monitor.report(static_cast<double>(row + rows) / static_cast<double>(info.rows));
    }
    return statistics;
}

std::size_t defaultMemoryBudget()
{
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_bytes = sysconf(_SC_PAGE_SIZE);
    if (pages <= 0 || page_bytes <= 0) {
        return std::size_t{2} << 30;
    }
    return static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(page_bytes);
}

void allowLargeBlockCache()
{
    ensureGdal();
    if (!hasUserOption("GDAL_CACHEMAX")) {
        GDALSetCacheMax64(CPLGetUsablePhysicalRAM() / 20);
    }
}

} // namespace marsview
