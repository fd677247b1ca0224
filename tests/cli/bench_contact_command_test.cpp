#include "tests/cli/run_cli.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace marsview::test {
namespace {

constexpr const char* kWalks = "proxy-graph,surface-walk,continuous-walk";

nlohmann::json measured(const std::vector<std::string>& options)
{
    std::vector<std::string> arguments{"bench", "contact", "--json", "--repeat", "1"};
    const auto add = [&](const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    add(options);
    const auto add_default = [&](const std::string& name, const std::string& value) {
        if (std::find(options.begin(), options.end(), name) == options.end()) {
            add({name, value});
        }
    };
    add_default("--updates", "120");
    add_default("--scales", "1");
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(output.err, "");
    return nlohmann::json::parse(output.out);
}

nlohmann::json onSmallFractal(const std::vector<std::string>& options)
{
    std::vector<std::string> all{"--size", "256", "--models", kWalks, "--speeds", "0.1,10"};
    all.insert(all.end(), options.begin(), options.end());
    return measured(all);
}

// The rows of a model for goals below the surface.
std::vector<nlohmann::json> rowsOf(const nlohmann::json& bench, const std::string& model)
{
    std::vector<nlohmann::json> rows;
    for (const nlohmann::json& row : bench["rows"]) {
        if (row["model"] == model && row["goals"] == "below") {
            rows.push_back(row);
        }
    }
    return rows;
}

} // namespace

TEST(BenchContactCommand, MeasuresEveryModelAndSpeedOnAFractal)
{
    const nlohmann::json bench = onSmallFractal({});
    EXPECT_NE(bench["processor"], "");
    EXPECT_GE(bench["core_count"], 1);
    EXPECT_GT(bench["clock_ns"], 0.0);
    EXPECT_EQ(bench["reference_unfinished"], 0);
    EXPECT_EQ(bench["reference_piece_cells"], 1.0 / 128.0);
    EXPECT_EQ(bench["terrain"]["columns"], 256);
    EXPECT_EQ(bench["terrain"]["rows"], 256);
    EXPECT_EQ(bench["terrain"]["triangle_count"], 2 * 255 * 255);
    EXPECT_EQ(bench["terrain"]["sample_type"], "Float32");
    EXPECT_EQ(bench["terrain"]["cell_m"], 1.0);
    EXPECT_NEAR(bench["terrain"]["sample_bytes_per_triangle"].get<double>(), 2.0, 0.03);
    EXPECT_LE(bench["terrain"]["hierarchy_bytes_per_triangle"], 0.02);
    EXPECT_EQ(bench["rows"].size(), 3U * 2U * 2U);
    for (const nlohmann::json& row : bench["rows"]) {
        EXPECT_EQ(row["updates"], 120);
        EXPECT_EQ(row["height_scale"], 1.0);
        EXPECT_GT(row["ns_mean"], 0.0);
        EXPECT_GT(row["ns_p50"], 0.0);
        EXPECT_LE(row["ns_p50"], row["ns_p99"]);
        EXPECT_LE(row["ns_p99"], row["ns_p999"]);
        EXPECT_LE(row["ns_p999"], row["ns_max"]);
        EXPECT_EQ(row["cut_short"], 0.0);
        if (row["goals"] == "above") {
            EXPECT_TRUE(row["errors"].is_null());
            EXPECT_EQ(row["contact_updates"], 0.0);
            EXPECT_NEAR(row["casts"].get<double>(), 1.0, 0.02);
            continue;
        }
        EXPECT_EQ(row["contact_updates"], 1.0);
        const nlohmann::json& errors = row["errors"];
        EXPECT_LE(errors["within_1e5_cell"], errors["within_half_cell"]);
        EXPECT_LE(errors["position_p99_cells"], errors["position_max_cells"]);
        EXPECT_LE(errors["position_mean_cells"], errors["position_max_cells"]);
        EXPECT_LE(errors["force_mean_deg"], 90.0);
        EXPECT_EQ(errors["at_minimum"], 1.0);
        EXPECT_LE(errors["lag_cells"], 1e-9);
        EXPECT_GE(errors["distance_mean_cells"], 0.0);
    }
}

TEST(BenchContactCommand, DistinguishesExactFromInexactModels)
{
    // The ideal shares no code with the models. At a tenth of a cell per update all models follow
    // it; at ten cells only the one that follows the motion does.
    const nlohmann::json bench =
        onSmallFractal({"--updates", "600", "--goals", "below", "--scales", "3"});
    const auto mean_error = [&](const char* model, std::size_t speed) {
        return rowsOf(bench, model).at(speed)["errors"]["position_mean_cells"].get<double>();
    };
    EXPECT_LE(mean_error("continuous-walk", 0), 1e-9);
    EXPECT_LE(mean_error("continuous-walk", 1), 1e-2);
    EXPECT_GE(mean_error("proxy-graph", 1), 1e-3);
    EXPECT_GE(mean_error("proxy-graph", 1), mean_error("continuous-walk", 1));
    for (const char* model : {"proxy-graph", "surface-walk", "continuous-walk"}) {
        EXPECT_GE(rowsOf(bench, model).at(0)["errors"]["within_half_cell"], 0.85) << model;
    }
}

TEST(BenchContactCommand, MeasuresTheSameErrorsEveryTime)
{
    const auto errors = [] {
        std::vector<nlohmann::json> found;
        const nlohmann::json bench = onSmallFractal({"--sample-type", "int16"});
        for (const nlohmann::json& row : bench["rows"]) {
            found.push_back(row["errors"]);
            found.push_back(row["vertices"]);
            found.push_back(row["cells"]);
        }
        return found;
    };
    EXPECT_EQ(errors(), errors());
}

TEST(BenchContactCommand, MeasuresOnRealMaps)
{
    const std::string helens = (bundledSamples() / "mount_st_helens_30m.tif").string();
    const nlohmann::json bench =
        measured({helens, "--models", kWalks, "--speeds", "1", "--goals", "below"});
    EXPECT_EQ(bench["terrain"]["name"], helens);
    EXPECT_EQ(bench["terrain"]["columns"], 327);
    EXPECT_EQ(bench["terrain"]["sample_type"], "Int16");
    EXPECT_EQ(bench["terrain"]["cell_m"], 30.0);
    EXPECT_EQ(bench["rows"].size(), 3U);
    const std::string mars = (bundledSamples() / "mars_mola_4ppd.tif").string();
    EXPECT_EQ(rowsOf(measured({mars, "--models", kWalks, "--speeds", "1"}), "surface-walk").size(),
              1U);
}

TEST(BenchContactCommand, KeepsToItsTimeLimit)
{
    const nlohmann::json bench =
        measured({"--size", "256", "--models", "surface-walk", "--speeds", "50", "--goals", "below",
                  "--updates", "1000000", "--seconds", "0.5"});
    const auto updates = bench["rows"][0]["updates"].get<int>();
    EXPECT_GT(updates, 0); // how many depends on the machine
    EXPECT_LT(updates, 1000000);
}

TEST(BenchContactCommand, PrintsATableForPeopleAndDrawsAPlot)
{
    const TempFolder folder;
    const std::string svg = folder.file("plot.svg");
    const ProgramOutput output =
        runCli({"bench", "contact", "--size", "256", "--models", kWalks, "--speeds", "1,10",
                "--scales", "0.1,1", "--updates", "100", "--repeat", "1", "--plot", svg});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    for (const char* word :
         {"proxy-graph", "surface-walk", "continuous-walk", "p99.9", "vertices", "casts",
          "far edge", "loops", "< 0.5", "< 1e-5", "force", "distance", "lag", "minimum",
          "heights × 0.1", "heights × 1", "bytes of samples"}) {
        EXPECT_THAT(output.out, testing::HasSubstr(word));
    }
    const std::string plot = readFile(svg);
    EXPECT_TRUE(plot.starts_with("<svg "));
    EXPECT_TRUE(plot.ends_with("</svg>\n"));
    for (const char* word : {"proxy-graph", "surface-walk", "continuous-walk", "heights × 0.1",
                             "heights × 1", "µs", "cells", "prefers-color-scheme: dark"}) {
        EXPECT_THAT(plot, testing::HasSubstr(word));
    }
    EXPECT_THAT(plot, testing::Not(testing::HasSubstr("nan")));
    EXPECT_THAT(plot, testing::Not(testing::HasSubstr("inf")));
    // One line per model in each panel.
    std::size_t lines = 0;
    for (std::size_t at = plot.find("<polyline"); at != std::string::npos;
         at = plot.find("<polyline", at + 1)) {
        ++lines;
    }
    EXPECT_EQ(lines, 6U);
}

TEST(BenchContactCommand, RefusesInvalidInput)
{
    for (const std::vector<std::string>& options : {std::vector<std::string>{"--models", "magic"},
                                                    {"--speeds", "0"},
                                                    {"--speeds", "fast"},
                                                    {"--scales", "-1"},
                                                    {"--updates", "1"},
                                                    {"--repeat", "0"},
                                                    {"--stroke", "0"},
                                                    {"--size", "3"},
                                                    {"--sample-type", "complex"},
                                                    {"--goals", "beside"},
                                                    {"--seconds", "nan"},
                                                    {"--colour"}}) {
        std::vector<std::string> arguments{"bench", "contact"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(runCli(arguments).exit_status, 2) << options.front();
    }
    EXPECT_EQ(runCli({"bench", "contact", "--help"}).exit_status, 0);
    const TempFolder folder;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{folder.file("nowhere.tif")},
          {"--size", "64", "--models", "surface-walk", "--speeds", "1", "--scales", "1",
           "--updates", "50", "--plot", folder.file("no/such/folder.svg")}}) {
        std::vector<std::string> arguments{"bench", "contact"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 1) << words.back();
        EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
    }
}

// The ideal is another model over small pieces of the motion; its cells are 15 km and 30 m.
TEST(BenchContactCommand, MeasuresTheContinuousWalkOnTheBody)
{
    for (const std::string& map : {bundledMars(), bundledMountain()}) {
        const nlohmann::json bench = measured(
            {map, "--scene", "body", "--models", kWalks, "--speeds", "1,10", "--updates", "1000"});
        EXPECT_EQ(bench["scene"], "body");
        EXPECT_EQ(bench["reference_unfinished"], 0);
        const std::vector<nlohmann::json> rows = rowsOf(bench, "continuous-walk");
        ASSERT_EQ(rows.size(), 2U);
        for (const nlohmann::json& row : rows) {
            EXPECT_GE(row["errors"]["within_1e5_cell"], 0.99) << map << row;
            EXPECT_GT(row["ns_mean"], 0.0);
            EXPECT_EQ(row["errors"]["at_minimum"], 1.0) << map << row;
        }
    }
}

TEST(BenchContactCommand, SaysWhyATerrainDoesNotLieOnABody)
{
    const ProgramOutput fractal = runCli({"bench", "contact", "--scene", "body"});
    EXPECT_EQ(fractal.exit_status, 1);
    EXPECT_EQ(fractal.err, "marsview-cli: --scene: the fractal has no body; name a map\n");
    EXPECT_EQ(runCli({"bench", "contact", "--scene", "globe"}).exit_status, 2);
}

} // namespace marsview::test
