#include "app/bench/terrain/held_map.h"
#include "app/bench/terrain/swipe_path.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/console/long_job.h"
#include "core/contact/contact_model.h"
#include "core/levels/waiting_terrain.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace marsview {
namespace {

bool isSame(const ContactState& a, const ContactState& b)
{
    return std::memcmp(&a.proxy, &b.proxy, sizeof(a.proxy)) == 0 &&
           a.is_in_contact == b.is_in_contact && a.feature == b.feature;
}

} // namespace

Result<BenchJson> measureIdentity(const TerrainBenchOptions& options)
{
    LongJob job("comparing");
    const Result<OpenRaster> opened = openRaster(options.map);
    if (!opened) {
        return opened.error();
    }
    // Analysis takes as much memory again, and briefly half as much in addition.
    const double samples_max = static_cast<double>(options.held_mb_max) * 1e6 / 4.0;
    const auto side = static_cast<std::size_t>(std::sqrt(samples_max));
    const std::size_t all = opened->info.columns * opened->info.rows;
    const bool is_whole = static_cast<double>(all) <= samples_max;
    const Result<HeldMap> held =
        holdWindow(options.map,
                   is_whole ? GridWindow{0, 0, opened->info.columns, opened->info.rows}
                            : middleOf(opened->info.columns, opened->info.rows, side, side),
                   job.monitor());
    if (!held) {
        return held.error();
    }
    // A cache so small that tiles are evicted and reloaded.
    constexpr std::size_t kCacheBytes = std::size_t{4} << 20;
    TileCache cache({.bytes_max = kCacheBytes, .loader_threads = 1});
    std::optional<std::shared_ptr<const Map>> map;
    std::string unopened;
    if (is_whole) {
        Result<std::shared_ptr<const Map>> in_tiles = openInTiles(options, job.monitor());
        if (in_tiles) {
            map = std::move(in_tiles).value();
        } else {
            unopened = in_tiles.error().message;
        }
    }
    const TouchedTiles touched =
        map ? touchedTiles(*map)
            : TouchedTiles{TiledRaster(cache, tilesOf(*held)), tileHeightsOf(*held), held->frame};
    BenchJson rows = BenchJson::array();
    std::uint64_t differing = 0;
    for (const double speed : options.speeds_cells) {
        const auto tiles = std::make_shared<WaitingTerrain>(touched.raster, touched.heights);
        const auto in_memory = makeContactModel(kContactModelDefault,
                                                HeightfieldSurface(held->filled, held->frame, 1.0));
        const auto in_tiles = makeContactModel(kContactModelDefault,
                                               TiledHeightfieldSurface(tiles, held->frame, 1.0));
        const SwipeArea area{{0.0, 0.0},
                             {static_cast<double>(held->window.columns - 1),
                              static_cast<double>(held->window.rows - 1)}};
        SwipingHand hand(SwipePath(area, {.speed_cells = speed, .seed = options.seed}), held->frame,
                         speed);
        ContactState truth = in_memory->place(hand.begin());
        std::uint64_t different = isSame(truth, in_tiles->place(hand.begin())) ? 0 : 1;
        std::uint64_t in_contact = 0;
        for (std::size_t i = 0; i < options.update_count; ++i) {
            const ScenePoint goal = hand.next(truth.proxy);
            truth = in_memory->update(goal);
            different += isSame(truth, in_tiles->update(goal)) ? 0U : 1U;
            in_contact += truth.is_in_contact ? 1U : 0U;
            if (job.monitor().isCanceled()) {
                return Error{ErrorCode::Canceled, "comparing was canceled"};
            }
        }
        if (tiles->error()) {
            return *tiles->error();
        }
        differing += different;
        rows.push_back({{"cells_per_update", speed},
                        {"updates", options.update_count},
                        {"in_contact", in_contact},
                        {"tiles_fetched", tiles->fetchCount()},
                        {"differing_proxies", different}});
    }
    return BenchJson{{"columns", held->window.columns},         {"rows", held->window.rows},
                     {"triangle_count", held->triangleCount()}, {"is_whole_map", is_whole},
                     {"is_read_from_files", map.has_value()},   {"unopened", unopened},
                     {"differing_proxies", differing},          {"speeds", rows}};
}

} // namespace marsview
