#include "core/session/map_opening.h"

#include "core/base/check.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/levels/estimated_levels.h"
#include "core/levels/map_tile_source.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/prepare_map.h"
#include "core/tiles/mean_samples_source.h"
#include "core/tiles/tile_disk_cache.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// An archive may unpack to a thousand times its size, so a large map in one is prepared on disk
// instead of read into memory.
std::uint64_t memoryBytesMax(const OpenRaster& raster, const MapResources& resources)
{
    constexpr std::uint64_t kUnpackedMax = std::uint64_t{1} << 30;
    const std::uint64_t bytes_max = resources.held_bytes_max;
    return isInArchive(raster.file.info().path) ? std::min(bytes_max, kUnpackedMax) : bytes_max;
}

} // namespace

MapOpening::MapOpening(OpenRaster raster, const MapResources& resources)
    : raster_(std::move(raster))
    , resources_(resources)
{}

Result<MapOpening> MapOpening::begin(OpenRaster raster, const MapResources& resources)
{
    if (Status surface = checkIsSurface(raster.spec.path, raster.info); !surface) {
        return std::move(surface).error();
    }
    MapOpening opening(std::move(raster), resources);
    if (Status chosen = opening.choose(); !chosen) {
        return std::move(chosen).error();
    }
    // Notices about the settings are shown with the first map that can be opened.
    if (resources.notices && opening.storage_ != MapStorage::NeedsOverviews) {
        for (std::string& notice : resources.notices->take()) {
            opening.notices_.push_back(std::move(notice));
        }
    }
    return opening;
}

Status MapOpening::choose()
{
    const KeepOpen opening;
    Status chosen = chooseStorage();
    open_files_ = opening.files();
    return chosen;
}

Status MapOpening::chooseStorage()
{
    const bool is_remote = remoteNameFor(raster_.spec.path).has_value();
    const auto in_place = GeotiffTileSource::of(raster_.file, raster_.voids());
    if (in_place) {
        in_place_ = *in_place;
        const Result<bool> has_levels = useAdjacentLevels();
        if (!has_levels) {
            return has_levels.error();
        }
        if (*has_levels || is_remote) {
            storage_ = MapStorage::Tiled;
            return Done{};
        }
    }
    const bool fits = raster_.sampleBytes() <= memoryBytesMax(raster_, resources_);
    if (is_remote) {
        return fits ? Status(Done{}) : Status(in_place.error());
    }
    // A prepared map opens at once, however much memory there is.
    if (usePrepared()) {
        storage_ = MapStorage::Tiled;
    } else if (!fits) {
        storage_ = MapStorage::NeedsOverviews;
    }
    return Done{};
}

// Whether a usable level file exists next to the raster.
Result<bool> MapOpening::useAdjacentLevels()
{
    const std::string& raster_path = raster_.file.info().path;
    const std::string path = LevelFile::pathFor(raster_path);
    Result<RasterLevels> levels = openLevels(path, raster_path, raster_.spec.band, raster_.info);
    if (levels) {
        levels_ = std::move(*levels);
        return true;
    }
    if (levels.error().code == ErrorCode::Damaged) {
        return std::move(levels).error();
    }
    if (levels.error().code != ErrorCode::NotFound) {
        notices_.push_back(notUsed(path, levels.error()));
    }
    return false;
}

// Whether the folder of prepared maps has a level file of this raster: of the raster itself,
// or of a tiled copy.
bool MapOpening::usePrepared()
{
    const MapFolder folder = MapFolder::at(resources_.folder);
    if (resources_.folder.empty() || !folder.hasMaps()) {
        return false; // and the raster need not be identified
    }
    const Result<std::string> path = preparedPathFor(raster_, resources_.folder);
    if (!path || folder.damage(*path)) {
        return false;
    }
    return (in_place_ && usePreparedAt(*path, false)) || usePreparedAt(*path, true);
}

bool MapOpening::usePreparedAt(const std::string& path, bool is_copy)
{
    // Locked before it is read. A folder without permission to write has no locks.
    Result<FileLock> lock = MapFolder::at(resources_.folder).use(path);
    Result<RasterLevels> levels =
        openLevels(LevelFile::pathFor(path), is_copy ? path : raster_.file.info().path,
                   is_copy ? 1 : raster_.spec.band, raster_.info);
    if (!levels) {
        return false;
    }
    levels_ = std::move(*levels);
    prepared_path_ = path;
    is_copy_ = is_copy;
    if (lock) {
        lock_ = std::move(*lock);
    }
    return true;
}

bool MapOpening::isDamageToPrepared(const Error& error) const
{
    return storage_ == MapStorage::Tiled && levels_ && isDamageToKept(error, is_copy_);
}

Status MapOpening::discardPrepared()
{
    if (prepared_path_.empty()) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: its overviews are not in {}", raster_.spec.path,
                                 resources_.folder.string())};
    }
    levels_.reset();
    open_files_.clear();
    lock_.reset();
    const Result<MapFolder> folder = MapFolder::open(resources_.folder);
    return folder ? folder->remove(std::filesystem::path(prepared_path_).filename().string())
                  : Status(folder.error());
}

Result<SampleStatistics> MapOpening::statistics(JobMonitor& monitor)
{
    const bool is_remote = !raster_.info.remote_version.empty();
    if (storage_ == MapStorage::Tiled) {
        Result<Tiles> tiles = openTiles(monitor);
        if (tiles) {
            return tiles->levels->statistics;
        }
        if (is_remote) {
            return std::move(tiles).error(); // it is not to be fetched whole
        }
    }
    return raster_.file.scan(monitor, raster_.voids());
}

Result<std::shared_ptr<const Map>> MapOpening::finish(JobMonitor& monitor)
{
    MARSVIEW_CHECK(storage_ != MapStorage::NeedsOverviews);
    if (storage_ == MapStorage::Tiled) {
        return finishTiled(monitor);
    }
    std::vector<std::string>& notices = raster_.info.notices;
    notices.insert(notices.end(), notices_.begin(), notices_.end());
    return readMap(std::move(raster_), monitor, defaultMemoryBudget());
}

Result<std::shared_ptr<const Map>> MapOpening::finishTiled(JobMonitor& monitor)
{
    Result<Tiles> opened = openTiles(monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    const SampleStatistics& statistics = opened->levels->statistics;
    if (!statistics.hasSamples()) {
        return noElevations(raster_.spec.path, statistics);
    }
    RasterInfo info = raster_.info;
    info.notices.insert(info.notices.end(), notices_.begin(), notices_.end());
    if (isEstimated()) {
        info.notices.push_back(notices_.empty()
                                   ? "its detail is estimated because it has no level file"
                                   : "its detail is estimated");
    }
    if (!prepared_path_.empty()) {
        opened->source = keptSource(opened->source, {.folder = MapFolder::at(resources_.folder),
                                                     .path = prepared_path_,
                                                     .lock = std::exchange(lock_, std::nullopt),
                                                     .is_copy = is_copy_});
    }
    Result<std::shared_ptr<const TiledSamples>> tiles =
        TiledSamples::open(TiledRaster(*resources_.tiles, opened->source));
    if (!tiles) {
        return std::move(tiles).error();
    }
    constexpr double kOpened = 0.5;
    monitor.report(kOpened);
    const ElevationScale scale = info.elevationScale();
    return tiledMap({.spec = raster_.spec,
                     .file_info = raster_.file.info(),
                     .info = std::move(info),
                     .statistics = statistics,
                     .heightfield = Heightfield(std::move(*tiles), statistics, scale)},
                    opened->levels);
}

// The raster that tiles are read from: the user's, or a copy in the folder of prepared maps.
Result<std::shared_ptr<const GeotiffTileSource>> MapOpening::tiledRaster() const
{
    if (!is_copy_) {
        return in_place_;
    }
    const Result<RasterFile> copy = RasterFile::open(prepared_path_);
    if (!copy) {
        return copy.error();
    }
    return GeotiffTileSource::of(*copy, raster_.voids());
}

Result<MapOpening::Tiles> MapOpening::openTiles(JobMonitor& monitor) const
{
    return levels_ ? tilesWithLevels() : estimatedTiles(monitor);
}

Result<MapOpening::Tiles> MapOpening::tilesWithLevels() const
{
    const Result<std::shared_ptr<const GeotiffTileSource>> raster = tiledRaster();
    if (!raster) {
        return raster.error();
    }
    const ElevationScale scale = raster_.info.elevationScale();
    Result<MapLevels> levels = levels_->file.readLevels(scale);
    if (!levels) {
        return std::move(levels).error();
    }
    const std::string remedy = is_copy_ ? "open the map again to rebuild it"
                                        : remedyFor(raster_.file.info().path, levels_->path);
    TileLayout layout = (*raster)->layout();
    layout.has_voids = levels->statistics.void_count > 0;
    // GDAL may decode a damaged tile to other samples without an error.
    auto source = mapTileSource({.raster = (*raster)->checkedBy(levels->checksums, remedy),
                                 .level_path = levels_->path,
                                 .level_key = levels_->key,
                                 .analysis = levels->analysis,
                                 .scale = scale,
                                 .layout = layout});
    return Tiles{.source = cachedTiles(std::move(source), "map"),
                 .levels = std::make_shared<const MapLevels>(std::move(*levels))};
}

// From the overviews of a raster without a level file.
Result<MapOpening::Tiles> MapOpening::estimatedTiles(JobMonitor& monitor) const
{
    const std::shared_ptr<const TileSource> raster = cachedTiles(in_place_, "raster");
    const ElevationScale scale = raster_.info.elevationScale();
    Result<MapLevels> levels = estimateLevels(*raster, scale, monitor);
    if (!levels) {
        return std::move(levels).error();
    }
    auto source = mapTileSource({.raster = samplesFromMeans(raster),
                                 .level_path = std::nullopt,
                                 .level_key = {},
                                 .analysis = levels->analysis,
                                 .scale = scale,
                                 .layout = raster->layout()});
    return Tiles{.source = std::move(source),
                 .levels = std::make_shared<const MapLevels>(std::move(*levels))};
}

// Tiles from a server that names versions are cached on disk. `what` distinguishes tiles of the
// raster from those of the map.
std::shared_ptr<const TileSource> MapOpening::cachedTiles(std::shared_ptr<const TileSource> source,
                                                          const char* what) const
{
    const RasterInfo& info = raster_.info;
    if (!resources_.fetched_tiles || !info.has_named_version) {
        return source;
    }
    const ElevationScale scale = info.elevationScale();
    const std::string key =
        fmt::format("{}\n{}\nband {}\n{}\ngain {} offset {}\n{}", info.path, info.remote_version,
                    info.band, info.voidSettings(), scale.gain, scale.offset_m, what);
    return cachedOnDisk(std::move(source), resources_.fetched_tiles, key);
}

} // namespace marsview
