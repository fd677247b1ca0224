// Overrides of units, scale, offset and placement on the command line.
#include "tests/cli/run_cli.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/shared_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

using testing::HasSubstr;

std::vector<std::int16_t> slope()
{
    std::vector<std::int16_t> samples(600 * 500);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<std::int16_t>(i % 600 + 2 * (i / 600));
    }
    return samples;
}

double sampleWith(const std::string& path,
                  const char* column,
                  const char* row,
                  const std::vector<std::string>& options,
                  const std::vector<std::string>& environment = {})
{
    std::vector<std::string> arguments{"sample", path, "--pixel", column, row};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCliWith(environment, arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return numbersIn(output.out).at(0);
}

} // namespace

TEST(ElevationOptions, ScaleOffsetAndUnitConvertSamplesToElevations)
{
    const TempFolder folder;
    const std::string path =
        writeRaster(folder, "map.tif", "GTiff", recipeFor(600, slope()), {"-co", "TILED=YES"});
    const double raw = rawSamples(path, {{321, 123}}).at(0);
    EXPECT_DOUBLE_EQ(
        sampleWith(path, "321", "123", {"--scale", "0.1", "--offset", "-7", "--unit", "ft"}),
        (raw * 0.1 - 7.0) * 0.3048);
    const nlohmann::json info =
        cliInfo(path, {"--scale", "-2", "--offset", "1e3", "--vertical-datum", "areoid"});
    EXPECT_EQ(info["scale"], -2.0);
    EXPECT_EQ(info["offset"], 1000.0);
    EXPECT_EQ(info["vertical_datum"], "areoid");
    EXPECT_EQ(info["maximum"], 1000.0);
    EXPECT_EQ(info["minimum"], 1000.0 - 2.0 * (599 + 2 * 499));
}

TEST(ElevationOptions, InfoNamesTheOptionForElevationsInFeet)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(2, std::vector<std::int16_t>{4458, 9000, 11000, 14176});
    recipe.srs = "EPSG:4267";
    recipe.transform = {-105.0, 0.001, 0.0, 38.0, 0.0, -0.001};
    const std::string path = writeRaster(folder, "feet.tif", "GTiff", recipe);
    const nlohmann::json info = cliInfo(path);
    EXPECT_EQ(info["vertical_unit_suggestion"], "ft");
    EXPECT_THAT(runCli({"info", path}).err, HasSubstr("--unit ft"));
    EXPECT_THAT(runCli({"render", path, "-o", folder.file("a.png"), "--size", "16x16"}).err,
                HasSubstr("--unit ft"));
    const ProgramOutput high = runCli({"sample", path, "--pixel", "1", "1"});
    EXPECT_EQ(high.out, "14176.0\n");
    EXPECT_THAT(high.err, HasSubstr("--unit ft"));
    EXPECT_EQ(runCli({"sample", path, "--pixel", "0", "0"}).err, "") << "4458 m may be meters";
    const nlohmann::json in_feet = cliInfo(path, {"--unit", "ft"});
    EXPECT_TRUE(in_feet["vertical_unit_suggestion"].is_null());
    EXPECT_DOUBLE_EQ(in_feet["maximum"], 14176 * 0.3048);
    EXPECT_EQ(runCli({"info", path, "--unit", "ft"}).err, "");
}

TEST(ElevationOptions, ApplyToAMapPreparedWithOtherOptions)
{
    const TempFolder folder;
    const std::string source =
        writeRaster(folder, "source.asc", "AAIGrid", recipeFor(600, slope()));
    const std::string plain = folder.file("plain.tif");
    const std::string scaled = folder.file("scaled.tif");
    ASSERT_EQ(runCli({"prepare", source, "-o", plain}).exit_status, 0);
    ASSERT_EQ(runCli({"prepare", source, "-o", scaled, "--scale", "0.5", "--offset", "20",
                      "--vertical-datum", "local tide"})
                  .exit_status,
              0);
    const double raw = rawSamples(source, {{599, 499}}).at(0);
    EXPECT_DOUBLE_EQ(sampleWith(scaled, "599", "499", {}), raw * 0.5 + 20.0);
    EXPECT_EQ(cliInfo(scaled)["vertical_datum"], "local tide");
    const std::vector<std::string> tiled{"MARSVIEW_HELD_MB=0"};
    for (const std::string& prepared : {plain, scaled}) {
        SCOPED_TRACE(prepared);
        const std::vector<std::string> options{"--scale", "-0.25", "--offset", "3"};
        EXPECT_DOUBLE_EQ(sampleWith(prepared, "599", "499", options), raw * -0.25 + 3.0);
        // Levels, bounds and fills are converted to elevations other than those they were prepared
        // with.
        nlohmann::json info = nlohmann::json::parse(
            runCliWith(tiled, {"info", prepared, "--json", "--scale", "-0.25", "--offset", "3"})
                .out);
        EXPECT_EQ(info["maximum"], 3.0);
        EXPECT_EQ(info["minimum"], 3.0 - 0.25 * (599 + 2 * 499));
        const std::string goals = folder.write("goals.csv", "x,y,z\n1300.5,1800.5,-50\n");
        const auto trace = [&](const std::vector<std::string>& environment) {
            return runCliWith(environment, {"trace", prepared, "--goals", goals, "--scale", "-0.25",
                                            "--offset", "3"});
        };
        const ProgramOutput from_tiles = trace(tiled);
        ASSERT_EQ(from_tiles.exit_status, 0) << from_tiles.err;
        EXPECT_EQ(from_tiles.out.substr(0, from_tiles.out.find(",vertex")),
                  trace({}).out.substr(0, from_tiles.out.find(",vertex")));
    }
}

TEST(ElevationOptions, AreRequiredToRepeatARecording)
{
    const TempFolder folder;
    const std::string recorded = folder.file("touch.csv");
    const std::vector<std::string> options{"--scale", "0.5", "--offset", "-300"};
    std::vector<std::string> loop{"loop",      bundledMars(), "--device", "sim:swipe=5,lift_s=0.2",
                                  "--seconds", "0.5",         "--record", recorded};
    loop.insert(loop.end(), options.begin(), options.end());
    const ProgramOutput looped = runCli(loop);
    ASSERT_EQ(looped.exit_status, 0) << looped.err;
    const auto differing = [&](const std::vector<std::string>& with) {
        const std::string summary = folder.file("summary.json");
        std::vector<std::string> trace{"trace",  bundledMars(), "--goals",
                                       recorded, "--summary",   summary};
        trace.insert(trace.end(), with.begin(), with.end());
        EXPECT_EQ(runCli(trace).exit_status, 0);
        return nlohmann::json::parse(readFile(summary)).value("differing_updates", -1);
    };
    EXPECT_EQ(differing(options), 0);
    EXPECT_GT(differing({}), 100);
    EXPECT_GT(differing({"--scale", "0.5"}), 100);
}

TEST(ElevationOptions, MalformedValuesAreUsageErrors)
{
    const std::string mars = bundledMars();
    for (const char* option : {"--scale", "--offset"}) {
        for (const char* value : {"nan", "inf", "much"}) {
            const ProgramOutput output = runCli({"info", mars, option, value});
            EXPECT_EQ(output.exit_status, 2) << option << " " << value;
            EXPECT_THAT(output.err, HasSubstr(option));
        }
    }
    const ProgramOutput zero = runCli({"info", mars, "--scale", "0"});
    EXPECT_EQ(zero.exit_status, 2);
    EXPECT_THAT(zero.err, HasSubstr("--scale: 0 is not a finite number other than 0"));
}

TEST(ElevationOptions, AreAcceptedByEveryCommandThatOpensAMap)
{
    for (const char* command : {"info", "sample", "trace", "loop", "prepare", "render"}) {
        const std::string help = runCli({command, "--help"}).out;
        for (const char* option : {"--scale", "--offset", "--vertical-datum"}) {
            EXPECT_THAT(help, HasSubstr(option)) << command;
        }
    }
}

TEST(CrsNotice, NamesTheOptionsThatPlaceAGridInDegrees)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(360, std::vector<std::int16_t>(360 * 180, std::int16_t{5}));
    recipe.transform = {0.0, 1.0, 0.0, 90.0, 0.0, -1.0};
    const std::string path = writeRaster(folder, "global.tif", "GTiff", recipe);
    const ProgramOutput output = runCli({"info", path, "--json"});
    ASSERT_EQ(output.exit_status, 0);
    EXPECT_THAT(output.err, HasSubstr("looks like longitude and latitude in degrees"));
    EXPECT_THAT(output.err, HasSubstr("--crs EPSG:4326 (Earth), --crs IAU_2015:49902 (Mars)"));
    const nlohmann::json suggestion = nlohmann::json::parse(output.out)["crs_suggestion"];
    EXPECT_EQ(suggestion["is_certain"], true);
    EXPECT_EQ(suggestion["choices"][0], (nlohmann::json{{"body", "Earth"}, {"crs", "EPSG:4326"}}));
    for (const nlohmann::json& choice : suggestion["choices"]) {
        const nlohmann::json info = cliInfo(path, {"--crs", choice["crs"].get<std::string>()});
        EXPECT_EQ(info["body"], choice["body"]);
        EXPECT_TRUE(info["crs_suggestion"].is_null());
        EXPECT_EQ(info["wraps_around"], true);
        EXPECT_TRUE(info["notices"].empty()) << info["notices"];
    }
    const ProgramOutput refused = runCli({"info", path, "--crs", "EPSG:32611"});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_THAT(refused.err, HasSubstr("CRS: \"WGS 84 / UTM zone 11N\" (unit metre) cannot place "
                                       "a grid in degrees"));
}

TEST(CrsNotice, FindsTheBodyOfRealGridsWithoutCrs)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const char* file :
         {"etopo/etopo5.cdf", "etopo/etopo60.cdf", "derived/W100N40_etopo5.DEM"}) {
        const nlohmann::json suggestion = cliInfo((sharedData() / file).string())["crs_suggestion"];
        ASSERT_FALSE(suggestion.is_null()) << file;
        ASSERT_EQ(suggestion["choices"].size(), 1U) << file;
        EXPECT_EQ(suggestion["choices"][0]["crs"], "EPSG:4326") << file;
    }
    EXPECT_TRUE(
        cliInfo((sharedData() / "usgs_asc/hugo_site.asc").string())["crs_suggestion"].is_null());
}

} // namespace marsview::test
