#include "app/bench/terrain/file_eviction.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/terrain/tile_swipe.h"
#include "app/console/long_job.h"
#include "core/session/open_map.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace marsview {
namespace {

double microseconds(std::chrono::nanoseconds span)
{
    return static_cast<double>(span.count()) / 1e3;
}

BenchJson asJson(const TimeHistogram& times)
{
    return {{"mean_us", times.meanNanoseconds() / 1e3},
            {"p50_us", microseconds(times.quantile(0.5))},
            {"p99_us", microseconds(times.quantile(0.99))},
            {"p999_us", microseconds(times.quantile(0.999))},
            {"max_us", microseconds(times.maximum())}};
}

BenchJson asJson(double speed, const TileSwipeResult& swipe, const EvictedFiles& evicted)
{
    const SwipeCounts& counts = swipe.counts;
    BenchJson levels = BenchJson::array(); // turns by the coarsest level used
    const auto last = std::find_if(counts.turns_at_level.rbegin(), counts.turns_at_level.rend(),
                                   [](std::uint64_t turns) { return turns > 0; });
    for (auto it = counts.turns_at_level.begin(); it != last.base(); ++it) {
        levels.push_back(*it);
    }
    return {{"cells_per_update", speed},
            {"turns", swipe.loop.tick.count()},
            {"in_contact", counts.in_contact},
            {"cut_short", counts.cut_short},
            {"update", asJson(swipe.loop.tick)},
            {"waking", asJson(swipe.loop.lateness)},
            {"missed_by_update", swipe.loop.missed_by_tick},
            {"missed_by_waking", swipe.loop.missed_by_waking},
            {"skipped_turns", swipe.loop.skipped},
            {"page_faults_minor", swipe.loop.minor_faults},
            {"page_faults_major", swipe.loop.major_faults},
            {"turns_with_misses", counts.turns_with_misses},
            {"samples_missed", counts.samples_missed},
            {"turns_by_coarsest_level", levels},
            {"worst_level", levels.empty() ? 0 : levels.size() - 1},
            {"windows_published", swipe.streamer.published},
            {"tiles_put", swipe.streamer.tiles_put},
            {"tiles_loaded", swipe.tiles_loaded},
            {"tiles_failed", swipe.tiles_failed},
            {"tile_lock_error", swipe.streamer.lock_error},
            {"resident_share_at_begin", evicted.resident_share}};
}

} // namespace

Result<BenchJson> measureSwipes(const TerrainBenchOptions& options)
{
    LongJob job("swiping");
    const MapResources resources = tiledResources();
    const Result<std::shared_ptr<const Map>> map =
        openMap(options.map.spec(), resources, job.monitor());
    if (!map) {
        return map.error();
    }
    const TouchedTiles tiles = touchedTiles(*map);
    BenchJson rows = BenchJson::array();
    RealTimeGrants grants;
    for (const double speed : options.speeds_cells) {
        resources.tiles->clear();
        const EvictedFiles evicted = evict({options.map.path, resources.folder});
        Result<TileSwipe> swipe = TileSwipe::begin(
            tiles, {.speed_cells = speed, .seconds = options.seconds, .seed = options.seed});
        if (!swipe) {
            return std::move(swipe).error();
        }
        const TileCacheStatistics before = resources.tiles->statistics();
        TileSwipeResult result = swipe->finish(job.monitor());
        if (job.monitor().isCanceled()) {
            return Error{ErrorCode::Canceled, "swiping was canceled"};
        }
        const TileCacheStatistics after = resources.tiles->statistics();
        result.tiles_loaded = after.loaded - before.loaded;
        result.tiles_failed = after.failed - before.failed;
        grants = result.grants;
        rows.push_back(asJson(speed, result, evicted));
    }
    return BenchJson{{"period_us", 1000.0},
                     {"seconds", options.seconds},
                     {"scheduling", grants.hasScheduling() ? "SCHED_FIFO" : "shared"},
                     {"scheduling_refusal", grants.scheduling_refusal},
                     {"memory_locked", grants.hasLocking()},
                     {"locking_refusal", grants.locking_refusal},
                     {"speeds", rows}};
}

} // namespace marsview
