#include "core/prepare/geotiff_skeleton.h"

#include "core/base/check.h"
#include "core/files/exact_crs.h"
#include "core/files/gdal_runtime.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/tiff/tiff_tiles.h"
#include "core/raster/gdal_types.h"
#include "core/tiles/tile.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr const char* kKey = "MADE_FROM";
constexpr const char* kSource = "SOURCE";

// Older readers do not support differencing of 64-bit integers.
const char* predictorFor(SampleType type)
{
    return dispatchSampleType(type, [](auto zero) {
        using T = decltype(zero);
        return std::is_floating_point_v<T> ? "3" : sizeof(T) == 8 ? "1" : "2";
    });
}

// GDAL options set for this thread during the object's lifetime.
class ThreadOption {
public:
    ThreadOption(const char* name, const char* value)
        : name_(name)
    {
        CPLSetThreadLocalConfigOption(name, value);
    }
    ~ThreadOption() { CPLSetThreadLocalConfigOption(name_, nullptr); }
    ThreadOption(const ThreadOption&) = delete;
    ThreadOption& operator=(const ThreadOption&) = delete;

private:
    const char* name_;
};

// GDAL 3.6 fails to create overviews of 64-bit integers with nodata ("Sanity check on tag count
// failed"); it succeeds if nodata is set afterwards.
bool isWide(SampleType type)
{
    return type == SampleType::Int64 || type == SampleType::UInt64;
}

CPLErr setNodata(GDALRasterBand& band, SampleType type, double nodata)
{
    constexpr double kTwoTo63 = 9223372036854775808.0;
    if (type == SampleType::Int64 && std::abs(nodata) < kTwoTo63) {
        return band.SetNoDataValueAsInt64(static_cast<std::int64_t>(nodata));
    }
    if (type == SampleType::UInt64 && nodata >= 0.0 && nodata < 2.0 * kTwoTo63) {
        return band.SetNoDataValueAsUInt64(static_cast<std::uint64_t>(nodata));
    }
    // 64-bit samples cannot have any other value.
    return isWide(type) ? CE_None : band.SetNoDataValue(nodata);
}

bool describe(GDALDataset& dataset, const RasterInfo& info, const GeoTiffOrigin& origin)
{
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    bool is_written = true;
    const auto expect = [&is_written](CPLErr outcome) { is_written &= outcome == CE_None; };
    if (info.transform) {
        GeoTransform::Terms terms = info.transform->terms();
        expect(dataset.SetGeoTransform(terms.data()));
    }
    if (info.crs) {
        OGRSpatialReference reference;
        reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        is_written &= reference.importFromWkt(info.crs->wkt().c_str()) == OGRERR_NONE;
        expect(dataset.SetSpatialRef(&reference));
    }
    // The transform places pixel corners, as in GDAL, whatever the convention of the source.
    expect(dataset.SetMetadataItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA));
    if (info.nodata && !isWide(info.type)) {
        expect(setNodata(band, info.type, *info.nodata));
    }
    if (info.scale != 1.0) {
        expect(band.SetScale(info.scale));
    }
    if (info.offset != 0.0) {
        expect(band.SetOffset(info.offset));
    }
    if (info.is_unit_declared) {
        expect(band.SetUnitType(info.unit.name.c_str()));
    }
    if (!info.vertical_datum.empty() && !info.reference_radius_m) {
        expect(dataset.SetMetadataItem("VERTICAL_DATUM", info.vertical_datum.c_str()));
    }
    expect(dataset.SetMetadataItem(kKey, origin.key.c_str(), kOwnMetadataDomain));
    expect(dataset.SetMetadataItem(kSource, origin.source.c_str(), kOwnMetadataDomain));
    return is_written;
}

} // namespace

Status
writeGeoTiffSkeleton(const std::string& path, const RasterInfo& info, const GeoTiffOrigin& origin)
{
    ensureGdal();
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    const GdalMessages messages;
    const auto refusal = [&] {
        return writeError(
            path, errno == ENOSPC ? ENOSPC : 0,
            fmt::format("cannot be laid out ({})", messages.firstFailure("unknown reason")));
    };
    errno = 0;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (driver == nullptr) {
        return refusal();
    }
    const std::string tile_side = fmt::format("{}", kTileSide);
    CPLStringList options;
    options.SetNameValue("BIGTIFF", "YES");
    options.SetNameValue("TILED", "YES");
    options.SetNameValue("BLOCKXSIZE", tile_side.c_str());
    options.SetNameValue("BLOCKYSIZE", tile_side.c_str());
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", predictorFor(info.type));
    options.SetNameValue("SPARSE_OK", "TRUE");
    if (info.type == SampleType::Int8) {
        options.SetNameValue("PIXELTYPE", "SIGNEDBYTE");
    }
    const ThreadOption inner_mask("GDAL_TIFF_INTERNAL_MASK", "YES");
    const ThreadOption overview_predictor("PREDICTOR_OVERVIEW", predictorFor(info.type));
    const ThreadOption overview_compression("COMPRESS_OVERVIEW", "DEFLATE");
    const ThreadOption overview_tiles("GDAL_TIFF_OVR_BLOCKSIZE", tile_side.c_str());
    const ThreadOption sparse_overviews("SPARSE_OK_OVERVIEW", "TRUE");
    std::vector<int> factors(overviewCount(info.columns, info.rows));
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] = 2 << i;
    }
    GDALDatasetUniquePtr dataset(driver->Create(path.c_str(), static_cast<int>(info.columns),
                                                static_cast<int>(info.rows), 1,
                                                gdalTypeOf(info.type), options.List()));
    if (!dataset || !describe(*dataset, info, origin) ||
        (info.needsVoidMask() && dataset->CreateMaskBand(GMF_PER_DATASET) != CE_None)) {
        return refusal();
    }
    // After reopening, GDAL reads the CRS as other programs will.
    const auto reopen = [&path, &dataset] {
        CPLStringList open_options;
        open_options.SetNameValue("SPARSE_OK", "TRUE");
        dataset.reset(); // first: closing writes the file
        dataset.reset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE, nullptr,
                                        open_options.List()));
        return dataset != nullptr;
    };
    if (!reopen() || !keepExactCrs(*dataset, info.crs) ||
        (!factors.empty() &&
         dataset->BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0,
                                 nullptr, GDALDummyProgress, nullptr) != CE_None)) {
        return refusal();
    }
    if (info.nodata && isWide(info.type) &&
        (!reopen() || setNodata(*dataset->GetRasterBand(1), info.type, *info.nodata) != CE_None)) {
        return refusal();
    }
    dataset.reset();
    if (messages.hasFailed()) {
        return refusal();
    }
    return Done{};
}

GeoTiffOrigin readGeoTiffOrigin(const std::string& path)
{
    ensureGdal();
    const GdalMessages messages;
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    const auto item = [&dataset](const char* name) {
        const char* text = dataset ? dataset->GetMetadataItem(name, kOwnMetadataDomain) : nullptr;
        return std::string(text != nullptr ? text : "");
    };
    return {item(kKey), item(kSource)};
}

} // namespace marsview
