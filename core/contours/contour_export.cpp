#include "core/contours/contour_export.h"

#include "core/files/gdal_runtime.h"

#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr double kVoid = -1e38;
constexpr std::size_t kSamplesAtOnce = std::size_t{1} << 23;

// The elevations of a raster as a GDAL dataset of one band, read in order of its rows.
class ElevationDataset final : public GDALDataset {
public:
    explicit ElevationDataset(OpenRaster raster)
        : raster_(std::move(raster))
        , scale_(raster_.info.elevationScale())
    {
        nRasterXSize = static_cast<int>(raster_.info.columns);
        nRasterYSize = static_cast<int>(raster_.info.rows);
        SetBand(1, new Band(*this)); // NOLINT(cppcoreguidelines-owning-memory): GDAL's way
    }

    CPLErr GetGeoTransform(double* terms) override
    {
        const GeoTransform::Terms placement = georeferenceOf(raster_.info).transform().terms();
        std::copy(placement.begin(), placement.end(), terms);
        return CE_None;
    }
    /// Why a row could not be read.
    const std::optional<Error>& problem() const noexcept { return problem_; }

private:
    class Band final : public GDALRasterBand {
    public:
        explicit Band(ElevationDataset& owner)
            : owner_(owner)
        {
            poDS = &owner;
            nBand = 1;
            eDataType = GDT_Float64;
            nBlockXSize = owner.nRasterXSize;
            nBlockYSize = 1;
        }
        double GetNoDataValue(int* has_value) override
        {
            if (has_value != nullptr) {
                *has_value = TRUE;
            }
            return kVoid;
        }

    protected:
        CPLErr IReadBlock(int /*column*/, int row, void* samples) override
        {
            return owner_.readRow(static_cast<std::size_t>(row), static_cast<double*>(samples));
        }

    private:
        ElevationDataset& owner_;
    };

    CPLErr readRow(std::size_t row, double* elevations)
    {
        if (!rows_ || row < first_row_ || row >= first_row_ + rows_->grid.rows()) {
            const std::size_t count = std::clamp<std::size_t>(kSamplesAtOnce / raster_.info.columns,
                                                              1, raster_.info.rows - row);
            rows_.reset();
            auto read = raster_.file.readWindow(
                {.column = 0, .row = row, .columns = raster_.info.columns, .rows = count},
                raster_.voids());
            if (!read) {
                problem_ = read.error();
                CPLError(CE_Failure, CPLE_FileIO, "%s", read.error().message.c_str());
                return CE_Failure;
            }
            rows_ = std::move(*read);
            first_row_ = row;
        }
        const SampleGrid& grid = rows_->grid;
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            const double elevation_m = scale_.height(grid.raw(column, row - first_row_));
            elevations[column] =
                grid.isVoid(column, row - first_row_) || !std::isfinite(elevation_m) ? kVoid
                                                                                     : elevation_m;
        }
        return CE_None;
    }

    OpenRaster raster_;
    ElevationScale scale_;
    std::optional<LoadedSamples> rows_; // those read last
    std::size_t first_row_ = 0;
    std::optional<Error> problem_;
};

int reportProgress(double share, const char* /*message*/, void* monitor)
{
    auto& job = *static_cast<JobMonitor*>(monitor);
    job.report(share);
    return job.isCanceled() ? FALSE : TRUE;
}

// The files of an unfinished export.
class StagedFile {
public:
    explicit StagedFile(const fs::path& path)
        : path_(path)
        , staged_(path.parent_path() /
                  ("." + path.stem().string() + ".part" + path.extension().string()))
    {
        remove();
    }
    ~StagedFile() { remove(); }
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    const fs::path& path() const noexcept { return staged_; }
    bool publish() const
    {
        std::error_code failure;
        for (const char* ending : {".shx", ".dbf", ".prj", ".cpg"}) {
            if (fs::exists(fs::path(staged_).replace_extension(ending), failure)) {
                fs::rename(fs::path(staged_).replace_extension(ending),
                           fs::path(path_).replace_extension(ending), failure);
            }
        }
        fs::rename(staged_, path_, failure);
        return !failure;
    }

private:
    void remove() const
    {
        std::error_code failure;
        for (const char* ending :
             {".shx", ".dbf", ".prj", ".cpg", ".gpkg-journal", ".gpkg", ".shp"}) {
            fs::remove(fs::path(staged_).replace_extension(ending), failure);
        }
    }

    fs::path path_;
    fs::path staged_;
};

} // namespace

Result<ContourReport> exportContours(const ContourJob& job, JobMonitor& monitor)
{
    const auto fault = [&job](ErrorCode code, const std::string& why) {
        return Error{code, job.path + ": " + why};
    };
    const std::string ending = fs::path(job.path).extension().string();
    const char* const driver_name = ending == ".gpkg"  ? "GPKG"
                                    : ending == ".shp" ? "ESRI Shapefile"
                                                       : nullptr;
    if (driver_name == nullptr) {
        return fault(ErrorCode::Unsupported,
                     "contours are written as a GeoPackage (.gpkg) or Shapefile (.shp)");
    }
    if (!(job.interval_m > 0.0) || !std::isfinite(job.interval_m)) {
        return fault(ErrorCode::OutOfRange, "the contour interval must be greater than 0 m");
    }
    Result<OpenRaster> raster = openRaster(job.raster);
    if (!raster) {
        return std::move(raster).error();
    }
    ensureGdal();
    const GdalMessages messages;
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driver_name);
    if (driver == nullptr) {
        return fault(ErrorCode::Unsupported,
                     fmt::format("this GDAL has no driver for {}", driver_name));
    }
    const std::optional<Crs> crs = raster->info.crs;
    const StagedFile staged(job.path);
    ContourReport report;
    {
        const GDALDatasetUniquePtr target(
            driver->Create(staged.path().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
        if (!target) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        OGRSpatialReference reference;
        if (crs) {
            reference.SetFromUserInput(crs->wkt().c_str());
            reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        }
        OGRLayer* const layer =
            target->CreateLayer("contours", crs ? &reference : nullptr, wkbLineString, nullptr);
        OGRFieldDefn id("id", OFTInteger64);
        OGRFieldDefn elevation("elevation", OFTReal);
        if (layer == nullptr || layer->CreateField(&id) != OGRERR_NONE ||
            layer->CreateField(&elevation) != OGRERR_NONE) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        ElevationDataset source(std::move(*raster));
        CPLStringList options;
        options.SetNameValue("LEVEL_INTERVAL", fmt::format("{}", job.interval_m).c_str());
        options.SetNameValue("LEVEL_BASE", fmt::format("{}", job.base_m).c_str());
        options.SetNameValue("NODATA", fmt::format("{}", kVoid).c_str());
        options.SetNameValue("ID_FIELD", "0");
        options.SetNameValue("ELEV_FIELD", "1");
        const bool has_transaction = target->StartTransaction() == OGRERR_NONE;
        const CPLErr outcome = GDALContourGenerateEx(
            GDALRasterBand::ToHandle(source.GetRasterBand(1)), OGRLayer::ToHandle(layer),
            options.List(), &reportProgress, &monitor);
        if (monitor.isCanceled()) {
            return fault(ErrorCode::Canceled, "exporting contours was canceled");
        }
        if (source.problem()) {
            return *source.problem();
        }
        if (outcome != CE_None || (has_transaction && target->CommitTransaction() != OGRERR_NONE)) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        report.lines = static_cast<std::size_t>(layer->GetFeatureCount());
    }
    if (messages.hasFailed() || !staged.publish()) {
        return fault(ErrorCode::Unreadable,
                     "cannot be written: " + messages.firstFailure("the folder is not writable"));
    }
    return report;
}

} // namespace marsview
