#include "tests/cli/run_cli.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

std::string
made(const TempFolder& folder, const std::string& name, const std::vector<std::string>& options)
{
    const std::string path = folder.file(name);
    std::vector<std::string> arguments{"bench", "terrain", "--make", path};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return path;
}

// Runs the benchmark in tiles although the map is small. The prepared files go into the folder.
nlohmann::json
measured(const TempFolder& folder, const std::string& map, const std::vector<std::string>& options)
{
    std::vector<std::string> arguments{"bench",  "terrain",  map,
                                       "--json", "--folder", folder.file("prepared")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return nlohmann::json::parse(output.out);
}

} // namespace

TEST(BenchTerrainCommand, MakesAMapOfTheSameExtent)
{
    const TempFolder folder;
    const std::string map = made(folder, "made.tif", {"--size", "700x300"});
    const nlohmann::json info = cliInfo(map);
    const nlohmann::json source = cliInfo(bundledMars());
    EXPECT_EQ(info["columns"], 700);
    EXPECT_EQ(info["rows"], 300);
    EXPECT_EQ(info["sample_type"], "Int16");
    for (const char* key : {"body", "crs_name", "vertical_datum"}) {
        EXPECT_EQ(info.value(key, nlohmann::json()), source.value(key, nlohmann::json())) << key;
    }
    // The same corners with a different step.
    EXPECT_DOUBLE_EQ(info["geotransform"][0], source["geotransform"][0]);
    EXPECT_DOUBLE_EQ(info["geotransform"][3], source["geotransform"][3]);
    EXPECT_DOUBLE_EQ(info["geotransform"][1].get<double>() * 700.0, 360.0);
    EXPECT_DOUBLE_EQ(info["geotransform"][5].get<double>() * 300.0, -180.0);
    EXPECT_FALSE(std::filesystem::exists(map + ".part"));
}

TEST(BenchTerrainCommand, MakesTheSameSamplesInEveryLayout)
{
    const TempFolder folder;
    const std::vector<std::string> size{"--size", "3000x1700", "--seed", "7"};
    const auto with = [&size](std::vector<std::string> more) {
        more.insert(more.begin(), size.begin(), size.end());
        return more;
    };
    const std::string tiles = made(folder, "tiles.tif", with({}));
    const std::string strips = made(folder, "strips.tif", with({"--layout", "strips"}));
    const std::string small =
        made(folder, "small.tif", with({"--layout", "strips", "--compress", "deflate"}));
    const std::string small_tiles =
        made(folder, "small_tiles.tif", with({"--compress", "deflate"}));
    const auto samples = [&folder](const std::string& map) {
        const std::string raw = folder.file("raw.img");
        runTool({"gdal_translate", "-q", "-of", "ENVI", map, raw});
        return readFile(raw);
    };
    const std::string expected = samples(tiles);
    EXPECT_EQ(expected.size(), 2U * 3000U * 1700U);
    EXPECT_TRUE(samples(strips) == expected);
    EXPECT_TRUE(samples(small) == expected);
    EXPECT_TRUE(samples(small_tiles) == expected);
    EXPECT_LT(std::filesystem::file_size(small), std::filesystem::file_size(strips));
    EXPECT_FALSE(samples(made(folder, "other.tif", {"--size", "3000x1700", "--seed", "8"})) ==
                 expected);
}

TEST(BenchTerrainCommand, RunsEachMeasurementAlone)
{
    const TempFolder folder;
    const std::string map = made(folder, "map.tif", {"--size", "1500x900"});
    const nlohmann::json bench =
        measured(folder, map,
                 {"--only", "prepare,swipes,identity,growth,remote", "--seconds", "0.3", "--speeds",
                  "1,50", "--updates", "500", "--held-mb", "8"});
    EXPECT_EQ(bench["file"], map);

    const nlohmann::json& prepare = bench["prepare"];
    ASSERT_FALSE(prepare.contains("left_out")) << prepare;
    EXPECT_GT(prepare["samples_per_s"], 0.0);
    EXPECT_GT(prepare["peak_memory_mb"], 1.0);
    EXPECT_GE(prepare["process_peak_memory_mb"], prepare["peak_memory_mb"].get<double>() * 0.9);
    EXPECT_GT(prepare["written_mb"], 0.0);

    const nlohmann::json& swipes = bench["swipes"];
    ASSERT_FALSE(swipes.contains("left_out")) << swipes;
    ASSERT_EQ(swipes["speeds"].size(), 2U);
    for (const nlohmann::json& row : swipes["speeds"]) {
        EXPECT_EQ(row["turns"], 300);
        EXPECT_LE(row["in_contact"], 300);
        EXPECT_GE(row["in_contact"], 200);
        EXPECT_EQ(row["cut_short"], 0);
        EXPECT_LE(row["update"]["p50_us"], row["update"]["p99_us"]);
        EXPECT_LE(row["update"]["p99_us"], row["update"]["p999_us"]);
        EXPECT_LE(row["update"]["p999_us"], row["update"]["max_us"]);
        EXPECT_EQ(row["tiles_failed"], 0);
        std::uint64_t turns = 0;
        for (const nlohmann::json& at_level : row["turns_by_coarsest_level"]) {
            turns += at_level.get<std::uint64_t>();
        }
        EXPECT_EQ(turns, 300U);
        EXPECT_EQ(row["turns_with_misses"].get<std::uint64_t>() == 0, row["worst_level"] == 0);
    }

    const nlohmann::json& identity = bench["identity"];
    ASSERT_FALSE(identity.contains("left_out")) << identity;
    EXPECT_TRUE(identity["is_whole_map"]);
    EXPECT_TRUE(identity["is_read_from_files"]) << identity["unopened"];
    EXPECT_EQ(identity["differing_proxies"], 0);
    for (const nlohmann::json& row : identity["speeds"]) {
        EXPECT_EQ(row["updates"], 500);
        EXPECT_GT(row["in_contact"], 250);
        EXPECT_GT(row["tiles_fetched"], 0);
    }

    const nlohmann::json& growth = bench["growth"];
    ASSERT_FALSE(growth.contains("left_out")) << growth;
    EXPECT_TRUE(growth["whole_map_left_out"].is_null()) << growth;
    EXPECT_EQ(growth["sizes"].front()["triangle_count"], 2 * 707 * 707);
    EXPECT_EQ(growth["sizes"].front()["growth"][0], 1.0);
    EXPECT_EQ(growth["sizes"].back()["triangle_count"], 2 * 1499 * 899);
    EXPECT_EQ(growth["sizes"].back()["storage"], "tiles");
    for (const nlohmann::json& size : growth["sizes"]) {
        EXPECT_GT(size["ns_per_update"][0], 0.0);
    }

    // Not by address.
    EXPECT_THAT(bench["remote"]["left_out"].get<std::string>(),
                testing::HasSubstr("not an address"));
    EXPECT_FALSE(bench.contains("frames"));
}

TEST(BenchTerrainCommand, FailsInOneSentenceIfTheMapCannotBeOpened)
{
    const TempFolder folder;
    for (const std::string& map : {std::string("/dev/zero"), folder.file("missing.tif"),
                                   folder.write("text.tif", "not a raster")}) {
        const ProgramOutput output = runCli({"bench", "terrain", map});
        EXPECT_EQ(output.exit_status, 1) << map;
        EXPECT_EQ(output.out, "") << map;
        EXPECT_EQ(output.err, runCli({"info", map}).err) << map;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        const ProgramOutput json = runCli({"bench", "terrain", map, "--json"});
        EXPECT_EQ(json.exit_status, 1) << map;
        EXPECT_EQ(json.out, "") << map;
        EXPECT_EQ(nlohmann::json::parse(json.err)["error"]["what"], map);
    }
}

TEST(BenchTerrainCommand, FailsIfNothingCouldBeMeasured)
{
    const TempFolder folder;
    const std::string map = made(folder, "map.tif", {"--size", "300x200"});
    const ProgramOutput json = runCli({"bench", "terrain", map, "--only", "remote", "--json"});
    EXPECT_EQ(json.exit_status, 1);
    EXPECT_EQ(json.out, "");
    EXPECT_THAT(nlohmann::json::parse(json.err)["error"]["message"].get<std::string>(),
                testing::StartsWith("not an address"));
    const ProgramOutput text = runCli({"bench", "terrain", map, "--only", "remote"});
    EXPECT_EQ(text.exit_status, 1);
    EXPECT_EQ(text.err, "marsview-cli: " + map + ": not an address; name a map by its address\n");
    EXPECT_THAT(text.out, testing::HasSubstr("skipped: " + map + ": not an address"));
}

TEST(BenchTerrainCommand, MeasuresTheSameSwipesEveryTime)
{
    const TempFolder folder;
    const std::string map = made(folder, "map.tif", {"--size", "600x500"});
    const auto contacts = [&](const char* seed) {
        const nlohmann::json bench =
            measured(folder, map,
                     {"--only", "identity", "--updates", "800", "--speeds", "5", "--seed", seed});
        return bench["identity"]["speeds"].dump();
    };
    EXPECT_EQ(contacts("3"), contacts("3"));
}

TEST(BenchTerrainCommand, DrawsAPlotOfTheGrowth)
{
    const TempFolder folder;
    const std::string map = made(folder, "map.tif", {"--size", "1500x800"});
    const std::string svg = folder.file("growth.svg");
    const ProgramOutput output =
        runCli({"bench", "terrain", map, "--only", "growth", "--updates", "200", "--speeds", "1,10",
                "--plot", svg, "--folder", folder.file("prepared")});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_THAT(output.out, testing::HasSubstr("growth at most"));
    const std::string plot = readFile(svg);
    EXPECT_TRUE(plot.starts_with("<svg "));
    for (const char* word : {"triangles", "held", "tiles", "1 cells per update"}) {
        EXPECT_THAT(plot, testing::HasSubstr(word));
    }
    EXPECT_THAT(plot, testing::Not(testing::HasSubstr("nan")));
}

TEST(BenchTerrainCommand, RefusesInvalidInput)
{
    const TempFolder folder;
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--make", folder.file("a.tif"), "--size", "1x5"},
          {"--make", folder.file("a.tif"), "--size", "5000000x5"},
          {"--make", folder.file("a.tif"), "--size", "20x20m"},
          {"--make", folder.file("a.tif"), "--layout", "rings"},
          {"--make", folder.file("a.tif"), "--compress", "magic"},
          {"--size", "100x100"},
          {"--only", "everything"},
          {"--speeds", "0"},
          {"--seconds", "nan"}}) {
        std::vector<std::string> arguments{"bench", "terrain"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(runCli(arguments).exit_status, 2) << options.back();
    }
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"--make", folder.file("no/such/folder/a.tif"), "--size",
                                   "20x20"},
          {"--make", folder.file("a.tif"), "--size", "20x20", "--from", folder.file("b.tif")}}) {
        std::vector<std::string> arguments{"bench", "terrain"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 1) << options.back();
        EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        EXPECT_FALSE(std::filesystem::exists(folder.file("a.tif")));
    }
}

} // namespace marsview::test
