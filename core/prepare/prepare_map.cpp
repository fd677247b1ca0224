#include "core/prepare/prepare_map.h"

#include "core/base/elapsed.h"
#include "core/base/file_lock.h"
#include "core/files/remote_raster.h"
#include "core/files/shared_file.h"
#include "core/levels/level_file.h"
#include "core/prepare/disk_room.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/level_builder.h"
#include "core/prepare/map_damage.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/overview_builder.h"
#include "core/raster/raster_file.h"
#include "core/sources/source_identity.h"
#include "core/sources/source_stamp.h"
#include "core/tiles/geotiff_tile_source.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// Of the whole work, as measured on a map of 268 million samples.
constexpr double kCopyingShare = 0.7;

constexpr std::chrono::milliseconds kLockPoll{100};

// An upper bound, before the raster is tiled.
std::uint64_t levelBytesFor(const RasterInfo& info)
{
    return levelFileBytesMax({.columns = info.columns,
                              .rows = info.rows,
                              .type = info.type,
                              .has_voids = info.needsVoidMask() || info.nodata.has_value() ||
                                           info.type == SampleType::Float32 ||
                                           info.type == SampleType::Float64,
                              .mean_levels = overviewCount(info.columns, info.rows)});
}

// Removes the least recently used maps.
void makeRoomFor(const RasterInfo& info,
                 const PrepareJob& job,
                 const MapFolder& folder,
                 const std::string& kept)
{
    const bool is_copy_there =
        job.when_there != PrepareJob::WhenThere::Replace && fileExists(job.raster_path);
    std::uint64_t bytes = fileExists(job.level_path) ? 0 : levelBytesFor(info);
    if (!job.raster_path.empty() && !is_copy_there) {
        const std::uint64_t copy = tiledGeoTiffBytesMax(info);
        bytes += copy - std::min(copy, bytesOnDisk(job.raster_path + ".part"));
    }
    static_cast<void>(folder.makeRoom(bytes, kept)); // writing reports missing space
}

// So that two programs do not write the same level file.
Result<FileLock>
lockFor(const std::string& level_path, TiledGeoTiffJob::WhenBusy when_busy, JobMonitor& monitor)
{
    const std::string path = level_path + ".lock";
    while (true) {
        Result<std::optional<FileLock>> lock = FileLock::tryLock(path, FileLock::Kind::Exclusive);
        if (!lock) {
            return std::move(lock).error();
        }
        if (*lock) {
            return std::move(**lock);
        }
        if (when_busy == TiledGeoTiffJob::WhenBusy::Fail) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: is being built by another program (process {}); wait for "
                                     "it or cancel it there",
                                     level_path, FileLock::holder(path))};
        }
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        std::this_thread::sleep_for(kLockPoll);
    }
}

// The input of makeLevels().
struct LevelWork {
    std::string raster_path;
    std::string level_path;
    int band = 1;
    RasterInfo info;
    std::shared_ptr<const GeotiffTileSource> source;
    LevelFileKey key;
    SourceStamp stamp; // of the raster, taken before it was read
};

Result<LevelWork> levelWork(const OpenRaster& source, const PrepareReport& report)
{
    const RasterInfo& info = source.info;
    const KeepOpen opening; // what the tile source keeps open
    LevelWork work{.raster_path = report.raster_path,
                   .level_path = report.level_path,
                   .band = report.is_source_used ? source.spec.band : 1,
                   .info = info,
                   .source = nullptr,
                   .key = {},
                   .stamp = stampOf(report.raster_path)};
    Result<SourceIdentity> identity = identify(work.raster_path, OverviewFiles::Counted);
    if (!identity) {
        return std::move(identity).error();
    }
    work.key = {.raster = std::move(*identity), .band = work.band, .nodata = info.nodata};
    if (report.is_source_used) {
        auto tiles = GeotiffTileSource::of(source.file, source.voids());
        if (!tiles) {
            return std::move(tiles).error();
        }
        work.source = std::move(*tiles);
        return work;
    }
    Result<RasterFile> copy = RasterFile::open(work.raster_path, work.band);
    if (!copy) {
        return std::move(copy).error();
    }
    auto tiles = GeotiffTileSource::of(*copy, source.voids());
    if (!tiles) {
        return std::move(tiles).error();
    }
    work.source = std::move(*tiles);
    return work;
}

std::string withoutRemedy(const std::string& sentence)
{
    return sentence.substr(0, sentence.rfind(';'));
}

Status makeLevels(const OpenRaster& raster,
                  const PrepareJob& job,
                  PrepareReport& report,
                  JobMonitor& monitor)
{
    Result<FileLock> lock = lockFor(report.level_path, job.when_busy, monitor);
    if (!lock) {
        return std::move(lock).error();
    }
    const Result<LevelWork> work = levelWork(raster, report);
    if (!work) {
        return work.error();
    }
    if (job.when_there != PrepareJob::WhenThere::Replace) {
        const Result<LevelFile> there = LevelFile::open(report.level_path, work->key);
        if (there) {
            report.are_levels_there = true;
            return Done{};
        }
        if (there.error().code == ErrorCode::Damaged && job.raster_path.empty()) {
            return there.error(); // a new level file would certify damaged samples
        }
        if (there.error().code != ErrorCode::NotFound) {
            report.notes.push_back(withoutRemedy(there.error().message) + "; it is rebuilt");
        }
    }
    const LevelBuild build{
        .source = work->source.get(),
        .scale = raster.info.elevationScale(),
        .key = work->key,
        .path = report.level_path,
        .confirm = [&work]() -> Status {
            const Result<SourceIdentity> now = identify(work->raster_path, OverviewFiles::Counted);
            if (now && isSameContent(work->key.raster, *now) && isUntouched(work->stamp)) {
                return Done{};
            }
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: changed while it was being prepared; prepare it again "
                                     "when no program writes to it",
                                     work->raster_path)};
        },
        .checkpoint_interval = job.checkpoint_interval};
    return buildLevelFile(build, monitor);
}

// The open files of an existing copy, or an error if its level file cannot be used or, without a
// level file, if the copy is not a complete tiled GeoTIFF.
Result<OpenFiles> checkKnown(const OpenRaster& raster, const PrepareReport& report)
{
    const KeepOpen opening;
    const Result<LevelWork> work = levelWork(raster, report);
    if (!work) {
        return work.error();
    }
    const Result<LevelFile> levels = LevelFile::open(report.level_path, work->key);
    if (!levels && levels.error().code == ErrorCode::NotFound) {
        return isWholeTiledGeoTiff(report.raster_path)
                   ? Result<OpenFiles>(opening.files())
                   : Result<OpenFiles>(
                         Error{ErrorCode::Unreadable, report.raster_path + ": is damaged"});
    }
    return levels ? Result<OpenFiles>(opening.files()) : Result<OpenFiles>(levels.error());
}

// Returns the open files of a copy that is used as it is.
Result<OpenFiles> makeCopy(const OpenRaster& raster,
                           const PrepareJob& job,
                           PrepareReport& report,
                           JobMonitor& monitor)
{
    const Clock::time_point start = Clock::now();
    const JobPart copying(monitor, 0.0, kCopyingShare);
    TiledGeoTiffJob copy;
    copy.source = raster.spec.path;
    copy.band = raster.spec.band;
    copy.overrides = raster.spec.overrides;
    copy.path = job.raster_path;
    copy.when_busy = job.when_busy;
    copy.when_there = job.when_there == PrepareJob::WhenThere::Replace
                          ? TiledGeoTiffJob::WhenThere::Replace
                          : TiledGeoTiffJob::WhenThere::Keep;
    copy.order = job.order;
    copy.bytes_after = levelBytesFor(raster.info);
    copy.checkpoint_interval = job.checkpoint_interval;
    Result<TiledGeoTiffReport> copied = writeTiledGeoTiff(copy, monitor);
    OpenFiles files;
    if (copied && copied->is_there) {
        if (Result<OpenFiles> known = checkKnown(raster, report)) {
            files = std::move(*known);
        } else {
            copy.when_there = TiledGeoTiffJob::WhenThere::Replace;
            copied = writeTiledGeoTiff(copy, monitor);
            report.notes.push_back(
                fmt::format("{}: cannot be verified; it is rebuilt", report.raster_path));
        }
    }
    if (!copied) {
        return std::move(copied).error();
    }
    report.copy = std::move(*copied);
    report.notes.insert(report.notes.end(), report.copy.notes.begin(), report.copy.notes.end());
    report.copy_seconds += secondsSince(start);
    return files;
}

Status
measure(const OpenRaster& raster, const PrepareJob& job, PrepareReport& report, JobMonitor& monitor)
{
    const Clock::time_point start = Clock::now();
    const JobPart measuring(monitor, report.is_source_used ? 0.0 : kCopyingShare, 1.0);
    Status made = makeLevels(raster, job, report, monitor);
    report.level_seconds += secondsSince(start);
    return made;
}

Status makeFiles(const OpenRaster& raster,
                 const PrepareJob& job,
                 PrepareReport& report,
                 JobMonitor& monitor)
{
    if (report.is_source_used) {
        return measure(raster, job, report, monitor);
    }
    Result<OpenFiles> copied = makeCopy(raster, job, report, monitor);
    if (!copied) {
        return std::move(copied).error();
    }
    Status made = measure(raster, job, report, monitor);
    if (made || made.error().code == ErrorCode::Canceled ||
        made.error().code == ErrorCode::TooLarge || isWholeTiledGeoTiff(report.raster_path)) {
        return made;
    }
    // The file there is makeCopy()'s own copy, which has been damaged since. Open, it would occupy
    // the disk.
    copied->clear();
    std::error_code ignored;
    std::filesystem::remove(report.raster_path, ignored);
    report.notes.push_back(
        fmt::format("{}: was damaged during preparation; it is rebuilt", report.raster_path));
    PrepareJob again = job;
    again.when_there = PrepareJob::WhenThere::Replace;
    copied = makeCopy(raster, again, report, monitor);
    return copied ? measure(raster, again, report, monitor) : Status(copied.error());
}

// Compares existing files with their checksums.
Result<std::optional<MapDamage>>
damageTo(const OpenRaster& raster, const PrepareReport& report, JobMonitor& monitor)
{
    const Result<LevelWork> work = levelWork(raster, report);
    if (!work) {
        return work.error();
    }
    return findDamage({.raster = work->source.get(),
                       .level_path = report.level_path,
                       .level_key = work->key,
                       .remedy = remedyFor(report.raster_path, report.level_path)},
                      monitor);
}

} // namespace

Status checkIsLocal(const RasterSpec& spec)
{
    if (!remoteNameFor(spec.path)) {
        return Done{};
    }
    return Error{ErrorCode::Unsupported,
                 fmt::format("{}: is on a server, where no file can be written next to it, and is "
                             "read directly; name a file to copy it to",
                             spec.path)};
}

bool canBeUsedInPlace(const OpenRaster& raster)
{
    return GeotiffTileSource::of(raster.file, raster.voids()).has_value();
}

Result<std::string> preparedPathFor(const OpenRaster& raster, const std::filesystem::path& folder)
{
    if (folder.empty()) {
        return Error{ErrorCode::NotFound,
                     raster.spec.path + ": cannot be prepared without a folder for prepared maps"};
    }
    const Result<SourceIdentity> identity = identify(raster.file.info().path);
    if (!identity) {
        return identity.error();
    }
    return MapFolder::at(folder).pathFor(*identity, raster.spec.band, raster.info.voidSettings());
}

Result<PrepareReport>
prepareMapFiles(const OpenRaster& raster, const PrepareJob& job, JobMonitor& monitor)
{
    const RasterInfo& info = raster.info;
    if (Status surface = checkIsSurface(raster.spec.path, info); !surface) {
        return std::move(surface).error();
    }
    PrepareReport report;
    report.is_source_used = job.raster_path.empty();
    report.raster_path = report.is_source_used ? info.path : job.raster_path;
    report.level_path =
        job.level_path.empty() ? LevelFile::pathFor(report.raster_path) : job.level_path;
    report.samples = std::uint64_t{info.columns} * info.rows;
    const std::string& written_next_to =
        report.is_source_used ? raster.spec.path : report.raster_path;
    if (Status local = checkIsLocal({.path = written_next_to}); !local) {
        return std::move(local).error();
    }
    if (Status made = makeFiles(raster, job, report, monitor); !made) {
        return std::move(made).error();
    }
    const bool was_there =
        report.are_levels_there && (report.is_source_used || report.copy.is_there);
    if (job.when_there != PrepareJob::WhenThere::Check || !was_there) {
        return report;
    }
    const Clock::time_point start = Clock::now();
    const Result<std::optional<MapDamage>> damage = damageTo(raster, report, monitor);
    report.check_seconds = secondsSince(start);
    if (!damage) {
        return damage.error();
    }
    if (!*damage) {
        if (report.notes.empty()) {
            report.notes.push_back(fmt::format("{}: is already prepared", report.raster_path));
        }
        report.notes.back() += "; all tiles are intact";
        return report;
    }
    const Error& what = (*damage)->error;
    const bool is_raster = (*damage)->of == MapDamage::Of::Raster;
    if (is_raster && report.is_source_used) {
        return what;
    }
    report.notes = {withoutRemedy(what.message) + "; it is rebuilt"};
    PrepareJob again = job;
    again.when_there = PrepareJob::WhenThere::Replace;
    // The copy is kept if only its levels are damaged.
    Status made = is_raster ? makeFiles(raster, again, report, monitor)
                            : makeLevels(raster, again, report, monitor);
    return made ? Result<PrepareReport>(std::move(report))
                : Result<PrepareReport>(std::move(made).error());
}

Result<PrepareReport>
prepareInFolder(const OpenRaster& raster, const FolderJob& job, JobMonitor& monitor)
{
    if (Status local = checkIsLocal(raster.spec); !local) {
        return std::move(local).error();
    }
    const Result<MapFolder> folder = MapFolder::open(job.folder);
    if (!folder) {
        return folder.error();
    }
    const Result<std::string> kept = preparedPathFor(raster, job.folder);
    if (!kept) {
        return kept.error();
    }
    const bool in_place = canBeUsedInPlace(raster);
    const std::string name = std::filesystem::path(*kept).filename().string();
    PrepareJob prepare{.raster_path = in_place ? std::string() : *kept,
                       .level_path = LevelFile::pathFor(*kept),
                       .when_busy = job.when_busy,
                       .when_there = job.when_there,
                       .checkpoint_interval = job.checkpoint_interval};
    const std::optional<std::string> damage = folder->damage(*kept);
    if (damage) {
        // If a program has it open, it is not removed but replaced.
        static_cast<void>(folder->remove(name));
        prepare.when_there = PrepareJob::WhenThere::Replace;
    }
    const bool is_copy_there = !in_place && fileExists(*kept);
    makeRoomFor(raster.info, prepare, *folder, *kept);
    Result<PrepareReport> prepared = prepareMapFiles(raster, prepare, monitor);
    // An existing copy is not rebuilt, so the error is in that copy.
    if (!prepared && is_copy_there && prepared.error().code != ErrorCode::Canceled &&
        prepared.error().code != ErrorCode::TooLarge && folder->remove(name)) {
        prepared = prepareMapFiles(raster, prepare, monitor);
    }
    if (!prepared) {
        return prepared;
    }
    if (damage) {
        folder->forgetDamage(*kept);
        prepared->notes.insert(prepared->notes.begin(), withoutRemedy(*damage) + "; rebuilt");
    }
    // Only now, so that no map is removed for one that could not be prepared.
    const std::uint64_t bytes_max =
        job.folder_bytes_max != 0 ? job.folder_bytes_max : folder->defaultBytesMax();
    const Result<FileLock> in_use = folder->use(*kept);
    static_cast<void>(folder->trim(bytes_max)); // files that cannot be removed stay
    return prepared;
}

std::string remedyFor(const std::string& raster_path, const std::string& level_path)
{
    if (const std::string source = readGeoTiffOrigin(raster_path).source; !source.empty()) {
        return fmt::format("prepare it again from {}", source);
    }
    return fmt::format(
        "restore or fetch it again or, if it is correct as it is, remove {} and prepare "
        "the map again",
        level_path);
}

} // namespace marsview
