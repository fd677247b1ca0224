#include "core/view/frame_governor.h"
#include "tests/cli/run_cli.h"
#include "tests/support/make_raster.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace marsview::test {
namespace {

nlohmann::json measured(const std::vector<std::string>& options)
{
    std::vector<std::string> arguments{"bench",    "view", "--json",  "--size", "320x200",
                                       "--frames", "8",    "--poses", "2"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(output.err, "");
    return nlohmann::json::parse(output.out);
}

} // namespace

TEST(BenchViewCommand, MeasuresEveryFlightOverTheBundledMap)
{
    const nlohmann::json bench = measured({});
    EXPECT_EQ(bench["width_px"], 320);
    EXPECT_EQ(bench["height_px"], 200);
    EXPECT_EQ(bench["target_ms"], 33.0);
    EXPECT_NE(bench["graphics_driver"], "");
    EXPECT_NE(bench["processor"], "");
    EXPECT_GE(bench["core_count"], 1);
    ASSERT_EQ(bench["maps"].size(), 1U);
    const nlohmann::json& map = bench["maps"][0];
    EXPECT_EQ(map["columns"], 1440);
    EXPECT_EQ(map["rows"], 720);
    EXPECT_EQ(map["triangle_count"], 2 * 1439 * 719);
    EXPECT_EQ(map["frame_median_against_first_map"], 1.0);
    EXPECT_LE(map["first_picture_ms"], map["sharp_picture_ms"]);
    EXPECT_GT(map["peak_memory_loaded_mb"], 1.0);
    EXPECT_GE(map["peak_memory_flown_mb"], map["peak_memory_loaded_mb"]);
    std::vector<std::string> names;
    for (const nlohmann::json& flight : map["flights"]) {
        names.push_back(flight["name"]);
        EXPECT_LE(flight["frame_median_ms"], flight["frame_p95_ms"]);
        EXPECT_LE(flight["frame_p95_ms"], flight["frame_max_ms"]);
        EXPECT_GE(flight["sharp_after_ms"], 120.0) << "the wait for stillness is part of it";
        EXPECT_LE(flight["sharp_after_ms"], flight["smooth_after_ms"]);
        ASSERT_EQ(flight["frames"].size(), 8U);
        for (const nlohmann::json& frame : flight["frames"]) {
            EXPECT_GT(frame["frame_ms"], 0.0);
            EXPECT_GT(frame["triangle_count"], 0);
            EXPECT_GE(frame["error_threshold_px"], 1.0);
            EXPECT_LE(frame["error_threshold_px"], kErrorPxMax); // a busy machine reaches it
            EXPECT_GE(frame["scale"], 0.5);
            EXPECT_LE(frame["scale"], 1.0);
        }
    }
    EXPECT_THAT(names, testing::ElementsAre("orbit", "dive", "sweep"));
}

TEST(BenchViewCommand, PicturesAtRestAreWithinAPixel)
{
    for (const nlohmann::json& flight : measured({bundledMars()})["maps"][0]["flights"]) {
        ASSERT_EQ(flight["resting_poses"].size(), 2U);
        for (const nlohmann::json& pose : flight["resting_poses"]) {
            EXPECT_GT(pose["pixel_count"], 320 * 200 / 10);
            EXPECT_GE(pose["share_within_threshold"], 0.99);
            EXPECT_LE(pose["error_bound_px"], 1.0);
            EXPECT_LE(pose["error_mean_px"], pose["error_p99_px"]);
            EXPECT_LE(pose["error_p99_px"], pose["error_max_px"]);
            const nlohmann::json& every = pose["against_every_sample"];
            EXPECT_GT(every["full_triangle_count"], pose["triangle_count"]);
            EXPECT_LE(every["mean_color_difference_levels"], 4.0);
        }
    }
}

TEST(BenchViewCommand, MeasuresTheErrorOfACoarsePicture)
{
    const nlohmann::json fine = measured({bundledMars(), "--color-exaggerations", "1"});
    const nlohmann::json coarse =
        measured({bundledMars(), "--color-exaggerations", "1", "--error-px", "16"});
    const auto low_over_the_map = [](const nlohmann::json& bench) {
        return bench["maps"][0]["flights"][2]["resting_poses"][1];
    };
    const nlohmann::json fine_pose = low_over_the_map(fine);
    const nlohmann::json coarse_pose = low_over_the_map(coarse);
    EXPECT_LT(coarse_pose["triangle_count"], fine_pose["triangle_count"]);
    EXPECT_GT(coarse_pose["error_bound_px"], 1.0);
    EXPECT_GT(coarse_pose["error_mean_px"].get<double>(),
              1.5 * fine_pose["error_mean_px"].get<double>());
}

TEST(BenchViewCommand, FliesTheSamePathsEveryTime)
{
    const nlohmann::json once = measured({bundledMars(), "--color-exaggerations", "1"});
    const nlohmann::json again =
        measured({bundledMars(), "--color-exaggerations", "1", "--target-ms", "5"});
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t pose = 0; pose < 2; ++pose) {
            const auto camera = [&](const nlohmann::json& bench) {
                return bench["maps"][0]["flights"][i]["resting_poses"][pose]["camera"];
            };
            EXPECT_EQ(camera(once), camera(again));
        }
    }
}

TEST(BenchViewCommand, ComparesSeveralMapsInATableForPeople)
{
    const std::string helens = (bundledSamples() / "mount_st_helens_30m.tif").string();
    const ProgramOutput output = runCli({"bench", "view", bundledMars(), helens, "--size",
                                         "160x100", "--frames", "3", "--poses", "0"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    for (const char* word : {"orbit", "dive", "sweep", "median", "p95", "growth"}) {
        EXPECT_NE(output.out.find(word), std::string::npos) << word;
    }
    EXPECT_NE(output.out.find(helens), std::string::npos);
}

TEST(BenchViewCommand, FliesOverAMapOnItsBody)
{
    const nlohmann::json bench = measured({bundledMars(), "--scene", "body"});
    EXPECT_EQ(bench["scene"], "body");
    const nlohmann::json& map = bench["maps"][0];
    EXPECT_TRUE(map["colors_at_rest"].is_null());
    EXPECT_EQ(map["triangle_count"], 2 * 1439 * 719);
    EXPECT_LE(map["first_picture_ms"], map["sharp_picture_ms"]);
    ASSERT_EQ(map["flights"].size(), 3U);
    for (const nlohmann::json& flight : map["flights"]) {
        SCOPED_TRACE(flight["name"]);
        EXPECT_LE(flight["sharp_after_ms"], flight["smooth_after_ms"]);
        EXPECT_GT(flight["sharp_triangle_count"], 0);
        ASSERT_EQ(flight["frames"].size(), 8U);
        for (const nlohmann::json& frame : flight["frames"]) {
            EXPECT_GT(frame["triangle_count"], 0);
        }
        ASSERT_EQ(flight["resting_poses"].size(), 2U);
        for (const nlohmann::json& pose : flight["resting_poses"]) {
            EXPECT_TRUE(pose["error_mean_px"].is_null());
            EXPECT_TRUE(pose["share_within_threshold"].is_null());
            EXPECT_LE(pose["error_bound_px"], 1.0);
            const nlohmann::json& every = pose["against_every_sample"];
            EXPECT_GE(every["full_triangle_count"], pose["triangle_count"]);
            EXPECT_LE(every["mean_color_difference_levels"], 4.0);
            // Mars has a radius of 3376 to 3396 km, and terrain from -8.2 to 21.3 km; the map is
            // exaggerated.
            const nlohmann::json& target = pose["camera"]["target_m"];
            const double exaggeration = map["exaggeration"];
            EXPECT_NEAR(std::hypot(target[0].get<double>(), target[1].get<double>(),
                                   target[2].get<double>()),
                        3.39e6, 1.5e4 + 2.2e4 * exaggeration);
        }
    }
    const auto distance = [&](std::size_t flight, std::size_t pose) {
        return map["flights"][flight]["resting_poses"][pose]["camera"]["distance_m"].get<double>();
    };
    EXPECT_EQ(distance(0, 0), distance(0, 1));
    EXPECT_GT(distance(0, 0), 3.39e6) << "the whole body is in the picture";
    EXPECT_LT(distance(1, 1), 0.3 * distance(0, 0));
    EXPECT_LT(distance(2, 0), 0.3 * distance(0, 0));
}

TEST(BenchViewCommand, SaysWhatAFlightOverTheBodyLeavesOut)
{
    const ProgramOutput output = runCli({"bench", "view", bundledMars(), "--scene", "body",
                                         "--size", "160x100", "--frames", "3", "--poses", "1"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_THAT(output.out, testing::HasSubstr("3 frames/flight, on the body\n"));
    EXPECT_THAT(output.out, testing::ContainsRegex("dive +[0-9]+ +- +- +- +- +[0-9.]+  mean"));
    EXPECT_THAT(output.out, testing::HasSubstr("full resolution: -\n"));
}

TEST(BenchViewCommand, TheFlatSceneIsTheDefault)
{
    const nlohmann::json named =
        measured({bundledMars(), "--color-exaggerations", "1", "--scene", "flat"});
    const nlohmann::json usual = measured({bundledMars(), "--color-exaggerations", "1"});
    EXPECT_EQ(usual["scene"], "flat");
    EXPECT_EQ(named["maps"][0]["colors_at_rest"], usual["maps"][0]["colors_at_rest"]);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(named["maps"][0]["flights"][i]["resting_poses"],
                  usual["maps"][0]["flights"][i]["resting_poses"]);
    }
}

TEST(BenchViewCommand, RefusesWhatCannotLieOnABody)
{
    const TempFolder folder;
    const std::string local =
        writeRaster(folder, "local.tif", "GTiff", recipeFor(8, std::vector<float>(64, 5.0F)));
    const std::string mesh = folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const auto& [file, said] : {std::pair<std::string, std::string>{local, "state the CRS"},
                                     {mesh, "convert it to GeoTIFF"}}) {
        SCOPED_TRACE(file);
        const ProgramOutput output = runCli({"bench", "view", file, "--scene", "body"});
        EXPECT_EQ(output.exit_status, 1);
        EXPECT_EQ(output.out, "");
        EXPECT_THAT(output.err, testing::HasSubstr(said));
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
    }
}

TEST(BenchViewCommand, RefusesInvalidInput)
{
    for (const std::vector<std::string>& options : {std::vector<std::string>{"--frames", "0"},
                                                    {"--frames", "many"},
                                                    {"--target-ms", "-1"},
                                                    {"--error-px", "0"},
                                                    {"--exaggeration", "0"},
                                                    {"--poses", "-1"},
                                                    {"--size", "0x5"},
                                                    {"--size", "wide"},
                                                    {"--scene", "globe"},
                                                    {"--scene", ""},
                                                    {"--colour"}}) {
        std::vector<std::string> arguments{"bench", "view", bundledMars()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(runCli(arguments).exit_status, 2) << options.front();
    }
    EXPECT_EQ(runCli({"bench"}).exit_status, 2);
    EXPECT_EQ(runCli({"bench", "smell"}).exit_status, 2);
    const TempFolder folder;
    const ProgramOutput output = runCli({"bench", "view", folder.file("nowhere.tif")});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_EQ(output.out, "");
    EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
    EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
}

} // namespace marsview::test
