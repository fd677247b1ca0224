#include "core/prepare/tiled_geotiff.h"

#include "core/base/check.h"
#include "core/base/file_lock.h"
#include "core/prepare/checkpoints.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/source_rows.h"
#include "core/prepare/tiff/cloud_order.h"
#include "core/prepare/tiff/tiff_tiles.h"
#include "core/prepare/tile_row_writer.h"
#include "core/raster/raster_file.h"
#include "core/sources/source_identity.h"
#include "core/sources/source_stamp.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// At these rows of tiles, finer levels are in the file and coarser ones in the checkpoint: 3 % of
// a row of tiles in total.
constexpr std::size_t kTileRowsPerCheckpoint = 8;

// Of the time, if the tiles are put in another order afterwards.
constexpr double kWritingShare = 0.9;

// Upper bound even for noise; overviews add a third.
constexpr double kBytesPerRawByte = 1.34;

constexpr const char* kFormVersion = "tiled GeoTIFF 1";

std::string checkpointOf(const std::string& path)
{
    return path + ".part.checkpoint";
}

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
    bool opensAsTheMap() const;
    Status writeOverviewRows(std::size_t tile_row, bool is_last);
    std::optional<JobPlace> reach();
    // TileRowWriter::open() makes no others.
    TiffTiles& tiles() { return static_cast<TiffTiles&>(writer_->tiles()); }
    std::size_t tileRows() const { return (info_.rows + kTileSide - 1) / kTileSide; }

    const TiledGeoTiffJob& job_;
    RasterFile& source_;
    const RasterInfo& info_;
    std::string key_;
    std::string source_path_;
    TiledGeoTiffReport& report_;
    std::string part_path_;
    OverviewBuilder overviews_;
    std::optional<TileRowWriter> writer_;
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
    Result<TileRowWriter> writer = TileRowWriter::open(part_path_, info_);
    if (!writer) {
        return false;
    }
    writer_ = std::move(writer).value();
    TiffTiles& tiles = this->tiles();
    const auto tile_rows = static_cast<std::size_t>(place.rows);
    const Result<std::uint64_t> bytes = tiles.fileBytes();
    if (!bytes || *bytes < place.file_bytes || !overviews_.restore(tile_rows, overviews)) {
        return false;
    }
    const auto holds = [&](std::size_t page, std::size_t level) {
        const std::size_t complete =
            level > OverviewBuilder::kStreamedLevels ? 0 : tile_rows >> level;
        const std::size_t noted = complete * tiles.pages()[page].tile_columns;
        return tiles.holdsTiles(page, noted, place.file_bytes) && tiles.areWhole(page, noted);
    };
    for (std::size_t level = 0; level < writer_->levelCount(); ++level) {
        if (!holds(writer_->page(level), level) ||
            (writer_->hasMasks() && !holds(writer_->maskPage(level), level))) {
            return false;
        }
    }
    tile_rows_done_ = tile_rows;
    if (!opensAsTheMap() || !tiles.trim(place.file_bytes)) {
        return false;
    }
    checkpoints_.adopt();
    return true;
}

Status Preparation::begin()
{
    if (Status room = overviews_.makeRoom(); !room) {
        return room;
    }
    std::error_code ignored;
    const bool was_begun =
        fs::exists(part_path_, ignored) && fs::exists(checkpointOf(job_.path), ignored);
    if (was_begun && tryResume()) {
        report_.notes.push_back(fmt::format("{}: resumed after row {} of {}", job_.path,
                                            std::min(tile_rows_done_ * kTileSide, info_.rows),
                                            info_.rows));
    } else {
        writer_.reset();
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
        Result<TileRowWriter> writer = TileRowWriter::open(part_path_, info_);
        if (!writer) {
            return std::move(writer).error();
        }
        writer_ = std::move(writer).value();
    }
    return Done{};
}

// The overviews' rows of tiles that this row of tiles completes.
Status Preparation::writeOverviewRows(std::size_t tile_row, bool is_last)
{
    for (std::size_t k = 1;
         k <= std::min(overviews_.levelCount(), OverviewBuilder::kStreamedLevels); ++k) {
        if (is_last || (tile_row + 1) % (std::size_t{1} << k) == 0) {
            if (Status written =
                    writer_->writeLevelRow(k, overviews_.rowsOf(k, tile_row), tile_row >> k);
                !written) {
                return written;
            }
        }
    }
    return Done{};
}

std::optional<JobPlace> Preparation::reach()
{
    const Status flushed = tiles().flush();
    const Result<std::uint64_t> bytes = tiles().fileBytes();
    if (!flushed || !bytes) {
        return std::nullopt;
    }
    return JobPlace{.rows = tile_rows_done_, .row_count = tileRows(), .file_bytes = *bytes};
}

Status Preparation::copy(JobMonitor& monitor)
{
    SourceRows rows(source_, info_);
    const auto copy_row = [&](const SampleGrid& grid, std::size_t grid_row,
                              std::size_t tile_row) -> Status {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, ""};
        }
        const bool is_last = tile_row + 1 == tileRows();
        if (Status written = writer_->copyRow(grid, grid_row, tile_row, overviews_); !written) {
            return written;
        }
        if (Status written = writeOverviewRows(tile_row, is_last); !written) {
            return written;
        }
        tile_rows_done_ = tile_row + 1;
        if (!is_last && tile_rows_done_ % kTileRowsPerCheckpoint == 0 && checkpoints_.isDue()) {
            checkpoints_.save([this] { return reach(); },
                              [this](CheckpointWriter& to) {
                                  to.putArray(overviews_.save(tile_rows_done_));
                                  return true;
                              });
        }
        monitor.report(static_cast<double>(tile_rows_done_) / static_cast<double>(tileRows()));
        return Done{};
    };
    const Status copied = rows.each(tile_rows_done_, tileRows(), copy_row);
    report_.samples_read += rows.samplesRead();
    if (!copied) {
        return copied;
    }
    for (std::size_t k = OverviewBuilder::kStreamedLevels + 1; k <= overviews_.levelCount(); ++k) {
        if (Status written = writer_->writeLevel(k, overviews_.makeLevel(k)); !written) {
            return written;
        }
    }
    TiffTiles& tiles = this->tiles();
    if (Status flushed = tiles.flush(); !flushed) {
        return flushed;
    }
    const Result<std::uint64_t> bytes = tiles.fileBytes();
    if (!bytes) {
        return bytes.error();
    }
    for (std::size_t page = 0; page < tiles.pages().size(); ++page) {
        const TiffPage& of = tiles.pages()[page];
        MARSVIEW_CHECK(tiles.holdsTiles(page, of.tile_columns * of.tile_rows, *bytes));
    }
    writer_.reset();
    return Done{};
}

Status checkSpace(const TiledGeoTiffJob& job, const RasterInfo& info)
{
    const std::uint64_t bytes = tiledGeoTiffBytesMax(info);
    const std::uint64_t written = bytesOnDisk(job.path + ".part");
    const std::uint64_t again = job.order == TiledGeoTiffJob::Order::OverviewsFirst ? bytes : 0;
    Status alone = checkRoom({.path = job.path, .bytes = bytes + again, .written = written});
    return !alone ? std::move(alone)
                  : checkRoom({.path = job.path + " and the files built from it",
                               .bytes = bytes + std::max(again, job.bytes_after),
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

// Replaces a complete file by one with its tiles in the order of a cloud-optimized GeoTIFF.
Status putOverviewsFirst(const std::string& path, const std::string& part, JobMonitor& monitor)
{
    if (Status written = orderForCloud(path, part, monitor); !written) {
        return written;
    }
    std::error_code failure;
    fs::rename(part, path, failure);
    return failure ? Status(writeError(path, failure.value(), "cannot be written"))
                   : Status(Done{});
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

std::string tiledGeoTiffKey(const RasterInfo& info, const SourceIdentity& source)
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
    const std::string key = tiledGeoTiffKey(*info, *before);
    const bool is_reordered = job.order == TiledGeoTiffJob::Order::OverviewsFirst;
    std::error_code failure;
    Preparation preparation(job, *source, *info, key, before->path, stamp.text, report);
    if (job.when_there == TiledGeoTiffJob::WhenThere::Keep && fs::exists(job.path, failure) &&
        readGeoTiffOrigin(job.path).key == key) {
        preparation.discard(); // as after a kill during publishing
        if (is_reordered && !isOrderedForCloud(job.path)) {
            Status ordered = putOverviewsFirst(job.path, preparation.partPath(), monitor);
            if (!ordered) {
                return std::move(ordered).error();
            }
            report.notes.push_back(fmt::format("{}: its overviews are now first", job.path));
            report.bytes = fs::file_size(job.path, failure);
            return report;
        }
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
        const JobPart copying(monitor, 0.0, is_reordered ? kWritingShare : 1.0);
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
    if (is_reordered) {
        const JobPart ordering(monitor, kWritingShare, 1.0);
        const std::string& part = preparation.partPath();
        if (Status ordered = putOverviewsFirst(part, part + ".ordered", monitor); !ordered) {
            preparation.discard();
            return std::move(ordered).error();
        }
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
