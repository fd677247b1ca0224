#include "app/bench/terrain/make_terrain.h"

#include "app/bench/reference/detailed_heights.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "core/raster/raster_file.h"
#include "core/session/map.h"

#include <chrono>
#include <fmt/format.h>
#include <memory>
#include <vector>

namespace marsview {
namespace {

// The same extent with more samples.
std::optional<GeoTransform> resized(const RasterInfo& info, const MakeTerrainOptions& options)
{
    if (!info.transform) {
        return std::nullopt;
    }
    const double across = static_cast<double>(info.columns) / static_cast<double>(options.columns);
    const double down = static_cast<double>(info.rows) / static_cast<double>(options.rows);
    GeoTransform::Terms terms = info.transform->terms();
    terms[1] *= across;
    terms[4] *= across;
    terms[2] *= down;
    terms[5] *= down;
    const Result<GeoTransform> transform = GeoTransform::fromTerms(terms);
    return transform ? std::optional(transform.value()) : std::nullopt;
}

} // namespace

Result<MadeTerrain> makeTerrain(const MakeTerrainOptions& options)
{
    const auto begin = std::chrono::steady_clock::now();
    forgetPeakMemory();
    LongJob job(fmt::format("making {}", options.path));
    const Result<std::shared_ptr<const Map>> loaded =
        readMap(RasterSpec{.path = options.from}, job.monitor(), defaultMemoryBudget());
    if (!loaded) {
        return loaded.error();
    }
    const Map& map = **loaded;
    const RasterInfo& info = map.info();
    if (map.heightfield().samples().hasVoids()) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("{}: some samples are nodata; choose a map without nodata", options.from)};
    }
    if (info.columns < 4 || info.rows < 4) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: {} × {} samples are too few; choose a map of 4 × 4 or more",
                                 options.from, info.columns, info.rows)};
    }
    std::vector<float> heights_m;
    heights_m.reserve(info.columns * info.rows);
    for (std::size_t r = 0; r < info.rows; ++r) {
        for (std::size_t c = 0; c < info.columns; ++c) {
            heights_m.push_back(static_cast<float>(map.heightfield().sample(c, r)));
        }
    }
    const DetailedHeights heights(GridView<const float>(heights_m.data(), info.columns, info.rows),
                                  {.columns = options.columns,
                                   .rows = options.rows,
                                   .seed = options.seed,
                                   .wraps_around = map.georeference().wrapsAround()});
    const Status written = writeComputedRaster(
        {.path = options.path,
         .columns = options.columns,
         .rows = options.rows,
         .transform = resized(info, options),
         .crs = info.crs,
         .vertical_datum = info.vertical_datum,
         .blocks = options.blocks,
         .compression = options.compression},
        [&heights](std::size_t column, std::size_t row, GridView<std::int16_t> samples) {
            heights.window(column, row, samples);
        },
        job.monitor());
    if (!written) {
        return written.error();
    }
    return MadeTerrain{
        .octave_count = heights.octaveCount(),
        .halving_ratio = heights.halvingRatio(),
        .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
        .peak_memory_bytes = peakMemoryBytes()};
}

} // namespace marsview
