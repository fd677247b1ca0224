#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
            EXPECT_LE(frame["error_threshold_px"], 8.0);
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
    const nlohmann::json fine = measured({bundledMars()});
    const nlohmann::json coarse = measured({bundledMars(), "--error-px", "16"});
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
    const nlohmann::json once = measured({bundledMars()});
    const nlohmann::json again = measured({bundledMars(), "--target-ms", "5"});
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
