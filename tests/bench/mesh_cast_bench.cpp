// Segment casts and nearest-point queries over general meshes, by the number of triangles, and the
// cost of checking and building a mesh. Prints a hash of the results.
#include "core/mesh/mesh_cast.h"
#include "core/mesh/triangle_mesh.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace marsview {
namespace {

class Random {
public:
    double uniform(double low, double high)
    {
        return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
    }

private:
    std::mt19937_64 engine_{7};
};

// A rough ball: 2 n² triangles, radius 1 to 1.2, poles closed by fans.
TriangleSoup ball(std::uint32_t n)
{
    Random random;
    TriangleSoup soup;
    soup.vertices.push_back({0.0, 0.0, 1.1});
    for (std::uint32_t i = 1; i < n; ++i) {
        const double polar = std::numbers::pi * i / n;
        for (std::uint32_t j = 0; j < n; ++j) {
            const double around = 2.0 * std::numbers::pi * j / n;
            const double rough = std::min(0.1, 1.0 / n); // independent of the resolution
            const double radius = 1.1 + 0.08 * std::sin(7.0 * polar) * std::cos(5.0 * around) +
                                  random.uniform(-rough, rough) * 0.5;
            soup.vertices.push_back({radius * std::sin(polar) * std::cos(around),
                                     radius * std::sin(polar) * std::sin(around),
                                     radius * std::cos(polar)});
        }
    }
    const auto last = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.push_back({0.0, 0.0, -1.1});
    const auto at = [n](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * n + j % n; };
    for (std::uint32_t j = 0; j < n; ++j) {
        soup.faces.push_back({0, at(1, j), at(1, j + 1)});
        for (std::uint32_t i = 1; i + 1 < n; ++i) {
            soup.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
        soup.faces.push_back({last, at(n - 1, j + 1), at(n - 1, j)});
    }
    return soup;
}

const std::shared_ptr<const TriangleMesh>& meshOf(std::int64_t n)
{
    static std::map<std::int64_t, std::shared_ptr<const TriangleMesh>> meshes;
    auto& mesh = meshes[n];
    if (!mesh) {
        JobMonitor monitor;
        mesh = TriangleMesh::build(ball(static_cast<std::uint32_t>(n)), monitor).value();
    }
    return mesh;
}

struct Segment {
    ScenePoint from;
    ScenePoint to;
};

std::uint64_t mixed(std::uint64_t hash, const std::optional<MeshPlace>& place)
{
    return (hash ^ (place ? place->face + 1 : 0)) * 0x100000001b3U;
}

void castAll(benchmark::State& state, const std::vector<Segment>& segments)
{
    const TriangleMesh& mesh = *meshOf(state.range(0));
    std::uint64_t hash = 0xcbf29ce484222325U;
    double faces = 0.0;
    double hits = 0.0;
    for (const Segment& s : segments) {
        const MeshCast cast = castSegment(mesh, {.base = s.from}, {s.to});
        hash = mixed(hash, cast.hit);
        faces += cast.faces;
        hits += cast.hit ? 1.0 : 0.0;
    }
    std::size_t i = 0;
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(castSegment(mesh, {.base = segments[i].from}, {segments[i].to}));
        i = i + 1 == segments.size() ? 0 : i + 1;
    }
    const double n = static_cast<double>(segments.size());
    state.counters["triangles"] = static_cast<double>(mesh.faceCount());
    state.counters["faces"] = faces / n; // tests per cast
    state.counters["hits"] = hits / n;
    state.SetLabel(fmt::format("hash {:016x}", hash));
}

std::vector<Segment> segments(double reach_from, double step_low, double step_high)
{
    Random random;
    std::vector<Segment> all;
    for (int i = 0; i < 20000; ++i) {
        const auto direction = [&random] {
            return normalized({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                               random.uniform(-1.0, 1.0) + 1e-3});
        };
        const ScenePoint from = direction() * reach_from;
        all.push_back({from, from + direction() * random.uniform(step_low, step_high)});
    }
    return all;
}

// From just outside the ball, as long as a typical movement of the goal: mostly free, as during
// contact.
void BM_MeshCastShort(benchmark::State& state)
{
    castAll(state, segments(1.2, 0.0, 0.02));
}

// Across the whole ball.
void BM_MeshCastLong(benchmark::State& state)
{
    castAll(state, segments(2.0, 1.0, 4.0));
}

void BM_MeshNearest(benchmark::State& state)
{
    const TriangleMesh& mesh = *meshOf(state.range(0));
    const std::vector<Segment> points = segments(1.15, 0.0, 0.1);
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const Segment& s : points) {
        hash = mixed(hash, nearestPlace(mesh, s.to));
    }
    std::size_t i = 0;
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(nearestPlace(mesh, points[i].to));
        i = i + 1 == points.size() ? 0 : i + 1;
    }
    state.counters["triangles"] = static_cast<double>(mesh.faceCount());
    state.SetLabel(fmt::format("hash {:016x}", hash));
}

void BM_MeshBuild(benchmark::State& state)
{
    const TriangleSoup soup = ball(static_cast<std::uint32_t>(state.range(0)));
    std::size_t bytes = 0;
    for ([[maybe_unused]] auto _ : state) {
        JobMonitor monitor;
        const auto mesh = TriangleMesh::build(soup, monitor).value();
        bytes = mesh->byteCount();
    }
    const double faces = static_cast<double>(soup.faces.size());
    state.counters["triangles"] = faces;
    state.counters["bytes_per_triangle"] = static_cast<double>(bytes) / faces;
}

// Twice the square of the argument is the number of triangles: 1000, 100 000, 1 000 000.
BENCHMARK(BM_MeshCastShort)->Arg(23)->Arg(224)->Arg(708);
BENCHMARK(BM_MeshCastLong)->Arg(23)->Arg(224)->Arg(708);
BENCHMARK(BM_MeshNearest)->Arg(23)->Arg(224)->Arg(708);
BENCHMARK(BM_MeshBuild)->Arg(23)->Arg(224)->Arg(708)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace marsview

BENCHMARK_MAIN();
