#include "app/bench/reference/computed_raster.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/files/gdal_runtime.h"
#include "core/tiles/tile.h"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <future>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Reserve for the file's directory and for writes of other programs.
constexpr std::uintmax_t kSpareBytes = std::uintmax_t{64} << 20;

// A band of whole rows of tiles. In tiled form, each tile is one block of kTileSide² samples,
// padded with zeros, as the file requires; in strip form, the rows are contiguous.
struct Band {
    std::size_t row = 0;
    std::size_t rows = 0;
    std::vector<std::int16_t> samples;
};

class Writer {
public:
    Writer(const ComputedRaster& raster, const SampleComputer& compute, JobMonitor& monitor)
        : raster_(raster)
        , compute_(compute)
        , monitor_(monitor)
        , unfinished_(raster.path + ".part")
        , tile_columns_((raster.columns + kTileSide - 1) / kTileSide)
    {}

    Status write()
    {
        constexpr std::size_t kSideMax = std::numeric_limits<int>::max();
        MARSVIEW_CHECK(raster_.columns >= 1 && raster_.rows >= 1);
        MARSVIEW_CHECK(raster_.columns <= kSideMax && raster_.rows <= kSideMax);
        ensureGdal();
        if (Status room = checkRoom(); !room) {
            return room;
        }
        Status status = writeAll();
        std::error_code error;
        if (status) {
            std::filesystem::rename(unfinished_, raster_.path, error);
            if (!error) {
                return status;
            }
            status = refusal(error.message());
        }
        std::filesystem::remove(unfinished_, error);
        return status;
    }

private:
    Error refusal(const std::string& reason) const
    {
        return {ErrorCode::Unreadable,
                fmt::format("{}: the map cannot be written ({}); choose another folder",
                            raster_.path, reason)};
    }

    Status checkRoom() const
    {
        std::error_code error;
        std::filesystem::path folder = std::filesystem::path(raster_.path).parent_path();
        if (folder.empty()) {
            folder = ".";
        }
        const std::filesystem::space_info space = std::filesystem::space(folder, error);
        if (error) {
            return refusal(error.message());
        }
        // The compressed size is known only after writing.
        const std::uintmax_t needed =
            raster_.compression == RasterCompression::None
                ? std::uintmax_t{2} * raster_.columns * raster_.rows + kSpareBytes
                : kSpareBytes;
        if (space.available < needed) {
            return Error{ErrorCode::TooLarge,
                         fmt::format("{}: the map takes {} MB, and the disk has room for {} MB; "
                                     "choose another folder",
                                     raster_.path, needed / 1'000'000,
                                     space.available / 1'000'000)};
        }
        return Done{};
    }

    GDALDatasetUniquePtr create() const
    {
        GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        if (driver == nullptr) {
            return nullptr;
        }
        CPLStringList options;
        const std::string side = std::to_string(kTileSide);
        if (raster_.blocks == RasterBlocks::Tiles) {
            options.SetNameValue("TILED", "YES");
            options.SetNameValue("BLOCKXSIZE", side.c_str());
            options.SetNameValue("BLOCKYSIZE", side.c_str());
        } else {
            options.SetNameValue("BLOCKYSIZE", "1");
        }
        if (raster_.compression == RasterCompression::Deflate) {
            options.SetNameValue("COMPRESS", "DEFLATE");
            options.SetNameValue("PREDICTOR", "2");
            options.SetNameValue("NUM_THREADS", "ALL_CPUS");
        }
        options.SetNameValue("BIGTIFF", "YES");
        GDALDatasetUniquePtr dataset(
            driver->Create(unfinished_.c_str(), static_cast<int>(raster_.columns),
                           static_cast<int>(raster_.rows), 1, GDT_Int16, options.List()));
        if (!dataset) {
            return nullptr;
        }
        if (raster_.transform) {
            GeoTransform::Terms terms = raster_.transform->terms();
            dataset->SetGeoTransform(terms.data());
        }
        if (raster_.crs) {
            OGRSpatialReference reference;
            if (reference.importFromWkt(raster_.crs->wkt().c_str()) == OGRERR_NONE) {
                reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
                dataset->SetSpatialRef(&reference);
            }
        }
        dataset->GetRasterBand(1)->SetUnitType("m");
        if (!raster_.vertical_datum.empty()) {
            dataset->SetMetadataItem("VERTICAL_DATUM", raster_.vertical_datum.c_str());
        }
        return dataset;
    }

    void compute(Band& band) const
    {
        const bool is_tiled = raster_.blocks == RasterBlocks::Tiles;
        band.samples.resize(is_tiled ? tile_columns_ * kTileSide * kTileSide
                                     : raster_.columns * band.rows);
        parallelRanges(tile_columns_, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t tile = begin; tile < end && !monitor_.isCanceled(); ++tile) {
                const std::size_t column = tile * kTileSide;
                const std::size_t columns = std::min(kTileSide, raster_.columns - column);
                if (!is_tiled) {
                    compute_(column, band.row,
                             GridView<std::int16_t>(band.samples.data() + column, columns,
                                                    band.rows, raster_.columns));
                    continue;
                }
                std::int16_t* samples = band.samples.data() + tile * kTileSide * kTileSide;
                if (columns < kTileSide || band.rows < kTileSide) {
                    std::fill_n(samples, kTileSide * kTileSide, std::int16_t{0});
                }
                compute_(column, band.row,
                         GridView<std::int16_t>(samples, columns, band.rows, kTileSide));
            }
        });
    }

    Status put(GDALDataset& dataset, Band& band) const
    {
        const GdalMessages messages; // of the thread that this runs on
        GDALRasterBand* raster = dataset.GetRasterBand(1);
        bool is_written = true;
        if (raster_.blocks == RasterBlocks::Tiles) {
            for (std::size_t tile = 0; tile < tile_columns_ && is_written; ++tile) {
                is_written = raster->WriteBlock(
                                 static_cast<int>(tile), static_cast<int>(band.row / kTileSide),
                                 band.samples.data() + tile * kTileSide * kTileSide) == CE_None;
            }
        } else {
            for (std::size_t r = 0; r < band.rows && is_written; ++r) {
                is_written =
                    raster->WriteBlock(0, static_cast<int>(band.row + r),
                                       band.samples.data() + r * raster_.columns) == CE_None;
            }
        }
        // GDAL's compression threads may report errors only as messages.
        if (!is_written || messages.hasFailed()) {
            return refusal(messages.firstFailure("unknown reason"));
        }
        return Done{};
    }

    Status writeAll()
    {
        const GdalMessages messages;
        GDALDatasetUniquePtr dataset = create();
        if (!dataset || messages.hasFailed()) {
            return refusal(messages.firstFailure("unknown reason"));
        }
        Band computed;
        Band written;
        std::future<Status> writing;
        Status status = Done{};
        for (std::size_t row = 0; row < raster_.rows && status; row += kTileSide) {
            computed.row = row;
            computed.rows = std::min(kTileSide, raster_.rows - row);
            compute(computed);
            if (writing.valid()) {
                status = writing.get();
            }
            if (monitor_.isCanceled()) {
                return Error{ErrorCode::Canceled,
                             fmt::format("{}: writing was canceled", raster_.path)};
            }
            if (status) {
                std::swap(computed, written);
                writing = std::async(std::launch::async,
                                     [this, &dataset, &written] { return put(*dataset, written); });
                monitor_.report(static_cast<double>(row) / static_cast<double>(raster_.rows));
            }
        }
        if (writing.valid()) {
            status = writing.get();
        }
        if (!status) {
            return status;
        }
        dataset->FlushCache(true);
        dataset.reset(); // writes the directory
        if (messages.hasFailed()) {
            return refusal(messages.firstFailure("unknown reason"));
        }
        monitor_.report(1.0);
        return Done{};
    }

    const ComputedRaster& raster_;
    const SampleComputer& compute_;
    JobMonitor& monitor_;
    std::string unfinished_;
    std::size_t tile_columns_;
};

} // namespace

Status writeComputedRaster(const ComputedRaster& raster,
                           const SampleComputer& compute,
                           JobMonitor& monitor)
{
    return Writer(raster, compute, monitor).write();
}

} // namespace marsview
