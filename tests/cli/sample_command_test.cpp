#include "tests/cli/run_cli.h"
#include "tests/support/damage.h"
#include "tests/support/gdal_tools.h"
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
#include <random>

namespace marsview::test {
namespace {

using testing::HasSubstr;

double sampleAt(const std::string& path, const char* frame, double a, double b)
{
    const ProgramOutput output =
        runCli({"sample", path, frame, fmt::format("{}", a), fmt::format("{}", b)});
    EXPECT_EQ(output.exit_status, 0) << output.err;
    return std::stod(output.out);
}

} // namespace

TEST(SampleCommand, ReturnsTheSampleAtIntegerPixels)
{
    constexpr unsigned kSeed = 20031;
    SCOPED_TRACE(fmt::format("seed {}", kSeed));
    std::mt19937 random(kSeed);
    std::uniform_int_distribution<std::size_t> column(0, 1439);
    std::uniform_int_distribution<std::size_t> row(0, 719);
    std::vector<Pixel> pixels;
    std::string lines;
    for (int i = 0; i < 200; ++i) {
        pixels.push_back({column(random), row(random)});
        lines += fmt::format("{} {}\n", pixels.back().column, pixels.back().row);
    }
    const ProgramOutput output = runCli({"sample", bundledMars(), "--pixel", "--stdin"}, lines);
    ASSERT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(numbersIn(output.out), rawSamples(bundledMars(), pixels));
}

TEST(SampleCommand, FindsOlympusMonsByLongitudeAndLatitudeInAnyTurn)
{
    const double height = sampleAt(bundledMars(), "--lonlat", 226.2, 18.65);
    EXPECT_GT(height, 18000.0);          // in the caldera, some 3 km below its rim
    constexpr double kToleranceM = 1e-6; // 360° more or less, rounded in the 14th digit
    EXPECT_NEAR(sampleAt(bundledMars(), "--lonlat", -133.8, 18.65), height, kToleranceM);
    EXPECT_NEAR(sampleAt(bundledMars(), "--lonlat", 586.2, 18.65), height, kToleranceM);
}

TEST(SampleCommand, ReadsLatitudesOnTheEarthAsPlanetographic)
{
    // The highest point of the crater rim, as the Geographic Names Information System lists it, is
    // on the map only if 46.19° is a planetographic latitude: the map ends at 46.06° planetocentric
    // there.
    const double height = sampleAt(bundledMountain(), "--lonlat", -122.1886, 46.1914);
    EXPECT_GT(height, 2300.0);
    const ProgramOutput centric = runCli({"sample", bundledMountain(), "--lonlat", "-122.1886",
                                          "46.1914", "--latitude", "planetocentric"});
    EXPECT_EQ(centric.out, "nan\n");
}

TEST(SampleCommand, GivesTheSameElevationInAllThreeFrames)
{
    const ProgramOutput output =
        runCli({"sample", bundledMountain(), "--pixel", "100.25", "200.5", "--json"});
    ASSERT_EQ(output.exit_status, 0) << output.err;
    const nlohmann::json report = nlohmann::json::parse(output.out);
    const double height = report["height"].get<double>();
    const std::string map =
        fmt::format("{} {}\n", report["map"][0].get<double>(), report["map"][1].get<double>());
    const std::string lonlat = fmt::format("{} {}\n", report["lonlat"][0].get<double>(),
                                           report["lonlat"][1].get<double>());
    const auto by = [](const char* frame, const std::string& line) {
        return std::stod(runCli({"sample", bundledMountain(), frame, "--stdin"}, line).out);
    };
    // a micrometer on a slope of 1 is a micrometer of elevation
    constexpr double kToleranceM = 1e-6;
    EXPECT_NEAR(by("--map", map), height, kToleranceM);
    EXPECT_NEAR(by("--lonlat", lonlat), height, kToleranceM);
}

// Latitude before longitude is a common slip.
TEST(SampleCommand, SaysThatALatitudeIsImpossible)
{
    const ProgramOutput swapped = runCli({"sample", bundledMars(), "--lonlat", "18.65", "226.2"});
    EXPECT_EQ(swapped.exit_status, 0);
    EXPECT_EQ(swapped.out, "nan\n");
    EXPECT_NE(
        swapped.err.find("latitude 226.2 is outside -90 to 90 degrees; write longitude before "
                         "latitude\n"),
        std::string::npos)
        << swapped.err;
    const ProgramOutput many =
        runCli({"sample", bundledMars(), "--lonlat", "--stdin"}, "0 90\n1 -91\n2 92\n");
    EXPECT_EQ(std::count(many.out.begin(), many.out.end(), '\n'), 3);
    EXPECT_NE(many.err.find("latitude -91 is"), std::string::npos) << many.err;
    EXPECT_EQ(many.err.find("latitude 92"), std::string::npos) << "one notice is enough";
    EXPECT_EQ(runCli({"sample", bundledMars(), "--map", "0", "95"}).err.find("latitude 95"),
              std::string::npos);
}

TEST(SampleCommand, PrintsNanOnlyOutside)
{
    EXPECT_TRUE(std::isnan(sampleAt(bundledMars(), "--pixel", -1.0, 0.0)));
    EXPECT_TRUE(std::isnan(sampleAt(bundledMars(), "--pixel", 0.0, 719.001)));
    EXPECT_TRUE(std::isnan(sampleAt(bundledMars(), "--map", 1e9, 1e9)));
    EXPECT_TRUE(std::isnan(sampleAt(bundledMountain(), "--lonlat", 0.0, 0.0)));
    EXPECT_FALSE(std::isnan(sampleAt(bundledMars(), "--pixel", 1439.0, 719.0)));
}

TEST(SampleCommand, InterpolatesAcrossTheSeamOfAGlobalMap)
{
    const double west = sampleAt(bundledMars(), "--pixel", 1439.0, 359.0);
    const double east = sampleAt(bundledMars(), "--pixel", 0.0, 359.0);
    const double latitude = 90.0 - 0.25 * 359.5;
    EXPECT_DOUBLE_EQ(sampleAt(bundledMars(), "--lonlat", 0.0, latitude), (west + east) / 2.0);
}

TEST(SampleCommand, PrintsDigitsThatReadBackExactly)
{
    const ProgramOutput text = runCli({"sample", bundledMars(), "--pixel", "10.1", "20.7"});
    const ProgramOutput json =
        runCli({"sample", bundledMars(), "--pixel", "10.1", "20.7", "--json"});
    EXPECT_EQ(std::stod(text.out), nlohmann::json::parse(json.out)["height"].get<double>());
    EXPECT_NE(text.out.find('.'), std::string::npos);
}

TEST(SampleCommand, NamesTheLineOfStandardInputThatItCannotRead)
{
    const ProgramOutput output =
        runCli({"sample", bundledMars(), "--pixel", "--stdin"}, "1 2\n3 x\n");
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_NE(output.err.find("line 2"), std::string::npos) << output.err;
}

TEST(SampleCommand, FindsEverySampleAtItsPositionEvenNextToVoids)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::string path = (sharedData() / "derived/W100N40_etopo5.DEM").string();
    std::string places;
    std::string pixels;
    for (int row = 0; row < 600; row += 3) {
        for (int column = 0; column < 480; column += 7) {
            pixels += fmt::format("{} {}\n", column, row);
            places += fmt::format("{} {}\n", -100.0416666666665 + (column + 0.5) * 0.083333333333,
                                  40.0416666666665 - (row + 0.5) * 0.083333333333);
        }
    }
    EXPECT_EQ(runCli({"sample", path, "--map", "--stdin"}, places).out,
              runCli({"sample", path, "--pixel", "--stdin"}, pixels).out);
}

TEST(SampleCommand, AcceptsThePositionBeforeTheMap)
{
    EXPECT_EQ(runCli({"sample", "--pixel", "3", "4", bundledMars()}).out,
              runCli({"sample", bundledMars(), "--pixel", "3", "4"}).out);
    EXPECT_EQ(runCli({"sample", bundledMars(), "--pixel", "--stdin"}, "nan 1\n3 4\n").exit_status,
              0);
}

TEST(SampleCommand, ReadsTheColoradoMapInFeetOnRequest)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const std::string path = (sharedData() / "derived/trinidad_co_3as.tif").string();
    const double elevation_m =
        std::stod(runCli({"sample", path, "--pixel", "1000", "500", "--unit", "ft"}).out);
    EXPECT_DOUBLE_EQ(elevation_m, rawSamples(path, {{1000, 500}}).front() * 0.3048);
}

// GDAL decodes some damaged tiles to wrong samples without an error.
TEST(SampleCommand, ReportsDamagedTilesAsErrorsInsteadOfElevations)
{
    namespace fs = std::filesystem;
    const TempFolder folder;
    const std::string whole = folder.file("whole.tif");
    ASSERT_EQ(runCli({"prepare", bundledMars(), "-o", whole}).exit_status, 0);
    Random random;
    std::string positions;
    for (int i = 0; i < 400; ++i) {
        positions += fmt::format("{} {}\n", random.below(1440), random.below(720));
    }
    const auto sampled = [&](const std::string& path) {
        return runCli({"sample", path, "--pixel", "--stdin"}, positions);
    };
    const ProgramOutput truth = sampled(whole);
    ASSERT_EQ(truth.exit_status, 0) << truth.err;
    EXPECT_EQ(truth.err, "");
    EXPECT_EQ(truth.out, sampled(bundledMars()).out);

    const std::string path = folder.file("damaged.tif");
    int refusals = 0;
    for (int i = 0; i < 30; ++i) {
        fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
        fs::copy_file(whole + ".marsview", path + ".marsview",
                      fs::copy_options::overwrite_existing);
        fs::last_write_time(path, fs::last_write_time(whole));
        flipBits(path, 3, random);
        const ProgramOutput output = sampled(path);
        if (output.exit_status == 0) {
            // Correct, or the level file was rejected, so that the damage could not be detected.
            EXPECT_TRUE(output.out == truth.out ||
                        output.err.find("its level file is not used") != std::string::npos);
        } else {
            ++refusals;
            EXPECT_THAT(output.err, HasSubstr(path));
            EXPECT_EQ(truth.out.substr(0, output.out.size()), output.out) << "then the error";
        }
    }
    EXPECT_GT(refusals, 5);
}

TEST(SampleCommand, PrintsOneLineForEveryLineOfItsInput)
{
    const ProgramOutput output =
        runCli({"sample", bundledMars(), "--pixel", "--stdin"}, "1 2\n\n3 4\n \t\r\n5 6");
    EXPECT_EQ(output.exit_status, 0) << output.err;
    const std::vector<double> elevations = numbersIn(output.out);
    ASSERT_EQ(elevations.size(), 5U);
    EXPECT_TRUE(std::isnan(elevations[1]) && std::isnan(elevations[3]));
    EXPECT_EQ(elevations[4],
              numbersIn(runCli({"sample", bundledMars(), "--pixel", "5", "6"}).out).at(0));
    const ProgramOutput json =
        runCli({"sample", bundledMars(), "--pixel", "--stdin", "--json"}, "1 2\n\n");
    EXPECT_EQ(std::count(json.out.begin(), json.out.end(), '\n'), 2);
    const auto empty = nlohmann::json::parse(json.out.substr(json.out.find('\n')));
    for (const char* field : {"height", "pixel", "map", "lonlat"}) {
        EXPECT_TRUE(empty[field].is_null()) << field;
    }
}

TEST(SampleCommand, ReadsInputThatBeginsWithAByteOrderMark)
{
    const std::vector<std::string> command{"sample", bundledMars(), "--pixel", "--stdin"};
    const ProgramOutput output = runCli(command,
                                        "\xEF\xBB\xBF"
                                        "5,6\r\n7,8\r\n");
    EXPECT_EQ(output.exit_status, 0) << output.err;
    EXPECT_EQ(output.out, runCli(command, "5 6\n7 8\n").out);
}

} // namespace marsview::test
