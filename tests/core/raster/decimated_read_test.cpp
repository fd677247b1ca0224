#include "core/raster/decimated_read.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace marsview {
namespace {

using namespace std::chrono_literals;
using test::TempFolder;

constexpr auto kForever = std::chrono::hours(1);

struct Source {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<std::int16_t> samples;
};

// Every sample is different, as far as int16 allows, with a few voids (-9999).
Source noise(std::size_t columns, std::size_t rows)
{
    test::Random random;
    Source source{columns, rows, {}};
    for (std::size_t i = 0; i < columns * rows; ++i) {
        source.samples.push_back(random.chance(0.05)
                                     ? std::int16_t{-9999}
                                     : static_cast<std::int16_t>(random.below(20000)));
    }
    return source;
}

std::string write(const TempFolder& folder,
                  const std::string& name,
                  const Source& source,
                  const std::vector<std::string>& options)
{
    test::RasterRecipe recipe = test::recipeFor(source.columns, source.samples);
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue>";
    std::vector<std::string> arguments;
    for (const std::string& option : options) {
        arguments.insert(arguments.end(), {"-co", option});
    }
    return test::writeRaster(folder, name, "GTiff", recipe, arguments);
}

Result<DecimatedSamples> decimated(const std::string& path, const DecimationLimits& limits)
{
    Result<RasterFile> file = RasterFile::open(path);
    EXPECT_TRUE(file) << file.error().message;
    JobMonitor monitor;
    return readDecimated(*file, {file->info().nodata}, limits, monitor);
}

// Each sample is the source sample whose pixel contains the center of its block.
void expectPicked(const DecimatedSamples& picked, const Source& source)
{
    const SampleGrid& grid = picked.loaded.grid;
    std::uint64_t void_count = 0;
    double minimum = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < grid.rows(); ++j) {
        for (std::size_t i = 0; i < grid.columns(); ++i) {
            const double x = (static_cast<double>(i) + 0.5) * static_cast<double>(source.columns) /
                             static_cast<double>(grid.columns());
            const double y = (static_cast<double>(j) + 0.5) * static_cast<double>(source.rows) /
                             static_cast<double>(grid.rows());
            const std::int16_t truth = source.samples[static_cast<std::size_t>(y) * source.columns +
                                                      static_cast<std::size_t>(x)];
            ASSERT_EQ(grid.isVoid(i, j), truth == -9999) << i << ", " << j;
            ASSERT_EQ(grid.raw(i, j), truth) << i << ", " << j;
            void_count += truth == -9999 ? 1 : 0;
            minimum = truth == -9999 ? minimum : std::min<double>(minimum, truth);
        }
    }
    EXPECT_EQ(picked.loaded.statistics.void_count, void_count);
    EXPECT_EQ(picked.loaded.statistics.sample_count, grid.columns() * grid.rows());
    EXPECT_EQ(picked.loaded.statistics.raw_minimum, minimum);
}

TEST(DecimatedRead, PicksSamplesOfTheSourceForAnyBlockSize)
{
    const TempFolder folder;
    const Source source = noise(1003, 517);
    const std::vector<std::vector<std::string>> layouts{
        {},                                              // strips
        {"BLOCKYSIZE=1", "COMPRESS=DEFLATE"},            // single rows
        {"BLOCKYSIZE=517", "COMPRESS=LZW"},              // one block for all
        {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=16"}, // raw tiles
        {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "COMPRESS=ZSTD"}};
    for (std::size_t k = 0; k < layouts.size(); ++k) {
        const std::string path =
            write(folder, "map" + std::to_string(k) + ".tif", source, layouts[k]);
        for (const std::size_t samples_max : {4U, 777U, 30'000U, 1'000'000U}) {
            const auto picked = decimated(path, {.samples_max = samples_max, .time_max = kForever});
            ASSERT_TRUE(picked) << picked.error().message;
            EXPECT_LE(picked->loaded.grid.columns() * picked->loaded.grid.rows(), samples_max);
            EXPECT_TRUE(picked->is_finest);
            EXPECT_FALSE(picked->is_overview);
            expectPicked(*picked, source);
        }
    }
}

TEST(DecimatedRead, UsesItsSampleLimitAndKeepsTheAspect)
{
    const TempFolder folder;
    const Source source = noise(900, 300);
    const auto picked = decimated(write(folder, "map.tif", source, {}),
                                  {.samples_max = 30'000, .time_max = kForever});
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->loaded.grid.columns(), 300U);
    EXPECT_EQ(picked->loaded.grid.rows(), 100U);
}

TEST(DecimatedRead, ReadsASmallRasterWhole)
{
    const TempFolder folder;
    const Source source = noise(40, 30);
    const auto picked = decimated(write(folder, "map.tif", source, {}), {.samples_max = 1200});
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->loaded.grid.columns(), 40U);
    EXPECT_EQ(picked->loaded.grid.rows(), 30U);
    EXPECT_TRUE(picked->is_finest);
    expectPicked(*picked, source);
}

// A clock that advances by `step` at every reading.
std::function<std::chrono::nanoseconds()> steps(std::chrono::nanoseconds step)
{
    return [now = std::make_shared<std::atomic<std::int64_t>>(0), step] {
        return std::chrono::nanoseconds(now->fetch_add(step.count()));
    };
}

TEST(DecimatedRead, StopsAtTheTimeLimitWithAtLeastOneResult)
{
    const TempFolder folder;
    const Source source = noise(2048, 1024);
    const std::string path =
        write(folder, "map.tif", source, {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"});
    const auto slow = decimated(
        path, {.samples_max = 1 << 19, .time_max = 1s, .now = steps(std::chrono::hours(1))});
    ASSERT_TRUE(slow) << slow.error().message;
    EXPECT_EQ(slow->loaded.grid.columns(), 32U);
    EXPECT_EQ(slow->loaded.grid.rows(), 16U);
    EXPECT_FALSE(slow->is_finest);
    expectPicked(*slow, source);
    const auto fast = decimated(path, {.samples_max = 1 << 19, .time_max = 1s, .now = steps(0ns)});
    ASSERT_TRUE(fast);
    EXPECT_EQ(fast->loaded.grid.columns(), 1024U);
    EXPECT_TRUE(fast->is_finest);
    expectPicked(*fast, source);
    // A disk of medium speed: the first read takes a tenth of the time, the second the rest.
    const auto middling = decimated(
        path,
        {.samples_max = 1 << 19,
         .time_max = 1s,
         .now = [count = std::make_shared<std::atomic<int>>(0)]() -> std::chrono::nanoseconds {
             const int n = (*count)++;
             return n <= 4 ? n * 100ms : 400ms + (n - 4) * 12ms;
         }});
    ASSERT_TRUE(middling);
    EXPECT_GT(middling->loaded.grid.columns(), 32U);
    EXPECT_LT(middling->loaded.grid.columns(), 1024U);
    EXPECT_FALSE(middling->is_finest);
    expectPicked(*middling, source);
}

TEST(DecimatedRead, RefinesWhileAllSamplesAreVoid)
{
    const TempFolder folder;
    Source source{2048, 1024, std::vector<std::int16_t>(2048 * 1024, -9999)};
    for (std::size_t row = 500; row < 504; ++row) {
        for (std::size_t column = 1200; column < 1204; ++column) {
            source.samples[row * source.columns + column] = 7;
        }
    }
    const auto picked =
        decimated(write(folder, "map.tif", source, {"TILED=YES"}),
                  {.samples_max = 1 << 19, .time_max = 1s, .now = steps(std::chrono::hours(1))});
    ASSERT_TRUE(picked) << picked.error().message;
    EXPECT_TRUE(picked->loaded.statistics.hasSamples());
    EXPECT_FALSE(picked->is_finest);
    expectPicked(*picked, source);
}

TEST(DecimatedRead, UsesTheLargestAffordableOverview)
{
    const TempFolder folder;
    const Source source = noise(2000, 1500);
    const std::string path = write(folder, "map.tif", source, {"TILED=YES"});
    test::runTool({"gdaladdo", "-q", "-r", "nearest", path, "2", "4", "8"});
    const auto picked = decimated(path, {.samples_max = 200'000});
    ASSERT_TRUE(picked) << picked.error().message;
    EXPECT_TRUE(picked->is_overview);
    EXPECT_EQ(picked->loaded.grid.columns(), 500U);
    EXPECT_EQ(picked->loaded.grid.rows(), 375U);
    // An overview with almost no valid samples is skipped.
    const auto few = decimated(path, {.samples_max = 10'000, .time_max = kForever});
    ASSERT_TRUE(few);
    EXPECT_FALSE(few->is_overview);
    expectPicked(*few, source);
}

TEST(DecimatedRead, HonorsMasksAndTheUsersNodata)
{
    const TempFolder folder;
    const Source source = noise(300, 200);
    test::RasterRecipe recipe = test::recipeFor(source.columns, source.samples);
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue>";
    const std::string path =
        test::writeRaster(folder, "map.tif", "GTiff", recipe, {"-a_nodata", "none", "-mask", "1"});
    Result<RasterFile> file = RasterFile::open(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->info().has_mask_band);
    JobMonitor monitor;
    const auto masked =
        readDecimated(*file, {}, {.samples_max = 5000, .time_max = kForever}, monitor);
    ASSERT_TRUE(masked);
    EXPECT_GT(masked->loaded.statistics.void_count, 0U);
    expectPicked(*masked, source);
    const double nodata = masked->loaded.grid.raw(7, 7);
    const auto overridden =
        readDecimated(*file, {nodata}, {.samples_max = 5000, .time_max = kForever}, monitor);
    ASSERT_TRUE(overridden);
    EXPECT_TRUE(overridden->loaded.grid.isVoid(7, 7));
    EXPECT_GT(overridden->loaded.statistics.void_count, masked->loaded.statistics.void_count);
}

TEST(DecimatedRead, StopsWhenCanceledAndReportsReadErrors)
{
    const TempFolder folder;
    const Source source = noise(1000, 800);
    const std::string path = write(folder, "map.tif", source, {});
    Result<RasterFile> file = RasterFile::open(path);
    ASSERT_TRUE(file);
    JobMonitor monitor;
    monitor.cancel();
    const auto canceled = readDecimated(*file, {}, {.samples_max = 5000}, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    JobMonitor unwatched;
    const auto damaged =
        readDecimated(*file, {}, {.samples_max = 5000, .time_max = kForever}, unwatched);
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(damaged.error().message.find(path + ": "), 0U);
}

// Against gdallocationinfo, which shares no code with the program.
TEST(DecimatedRead, AgreesWithGdalOnRealMaps)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    std::size_t checked = 0;
    for (const test::CatalogueEntry& entry : test::catalogue()) {
        const std::string path = (test::sharedData() / entry.path).string();
        Result<RasterFile> file = RasterFile::open(path);
        if (!file || file->info().columns * file->info().rows < 100'000 ||
            file->info().driver == "netCDF" || entry.path.find("truncated") != std::string::npos) {
            continue;
        }
        const RasterInfo info = file->info();
        JobMonitor monitor;
        const auto picked = readDecimated(*file, {info.nodata},
                                          {.samples_max = 2000, .time_max = kForever}, monitor);
        ASSERT_TRUE(picked) << picked.error().message;
        const SampleGrid& grid = picked->loaded.grid;
        std::vector<test::Pixel> pixels;
        for (std::size_t j = 0; j < grid.rows(); ++j) {
            for (std::size_t i = 0; i < grid.columns(); ++i) {
                pixels.push_back({(2 * i + 1) * info.columns / (2 * grid.columns()),
                                  (2 * j + 1) * info.rows / (2 * grid.rows())});
            }
        }
        const std::vector<double> truth = test::rawSamples(info.path, pixels);
        ASSERT_EQ(truth.size(), pixels.size()) << path;
        for (std::size_t k = 0; k < truth.size(); ++k) {
            const double raw = grid.raw(k % grid.columns(), k / grid.columns());
            ASSERT_TRUE(std::abs(raw - truth[k]) <= 1e-12 * std::abs(truth[k]) ||
                        (std::isnan(raw) && std::isnan(truth[k])))
                << path << " sample " << k << ": " << raw << ", expected " << truth[k];
        }
        ++checked;
    }
    EXPECT_GE(checked, 5U);
}

} // namespace
} // namespace marsview
