// What all maps of a program share.
#pragma once

#include "core/session/notices_once.h"
#include "core/tiles/tile_cache.h"
#include "core/tiles/tile_disk_cache.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace marsview {

struct MapResources {
    std::shared_ptr<TileCache> tiles; // decoded tiles of maps that are not in memory
    /// Maps whose samples take no more than this are read into memory, unless they are prepared.
    std::size_t held_bytes_max = std::size_t{1} << 30;
    /// The folder of prepared maps, and how many bytes they may take.
    std::filesystem::path folder;
    std::uint64_t folder_bytes_max = 0; // 0: MapFolder::defaultBytesMax()
    /// Tiles from servers, in fetchedTilesFolder(folder); may be null.
    std::shared_ptr<TileDiskCache> fetched_tiles;
    /// Notices about the settings, shown with the first map that is opened; may be null.
    std::shared_ptr<NoticesOnce> notices{};
};

/// A quarter of the machine's memory for tiles, as much for maps in memory, and the user's cache
/// folder. The environment overrides these: MARSVIEW_CACHE_DIR (a folder), MARSVIEW_CACHE_MB
/// (decoded tiles in memory) and MARSVIEW_HELD_MB (maps in memory). An invalid value is a notice.
MapResources defaultMapResources();

/// Where tiles from servers are kept next to prepared maps; empty if `folder` is.
std::string fetchedTilesFolder(const std::filesystem::path& folder);

} // namespace marsview
