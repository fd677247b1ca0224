// Reading whole rasters: samples per second, bytes in memory per sample, peak memory. Prints a hash
// of the samples, so that a faster run with a different result is noticed.
#include "core/raster/raster_file.h"
#include "tests/support/make_raster.h"
#include "tests/support/shared_data.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace marsview {
namespace {

// FNV-1a over the samples as doubles; a void counts as a separate value. The same on every machine.
std::uint64_t hashOf(const SampleGrid& grid)
{
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&hash](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3U; };
    for (std::size_t r = 0; r < grid.rows(); ++r) {
        for (std::size_t c = 0; c < grid.columns(); ++c) {
            if (grid.isVoid(c, r)) {
                mix(0x7ff8dead00000000U);
            } else {
                const double value = grid.raw(c, r);
                std::uint64_t bits = 0;
                static_assert(sizeof(bits) == sizeof(value));
                __builtin_memcpy(&bits, &value, sizeof(bits));
                mix(bits);
            }
        }
    }
    return hash;
}

double peakMemoryMb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void BM_ReadAll(benchmark::State& state, const std::string& path)
{
    std::uint64_t hash = 0;
    double bytes_per_sample = 0.0;
    std::int64_t samples = 0;
    for ([[maybe_unused]] auto _ : state) {
        auto file = RasterFile::open(path);
        if (!file) {
            state.SkipWithError(file.error().message.c_str());
            return;
        }
        JobMonitor monitor;
        auto loaded = file->readAll(monitor, VoidRule{file->info().nodata}, defaultMemoryBudget());
        if (!loaded) {
            state.SkipWithError(loaded.error().message.c_str());
            return;
        }
        benchmark::DoNotOptimize(loaded->statistics.raw_minimum);
        state.PauseTiming();
        const auto count = static_cast<std::int64_t>(loaded->grid.columns() * loaded->grid.rows());
        samples += count;
        bytes_per_sample = static_cast<double>(loaded->grid.bytes()) / static_cast<double>(count);
        hash = hash == 0 ? hashOf(loaded->grid) : hash;
        state.ResumeTiming();
    }
    state.SetItemsProcessed(samples);
    state.counters["bytes/sample"] = bytes_per_sample;
    state.counters["peak_MB"] = peakMemoryMb();
    state.SetLabel(fmt::format("hash {:016x}", hash));
}

// Looks like a fractal but is cheap: a sum of sines, with one void per thousand samples.
template <typename T>
std::string synthetic(const test::TempFolder& folder,
                      const std::string& name,
                      std::size_t side,
                      const std::vector<std::string>& options)
{
    std::vector<T> samples(side * side);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t row = i / side;
        const double x = static_cast<double>(i % side);
        const double y = static_cast<double>(row);
        const double height = 3000.0 * std::sin(x * 0.011) * std::cos(y * 0.017) +
                              400.0 * std::sin(x * 0.13 + y * 0.07);
        samples[i] = static_cast<T>(i % 1009 == 0 ? -9999.0 : height);
    }
    test::RasterRecipe recipe = test::recipeFor(side, samples);
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue>";
    return test::writeRaster(folder, name, "GTiff", recipe, options);
}

} // namespace
} // namespace marsview

int main(int argc, char** argv)
{
    using namespace marsview; // NOLINT(google-build-using-namespace)
    const test::TempFolder folder;
    constexpr std::size_t kSide = 2048;
    const std::vector<std::string> tiled{"-co", "TILED=YES", "-co", "COMPRESS=DEFLATE"};
    const std::pair<const char*, std::string> inputs[] = {
        {"BM_ReadAll/int16_strips/2048", synthetic<std::int16_t>(folder, "a.tif", kSide, {})},
        {"BM_ReadAll/int16_deflate_tiles/2048",
         synthetic<std::int16_t>(folder, "b.tif", kSide, tiled)},
        {"BM_ReadAll/float32_strips/2048", synthetic<float>(folder, "c.tif", kSide, {})},
        {"BM_ReadAll/float64_deflate_tiles/2048", synthetic<double>(folder, "d.tif", kSide, tiled)},
    };
    for (const auto& [name, path] : inputs) {
        benchmark::RegisterBenchmark(name, BM_ReadAll, path)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    const auto moon = test::sharedData() / "derived" / "moon_gld100_64ppd_crop_8192x4096.tif";
    if (std::filesystem::exists(moon)) {
        benchmark::RegisterBenchmark("BM_ReadAll/moon_crop/8192x4096", BM_ReadAll, moon.string())
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    } else {
        std::fprintf(stderr, "the crop of the Moon is not at %s; left out\n", moon.c_str());
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
