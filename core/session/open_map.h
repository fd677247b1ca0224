// Opening maps of any size: whole into memory, or in tiles where they are too large for that.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/session/dataset.h"
#include "core/session/loaded_map.h"
#include "core/session/notices_once.h"
#include "core/tiles/tile_cache.h"
#include "core/tiles/tile_disk_cache.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// What all maps of a program share.
struct MapResources {
    std::shared_ptr<TileCache> tiles; // decoded tiles of maps too large to hold
    /// Maps whose samples take no more than this are read whole, unless they are prepared already.
    std::size_t held_bytes_max = std::size_t{1} << 30;
    /// Where prepared maps are kept, and how many bytes of them.
    std::filesystem::path folder;
    std::uint64_t folder_bytes_max = 0; // 0: MapFolder::defaultBytesMax()
    /// Tiles that came from servers, in fetchedTilesFolder(folder); may be null.
    std::shared_ptr<TileDiskCache> fetched_tiles;
    /// What is odd about them, told with the first map that is opened; may be null.
    std::shared_ptr<NoticesOnce> notices{};
};

/// A quarter of memory for tiles, as much for maps that are held; the user's cache folder. The
/// environment may say otherwise: MARSVIEW_CACHE_DIR (a folder), MARSVIEW_CACHE_MB (decoded tiles
/// in memory) and MARSVIEW_HELD_MB (what is read whole). What is no such number is a notice.
MapResources defaultMapResources();

/// Where tiles from servers are kept beside prepared maps; empty where `folder` is.
std::string fetchedTilesFolder(const std::filesystem::path& folder);

/// How a map is going to be opened.
enum class MapStore {
    Held,      // read whole
    Tiled,     // in tiles, at once
    Unprepared // in tiles, once it has been prepared, which takes minutes
};

struct OpenPlan {
    MapStore store = MapStore::Held;
    /// Of Tiled: the raster that tiles are read from, the map itself or its prepared copy.
    std::string raster_path;
    /// Its level file. Nothing where there is none: detail is then estimated (remote maps).
    std::optional<std::string> level_path;
    /// For the user, such as why a level file is not used.
    std::vector<std::string> notices{};
};

/// Looks at the file and at what was prepared from it. Reads a few dozen kilobytes.
Result<OpenPlan> planOpening(const DatasetSpec& spec, const MapResources& resources);

/// Makes an Unprepared map's files in the folder of prepared maps, making room there; afterwards
/// its plan is Tiled. What was begun and stopped is gone on with. On all cores; reports progress;
/// the source is read once, and never written to.
Status
prepareForOpening(const DatasetSpec& spec, const MapResources& resources, JobMonitor& monitor);

/// Opens a map whose plan is not Unprepared, ready to be shown and touched.
Result<LoadedMap> openPlanned(const DatasetSpec& spec,
                              const OpenPlan& plan,
                              const MapResources& resources,
                              JobMonitor& monitor);

/// Whether openPlanned() may have failed with `error` because what was prepared is damaged, rather
/// than the map itself.
bool isDamageToPrepared(const OpenPlan& plan, const Error& error);
/// Removes what was prepared, if it lies in the folder of prepared maps and nobody uses it:
/// afterwards the map has another plan. The user's own files stay.
Status discardPrepared(const OpenPlan& plan, const MapResources& resources);

/// All of the above in turn, waiting for as long as it takes.
Result<LoadedMap>
openMap(const DatasetSpec& spec, const MapResources& resources, JobMonitor& monitor);

/// A smaller map of the same ground, held in memory: at most `samples_max` of its samples, from
/// overviews, or from as many blocks of the file as can be read in a moment. To be looked at while
/// the map itself is prepared; the numbers of its heights are not to be quoted.
Result<LoadedMap> previewMap(const DatasetSpec& spec, std::size_t samples_max, JobMonitor& monitor);

} // namespace marsview
