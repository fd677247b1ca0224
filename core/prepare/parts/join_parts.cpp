#include "core/prepare/parts/join_parts.h"

#include "core/base/elapsed.h"
#include "core/base/file_lock.h"
#include "core/files/file_bytes.h"
#include "core/files/remote_raster.h"
#include "core/levels/level_file.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/parts/errors_part.h"
#include "core/prepare/parts/merged_survey.h"
#include "core/prepare/parts/overview_edges.h"
#include "core/prepare/parts/part_state.h"
#include "core/prepare/parts/part_tiles.h"
#include "core/prepare/parts/survey_part.h"
#include "core/prepare/tiff/cloud_order.h"
#include "core/prepare/tiff/tiff_stream.h"
#include "core/sources/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <sys/resource.h>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Of the time of a join whose parts have made the second pass.
constexpr double kMergeShare = 0.2;
constexpr double kStreamEnd = 0.8;

// Many systems allow a program 1024 files unless it asks for more.
void allowOpenFiles(std::size_t count)
{
    constexpr std::size_t kOthers = 64;
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < count + kOthers) {
        limit.rlim_cur = std::min<rlim_t>(count + kOthers, limit.rlim_max);
        setrlimit(RLIMIT_NOFILE, &limit);
    }
}

// The rows of tiles of the new file, with the file that has each: a part, or the one of what parts
// share.
struct TileRow {
    std::size_t level = 0;
    std::size_t row = 0;
    std::size_t file = 0; // 0: shared; otherwise the number of a part
};

class Join {
public:
    Join(const PartedMap& map, const JoinJob& job, JoinReport& report, JobMonitor& monitor)
        : map_(map)
        , job_(job)
        , report_(report)
        , monitor_(monitor)
        , shared_path_((fs::path(map.folder) / "shared.tif").string())
        , is_remote_(remoteNameFor(job.path).has_value())
        , level_path_(is_remote_ ? (fs::path(map.folder) / "joined.marsview").string()
                                 : LevelFile::pathFor(job.path))
        , overviews_(map.info.columns,
                     map.info.rows,
                     map.info.type,
                     map.info.nodata,
                     map.info.needsVoidMask())
        , edges_(map.info.type, map.tileRows(), map.memory.place())
    {}

    Status run()
    {
        const Clock::time_point start = Clock::now();
        Status done = mergeSurveysAndTiles();
        if (done) {
            done = mergeErrorsOrMeasure();
        }
        report_.level_seconds = secondsSince(start);
        if (done) {
            const Clock::time_point copying = Clock::now();
            done = writeRaster();
            report_.copy_seconds = secondsSince(copying);
        }
        if (done) {
            done = writeLevels();
        }
        removePartFile(shared_path_);
        return done;
    }

    void removeParts() const
    {
        for (std::size_t part = 1; part <= map_.parts; ++part) {
            for (const char* ending : {kPartTiles, kPartLevels, kPartSurvey, kPartMeans,
                                       kPartBorder, kPartEdges, kPartFills, kPartErrors}) {
                removePartFile(map_.file(part, ending));
            }
        }
    }

private:
    Status openShared()
    {
        if (Status made =
                writeGeoTiffSkeleton(shared_path_, map_.info, {map_.key, map_.source_path});
            !made) {
            return made;
        }
        Result<TileRowWriter> writer = TileRowWriter::open(shared_path_, map_.info, map_.memory);
        if (!writer) {
            return std::move(writer).error();
        }
        shared_ = std::move(writer).value();
        const Result<RasterFile> file = RasterFile::open(shared_path_);
        const auto source = file ? GeotiffTileSource::of(*file, map_.voids) : file.error();
        if (!source) {
            return source.error();
        }
        source_ = *source;
        return Done{};
    }

    // `error` may name a file of the part itself.
    Error ofPart(std::size_t part, const char* ending, const Error& error) const
    {
        const std::string where = error.message.starts_with(map_.file(part, ""))
                                      ? std::string()
                                      : map_.file(part, ending) + ": ";
        return {error.code, fmt::format("{}{}; prepare part {} again", where, error.message, part)};
    }

    Status mergeSurveysAndTiles()
    {
        const JobPart merging(monitor_, 0.0, kMergeShare);
        if (Status opened = openShared(); !opened) {
            return opened;
        }
        auto writer = LevelFileWriter::create(level_path_);
        if (!writer) {
            return std::move(writer).error();
        }
        level_writer_ = std::move(writer).value();
        survey_.emplace(SurveyOptions{.source = source_.get(),
                                      .scale = map_.scale,
                                      .means_path = {},
                                      .mean_blocks_max = map_.mean_blocks_max,
                                      .scratch = map_.memory.place()},
                        level_writer_.get(), monitor_);
        if (Status begun = survey_->begin(); !begun) {
            return begun;
        }
        checksums_.resize(map_.parts + 1);
        sizes_.resize(map_.parts + 1);
        for (std::size_t part = 1; part <= map_.parts; ++part) {
            if (monitor_.isCanceled()) {
                return Error{ErrorCode::Canceled, "canceled"};
            }
            if (Status merged = mergePart(part); !merged) {
                return merged;
            }
        }
        std::vector<std::size_t> mean_rows;
        const TileLayout& layout = source_->layout();
        for (const auto& [level, row] : edges_.written()) {
            mean_rows.push_back(meanRowNumber(layout, level, row));
        }
        for (std::size_t k = OverviewBuilder::kStreamedLevels + 1; k <= overviews_.levelCount();
             ++k) {
            if (Status written = shared_->writeLevel(k, overviews_.makeLevel(k)); !written) {
                return written;
            }
            for (std::size_t row = 0; row < layout.tileRows(TileKind::Means, k); ++row) {
                mean_rows.push_back(meanRowNumber(layout, k, row));
            }
        }
        if (Status flushed = shared_->tiles().flush(); !flushed) {
            return flushed;
        }
        TileReaders readers(*source_, levelThreads(layout));
        return surveyMeans(*survey_, readers, mean_rows, monitor_);
    }

    Status mergePart(std::size_t part)
    {
        Result<CheckpointReader> state = openPartState(map_, part, kPartSurvey);
        if (!state) {
            return std::move(state).error();
        }
        PartFiles tiles;
        if (!tiles.restore(*state)) {
            return ofPart(part, kPartSurvey, {ErrorCode::Damaged, "is damaged"});
        }
        checksums_[part] = std::move(tiles.checksums);
        sizes_[part] = std::move(tiles.sizes);
        const PartRows rows = map_.rowsOf(part);
        const OverviewBuilder::TileSums sums = overviews_.sumsOf(rows.first, rows.end);
        if (tiles.sums.size() != sums.sums.size() || tiles.counts.size() != sums.counts.size()) {
            return ofPart(part, kPartSurvey, {ErrorCode::Damaged, "is damaged"});
        }
        std::copy(tiles.sums.begin(), tiles.sums.end(), sums.sums.begin());
        std::copy(tiles.counts.begin(), tiles.counts.end(), sums.counts.begin());
        Result<CheckpointReader> edges = openPartState(map_, part, kPartEdges);
        if (!edges) {
            return std::move(edges).error();
        }
        if (Status merged = edges_.merge(*edges, *shared_); !merged) {
            return ofPart(part, kPartEdges, merged.error());
        }
        const Result<FileBytes> levels = FileBytes::open(map_.file(part, kPartLevels));
        if (!levels) {
            return levels.error();
        }
        Status merged = mergeSurvey(*state, *survey_, source_->layout(), rows, &*levels, &*edges,
                                    map_.file(part, kPartMeans));
        return merged ? merged : Status(ofPart(part, kPartSurvey, merged.error()));
    }

    Result<std::unique_ptr<PartTileFile>> openTiles(std::size_t part) const
    {
        return PartTileFile::open(map_, map_.rowsOf(part), shared_->tiles().pages(),
                                  map_.file(part, kPartTiles), sizes_[part], checksums_[part]);
    }

    Status mergeErrorsOrMeasure()
    {
        const JobPart merging(monitor_, kMergeShare, 2 * kMergeShare);
        const LevelSurvey& survey = survey_->finish();
        errors_.emplace(*source_, map_.scale, survey, level_writer_.get(), monitor_, TileRowRange{},
                        map_.memory.place());
        if (Status begun = errors_->begin(); !begun) {
            return begun;
        }
        for (std::size_t part = 1; part <= map_.parts; ++part) {
            Result<CheckpointReader> state = openPartState(map_, part, kPartErrors);
            const Result<FileBytes> fills = FileBytes::open(map_.file(part, kPartFills));
            FileMark mark;
            const bool is_there = state && fills && mark.restore(*state) &&
                                  mark == FileMark::of(map_.file(part, kPartFills));
            Status done = is_there ? mergeErrors(*state, *errors_, source_->layout(),
                                                 map_.rowsOf(part), *fills)
                                   : measure(part);
            if (!done) {
                return is_there ? Status(ofPart(part, kPartErrors, done.error())) : done;
            }
        }
        return Done{};
    }

    Status measure(std::size_t part)
    {
        ++report_.measured;
        const std::string path = map_.file(part, kPartTiles);
        const auto tiles = openTiles(part);
        if (!tiles) {
            return ofPart(part, kPartTiles, tiles.error());
        }
        const PartRows rows = map_.rowsOf(part);
        const auto source = sourceOf(map_, **tiles);
        TileReaders readers(*source, levelThreads(source_->layout()));
        const auto measure_row = [this](TileReader& reader, std::size_t row) {
            return errors_->measureRow(reader, row);
        };
        const auto done =
            readers.eachRow({.first = rows.first, .end = rows.end}, measure_row, monitor_);
        if (!done && (done.error().code == ErrorCode::Invalid ||
                      done.error().code == ErrorCode::Unreadable)) {
            return ofPart(part, kPartTiles, {ErrorCode::Damaged, "is damaged"});
        }
        return done ? Status(Done{}) : Status(done.error());
    }

    // All rows of tiles as they are made, or the overviews first.
    std::vector<TileRow> tileRows() const
    {
        std::vector<TileRow> rows;
        std::size_t part = 1;
        forEachTileRow(map_, {0, map_.tileRows()}, [&](std::size_t level, std::size_t row) {
            while (level == 0 && !map_.rowsOf(part).has(row)) {
                ++part;
            }
            const bool is_whole = map_.rowsOf(part).hasMeans(level, row, map_.tileRows());
            rows.push_back({level, row, is_whole ? part : 0});
        });
        const TileLayout& layout = source_->layout();
        for (std::size_t k = OverviewBuilder::kStreamedLevels + 1; k <= overviews_.levelCount();
             ++k) {
            for (std::size_t row = 0; row < layout.tileRows(TileKind::Means, k); ++row) {
                rows.push_back({k, row, 0});
            }
        }
        return rows;
    }

    Status writeRaster()
    {
        const JobPart writing(monitor_, 2 * kMergeShare, kStreamEnd);
        TiffStreamJob stream{.skeleton = (fs::path(map_.folder) / "skeleton.tif").string(),
                             .skeleton_bytes = 0,
                             .files = {&shared_->tiles()},
                             .tiles = {},
                             .names = {shared_path_},
                             .remedies = {std::string()}};
        std::vector<std::unique_ptr<PartTileFile>> files;
        for (std::size_t part = 1; part <= map_.parts; ++part) {
            auto tiles = openTiles(part);
            if (!tiles) {
                return ofPart(part, kPartTiles, tiles.error());
            }
            files.push_back(std::move(tiles).value());
            stream.names.push_back(map_.file(part, kPartTiles));
            stream.remedies.push_back(fmt::format("; prepare part {} again", part));
        }
        for (const auto& file : files) {
            stream.files.push_back(file.get());
        }
        if (Status made =
                writeGeoTiffSkeleton(stream.skeleton, map_.info, {map_.key, map_.source_path});
            !made) {
            return made;
        }
        if (Status listed = listTiles(stream); !listed) {
            return listed;
        }
        report_.bytes = bytesOnDisk(stream.skeleton);
        for (const StreamedTile& tile : stream.tiles) {
            report_.bytes += stream.files[tile.file]->encodedBytes(tile.page, tile.tile);
        }
        Status written = publish(stream);
        removePartFile(stream.skeleton);
        return written;
    }

    Status listTiles(TiffStreamJob& stream) const
    {
        std::vector<std::size_t> next(map_.parts + 1, 0); // checksum of each part
        std::vector<TileRow> rows = tileRows();
        std::vector<std::vector<StreamedTile>> tiles(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const TileRow& row = rows[i];
            forEachTileOfRow(*shared_, row.level, row.row, [&](std::size_t page, std::size_t tile) {
                StreamedTile streamed{.file = static_cast<std::uint32_t>(row.file),
                                      .page = static_cast<std::uint32_t>(page),
                                      .tile = tile,
                                      .checksum = 0,
                                      .is_checked = row.file != 0};
                const std::size_t number = next[row.file]++;
                if (row.file != 0 && number < checksums_[row.file].size()) {
                    streamed.checksum = checksums_[row.file][number];
                }
                tiles[i].push_back(streamed);
            });
        }
        for (std::size_t part = 1; part <= map_.parts; ++part) {
            if (next[part] != checksums_[part].size()) {
                return ofPart(part, kPartSurvey, {ErrorCode::Damaged, "is damaged"});
            }
        }
        std::vector<std::size_t> order(rows.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        if (job_.order == TiledGeoTiffJob::Order::OverviewsFirst) {
            std::stable_sort(order.begin(), order.end(), [&rows](std::size_t a, std::size_t b) {
                return rows[a].level > rows[b].level;
            });
        }
        for (const std::size_t i : order) {
            stream.tiles.insert(stream.tiles.end(), tiles[i].begin(), tiles[i].end());
        }
        return Done{};
    }

    Status publish(const TiffStreamJob& stream)
    {
        const std::string path = is_remote_ ? job_.path : job_.path + ".part";
        if (!is_remote_) {
            if (Status room = checkRoom({.path = job_.path, .bytes = report_.bytes}); !room) {
                return room;
            }
        }
        Result<std::unique_ptr<ByteStream>> to = ByteStream::open(path);
        if (!to) {
            return std::move(to).error();
        }
        Status written = streamTiff(stream, **to, monitor_);
        if (written) {
            written = (*to)->finish();
        }
        if (is_remote_) {
            return written;
        }
        if (!written) {
            removePartFile(path);
            return written;
        }
        std::error_code failure;
        fs::rename(path, job_.path, failure);
        if (failure) {
            return writeError(job_.path, failure.value(), "cannot be written");
        }
        // Of a previous file.
        for (const char* ending : {".aux.xml", ".ovr", ".msk"}) {
            removePartFile(job_.path + ending);
        }
        return Done{};
    }

    Status writeLevels()
    {
        const JobPart writing(monitor_, kStreamEnd, 1.0);
        Result<SourceIdentity> identity = identify(job_.path, OverviewFiles::Counted);
        if (!identity) {
            return std::move(identity).error();
        }
        const LevelFileOf file{
            .key = {.raster = std::move(*identity), .band = 1, .nodata = map_.info.nodata},
            .layout = source_->layout(),
            .scale = map_.scale,
            .mean_blocks_max = map_.mean_blocks_max};
        Status finished =
            finishLevelFile(file, survey_->finish(), *errors_, *level_writer_, monitor_);
        if (!finished) {
            return finished;
        }
        report_.level_path = LevelFile::pathFor(job_.path);
        report_.level_bytes = bytesOnDisk(level_path_);
        return is_remote_ ? upload() : Status(Done{});
    }

    Status upload() const
    {
        constexpr std::uint64_t kPiece = std::uint64_t{1} << 22U;
        const Result<FileBytes> from = FileBytes::open(level_path_);
        Result<std::unique_ptr<ByteStream>> to = ByteStream::open(report_.level_path);
        if (!from || !to) {
            return from ? std::move(to).error() : from.error();
        }
        for (std::uint64_t at = 0; at < from->size(); at += kPiece) {
            const auto bytes = from->read(at, std::min(kPiece, from->size() - at));
            if (!bytes) {
                return bytes.error();
            }
            if (Status written = (*to)->write({bytes->data(), bytes->size()}); !written) {
                return written;
            }
        }
        removePartFile(level_path_);
        return (*to)->finish();
    }

    const PartedMap& map_;
    const JoinJob& job_;
    JoinReport& report_;
    JobMonitor& monitor_;
    std::string shared_path_; // a tiled GeoTIFF with the tiles that parts share
    bool is_remote_;
    std::string level_path_; // on a disk
    OverviewBuilder overviews_;
    OverviewEdges edges_;
    std::optional<TileRowWriter> shared_;
    std::shared_ptr<const GeotiffTileSource> source_; // of the shared tiles
    std::unique_ptr<LevelFileWriter> level_writer_;
    std::optional<LevelSurveyPass> survey_;
    std::optional<LevelErrorPass> errors_;
    std::vector<std::vector<std::uint32_t>> checksums_; // of tiles, by part
    std::vector<std::vector<std::uint32_t>> sizes_;
};

Result<FileLock> lockFile(const std::string& path)
{
    Result<std::optional<FileLock>> lock = FileLock::tryLock(path, FileLock::Kind::Exclusive);
    if (!lock) {
        return std::move(lock).error();
    }
    if (!*lock) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: is held by another program (process {}); wait for it or "
                                 "cancel it there",
                                 path, FileLock::holder(path))};
    }
    return std::move(**lock);
}

} // namespace

Result<JoinReport> joinParts(const OpenRaster& raster, const JoinJob& job, JobMonitor& monitor)
{
    const Result<PartedMap> map =
        partedMap(raster, job.parts, job.folder, job.mean_blocks_max, job.memory);
    if (!map) {
        return map.error();
    }
    for (std::size_t part = 1; part <= job.parts; ++part) {
        const Result<CheckpointReader> state = openPartState(*map, part, kPartSurvey);
        if (!state && state.error().code == ErrorCode::Invalid) {
            return state.error();
        }
    }
    if (const std::vector<std::size_t> missing = missingParts(*map); !missing.empty()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: lacks {} of {} parts: {}; prepare them first", job.folder,
                                 missing.size(), job.parts, fmt::join(missing, ", "))};
    }
    Result<FileLock> held = lockFile((fs::path(job.folder) / "join.lock").string());
    if (!held) {
        return std::move(held).error();
    }
    std::optional<FileLock> lock(std::move(held).value());
    std::optional<FileLock> output_lock;
    if (!remoteNameFor(job.path)) {
        Result<FileLock> output = lockFile(job.path + ".lock");
        if (!output) {
            return std::move(output).error();
        }
        output_lock = std::move(output).value();
    }
    allowOpenFiles(job.parts); // all parts are open at a time
    JoinReport report;
    report.samples = std::uint64_t{map->info.columns} * map->info.rows;
    Join join(*map, job, report, monitor);
    if (Status joined = join.run(); !joined) {
        return std::move(joined).error();
    }
    monitor.report(1.0);
    join.removeParts();
    lock.reset();
    removePartFile(job.folder); // if nothing else is in it
    return report;
}

} // namespace marsview
