#include "core/session/map_resources.h"

#include "core/base/environment.h"
#include "core/base/plain_number.h"
#include "core/prepare/map_folder.h"
#include "core/raster/raster_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <thread>

namespace marsview {
namespace {

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
            fmt::format("the environment variable {} is \"{}\", not a number of megabytes from 0 "
                        "to {:.0f}; {} is used",
                        variable, text, kMost, otherwise >> 20));
    }
    return otherwise;
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

} // namespace marsview
