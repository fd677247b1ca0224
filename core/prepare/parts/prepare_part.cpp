#include "core/prepare/parts/prepare_part.h"

#include "core/base/elapsed.h"
#include "core/base/file_lock.h"
#include "core/files/file_bytes.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/parts/errors_part.h"
#include "core/prepare/parts/merged_survey.h"
#include "core/prepare/parts/overview_edges.h"
#include "core/prepare/parts/part_border.h"
#include "core/prepare/parts/part_state.h"
#include "core/prepare/parts/part_tiles.h"
#include "core/prepare/parts/survey_part.h"
#include "core/prepare/source_rows.h"
#include "core/prepare/tiff/tiff_tiles.h"
#include "core/prepare/tile_row_writer.h"
#include "core/prepare/tile_rows.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/sources/source_stamp.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Of the threads that measure: a part is small, and other parts may run beside it.
constexpr std::size_t kMemoryBytesMax = std::size_t{160} << 20;

// A row of tiles with the memory of so many small arrays is wide.
constexpr std::size_t kOrderedRows = 4;

Status renameTo(const std::string& from, const std::string& to)
{
    std::error_code failure;
    fs::rename(from, to, failure);
    return failure ? Status(writeError(to, failure.value(), "cannot be written")) : Status(Done{});
}

Error writingState(const std::string& path)
{
    return {ErrorCode::Unreadable,
            fmt::format("{}: cannot be written; make room there or choose another folder", path)};
}

// One part in work.
class Part {
public:
    Part(const OpenRaster& raster, const PartedMap& map, std::size_t part, JobMonitor& monitor)
        : raster_(raster)
        , map_(map)
        , part_(part)
        , rows_(map.rowsOf(part))
        , monitor_(monitor)
        , new_tiles_(map.file(part, "new.tiles"))
    {}

    // Whether the first pass is complete and its files are intact, except for tiles of the raster.
    bool isSurveyed() const
    {
        Result<CheckpointReader> state = openPartState(map_, part_, kPartSurvey);
        PartFiles tiles;
        return state && tiles.restore(*state) && tiles.areIntact(map_, part_);
    }

    bool isMeasured() const
    {
        Result<CheckpointReader> state = openPartState(map_, part_, kPartErrors);
        FileMark fills;
        return state && fills.restore(*state) &&
               FileMark::of(map_.file(part_, kPartFills)) == fills;
    }

    // Whether the encoded tiles match the checksums of the first pass. Reads them all.
    bool hasIntactTiles() const
    {
        const auto file = openTiles();
        return file && (*file)->isIntact();
    }

    Status copy(PartFiles& tiles, OverviewEdges& edges)
    {
        for (const char* ending : {kPartSurvey, kPartBorder, kPartEdges, kPartMeans, kPartErrors}) {
            removePartFile(map_.file(part_, ending));
        }
        auto pages = pagesOfMap(map_, part_);
        if (!pages) {
            return std::move(pages).error();
        }
        auto created = PartTileFile::create(map_, rows_, std::move(pages).value(), new_tiles_);
        Result<RasterFile> source = RasterFile::open(raster_.spec.path, raster_.spec.band);
        if (!created || !source) {
            return source ? std::move(created).error() : std::move(source).error();
        }
        PartTileFile& file = **created;
        auto writer =
            TileRowWriter::to(std::move(created).value(), map_.info, new_tiles_, map_.memory);
        if (!writer) {
            return std::move(writer).error();
        }
        const RasterInfo& info = map_.info;
        OverviewBuilder overviews(info.columns, info.rows, info.type, info.nodata,
                                  info.needsVoidMask());
        if (Status room = overviews.makeRoom(map_.memory.place()); !room) {
            return room;
        }
        SourceRows rows(*source, info, map_.memory);
        Status copied = rows.each(
            rows_.first, rows_.end,
            [&](const SampleGrid& grid, std::size_t grid_row, std::size_t tile_row) -> Status {
                if (monitor_.isCanceled()) {
                    return Error{ErrorCode::Canceled, "canceled"};
                }
                Status written = writer->copyRow(grid, grid_row, tile_row, overviews);
                if (written) {
                    written = edges.addRow(overviews, tile_row, rows_, *writer);
                }
                monitor_.report(static_cast<double>(tile_row + 1 - rows_.first) /
                                static_cast<double>(rows_.end - rows_.first));
                return written;
            });
        if (!copied) {
            return copied;
        }
        const OverviewBuilder::TileSums sums = overviews.sumsOf(rows_.first, rows_.end);
        tiles.sums.assign(sums.sums.begin(), sums.sums.end());
        tiles.counts.assign(sums.counts.begin(), sums.counts.end());
        if (Status flushed = file.flush(); !flushed) {
            return flushed;
        }
        tiles.sizes = file.sizes();
        tiles.checksums = file.checksums();
        writer_ = std::move(writer).value();
        tiles_ = &file;
        return Done{};
    }

    Status survey(PartFiles& tiles, const OverviewEdges& edges)
    {
        const auto source = sourceOf(map_, *tiles_);
        const TileLayout& layout = source->layout();
        const std::string levels = map_.file(part_, kPartLevels);
        auto writer = LevelFileWriter::create(levels);
        if (!writer) {
            return std::move(writer).error();
        }
        LevelSurveyPass pass({.source = source.get(),
                              .scale = map_.scale,
                              .means_path = map_.file(part_, kPartMeans),
                              .mean_blocks_max = map_.mean_blocks_max,
                              .rows = {rows_.first, rows_.end},
                              .scratch = map_.memory.place()},
                             writer->get(), monitor_);
        if (Status begun = pass.begin(); !begun) {
            return begun;
        }
        startTiles(pass.state().ordered);
        TileReaders readers(*source, threads(layout));
        const auto survey_row = [&pass](TileReader& reader, std::size_t row) {
            return pass.surveyRow(reader, row);
        };
        const auto rows =
            readers.eachRow({.first = rows_.first, .end = rows_.end}, survey_row, monitor_);
        if (!rows) {
            return rows.error();
        }
        std::vector<std::size_t> mean_rows;
        forEachTileRow(map_, rows_, [&](std::size_t level, std::size_t row) {
            if (level > 0 && rows_.hasMeans(level, row, map_.tileRows())) {
                mean_rows.push_back(meanRowNumber(layout, level, row));
            }
        });
        if (Status done = surveyMeans(pass, readers, mean_rows, monitor_); !done) {
            return done;
        }
        if (!(*writer)->flush()) {
            return writingState(levels);
        }
        (*writer)->keep();
        tiles.levels = FileMark::of(levels + ".part");
        tiles.tile_bytes = bytesOnDisk(new_tiles_);
        CheckpointWriter border(map_.file(part_, kPartBorder));
        beginPartState(border, map_);
        if (!saveBorder(border, pass, layout, rows_) || !border.finish()) {
            return writingState(map_.file(part_, kPartBorder));
        }
        CheckpointWriter shared(map_.file(part_, kPartEdges));
        beginPartState(shared, map_);
        edges.save(shared);
        pass.state().nested.save(shared);
        if (!shared.finish()) {
            return writingState(map_.file(part_, kPartEdges));
        }
        tiles.means = FileMark::of(map_.file(part_, kPartMeans));
        CheckpointWriter to(map_.file(part_, kPartSurvey));
        beginPartState(to, map_);
        tiles.save(to);
        saveSurvey(to, pass, layout, rows_);
        Status saved = renameTo(levels + ".part", levels);
        if (saved) {
            saved = renameTo(new_tiles_, map_.file(part_, kPartTiles));
        }
        if (saved && !to.finish()) {
            return writingState(map_.file(part_, kPartSurvey));
        }
        return saved;
    }

    Status measure()
    {
        const auto file = openTiles();
        if (!file) {
            return file.error();
        }
        const auto source = sourceOf(map_, **file);
        const TileLayout& layout = source->layout();
        LevelSurveyPass survey({.source = source.get(),
                                .scale = map_.scale,
                                .means_path = {},
                                .mean_blocks_max = map_.mean_blocks_max,
                                .rows = {rows_.first, rows_.end}},
                               nullptr, monitor_);
        const Status restored = restoreSurvey(map_, part_, layout, survey);
        return restored ? measureRows(*source, survey.finish()) : restored;
    }

    void discard() const { removePartFile(new_tiles_); }

private:
    std::size_t threads(const TileLayout& layout) const
    {
        // Small bands are few, and threads on neighboring rows share them.
        return levelThreads(layout, kMemoryBytesMax, map_.memory.place()->bytes_min / 4);
    }
    // Tiles of wide rows are stored as they are made; joining puts them in order.
    void startTiles(OrderedTiles& ordered) const
    {
        ordered.startAt(rows_.first);
        if (map_.info.columns * kTileSide * sampleBytes(map_.info.type) >=
            kOrderedRows * map_.memory.place()->bytes_min) {
            ordered.appendAtOnce();
        }
    }

    Result<std::unique_ptr<PartTileFile>> openTiles() const { return openPartTiles(map_, part_); }

    Status measureRows(const TileSource& source, const LevelSurvey& survey)
    {
        const TileLayout& layout = source.layout();
        const std::string fills = map_.file(part_, kPartFills);
        auto writer = LevelFileWriter::create(fills);
        if (!writer) {
            return std::move(writer).error();
        }
        LevelErrorPass pass(source, map_.scale, survey, writer->get(), monitor_,
                            {rows_.first, rows_.end}, map_.memory.place());
        if (Status begun = pass.begin(); !begun) {
            return begun;
        }
        startTiles(pass.state().ordered);
        TileReaders readers(source, threads(layout));
        const auto measure_row = [&pass](TileReader& reader, std::size_t row) {
            return pass.measureRow(reader, row);
        };
        const auto rows =
            readers.eachRow({.first = rows_.first, .end = rows_.end}, measure_row, monitor_);
        if (!rows) {
            return rows.error();
        }
        if (!(*writer)->flush()) {
            return writingState(fills);
        }
        (*writer)->keep();
        if (Status renamed = renameTo(fills + ".part", fills); !renamed) {
            return renamed;
        }
        CheckpointWriter to(map_.file(part_, kPartErrors));
        beginPartState(to, map_);
        FileMark::of(fills).save(to);
        saveErrors(to, pass, layout, rows_);
        return to.finish() ? Status(Done{}) : Status(writingState(map_.file(part_, kPartErrors)));
    }

    const OpenRaster& raster_;
    const PartedMap& map_;
    std::size_t part_;
    PartRows rows_;
    JobMonitor& monitor_;
    std::string new_tiles_;
    std::optional<TileRowWriter> writer_; // of new_tiles_
    const PartTileFile* tiles_ = nullptr; // in it
};

// Of the time of a part.
constexpr double kCopyingShare = 0.7;
constexpr double kSurveyEnd = 0.8;

Status copyAndSurvey(Part& part, const PartedMap& map, PartReport& report, JobMonitor& monitor)
{
    const Clock::time_point start = Clock::now();
    PartFiles tiles;
    OverviewEdges edges(map.info.type, map.tileRows(), map.memory.place());
    {
        const JobPart copying(monitor, 0.0, kCopyingShare);
        if (Status copied = part.copy(tiles, edges); !copied) {
            return copied;
        }
    }
    report.copy_seconds = secondsSince(start);
    const JobPart surveying(monitor, kCopyingShare, kSurveyEnd);
    Status surveyed = part.survey(tiles, edges);
    report.is_copied = surveyed.has_value();
    report.level_seconds = secondsSince(start) - report.copy_seconds;
    return surveyed;
}

// Measures a part that has been surveyed, unless that is done or other parts are awaited.
enum class Measuring : std::uint8_t { Done, NothingToDo };

Result<Measuring>
measureIfDue(Part& part, const PartedMap& map, PartReport& report, JobMonitor& monitor)
{
    report.awaited = absentParts(map);
    report.is_measured = part.isMeasured();
    if (!report.awaited.empty() || report.is_measured) {
        monitor.report(1.0);
        return Measuring::NothingToDo;
    }
    const Clock::time_point start = Clock::now();
    const JobPart measuring(monitor, kSurveyEnd, 1.0);
    Status measured = part.measure();
    report.is_measured = measured.has_value();
    report.level_seconds += secondsSince(start);
    if (!measured) {
        return std::move(measured).error();
    }
    return Measuring::Done;
}

Status makePart(Part& part, const PartedMap& map, PartReport& report, JobMonitor& monitor)
{
    if (part.isSurveyed()) {
        const Result<Measuring> measured = measureIfDue(part, map, report, monitor);
        // Measuring finds damaged tiles too. What is run again without need is checked here.
        const bool is_final =
            measured ? *measured == Measuring::Done : measured.error().code == ErrorCode::Canceled;
        if (is_final || part.hasIntactTiles()) {
            return measured ? Status(Done{}) : Status(measured.error());
        }
    }
    if (Status copied = copyAndSurvey(part, map, report, monitor); !copied) {
        return copied;
    }
    const Result<Measuring> measured = measureIfDue(part, map, report, monitor);
    return measured ? Status(Done{}) : Status(measured.error());
}

} // namespace

Result<PartReport> preparePart(const OpenRaster& raster, const PartJob& job, JobMonitor& monitor)
{
    if (Status surface = checkIsSurface(raster.spec.path, raster.info); !surface) {
        return std::move(surface).error();
    }
    const SourceStamp stamp = stampOf(raster.spec.path);
    const Result<PartedMap> map =
        partedMap(raster, job.parts, job.folder, job.mean_blocks_max, job.memory);
    if (!map) {
        return map.error();
    }
    std::error_code failure;
    fs::create_directories(job.folder, failure);
    if (failure) {
        return writeError(job.folder, failure.value(), "cannot be created");
    }
    const std::string lock_path = map->file(job.part, "lock");
    const auto lock = FileLock::tryLock(lock_path, FileLock::Kind::Exclusive);
    if (!lock) {
        return lock.error();
    }
    if (!*lock) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: is being prepared by another program (process {}); wait for "
                                 "it or cancel it there",
                                 map->file(job.part, kPartTiles), FileLock::holder(lock_path))};
    }
    PartReport report;
    report.rows = map->rowsOf(job.part);
    report.samples = std::uint64_t{map->info.columns} *
                     (std::min(report.rows.end * kTileSide, map->info.rows) -
                      std::min(report.rows.first * kTileSide, map->info.rows));
    Part part(raster, *map, job.part, monitor);
    Status made = makePart(part, *map, report, monitor);
    if (made && report.is_copied) {
        const Result<SourceIdentity> now = identify(raster.spec.path);
        if (!now || tiledGeoTiffKey(map->info, *now) != map->key || !isUntouched(stamp)) {
            std::error_code ignored;
            fs::remove(map->file(job.part, kPartSurvey), ignored);
            made = Error{ErrorCode::Invalid,
                         fmt::format("{}: changed while it was being read; start again when no "
                                     "program writes to it",
                                     raster.spec.path)};
        }
    }
    if (!made) {
        part.discard();
        if (made.error().code == ErrorCode::Canceled) {
            return Error{ErrorCode::Canceled, fmt::format("{}: preparing was canceled",
                                                          map->file(job.part, kPartTiles))};
        }
        return std::move(made).error();
    }
    return report;
}

} // namespace marsview
