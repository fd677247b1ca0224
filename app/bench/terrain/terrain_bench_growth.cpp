#include "app/bench/terrain/held_map.h"
#include "app/bench/terrain/swipe_path.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/tick_clock.h"
#include "app/console/long_job.h"
#include "core/contact/contact_model.h"
#include "core/levels/waiting_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// The smallest part: a million triangles. All swipes stay in its middle, on the same terrain.
constexpr std::size_t kSideLeast = 708;
constexpr std::size_t kMargin = 16;
constexpr int kRounds = 7;

struct Size {
    std::uint64_t triangle_count = 0;
    const char* storage = "";
    SceneFrame frame;
    std::unique_ptr<MapContactModel> model;
    std::vector<double> ns; // for each speed, of the best round
};

class Growth {
public:
    Growth(const TerrainBenchOptions& options, JobMonitor& monitor)
        : options_(options)
        , monitor_(monitor)
    {}

    Result<BenchJson> run()
    {
        const Result<OpenRaster> opened = openRaster(options_.map);
        if (!opened) {
            return opened.error();
        }
        columns_ = opened->info.columns;
        rows_ = opened->info.rows;
        if (std::min(columns_, rows_) < kSideLeast) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("{}: {} × {} samples are too few; growth begins at {} × {}",
                                     options_.map.path, columns_, rows_, kSideLeast, kSideLeast)};
        }
        if (Status status = holdParts(); !status) {
            return status.error();
        }
        BenchJson json{{"whole_map_left_out", nullptr}};
        if (Status status = openWhole(); !status) {
            json["whole_map_left_out"] = status.error().message;
        }
        measure();
        if (monitor_.isCanceled()) {
            return Error{ErrorCode::Canceled, "measuring was canceled"};
        }
        for (const auto& [tiles, path] : tiles_) {
            if (tiles->error()) {
                return *tiles->error();
            }
        }
        addResultsTo(json);
        return json;
    }

private:
    double heldBytesMax() const { return static_cast<double>(options_.held_mb_max) * 1e6; }

    Status holdParts()
    {
        for (std::size_t side = kSideLeast; !monitor_.isCanceled(); side *= 2) {
            const GridWindow window = middleOf(columns_, rows_, side, side);
            const auto bytes =
                2.0 * static_cast<double>(window.columns) * static_cast<double>(window.rows);
            const bool is_first = side == kSideLeast;
            if (!is_first && bytes > heldBytesMax()) {
                break;
            }
            Result<HeldMap> held = holdWindow(options_.map, window, monitor_);
            if (!held) {
                return std::move(held).error();
            }
            add(held->triangleCount(), "held", held->frame,
                makeContactModel(kContactModelDefault,
                                 HeightfieldSurface(held->filled, held->frame, 1.0)));
            addTiles(held->triangleCount(), held->frame, TiledRaster(cache_, tilesOf(*held)),
                     tileHeightsOf(*held));
            if (window.columns == columns_ && window.rows == rows_) {
                break;
            }
        }
        return Done{};
    }

    Status openWhole()
    {
        Result<std::shared_ptr<const Map>> map = openInTiles(options_, monitor_);
        if (!map) {
            return std::move(map).error();
        }
        whole_ = std::move(map).value();
        const TouchedTiles tiles = touchedTiles(whole_);
        addTiles(whole_->info().triangleCount(), tiles.frame, tiles.raster, tiles.heights);
        return Done{};
    }

    void add(std::uint64_t triangle_count,
             const char* storage,
             const SceneFrame& frame,
             std::unique_ptr<MapContactModel> model)
    {
        sizes_.push_back({.triangle_count = triangle_count,
                          .storage = storage,
                          .frame = frame,
                          .model = std::move(model),
                          .ns = std::vector<double>(options_.speeds_cells.size(),
                                                    std::numeric_limits<double>::infinity())});
    }

    void addTiles(std::uint64_t triangle_count,
                  const SceneFrame& frame,
                  const TiledRaster& raster,
                  std::shared_ptr<const TileHeights> heights)
    {
        auto terrain = std::make_shared<WaitingTerrain>(raster, std::move(heights));
        tiles_.emplace_back(terrain, raster.name());
        add(triangle_count, "tiles", frame,
            makeContactModel(kContactModelDefault, TiledHeightfieldSurface(terrain, frame, 1.0)));
    }

    // The same terrain for every size: scene coordinates are those of the whole map.
    SwipeArea areaIn(const SceneFrame& frame) const
    {
        const GridWindow part = middleOf(columns_, rows_, kSideLeast, kSideLeast);
        const SceneFrame& smallest = sizes_.front().frame;
        const auto grid = [&](std::size_t column, std::size_t row) {
            // Frames differ by whole samples only.
            return GridPoint{static_cast<double>(column) + frame.origin.column -
                                 smallest.origin.column,
                             static_cast<double>(row) + frame.origin.row - smallest.origin.row};
        };
        return {grid(kMargin, kMargin), grid(part.columns - 1 - kMargin, part.rows - 1 - kMargin)};
    }

    // All sizes in turn in every round, so that disturbances on the machine affect all alike.
    void measure()
    {
        for (int round = 0; round < kRounds; ++round) {
            for (std::size_t s = 0; s < options_.speeds_cells.size(); ++s) {
                for (Size& size : sizes_) {
                    if (monitor_.isCanceled()) {
                        return;
                    }
                    const double ns = swipe(size, options_.speeds_cells[s]);
                    if (round > 0) { // the first one warms up
                        size.ns[s] = std::min(size.ns[s], ns);
                    }
                }
            }
            monitor_.report((round + 1.0) / kRounds);
        }
    }

    // Nanoseconds per update.
    double swipe(Size& size, double speed) const
    {
        SwipingHand hand(
            SwipePath(areaIn(size.frame), {.speed_cells = speed, .seed = options_.seed}),
            size.frame, speed);
        ContactState state = size.model->place(hand.begin());
        const std::uint64_t begin = TickClock::now();
        for (std::size_t i = 0; i < options_.update_count; ++i) {
            state = size.model->update(hand.next(state.proxy));
        }
        const std::uint64_t end = TickClock::now();
        return clock_.nanoseconds(end - begin) / static_cast<double>(options_.update_count);
    }

    void addResultsTo(BenchJson& json) const
    {
        json["updates"] = options_.update_count;
        json["cells_per_update"] = options_.speeds_cells;
        BenchJson sizes = BenchJson::array();
        double worst = 0.0;
        for (const Size& size : sizes_) {
            // Compares with the smallest part of the same storage kind.
            const auto first = std::find_if(sizes_.begin(), sizes_.end(), [&](const Size& other) {
                return std::string_view(other.storage) == size.storage;
            });
            BenchJson growth = BenchJson::array();
            for (std::size_t s = 0; s < size.ns.size(); ++s) {
                growth.push_back(size.ns[s] / first->ns[s]);
                worst = std::max(worst, size.ns[s] / first->ns[s]);
            }
            sizes.push_back({{"triangle_count", size.triangle_count},
                             {"storage", size.storage},
                             {"ns_per_update", size.ns},
                             {"growth", growth}});
        }
        json["growth_most"] = worst;
        json["sizes"] = sizes;
    }

    const TerrainBenchOptions& options_;
    JobMonitor& monitor_;
    TickClock clock_;
    TileCache cache_{{.bytes_max = std::size_t{256} << 20, .loader_threads = 1}};
    std::shared_ptr<const Map> whole_;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::vector<Size> sizes_;
    std::vector<std::pair<std::shared_ptr<WaitingTerrain>, std::string>> tiles_;
};

} // namespace

Result<BenchJson> measureGrowth(const TerrainBenchOptions& options)
{
    LongJob job("measuring growth");
    return Growth(options, job.monitor()).run();
}

} // namespace marsview
