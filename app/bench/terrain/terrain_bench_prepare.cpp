#include "app/bench/terrain/file_eviction.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "core/session/map_opening.h"
#include "core/session/open_map.h"

#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace marsview {
namespace {

double bytesBelow(const std::filesystem::path& folder)
{
    namespace fs = std::filesystem;
    double bytes = 0.0;
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(folder, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        if (it->is_regular_file(error)) {
            bytes += static_cast<double>(it->file_size(error));
        }
    }
    return bytes;
}

} // namespace

Result<BenchJson> measurePrepare(const TerrainBenchOptions& options)
{
    const MapResources resources = tiledResources();
    const RasterSpec spec = options.map.spec();
    Result<OpenRaster> raster = openRaster(options.map);
    if (!raster) {
        return std::move(raster).error();
    }
    const Result<MapOpening> opening = MapOpening::begin(std::move(*raster), resources);
    if (!opening) {
        return opening.error();
    }
    if (opening->storage() != MapStorage::NeedsOverviews) {
        return Error{ErrorCode::Invalid, fmt::format("{}: nothing to prepare", options.map.path)};
    }
    const EvictedFiles evicted = evict({options.map.path});
    const double bytes_before = bytesBelow(resources.folder);
    LongJob job("preparing");
    forgetPeakMemory();
    const auto begin = std::chrono::steady_clock::now();
    if (const Status status = buildOverviews(spec, resources, job.monitor()); !status) {
        return status.error();
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double samples = static_cast<double>(opening->raster().info.columns) *
                           static_cast<double>(opening->raster().info.rows);
    return BenchJson{{"seconds", seconds},
                     {"samples_per_s", samples / seconds},
                     {"peak_memory_mb", static_cast<double>(peakMemoryBytes()) / 1e6},
                     {"written_mb", (bytesBelow(resources.folder) - bytes_before) / 1e6},
                     {"source_resident_share", evicted.resident_share}};
}

} // namespace marsview
