#include "core/prepare/tiled_geotiff.h"

#include "core/base/check.h"
#include "core/base/file_lock.h"
#include "core/base/parallel.h"
#include "core/prepare/checkpoints.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/tiff_tiles.h"
#include "core/prepare/tile_encoding.h"
#include "core/raster/raster_file.h"
#include "core/raster/source_identity.h"
#include "core/raster/source_stamp.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <future>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// The total size of the rows that are being read while earlier ones are written.
constexpr std::size_t kWindowBytes = std::size_t{230} << 20;
// A row of blocks taller than a tile is read at once up to this size.
constexpr std::size_t kTallBlockBytesMax = std::size_t{16} << 20;

// At these rows of tiles, finer levels are in the file and coarser ones in the checkpoint: 3 % of
// a row of tiles in total.
constexpr std::size_t kTileRowsPerCheckpoint = 8;

// Upper bound even for noise; overviews add a third.
constexpr double kBytesPerRawByte = 1.34;

constexpr const char* kFormVersion = "tiled GeoTIFF 1";

std::string checkpointOf(const std::string& path)
{
    return path + ".part.checkpoint";
}

std::size_t tilesAlong(std::size_t samples)
{
    return (samples + kTileSide - 1) / kTileSide;
}

// Identifies a preparation. The location of the source is not part of it.
std::string keyOf(const RasterInfo& info, const SourceIdentity& source)
{
    const auto terms = info.transform ? info.transform->terms() : GeoTransform::Terms{};
    return fmt::format(
        "{}; source {} {} {}; band {}; {} x {} {}; nodata {}; mask {}; scale {} {}; "
        "unit {} {}; datum {}; radius {}; transform {} {}; CRS {}",
        kFormVersion, source.digest, source.bytes, source.modified_s, info.band, info.columns,
        info.rows, sampleTypeName(info.type),
        info.nodata ? fmt::format("{}", *info.nodata) : "none",
        info.has_mask_band ? "true" : fmt::format("{}", fmt::join(info.other_nodata, " ")),
        info.scale, info.offset, info.is_unit_declared, info.unit.name, info.vertical_datum,
        info.reference_radius_m.has_value(), info.transform.has_value(), fmt::join(terms, " "),
        info.crs ? info.crs->wkt() : "none");
}

// Rows to read at once: whole rows of tiles and, if they fit, whole rows of the source's blocks.
struct Windows {
    std::size_t rows = kTileSide;
    bool reads_ahead = true;
};

Windows windowsFor(const RasterFile& source, const RasterInfo& info)
{
    const std::size_t row_bytes =
        info.columns * (sampleBytes(info.type) + (info.needsVoidMask() ? 1 : 0));
    const std::size_t block_rows =
        source.hasCheapRows()
            ? kTileSide
            : (std::max<std::size_t>(source.blockSize().rows, 1) + kTileSide - 1) / kTileSide *
                  kTileSide;
    Windows windows;
    windows.rows = std::max(kTileSide, kTallBlockBytesMax / row_bytes / kTileSide * kTileSide);
    if (block_rows > windows.rows) {
        windows.rows = std::min(
            block_rows, std::max(kTileSide, kWindowBytes / row_bytes / kTileSide * kTileSide));
    } else {
        windows.rows = windows.rows / block_rows * block_rows;
    }
    windows.reads_ahead = 2 * windows.rows * row_bytes <= kWindowBytes || windows.rows == kTileSide;
    return windows;
}

// Copies the part of a tile within the grid and repeats the last column and row beyond.
std::vector<std::byte> tileBytes(const std::byte* rows,
                                 std::size_t columns,
                                 std::size_t row_count,
                                 std::size_t tile_column,
                                 std::size_t sample_bytes)
{
    const std::size_t width = std::min(kTileSide, columns - tile_column * kTileSide);
    const std::size_t row_bytes = kTileSide * sample_bytes;
    std::vector<std::byte> tile(kTileSide * row_bytes);
    for (std::size_t y = 0; y < kTileSide; ++y) {
        std::byte* const to = tile.data() + y * row_bytes;
        if (y >= row_count) {
            std::memcpy(to, to - row_bytes, row_bytes);
            continue;
        }
        std::memcpy(to, rows + (y * columns + tile_column * kTileSide) * sample_bytes,
                    width * sample_bytes);
        for (std::size_t x = width; x < kTileSide; ++x) {
            std::memcpy(to + x * sample_bytes, to + (width - 1) * sample_bytes, sample_bytes);
        }
    }
    return tile;
}

// A mask's tile in the file's format: one bit or byte per sample, all ones if valid.
template <typename IsValid>
std::vector<std::byte>
maskBytes(const TiffPage& page, std::size_t width, std::size_t height, IsValid&& is_valid)
{
    std::vector<std::byte> tile(kTileSide * (page.has_bits ? kTileSide / 8 : kTileSide));
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            if (!is_valid(x, y)) {
                continue;
            }
            if (page.has_bits) {
                tile[(y * kTileSide + x) / 8] |= std::byte{0x80} >> (x % 8);
            } else {
                tile[y * kTileSide + x] = std::byte{0xFF};
            }
        }
    }
    return tile;
}

std::vector<std::byte> encodeMask(const TiffPage& page, std::vector<std::byte> tile)
{
    return encodeTile(tile, page.has_bits ? kTileSide / 8 : kTileSide, 1, page.predictor);
}

using EncodedTiles = std::vector<std::vector<std::byte>>;

// One preparation, from its skeleton or an interrupted attempt to the complete file.
class Preparation {
public:
    Preparation(const TiledGeoTiffJob& job,
                RasterFile& source,
                const RasterInfo& info,
                std::string key,
                std::string source_path,
                const std::string& source_stamp,
                TiledGeoTiffReport& report);

    /// Resumes an interrupted attempt, or creates the file.
    Status begin();
    /// Reads, encodes and writes the missing tiles.
    Status copy(JobMonitor& monitor);
    bool hasCheckpoint() const noexcept { return checkpoints_.hasCheckpoint(); }
    void discard();
    const std::string& partPath() const { return part_path_; }

private:
    bool tryResume();
    bool findPages();
    bool opensAsTheMap() const;
    Status copyTileRow(const SampleGrid& grid, std::size_t grid_row, std::size_t tile_row);
    Status
    writeLevelRows(std::size_t level, const OverviewBuilder::Rows& rows, std::size_t tile_row);
    Status append(std::size_t page, std::size_t tile_row, EncodedTiles& tiles);
    std::optional<JobPlace> reach();
    std::size_t tileRows() const { return tilesAlong(info_.rows); }

    const TiledGeoTiffJob& job_;
    RasterFile& source_;
    const RasterInfo& info_;
    std::string key_;
    std::string source_path_;
    TiledGeoTiffReport& report_;
    std::string part_path_;
    OverviewBuilder overviews_;
    std::optional<TiffTiles> tiles_;
    // Pages by level: 0 is the raster.
    std::vector<std::size_t> pages_;
    std::vector<std::size_t> mask_pages_;
    std::size_t tile_rows_done_ = 0;
    Checkpoints checkpoints_;
};

Preparation::Preparation(const TiledGeoTiffJob& job,
                         RasterFile& source,
                         const RasterInfo& info,
                         std::string key,
                         std::string source_path,
                         const std::string& source_stamp,
                         TiledGeoTiffReport& report)
    : job_(job)
    , source_(source)
    , info_(info)
    , key_(std::move(key))
    , source_path_(std::move(source_path))
    , report_(report)
    , part_path_(job.path + ".part")
    , overviews_(info.columns, info.rows, info.type, info.nodata, info.needsVoidMask())
    , checkpoints_(checkpointOf(job.path), key_ + '\n' + source_stamp, job.checkpoint_interval)
{}

void Preparation::discard()
{
    std::error_code ignored;
    fs::remove(part_path_, ignored);
    checkpoints_.remove();
}

// Finds the page of every level by its size.
bool Preparation::findPages()
{
    const std::size_t levels = overviews_.levelCount() + 1;
    constexpr std::size_t kNone = ~std::size_t{0};
    pages_.assign(levels, kNone);
    mask_pages_.assign(info_.needsVoidMask() ? levels : 0, kNone);
    const std::vector<TiffPage>& pages = tiles_->pages();
    for (std::size_t i = 0; i < pages.size(); ++i) {
        for (std::size_t level = 0; level < levels; ++level) {
            if (pages[i].columns ==
                    TileLayout::samplesAlong(TileKind::Means, level, info_.columns) &&
                pages[i].rows == TileLayout::samplesAlong(TileKind::Means, level, info_.rows)) {
                std::vector<std::size_t>& of = pages[i].is_mask ? mask_pages_ : pages_;
                if (level < of.size()) {
                    of[level] = i;
                }
            }
        }
    }
    const auto is_found = [](std::size_t page) { return page != kNone; };
    return pages.size() == pages_.size() + mask_pages_.size() &&
           std::all_of(pages_.begin(), pages_.end(), is_found) &&
           std::all_of(mask_pages_.begin(), mask_pages_.end(), is_found);
}

// Opens the file as any program would.
bool Preparation::opensAsTheMap() const
{
    const Result<RasterFile> part = RasterFile::open(part_path_);
    return part && part->info().columns == info_.columns && part->info().rows == info_.rows &&
           part->info().type == info_.type;
}

bool Preparation::tryResume()
{
    std::optional<Checkpoints::Found> checkpoint = checkpoints_.find();
    if (!checkpoint) {
        return false;
    }
    const JobPlace& place = checkpoint->place;
    std::vector<std::uint8_t> overviews;
    if (place.rows == 0 || place.rows > tileRows() || place.rows % kTileRowsPerCheckpoint != 0 ||
        !checkpoint->state.getAny(overviews)) {
        return false;
    }
    Result<TiffTiles> tiles = TiffTiles::open(part_path_);
    if (!tiles) {
        return false;
    }
    tiles_ = std::move(tiles).value();
    const auto tile_rows = static_cast<std::size_t>(place.rows);
    const Result<std::uint64_t> bytes = tiles_->fileBytes();
    if (!bytes || *bytes < place.file_bytes || !findPages() ||
        !overviews_.restore(tile_rows, overviews)) {
        return false;
    }
    for (const std::vector<std::size_t>* pages : {&pages_, &mask_pages_}) {
        for (std::size_t level = 0; level < pages->size(); ++level) {
            const std::size_t page = (*pages)[level];
            const std::size_t complete =
                level > OverviewBuilder::kStreamedLevels ? 0 : tile_rows >> level;
            const std::size_t noted = complete * tiles_->pages()[page].tile_columns;
            if (!tiles_->holdsTiles(page, noted, place.file_bytes) ||
                !tiles_->areWhole(page, noted)) {
                return false;
            }
        }
    }
    tile_rows_done_ = tile_rows;
    if (!opensAsTheMap() || !tiles_->trim(place.file_bytes)) {
        return false;
    }
    checkpoints_.adopt();
    return true;
}

Status Preparation::begin()
{
    std::error_code ignored;
    const bool was_begun =
        fs::exists(part_path_, ignored) && fs::exists(checkpointOf(job_.path), ignored);
    if (was_begun && tryResume()) {
        report_.notes.push_back(fmt::format("{}: resumed after row {} of {}", job_.path,
                                            std::min(tile_rows_done_ * kTileSide, info_.rows),
                                            info_.rows));
    } else {
        tiles_.reset();
        tile_rows_done_ = 0;
        discard();
        if (was_begun) {
            report_.notes.push_back(fmt::format(
                "{}: the unfinished file is damaged, or was made from another source or with "
                "other settings; restarted",
                part_path_));
        }
        if (Status laid_out = writeGeoTiffSkeleton(part_path_, info_, {key_, source_path_});
            !laid_out) {
            return laid_out;
        }
        Result<TiffTiles> tiles = TiffTiles::open(part_path_);
        if (!tiles) {
            return std::move(tiles).error();
        }
        tiles_ = std::move(tiles).value();
        if (!findPages()) {
            return writeError(part_path_, 0, "was not created with the requested layout");
        }
    }
    return Done{};
}

Status Preparation::append(std::size_t page, std::size_t tile_row, EncodedTiles& tiles)
{
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (tiles[i].empty()) {
            return Error{ErrorCode::TooLarge,
                         fmt::format("{}: not enough memory to compress its tiles", part_path_)};
        }
        if (Status written = tiles_->append(page, tile_row * tiles.size() + i, tiles[i]);
            !written) {
            return written;
        }
        tiles[i] = {};
    }
    return Done{};
}

Status Preparation::copyTileRow(const SampleGrid& grid, std::size_t grid_row, std::size_t tile_row)
{
    const std::size_t height = std::min(kTileSide, info_.rows - tile_row * kTileSide);
    const std::size_t count = tilesAlong(info_.columns);
    const std::size_t sample_bytes = sampleBytes(info_.type);
    EncodedTiles tiles(count);
    EncodedTiles masks(info_.needsVoidMask() ? count : 0);
    const TiffPage& page = tiles_->pages()[pages_[0]];
    const std::byte* const rows = grid.visit([&](auto samples) {
        return reinterpret_cast<const std::byte*>(samples.row(grid_row).data());
    });
    parallelRanges(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<std::byte> tile = tileBytes(rows, info_.columns, height, i, sample_bytes);
            tiles[i] = encodeTile(tile, kTileSide, sample_bytes, page.predictor);
            if (!masks.empty()) {
                const TiffPage& mask_page = tiles_->pages()[mask_pages_[0]];
                const std::size_t first = i * kTileSide;
                masks[i] = encodeMask(
                    mask_page, maskBytes(mask_page, std::min(kTileSide, info_.columns - first),
                                         height, [&](std::size_t x, std::size_t y) {
                                             return !grid.isVoid(first + x, grid_row + y);
                                         }));
            }
            overviews_.addTile(grid, grid_row, i, tile_row);
        }
    });
    if (Status written = append(pages_[0], tile_row, tiles); !written || masks.empty()) {
        return written;
    }
    return append(mask_pages_[0], tile_row, masks);
}

Status Preparation::writeLevelRows(std::size_t level,
                                   const OverviewBuilder::Rows& rows,
                                   std::size_t tile_row)
{
    const std::size_t count = tilesAlong(rows.columns);
    const std::size_t sample_bytes = sampleBytes(info_.type);
    EncodedTiles tiles(count);
    EncodedTiles masks(info_.needsVoidMask() ? count : 0);
    const TiffPage& page = tiles_->pages()[pages_[level]];
    parallelRanges(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::vector<std::byte> tile =
                tileBytes(rows.samples, rows.columns, rows.rows, i, sample_bytes);
            tiles[i] = encodeTile(tile, kTileSide, sample_bytes, page.predictor);
            if (!masks.empty()) {
                const TiffPage& mask_page = tiles_->pages()[mask_pages_[level]];
                const std::size_t first = i * kTileSide;
                masks[i] = encodeMask(
                    mask_page, maskBytes(mask_page, std::min(kTileSide, rows.columns - first),
                                         rows.rows, [&](std::size_t x, std::size_t y) {
                                             return rows.valid[y * rows.columns + first + x] != 0;
                                         }));
            }
        }
    });
    if (Status written = append(pages_[level], tile_row, tiles); !written || masks.empty()) {
        return written;
    }
    return append(mask_pages_[level], tile_row, masks);
}

std::optional<JobPlace> Preparation::reach()
{
    const Status flushed = tiles_->flush();
    const Result<std::uint64_t> bytes = tiles_->fileBytes();
    if (!flushed || !bytes) {
        return std::nullopt;
    }
    return JobPlace{.rows = tile_rows_done_, .row_count = tileRows(), .file_bytes = *bytes};
}

Status Preparation::copy(JobMonitor& monitor)
{
    const Windows windows = windowsFor(source_, info_);
    const auto window_at = [&](std::size_t row) {
        return GridWindow{0, row, info_.columns, std::min(windows.rows, info_.rows - row)};
    };
    const auto read = [&](std::size_t row) {
        return source_.readWindow(window_at(row), {info_.nodata});
    };
    std::future<Result<LoadedSamples>> ahead;
    for (std::size_t row = tile_rows_done_ * kTileSide; row < info_.rows;) {
        Result<LoadedSamples> samples = ahead.valid() ? ahead.get() : read(row);
        if (!samples) {
            return std::move(samples).error();
        }
        const std::size_t end = row + samples->grid.rows();
        if (windows.reads_ahead && end < info_.rows) {
            ahead = std::async(std::launch::async, read, end);
        }
        for (std::size_t grid_row = 0; row < end;
             grid_row += kTileSide, row = std::min(row + kTileSide, end)) {
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, ""};
            }
            if (Status written = copyTileRow(samples->grid, grid_row, tile_rows_done_); !written) {
                return written;
            }
            const std::size_t tile_row = tile_rows_done_++;
            const bool is_last = tile_rows_done_ == tileRows();
            for (std::size_t k = 1;
                 k <= std::min(overviews_.levelCount(), OverviewBuilder::kStreamedLevels); ++k) {
                if (is_last || tile_rows_done_ % (std::size_t{1} << k) == 0) {
                    if (Status written =
                            writeLevelRows(k, overviews_.rowsOf(k, tile_row), tile_row >> k);
                        !written) {
                        return written;
                    }
                }
            }
            if (!is_last && tile_rows_done_ % kTileRowsPerCheckpoint == 0 && checkpoints_.isDue()) {
                checkpoints_.save([this] { return reach(); },
                                  [this](CheckpointWriter& to) {
                                      to.putArray(overviews_.save(tile_rows_done_));
                                      return true;
                                  });
            }
            monitor.report(static_cast<double>(tile_rows_done_) / static_cast<double>(tileRows()));
        }
        report_.samples_read += samples->grid.columns() * samples->grid.rows();
    }
    for (std::size_t k = OverviewBuilder::kStreamedLevels + 1; k <= overviews_.levelCount(); ++k) {
        const OverviewBuilder::Rows level = overviews_.makeLevel(k);
        for (std::size_t first = 0; first < level.rows; first += kTileSide) {
            OverviewBuilder::Rows rows = level;
            rows.samples += first * level.columns * sampleBytes(info_.type);
            rows.valid += level.valid != nullptr ? first * level.columns : 0;
            rows.rows = std::min(kTileSide, level.rows - first);
            if (Status written = writeLevelRows(k, rows, first / kTileSide); !written) {
                return written;
            }
        }
    }
    if (Status flushed = tiles_->flush(); !flushed) {
        return flushed;
    }
    const Result<std::uint64_t> bytes = tiles_->fileBytes();
    if (!bytes) {
        return bytes.error();
    }
    for (std::size_t page = 0; page < tiles_->pages().size(); ++page) {
        const TiffPage& of = tiles_->pages()[page];
        MARSVIEW_CHECK(tiles_->holdsTiles(page, of.tile_columns * of.tile_rows, *bytes));
    }
    tiles_.reset();
    return Done{};
}

Status checkSpace(const TiledGeoTiffJob& job, const RasterInfo& info)
{
    const std::uint64_t bytes = tiledGeoTiffBytesMax(info);
    const std::uint64_t written = bytesOnDisk(job.path + ".part");
    Status alone = checkRoom({.path = job.path, .bytes = bytes, .written = written});
    return !alone ? std::move(alone)
                  : checkRoom({.path = job.path + " and the files built from it",
                               .bytes = bytes + job.bytes_after,
                               .written = written});
}

Status checkIsNotSource(const TiledGeoTiffJob& job, const RasterFile& source)
{
    std::vector<std::string> files = source.files();
    files.push_back(job.source);
    files.push_back(source.info().path);
    std::error_code ignored;
    if (fs::equivalent(fs::absolute(job.path).parent_path(), job.source, ignored)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: would become part of its own source folder; choose another "
                                 "folder",
                                 job.path)};
    }
    for (const std::string& file : files) {
        for (const char* ending : {"", ".part", ".part.checkpoint", ".lock"}) {
            if (fs::equivalent(job.path + ending, file, ignored)) {
                return Error{
                    ErrorCode::Invalid,
                    fmt::format("{}: belongs to the source map; choose another name", job.path)};
            }
        }
    }
    return Done{};
}

// Reports the progress of the program that holds the lock.
void reportOthersProgress(const std::string& path, JobMonitor& monitor)
{
    const std::optional<JobPlace> place = placeInCheckpoint(checkpointOf(path));
    if (place && place->row_count > 0) {
        monitor.report(static_cast<double>(place->rows) / static_cast<double>(place->row_count));
    }
}

Result<FileLock> lockFor(const TiledGeoTiffJob& job, JobMonitor& monitor, bool& has_waited)
{
    const std::string path = job.path + ".lock";
    while (true) {
        Result<std::optional<FileLock>> lock = FileLock::tryLock(path, FileLock::Kind::Exclusive);
        if (!lock) {
            return Error{lock.error().code,
                         fmt::format("{}: cannot be written: {}", job.path, lock.error().message)};
        }
        if (*lock) {
            return std::move(**lock);
        }
        if (job.when_busy == TiledGeoTiffJob::WhenBusy::Fail) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: is being prepared by another program (process {}); wait "
                                     "for it or cancel it there",
                                     job.path, FileLock::holder(path))};
        }
        if (monitor.isCanceled()) {
            return Error{
                ErrorCode::Canceled,
                fmt::format("{}: waiting for another program that prepares it was canceled",
                            job.path)};
        }
        has_waited = true;
        reportOthersProgress(job.path, monitor);
        constexpr std::chrono::milliseconds kPatience{200};
        std::this_thread::sleep_for(kPatience);
    }
}

Status publish(const TiledGeoTiffJob& job, Preparation& preparation)
{
    std::error_code failure;
    const bool is_replaced = fs::exists(job.path, failure);
    fs::rename(preparation.partPath(), job.path, failure);
    if (failure) {
        return writeError(job.path, failure.value(), "cannot be written");
    }
    if (is_replaced) {
        // These belong to the previous file and would be taken for this one's.
        for (const char* ending : {".aux.xml", ".ovr", ".msk"}) {
            fs::remove(job.path + ending, failure);
        }
    }
    preparation.discard();
    return Done{};
}

} // namespace

std::uint64_t tiledGeoTiffBytesMax(const RasterInfo& info)
{
    const double sample_bytes =
        static_cast<double>(sampleBytes(info.type)) + (info.needsVoidMask() ? 0.125 : 0.0);
    return static_cast<std::uint64_t>(kBytesPerRawByte * sample_bytes *
                                      static_cast<double>(info.columns) *
                                      static_cast<double>(info.rows));
}

Result<TiledGeoTiffReport> writeTiledGeoTiff(const TiledGeoTiffJob& job, JobMonitor& monitor)
{
    const SourceStamp stamp = stampOf(job.source);
    Result<SourceIdentity> before = identify(job.source);
    if (!before) {
        return std::move(before).error();
    }
    Result<RasterFile> source = RasterFile::open(job.source, job.band);
    if (!source) {
        return std::move(source).error();
    }
    Result<RasterInfo> info = withOverrides(source->info(), job.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", job.source, info.error().message)};
    }
    if (Status apart = checkIsNotSource(job, *source); !apart) {
        return std::move(apart).error();
    }
    bool has_waited = false;
    Result<FileLock> lock = lockFor(job, monitor, has_waited);
    if (!lock) {
        return std::move(lock).error();
    }
    TiledGeoTiffReport report;
    report.samples = info->columns * info->rows;
    const std::string key = keyOf(*info, *before);
    std::error_code failure;
    Preparation preparation(job, *source, *info, key, before->path, stamp.text, report);
    if (job.when_there == TiledGeoTiffJob::WhenThere::Keep && fs::exists(job.path, failure) &&
        readGeoTiffOrigin(job.path).key == key) {
        preparation.discard(); // as after a kill during publishing
        report.is_there = true;
        report.notes.push_back(
            fmt::format("{}: is up to date with its source{}", job.path,
                        has_waited ? ", as another program has just made it" : ""));
        report.bytes = fs::file_size(job.path, failure);
        monitor.report(1.0);
        return report;
    }
    if (Status space = checkSpace(job, *info); !space) {
        return std::move(space).error();
    }
    Status copied = preparation.begin();
    if (copied) {
        copied = preparation.copy(monitor);
    }
    if (!copied) {
        const bool is_kept =
            preparation.hasCheckpoint() && (copied.error().code == ErrorCode::Canceled ||
                                            copied.error().code == ErrorCode::TooLarge);
        if (!is_kept) {
            preparation.discard();
        }
        if (copied.error().code == ErrorCode::Canceled) {
            return Error{ErrorCode::Canceled,
                         fmt::format("{}: preparing was canceled{}", job.path,
                                     is_kept ? "; prepare it again to resume" : "")};
        }
        return std::move(copied).error();
    }
    Result<SourceIdentity> after = identify(job.source);
    if (!after || !isSameContent(*before, *after) || !isUntouched(stamp)) {
        preparation.discard();
        return Error{
            ErrorCode::Invalid,
            fmt::format(
                "{}: changed while it was being read; start again when no program writes to it",
                job.source)};
    }
    if (Status published = publish(job, preparation); !published) {
        return std::move(published).error();
    }
    report.bytes = fs::file_size(job.path, failure);
    return report;
}

bool isWholeTiledGeoTiff(const std::string& path)
{
    const Result<TiffTiles> tiles = TiffTiles::open(path, TiffTiles::Access::Read);
    const Result<std::uint64_t> bytes = tiles ? tiles->fileBytes() : tiles.error();
    if (!bytes) {
        return false;
    }
    for (std::size_t page = 0; page < tiles->pages().size(); ++page) {
        const TiffPage& of = tiles->pages()[page];
        const std::size_t count = of.tile_columns * of.tile_rows;
        if (!tiles->holdsTiles(page, count, *bytes) || !tiles->areWhole(page, count)) {
            return false;
        }
    }
    return true;
}

} // namespace marsview
