#include "app/bench/terrain/file_eviction.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/terrain/terrain_stage.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "core/session/open_map.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace marsview {

Result<BenchJson> measureFirstPicture(const TerrainBenchOptions& options)
{
    using Clock = std::chrono::steady_clock;
    // As many samples as in the window's preview.
    constexpr std::size_t kPreviewSamples = std::size_t{1} << 21U;
    const MapResources resources = tiledResources();
    EvictedFiles evicted;
    if (!options.is_warm) {
        evicted = evict({options.map.path, resources.folder});
    }
    Result<std::unique_ptr<TerrainStage>> stage = TerrainStage::create({1280, 800});
    if (!stage) {
        return std::move(stage).error();
    }
    LongJob job("opening");
    const Clock::time_point begin = Clock::now();
    const auto since = [begin] {
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    };
    Result<std::shared_ptr<const Map>> map =
        openMap(options.map.spec(), resources, job.monitor(),
                {.without_overviews = WithoutOverviews::Preview,
                 .preview = {.samples_max = kPreviewSamples}});
    if (!map) {
        return std::move(map).error();
    }
    const bool is_prepared = !(*map)->isPreview();
    const double opened_ms = since();
    (*stage)->show(std::move(map).value());
    const OrbitCamera camera = (*stage)->camera(Flight::Orbit, 0.0);
    (*stage)->paint(camera, PictureStage::Moving);
    const double first_ms = since();
    (*stage)->paintWhole(camera, job.monitor());
    if (job.monitor().isCanceled()) {
        return Error{ErrorCode::Canceled, "opening was canceled"};
    }
    return BenchJson{{"is_prepared", is_prepared},
                     {"is_warm", options.is_warm},
                     {"opened_ms", opened_ms},
                     {"first_picture_ms", first_ms},
                     {"sharp_picture_ms", since()},
                     {"peak_memory_mb", static_cast<double>(peakMemoryBytes()) / 1e6},
                     {"resident_share_at_begin", evicted.resident_share}};
}

} // namespace marsview
