#include "core/contact/contact_model.h"
#include "tests/cli/level_maps.h"
#include "tests/cli/run_cli.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace marsview::test {
namespace {

constexpr const char* kHeader =
    "x,y,z,contact,feature,vertices,faces,casts,cells,far_edges,far_loops";

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> wordsOf(const std::string& line)
{
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');) {
        words.push_back(word);
    }
    return words;
}

struct Row {
    double x;
    double y;
    double z;
    bool is_in_contact;
    std::string feature;
    std::vector<std::string> words;
};

std::vector<Row> rowsOf(const std::string& csv)
{
    std::vector<std::string> lines = linesOf(csv);
    lines.erase(lines.begin());
    std::vector<Row> rows;
    for (const std::string& line : lines) {
        const std::vector<std::string> words = wordsOf(line);
        rows.push_back({std::stod(words.at(0)), std::stod(words.at(1)), std::stod(words.at(2)),
                        words.at(3) == "1", words.at(4), words});
    }
    return rows;
}

// The trace of the given goals text, which includes the header.
std::vector<Row> traced(const std::string& dem,
                        const std::string& goals,
                        const std::vector<std::string>& options = {})
{
    const TempFolder folder;
    std::vector<std::string> arguments{"trace", dem, "--goals", folder.write("goals.csv", goals)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramOutput output = runCli(arguments);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(linesOf(output.out).at(0), kHeader);
    return rowsOf(output.out);
}

std::vector<double> heightsAt(const std::string& dem, const std::vector<Row>& rows)
{
    std::string lines;
    for (const Row& row : rows) {
        lines += fmt::format("{} {}\n", row.x, row.y);
    }
    return numbersIn(runCli({"sample", dem, "--map", "--stdin"}, lines).out);
}

// A map of hills, with a hole if `has_void`.
std::string hills(const TempFolder& folder,
                  const std::string& srs,
                  const std::array<double, 6>& transform,
                  double height,
                  bool has_void = false)
{
    std::vector<float> samples;
    for (int row = 0; row < 40; ++row) {
        for (int column = 0; column < 60; ++column) {
            const bool is_void = has_void && std::hypot(column - 30, row - 20) < 6.0;
            samples.push_back(static_cast<float>(
                is_void ? -9999.0
                        : height * (std::sin(column * 0.4) * std::cos(row * 0.3) + 0.02 * column)));
        }
    }
    RasterRecipe recipe = recipeFor(60, samples);
    recipe.srs = srs;
    recipe.transform = transform;
    recipe.band_xml = has_void ? "<NoDataValue>-9999</NoDataValue>" : "";
    return writeRaster(folder, "hills.tif", "GTiff", recipe);
}

struct Hills {
    const char* name;
    const char* srs;
    std::array<double, 6> transform;
    double height;
};

// Cells with about one unit of height in each.
const std::vector<Hills>& hillsEverywhere()
{
    static const std::vector<Hills> kHills{
        {"no CRS", "", {1000.0, 1.0, 0.0, 2000.0, 0.0, -1.0}, 2.0},
        {"UTM", "EPSG:32633", {500000.0, 30.0, 0.0, 5200000.0, 0.0, -30.0}, 60.0},
        {"feet", "EPSG:2227", {6000000.0, 100.0, 0.0, 2100000.0, 0.0, -100.0}, 60.0},
        {"degrees on the Earth", "EPSG:4326", {10.0, 0.01, 0.0, 50.0, 0.0, -0.01}, 1500.0},
        {"degrees on the Moon", "IAU_2015:30100", {-5.0, 0.1, 0.0, 70.0, 0.0, -0.1}, 4000.0},
        {"rotated", "EPSG:32633", {500000.0, 20.0, 15.0, 5200000.0, 14.0, -21.0}, 50.0},
        {"south up", "EPSG:32633", {500000.0, 30.0, 0.0, 5200000.0, 0.0, 30.0}, 60.0},
    };
    return kHills;
}

struct Goals {
    std::string csv = "x,y,z\n";
    std::vector<std::array<double, 3>> points;
};

// Goals on a random walk, mostly below the surface; some above it.
Goals goalsOver(const Hills& hills, int count)
{
    Random random;
    Goals goals;
    double column = 30.0;
    double row = 20.0;
    const auto& t = hills.transform;
    for (int i = 0; i < count; ++i) {
        column = std::clamp(column + random.uniform(-2.0, 2.0), 1.0, 58.0);
        row = std::clamp(row + random.uniform(-2.0, 2.0), 1.0, 38.0);
        const double x = t[0] + (column + 0.5) * t[1] + (row + 0.5) * t[2];
        const double y = t[3] + (column + 0.5) * t[4] + (row + 0.5) * t[5];
        const double z = hills.height * random.uniform(-3.0, 2.5);
        goals.points.push_back({x, y, z});
        goals.csv += fmt::format("{},{},{}\n", x, y, z);
    }
    return goals;
}

} // namespace

TEST(TraceCommand, KeepsProxiesOnTheSurfaceThatSamplePrints)
{
    for (const Hills& hill : hillsEverywhere()) {
        for (const bool has_void : {false, true}) {
            SCOPED_TRACE(fmt::format("{}{}", hill.name, has_void ? ", voids" : ""));
            const TempFolder folder;
            const std::string dem = hills(folder, hill.srs, hill.transform, hill.height, has_void);
            const Goals goals = goalsOver(hill, 300);
            for (const char* exaggeration : {"1", "3.5"}) {
                const std::vector<Row> rows =
                    traced(dem, goals.csv, {"--exaggeration", exaggeration});
                ASSERT_EQ(rows.size(), goals.points.size());
                const std::vector<double> heights = heightsAt(dem, rows);
                int contacts = 0;
                int voids = 0;
                for (std::size_t i = 0; i < rows.size(); ++i) {
                    const Row& row = rows[i];
                    if (row.is_in_contact) {
                        ++contacts;
                        EXPECT_NE(row.feature, "free");
                        if (std::isnan(heights[i])) {
                            ++voids; // filled for touch only
                        } else {
                            EXPECT_NEAR(row.z, heights[i], 1e-8 * hill.height) << "line " << i + 2;
                        }
                    } else {
                        EXPECT_EQ(row.feature, "free");
                        // Exactly the goal, to the last digit.
                        EXPECT_EQ((std::array{row.x, row.y, row.z}), goals.points[i]);
                        EXPECT_FALSE(row.z < heights[i]);
                    }
                }
                EXPECT_GT(contacts, 100);
                EXPECT_LT(contacts, 290);
                EXPECT_EQ(voids > 0, has_void);
            }
        }
    }
}

TEST(TraceCommand, RestsAtTheClosestPointOfAPlaneInSceneMeters)
{
    // 30 m cells; z rises 0.4 m per meter eastwards, 0.8 with the exaggeration.
    std::vector<float> samples;
    for (int i = 0; i < 50 * 50; ++i) {
        samples.push_back(static_cast<float>(12.0 * (i % 50)));
    }
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(50, samples);
    recipe.srs = "EPSG:32633";
    recipe.transform = {600000.0, 30.0, 0.0, 5300000.0, 0.0, -30.0};
    const std::string dem = writeRaster(folder, "plane.tif", "GTiff", recipe);
    const double x0 = 600015.0; // of the first sample, where z = 0
    const double goal_x = 600700.0;
    const double goal_y = 5299500.0;
    const double depth = 40.0;
    const double goal_z = 0.4 * (goal_x - x0) - depth;
    const std::vector<Row> rows = traced(
        dem, fmt::format("x,y,z\n{},{},{}\n", goal_x, goal_y, goal_z), {"--exaggeration", "2"});
    // The foot of the goal: (depth × 2) below along z, so it moves west by slope / (1 + slope²).
    const double x = goal_x - 2.0 * depth * 0.8 / (1.0 + 0.64);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_TRUE(rows[0].is_in_contact);
    EXPECT_NEAR(rows[0].x, x, 1e-6);
    EXPECT_NEAR(rows[0].y, goal_y, 1e-6);
    EXPECT_NEAR(rows[0].z, 0.4 * (x - x0), 1e-6);
}

TEST(TraceCommand, ScalesDegreesAtTheLatitudeOfTheCenter)
{
    // A plane on a sphere that rises eastwards, around 60° north: a degree of longitude is half as
    // long as a degree of latitude.
    std::vector<float> samples;
    for (int i = 0; i < 41 * 41; ++i) {
        samples.push_back(static_cast<float>(300.0 * (i % 41)));
    }
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(41, samples);
    recipe.srs = "+proj=longlat +R=1737400 +no_defs";
    recipe.transform = {20.0 - 0.025, 0.05, 0.0, 61.0 + 0.025, 0.0, -0.05};
    const std::string dem = writeRaster(folder, "plane.tif", "GTiff", recipe);
    constexpr double kDegree = 1737400.0 * 3.14159265358979323846 / 180.0;
    const double slope = 300.0 / (0.05 * kDegree * 0.5);
    const double depth = 5000.0;
    const double goal_z = 300.0 / 0.05 * (21.2 - 20.0) - depth;
    const std::vector<Row> rows = traced(dem, fmt::format("x,y,z\n21.2,60.3,{}\n", goal_z));
    const double x = 21.2 - depth * slope / (1.0 + slope * slope) / (kDegree * 0.5);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_NEAR(rows[0].x, x, 1e-9);
    EXPECT_NEAR(rows[0].y, 60.3, 1e-9);
    EXPECT_NEAR(rows[0].z, 300.0 / 0.05 * (x - 20.0), 1e-5);
}

TEST(TraceCommand, PlacesTheProxyWithTheFirstLine)
{
    const std::vector<Row> rows = traced(bundledMountain(), "x,y,z\n560000,5116000,4000\n");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].words[4], "free");
    EXPECT_FALSE(rows[0].is_in_contact);
    EXPECT_EQ(rows[0].z, 4000.0);
}

TEST(TraceCommand, ClampsGoalsOutsideTheMapAndRefusesInvalidOnes)
{
    const Hills& hill = hillsEverywhere()[1];
    const TempFolder folder;
    const std::string dem = hills(folder, hill.srs, hill.transform, hill.height);
    const std::string summary = folder.file("summary.json");
    const std::vector<Row> rows = traced(dem,
                                         "x,y,z\n"
                                         "500600,5199400,-500\n"
                                         "nan,5199400,-500\n"
                                         "500600,inf,-500\n"
                                         "500600,5199400,-inf\n"
                                         "500600,5199400,1.1e12\n"
                                         "1e13,-1e17,-500\n"
                                         "499000,5199400,9000\n"
                                         "599000,5300000,-500\n",
                                         {"--summary", summary});
    ASSERT_EQ(rows.size(), 8U);
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_EQ(rows[i].x, rows[0].x);
        EXPECT_EQ(rows[i].y, rows[0].y);
        EXPECT_EQ(rows[i].z, rows[0].z);
    }
    EXPECT_TRUE(rows[5].is_in_contact);
    EXPECT_EQ(rows[6].feature, "free");
    EXPECT_NEAR(rows[6].x, 500015.0, 1e-6); // the first column
    EXPECT_EQ(rows[6].z, 9000.0);
    EXPECT_TRUE(rows[7].is_in_contact);
    EXPECT_LE(rows[7].x, 500000.0 + 30.0 * 59.5 + 1e-6);
    EXPECT_LE(rows[7].y, 5200000.0 - 15.0 + 1e-6);
    const nlohmann::json json = nlohmann::json::parse(readFile(summary));
    EXPECT_EQ(json["refused_updates"], 4);
    EXPECT_EQ(json["updates"], 8);
    EXPECT_EQ(json["contact_updates"], 7);
    const ProgramOutput output =
        runCli({"trace", dem, "--goals", "-"}, "x,y,z\n500600,5199400,-500\nnan,5199400,-500\n");
    EXPECT_THAT(output.err, testing::StartsWith("marsview-cli: --goals: has 1 of 2 goals that are "
                                                "not numbers or too far away"));
}

TEST(TraceCommand, ReadsGoalsWrittenByEditorsAndSpreadsheets)
{
    const std::vector<Row> plain =
        traced(bundledMountain(), "x,y,z\n560000,5116000,1000\n560100,5116050,900\n");
    for (const char* text : {"x,y,z\r\n560000,5116000,1000\r\n560100,5116050,900\r\n",
                             "\xef\xbb\xbfx,y,z\n560000,5116000,1000\n560100,5116050,900",
                             "x, y, z\n 560000 ,\t5116000, 1e3\n\n+560100,5116050.0,900\n\n",
                             "x y z\n560000  5116000\t1000\n560100 5116050 900 \r\n",
                             "x,y,z\n560000 5116000 1000\n560100,5116050,900,\n",
                             "x,y,z,\n560000,5116000,1000,\n560100,5116050,900,\n"}) {
        const std::vector<Row> rows = traced(bundledMountain(), text);
        ASSERT_EQ(rows.size(), plain.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].words, plain[i].words);
        }
    }
    const ProgramOutput piped =
        runCli({"trace", bundledMountain(), "--goals", "-"}, "x,y,z\n560000,5116000,1000\n");
    EXPECT_EQ(rowsOf(piped.out).at(0).words, plain[0].words);
}

TEST(TraceCommand, NamesTheLineThatItCannotRead)
{
    const TempFolder folder;
    struct Case {
        const char* text;
        const char* line;
        const char* found;
    };
    for (const Case& bad :
         {Case{"x,y,z\n1,2,3\n4,5\n", "line 3", "4,5"},
          Case{"x,y,z\n1,2,3,4\n", "line 2", "1,2,3,4"},
          Case{"x,y,z\n\n1,two,3\n", "line 3", "1,two,3"},
          Case{"x,y,z\n1,2,3 4\n", "line 2", "1,2,3 4"}, Case{"1,2,3\n", "line 1", "x,y,z"},
          Case{"x,y,z\n1,,3\n", "line 2", "1,,3"}, Case{"x,y,z\n1,2,\n", "line 2", "1,2,"},
          Case{"x,y,z\n1,2,3,,\n", "line 2", "1,2,3,,"}, Case{"x,y,z\n1 2\n", "line 2", "1 2"}}) {
        const std::string goals = folder.write("goals.csv", bad.text);
        const ProgramOutput output = runCli({"trace", bundledMountain(), "--goals", goals});
        EXPECT_EQ(output.exit_status, 1);
        EXPECT_EQ(output.out, "");
        EXPECT_TRUE(output.err.starts_with("marsview-cli: " + goals + ": ")) << output.err;
        EXPECT_THAT(output.err, testing::HasSubstr(bad.line));
        EXPECT_THAT(output.err, testing::HasSubstr(bad.found));
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
    }
}

TEST(TraceCommand, WritesFilesWithTimesAndASummary)
{
    const TempFolder folder;
    const std::string goals = folder.write(
        "goals.csv", "x,y,z\n560000,5116000,1000\n560100,5116050,900\n560100,5116050,9000\n");
    const std::string csv = folder.file("trace.csv");
    const std::string summary = folder.file("summary.json");
    const ProgramOutput output =
        runCli({"trace", bundledMountain(), "--goals", goals, "--timing", "-o", csv, "--summary",
                summary, "--model", "surface-walk"});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(output.out, "");
    const std::vector<std::string> lines = linesOf(readFile(csv));
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(lines[0], std::string(kHeader) + ",ns");
    const nlohmann::json json = nlohmann::json::parse(readFile(summary));
    EXPECT_EQ(json["model"], "surface-walk");
    EXPECT_EQ(json["updates"], 3);
    EXPECT_EQ(json["contact_updates"], 2);
    const std::vector<std::string> names = wordsOf(kHeader);
    for (std::size_t column = 5; column < names.size(); ++column) {
        double total = 0.0;
        for (std::size_t line = 1; line < lines.size(); ++line) {
            total += std::stod(wordsOf(lines[line]).at(column));
        }
        EXPECT_EQ(json["totals"][names[column]], total) << names[column];
        EXPECT_DOUBLE_EQ(json["means"][names[column]], total / 3.0) << names[column];
    }
    double sum = 0.0;
    double longest = 0.0;
    for (std::size_t line = 1; line < lines.size(); ++line) {
        const double ns = std::stod(wordsOf(lines[line]).at(11));
        sum += ns;
        longest = std::max(longest, ns);
    }
    EXPECT_NEAR(json["ns"]["mean"].get<double>(), sum / 3.0, 1.0);
    EXPECT_NEAR(json["ns"]["max"].get<double>(), longest, 1.0);
    for (const char* quantile : {"p50", "p99", "p999"}) {
        EXPECT_GT(json["ns"][quantile], 0.0);
        EXPECT_LE(json["ns"][quantile], json["ns"]["max"]);
    }
    const ProgramOutput printed = runCli({"trace", bundledMountain(), "--goals", goals});
    const ProgramOutput asked = runCli({"trace", bundledMountain(), "--goals", goals, "-o", "-"});
    EXPECT_EQ(asked.out, printed.out) << "a minus sign is standard output";
    EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(TraceCommand, RunsEveryModel)
{
    const Hills& hill = hillsEverywhere()[1];
    const TempFolder folder;
    const std::string dem = hills(folder, hill.srs, hill.transform, hill.height);
    const Goals goals = goalsOver(hill, 200);
    for (const ContactModelKind kind : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(kind));
        const std::vector<Row> rows =
            traced(dem, goals.csv, {"--model", std::string(contactModelName(kind))});
        ASSERT_EQ(rows.size(), goals.points.size());
        const std::vector<double> heights = heightsAt(dem, rows);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_GE(rows[i].z, heights[i] - 1e-6) << "line " << i + 2;
            const bool is_on_surface =
                kind != ContactModelKind::GodObject && kind != ContactModelKind::VirtualProxy;
            if (rows[i].is_in_contact && is_on_surface) {
                EXPECT_NEAR(rows[i].z, heights[i], 1e-6) << "line " << i + 2;
            }
            if (!rows[i].is_in_contact) {
                EXPECT_EQ((std::array{rows[i].x, rows[i].y, rows[i].z}), goals.points[i]);
            }
        }
    }
}

TEST(TraceCommand, HoldsASphereItsRadiusAboveTheSurface)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(40, std::vector<float>(1600, 100.0F));
    const std::string dem = writeRaster(folder, "flat.tif", "GTiff", recipe);
    const std::string goals = "x,y,z\n1020,1980,90\n";
    const auto height = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{"--model", "virtual-proxy"};
        all.insert(all.end(), options.begin(), options.end());
        return traced(dem, goals, all).at(0).z;
    };
    EXPECT_NEAR(height({}), 100.5, 1e-6);
    EXPECT_NEAR(height({"--radius", "2"}), 102.0, 1e-6);
    EXPECT_NEAR(height({"--radius", "2", "--exaggeration", "4"}), 100.5, 1e-6);
}

TEST(TraceCommand, KeepsASphereAtRestOnSamples)
{
    // On three spikes; their centroid is not a sample position.
    const TempFolder folder;
    std::vector<float> heights(1600, 0.0F);
    for (const auto& [column, row] : {std::pair{20, 20}, {23, 20}, {21, 23}}) {
        heights[static_cast<std::size_t>(row * 40 + column)] = 10.0F;
    }
    const std::string dem =
        writeRaster(folder, "spikes.tif", "GTiff", recipeFor(40, std::move(heights)));
    const double x = 1021.5 + 0.5;
    const double y = 2000.0 - (20.0 + 7.0 / 6.0) - 0.5;
    const Row row = traced(dem, fmt::format("x,y,z\n{},{},5\n", x + 0.1, y),
                           {"--model", "virtual-proxy", "--radius", "2.2"})
                        .at(0);
    EXPECT_EQ(row.feature, "vertex");
    EXPECT_NEAR(row.x, x, 1e-3);
    EXPECT_NEAR(row.y, y, 1e-3);
    const auto distance = [&](double column, double line) {
        return std::hypot(row.x - (1000.5 + column), row.y - (1999.5 - line), row.z - 10.0);
    };
    EXPECT_NEAR(distance(20, 20), 2.2, 1e-6);
    EXPECT_NEAR(distance(23, 20), 2.2, 1e-6);
    EXPECT_NEAR(distance(21, 23), 2.2, 1e-6);
}

TEST(TraceCommand, RefusesInvalidInput)
{
    const TempFolder folder;
    const std::string goals = folder.write("goals.csv", "x,y,z\n1,2,3\n");
    for (const std::vector<std::string>& options : {std::vector<std::string>{"--model", "magic"},
                                                    {"--radius", "2"},
                                                    {"--model", "surface-walk", "--radius", "2"},
                                                    {"--model", "virtual-proxy", "--radius", "0"},
                                                    {"--exaggeration", "-1"},
                                                    {"--exaggeration", "nan"},
                                                    {"--colour"}}) {
        std::vector<std::string> arguments{"trace", bundledMountain(), "--goals", goals};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(runCli(arguments).exit_status, 2) << options.front() << " " << options.back();
    }
    EXPECT_EQ(runCli({"trace", bundledMountain()}).exit_status, 2);
    EXPECT_EQ(runCli({"trace"}).exit_status, 2);
    EXPECT_EQ(runCli({"trace", "--help"}).exit_status, 0);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{folder.file("nowhere.tif"), "--goals", goals},
          {bundledMountain(), "--goals", folder.file("nowhere.csv")},
          {bundledMountain(), "--goals", folder.path().string()},
          {bundledMountain(), "--goals", folder.write("empty.csv", "")},
          {bundledMountain(), "--goals", goals, "-o", folder.file("no/such/folder.csv")},
          {bundledMountain(), "--goals", goals, "--summary", folder.file("no/such/folder.json")}}) {
        std::vector<std::string> arguments{"trace"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const ProgramOutput output = runCli(arguments);
        EXPECT_EQ(output.exit_status, 1) << words.back();
        EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
        EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
    }
}

TEST(TraceCommand, TouchesTriangleMeshes)
{
    const TempFolder folder;
    std::string cube;
    for (const int x : {-1, 1}) {
        for (const int y : {-1, 1}) {
            for (const int z : {-1, 1}) {
                cube += fmt::format("v {} {} {}\n", x, y, z);
            }
        }
    }
    cube += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
    const std::string mesh = folder.write("cube.obj", cube);
    const std::string goals = folder.write("goals.csv", "x,y,z\n0.5,0.25,3\n0.5,0.25,0\n-2,0,0\n");
    for (const ContactModelKind kind : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(kind));
        const bool is_sphere = kind == ContactModelKind::VirtualProxy;
        const double radius_m = is_sphere ? 0.125 : 0.0;
        std::vector<std::string> arguments{"trace", mesh,      "--goals",
                                           goals,   "--model", std::string(contactModelName(kind))};
        if (is_sphere) {
            arguments.insert(arguments.end(), {"--radius", "0.125"});
        }
        const ProgramOutput result = runCli(arguments);
        ASSERT_EQ(result.exit_status, 0) << result.err;
        const std::vector<Row> rows = rowsOf(result.out);
        ASSERT_EQ(rows.size(), 3U);
        EXPECT_EQ(rows[0].feature, "free");
        EXPECT_EQ(rows[1].feature, "face");
        if (kind == ContactModelKind::ProxyGraph2003) {
            // It begins at a corner of the cube, from which it goes to the nearest side.
            EXPECT_NEAR(rows[1].x, 1.0, 1e-6);
            EXPECT_NEAR(rows[1].y, 0.25, 1e-6);
            EXPECT_NEAR(rows[1].z, 0.0, 1e-9);
            continue;
        }
        EXPECT_NEAR(rows[1].x, 0.5, 1e-6);
        EXPECT_NEAR(rows[1].y, 0.25, 1e-6);
        EXPECT_NEAR(rows[1].z, 1.0 + radius_m, 1e-9);
    }
    const ProgramOutput torn =
        runCli({"trace", folder.write("torn.obj", cube + "f 1 2 4\n"), "--goals", goals});
    EXPECT_EQ(torn.exit_status, 1);
    EXPECT_THAT(torn.err, testing::HasSubstr("duplicated triangle"));
    const ProgramOutput refused = runCli({"trace", mesh, "--goals", goals, "--crs", "EPSG:4326"});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_THAT(refused.err, testing::HasSubstr("a mesh has no CRS"));
}

TEST(TraceCommand, PrintsNoUpdatesWithoutGoals)
{
    const TempFolder folder;
    const std::string summary = folder.file("summary.json");
    EXPECT_TRUE(traced(bundledMountain(), "x,y,z\n", {"--summary", summary}).empty());
    const nlohmann::json json = nlohmann::json::parse(readFile(summary));
    EXPECT_EQ(json["updates"], 0);
    EXPECT_EQ(json["ns"]["mean"], 0.0);
}

// As `loop --record` writes them, without the columns that trace ignores.
TEST(TraceCommand, UsesTheContactSettingsOfARecording)
{
    // Goals that sink into the mountain and slide along inside it.
    const auto goal = [](int i) {
        return fmt::format("{},{},{}", 562000 + 40 * i, 5115000 + 25 * i, 4000 - 150 * i);
    };
    const std::string columns = "x,y,z,time_s,map,part,model,radius_m,exaggeration\n";
    std::string recording = columns;
    std::string all_one = columns;
    std::string plain = "x,y,z\n";
    std::string first = plain;
    std::string second = plain;
    for (int i = 0; i < 60; ++i) {
        // The first model returns at the end and continues from its last state.
        const bool is_first = i < 20 || i >= 40;
        recording += goal(i);
        recording += is_first ? ",0,1,5,virtual-proxy,40,1\n" : ",0,1,6,god-object,1,3\n";
        (is_first ? first : second) += goal(i) + "\n";
        all_one += goal(i) + ",0,1,5,god-object,1,3\n";
        plain += goal(i) + "\n";
    }
    const auto words = [](const std::vector<Row>& rows) {
        std::vector<std::vector<std::string>> all;
        for (const Row& row : rows) {
            all.push_back(row.words);
        }
        return all;
    };
    const auto a =
        words(traced(bundledMountain(), first, {"--model", "virtual-proxy", "--radius", "40"}));
    const auto b =
        words(traced(bundledMountain(), second, {"--model", "god-object", "--exaggeration", "3"}));
    auto expected = std::vector(a.begin(), a.begin() + 20);
    expected.insert(expected.end(), b.begin(), b.end());
    expected.insert(expected.end(), a.begin() + 20, a.end());
    const auto rows = traced(bundledMountain(), recording);
    EXPECT_EQ(words(rows), expected);
    EXPECT_TRUE(rows.at(19).is_in_contact && rows.at(39).is_in_contact &&
                rows.at(59).is_in_contact);
    EXPECT_NE(a, words(traced(bundledMountain(), first))) << "the model must matter";

    // Options on the command line take precedence.
    const std::vector<std::string> other{"--model", "surface-walk", "--exaggeration", "2"};
    EXPECT_EQ(words(traced(bundledMountain(), all_one, other)),
              words(traced(bundledMountain(), plain, other)));

    // A recording over two maps cannot be traced on one.
    const TempFolder folder;
    const std::string two =
        folder.write("two.csv", recording + goal(60) + ",0,2,7,god-object,1,1\n");
    const ProgramOutput refused = runCli({"trace", bundledMountain(), "--goals", two});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_NE(refused.err.find("is a recording of another map from line 62 on"), std::string::npos)
        << refused.err;
}

// 2026-11: it would slide over the lower map alone.
TEST(TraceCommand, ARecordingOverJoinedMapsIsNotTracedOnOne)
{
    const TempFolder folder;
    const std::string frame = "/3396190/3376200/0/0/1000/0/0/-1000";
    const std::string goals = folder.write("joined.csv",
                                           "lon,lat,z,map,part,model,radius_m,exaggeration,ground\n"
                                           "10,60,0,1,7,god-object,1,1,part/7/41/33" +
                                               frame + " below/7/1440/720" + frame + "\n");
    const ProgramOutput refused =
        runCli({"trace", "--scene", "body", bundledMars(), "--goals", goals});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_NE(
        refused.err.find("joined.csv: was recorded on 2 maps on top of each other from line 2 "
                         "on; replay it in the window"),
        std::string::npos)
        << refused.err;
}

// On the body the surface has no border at 0°: the proxy follows a goal around the whole of Mars at
// 60° N, once in each direction, and arrives where it began. Distances are those of the sphere.
TEST(TraceCommand, OnTheBodyTheProxyGoesAroundWithoutASeam)
{
    const TempFolder folder;
    std::string goals = "lon,lat,z\n10,60,30000\n";
    for (int i = 0; i <= 720; ++i) {
        goals += fmt::format("{},60,-9000\n", 10.0 + static_cast<double>(i));
    }
    for (int i = 719; i >= 0; --i) {
        goals += fmt::format("{},60,-9000\n", 10.0 + static_cast<double>(i));
    }
    for (const char* model : {"proxy-graph", "surface-walk", "continuous-walk", "god-object"}) {
        const ProgramOutput output =
            runCli({"trace", "--scene", "body", "--model", model, bundledMars(), "--goals",
                    folder.write("around.csv", goals)});
        ASSERT_EQ(output.exit_status, 0) << output.err;
        const std::vector<std::string> lines = linesOf(output.out);
        EXPECT_TRUE(lines.at(0).starts_with("lon,lat,z,contact,")) << lines.at(0);
        const std::vector<Row> rows = rowsOf(output.out);
        ASSERT_EQ(rows.size(), 1442U);
        for (std::size_t i = 1; i < rows.size(); ++i) {
            const double goal_deg = 10.0 + static_cast<double>(i <= 721 ? i - 1 : 1441 - i);
            ASSERT_TRUE(rows[i].is_in_contact) << model << " " << i;
            // Near the goal: valleys hold a proxy back by a few cells of 0.25°.
            ASSERT_LT(std::abs(std::remainder(rows[i].x - goal_deg, 360.0)), 4.0) << model << i;
            ASSERT_NEAR(rows[i].y, 60.0, 2.0) << model << " " << i;
        }
    }
}

TEST(TraceCommand, OnTheBodyGoalsNeedTheirOwnHeaderAndTheMapABody)
{
    const TempFolder folder;
    const std::string flat = folder.write("flat.csv", "x,y,z\n1,2,3\n");
    const ProgramOutput columns =
        runCli({"trace", "--scene", "body", bundledMars(), "--goals", flat});
    EXPECT_EQ(columns.exit_status, 1);
    EXPECT_THAT(columns.err, testing::HasSubstr("not the header \"lon,lat,z\""));
    const std::string goals = folder.write("body.csv", "lon,lat,z\n1,2,3\n");
    const std::string local = hills(folder, "", {0, 30, 0, 0, 0, -30}, 10.0);
    const ProgramOutput no_body = runCli({"trace", "--scene", "body", local, "--goals", goals});
    EXPECT_EQ(no_body.exit_status, 1);
    EXPECT_THAT(no_body.err, testing::HasSubstr("has no CRS on a body"));
    EXPECT_EQ(runCli({"trace", "--scene", "globe", bundledMars(), "--goals", goals}).exit_status,
              2);
}

// 300 m above a level map, with cells of 0.01°: goals go straight into the upper one, 1 m below the
// curve of 3 t² - 2 t³ from one to the other.
TEST(TraceCommand, OnTheBodyTheEdgesOfAMapAreBlendedIntoTheMapBelow)
{
    const TempFolder folder;
    const std::string lower = writeLevelMars(folder, "lower", 60, {98.0, 3.0, 0.05}, 0.0F);
    const std::string upper = writeLevelMars(folder, "upper", 61, {100.0, 1.0, 0.01}, 300.0F);
    const auto curve_m = [](int cell, double cells) {
        const double t = std::clamp(cell / cells, 0.0, 1.0);
        return 300.0 * (3.0 * t * t - 2.0 * t * t * t);
    };
    for (const double cells : {0.0, 20.0}) {
        std::string goals = "lon,lat,z\n99.9,0.7,1000\n";
        for (int cell = -5; cell <= 30; ++cell) {
            goals += fmt::format("{},{},{}\n", 100.005 + 0.01 * cell, 0.695,
                                 curve_m(cell, std::max(cells, 1e-9)) - 1.0);
        }
        const ProgramOutput output =
            runCli({"trace", upper, "--scene", "body", "--below", lower, "--feather",
                    fmt::format("{:.0f}", cells), "--goals", folder.write("edge.csv", goals)});
        ASSERT_EQ(output.exit_status, 0) << output.err;
        const std::vector<Row> rows = rowsOf(output.out);
        ASSERT_EQ(rows.size(), 37U);
        for (int cell = -5; cell <= 30; ++cell) {
            const Row& row = rows[static_cast<std::size_t>(cell + 6)];
            EXPECT_TRUE(row.is_in_contact) << cell;
            if (cells > 0.0 || cell < -1) {
                EXPECT_NEAR(row.z, curve_m(cell, std::max(cells, 1e-9)), 1.0) << cell;
            } else if (cell > 1) {
                EXPECT_LT(row.z, 299.0) << "held by the wall";
            }
        }
    }
    const std::string goals = folder.write("goals.csv", "lon,lat,z\n100,0.7,3\n");
    const auto refusal = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{"trace", upper, "--goals", goals};
        all.insert(all.end(), options.begin(), options.end());
        const ProgramOutput output = runCli(all);
        EXPECT_EQ(output.exit_status, 2);
        return output.err;
    };
    EXPECT_THAT(refusal({"--below", lower}), testing::HasSubstr("add --scene body"));
    EXPECT_THAT(refusal({"--scene", "body", "--feather", "5"}), testing::HasSubstr("add --below"));
    EXPECT_THAT(refusal({"--scene", "body", "--below", lower, "--feather", "201"}),
                testing::HasSubstr("--feather"));
    RasterRecipe moon = recipeFor(4, std::vector<float>(16, 0.0F));
    moon.transform = {0.0, 10.0, 0.0, 20.0, 0.0, -10.0};
    moon.srs = "IAU_2015:30100";
    const ProgramOutput other = runCli({"trace", upper, "--scene", "body", "--below",
                                        writeVrt(folder, "moon", moon), "--goals", goals});
    EXPECT_EQ(other.exit_status, 1);
    EXPECT_THAT(other.err, testing::HasSubstr("is a map of Moon"));
}

} // namespace marsview::test
