#include "core/session/open_map.h"

#include "core/base/check.h"
#include "core/base/environment.h"
#include "core/base/plain_number.h"
#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "core/levels/estimated_levels.h"
#include "core/levels/level_file.h"
#include "core/levels/level_file_use.h"
#include "core/levels/map_tile_source.h"
#include "core/prepare/kept_source.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/prepare_map.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/raster/raster_file.h"
#include "core/raster/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"
#include "core/tiles/mean_samples_source.h"
#include "core/tiles/tile_disk_cache.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

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
    if (Status surface = checkIsSurface(spec.path, *info); !surface) {
        return std::move(surface).error();
    }
    return Described{std::move(*file), std::move(file_info), std::move(*info)};
}

// A prepared copy has one band.
int bandOf(const DatasetSpec& spec, const std::string& raster_path, const RasterInfo& info)
{
    return raster_path == info.path ? spec.band : 1;
}

std::size_t megabytesFrom(const char* variable, std::size_t otherwise, NoticesOnce& notices)
{
    constexpr double kMost = 1e9;
    const std::string text = environmentVariable(variable);
    const std::optional<double> megabytes = parseNumber(text);
    if (megabytes && *megabytes >= 0.0 && *megabytes <= kMost) {
        return static_cast<std::size_t>(*megabytes * 0x1p20);
    }
    if (!text.empty()) {
        notices.add(
            fmt::format("{}=\"{}\" in the environment is not a number of megabytes from 0 to "
                        "{:.0f}; {} are used",
                        variable, text, kMost, otherwise >> 20));
    }
    return otherwise;
}

// What there is to say about more than this map goes with the first one that can be opened.
OpenPlan withNoticesOf(const MapResources& resources, OpenPlan plan)
{
    if (resources.notices && plan.store != MapStore::Unprepared) {
        for (std::string& notice : resources.notices->take()) {
            plan.notices.push_back(std::move(notice));
        }
    }
    return plan;
}

Result<LoadedMap>
openHeld(const DatasetSpec& spec, const std::vector<std::string>& notices, JobMonitor& monitor)
{
    // Shares as measured on a map of 34 million samples.
    monitor.beginStage(0.0, 0.6);
    auto dataset = loadDataset(spec, monitor, defaultMemoryBudget(), notices);
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
                    info.band, info.voidSettings(), scale.gain, scale.offset_m, what);
    return cachedOnDisk(std::move(source), resources.fetched_tiles, key);
}

// The prepared map that a level file belongs to.
std::string keptPathOf(const std::string& level_path)
{
    return level_path.substr(0, level_path.size() - LevelFile::pathFor("").size());
}

// Whether tiles are read from a copy that goes with the level file, in the folder of prepared maps.
bool isCopy(const OpenPlan& plan)
{
    return plan.level_path && plan.raster_path == keptPathOf(*plan.level_path) &&
           std::filesystem::path(plan.raster_path).filename().string().ends_with(".map.tif");
}

// All tiles of a map, and what is known of it as a whole.
struct OpenedTiles {
    std::shared_ptr<const TileSource> source;
    std::shared_ptr<const MapLevels> levels;
};

Result<OpenedTiles> openWithLevels(const std::shared_ptr<const GeotiffTileSource>& raster,
                                   const OpenPlan& plan,
                                   int band,
                                   const RasterInfo& info)
{
    const std::string& level_path = *plan.level_path;
    Result<LevelFileKey> key = levelFileKey(raster->name(), band, info);
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
    const bool is_made_anew = plan.raster_path != info.path; // a copy that the program keeps
    const std::string remedy = is_made_anew ? "open the map again to have it made anew"
                                            : remedyFor(plan.raster_path, level_path);
    TileLayout layout = raster->layout();
    layout.has_voids = levels->statistics.void_count > 0;
    OpenedTiles opened;
    // Of a damaged tile GDAL may decode other samples without a word.
    opened.source = mapTileSource({.raster = raster->checkedBy(levels->checksums, remedy),
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

// What of the plan lies in the folder of prepared maps; nothing where it lies elsewhere. As long as
// it lives, nobody removes that, unless the folder may not be written to.
std::optional<KeptMap> keptMapOf(const OpenPlan& plan, const MapResources& resources)
{
    std::error_code failure;
    if (!plan.level_path ||
        !std::filesystem::equivalent(std::filesystem::path(*plan.level_path).parent_path(),
                                     resources.folder, failure)) {
        return std::nullopt;
    }
    KeptMap kept{.folder = MapFolder::at(resources.folder),
                 .path = keptPathOf(*plan.level_path),
                 .lock = std::nullopt,
                 .is_copy = isCopy(plan)};
    if (Result<FileLock> lock = kept.folder.use(kept.path)) {
        kept.lock = std::move(lock).value();
    }
    return kept;
}

// By what somebody found who had it open.
bool isDamaged(const std::string& kept_path, const MapResources& resources)
{
    return MapFolder::at(resources.folder).damage(kept_path).has_value();
}

// An archive may unpack to a thousand times its size, so a large map in one is prepared on disk
// rather than held in memory.
std::uint64_t heldBytesMax(const std::string& raster_path, const MapResources& resources)
{
    constexpr std::uint64_t kUnpackedMax = std::uint64_t{1} << 30;
    const std::uint64_t held_max = resources.held_bytes_max;
    return isInArchive(raster_path) ? std::min(held_max, kUnpackedMax) : held_max;
}

Result<OpenPlan> planFor(const DatasetSpec& spec, const MapResources& resources)
{
    Result<Described> map = describe(spec);
    if (!map) {
        return std::move(map).error();
    }
    const bool is_remote = remoteNameFor(spec.path).has_value();
    const std::string& raster_path = map->file_info.path;
    const bool fits = map->bytes() <= heldBytesMax(raster_path, resources);
    std::vector<std::string> notices;
    const auto in_place = GeotiffTileSource::of(map->file, map->voids());
    if (in_place) {
        const std::string beside = LevelFile::pathFor(raster_path);
        const Status levels = checkLevels(beside, raster_path, spec.band, map->info);
        if (levels) {
            return OpenPlan{MapStore::Tiled, raster_path, beside};
        }
        if (levels.error().code == ErrorCode::Damaged) {
            return levels.error();
        }
        if (levels.error().code != ErrorCode::NotFound) {
            notices.push_back(notUsed(beside, levels.error()));
        }
        if (is_remote) {
            return OpenPlan{MapStore::Tiled, raster_path, std::nullopt, std::move(notices)};
        }
        const Result<std::string> kept = preparedPathFor(spec, resources.folder);
        if (kept && !isDamaged(*kept, resources) &&
            hasLevels(LevelFile::pathFor(*kept), raster_path, spec.band, map->info)) {
            return OpenPlan{MapStore::Tiled, raster_path, LevelFile::pathFor(*kept),
                            std::move(notices)};
        }
    }
    const auto held = [&notices] {
        return OpenPlan{.store = MapStore::Held,
                        .raster_path = {},
                        .level_path = {},
                        .notices = std::move(notices)};
    };
    if (is_remote) {
        return fits ? Result<OpenPlan>(held()) : in_place.error(); // says what to do
    }
    // What was prepared opens at once, however much memory there is.
    const Result<std::string> copy = preparedPathFor(spec, resources.folder);
    if (copy && !isDamaged(*copy, resources) &&
        hasLevels(LevelFile::pathFor(*copy), *copy, 1, map->info)) {
        return OpenPlan{MapStore::Tiled, *copy, LevelFile::pathFor(*copy), std::move(notices)};
    }
    if (fits) {
        return held();
    }
    return OpenPlan{.store = MapStore::Unprepared,
                    .raster_path = {},
                    .level_path = {},
                    .notices = std::move(notices)};
}

} // namespace

MapResources defaultMapResources()
{
    const std::size_t quarter = defaultMemoryBudget() / 2;
    MapResources resources;
    resources.notices = std::make_shared<NoticesOnce>();
    resources.held_bytes_max = megabytesFrom("MARSVIEW_HELD_MB", quarter, *resources.notices);
    resources.tiles = std::make_shared<TileCache>(TileCacheOptions{
        .bytes_max = megabytesFrom("MARSVIEW_CACHE_MB", quarter, *resources.notices),
        .loader_threads = std::max(2U, std::thread::hardware_concurrency())});
    resources.folder = MapFolder::defaultPath();
    resources.fetched_tiles = std::make_shared<TileDiskCache>(
        TileDiskCacheOptions{.folder = fetchedTilesFolder(resources.folder)});
    return resources;
}

std::string fetchedTilesFolder(const std::filesystem::path& folder)
{
    return folder.empty() ? std::string() : (folder / "fetched").string();
}

Result<OpenPlan> planOpening(const DatasetSpec& spec, const MapResources& resources)
{
    Result<OpenPlan> plan = planFor(spec, resources);
    return plan ? Result<OpenPlan>(withNoticesOf(resources, std::move(plan).value())) : plan;
}

Status
prepareForOpening(const DatasetSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    const Result<PrepareReport> prepared = prepareInFolder(
        {.spec = spec, .folder = resources.folder, .folder_bytes_max = resources.folder_bytes_max},
        monitor);
    return prepared ? Status(Done{}) : Status(prepared.error());
}

Result<LoadedMap> openPlanned(const DatasetSpec& spec,
                              const OpenPlan& plan,
                              const MapResources& resources,
                              JobMonitor& monitor)
{
    MARSVIEW_CHECK(plan.store != MapStore::Unprepared);
    if (plan.store == MapStore::Held) {
        return openHeld(spec, plan.notices, monitor);
    }
    Result<Described> map = describe(spec);
    if (!map) {
        return std::move(map).error();
    }
    std::optional<KeptMap> kept = keptMapOf(plan, resources); // before it is looked at
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
            ? openWithLevels(*source, plan, band, map->info)
            : openWithoutLevels(keptOnDisk(*source, resources, map->file_info, "raster"), map->info,
                                monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    if (const SampleStatistics& found = opened->levels->statistics; !found.hasSamples()) {
        return noHeights(spec.path, found);
    }
    map->info.notices.insert(map->info.notices.end(), plan.notices.begin(), plan.notices.end());
    if (!plan.level_path) {
        map->info.notices.push_back(
            plan.notices.empty() ? "its detail is estimated: there is no level file beside it"
                                 : "its detail is estimated");
    }
    if (plan.level_path) {
        opened->source = keptOnDisk(opened->source, resources, map->info, "map");
    }
    if (kept) {
        opened->source = keptSource(opened->source, std::move(*kept));
    }
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
    return plan.store == MapStore::Tiled && plan.level_path && isDamageToKept(error, isCopy(plan));
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
