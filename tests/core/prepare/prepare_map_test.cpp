#include "core/levels/level_file.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/prepare_map.h"
#include "core/session/open_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using WhenThere = PrepareJob::WhenThere;

class PrepareMap : public testing::Test {
protected:
    std::string source(const std::string& name, int seed = 0) const
    {
        std::vector<std::int16_t> samples;
        for (std::size_t i = 0; i < std::size_t{700} * 1300; ++i) {
            const auto column = static_cast<double>(i % 700);
            samples.push_back(static_cast<std::int16_t>(300.0 * std::sin(0.01 * column + seed) +
                                                        static_cast<double>(i / 700 * 7919 % 13)));
        }
        return test::writeVrt(folder_, name, test::recipeFor(700, samples));
    }
    PrepareJob job(WhenThere when_there) const
    {
        return {.raster_path = folder_.file("out.tif"), .when_there = when_there};
    }
    Result<PrepareReport> run(const PrepareJob& job) const
    {
        return run(folder_.file("map.vrt"), job);
    }
    static Result<PrepareReport> run(const std::string& path, const PrepareJob& job)
    {
        JobMonitor monitor;
        return prepareMapFiles(*openRaster({.path = path}), job, monitor);
    }
    static void overwrite(const std::string& path, double share)
    {
        const fs::file_time_type time = fs::last_write_time(path);
        std::string content = test::readFile(path);
        const auto at = static_cast<std::size_t>(share * static_cast<double>(content.size()));
        for (std::size_t i = at; i < std::min(at + 50, content.size()); ++i) {
            content[i] = static_cast<char>(content[i] ^ 0x5A);
        }
        std::ofstream(path, std::ios::binary) << content;
        fs::last_write_time(path, time);
    }

    test::TempFolder folder_;
};

} // namespace

TEST_F(PrepareMap, UsesTiledRastersWithOverviewsInPlace)
{
    const test::RasterRecipe recipe =
        test::recipeFor(1300, std::vector<std::int16_t>(std::size_t{1300} * 1100, 7));
    const auto is_used_in_place = [](const std::string& path) {
        return canBeUsedInPlace(openRaster({.path = path}).value());
    };
    const auto write = [&](const char* name, const char* driver, std::vector<std::string> options) {
        return test::writeRaster(folder_, name, driver, recipe, options);
    };
    EXPECT_FALSE(is_used_in_place(write("strips.tif", "GTiff", {})));
    EXPECT_FALSE(is_used_in_place(write("map.asc", "AAIGrid", {})));
    EXPECT_TRUE(is_used_in_place(write("cog.tif", "COG", {})));

    const std::string tiled = write("tiled.tif", "GTiff", {"-co", "TILED=YES"});
    EXPECT_FALSE(is_used_in_place(tiled)); // no picture of all of it is cheap
    test::runTool({"gdaladdo", "-q", "-r", "average", tiled, "2"});
    EXPECT_TRUE(is_used_in_place(tiled));

    const std::string sparse = write("sparse.tif", "GTiff", {"-co", "TILED=YES"});
    test::runTool({"gdaladdo", "-q", "-r", "average", sparse, "8"});
    EXPECT_FALSE(is_used_in_place(sparse)); // the levels between are missing
}

TEST_F(PrepareMap, RebuildsACopyThatIsDamagedAnywhere)
{
    source("map");
    ASSERT_TRUE(run(job(WhenThere::Check)));
    const std::string out = folder_.file("out.tif");
    const std::string whole = test::readFile(out);
    std::size_t noticed_late = 0;
    for (const double share : {0.1, 0.2, 0.3, 0.35, 0.4, 0.47, 0.55, 0.6, 0.67, 0.9}) {
        overwrite(out, share);
        // The fields that identify the file may reveal the damage.
        ASSERT_TRUE(run(job(WhenThere::Trust)));
        const bool is_left = test::readFile(out) != whole;
        noticed_late += is_left ? 1U : 0U;
        const Result<PrepareReport> report = run(job(WhenThere::Check));
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_THAT(report->notes,
                    Contains(EndsWith(is_left ? "it is rebuilt" : "all tiles are intact")))
            << share;
        EXPECT_TRUE(test::readFile(out) == whole) << share;
        const Result<PrepareReport> again = run(job(WhenThere::Check));
        ASSERT_TRUE(again);
        EXPECT_THAT(again->notes, Contains(EndsWith("all tiles are intact")));
    }
    EXPECT_GT(noticed_late, 0U);
}

TEST_F(PrepareMap, RebuildsADamagedCopyWithoutALevelFile)
{
    source("map");
    const std::string out = folder_.file("out.tif");
    ASSERT_TRUE(run(job(WhenThere::Trust)));
    const std::string whole = test::readFile(out);
    for (const double share : {0.1, 0.2, 0.35, 0.47, 0.55, 0.67, 0.9}) {
        // The state after a program that was killed before it measured the levels.
        fs::remove(LevelFile::pathFor(out));
        overwrite(out, share);
        const Result<PrepareReport> report = run(job(WhenThere::Trust));
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_THAT(report->notes, Contains(EndsWith("it is rebuilt"))) << share;
        EXPECT_FALSE(report->copy.is_there);
        EXPECT_TRUE(test::readFile(out) == whole) << share;
        const Result<PrepareReport> again = run(job(WhenThere::Check));
        ASSERT_TRUE(again);
        EXPECT_THAT(again->notes, Contains(EndsWith("all tiles are intact")));
    }
}

TEST_F(PrepareMap, NeverTouchesADamagedRasterOfTheUser)
{
    source("map");
    const std::string own = folder_.file("own.tif");
    test::runTool({"gdal_translate", "-q", "-of", "COG", "-co", "COMPRESS=DEFLATE",
                   folder_.file("map.vrt"), own});
    overwrite(own, 0.5);
    const std::string damaged = test::readFile(own);
    for (const std::string& copy : {std::string(), folder_.file("copy.tif")}) {
        const Result<PrepareReport> report = run(own, {.raster_path = copy});
        ASSERT_FALSE(report);
        EXPECT_THAT(report.error().message, testing::StartsWith(own + ": "));
        EXPECT_TRUE(test::readFile(own) == damaged);
        EXPECT_FALSE(fs::exists(LevelFile::pathFor(own)));
        EXPECT_FALSE(fs::exists(folder_.file("copy.tif")));
    }
}

TEST_F(PrepareMap, RebuildsALevelFileThatIsDamagedAnywhere)
{
    source("map");
    ASSERT_TRUE(run(job(WhenThere::Check)));
    const std::string levels = LevelFile::pathFor(folder_.file("out.tif"));
    fs::file_time_type copied = fs::last_write_time(folder_.file("out.tif"));
    for (const double share : {0.0, 0.02, 0.1, 0.3, 0.7, 0.99}) {
        overwrite(levels, share);
        const Result<PrepareReport> report = run(job(WhenThere::Check));
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_THAT(report->notes, Contains(EndsWith("it is rebuilt"))) << share;
        // Without the checksums, nothing proves that the copy is undamaged.
        const fs::file_time_type now = fs::last_write_time(folder_.file("out.tif"));
        EXPECT_TRUE(now == copied || share < 0.01 || share > 0.5) << share;
        copied = now;
        const Result<PrepareReport> again = run(job(WhenThere::Check));
        ASSERT_TRUE(again);
        EXPECT_THAT(again->notes, Contains(EndsWith("all tiles are intact")));
    }
}

TEST_F(PrepareMap, NamesTheRemedyForADamagedRasterUsedInPlace)
{
    source("map");
    ASSERT_TRUE(run(job(WhenThere::Check)));
    const std::string out = folder_.file("out.tif");
    const std::string own = folder_.file("own.tif"); // its source is not recorded
    test::runTool({"gdal_translate", "-q", "-of", "COG", folder_.file("map.vrt"), own});
    ASSERT_TRUE(run(own, {}));
    for (const auto& [path, remedy] :
         {std::pair{out, "prepare it again from " + folder_.file("map.vrt")},
          std::pair{own, std::string("restore or fetch it again")}}) {
        const std::string levels = test::readFile(LevelFile::pathFor(path));
        overwrite(path, 0.5);
        const Result<PrepareReport> report = run(path, {.when_there = WhenThere::Check});
        ASSERT_FALSE(report) << path;
        EXPECT_THAT(report.error().message, HasSubstr("is damaged in the tile"));
        EXPECT_THAT(report.error().message, HasSubstr(remedy));
        EXPECT_TRUE(test::readFile(LevelFile::pathFor(path)) == levels);
    }
}

TEST_F(PrepareMap, KeepsTheFolderWithinItsLimit)
{
    const test::TempFolder maps;
    const MapFolder folder = MapFolder::at(maps.path());
    JobMonitor monitor;
    for (int seed = 0; seed < 3; ++seed) {
        const Result<PrepareReport> report =
            prepareInFolder(*openRaster({.path = source("map" + std::to_string(seed), seed)}),
                            {.folder = maps.path(), .folder_bytes_max = 1}, monitor);
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_EQ(folder.list()->size(), 1U);
        EXPECT_EQ(folder.list()->front().path, report->raster_path);
    }
}

TEST_F(PrepareMap, RefusesToWriteNextToARemoteRaster)
{
    const test::TempFolder maps;
    MapResources resources;
    resources.folder = maps.path();
    JobMonitor monitor;
    const std::string address = "http://localhost:1/mars.tif"; // it gets no request
    const Status built = buildOverviews({.path = address}, resources, monitor);
    ASSERT_FALSE(built);
    EXPECT_THAT(built.error().message, testing::StartsWith(address + ": is on a server"));
    EXPECT_TRUE(fs::is_empty(maps.path()));
}

} // namespace marsview
