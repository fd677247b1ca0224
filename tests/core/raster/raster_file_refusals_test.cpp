// Files that are not elevation maps, or not of the type that they claim. Each is rejected with one
// sentence that names the file, without a crash and without allocating memory for missing data.
#include "core/raster/raster_file.h"
#include "core/session/map.h"
#include "tests/support/make_raster.h"
#include "tests/support/nan.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

using test::RasterRecipe;
using test::recipeFor;
using test::TempFolder;
using test::writeRaster;
using test::writeVrt;

constexpr std::size_t kBudget = std::size_t{1} << 30;

Result<std::shared_ptr<const Map>> load(const std::string& path,
                                        std::size_t memory_bytes_max = kBudget)
{
    JobMonitor monitor;
    return readMap(RasterSpec{path, 1, {}}, monitor, memory_bytes_max);
}

long peakMemoryKb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

void expectOneSentence(const Error& error, const std::string& path)
{
    const std::string& message = error.message;
    EXPECT_TRUE(message.starts_with(path)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    ASSERT_GT(message.size(), path.size() + 3) << message;
    EXPECT_NE(message.back(), '.') << message;
    EXPECT_NE(message.back(), ' ') << message;
}

void expectRefused(const std::string& path, ErrorCode code)
{
    SCOPED_TRACE(path);
    const long before_kb = peakMemoryKb();
    const auto dataset = load(path);
    ASSERT_FALSE(dataset);
    EXPECT_EQ(dataset.error().code, code) << dataset.error().message;
    expectOneSentence(dataset.error(), path);
    EXPECT_LT(peakMemoryKb() - before_kb, 200 * 1024);
}

RasterRecipe smallMap()
{
    return recipeFor<std::int16_t>(3, {1, 2, 3, 4, 5, 6});
}

bool opensAsMap(const std::string& path)
{
    return load(path).has_value();
}

TEST(Refusal, AMissingFile)
{
    const TempFolder folder;
    expectRefused(folder.file("missing.tif"), ErrorCode::NotFound);
    expectRefused(folder.file("no/such/folder.tif"), ErrorCode::NotFound);
}

TEST(Refusal, AnUnreadableFile)
{
    if (geteuid() == 0) {
        GTEST_SKIP() << "root can read every file";
    }
    const TempFolder folder;
    const std::string path = writeRaster(folder, "map.tif", "GTiff", smallMap());
    fs::permissions(path, fs::perms::none);
    expectRefused(path, ErrorCode::Unreadable);
}

TEST(Refusal, AnEmptyFile)
{
    const TempFolder folder;
    expectRefused(folder.write("map.tif", ""), ErrorCode::Invalid);
}

TEST(Refusal, ADirectory)
{
    const TempFolder folder;
    expectRefused(folder.path().string(), ErrorCode::Unsupported);
}

TEST(Refusal, SomethingElseThanARaster)
{
    const TempFolder folder;
    expectRefused(folder.write("map.tif", "not a raster"), ErrorCode::Unsupported);
    expectRefused(folder.write("map.hgt", std::string(1000, 'x')), ErrorCode::Unsupported);
    expectRefused(folder.write("map.zip", "PK\x03\x04 broken"), ErrorCode::Unsupported);
    expectRefused(folder.write("map.vrt", "<VRTDataset"), ErrorCode::Unsupported);
    expectRefused(folder.write("map.xml", "<Product_Observational/>"), ErrorCode::Unsupported);
    expectRefused(folder.write("map.lbl", "PDS_VERSION_ID = PDS3\nEND\n"), ErrorCode::Unsupported);
    expectRefused(folder.write("points.csv", "x,y,z\n1,2,3\n"), ErrorCode::Unsupported);
}

TEST(Refusal, AnAbsurdSize)
{
    const TempFolder folder;
    for (const char* size : {"rasterXSize=\"2147483647\" rasterYSize=\"2147483647\"",
                             "rasterXSize=\"2147483647\" rasterYSize=\"1\"",
                             "rasterXSize=\"2\" rasterYSize=\"2147483647\""}) {
        expectRefused(folder.write("map.vrt", "<VRTDataset " + std::string(size) +
                                                  "><VRTRasterBand dataType=\"Float64\" "
                                                  "band=\"1\"/></VRTDataset>"),
                      ErrorCode::TooLarge);
    }
    // An accepted size, but more than the available memory.
    expectRefused(folder.write("map.vrt",
                               "<VRTDataset rasterXSize=\"16777216\" rasterYSize=\"16777216\">"
                               "<VRTRasterBand dataType=\"Float64\" band=\"1\"/></VRTDataset>"),
                  ErrorCode::TooLarge);
}

// Far more bytes per row than a whole map may have: the size must be checked before any read.
TEST(Refusal, TheLimitIsCheckedBeforeAWideRowOfRadiiIsRead)
{
    const TempFolder folder;
    expectRefused(folder.write("map.vrt",
                               "<VRTDataset rasterXSize=\"16777216\" rasterYSize=\"1000\">"
                               "<SRS>IAU_2015:49900</SRS>"
                               "<VRTRasterBand dataType=\"Float64\" band=\"1\"/></VRTDataset>"),
                  ErrorCode::TooLarge);
}

TEST(Refusal, MoreMemoryThanGranted)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "map.tif", "GTiff", smallMap());
    const auto refused = load(path, 11);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::TooLarge);
    expectOneSentence(refused.error(), path);
    EXPECT_TRUE(load(path, 12));
}

TEST(Refusal, PicturesAndComplexNumbers)
{
    const TempFolder folder;
    const RasterRecipe bytes = recipeFor<std::uint8_t>(2, {1, 2, 3, 4});
    expectRefused(writeRaster(folder, "colour.tif", "GTiff", bytes,
                              {"-b", "1", "-b", "1", "-b", "1", "-colorinterp", "red,green,blue"}),
                  ErrorCode::Unsupported);
    RasterRecipe indexed = bytes;
    indexed.band_xml =
        "<ColorInterp>Palette</ColorInterp><ColorTable>"
        "<Entry c1=\"0\" c2=\"0\" c3=\"0\" c4=\"255\"/>"
        "<Entry c1=\"255\" c2=\"0\" c3=\"0\" c4=\"255\"/></ColorTable>";
    expectRefused(writeRaster(folder, "indexed.tif", "GTiff", indexed), ErrorCode::Unsupported);
    for (const char* type : {"CInt16", "CFloat32", "CFloat64"}) {
        expectRefused(writeRaster(folder, "complex.tif", "GTiff", bytes, {"-ot", type}),
                      ErrorCode::Unsupported);
    }
}

// 2026-11: files in which GDAL finds no colors were read as elevations without a word.
TEST(LikelyPicture, IsNoted)
{
    const TempFolder folder;
    const RasterRecipe bytes = recipeFor<std::uint8_t>(2, {1, 2, 3, 4});
    const auto notices = [&](const std::vector<std::string>& options) {
        const auto opened = RasterFile::open(writeRaster(folder, "map.vrt", "VRT", bytes, options));
        if (!opened) {
            return std::string("refused");
        }
        std::string texts;
        for (const std::string& notice : opened->info().notices) {
            texts += notice.find("picture") != std::string::npos ? notice : "";
        }
        return texts;
    };
    const std::vector<std::string> three = {"-b", "1", "-b", "1", "-b", "1"};
    const auto withThree = [&three](std::vector<std::string> more) {
        more.insert(more.begin(), three.begin(), three.end());
        return more;
    };
    EXPECT_EQ(notices(three),
              "looks like a color picture: band 1 of 3 is read as elevations, and all are 8-bit "
              "values without a unit; open an elevation map instead");
    EXPECT_THAT(notices(withThree({"-b", "1"})), testing::HasSubstr("band 1 of 4"));
    EXPECT_EQ(notices({"-colorinterp", "red"}),
              "is one band of a color picture, read as elevations; open an elevation map instead");
    EXPECT_EQ(notices(withThree({"-colorinterp", "red,green,blue"})), "refused");
    EXPECT_EQ(notices({}), "");
    EXPECT_EQ(notices({"-colorinterp", "gray"}), "");
    EXPECT_EQ(notices({"-b", "1", "-b", "1", "-colorinterp", "gray,alpha"}), "");
    EXPECT_EQ(notices(withThree({"-ot", "Int16"})), "") << "three maps";
    EXPECT_EQ(notices(withThree({"-a_scale", "10"})), "") << "a declared scale";
}

// Vertical Mapper's grids have a picture of the elevations before them.
TEST(Refusal, APictureNamesTheElevationBand)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "grid.grd", "NWT_GRD",
                                         recipeFor<float>(3, {1, 2, 3, 4, 5, 6, 7, 8, 9}));
    const auto refused = RasterFile::open(path);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::HasSubstr("band 1 is part of a color picture; open band 4 (--band 4)"));
    const auto opened = RasterFile::open(path, 4);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->info().type, SampleType::Float32);
}

std::string fitsHeader(const std::vector<std::string>& cards)
{
    std::string header;
    for (std::string card : cards) {
        card.resize(80, ' ');
        header += card;
    }
    header.resize(2880, ' ');
    return header;
}

// 2026-11: a damaged FITS file of this size ended the program with a division by 0.
TEST(Refusal, RastersWithoutSamples)
{
    const TempFolder folder;
    const std::string path =
        folder.write("empty.fits",
                     fitsHeader({"SIMPLE  =                    T", "BITPIX  =                   16",
                                 "NAXIS   =                    2", "NAXIS1  =                    0",
                                 "NAXIS2  =                   64", "END"}));
    const auto refused = RasterFile::open(path);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              path + ": is damaged: its header says 0 × 64 samples; fetch it again");
}

// A FITS file of 3 × 2 samples 0, 1, …, 5.
std::string fitsFile(int bits, const std::string& scale, const std::string& offset)
{
    std::string file = fitsHeader(
        {"SIMPLE  =                    T", fmt::format("BITPIX  = {:20}", bits),
         "NAXIS   =                    2", "NAXIS1  =                    3",
         "NAXIS2  =                    2", "BSCALE  = " + scale, "BZERO   = " + offset, "END"});
    for (int i = 0; i < 6; ++i) {
        const auto bytes =
            bits == 16 ? static_cast<std::uint64_t>(i) << 48
                       : std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(i))} << 32;
        for (int byte = 0; byte < std::abs(bits) / 8; ++byte) {
            file += static_cast<char>(bytes >> (56 - 8 * byte) & 0xFF);
        }
    }
    file.resize(2 * 2880, '\0');
    return file;
}

// FITS 4.0, section 4.4.2: the physical value is BZERO + BSCALE × the stored value. The samples are
// numbered from below.
TEST(FitsFile, ItsScaleIsAppliedOnce)
{
    const TempFolder folder;
    for (const auto& [bits, scale, offset] :
         {std::tuple(-32, 0.5, 100.0), std::tuple(16, 2.0, 100.0), std::tuple(16, 1.0, -7.0)}) {
        SCOPED_TRACE(fmt::format("{} bits, {} + {}", bits, offset, scale));
        auto file = RasterFile::open(folder.write(
            "a.fits", fitsFile(bits, fmt::format("{:.1f}", scale), fmt::format("{:.1f}", offset))));
        ASSERT_TRUE(file) << file.error().message;
        const RasterInfo& info = file->info();
        const auto read = file->readWindow({0, 0, 3, 2}, {});
        ASSERT_TRUE(read) << read.error().message;
        const SampleStatistics& found = read->statistics;
        EXPECT_EQ(found.raw_minimum * info.scale + info.offset, offset);
        EXPECT_EQ(found.raw_maximum * info.scale + info.offset, offset + 5.0 * scale);
    }
}

TEST(FitsFile, WholeNumbersWithAFractionalScaleAreRefused)
{
    const TempFolder folder;
    const auto refused = RasterFile::open(folder.write("a.fits", fitsFile(16, "0.5", "100.0")));
    ASSERT_FALSE(refused);
    EXPECT_THAT(
        refused.error().message,
        testing::EndsWith("has whole numbers with scale 0.5 and offset 100, which GDAL reads "
                          "as whole elevations; save it with floating-point samples"));
}

TEST(Refusal, AnImageWithoutTheSamplesThatItsHeaderPromises)
{
    const TempFolder folder;
    const auto refused =
        RasterFile::open(folder.write("a.pgm", "P5\n1000 1000\n255\n" + std::string(1000, '\7')));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::HasSubstr("it is cut short, 1017 of the 1000000 bytes"));
}

TEST(Refusal, ACutPcidskFile)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "a.pix", "PCIDSK",
                                         recipeFor(200, std::vector<std::int16_t>(200 * 100, 500)));
    const auto bytes = fs::file_size(path);
    ASSERT_TRUE(RasterFile::open(path));
    fs::resize_file(path, bytes / 2);
    const auto refused = RasterFile::open(path);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr(fmt::format(
                                             "it is cut short, {} of the {} bytes that its header "
                                             "promises are present; fetch it again",
                                             bytes / 2, bytes)));
}

TEST(Refusal, ATruncatedSrtmTileIsToldFromItsSize)
{
    const TempFolder folder;
    const auto refused =
        RasterFile::open(folder.write("N40W106.hgt", std::string(1'000'000, '\0')));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::EndsWith("has 1000000 bytes, but SRTM tiles have 2884802 (1201 × 1201 "
                                  "samples) or 25934402 (3601 × 3601); it may be cut short; fetch "
                                  "it again"));
}

TEST(Refusal, SgiPicturesAreNamed)
{
    const TempFolder folder;
    const auto refused = RasterFile::open(folder.write(
        "picture.rgb", std::string("\x01\xDA\x00\x01\x00\x02", 6) + std::string(600, '\0')));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::HasSubstr("is in the format SGI, which MarsView does not read"));
}

TEST(Refusal, OnlyVoids)
{
    const TempFolder folder;
    RasterRecipe recipe = recipeFor<std::int16_t>(3, {-9999, -9999, -9999, -9999, -9999, -9999});
    recipe.band_xml = "<NoDataValue>-9999</NoDataValue>";
    expectRefused(writeRaster(folder, "voids.tif", "GTiff", recipe), ErrorCode::Invalid);
    expectRefused(writeRaster(folder, "nan.tif", "GTiff",
                              recipeFor<float>(2, {kNanFloat, kNanFloat, kNanFloat, kNanFloat})),
                  ErrorCode::Invalid);
}

TEST(Refusal, FewerThanTwoByTwoSamples)
{
    const TempFolder folder;
    expectRefused(writeRaster(folder, "one.tif", "GTiff", recipeFor<std::int16_t>(1, {5})),
                  ErrorCode::Invalid);
    expectRefused(writeRaster(folder, "row.tif", "GTiff", recipeFor<std::int16_t>(3, {5, 6, 7})),
                  ErrorCode::Invalid);
    expectRefused(writeRaster(folder, "column.tif", "GTiff", recipeFor<std::int16_t>(1, {5, 6, 7})),
                  ErrorCode::Invalid);
}

TEST(Refusal, AFileWithoutBands)
{
    const TempFolder folder;
    const std::string path =
        folder.write("none.vrt", "<VRTDataset rasterXSize=\"5\" rasterYSize=\"5\"></VRTDataset>");
    const auto dataset = load(path);
    ASSERT_FALSE(dataset);
    expectOneSentence(dataset.error(), path);
}

TEST(Refusal, TruncatedFiles)
{
    const TempFolder folder;
    const std::string whole = test::readFile(writeRaster(
        folder, "whole.tif", "GTiff",
        recipeFor<std::int16_t>(200, std::vector<std::int16_t>(std::size_t{200} * 200, 7))));
    for (const double share : {0.001, 0.01, 0.5, 0.9, 0.999}) {
        const auto bytes = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
        const std::string path = folder.write("short.tif", whole.substr(0, bytes));
        SCOPED_TRACE(share);
        const auto dataset = load(path);
        ASSERT_FALSE(dataset);
        expectOneSentence(dataset.error(), path);
    }
}

// For raw data, GDAL itself replaces a missing end of the file by zeros.
TEST(Refusal, RawDataTruncatedAnywhere)
{
    const TempFolder folder;
    for (const char* driver : {"ENVI", "EHdr"}) {
        const std::string path = writeRaster(
            folder, std::string(driver) + ".bil", driver,
            recipeFor<std::int16_t>(20, std::vector<std::int16_t>(std::size_t{20} * 20, 7)));
        ASSERT_TRUE(opensAsMap(path));
        for (const std::uintmax_t bytes : {799U, 798U, 790U, 761U, 760U, 400U, 39U}) {
            fs::resize_file(path, bytes);
            SCOPED_TRACE(bytes);
            expectRefused(path, ErrorCode::Unreadable);
        }
    }
}

// Known gap, 2026-11: GDAL 3.6 does not report the location of the raw bands of a virtual raster,
// and reads their missing part as zeros.
TEST(Refusal, TruncatedRawBandsOfAVirtualRaster)
{
    const TempFolder folder;
    const std::string path = writeVrt(folder, "raw", smallMap());
    ASSERT_TRUE(opensAsMap(path));
    fs::resize_file(folder.file("raw.raw"), 10);
    if (opensAsMap(path)) {
        GTEST_SKIP() << "this GDAL reads the missing end of a virtual raster's raw band as zeros";
    }
    expectRefused(path, ErrorCode::Unreadable);
}

TEST(Refusal, DamagedRealFiles)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    for (const char* file :
         {"mars_mola/megt44n000hb.lbl", // its data file is missing
          "derived/megt90n000cb_truncated.lbl", "derived/S11E120.hgt",
          "gdal_autotest/gcore/data/byte_truncated.tif", "oracle/mars-nomenclature.csv",
          "oracle/GeodTest-100.dat", "oracle/three_point_bennison1990.txt", "CATALOGUE.tsv"}) {
        const std::string path = (test::sharedData() / file).string();
        SCOPED_TRACE(path);
        const auto dataset = load(path);
        ASSERT_FALSE(dataset);
        expectOneSentence(dataset.error(), path);
        std::printf("%s\n", dataset.error().message.substr(path.size() + 2).c_str());
    }
}

TEST(Refusal, AFileTruncatedAfterOpening)
{
    const TempFolder folder;
    const std::string path = writeRaster(
        folder, "map.tif", "GTiff",
        recipeFor<std::int16_t>(2000, std::vector<std::int16_t>(std::size_t{2000} * 2000, 7)));
    auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    fs::resize_file(path, 4096);
    JobMonitor monitor;
    const auto loaded = file->readAll(monitor, {}, kBudget);
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, ErrorCode::Unreadable);
    expectOneSentence(loaded.error(), path);
    const auto window = file->readWindow({1500, 1500, 10, 10}, {});
    ASSERT_FALSE(window);
    expectOneSentence(window.error(), path);
    ASSERT_FALSE(file->scan(monitor, {}));
}

TEST(Refusal, AFileRemovedAfterOpening)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "map.tif", "GTiff", smallMap());
    auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    fs::remove(path);
    JobMonitor monitor;
    // The system keeps the data for a process that has the file open. A crash or wrong samples are
    // failures.
    const auto loaded = file->readAll(monitor, {}, kBudget);
    if (loaded) {
        EXPECT_EQ(loaded->grid.raw(2, 1), 6.0);
    } else {
        expectOneSentence(loaded.error(), path);
    }
    const auto again = load(path);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::NotFound);
}

TEST(Refusal, CanceledReading)
{
    const TempFolder folder;
    const std::string path = writeRaster(folder, "map.tif", "GTiff", smallMap());
    JobMonitor monitor;
    monitor.cancel();
    const auto dataset = readMap(RasterSpec{path, 1, {}}, monitor, kBudget);
    ASSERT_FALSE(dataset);
    EXPECT_EQ(dataset.error().code, ErrorCode::Canceled);
    expectOneSentence(dataset.error(), path);
    auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    const auto scanned = file->scan(monitor, {});
    ASSERT_FALSE(scanned);
    EXPECT_EQ(scanned.error().code, ErrorCode::Canceled);
}

// A raster without a geotransform is still a map: the user can enter its position.
TEST(Tolerance, MapsWithoutUsablePlacementOpenWithANotice)
{
    const TempFolder folder;
    const auto noticed = [&](const RasterRecipe& recipe, const std::string& word) {
        const std::string path = writeVrt(folder, "map", recipe);
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_TRUE(
            std::any_of(file->info().notices.begin(), file->info().notices.end(),
                        [&](const std::string& n) { return n.find(word) != std::string::npos; }))
            << word;
        for (const std::string& notice : file->info().notices) {
            EXPECT_EQ(notice.find('\n'), std::string::npos) << notice;
        }
        EXPECT_TRUE(opensAsMap(path));
    };
    RasterRecipe nowhere = smallMap();
    nowhere.transform.reset();
    noticed(nowhere, "no georeferencing");
    RasterRecipe zero = smallMap();
    zero.transform = {0, 0, 0, 0, 0, 0};
    noticed(zero, "cannot be inverted");
    RasterRecipe parallel = smallMap();
    parallel.transform = {0, 30, 30, 0, 30, 30};
    noticed(parallel, "cannot be inverted");
    RasterRecipe endless = smallMap();
    endless.transform = {std::numeric_limits<double>::infinity(), 30, 0, 0, 0, -30};
    noticed(endless, "cannot be inverted");
    RasterRecipe geocentric = smallMap();
    geocentric.srs = "EPSG:4978";
    noticed(geocentric, "geocentric");
}

TEST(Tolerance, ADamagedCrsDoesNotCrash)
{
    const TempFolder folder;
    const std::string nonsense =
        "PROJCS[\"x\",GEOGCS[\"x\",DATUM[\"y\",SPHEROID[\"z\",6378137,298]],"
        "PRIMEM[\"G\",0],UNIT[\"degree\",0.017]],"
        "PROJECTION[\"Nonsense\"],UNIT[\"metre\",1]]";
    for (const std::string& srs : {std::string("garbage"), std::string("PROJCS[\"x\"]"),
                                   std::string("GEOGCS[\"x\",DATUM[\"y\",SPHEROID[\"z\",0,0]]]"),
                                   std::string("+proj=eqc +R=0"), nonsense}) {
        RasterRecipe recipe = smallMap();
        recipe.srs = srs;
        const std::string path = writeVrt(folder, "map", recipe);
        const auto dataset = load(path);
        if (dataset) {
            (void)(*dataset)->georeference().toGeographic(GridPoint{0.5, 0.5});
        } else {
            expectOneSentence(dataset.error(), path);
        }
    }
}

TEST(Tolerance, HugeNodataDoesNotLoopForever)
{
    const TempFolder folder;
    for (const char* nodata :
         {"1e300", "-1.7976931348623157e308", "nan", "inf", "-inf", "1e-320"}) {
        RasterRecipe recipe = recipeFor<float>(3, {1, 2, 3, 4, 5, 6});
        recipe.band_xml = "<NoDataValue>" + std::string(nodata) + "</NoDataValue>";
        const auto dataset = load(writeVrt(folder, "map", recipe));
        ASSERT_TRUE(dataset) << nodata << ": " << dataset.error().message;
        EXPECT_EQ((*dataset)->heightfield().range()->maximum_m, 6.0) << nodata;
    }
}

} // namespace
} // namespace marsview
