#include "core/session/open_map.h"

#include "core/base/check.h"
#include "core/base/environment.h"
#include "core/base/file_lock.h"
#include "core/base/plain_number.h"
#include "core/raster/geotiff_tile_source.h"
#include "core/raster/map_folder.h"
#include "core/raster/mean_samples_source.h"
#include "core/raster/raster_file.h"
#include "core/raster/remote_raster.h"
#include "core/raster/source_identity.h"
#include "core/raster/tile_disk_cache.h"
#include "core/raster/tiled_geotiff.h"
#include "core/session/prepare_map.h"
#include "core/terrain/estimated_levels.h"
#include "core/terrain/level_file.h"
#include "core/terrain/map_tile_source.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace marsview {
namespace {

// A file with the description that the user gave it.
struct Described {
    RasterFile file;
    RasterInfo file_info;
    RasterInfo info;

    std::uint64_t bytes() const
    {
        return std::uint64_t{info.columns} * info.rows * sampleBytes(info.type);
    }
    VoidRule voids() const { return {info.nodata}; }
};

Result<Described> describe(const DatasetSpec& spec)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    RasterInfo file_info = file->info();
    Result<RasterInfo> info = withOverrides(file_info, spec.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", spec.path, info.error().message)};
    }
    return Described{std::move(*file), std::move(file_info), std::move(*info)};
}

// What decides about the content of a prepared map beside the source itself.
std::string settingsOf(const RasterInfo& info)
{
    return info.nodata ? fmt::format("nodata {}", *info.nodata) : std::string();
}

Result<LevelFileKey> keyOf(const std::string& raster_path, int band, const RasterInfo& info)
{
    Result<SourceIdentity> identity = identify(raster_path);
    if (!identity) {
        return std::move(identity).error();
    }
    return LevelFileKey{.raster = std::move(*identity), .band = band, .nodata = info.nodata};
}

// Whether the file is there and belongs to the raster. Only then is the raster looked at, which at
// a server takes a dozen requests.
bool hasLevels(const std::string& level_path,
               const std::string& raster_path,
               int band,
               const RasterInfo& info)
{
    if (!fileExists(level_path)) {
        return false;
    }
    const Result<LevelFileKey> key = keyOf(raster_path, band, info);
    return key && LevelFile::open(level_path, *key);
}

// A prepared copy has one band.
int bandOf(const DatasetSpec& spec, const std::string& raster_path, const RasterInfo& info)
{
    return raster_path == info.path ? spec.band : 1;
}

std::size_t megabytesFrom(const char* variable, std::size_t otherwise)
{
    constexpr double kMost = 1e9;
    const std::optional<double> megabytes = parseNumber(environmentVariable(variable));
    return megabytes && *megabytes >= 0.0 && *megabytes <= kMost
               ? static_cast<std::size_t>(*megabytes * 0x1p20)
               : otherwise;
}

Result<LoadedMap> openHeld(const DatasetSpec& spec, JobMonitor& monitor)
{
    // Shares as measured on a map of 34 million samples.
    monitor.beginStage(0.0, 0.6);
    auto dataset = loadDataset(spec, monitor, defaultMemoryBudget());
    if (!dataset) {
        return std::move(dataset).error();
    }
    const JobPart measuring(monitor, 0.6, 1.0);
    return prepareMap(std::move(dataset).value(), monitor);
}

// What comes from a server that names versions is kept on disk. `what` tells tiles of the raster
// from those of the map.
std::shared_ptr<const TileSource> keptOnDisk(std::shared_ptr<const TileSource> source,
                                             const MapResources& resources,
                                             const RasterInfo& info,
                                             const char* what)
{
    if (!resources.fetched_tiles || !info.has_named_version) {
        return source;
    }
    const ElevationScale scale = info.elevationScale();
    const std::string key =
        fmt::format("{}\n{}\nband {}\n{}\ngain {} offset {}\n{}", info.path, info.remote_version,
                    info.band, settingsOf(info), scale.gain, scale.offset_m, what);
    return cachedOnDisk(std::move(source), resources.fetched_tiles, key);
}

// All tiles of a map, and what is known of it as a whole.
struct OpenedTiles {
    std::shared_ptr<const TileSource> source;
    std::shared_ptr<const MapLevels> levels;
};

Result<OpenedTiles> openWithLevels(const std::shared_ptr<const GeotiffTileSource>& raster,
                                   const std::string& level_path,
                                   int band,
                                   const RasterInfo& info)
{
    Result<LevelFileKey> key = keyOf(raster->name(), band, info);
    if (!key) {
        return std::move(key).error();
    }
    Result<LevelFile> file = LevelFile::open(level_path, *key);
    if (!file) {
        return std::move(file).error();
    }
    const ElevationScale scale = info.elevationScale();
    Result<MapLevels> levels = file->readLevels(scale);
    if (!levels) {
        return std::move(levels).error();
    }
    TileLayout layout = raster->layout();
    layout.has_voids = levels->statistics.void_count > 0;
    OpenedTiles opened;
    // Of a damaged tile GDAL may decode other samples without a word.
    opened.source = mapTileSource({.raster = raster->checkedBy(levels->checksums),
                                   .level_path = level_path,
                                   .level_key = std::move(*key),
                                   .analysis = levels->analysis,
                                   .scale = scale,
                                   .layout = layout});
    opened.levels = std::make_shared<const MapLevels>(std::move(*levels));
    return opened;
}

// From the overviews of a raster that nobody has prepared.
Result<OpenedTiles> openWithoutLevels(const std::shared_ptr<const TileSource>& raster,
                                      const RasterInfo& info,
                                      JobMonitor& monitor)
{
    const ElevationScale scale = info.elevationScale();
    Result<MapLevels> levels = estimateLevels(*raster, scale, monitor);
    if (!levels) {
        return std::move(levels).error();
    }
    OpenedTiles opened;
    opened.source = mapTileSource({.raster = samplesFromMeans(raster),
                                   .level_path = std::nullopt,
                                   .level_key = {},
                                   .analysis = levels->analysis,
                                   .scale = scale,
                                   .layout = raster->layout()});
    opened.levels = std::make_shared<const MapLevels>(std::move(*levels));
    return opened;
}

// A source together with what keeps its files from being removed.
struct SourceInUse {
    std::shared_ptr<const TileSource> source;
    FileLock lock;
};

// The prepared map that a level file belongs to.
std::string keptPathOf(const std::string& level_path)
{
    return level_path.substr(0, level_path.size() - LevelFile::pathFor("").size());
}

// What lies in the folder of prepared maps stays there as long as it is open.
void keepInUse(const OpenPlan& plan, const MapResources& resources, OpenedTiles& opened)
{
    Result<MapFolder> folder = MapFolder::open(resources.folder);
    std::error_code failure;
    if (!folder || !plan.level_path ||
        !std::filesystem::equivalent(std::filesystem::path(*plan.level_path).parent_path(),
                                     resources.folder, failure)) {
        return; // it lies elsewhere: nobody removes it
    }
    Result<FileLock> lock = folder->use(keptPathOf(*plan.level_path));
    if (!lock) {
        return;
    }
    const auto in_use =
        std::make_shared<const SourceInUse>(SourceInUse{opened.source, std::move(*lock)});
    opened.source = std::shared_ptr<const TileSource>(in_use, in_use->source.get());
}

} // namespace

MapResources defaultMapResources()
{
    const std::size_t quarter = defaultMemoryBudget() / 2;
    MapResources resources;
    resources.held_bytes_max = megabytesFrom("MARSVIEW_HELD_MB", quarter);
    resources.tiles = std::make_shared<TileCache>(
        TileCacheOptions{.bytes_max = megabytesFrom("MARSVIEW_CACHE_MB", quarter),
                         .loader_threads = std::max(2U, std::thread::hardware_concurrency())});
    resources.folder = MapFolder::defaultPath();
    resources.fetched_tiles = std::make_shared<TileDiskCache>(
        TileDiskCacheOptions{.folder = (resources.folder / "fetched").string()});
    return resources;
}

Result<OpenPlan> planOpening(const DatasetSpec& spec, const MapResources& resources)
{
    Result<Described> map = describe(spec);
    if (!map) {
        return std::move(map).error();
    }
    const bool is_remote = remoteNameFor(spec.path).has_value();
    const bool fits = map->bytes() <= resources.held_bytes_max;
    const std::string& raster_path = map->file_info.path;
    const auto in_place = GeotiffTileSource::of(map->file, map->voids());
    if (in_place) {
        if (const std::string beside = LevelFile::pathFor(raster_path);
            hasLevels(beside, raster_path, spec.band, map->info)) {
            return OpenPlan{MapStore::Tiled, raster_path, beside};
        }
        if (is_remote) {
            return OpenPlan{MapStore::Tiled, raster_path, std::nullopt};
        }
        const Result<std::string> kept = preparedPathFor(spec, resources.folder);
        if (kept && hasLevels(LevelFile::pathFor(*kept), raster_path, spec.band, map->info)) {
            return OpenPlan{MapStore::Tiled, raster_path, LevelFile::pathFor(*kept)};
        }
    }
    if (is_remote) {
        return fits ? Result<OpenPlan>(OpenPlan{}) : in_place.error(); // says what to do
    }
    // What was prepared opens at once, however much memory there is. No folder is made just to
    // look.
    if (std::error_code error; std::filesystem::is_directory(resources.folder, error)) {
        const Result<std::string> copy = preparedPathFor(spec, resources.folder);
        if (copy && hasLevels(LevelFile::pathFor(*copy), *copy, 1, map->info)) {
            return OpenPlan{MapStore::Tiled, *copy, LevelFile::pathFor(*copy)};
        }
    }
    if (fits) {
        return OpenPlan{};
    }
    return OpenPlan{.store = MapStore::Unprepared, .raster_path = {}, .level_path = {}};
}

Status
prepareForOpening(const DatasetSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    Result<Described> map = describe(spec);
    if (!map) {
        return std::move(map).error();
    }
    Result<MapFolder> folder = MapFolder::open(resources.folder);
    if (!folder) {
        return std::move(folder).error();
    }
    const Result<std::string> kept = preparedPathFor(spec, resources.folder);
    if (!kept) {
        return kept.error();
    }
    const bool is_in_place = GeotiffTileSource::of(map->file, map->voids()).has_value();
    const PrepareJob job{.spec = spec,
                         .raster_path = is_in_place ? std::string() : *kept,
                         .level_path = LevelFile::pathFor(*kept),
                         .when_busy = TiledGeoTiffJob::WhenBusy::Wait};
    const bool is_copy_there = !is_in_place && fileExists(*kept);
    Result<PrepareReport> prepared = prepareMapFiles(job, monitor);
    // A copy that was there is not made again, and then it is what cannot be read.
    if (!prepared && is_copy_there && prepared.error().code != ErrorCode::Cancelled &&
        folder->remove(std::filesystem::path(*kept).filename().string())) {
        prepared = prepareMapFiles(job, monitor);
    }
    if (!prepared) {
        return prepared.error();
    }
    // Only now, so that nothing is given up for a map that could not be made.
    const std::uint64_t bytes_max =
        resources.folder_bytes_max != 0 ? resources.folder_bytes_max : folder->defaultBytesMax();
    const Result<FileLock> in_use = folder->use(*kept);
    static_cast<void>(folder->trim(bytes_max)); // what cannot be removed stays
    return Done{};
}

Result<LoadedMap> openPlanned(const DatasetSpec& spec,
                              const OpenPlan& plan,
                              const MapResources& resources,
                              JobMonitor& monitor)
{
    MARSVIEW_CHECK(plan.store != MapStore::Unprepared);
    if (plan.store == MapStore::Held) {
        return openHeld(spec, monitor);
    }
    Result<Described> map = describe(spec);
    if (!map) {
        return std::move(map).error();
    }
    const int band = bandOf(spec, plan.raster_path, map->file_info);
    Result<RasterFile> raster = RasterFile::open(plan.raster_path, band);
    if (!raster) {
        return std::move(raster).error();
    }
    Result<std::shared_ptr<const GeotiffTileSource>> source =
        GeotiffTileSource::of(*raster, map->voids());
    if (!source) {
        return std::move(source).error();
    }
    Result<OpenedTiles> opened =
        plan.level_path
            ? openWithLevels(*source, *plan.level_path, band, map->info)
            : openWithoutLevels(keptOnDisk(*source, resources, map->file_info, "raster"), map->info,
                                monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    if (const SampleStatistics& found = opened->levels->statistics; !found.hasSamples()) {
        return noHeights(spec.path, found);
    }
    if (!plan.level_path) {
        map->info.notices.push_back("its detail is estimated: there is no level file beside it");
    }
    if (plan.level_path) {
        opened->source = keptOnDisk(opened->source, resources, map->info, "map");
    }
    keepInUse(plan, resources, *opened);
    Result<std::shared_ptr<const TiledSamples>> tiles =
        TiledSamples::open(TiledRaster(*resources.tiles, opened->source));
    if (!tiles) {
        return std::move(tiles).error();
    }
    monitor.report(0.5);
    return prepareTiledMap(tiledDataset({.spec = spec,
                                         .file_info = map->file_info,
                                         .info = map->info,
                                         .statistics = opened->levels->statistics,
                                         .tiles = std::move(*tiles)}),
                           opened->levels);
}

bool isDamageToPrepared(const OpenPlan& plan, const Error& error)
{
    return plan.store == MapStore::Tiled && plan.level_path &&
           (error.code == ErrorCode::Invalid || error.code == ErrorCode::Unreadable);
}

Status discardPrepared(const OpenPlan& plan, const MapResources& resources)
{
    const std::filesystem::path kept = plan.level_path ? keptPathOf(*plan.level_path) : "";
    std::error_code failure;
    if (kept.empty() ||
        !std::filesystem::equivalent(kept.parent_path(), resources.folder, failure)) {
        return Error{ErrorCode::NotFound, fmt::format("{}: was not prepared in {}", kept.string(),
                                                      resources.folder.string())};
    }
    const Result<MapFolder> folder = MapFolder::open(resources.folder);
    return folder ? folder->remove(kept.filename().string()) : Status(folder.error());
}

Result<LoadedMap>
openMap(const DatasetSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    Result<OpenPlan> plan = planOpening(spec, resources);
    if (!plan) {
        return std::move(plan).error();
    }
    if (plan->store == MapStore::Unprepared) {
        if (Status prepared = prepareForOpening(spec, resources, monitor); !prepared) {
            return std::move(prepared).error();
        }
        plan = planOpening(spec, resources);
        if (!plan) {
            return std::move(plan).error();
        }
        if (plan->store == MapStore::Unprepared) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: was prepared, but what was made of it is gone from {}; "
                                     "choose another folder for prepared maps",
                                     spec.path, resources.folder.string())};
        }
    }
    Result<LoadedMap> map = openPlanned(spec, *plan, resources, monitor);
    if (map || !isDamageToPrepared(*plan, map.error()) || !discardPrepared(*plan, resources)) {
        return map;
    }
    return openMap(spec, resources, monitor); // what is gone cannot be damaged again
}

} // namespace marsview
