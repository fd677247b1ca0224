#include "core/raster/raster_file.h"

#include "core/files/archive_rasters.h"
#include "core/files/gdal_runtime.h"
#include "core/files/open_guard.h"
#include "core/files/opening_job.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/raster/dataset_description.h"
#include "core/raster/dataset_opening.h"
#include "core/raster/gdal_types.h"
#include "core/raster/large_blocks.h"
#include "core/raster/mosaic.h"
#include "core/raster/promised_extent.h"

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

// GDAL applies the scale of a FITS file as it reads, to samples of the stored type.
bool cutsScaledSamples(GDALRasterBand& band, const RasterInfo& info)
{
    const auto is_whole = [](double value) { return value == std::floor(value); };
    return info.driver == "FITS" && GDALDataTypeIsInteger(band.GetRasterDataType()) != 0 &&
           !(is_whole(band.GetScale()) && is_whole(band.GetOffset()));
}

} // namespace

struct RasterFile::Impl {
    OpenFiles open_files; // that were opened for the raster
    Dataset dataset;
    GDALRasterBand* band = nullptr;
    std::optional<PromisedExtent> promised;
    std::optional<RemoteVersion> remote;  // for a raster on a server
    std::shared_ptr<const Mosaic> mosaic; // of a folder of rasters
    RasterInfo info;
    // If present, whole rows are read through these.
    mutable std::optional<TiffStrips> strips;
    bool has_plain_strips = false; // read without caching more than requested
    // After a read that failed, GDAL 3.6 silently returns wrong samples.
    mutable bool is_unreliable = false;
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
    const KeepOpen opening;
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
        impl->open_files = opening.files();
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
        if (const std::string archive = archiveNameFor(path); !archive.empty()) {
            info.in_archive = rastersInArchive(archive);
        }
        if (info.in_archive.size() < 2) {
            info.in_archive.clear();
        }
        info.requested = path;
        std::string notice = info.in_archive.empty() ? info.replacementNotice()
                                                     : archiveNotice(info.in_archive, info.path);
        if (!notice.empty()) {
            info.notices.push_back(std::move(notice));
        }
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
    if (cutsScaledSamples(*impl->band, info)) {
        return refuse(ErrorCode::Unsupported,
                      fmt::format("has whole numbers with scale {} and offset {}, which GDAL reads "
                                  "as whole elevations; save it with floating-point samples",
                                  impl->band->GetScale(), impl->band->GetOffset()));
    }
    if (isPicture(dataset, *impl->band)) {
        return refuse(ErrorCode::Unsupported, refusalOfPicture(dataset, band));
    }
    if (std::string notice = noticeOfLikelyPicture(dataset, *impl->band); !notice.empty()) {
        info.notices.push_back(std::move(notice));
    } else if (info.band_count > 1) {
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
    impl->promised = promisedExtentOf(dataset, info);
    describe(dataset, *impl->band, {.path = path, .label = opened->label}, info);
    if (Status complete = impl->checkExtent({0, 0, info.columns, info.rows}); !complete) {
        return std::move(complete).error();
    }
    info.typical_raw = impl->findTypicalSample();
    if (impl->strips) {
        impl->strips->rest();
    }
    deduceHeightReference(info);
    RasterFile file(std::move(impl));
    if (file.info().driver == "VRT") { // which opens its parts when they are read, on any thread
        for (const std::string& part : file.files()) {
            openShared(part);
        }
    }
    file.impl_->open_files = opening.files();
    return file;
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

const OpenFiles& RasterFile::openFiles() const noexcept
{
    return impl_->open_files;
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
    is_unreliable = true;
    if (remote) {
        return remoteFailure(info.path, *remote, messages,
                             fmt::format("reading rows {} to {} failed, {}; try again", window.row,
                                         window.row + window.rows - 1, kConnectionLost));
    }
    const std::string of_part = mosaic ? withoutRows(mosaic->failureIn(window)) : std::string();
    if (!of_part.empty()) {
        return readFailure(of_part, window);
    }
    const std::string reason = messages.firstFailure("");
    return readFailure(reason.empty() ? "the file is cut short or damaged; fetch it again"
                                      : fmt::format("the file is cut short or damaged ({}); fetch "
                                                    "it again",
                                                    reason),
                       window);
}

// Reopens the dataset after a failed read.
Status RasterFile::Impl::renew()
{
    if (!is_unreliable) {
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
                                     ? openRemoteDataset(info.path, *remote)
                                     : Result<Dataset>(remoteFailure(info.path, *remote, none, ""));
        if (!opened) {
            return std::move(opened).error();
        }
        fresh = std::move(opened).value();
    } else {
        const auto open_again = [this]() -> Result<Dataset> {
            if (mosaic) {
                return openMosaicDataset(*mosaic);
            }
            Result<OpenedDataset> opened = openLocalDataset({info.path});
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
    is_unreliable = false;
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
    const auto cut_short = [&](std::int64_t present, std::int64_t wanted) {
        return readFailure(fmt::format("it is cut short, {} of the {} bytes that its header "
                                       "promises are present; fetch it again",
                                       present, wanted),
                           window);
    };
    VSIStatBufL status{};
    if (promised && VSIStatL(promised->path.c_str(), &status) == 0 &&
        static_cast<std::int64_t>(status.st_size) < promised->bytes) {
        return cut_short(static_cast<std::int64_t>(status.st_size), promised->bytes);
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
            if (!impl_->is_unreliable && !impl_->isStored(window)) {
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
