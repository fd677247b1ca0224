#include "core/session/prepare_map.h"

#include "core/base/file_lock.h"
#include "core/raster/geotiff_tile_source.h"
#include "core/raster/map_folder.h"
#include "core/raster/raster_file.h"
#include "core/raster/source_identity.h"
#include "core/terrain/level_file.h"

#include <chrono>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// Of the whole work, as measured on a map of 268 million samples.
constexpr double kCopyingShare = 0.7;

constexpr std::chrono::milliseconds kLockPoll{100};

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
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
                         fmt::format("{}: is being made by another program (process {}); wait for "
                                     "it or stop it there",
                                     level_path, FileLock::holder(path))};
        }
        if (monitor.isCancelled()) {
            return Error{ErrorCode::Cancelled, "cancelled"};
        }
        std::this_thread::sleep_for(kLockPoll);
    }
}

Status makeLevels(const PrepareJob& job,
                  PrepareReport& report,
                  const RasterInfo& info,
                  JobMonitor& monitor)
{
    const int band = report.is_source_used ? job.spec.band : 1;
    Result<FileLock> lock = lockFor(report.level_path, job.when_busy, monitor);
    if (!lock) {
        return std::move(lock).error();
    }
    Result<SourceIdentity> identity = identify(report.raster_path);
    if (!identity) {
        return std::move(identity).error();
    }
    const LevelFileKey key{.raster = *identity, .band = band, .nodata = info.nodata};
    const Result<LevelFile> there = LevelFile::open(report.level_path, key);
    if (there) {
        return Done{};
    }
    if (there.error().code != ErrorCode::NotFound) {
        const std::string& why = there.error().message;
        report.notes.push_back(why.substr(0, why.rfind(';')) + "; it is made anew");
    }
    Result<RasterFile> raster = RasterFile::open(report.raster_path, band);
    if (!raster) {
        return std::move(raster).error();
    }
    const auto source = GeotiffTileSource::of(*raster, {info.nodata});
    if (!source) {
        return source.error();
    }
    const LevelBuild build{.source = source->get(),
                           .scale = info.elevationScale(),
                           .key = key,
                           .path = report.level_path,
                           .checkpoint_interval = job.checkpoint_interval};
    if (Status built = buildLevelFile(build, monitor); !built) {
        return built;
    }
    const Result<SourceIdentity> now = identify(report.raster_path);
    if (!now || !isSameContent(*identity, *now)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: changed while it was being prepared; prepare it again when "
                                 "it is finished",
                                 report.raster_path)};
    }
    return Done{};
}

} // namespace

Result<bool> canBeUsedInPlace(const DatasetSpec& spec)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    const std::optional<double> nodata =
        spec.overrides.nodata ? spec.overrides.nodata : file->info().nodata;
    return GeotiffTileSource::of(*file, {nodata}).has_value();
}

Result<std::string> preparedPathFor(const DatasetSpec& spec, const std::filesystem::path& folder)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    Result<MapFolder> maps = MapFolder::open(folder);
    if (!maps) {
        return std::move(maps).error();
    }
    const Result<SourceIdentity> identity = identify(file->info().path);
    if (!identity) {
        return identity.error();
    }
    // What decides about the content beside the source itself.
    const std::optional<double> nodata =
        spec.overrides.nodata ? spec.overrides.nodata : file->info().nodata;
    return maps->pathFor(*identity, spec.band,
                         nodata ? fmt::format("nodata {}", *nodata) : std::string());
}

Result<PrepareReport> prepareMapFiles(const PrepareJob& job, JobMonitor& monitor)
{
    Result<RasterFile> file = RasterFile::open(job.spec.path, job.spec.band);
    if (!file) {
        return std::move(file).error();
    }
    Result<RasterInfo> info = withOverrides(file->info(), job.spec.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", job.spec.path, info.error().message)};
    }
    PrepareReport report;
    report.is_source_used = job.raster_path.empty();
    report.raster_path = report.is_source_used ? info->path : job.raster_path;
    report.level_path =
        job.level_path.empty() ? LevelFile::pathFor(report.raster_path) : job.level_path;
    report.samples = std::uint64_t{info->columns} * info->rows;
    const Clock::time_point start = Clock::now();
    if (!report.is_source_used) {
        const JobPart copying(monitor, 0.0, kCopyingShare);
        TiledGeoTiffJob copy;
        copy.source = job.spec.path;
        copy.band = job.spec.band;
        copy.overrides = job.spec.overrides;
        copy.path = job.raster_path;
        copy.when_busy = job.when_busy;
        copy.checkpoint_interval = job.checkpoint_interval;
        Result<TiledGeoTiffReport> copied = writeTiledGeoTiff(copy, monitor);
        if (!copied) {
            return std::move(copied).error();
        }
        report.copy = std::move(*copied);
        report.copy_seconds = secondsSince(start);
    }
    const Clock::time_point between = Clock::now();
    const JobPart measuring(monitor, report.is_source_used ? 0.0 : kCopyingShare, 1.0);
    if (Status made = makeLevels(job, report, *info, monitor); !made) {
        return std::move(made).error();
    }
    report.level_seconds = secondsSince(between);
    report.notes.insert(report.notes.begin(), report.copy.notes.begin(), report.copy.notes.end());
    return report;
}

} // namespace marsview
