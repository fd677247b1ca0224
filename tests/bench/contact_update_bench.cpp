// One update of a contact model over a fractal, by the speed of the goal. Prints a hash of the
// proxies, so that a faster run with a different result is noticed.
#include "core/contact/continuous_walk.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "tests/support/fractal_terrain.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSide = 2048;

template <typename T>
std::shared_ptr<const FilledHeightfield> terrainOf(const std::vector<float>& heights, double gain)
{
    constexpr SampleType kType =
        std::is_same_v<T, std::int16_t> ? SampleType::Int16 : SampleType::Float32;
    SampleGrid grid = SampleGrid::create(kType, kSide, kSide).value();
    std::vector<T> row(kSide);
    for (std::size_t r = 0; r < kSide; ++r) {
        std::transform(heights.begin() + static_cast<std::ptrdiff_t>(r * kSide),
                       heights.begin() + static_cast<std::ptrdiff_t>((r + 1) * kSide), row.begin(),
                       [gain](float z) { return static_cast<T>(static_cast<double>(z) / gain); });
        std::memcpy(grid.rowData(r), row.data(), kSide * sizeof(T));
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, kSide);
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics,
                                  {.gain = gain});
    JobMonitor monitor;
    return std::make_shared<const FilledHeightfield>(
        FilledHeightfield::build(heightfield, *analyze(heightfield, monitor), monitor).value());
}

const std::shared_ptr<const FilledHeightfield>& floatTerrain()
{
    static const auto kTerrain = terrainOf<float>(test::fractalHeights(kSide, kSide, 20031), 1.0);
    return kTerrain;
}

const std::shared_ptr<const FilledHeightfield>& int16Terrain()
{
    // Steps of 1/64 of a cell.
    static const auto kTerrain =
        terrainOf<std::int16_t>(test::fractalHeights(kSide, kSide, 20031), 1.0 / 64.0);
    return kTerrain;
}

SceneFrame centeredFrame()
{
    constexpr double kCenter = static_cast<double>(kSide - 1) / 2.0;
    return {.origin = {kCenter, kCenter}};
}

// A goal that moves at a constant speed, `low` to `high` meters above the surface (negative: below
// it), and turns back at the border.
std::vector<ScenePoint>
path(const HeightfieldSurface& surface, double cells, double low, double high)
{
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
        p.z = surface.height(surface.frame().toGrid(p)) + low + (high - low) * share;
        goals.push_back(p);
    }
    return goals;
}

template <template <typename> typename Model, typename S>
void run(benchmark::State& state, const S& surface, double low, double high)
{
    const double cells = static_cast<double>(state.range(0)) / 10.0;
    const HeightfieldSurface any(surface.terrain(), surface.frame(), surface.exaggeration());
    const std::vector<ScenePoint> goals = path(any, cells, low, high);
    Model<S> model(surface);
    ContactCounters sum;
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const ScenePoint& goal : goals) { // once for the counters, and to warm the caches
        const ContactState at = model.update(goal);
        sum.vertices += at.counters.vertices;
        sum.faces += at.counters.faces;
        sum.casts += at.counters.casts;
        sum.cells += at.counters.cells;
        sum.far_edges += at.counters.far_edges;
        for (const double value : {at.proxy.x, at.proxy.y, at.proxy.z}) {
            hash = (hash ^ static_cast<std::uint64_t>(std::llround(value * 1e6))) * 0x100000001b3U;
        }
    }
    std::size_t i = 0;
    model.place(goals[0]);
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(model.update(goals[i]));
        i = i + 1 == goals.size() ? 0 : i + 1;
    }
    const double n = static_cast<double>(goals.size());
    state.counters["vertices"] = sum.vertices / n;
    state.counters["faces"] = sum.faces / n;
    state.counters["casts"] = sum.casts / n;
    state.counters["cells"] = sum.cells / n;
    state.counters["far_edges"] = sum.far_edges / n;
    state.SetLabel(fmt::format("hash {:016x}", hash));
}

using FloatSurface = PlainHeightfieldSurface<float>;
using Int16Surface = PlainHeightfieldSurface<std::int16_t>;

void BM_ProxyGraph(benchmark::State& state)
{
    run<ProxyGraph>(state, FloatSurface(floatTerrain(), centeredFrame(), 1.0), -5.0, -2.0);
}

void BM_SurfaceWalk(benchmark::State& state)
{
    run<SurfaceWalk>(state, FloatSurface(floatTerrain(), centeredFrame(), 1.0), -5.0, -2.0);
}

void BM_ContinuousWalk(benchmark::State& state)
{
    run<ContinuousWalk>(state, FloatSurface(floatTerrain(), centeredFrame(), 1.0), -5.0, -2.0);
}

void BM_ProxyGraphInt16(benchmark::State& state)
{
    run<ProxyGraph>(state, Int16Surface(int16Terrain(), centeredFrame(), 1.0), -5.0, -2.0);
}

void BM_ProxyGraphTimes5(benchmark::State& state)
{
    run<ProxyGraph>(state, FloatSurface(floatTerrain(), centeredFrame(), 5.0), -5.0, -2.0);
}

void BM_ProxyGraphFree(benchmark::State& state)
{
    run<ProxyGraph>(state, FloatSurface(floatTerrain(), centeredFrame(), 1.0), 20.0, 60.0);
}

// The argument is the speed in tenths of a cell per update.
BENCHMARK(BM_ProxyGraph)->Arg(1)->Arg(10)->Arg(100)->Arg(500);
BENCHMARK(BM_SurfaceWalk)->Arg(1)->Arg(10)->Arg(100)->Arg(500);
BENCHMARK(BM_ContinuousWalk)->Arg(1)->Arg(10)->Arg(100)->Arg(500);
BENCHMARK(BM_ProxyGraphInt16)->Arg(1)->Arg(10)->Arg(100)->Arg(500);
BENCHMARK(BM_ProxyGraphTimes5)->Arg(1)->Arg(10)->Arg(100)->Arg(500);
BENCHMARK(BM_ProxyGraphFree)->Arg(1)->Arg(10)->Arg(100)->Arg(500);

} // namespace
} // namespace marsview

BENCHMARK_MAIN();
