#include "tests/cli/run_cli.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/http_server.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

} // namespace

TEST(InfoCommand, DescribesTheBundledMars)
{
    const nlohmann::json info = cliInfo(bundledMars());
    EXPECT_EQ(info["driver"], "GTiff");
    EXPECT_EQ(info["columns"], 1440);
    EXPECT_EQ(info["rows"], 720);
    EXPECT_EQ(info["sample_type"], "Int16");
    EXPECT_EQ(info["nodata"], -32768.0);
    EXPECT_EQ(info["minimum"], -8068.0);
    EXPECT_EQ(info["maximum"], 21134.0);
    EXPECT_EQ(info["vertical_unit"], "m");
    EXPECT_EQ(info["body"], "Mars");
    EXPECT_THAT(info["radii_m"].get<std::vector<double>>(), ElementsAre(3396000.0, 3396000.0));
    EXPECT_EQ(info["triangle_count"], 2 * 1439 * 719);
    EXPECT_THAT(info["corners_lonlat"]["upper_left"].get<std::vector<double>>(),
                ElementsAre(DoubleNear(0.0, 1e-9), DoubleNear(90.0, 1e-9)));
    EXPECT_THAT(info["corners_lonlat"]["lower_right"].get<std::vector<double>>(),
                ElementsAre(DoubleNear(360.0, 1e-9), DoubleNear(-90.0, 1e-9)));
    EXPECT_EQ(info["wraps_around"], true);
    EXPECT_TRUE(info["notices"].empty());
}

TEST(InfoCommand, AgreesWithGdalinfoOnEveryReadableFile)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const CatalogueEntry& entry : catalogue()) {
        const std::string path = (sharedData() / entry.path).string();
        const ProgramOutput output = runCli({"info", path, "--json"});
        if (output.exit_status != 0) {
            continue; // errors and their messages are tested with the rasters
        }
        SCOPED_TRACE(entry.path);
        const nlohmann::json ours = nlohmann::json::parse(output.out);
        const nlohmann::json theirs = gdalInfo(ours["file"].get<std::string>());
        EXPECT_EQ(ours["columns"], theirs["size"][0]);
        EXPECT_EQ(ours["rows"], theirs["size"][1]);
        EXPECT_EQ(ours["driver"], theirs["driverShortName"]);
        EXPECT_EQ(ours["sample_type"], firstBand(theirs)["type"]);
        EXPECT_EQ(!ours["nodata"].is_null(), firstBand(theirs).contains("noDataValue"));
        EXPECT_EQ(!ours["crs_wkt"].is_null(), theirs.contains("coordinateSystem"));
        if (entry.path.find("megt90n000cb") != std::string::npos) {
            continue; // shifted by a pixel on purpose
        }
        EXPECT_EQ(ours["geotransform"].is_null(), !theirs.contains("geoTransform"));
        if (theirs.contains("geoTransform")) {
            for (std::size_t i = 0; i < 6; ++i) {
                const double term = theirs["geoTransform"][i].get<double>();
                EXPECT_NEAR(ours["geotransform"][i].get<double>(), term,
                            1e-16 + 1e-15 * std::abs(term)); // gdalinfo prints 16 decimals
            }
        }
    }
}

TEST(InfoCommand, PlacesTheCornersOfPds3MapsWhereTheLabelsDo)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const char* label : {"mars_mola/megt90n000cb.lbl", "moon_lola/LDEM_4.LBL"}) {
        SCOPED_TRACE(label);
        const nlohmann::json corners = cliInfo((sharedData() / label).string())["corners_lonlat"];
        constexpr double kRoundedScaleDeg = 0.002; // the labels give MAP_SCALE with five digits
        EXPECT_THAT(corners["upper_left"].get<std::vector<double>>(),
                    ElementsAre(DoubleNear(0.0, kRoundedScaleDeg), DoubleNear(90.0, 1e-9)));
        EXPECT_THAT(corners["lower_right"].get<std::vector<double>>(),
                    ElementsAre(DoubleNear(360.0, kRoundedScaleDeg), DoubleNear(-90.0, 1e-9)));
    }
}

// The unit of most projected maps is the meter.
TEST(InfoCommand, PrintsThePixelSizeInMetersOnce)
{
    const auto sizes_of = [](const std::string& raster) {
        std::vector<std::string> sizes;
        std::istringstream lines(runCli({"info", raster}).out);
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("pixel size")) {
                sizes.push_back(line.substr(16));
            }
        }
        return sizes;
    };
    const TempFolder folder;
    const auto raster = [&](const char* name, const char* crs, double cell) {
        const std::string text = folder.write(
            std::string(name) + ".asc",
            fmt::format("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 10\ncellsize {}\n1 2 3\n4 5 6\n",
                        cell));
        const std::string file = folder.file(std::string(name) + ".tif");
        test::runTool({"gdal_translate", "-q", "-ot", "Int16", "-a_srs", crs, text, file});
        return file;
    };
    EXPECT_THAT(sizes_of(raster("meters", "EPSG:32632", 30.0)), ElementsAre("30.0 30.0 m"));
    EXPECT_THAT(sizes_of(raster("feet", "EPSG:2230", 100.0)),
                ElementsAre("100.0 100.0 US survey foot", testing::StartsWith("30.48")));
    EXPECT_THAT(sizes_of(raster("degrees", "EPSG:4326", 1.0)),
                ElementsAre("1.0 1.0 degree", testing::EndsWith(" m")));
}

TEST(InfoCommand, SaysThatALabelHasNoImage)
{
    const TempFolder folder;
    const auto refusal = [&](const std::string& more) {
        return runCli({"info", folder.write("table.lbl",
                                            "PDS_VERSION_ID = PDS3\nRECORD_TYPE = FIXED_LENGTH\n"
                                            "RECORD_BYTES = 80\nFILE_RECORDS = 20\n" +
                                                more + "END\n")})
            .err;
    };
    EXPECT_THAT(
        refusal("^TABLE = \"A.TAB\"\nOBJECT = TABLE\n ROWS = 20\nEND_OBJECT = TABLE\n"),
        testing::HasSubstr("table.lbl: is a PDS label without an image: it has neither ^IMAGE "
                           "nor a COMPRESSED_FILE (only ^TABLE); open the label of an image"));
    EXPECT_THAT(refusal("OBJECT = IMAGE\n LINES = 20\n LINE_SAMPLES = 40\nEND_OBJECT = IMAGE\n"),
                testing::HasSubstr("neither ^IMAGE nor a COMPRESSED_FILE; open"));
    EXPECT_THAT(refusal("^IMAGE = \"A.IMG\"\n"),
                testing::Not(testing::HasSubstr("without an image")));
}

TEST(InfoCommand, RefusesTruncatedNetcdf)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const TempFolder folder;
    const std::string whole = readFile(sharedData() / "etopo/etopo60.cdf");
    const std::string half = folder.write("half.nc", whole.substr(0, whole.size() / 2));
    const ProgramOutput output = runCli({"info", half});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_NE(output.err.find("cut short"), std::string::npos) << output.err;
    EXPECT_EQ(runCli({"info", folder.write("whole.nc", whole)}).exit_status, 0);
}

TEST(InfoCommand, DescribesRastersThatAreNotASurface)
{
    const TempFolder folder;
    const std::string row = writeRaster(folder, "row.tif", "GTiff",
                                        recipeFor(5, std::vector<std::int16_t>{1, 2, 3, 4, 5}));
    const nlohmann::json info = cliInfo(row);
    EXPECT_EQ(info["columns"], 5);
    EXPECT_EQ(info["rows"], 1);
    EXPECT_EQ(info["maximum"], 5.0);
    EXPECT_EQ(info["triangle_count"], 0);
    EXPECT_THAT(info["notices"].get<std::vector<std::string>>(),
                testing::Contains("5 × 1 samples are not a surface; at least 2 × 2 are needed"));
    const ProgramOutput refused = runCli({"prepare", row, "-o", folder.file("prepared.tif")});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_THAT(refused.err, testing::HasSubstr("5 × 1 samples are not a surface"));
}

TEST(InfoCommand, ReportsAServersErrorResponse)
{
    const TempFolder folder;
    HttpServer server(folder.path());
    const std::string address = server.url("missing.tif");
    const auto failure = [&address] {
        const ProgramOutput output = runCli({"info", address});
        EXPECT_EQ(output.exit_status, 1);
        return output.err;
    };
    EXPECT_EQ(failure(), "marsview-cli: " + address +
                             ": nothing was found at this address (404); check its spelling\n");
    server.failNext(100, 403);
    EXPECT_EQ(failure(), "marsview-cli: " + address +
                             ": the server denies access (403); it may require a login, or "
                             "the address may have expired\n");
    server.failNext(100, 500);
    EXPECT_EQ(failure(), "marsview-cli: " + address +
                             ": the server reports an error (500); try again later\n");
}

TEST(InfoCommand, ReportsInvalidNumbersInTheEnvironment)
{
    const ProgramOutput output = runCliWith({"MARSVIEW_HELD_MB=abc"}, {"info", bundledMars()});
    EXPECT_EQ(output.exit_status, 0);
    EXPECT_THAT(output.err,
                testing::HasSubstr("MARSVIEW_HELD_MB is \"abc\", not a number of megabytes"));
}

TEST(InfoCommand, DistinguishesFeetFromMeters)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<float>(2, {100.0F, 200.0F, 300.0F, 400.0F});
    recipe.band_xml = "<UnitType>ft</UnitType>";
    const std::string declared = writeVrt(folder, "declared", recipe);
    EXPECT_EQ(cliInfo(declared)["vertical_unit"], "ft");
    EXPECT_DOUBLE_EQ(cliInfo(declared)["maximum"].get<double>(), 400.0 * 0.3048);
    EXPECT_DOUBLE_EQ(cliInfo(declared)["raw_maximum"].get<double>(), 400.0);
    recipe.band_xml.clear();
    const std::string undeclared = writeVrt(folder, "undeclared", recipe);
    EXPECT_EQ(cliInfo(undeclared)["is_vertical_unit_declared"], false);
    EXPECT_DOUBLE_EQ(cliInfo(undeclared, {"--unit", "ft"})["maximum"].get<double>(),
                     400.0 * 0.3048);
}

TEST(InfoCommand, AppliesOverridesWithoutChangingTheFile)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(2, {1, 2, 3, 4});
    recipe.transform.reset();
    const std::string path = writeVrt(folder, "nowhere", recipe);
    const std::string before = readFile(path);
    EXPECT_TRUE(cliInfo(path)["geotransform"].is_null());
    const nlohmann::json info =
        cliInfo(path, {"--geotransform", "10", "0.5", "0", "-20", "0", "-0.5", "--body", "Vesta"});
    EXPECT_EQ(info["body"], "Vesta");
    EXPECT_THAT(info["corners_lonlat"]["upper_left"].get<std::vector<double>>(),
                ElementsAre(DoubleNear(10.0, 1e-12), DoubleNear(-20.0, 1e-12)));
    EXPECT_EQ(readFile(path), before);
}

} // namespace marsview::test
