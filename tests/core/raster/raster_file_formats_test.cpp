// The formats of elevation data, written here from known samples.
#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/make_raster.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace marsview {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using test::RasterRecipe;
using test::recipeFor;
using test::TempFolder;
using test::writeRaster;
using test::writeVrt;

constexpr std::size_t kColumns = 70; // more than a word of the void mask
constexpr std::size_t kRows = 40;

std::vector<std::int16_t> hills()
{
    test::Random random;
    std::vector<std::int16_t> samples(kColumns * kRows);
    for (std::int16_t& sample : samples) {
        sample = static_cast<std::int16_t>(random.uniform(-9000.0, 9000.0));
    }
    return samples;
}

LoadedSamples load(const std::string& path)
{
    auto file = RasterFile::open(path);
    if (!file) {
        throw std::runtime_error(file.error().message);
    }
    JobMonitor monitor;
    auto loaded = file->readAll(monitor, {file->info().nodata}, std::size_t{1} << 30);
    if (!loaded) {
        throw std::runtime_error(loaded.error().message);
    }
    return std::move(*loaded);
}

template <typename T>
void expectSamples(const LoadedSamples& loaded, const std::vector<T>& expected)
{
    ASSERT_EQ(loaded.grid.columns() * loaded.grid.rows(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const std::size_t c = i % loaded.grid.columns();
        const std::size_t r = i / loaded.grid.columns();
        ASSERT_FALSE(loaded.grid.isVoid(c, r)) << c << " " << r;
        ASSERT_EQ(loaded.grid.raw(c, r), static_cast<double>(expected[i])) << c << " " << r;
    }
}

struct Format {
    const char* driver;
    const char* file;
    std::vector<std::string> options;
};

class RasterFormat : public testing::TestWithParam<Format> {};

void PrintTo(const Format& format, std::ostream* stream)
{
    *stream << format.driver;
}

TEST_P(RasterFormat, KeepsSamplesPlacementAndNegativeHeights)
{
    const TempFolder folder;
    const Format& format = GetParam();
    RasterRecipe recipe = recipeFor(kColumns, hills());
    recipe.transform = {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0};
    recipe.srs = "EPSG:32610";
    const std::string path =
        writeRaster(folder, format.file, format.driver, recipe, format.options);
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->info().columns, kColumns);
    EXPECT_EQ(file->info().rows, kRows);
    ASSERT_TRUE(file->info().transform);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(file->info().transform->terms()[i], (*recipe.transform)[i], 1e-6) << i;
    }
    ASSERT_TRUE(file->info().crs);
    EXPECT_EQ(file->info().crs->kind(), CrsKind::Projected);
    const auto place = file->info().crs->toGeographic({500000.0, 4000000.0});
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->longitude.degrees(), -123.0, 1e-6);
    expectSamples(load(path), hills());
}

INSTANTIATE_TEST_SUITE_P(Written,
                         RasterFormat,
                         testing::Values(Format{"GTiff", "strips.tif", {}},
                                         Format{"GTiff",
                                                "tiles.tif",
                                                {"-co", "TILED=YES", "-co", "BLOCKXSIZE=32", "-co",
                                                 "BLOCKYSIZE=16", "-co", "COMPRESS=DEFLATE", "-co",
                                                 "PREDICTOR=2"}},
                                         Format{"COG", "cloud.tif", {}},
                                         Format{"ENVI", "map.img", {}},
                                         Format{"EHdr", "map.bil", {}},
                                         Format{"AAIGrid", "map.asc", {}},
                                         Format{"netCDF", "map.nc", {}},
                                         Format{"HFA", "erdas.img", {}},
                                         Format{"SAGA", "map.sdat", {}},
                                         Format{"VRT", "virtual.vrt", {}}),
                         [](const auto& parameter) {
                             std::string name =
                                 std::string(parameter.param.driver) + "_" + parameter.param.file;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

TEST(RasterFile, PixelIsPointIsNotShiftedTwice)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(kColumns, hills());
    recipe.transform = {10.0, 0.5, 0.0, 50.0, 0.0, -0.5};
    recipe.srs = "EPSG:4326";
    const std::string path =
        writeRaster(folder, "point.tif", "GTiff", recipe, {"-mo", "AREA_OR_POINT=Point"});
    ASSERT_NE(test::runTool({"gdalinfo", path}).find("AREA_OR_POINT=Point"), std::string::npos);
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->info().transform->terms(), *recipe.transform);
    EXPECT_EQ(file->info().transform->toMap({0.0, 0.0}), (MapPoint{10.25, 49.75}));
}

TEST(RasterFile, AnArchiveWithOneRasterOpens)
{
    const TempFolder folder;
    const std::string tif =
        writeRaster(folder, "inside.tif", "GTiff", recipeFor(kColumns, hills()));
    // Python is available wherever the tools are; zip is not.
    const std::string archive = folder.file("map.zip");
    const auto packed = test::runProgram({"python3", "-m", "zipfile", "-c", archive, tif});
    if (packed.exit_status != 0) {
        GTEST_SKIP() << "python3 is needed to make an archive";
    }
    const auto file = RasterFile::open(archive);
    ASSERT_TRUE(file) << file.error().message;
    expectSamples(load(archive), hills());
}

TEST(RasterFile, AnArchiveWithoutRastersIsRefused)
{
    const TempFolder folder;
    const std::string text = folder.write("readme.txt", "nothing here");
    const std::string archive = folder.file("map.zip");
    const auto packed = test::runProgram({"python3", "-m", "zipfile", "-c", archive, text});
    if (packed.exit_status != 0) {
        GTEST_SKIP() << "python3 is needed to make an archive";
    }
    const auto file = RasterFile::open(archive);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().message,
              archive +
                  ": holds no raster that GDAL can read, only readme.txt; a map among them is "
                  "damaged or in another format");
}

// The file in it, not the archive.
TEST(RasterFile, ADamagedRasterInAnArchiveIsRefusedWithWhatIsWrong)
{
    const TempFolder folder;
    const std::string tile = folder.write("N44W072.hgt", std::string(1000, 'x'));
    const std::string tif =
        folder.write("map.tif", std::string("II*\0", 4) + std::string(500, '\xff'));
    const auto refusal_of = [&](const std::string& file) {
        const std::string archive = folder.file("packed.zip");
        const auto packed = test::runProgram({"python3", "-m", "zipfile", "-c", archive, file});
        EXPECT_EQ(packed.exit_status, 0) << "python3 is needed to make an archive";
        const auto opened = RasterFile::open(archive);
        return opened ? std::string() : opened.error().message;
    };
    EXPECT_THAT(refusal_of(tile), HasSubstr("packed.zip: N44W072.hgt in it has 1000 bytes, but"));
    EXPECT_THAT(refusal_of(tif), HasSubstr("packed.zip: map.tif in it cannot be opened ("));
    EXPECT_THAT(refusal_of(tif), Not(HasSubstr("unpacked")));
    // Bytes of the packed data.
    refusal_of(writeRaster(folder, "inside.tif", "GTiff", recipeFor(kColumns, hills())));
    std::string bytes = test::readFile(folder.file("packed.zip"));
    std::fill_n(bytes.begin() + 45, 200, '\xff');
    const auto spoiled = RasterFile::open(folder.write("spoiled.zip", bytes));
    ASSERT_FALSE(spoiled);
    EXPECT_THAT(spoiled.error().message,
                HasSubstr("inside.tif in it cannot be unpacked: the archive is damaged"));
    const auto cut = RasterFile::open(folder.write("cut.zip", bytes.substr(0, 100)));
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("cut.zip: is an archive without files"));
}

// GTOPO30's headers do not state whether samples are signed. They are: the Dead Sea is below zero.
TEST(RasterFile, ReadsNegativeHeightsOfGtopo30WithoutPixelType)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples{-9999, -407, 12, 5000, -1, 0};
    std::string bytes;
    for (const std::int16_t sample : samples) {
        const auto bits = static_cast<std::uint16_t>(sample);
        bytes += static_cast<char>(bits >> 8);
        bytes += static_cast<char>(bits & 0xFF);
    }
    const std::string dem = folder.write("E020N40.DEM", bytes);
    const std::string header = folder.write(
        "E020N40.HDR",
        "BYTEORDER      M\nLAYOUT       BIL\nNROWS         2\nNCOLS         3\nNBANDS        1\n"
        "NBITS         16\nBANDROWBYTES         6\nTOTALROWBYTES        6\nBANDGAPBYTES         0\n"
        "NODATA        -9999\nULXMAP        20.00416666666667\nULYMAP        39.99583333333333\n"
        "XDIM          0.00833333333333\nYDIM          0.00833333333333\n");
    for (const std::string& path : {dem, header}) {
        const LoadedSamples loaded = load(path);
        EXPECT_EQ(loaded.grid.type(), SampleType::Int16);
        EXPECT_TRUE(loaded.grid.isVoid(0, 0));
        EXPECT_EQ(loaded.grid.raw(1, 0), -407.0);
        EXPECT_EQ(loaded.grid.raw(1, 1), -1.0);
        EXPECT_EQ(loaded.statistics.raw_minimum, -407.0);
        EXPECT_EQ(loaded.statistics.raw_maximum, 5000.0);
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file && file->info().transform);
        const MapPoint center = file->info().transform->toMap({0.0, 0.0});
        EXPECT_NEAR(center.x, 20.00416666666667, 1e-12); // ULXMAP is the center of a pixel
        EXPECT_NEAR(center.y, 39.99583333333333, 1e-12);
    }
}

TEST(RasterFile, Pds4KeepsItsPlacementAndBody)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor(kColumns, hills());
    recipe.transform = {100000.0, 1000.0, 0.0, 200000.0, 0.0, -1000.0};
    recipe.srs = "+proj=eqc +lat_ts=0 +lat_0=0 +lon_0=180 +R=3396190 +units=m +no_defs";
    const std::string path =
        writeRaster(folder, "map.xml", "PDS4", recipe, {"-co", "VAR_TARGET=Mars"});
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->info().transform && file->info().crs);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(file->info().transform->terms()[i], (*recipe.transform)[i], 1e-3) << i;
    }
    ASSERT_NE(file->info().body, nullptr);
    EXPECT_EQ(file->info().body->name, "Mars");
    expectSamples(load(path), hills());
    expectSamples(load(folder.file("map.img")), hills());
}

TEST(RasterFile, SouthUpAndRotatedGridsKeepTheirTransform)
{
    const std::array<double, 6> transforms[] = {
        {500000.0, 30.0, 0.0, 4000000.0, 0.0, 30.0},
        {500000.0, 25.98, 15.0, 4000000.0, 15.0, -25.98},
        {500000.0, 0.0, 30.0, 4000000.0, 30.0, 0.0},
        {500000.0, -30.0, 0.0, 4000000.0, 0.0, -30.0},
    };
    for (const auto& transform : transforms) {
        const TempFolder folder;
        RasterRecipe recipe = recipeFor(kColumns, hills());
        recipe.transform = transform;
        recipe.srs = "EPSG:32610";
        const std::string path = writeRaster(folder, "map.tif", "GTiff", recipe);
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file && file->info().transform);
        EXPECT_EQ(file->info().transform->terms(), transform);
        expectSamples(load(path), hills());
    }
}

template <typename T>
void expectTypeSurvives(SampleType type, const std::vector<T>& samples)
{
    const TempFolder folder;
    std::vector<std::string> options;
    if constexpr (std::is_same_v<T, std::int8_t>) {
        options = {"-co", "PIXELTYPE=SIGNEDBYTE"};
    }
    for (const std::string& path :
         {writeVrt(folder, "plain", recipeFor(3, samples)),
          writeRaster(folder, "map.tif", "GTiff", recipeFor(3, samples), options)}) {
        const LoadedSamples loaded = load(path);
        EXPECT_EQ(loaded.grid.type(), type) << path;
        expectSamples(loaded, samples);
    }
}

TEST(RasterFile, EverySampleTypeKeepsItsExtremes)
{
    expectTypeSurvives<std::uint8_t>(SampleType::UInt8, {0, 255, 1, 2, 3, 128});
    expectTypeSurvives<std::int8_t>(SampleType::Int8, {-128, 127, 1, 0, -1, 5});
    expectTypeSurvives<std::uint16_t>(SampleType::UInt16, {0, 65535, 1, 2, 3, 40000});
    expectTypeSurvives<std::int16_t>(SampleType::Int16, {-32768, 32767, 0, 1, -1, 5});
    expectTypeSurvives<std::uint32_t>(SampleType::UInt32, {0, 4294967295U, 1, 2, 3, 3000000000U});
    expectTypeSurvives<std::int32_t>(
        SampleType::Int32, {std::numeric_limits<std::int32_t>::min(), 2147483647, 0, 1, -1, 5});
    expectTypeSurvives<std::uint64_t>(SampleType::UInt64,
                                      {0, std::uint64_t{1} << 53, 1, 2, 3, 3000000000U});
    expectTypeSurvives<std::int64_t>(SampleType::Int64,
                                     {-(std::int64_t{1} << 53), std::int64_t{1} << 53, 0, 1, 2, 3});
    expectTypeSurvives<float>(SampleType::Float32, {-3.4e38F, 3.4e38F, 0.1F, -0.0F, 1e-38F, 7.0F});
    expectTypeSurvives<double>(SampleType::Float64, {-1.7e308, 1.7e308, 0.1, -0.0, 1e-300, 7.0});
}

TEST(RasterFile, NodataOf64BitIntegersIsKept)
{
    const TempFolder folder;
    RasterRecipe recipe =
        recipeFor<std::int64_t>(3, {std::numeric_limits<std::int64_t>::min(), 5, 7, 8, 9, 10});
    recipe.band_xml = "<NoDataValue>-9223372036854775808</NoDataValue>";
    const LoadedSamples loaded = load(writeVrt(folder, "map", recipe));
    EXPECT_TRUE(loaded.grid.isVoid(0, 0));
    EXPECT_EQ(loaded.statistics.void_count, 1U);
    EXPECT_EQ(loaded.statistics.raw_minimum, 5.0);
}

// Read block by block, its 10 billion samples would take minutes.
TEST(RasterFile, CountsOmittedBlocksWithoutReadingThem)
{
    const TempFolder folder;
    for (const bool has_nodata : {false, true}) {
        SCOPED_TRACE(has_nodata);
        const std::string path = folder.file("sparse.tif");
        std::vector<std::string> command{"gdal_create", "-q",        "-of",    "GTiff",
                                         "-outsize",    "100000",    "100000", "-ot",
                                         "Int16",       "-a_ullr",   "0",      "100000",
                                         "100000",      "0",         "-co",    "SPARSE_OK=TRUE",
                                         "-co",         "TILED=YES", "-co",    "BIGTIFF=YES"};
        if (has_nodata) {
            command.insert(command.end(), {"-a_nodata", "-5"});
        }
        command.push_back(path);
        test::runTool(command);
        RasterRecipe recipe = recipeFor<std::int16_t>(3, {7, 8, 9, 10, 11, 12});
        recipe.transform = {70000.0, 1.0, 0.0, 30000.0, 0.0, -1.0};
        test::runTool({"gdalwarp", "-q", writeVrt(folder, "patch", recipe), path});
        auto file = RasterFile::open(path);
        ASSERT_TRUE(file) << file.error().message;
        JobMonitor monitor;
        const auto statistics = file->scan(monitor, {file->info().nodata});
        ASSERT_TRUE(statistics) << statistics.error().message;
        EXPECT_EQ(statistics->sample_count, 10'000'000'000U);
        EXPECT_EQ(statistics->void_count, has_nodata ? 9'999'999'994U : 0U);
        EXPECT_EQ(statistics->raw_minimum, has_nodata ? 7.0 : 0.0);
        EXPECT_EQ(statistics->raw_maximum, 12.0);
    }
}

// Without bytes for its strips it is shorter than its samples, and whole.
TEST(RasterFile, ASparseTiffIsNotTakenForTruncated)
{
    const TempFolder folder;
    const std::string path = folder.file("sparse.tif");
    test::runTool({"gdal_create", "-q", "-of", "GTiff", "-outsize", "3000", "2000", "-ot", "Int16",
                   "-co", "SPARSE_OK=TRUE", path});
    auto file = RasterFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto window = file->readWindow({10, 1990, 5, 10}, {});
    ASSERT_TRUE(window) << window.error().message;
    EXPECT_EQ(window->statistics.raw_maximum, 0.0);
}

TEST(RasterFile, NanAndInfinityAreAlwaysVoid)
{
    const TempFolder folder;
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const LoadedSamples loaded = load(writeRaster(
        folder, "map.tif", "GTiff", recipeFor<float>(3, {kNanFloat, kInf, -kInf, 1, 2, 3})));
    EXPECT_EQ(loaded.statistics.void_count, 3U);
    EXPECT_EQ(loaded.statistics.raw_minimum, 1.0);
    EXPECT_EQ(loaded.statistics.raw_maximum, 3.0);
}

TEST(RasterFile, HonorsMasksInsideAndNextToTheRaster)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6});
    folder.write("mask.raw", std::string("\xFF\x00\xFF\xFF\xFF\x00", 6));
    recipe.extra_xml =
        "<MaskBand><VRTRasterBand dataType=\"Byte\" subClass=\"VRTRawRasterBand\">"
        "<SourceFilename relativeToVRT=\"1\">mask.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>1</PixelOffset><LineOffset>3</LineOffset></VRTRasterBand></MaskBand>";
    const std::string paths[] = {
        writeVrt(folder, "virtual", recipe),
        // A mask in a separate file, and one inside the file.
        writeRaster(folder, "separate.tif", "GTiff", recipe),
        writeRaster(folder, "within.tif", "GTiff", recipe,
                    {"--config", "GDAL_TIFF_INTERNAL_MASK", "YES"}),
    };
    EXPECT_TRUE(std::filesystem::exists(folder.file("separate.tif.msk")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("within.tif.msk")));
    for (const std::string& path : paths) {
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file);
        EXPECT_TRUE(file->info().has_mask_band) << path;
        const LoadedSamples loaded = load(path);
        EXPECT_EQ(loaded.statistics.void_count, 2U) << path;
        EXPECT_TRUE(loaded.grid.isVoid(1, 0)) << path;
        EXPECT_TRUE(loaded.grid.isVoid(2, 1)) << path;
        EXPECT_EQ(loaded.statistics.raw_minimum, 1.0) << path;
        EXPECT_EQ(loaded.statistics.raw_maximum, 5.0) << path;
    }
}

TEST(RasterFile, TreatsAnAlphaBandAsAMask)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6});
    folder.write("alpha.raw", std::string("\xFF\x00\xFF\xFF\xFF\x00", 6));
    recipe.extra_xml =
        "<VRTRasterBand dataType=\"Byte\" band=\"2\" subClass=\"VRTRawRasterBand\">"
        "<ColorInterp>Alpha</ColorInterp>"
        "<SourceFilename relativeToVRT=\"1\">alpha.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>1</PixelOffset><LineOffset>3</LineOffset></VRTRasterBand>";
    const LoadedSamples loaded = load(writeVrt(folder, "map", recipe));
    EXPECT_EQ(loaded.statistics.void_count, 2U);
    EXPECT_TRUE(loaded.grid.isVoid(1, 0));
    EXPECT_TRUE(loaded.grid.isVoid(2, 1));
}

TEST(RasterFile, NodataAndMaskBothMarkVoids)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(3, {-9999, 2, 3, 4, 5, 6});
    folder.write("mask.raw", std::string("\xFF\x00\xFF\xFF\xFF\xFF", 6));
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue>";
    recipe.extra_xml =
        "<MaskBand><VRTRasterBand dataType=\"Byte\" subClass=\"VRTRawRasterBand\">"
        "<SourceFilename relativeToVRT=\"1\">mask.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>1</PixelOffset><LineOffset>3</LineOffset></VRTRasterBand></MaskBand>";
    const LoadedSamples loaded = load(writeVrt(folder, "map", recipe));
    EXPECT_TRUE(loaded.grid.isVoid(0, 0));
    EXPECT_TRUE(loaded.grid.isVoid(1, 0));
    EXPECT_EQ(loaded.statistics.void_count, 2U);
}

TEST(RasterFile, AppliesScaleOffsetAndUnit)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(2, {100, 200, 300, 400});
    recipe.band_xml = "<Offset>-50</Offset><Scale>0.25</Scale><UnitType>ft</UnitType>";
    const auto file = RasterFile::open(writeRaster(folder, "map.tif", "GTiff", recipe));
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->info().scale, 0.25);
    EXPECT_EQ(file->info().offset, -50.0);
    EXPECT_EQ(file->info().unit.name, "ft");
    EXPECT_TRUE(file->info().is_unit_declared);
    EXPECT_NEAR(file->info().elevationScale().height(100.0), (25.0 - 50.0) * 0.3048, 1e-12);
}

TEST(RasterFile, AssumesMetersForAnUnknownUnitWithANotice)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(2, {100, 200, 300, 400});
    recipe.band_xml = "<UnitType>furlong</UnitType>";
    const auto file = RasterFile::open(writeVrt(folder, "map", recipe));
    ASSERT_TRUE(file);
    EXPECT_FALSE(file->info().is_unit_declared);
    EXPECT_EQ(file->info().unit.meters, 1.0);
    EXPECT_TRUE(
        std::any_of(file->info().notices.begin(), file->info().notices.end(),
                    [](const std::string& n) { return n.find("furlong") != std::string::npos; }));
}

TEST(RasterFile, DistinguishesRadiiWithoutAnOffsetFromHeights)
{
    const TempFolder folder;
    test::Random random;
    std::vector<float> radii;
    std::vector<float> heights;
    for (int i = 0; i < 36 * 18; ++i) {
        const double height = random.uniform(-8000.0, 21000.0);
        heights.push_back(static_cast<float>(height));
        radii.push_back(static_cast<float>(3396190.0 + height));
    }
    for (const bool is_radius : {true, false}) {
        RasterRecipe recipe = recipeFor(36, is_radius ? radii : heights);
        recipe.transform = {0.0, 10.0, 0.0, 90.0, 0.0, -10.0};
        recipe.srs = "IAU_2015:49900";
        const auto file = RasterFile::open(writeRaster(folder, "map.tif", "GTiff", recipe));
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->info().reference_radius_m.has_value(), is_radius);
        if (is_radius) {
            const double height =
                file->info().elevationScale().height(static_cast<double>(radii[5]));
            EXPECT_NEAR(height, static_cast<double>(radii[5]) - 3396190.0, 1e-9);
            EXPECT_NEAR(height, static_cast<double>(heights[5]), 0.25); // the digits of a float
        }
    }
}

TEST(RasterFile, BandsAreCountedFromOne)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(2, {1, 2, 3, 4});
    folder.write("second.raw", std::string("\x05\x00\x06\x00\x07\x00\x08\x00", 8));
    recipe.extra_xml =
        "<VRTRasterBand dataType=\"Int16\" band=\"2\" subClass=\"VRTRawRasterBand\">"
        "<SourceFilename "
        "relativeToVRT=\"1\">second.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>2</PixelOffset><LineOffset>4</LineOffset></VRTRasterBand>";
    const std::string path = writeVrt(folder, "map", recipe);
    auto second = RasterFile::open(path, 2);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_EQ(second->readWindow({0, 0, 2, 2}, {})->grid.raw(1, 1), 8.0);
    for (const int band : {0, -1, 3, 1000}) {
        const auto file = RasterFile::open(path, band);
        ASSERT_FALSE(file) << band;
        EXPECT_EQ(file.error().code, ErrorCode::OutOfRange);
    }
}

TEST(RasterFile, WindowsMatchTheirPartOfTheWhole)
{
    const TempFolder folder;
    const std::vector<std::int16_t> samples = hills();
    auto file = RasterFile::open(
        writeRaster(folder, "map.tif", "GTiff", recipeFor(kColumns, samples),
                    {"-co", "TILED=YES", "-co", "BLOCKXSIZE=16", "-co", "BLOCKYSIZE=16"}));
    ASSERT_TRUE(file);
    test::Random random;
    for (int i = 0; i < 300; ++i) {
        GridWindow window;
        window.column = random.below(kColumns);
        window.row = random.below(kRows);
        window.columns = 1 + random.below(kColumns - window.column);
        window.rows = 1 + random.below(kRows - window.row);
        const auto loaded = file->readWindow(window, {});
        ASSERT_TRUE(loaded);
        for (std::size_t r = 0; r < window.rows; ++r) {
            for (std::size_t c = 0; c < window.columns; ++c) {
                ASSERT_EQ(loaded->grid.raw(c, r),
                          samples[(window.row + r) * kColumns + window.column + c]);
            }
        }
    }
}

TEST(RasterFile, LeavesTheUsersFolderUnchanged)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "map.tif", "GTiff", recipeFor(kColumns, hills()));
    const std::string before = test::readFile(path);
    const auto count = [&] {
        return std::distance(std::filesystem::directory_iterator(folder.path()),
                             std::filesystem::directory_iterator());
    };
    const auto files = count();
    {
        const LoadedSamples loaded = load(path);
        auto file = RasterFile::open(path);
        JobMonitor monitor;
        ASSERT_TRUE(file->scan(monitor, {}));
    }
    EXPECT_EQ(count(), files);
    EXPECT_EQ(test::readFile(path), before);
}

} // namespace
} // namespace marsview
