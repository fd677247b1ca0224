#include "tests/cli/level_maps.h"
#include "tests/cli/run_cli.h"
#include "tests/support/damage.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace marsview::test {
namespace {

class RenderCommand : public testing::Test {
protected:
    void SetUp() override
    {
        // A missing OpenGL driver is reported before any file is read.
        const std::string missing = folder_.file("missing.tif");
        const ProgramOutput output = render({missing, "-o", folder_.file("no.png")});
        if (output.err.find("no OpenGL") != std::string::npos) {
            GTEST_SKIP() << output.err;
        }
    }

    // The program's output for `render`, with no display server available.
    ProgramOutput render(const std::vector<std::string>& options) const
    {
        return renderHolding({}, options);
    }
    // The same with a limit on rasters read into memory as a whole; 0 for prepared maps.
    ProgramOutput renderHolding(const std::string& held_mb,
                                const std::vector<std::string>& options) const
    {
        std::vector<std::string> environment{"DISPLAY", "WAYLAND_DISPLAY"};
        if (!held_mb.empty()) {
            environment.push_back("MARSVIEW_HELD_MB=" + held_mb);
        }
        std::vector<std::string> arguments{"render"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCliWith(environment, arguments);
    }

    // The bytes of a picture's bands, one band after the other, as GDAL reads them.
    std::string pixels(const std::string& png) const
    {
        const std::string raw = png + ".raw";
        runTool({"gdal_translate", "-q", "-of", "ENVI", "-co", "INTERLEAVE=BSQ", png, raw});
        return readFile(raw);
    }

    // The command prints one sentence that names the cause, and writes no picture.
    void expectRefusal(const std::vector<std::string>& options, const std::string& named) const
    {
        const ProgramOutput output = render(options);
        EXPECT_TRUE(output.exit_status == 1 || output.exit_status == 2)
            << output.exit_status << ": " << output.err;
        EXPECT_EQ(output.out, "");
        EXPECT_TRUE(output.err.starts_with("marsview-cli: ")) << output.err;
        EXPECT_NE(output.err.find(named), std::string::npos) << output.err;
        if (output.exit_status == 1) {
            EXPECT_EQ(std::count(output.err.begin(), output.err.end(), '\n'), 1) << output.err;
        }
        // Two separate checks, so that each reports its own failure.
        EXPECT_FALSE(std::filesystem::remove(folder_.file("no.png")));
        EXPECT_FALSE(std::filesystem::exists(folder_.file("no.png.part")));
    }

    TempFolder folder_;
};

struct Difference {
    double mean = 0.0;
    double share = 0.0; // of bytes that differ by more than 16
};

Difference difference(const std::string& a, const std::string& b)
{
    EXPECT_EQ(a.size(), b.size());
    double sum = 0.0;
    std::size_t above = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const int off =
            std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i]));
        sum += off;
        above += off > 16 ? 1U : 0U;
    }
    const auto count = static_cast<double>(a.size());
    return {.mean = sum / count, .share = static_cast<double>(above) / count};
}

} // namespace

TEST_F(RenderCommand, WritesAPngOfTheRequestedSize)
{
    for (const auto& [width, height] : {std::pair{640, 400}, {1, 1}, {33, 500}}) {
        const std::string png = folder_.file(fmt::format("{}.png", width));
        const ProgramOutput output =
            render({bundledMars(), "-o", png, "--size", fmt::format("{}x{}", width, height)});
        ASSERT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(output.out, "");
        const nlohmann::json info = gdalInfo(png);
        EXPECT_EQ(info["driverShortName"], "PNG");
        EXPECT_EQ(info["size"], (nlohmann::json{width, height}));
        EXPECT_EQ(info["bands"].size(), 3U);
        EXPECT_FALSE(std::filesystem::exists(png + ".part"));
    }
}

TEST_F(RenderCommand, ShowsTheWholeMapByDefault)
{
    const std::string whole = folder_.file("whole.png");
    ASSERT_EQ(render({bundledMountain(), "-o", whole, "--size", "400x300"}).exit_status, 0);
    const std::string bytes = pixels(whole);
    ASSERT_EQ(bytes.size(), 400U * 300U * 3U);
    // Sky along the border on all sides, terrain in the middle: the whole map is in the picture.
    const auto at = [&](std::size_t x, std::size_t y, std::size_t band) {
        return static_cast<int>(static_cast<unsigned char>(bytes[(band * 300 + y) * 400 + x]));
    };
    const auto isSkyLike = [&](std::size_t x,
                               std::size_t y) { // dark and blue, darker than any terrain
        return at(x, y, 0) < 45 && at(x, y, 1) < 50 && at(x, y, 2) < 60 &&
               at(x, y, 2) > at(x, y, 0);
    };
    for (std::size_t x = 0; x < 400; ++x) {
        EXPECT_TRUE(isSkyLike(x, 0) && isSkyLike(x, 299)) << x;
    }
    for (std::size_t y = 0; y < 300; ++y) {
        EXPECT_TRUE(isSkyLike(0, y) && isSkyLike(399, y)) << y;
    }
    EXPECT_FALSE(isSkyLike(200, 150));

    const std::string near = folder_.file("near.png");
    ASSERT_EQ(render({bundledMountain(), "-o", near, "--size", "400x300", "--tilt", "0",
                      "--distance", "3000"})
                  .exit_status,
              0);
    EXPECT_GT(difference(bytes, pixels(near)).mean, 1.0);
}

// A mesa of 11 x 11 samples in a plain appears in the middle of the picture, and nowhere else.
TEST_F(RenderCommand, LooksAtTheGivenPosition)
{
    constexpr std::size_t kColumns = 300;
    constexpr std::size_t kRows = 200;
    std::vector<float> heights(kColumns * kRows);
    for (std::size_t row = 45; row <= 55; ++row) {
        for (std::size_t column = 205; column <= 215; ++column) {
            heights[row * kColumns + column] = 1.0F;
        }
    }
    RasterRecipe recipe = recipeFor(kColumns, heights);
    recipe.transform = {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0};
    recipe.srs = "EPSG:32610";
    const std::string map = writeRaster(folder_, "mountain.tif", "GTiff", recipe);
    const auto middleOf = [&](const std::string& place) {
        const std::string png = folder_.file("place.png");
        const ProgramOutput output =
            render({map, "-o", png, "--size", "101x101", "--tilt", "0", "--distance", "1500",
                    "--exaggeration", "1", fmt::format("--look-at={}", place)});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        const std::string bytes = pixels(png);
        const std::size_t middle = 50 * 101 + 50;
        const auto level = [&](std::size_t at) {
            return static_cast<int>(static_cast<unsigned char>(bytes.at(at)));
        };
        return std::array<int, 3>{level(middle), level(101 * 101 + middle),
                                  level(2 * 101 * 101 + middle)};
    };
    const auto distance = [](const std::array<int, 3>& a, const std::array<int, 3>& b) {
        return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
    };
    // The map coordinates of the middle of pixel (210, 50), and of points 10 pixels away from it.
    const auto place = [](double column, double row) {
        return fmt::format("{},{}", 500000.0 + 30.0 * (column + 0.5),
                           4000000.0 - 30.0 * (row + 0.5));
    };
    const auto mountain = middleOf(place(210, 50));
    for (const auto& [column, row] : {
             std::pair{200.0, 50.0},
             {220.0, 50.0},
             {210.0, 60.0},
         }) {
        EXPECT_GT(distance(middleOf(place(column, row)), mountain), 16) << column << ", " << row;
    }
    EXPECT_LE(distance(middleOf(place(214, 54)), mountain), 2) << "shading apart";
}

TEST_F(RenderCommand, RefusesPositionsOutsideTheMap)
{
    const std::string png = folder_.file("no.png");
    expectRefusal({bundledMars(), "-o", png, "--look-at", "1e9,0"}, "--look-at");
    expectRefusal({bundledMars(), "-o", png, "--look-at", "0,-1e9"}, "--look-at");
    expectRefusal({bundledMars(), "-o", png, "--look-at", "nan,nan"}, "--look-at");
    expectRefusal({bundledMars(), "-o", png, "--look-at", "0"}, "--look-at");
    expectRefusal({bundledMars(), "-o", png, "--look-at", "here,there"}, "--look-at");
}

// The same place in any turn of longitude; the poles, which lie beyond the outermost samples.
TEST_F(RenderCommand, LooksAtAnyLongitudeAndThePolesOfAMapAroundItsBody)
{
    const auto drawn = [&](const std::string& place) {
        const std::string png = folder_.file("place.png");
        const ProgramOutput output =
            render({bundledMars(), "-o", png, "--scene", "body", "--size", "160x100", "--samples",
                    "1", "--distance", "1e6", "--look-at=" + place});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        return output.exit_status == 0 ? pixels(png) : std::string();
    };
    const std::string valles = drawn("-75,-9");
    EXPECT_EQ(valles, drawn("285,-9"));
    EXPECT_EQ(valles, drawn("645,-9"));
    EXPECT_NE(valles, drawn("105,-9"));
    EXPECT_FALSE(drawn("0,89.9").empty());
    EXPECT_FALSE(drawn("0,90").empty());
    EXPECT_FALSE(drawn("-180,-89.99").empty());
    expectRefusal(
        {bundledMars(), "-o", folder_.file("no.png"), "--scene", "body", "--look-at", "0,90.5"},
        "--look-at");
    expectRefusal({bundledMars(), "-o", folder_.file("no.png"), "--look-at=-75,-9"}, "--look-at");
}

TEST_F(RenderCommand, RefusesInvalidSizes)
{
    const std::string png = folder_.file("no.png");
    for (const char* size : {"",
                             "800",
                             "x",
                             "800x",
                             "x600",
                             "800x600x3",
                             "800x600px",
                             "800X600",
                             "0x600",
                             "800x-1",
                             "-800x600",
                             "17000x10",
                             "10x17000",
                             "1.5x2",
                             " 8x8",
                             "8 x 8",
                             "8x 8",
                             "+8x8",
                             "4294967297x4294967297",
                             "99999999999999999999x1",
                             "0x10x10",
                             "nanx1"}) {
        SCOPED_TRACE(size);
        expectRefusal({bundledMars(), "-o", png, fmt::format("--size={}", size)}, "--size");
    }
}

TEST_F(RenderCommand, RefusesNumbersOutOfRange)
{
    const std::string png = folder_.file("no.png");
    for (const auto& [option, values] :
         std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"--tilt", {"-1", "86", "nan", "steep"}},
             {"--distance", {"0", "-5", "nan", "inf"}},
             {"--exaggeration", {"0", "-1", "nan", "inf"}},
             {"--error-px", {"0", "-1", "nan", "inf"}},
             {"--azimuth", {"nan", "inf", "north"}},
             {"--samples", {"0", "17", "2.5"}},
             {"--light", {"1", "nan,45", "10,inf"}},
             {"--shading", {"", "rainbow"}},
             {"--ramp", {"none-such"}}}) {
        for (const std::string& value : values) {
            SCOPED_TRACE(option + " " + value);
            expectRefusal({bundledMars(), "-o", png, fmt::format("{}={}", option, value)}, option);
        }
    }
    expectRefusal({bundledMars(), "-o", png, "--full", "--error-px", "2"}, "--full");
    expectRefusal({bundledMars()}, "--output");
}

TEST_F(RenderCommand, AcceptsTheLimitsOfItsNumbers)
{
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--error-px", "1e-300"},
                                               {"--error-px", "1e300"},
                                               {"--exaggeration", "1e-6"},
                                               {"--exaggeration", "1e6"},
                                               {"--distance", "1e-9"},
                                               {"--distance", "1e30"},
                                               {"--azimuth", "-7200"},
                                               {"--tilt", "85"},
                                               {"--samples", "16"},
                                               {"--light", "-90,-45"}}) {
        SCOPED_TRACE(options[0] + " " + options[1]);
        const std::string png = folder_.file("yes.png");
        std::vector<std::string> arguments{bundledMountain(), "-o", png, "--size", "60x40"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramOutput output = render(arguments);
        EXPECT_EQ(output.exit_status, 0) << output.err;
        EXPECT_EQ(gdalInfo(png)["size"], (nlohmann::json{60, 40}));
        std::filesystem::remove(png);
    }
}

TEST_F(RenderCommand, NamesTheFileThatCannotBeWritten)
{
    const std::string nowhere = folder_.file("missing/picture.png");
    expectRefusal({bundledMountain(), "--size", "40x30", "-o", nowhere}, nowhere);
    // A folder of that name is in the way. It must stay.
    const std::string taken = folder_.file("taken");
    std::filesystem::create_directory(taken);
    expectRefusal({bundledMountain(), "--size", "40x30", "-o", taken}, taken);
    EXPECT_TRUE(std::filesystem::is_directory(taken));
    EXPECT_FALSE(std::filesystem::exists(taken + ".part"));
}

TEST_F(RenderCommand, KeepsTheExistingPictureIfItFails)
{
    const std::string png = folder_.write("no-map.png", "not a picture");
    const ProgramOutput output = render({folder_.file("missing.tif"), "-o", png});
    EXPECT_EQ(output.exit_status, 1);
    EXPECT_EQ(readFile(png), "not a picture");
}

TEST_F(RenderCommand, DrawsTheSameWithEverySampleAndWithinAPixel)
{
    const auto draw = [&](const std::string& name, const std::vector<std::string>& options) {
        const std::string png = folder_.file(name);
        std::vector<std::string> arguments{bundledMountain(), "-o", png, "--size", "500x350"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(render(arguments).exit_status, 0);
        return pixels(png);
    };
    const std::string full = draw("full.png", {"--full"});
    const Difference fine = difference(full, draw("fine.png", {"--error-px", "1"}));
    const Difference coarse = difference(full, draw("coarse.png", {"--error-px", "30"}));
    EXPECT_LT(fine.mean, 1.0);
    EXPECT_LT(fine.share, 0.01);
    EXPECT_GT(coarse.mean, fine.mean) << "the option must have an effect";
    // The same command gives the same picture.
    EXPECT_EQ(full, draw("again.png", {"--full"}));
}

// Several samples fall into a pixel: a picture of one of them in each would be 4 levels off.
TEST_F(RenderCommand, FullHasTheMeanOfThePixel)
{
    constexpr std::size_t kWidth = 500;
    constexpr std::size_t kHeight = 400;
    constexpr std::size_t kTimes = 4;
    const auto draw = [&](const std::string& name, std::size_t times,
                          const std::vector<std::string>& options) {
        const std::string png = folder_.file(name);
        std::vector<std::string> arguments{bundledMars(),
                                           "-o",
                                           png,
                                           "--full",
                                           "--scene",
                                           "body",
                                           "--exaggeration",
                                           "1",
                                           "--size",
                                           fmt::format("{}x{}", times * kWidth, times * kHeight)};
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(render(arguments).exit_status, 0);
        return pixels(png);
    };
    const std::string full = draw("full.png", 1, {});
    const std::string large = draw("large.png", kTimes, {"--samples", "4"});
    ASSERT_EQ(full.size(), 3 * kWidth * kHeight);
    ASSERT_EQ(large.size(), kTimes * kTimes * full.size());
    const auto level = [](char byte) {
        return static_cast<double>(static_cast<unsigned char>(byte));
    };
    std::size_t far = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        const std::size_t row = i / kWidth; // of all bands
        double sum = 0.0;
        for (std::size_t j = 0; j < kTimes * kTimes; ++j) {
            sum += level(large[(kTimes * row + j / kTimes) * kTimes * kWidth +
                               kTimes * (i % kWidth) + j % kTimes]);
        }
        far += std::abs(level(full[i]) - sum / (kTimes * kTimes)) > 2.5 ? 1U : 0U;
    }
    EXPECT_LT(static_cast<double>(far), 0.01 * static_cast<double>(full.size()));
}

TEST_F(RenderCommand, DrawsWithEveryShadingAndRamp)
{
    std::vector<std::string> seen;
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{},
                                               {"--shading", "hillshade"},
                                               {"--shading", "slope"},
                                               {"--contours"},
                                               {"--light", "90,20"},
                                               {"--exaggeration", "4"},
                                               {"--azimuth", "90"}}) {
        const std::string png = folder_.file("one.png");
        std::vector<std::string> arguments{bundledMountain(), "-o", png, "--size", "160x120"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ASSERT_EQ(render(arguments).exit_status, 0);
        seen.push_back(pixels(png));
        for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
            EXPECT_NE(seen[i], seen.back()) << i << " and " << seen.size() - 1;
        }
    }
}

TEST_F(RenderCommand, TheSunLightsTheSideOfTheBodyThatItStandsOver)
{
    const auto brightness = [&](const std::string& sun_at) {
        const std::string png = folder_.file("sun.png");
        EXPECT_EQ(render({bundledMars(), "-o", png, "--scene", "body", "--size", "161x121",
                          "--shading", "hillshade", "--look-at", "-60,20", "--tilt", "0",
                          "--exaggeration", "1", "--sun-at=" + sun_at})
                      .exit_status,
                  0);
        const std::string all = pixels(png);
        return static_cast<int>(static_cast<unsigned char>(all[60 * 161 + 80]));
    };
    const int noon = brightness("-60,20");
    EXPECT_NEAR(noon, 255 * 0.92, 12);
    EXPECT_NEAR(brightness("300,20"), noon, 1) << "another turn";
    EXPECT_NEAR(brightness("120,-20"), 255 * 0.92 * 0.08, 3) << "midnight";
    EXPECT_LT(brightness("-60,80"), 0.75 * noon);
}

// One above the other, of one color: light shows the step of the edge as a line, and a feather as a
// slope that is as wide.
TEST_F(RenderCommand, DrawsMapsOnTopOfEachOtherWithBlendedEdges)
{
    const std::string lower = writeLevelMars(folder_, "lower", 80, {98.0, 4.0, 0.05}, 0.0F);
    const std::string upper = writeLevelMars(folder_, "upper", 100, {99.5, 2.5, 0.01}, 1500.0F);
    const auto shaded = [&](const std::string& cells) {
        const std::string png = folder_.file("pile" + cells + ".png");
        const ProgramOutput output =
            render({upper,       "-o",     png,          "--scene",   "body",
                    "--below",   lower,    "--feather",  cells,       "--shading",
                    "hillshade", "--size", "300x300",    "--look-at", "100,2",
                    "--tilt",    "0",      "--distance", "120000",    "--exaggeration",
                    "1"});
        EXPECT_EQ(output.exit_status, 0) << output.err;
        // Across the middle: pixels that are not as bright as level ground.
        const std::string all = pixels(png);
        const auto at = [&](std::size_t column) {
            return static_cast<int>(static_cast<unsigned char>(all[150 * 300 + column]));
        };
        std::size_t count = 0;
        for (std::size_t column = 0; column < 300; ++column) {
            count += std::abs(at(column) - at(150)) > 8 ? 1U : 0U;
        }
        return count;
    };
    const std::size_t plain = shaded("0");
    const std::size_t blended = shaded("30");
    EXPECT_LT(plain, 25U);
    EXPECT_GT(blended, 2 * plain + 30U);
    expectRefusal({upper, "-o", folder_.file("no.png"), "--scene", "body", "--below",
                   folder_.file("missing.tif")},
                  "missing.tif");
}

TEST_F(RenderCommand, RefusesToDrawADamagedPreparedMap)
{
    namespace fs = std::filesystem;
    const std::string whole = folder_.file("whole.tif");
    ASSERT_EQ(runCli({"prepare", bundledMars(), "-o", whole}).exit_status, 0);
    const auto drawn = [&](const std::string& map, const std::string& picture) {
        return renderHolding("0", {map, "-o", picture, "--size", "240x160"});
    };
    ASSERT_EQ(drawn(whole, folder_.file("whole.png")).exit_status, 0);
    const std::string truth = readFile(folder_.file("whole.png"));
    const std::string path = folder_.file("damaged.tif");
    Random random;
    int refusals = 0;
    for (int i = 0; i < 8; ++i) {
        fs::copy_file(whole, path, fs::copy_options::overwrite_existing);
        fs::copy_file(whole + ".marsview", path + ".marsview",
                      fs::copy_options::overwrite_existing);
        fs::last_write_time(path, fs::last_write_time(whole));
        flipBits(path, 40, random);
        const ProgramOutput output = drawn(path, folder_.file("damaged.png"));
        if (output.exit_status == 0) {
            EXPECT_TRUE(readFile(folder_.file("damaged.png")) == truth ||
                        output.err.find("is not used") != std::string::npos);
        } else {
            ++refusals;
            EXPECT_NE(output.err.find(path), std::string::npos) << output.err;
        }
    }
    EXPECT_GT(refusals, 2);
}

// Tiles are drawn separately; most of them have no voids.
TEST_F(RenderCommand, DrawsAPreparedMapWithAHoleCompletely)
{
    constexpr std::size_t kColumns = 1500;
    constexpr std::size_t kRows = 1200;
    constexpr std::int16_t kVoid = -32768;
    std::vector<std::int16_t> heights(kColumns * kRows);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::size_t column = i % kColumns;
        const std::size_t row = i / kColumns;
        const bool is_hole = column > 100 && column < 160 && row > 100 && row < 160;
        const double waves = 300.0 * std::sin(0.01 * static_cast<double>(column + 2 * row));
        heights[i] = is_hole ? kVoid : static_cast<std::int16_t>(waves);
    }
    RasterRecipe recipe = recipeFor(kColumns, heights);
    recipe.band_xml = "<NoDataValue>-32768</NoDataValue>";
    recipe.transform = {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0};
    recipe.srs = "EPSG:32610";
    const std::string map = writeRaster(folder_, "hole.tif", "GTiff", recipe);
    const std::string prepared = folder_.file("prepared.tif");
    ASSERT_EQ(runCli({"prepare", map, "-o", prepared}).exit_status, 0);
    const std::string middle = fmt::format("{},{}", 500000 + 30 * 1100, 4000000 - 30 * 800);
    for (const std::vector<std::string>& place :
         {std::vector<std::string>{}, {"--look-at", middle, "--distance", "9000"}}) {
        const auto drawn = [&](const std::string& path, const std::string& held_mb) {
            const std::string png = folder_.file("hole.png");
            std::vector<std::string> options{path, "-o", png, "--size", "200x150"};
            options.insert(options.end(), place.begin(), place.end());
            const ProgramOutput output = renderHolding(held_mb, options);
            EXPECT_EQ(output.exit_status, 0) << output.err;
            return pixels(png);
        };
        const std::string truth = drawn(map, "500");
        const std::string picture = drawn(prepared, "0");
        ASSERT_EQ(picture.size(), truth.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const int levels = std::abs(int{static_cast<unsigned char>(picture[i])} -
                                        int{static_cast<unsigned char>(truth[i])});
            different += levels > 8 ? 1U : 0U;
        }
        EXPECT_LT(different, truth.size() / 200);
    }
}

} // namespace marsview::test
