#include "tests/cli/run_cli.h"
#include "tests/support/reference_ellipsoid.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

ProgramOutput measured(const std::string& what,
                       const std::string& map,
                       const std::string& positions,
                       Words more = {})
{
    Words words{"measure", what, map, "--points", "-"};
    words.insert(words.end(), more.begin(), more.end());
    return runCli(words, positions);
}

nlohmann::json measuredJson(const std::string& what,
                            const std::string& map,
                            const std::string& positions,
                            Words more = {})
{
    more.emplace_back("--json");
    const ProgramOutput output = measured(what, map, positions, more);
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return nlohmann::json::parse(output.out);
}

struct CsvTable {
    std::string header;
    std::vector<std::vector<double>> rows;
};

CsvTable tableIn(const std::string& text)
{
    CsvTable table;
    std::istringstream lines(text);
    std::getline(lines, table.header);
    for (std::string line; std::getline(lines, line);) {
        table.rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) {
            table.rows.back().push_back(std::stod(field));
        }
    }
    return table;
}

} // namespace

TEST(MeasureDistance, MatchesGeodSolveOnTheBodyOfTheMap)
{
    // The map is planetocentric on a sphere of 3396 km; on an ellipsoid, latitudes are converted.
    const auto geodesic_m = [](double polar_m, bool is_centric) {
        const auto latitude = [&](double degrees) {
            return is_centric
                       ? static_cast<double>(graphicLatitude_deg(3396190.0L, polar_m, degrees))
                       : degrees;
        };
        const std::string input =
            fmt::format("{:.15f} 226.2 {:.15f} 255.5\n", latitude(18.65), latitude(11.8));
        const std::string out = runTool({"GeodSolve", "-i", "-p", "10", "-e", "3396190",
                                         fmt::format("{:.17g}", (3396190.0 - polar_m) / 3396190.0)},
                                        input);
        return numbersIn(out.substr(out.rfind(' ') + 1)).front();
    };
    const std::string positions = "lon,lat\n226.2,18.65\n255.5,11.8\n";
    const Words sphere{"--radii", "3396190"};
    const Words ellipsoid{"--radii", "3396190,3376200"};
    EXPECT_NEAR(
        measuredJson("distance", bundledMars(), positions, sphere)["geodesic_m"].get<double>(),
        geodesic_m(3396190.0, false), 1e-3);
    EXPECT_NEAR(
        measuredJson("distance", bundledMars(), positions, ellipsoid)["geodesic_m"].get<double>(),
        geodesic_m(3376200.0, true), 1e-3);
}

TEST(MeasureDistance, ReadsPositionsInEveryForm)
{
    const std::string truth = measured("distance", bundledMars(), "226.2 18.65\n230 20\n").out;
    const TempFolder folder;
    for (const char* text :
         {"226.2,18.65\n230,20\n", "lon;lat\r\n226.2;18.65\r\n230;20\r\n",
          "\xEF\xBB\xBF"
          "226.2\t18.65\n\n230\t20",
          "Longitude Latitude\n226.2 18.65\n+230 2e1\n", "-133.8 18.65\n590 20\n"}) {
        const ProgramOutput output = measured("distance", bundledMars(), text, {"--lonlat"});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(output.out.substr(0, 33), truth.substr(0, 33)) << text;
    }
    const std::string file = folder.write("points.csv", "226.2 18.65\n230 20\n");
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--points", file}).out, truth);
    // Map coordinates of a geographic map are the same numbers.
    EXPECT_EQ(measured("distance", bundledMars(), "226.2 18.65\n230 20\n", {"--map"}).out, truth);
}

// The same two positions, with their columns named in any order and among others.
TEST(MeasureDistance, TakesPositionsFromTheColumnsThatAHeaderNames)
{
    const auto distance = [](const std::string& lines, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"measure",  "distance", bundledMars(),
                                           "--points", "-",        "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramOutput output = runCli(arguments, lines);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return nlohmann::json::parse(output.out)["geodesic_m"].get<double>();
    };
    const double expected_m = distance("10 34.3\n11 35\n");
    EXPECT_EQ(distance("latitude,longitude\n34.3,10\n35,11\n"), expected_m);
    EXPECT_EQ(distance("Lat Lon\n34.3 10\n35 11\n"), expected_m);
    EXPECT_EQ(distance("name;lon;lat;z\n\"Rim; east\";10;34.3;-5\nfloor;11;35;\n"), expected_m);
    EXPECT_EQ(distance("distance_m,lon,lat,x,y,elevation_m\n0,10,34.3,1,2,3\n9,11,35,4,5,6\n"),
              expected_m);
    EXPECT_EQ(distance("elevation,y,x\n1,34.3,10\n2,35,11\n", {"--map"}),
              distance("10 34.3\n11 35\n", {"--map"}));
    const ProgramOutput unnamed =
        runCli({"measure", "distance", bundledMars(), "--points", "-"}, "a,b,c\n1,2,3\n");
    EXPECT_EQ(unnamed.exit_status, 1);
    EXPECT_NE(unnamed.err.find("two finite numbers are required, or a first line that names their "
                               "columns lon and lat"),
              std::string::npos)
        << unnamed.err;
}

TEST(MeasureDistance, RefusesBadPositionsWithOneSentence)
{
    const auto refusal = [](const std::string& positions, Words more = {}) {
        const ProgramOutput output = measured("distance", bundledMars(), positions, more);
        EXPECT_EQ(output.exit_status, 1);
        EXPECT_EQ(output.out, "");
        return output.err;
    };
    EXPECT_EQ(refusal(""),
              "marsview-cli: --points: a distance needs at least 2 positions, but there are 0\n");
    EXPECT_EQ(refusal("1 2\n3\n"),
              "marsview-cli: --points: line 2 is \"3\"; two finite numbers are required\n");
    EXPECT_EQ(refusal("1 2\nx y\n"),
              "marsview-cli: --points: line 2 is \"x y\"; two finite numbers are required\n");
    EXPECT_EQ(refusal("1 2\n18 226\n"),
              "marsview-cli: --points: position 2 has latitude 226, which is outside -90 to 90 "
              "degrees; write longitude before latitude, or add --map for map coordinates\n");
    EXPECT_EQ(refusal("1 2\nnan 3\n"),
              "marsview-cli: --points: line 2 is \"nan 3\"; two finite numbers are required\n");
    const ProgramOutput missing =
        runCli({"measure", "distance", bundledMars(), "--points", "/no/such/file.csv"});
    EXPECT_EQ(missing.exit_status, 1);
    EXPECT_EQ(missing.err, "marsview-cli: /no/such/file.csv: cannot be opened for reading\n");
    EXPECT_EQ(runCli({"measure", "distance", bundledMars()}).exit_status, 2);
    EXPECT_EQ(runCli({"measure", "distence", bundledMars()}).exit_status, 2);
    EXPECT_EQ(measured("distance", bundledMars(), "1 2\n3 4\n", {"--map", "--lonlat"}).exit_status,
              2);
    const ProgramOutput endless =
        runCli({"measure", "distance", bundledMars(), "--points", "/dev/zero"});
    EXPECT_EQ(endless.exit_status, 1);
}

TEST(MeasureDistance, ReadsPositionsFromVectorFiles)
{
    const TempFolder folder;
    const std::string truth = measured("distance", bundledMars(), "226.2 18.65\n230 20\n").out;
    const std::string wkt =
        folder.write("line.csv", "wkt,name\n\"LINESTRING(226.2 18.65,230 20)\",a\n");
    for (const char* name : {"line.gpkg", "line.geojson", "line.shp"}) {
        const std::string file = folder.file(name);
        runTool({"ogr2ogr", "-a_srs", "IAU_2015:49900", "-nlt", "LINESTRING", file, wkt});
        const ProgramOutput output =
            runCli({"measure", "distance", bundledMars(), "--vector", file});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(output.out.substr(0, 33), truth.substr(0, 33)) << name;
    }
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--vector", wkt}).out, truth);
    const std::string earth = folder.file("earth.gpkg");
    runTool({"ogr2ogr", "-a_srs", "EPSG:4326", "-nlt", "LINESTRING", earth, wkt});
    const ProgramOutput refused = runCli({"measure", "distance", bundledMars(), "--vector", earth});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_THAT(refused.err, HasSubstr("is on the Earth, but the map is on Mars"));
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--vector", "/no/such.gpkg"}).err,
              "marsview-cli: /no/such.gpkg: does not exist\n");
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--vector", "/dev/zero"}).exit_status,
              1);
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--vector", bundledMars()}).exit_status,
              1);
    EXPECT_EQ(runCli({"measure", "distance", bundledMars(), "--vector", wkt, "--points", "-"})
                  .exit_status,
              2);
}

// The bundled map of Mars has a sample each 14.8 km, in whole meters: lengths end at the place of
// the second digit of that, elevations at a tenth of a meter.
TEST(MeasureDistance, PrintsTheDigitsThatTheSamplesGive)
{
    const std::string positions = "226.2 18.65\n230 20\n";
    const nlohmann::json exact = measuredJson("distance", bundledMars(), positions);
    const double geodesic_m = exact["geodesic_m"].get<double>();
    const std::string text = measured("distance", bundledMars(), positions).out;
    EXPECT_THAT(text, HasSubstr(fmt::format("Geodesic distance:    {:.0f} m\n",
                                            std::round(geodesic_m / 1000.0) * 1000.0)));
    EXPECT_THAT(text, HasSubstr(fmt::format("Rise:                 {:.1f} m\n",
                                            exact["rise_m"].get<double>())));
    const nlohmann::json crater =
        measuredJson("crater", bundledMars(), "226.1 18.9\n227.4 18.5\n226.4 17.8\n227.2 18.9\n");
    // A tenth of the samples' distance is 0.025°, and 2 digits of it are thousandths.
    EXPECT_THAT(
        measured("crater", bundledMars(), "226.1 18.9\n227.4 18.5\n226.4 17.8\n227.2 18.9\n").out,
        HasSubstr(fmt::format("Center:     {:.3f}, {:.3f}\n", crater["lon"].get<double>(),
                              crater["lat"].get<double>())));
    // Its walls rise by the depth over a radius of two samples: the last digit counts 10 m.
    EXPECT_THAT(
        measured("crater", bundledMars(), "226.1 18.9\n227.4 18.5\n226.4 17.8\n227.2 18.9\n").out,
        HasSubstr(fmt::format("Depth:      {:.0f} m\nd/D:        {:.2f}",
                              10.0 * std::round(0.1 * crater["depth_m"].get<double>()),
                              std::floor(100.0 * crater["depth_m"].get<double>() /
                                         crater["diameter_m"].get<double>()) /
                                  100.0)));
}

TEST(MeasureProfile, IsCsvWithThePositionsOfEveryPoint)
{
    const ProgramOutput output =
        measured("profile", bundledMountain(), "-122.2 46.19\n-122.18 46.2\n");
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const CsvTable table = tableIn(output.out);
    EXPECT_EQ(table.header, "distance_m,lon,lat,x,y,elevation_m");
    ASSERT_GT(table.rows.size(), 100U);
    std::string lonlat;
    std::string xy;
    for (const auto& row : table.rows) {
        ASSERT_EQ(row.size(), 6U);
        lonlat += fmt::format("{} {}\n", row[1], row[2]);
        xy += fmt::format("{} {}\n", row[3], row[4]);
    }
    const auto by_lonlat =
        numbersIn(runCli({"sample", bundledMountain(), "--lonlat", "--stdin"}, lonlat).out);
    const auto by_map =
        numbersIn(runCli({"sample", bundledMountain(), "--map", "--stdin"}, xy).out);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        EXPECT_NEAR(table.rows[i][5], by_lonlat[i], 1e-4);
        EXPECT_NEAR(table.rows[i][5], by_map[i], 1e-4);
    }
    const CsvTable stepped = tableIn(
        measured("profile", bundledMountain(), "-122.2 46.19\n-122.18 46.2\n", {"--step", "50"})
            .out);
    EXPECT_EQ(stepped.rows[3][0], 150.0);
    EXPECT_EQ(stepped.rows.back()[0], table.rows.back()[0]);
    EXPECT_EQ(measured("profile", bundledMountain(), "0 0\n1 1\n", {"--step", "0"}).exit_status, 2);
}

TEST(MeasureProfile, ShowsGapsAsNan)
{
    const ProgramOutput output =
        measured("profile", bundledMountain(), "-122.2 46.19\n-121 46.2\n");
    const CsvTable table = tableIn(output.out);
    ASSERT_GT(table.rows.size(), 10U);
    EXPECT_TRUE(std::isfinite(table.rows.front()[5]));
    EXPECT_TRUE(std::isnan(table.rows.back()[5]));
    const nlohmann::json distance =
        measuredJson("distance", bundledMountain(), "-122.2 46.19\n-121 46.2\n");
    EXPECT_TRUE(distance["surface_m"].is_null());
    EXPECT_TRUE(distance["rise_m"].is_null());
    EXPECT_GT(distance["geodesic_m"].get<double>(), 90'000.0);
}

TEST(MeasureAttitude, RefusesPointsOnALineAndStatesTheErrorOfThree)
{
    const nlohmann::json attitude =
        measuredJson("attitude", bundledMars(), "226.2 18.65\n230 20\n228 15\n");
    EXPECT_EQ(attitude["points"], 3);
    EXPECT_EQ(attitude["uncertainty"]["elevation_error_m"], 0.5); // whole meters
    EXPECT_GT(attitude["uncertainty"]["dip_error_deg"].get<double>(), 0.0);
    EXPECT_NEAR(std::remainder(attitude["dip_direction_deg"].get<double>() -
                                   attitude["strike_deg"].get<double>() - 90.0,
                               360.0),
                0.0, 1e-9);
    const nlohmann::json stated = measuredJson(
        "attitude", bundledMars(), "226.2 18.65\n230 20\n228 15\n", {"--elevation-error", "5"});
    EXPECT_NEAR(stated["uncertainty"]["dip_error_deg"].get<double>(),
                10.0 * attitude["uncertainty"]["dip_error_deg"].get<double>(), 1e-4);
    // For people, three points have errors only if those of the elevations are stated.
    const ProgramOutput three =
        measured("attitude", bundledMars(), "226.2 18.65\n230 20\n228 15\n");
    EXPECT_THAT(three.out, HasSubstr("Errors:         three points: no error estimate\n"));
    EXPECT_THAT(three.out, HasSubstr("RMS:            three points: no error estimate\n"));
    EXPECT_THAT(three.out, testing::Not(HasSubstr("±")));
    EXPECT_THAT(measured("attitude", bundledMars(), "226.2 18.65\n230 20\n228 15\n227 17\n").out,
                HasSubstr(" ± "));
    EXPECT_THAT(measured("crater", bundledMars(), "226.2 18.65\n230 20\n228 15\n").out,
                HasSubstr("RMS:        three points: no error estimate\n"));
    const ProgramOutput line = measured("attitude", bundledMars(), "226 18\n227 18\n228 18\n");
    EXPECT_EQ(line.exit_status, 1);
    EXPECT_THAT(line.err, HasSubstr("nearly on a line"));
    const ProgramOutput outside =
        measured("attitude", bundledMountain(), "-122.2 46.19\n-122.19 46.2\n0 0\n");
    EXPECT_EQ(outside.err,
              "marsview-cli: --points: position 3 (0, 0) is outside the map or on nodata; choose "
              "another position\n");
}

TEST(MeasureArea, IsThatOfPlanimeterWithVolumesOnRequest)
{
    const std::string polygon = "220 10\n235 12\n230 28\n";
    const nlohmann::json area = measuredJson("area", bundledMars(), polygon);
    const std::string planimeter =
        runTool({"Planimeter", "-e", "3396000", "0", "-p", "8"}, "10 220\n12 235\n28 230\n");
    std::istringstream words(planimeter);
    double count = 0.0;
    double perimeter_m = 0.0;
    double area_m2 = 0.0;
    words >> count >> perimeter_m >> area_m2;
    EXPECT_NEAR(area["geodesic_m2"].get<double>(), area_m2, 1e-9 * area_m2);
    EXPECT_NEAR(area["perimeter_m"].get<double>(), perimeter_m, 1e-9 * perimeter_m);
    EXPECT_GT(area["surface_m2"].get<double>(), area_m2);
    EXPECT_GT(area["max_m"].get<double>(), 21'000.0); // Olympus Mons
    EXPECT_FALSE(area.contains("volume_above_m3"));
    const nlohmann::json low = measuredJson("area", bundledMars(), polygon, {"--base", "-20000"});
    EXPECT_EQ(low["volume_below_m3"].get<double>(), 0.0);
    EXPECT_NEAR(low["volume_above_m3"].get<double>(),
                (low["mean_m"].get<double>() + 20'000.0) * low["covered_m2"].get<double>(),
                1e-9 * low["volume_above_m3"].get<double>());
    EXPECT_TRUE(measuredJson("area", bundledMars(), polygon, {"--base", "plane"})
                    .contains("volume_below_m3"));
    EXPECT_EQ(measured("area", bundledMars(), polygon, {"--base", "high"}).exit_status, 2);
    EXPECT_EQ(measured("area", bundledMars(), polygon, {"--base", "nan"}).exit_status, 2);
    for (const char* base : {"1e30", "-1e30", "3396001"}) { // Mars has 3 396 000 m
        const ProgramOutput absurd = measured("area", bundledMars(), polygon, {"--base", base});
        EXPECT_EQ(absurd.exit_status, 1);
        EXPECT_EQ(absurd.out, "");
        EXPECT_THAT(absurd.err, HasSubstr("--base: an elevation of "));
        EXPECT_THAT(absurd.err, HasSubstr("is farther from 0 than the body's radius; use one "
                                          "between -3396000 and 3396000 m"));
    }
    EXPECT_EQ(measured("area", bundledMars(), polygon, {"--base", "3396000"}).exit_status, 0);
    const ProgramOutput outside =
        measured("area", bundledMountain(), "-122.2 46.19\n-121 46.2\n-122 47\n");
    EXPECT_EQ(outside.exit_status, 0);
    EXPECT_THAT(outside.err, HasSubstr("outside the map or on nodata"));
    const ProgramOutput crossed =
        measured("area", bundledMars(), "220 10\n230 20\n230 10\n220 18\n");
    EXPECT_THAT(crossed.err, HasSubstr("edges of the polygon cross"));
}

TEST(MeasureArea, HypsometryAddsUpToTheArea)
{
    const std::string polygon = "220 10\n235 12\n230 28\n";
    const nlohmann::json area =
        measuredJson("area", bundledMars(), polygon, {"--hypsometry", "--step", "500"});
    const nlohmann::json& classes = area["hypsometry"];
    double sum_m2 = 0.0;
    double above_m2 = area["covered_m2"].get<double>();
    for (const nlohmann::json& each : classes) {
        EXPECT_EQ(each["to_m"].get<double>() - each["from_m"].get<double>(), 500.0);
        EXPECT_NEAR(each["area_above_m2"].get<double>(), above_m2, 1e-9 * above_m2 + 1.0);
        above_m2 -= each["area_m2"].get<double>();
        sum_m2 += each["area_m2"].get<double>();
    }
    EXPECT_NEAR(sum_m2, area["covered_m2"].get<double>(), 1e-9 * sum_m2);
    EXPECT_LE(classes.front()["from_m"].get<double>(), area["min_m"].get<double>());
    EXPECT_GT(classes.back()["to_m"].get<double>(), area["max_m"].get<double>());
    const ProgramOutput table = measured("area", bundledMars(), polygon, {"--hypsometry"});
    EXPECT_THAT(table.out, testing::StartsWith("from_m,to_m,area_m2,share,area_above_m2,share_above"
                                               "\n-2000,-1500,"));
    EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1 + 47) << table.out;
    EXPECT_EQ(measured("area", bundledMars(), polygon, {"--step", "500"}).exit_status, 2);
    const ProgramOutput fine =
        measured("area", bundledMars(), polygon, {"--hypsometry", "--step", "0.001"});
    EXPECT_EQ(fine.exit_status, 1);
    EXPECT_THAT(fine.err, HasSubstr("use wider ones"));
}

TEST(MeasureCrater, FindsTheCalderaOfOlympusMons)
{
    const nlohmann::json crater =
        measuredJson("crater", bundledMars(), "226.1 18.9\n227.4 18.5\n226.4 17.8\n227.2 18.9\n");
    EXPECT_NEAR(crater["lon"].get<double>(), 226.8, 0.5);
    EXPECT_NEAR(crater["lat"].get<double>(), 18.4, 0.5);
    EXPECT_GT(crater["diameter_m"].get<double>(), 50'000.0);
    EXPECT_LT(crater["diameter_m"].get<double>(), 100'000.0);
    EXPECT_NEAR(crater["depth_m"].get<double>(),
                crater["rim_m"].get<double>() - crater["floor_m"].get<double>(), 1e-9);
    const ProgramOutput line = measured("crater", bundledMars(), "226 18\n227 18\n228 18\n");
    EXPECT_EQ(line.exit_status, 1);
    EXPECT_THAT(line.err, HasSubstr("nearly on a line"));
}

TEST(MeasureSlope, PrintsSlopeAndAspectOfEachPosition)
{
    const std::string positions = "-122.2 46.19\n-122.18 46.2\n0 0\n";
    const CsvTable table = tableIn(measured("slope", bundledMountain(), positions).out);
    EXPECT_EQ(table.header, "lon,lat,x,y,elevation_m,slope_deg,aspect_deg");
    const nlohmann::json json = measuredJson("slope", bundledMountain(), positions);
    ASSERT_EQ(table.rows.size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(json["positions"][i]["slope_deg"].get<double>(), table.rows[i][5]);
        EXPECT_EQ(json["positions"][i]["aspect_deg"].get<double>(), table.rows[i][6]);
        EXPECT_GT(table.rows[i][5], 1.0);
    }
    EXPECT_TRUE(json["positions"][2]["slope_deg"].is_null());
    const nlohmann::json single = measuredJson("slope", bundledMountain(), "-122.2 46.19\n");
    EXPECT_EQ(single["slope_deg"], json["positions"][0]["slope_deg"]);
    const nlohmann::json wide =
        measuredJson("slope", bundledMountain(), "-122.2 46.19\n", {"--baseline", "500"});
    EXPECT_NE(wide["slope_deg"], single["slope_deg"]);
}

} // namespace marsview::test
