// One update of each contact model over a map in memory and over the same map in tiles that are all
// resident: the cost of reading through a resident window. The hash of the proxies is the same for
// both.
//
// Compare the two times only within one run: --benchmark_enable_random_interleaving=true
// --benchmark_repetitions=5
#include "core/contact/contact_model.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace marsview {
namespace {

// The same size as the finest level of a window: 8 × 8 tiles.
constexpr std::size_t kSide = 2048;

struct Ground {
    test::TiledMap map;
    std::unique_ptr<Clipmap> window;
    std::shared_ptr<const ResidentTerrain> terrain;
};

const Ground& ground()
{
    static const Ground kGround = [] {
        const auto heights = test::fractalHeights(kSide, kSide, 20031);
        Ground made{test::tiledMap(test::int16Terrain(
                        kSide, kSide, {.gain = 1.0 / 64.0},
                        [&heights](std::size_t column, std::size_t row) {
                            return static_cast<double>(heights[row * kSide + column]);
                        })),
                    nullptr, nullptr};
        made.window = std::make_unique<Clipmap>(
            made.map.window({static_cast<double>(kSide) / 2.0, static_cast<double>(kSide) / 2.0}));
        for (const TileId& id : test::tilesOf(*made.window)) {
            made.window->put(made.map.tile(id), 0.0);
        }
        made.terrain = std::make_shared<const ResidentTerrain>(*made.window, made.map.heights);
        return made;
    }();
    return kGround;
}

SceneFrame centeredFrame()
{
    constexpr double kCenter = static_cast<double>(kSide - 1) / 2.0;
    return {.origin = {kCenter, kCenter}};
}

// A goal that moves at a constant speed, 2 to 5 meters below the surface, and turns back at the
// border.
std::vector<ScenePoint> path(double cells)
{
    const HeightfieldSurface surface(ground().map.filled, centeredFrame(), 1.0);
    constexpr std::size_t kCount = 20000;
    std::mt19937_64 random(7);
    const auto uniform = [&random](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    std::vector<ScenePoint> goals;
    ScenePoint p{};
    double heading = 0.7;
    for (std::size_t i = 0; i < kCount; ++i) {
        heading += uniform(-0.05, 0.05);
        constexpr double kReach = static_cast<double>(kSide) / 2.0 - 64.0;
        if (std::abs(p.x + cells * std::cos(heading)) > kReach ||
            std::abs(p.y + cells * std::sin(heading)) > kReach) {
            heading = std::atan2(-p.y, -p.x);
        }
        p.x += cells * std::cos(heading);
        p.y += cells * std::sin(heading);
        const double share = 0.5 + 0.5 * std::sin(static_cast<double>(i) * cells * 0.013);
        p.z = surface.height(surface.frame().toGrid(p)) - 5.0 + 3.0 * share;
        goals.push_back(p);
    }
    return goals;
}

void run(benchmark::State& state, ContactModelKind kind, bool is_tiled)
{
    const double cells = static_cast<double>(state.range(0)) / 10.0;
    const std::vector<ScenePoint> goals = path(cells);
    const ContactModelOptions options{.radius_m = 0.1};
    const auto model =
        is_tiled
            ? makeContactModel(
                  kind, TiledHeightfieldSurface(ground().terrain, centeredFrame(), 1.0), options)
            : makeContactModel(kind, HeightfieldSurface(ground().map.filled, centeredFrame(), 1.0),
                               options);
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const ScenePoint& goal : goals) { // once for the hash, and to warm the caches
        const ContactState at = model->update(goal);
        for (const double value : {at.proxy.x, at.proxy.y, at.proxy.z}) {
            hash = (hash ^ static_cast<std::uint64_t>(std::llround(value * 1e6))) * 0x100000001b3U;
        }
    }
    std::size_t i = 0;
    model->place(goals[0]);
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(model->update(goals[i]));
        i = i + 1 == goals.size() ? 0 : i + 1;
    }
    state.SetLabel(fmt::format("hash {:016x}", hash));
}

void registerAll()
{
    for (const ContactModelKind kind : kContactModelKinds) {
        for (const bool is_tiled : {false, true}) {
            const std::string name =
                fmt::format("BM_{}/{}", contactModelName(kind), is_tiled ? "resident" : "memory");
            auto* bench = benchmark::RegisterBenchmark(
                name.c_str(),
                [kind, is_tiled](benchmark::State& state) { run(state, kind, is_tiled); });
            bench->Arg(1)->Arg(10)->Arg(100)->Arg(500); // tenths of a cell per update
        }
    }
}

} // namespace
} // namespace marsview

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    marsview::registerAll();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
