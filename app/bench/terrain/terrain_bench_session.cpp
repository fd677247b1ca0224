#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/terrain/terrain_stage.h"
#include "app/bench/terrain/tile_swipe.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "core/session/open_map.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace marsview {

Result<BenchJson> measureSession(const TerrainBenchOptions& options)
{
    Result<std::unique_ptr<TerrainStage>> stage = TerrainStage::create({1280, 800});
    if (!stage) {
        return std::move(stage).error();
    }
    const MapResources resources = tiledResources();
    LongJob job("a session");
    Result<std::shared_ptr<const Map>> map = openMap(options.map.spec(), resources, job.monitor());
    if (!map) {
        return std::move(map).error();
    }
    (*stage)->show(*map);
    const double opened_mb = static_cast<double>(peakMemoryBytes()) / 1e6;
    // The hand swipes all the time, faster from flight to flight.
    const TouchedTiles tiles = touchedTiles(*map);
    std::uint64_t turns = 0;
    std::uint64_t frames = 0;
    std::size_t tile_bytes_most = 0;
    for (std::size_t i = 0; i < kFlights.size(); ++i) {
        constexpr double kLong = 3600.0; // it is stopped earlier
        const std::vector<double>& speeds = options.speeds_cells;
        Result<TileSwipe> swipe =
            TileSwipe::begin(tiles, {.speed_cells = speeds[std::min(i, speeds.size() - 1)],
                                     .seconds = kLong,
                                     .seed = options.seed + i});
        if (!swipe) {
            return std::move(swipe).error();
        }
        for (int frame = 0; frame < options.frame_count && !job.monitor().isCanceled(); ++frame) {
            const double t = frame / std::max(options.frame_count - 1.0, 1.0);
            (*stage)->paint((*stage)->camera(kFlights[i], t), PictureStage::Moving);
            ++frames;
            tile_bytes_most = std::max(tile_bytes_most, resources.tiles->statistics().bytes_held);
        }
        (*stage)->paintWhole((*stage)->camera(kFlights[i], 1.0), job.monitor());
        turns += swipe->stop().loop.tick.count();
        job.monitor().report((static_cast<double>(i) + 1.0) / kFlights.size());
    }
    if (job.monitor().isCanceled()) {
        return Error{ErrorCode::Canceled, "the session was canceled"};
    }
    return BenchJson{{"peak_memory_mb", static_cast<double>(peakMemoryBytes()) / 1e6},
                     {"opened_peak_memory_mb", opened_mb},
                     {"tile_cache_mb_max", static_cast<double>(resources.tiles->bytesMax()) / 1e6},
                     {"tile_cache_mb_most", static_cast<double>(tile_bytes_most) / 1e6},
                     {"frames", frames},
                     {"turns_of_hand", turns}};
}

} // namespace marsview
