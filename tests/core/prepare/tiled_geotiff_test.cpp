// The tiled copy against its source, by GDAL's tools and by brute force.
#include "core/base/file_lock.h"
#include "core/prepare/checkpoints.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/raster/raster_file.h"
#include "core/sources/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"
#include "tests/support/gdal_tools.h"
#include "tests/support/make_raster.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_types.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <future>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <sys/stat.h>
#include <thread>
#include <type_traits>
#include <unistd.h>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

TiledGeoTiffJob jobFor(const std::string& source, const std::string& path)
{
    TiledGeoTiffJob job;
    job.source = source;
    job.path = path;
    job.checkpoint_interval = std::chrono::milliseconds(0); // as many checkpoints as possible
    return job;
}

TiledGeoTiffReport prepare(const TiledGeoTiffJob& job)
{
    JobMonitor monitor;
    Result<TiledGeoTiffReport> report = writeTiledGeoTiff(job, monitor);
    EXPECT_TRUE(report) << report.error().message;
    EXPECT_EQ(monitor.fraction(), 1.0);
    return report ? *report : TiledGeoTiffReport{};
}

Error failureOf(const TiledGeoTiffJob& job)
{
    JobMonitor monitor;
    Result<TiledGeoTiffReport> report = writeTiledGeoTiff(job, monitor);
    EXPECT_FALSE(report) << "was prepared";
    return report ? Error{} : report.error();
}

// The samples of a band, or of one of its overviews (0 is the one by 2), as gdal_translate writes
// them: into a plain TIFF with one strip at the end of the file. (No simpler format has 64-bit
// integers.)
std::string samplesOf(const std::string& path, int overview = -1, const std::string& band = "1")
{
    const test::TempFolder folder;
    const std::string plain = folder.file("plain.tif");
    std::vector<std::string> command{
        "gdal_translate", "-q", "-b", band, "-co", "PROFILE=BASELINE", "-co", "BLOCKYSIZE=1000000"};
    if (overview >= 0) {
        command.insert(command.end(), {"-ovr", std::to_string(overview)});
    }
    command.insert(command.end(), {path, plain});
    test::runTool(command);
    const nlohmann::json info = test::gdalInfo(plain);
    const std::string type = test::firstBand(info)["type"].get<std::string>();
    const std::size_t sample_bytes = type.ends_with("64")   ? 8
                                     : type.ends_with("32") ? 4
                                     : type.ends_with("16") ? 2
                                                            : 1;
    const std::size_t bytes =
        info["size"][0].get<std::size_t>() * info["size"][1].get<std::size_t>() * sample_bytes;
    const std::string file = test::readFile(plain);
    const auto number = [&file](std::size_t at, std::size_t size) {
        std::size_t value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            value |= static_cast<std::size_t>(static_cast<unsigned char>(file.at(at + i)))
                     << (8 * i);
        }
        return value;
    };
    const std::size_t directory = number(4, 4);
    for (std::size_t entry = 0; entry < number(directory, 2); ++entry) {
        constexpr std::size_t kStripOffsets = 273;
        const std::size_t at = directory + 2 + 12 * entry;
        if (number(at, 2) == kStripOffsets && number(at + 4, 4) == 1) {
            return file.substr(number(at + 8, 4), bytes);
        }
    }
    throw std::runtime_error(plain + " has more than one strip");
}

void expectNothingLeftBeside(const std::string& path)
{
    for (const char* ending :
         {".part", ".part.checkpoint", ".part.checkpoint.new", ".lock", ".aux.xml"}) {
        EXPECT_FALSE(fs::exists(path + ending)) << path << ending;
    }
}

void expectSameMap(const std::string& source_path, const std::string& copy_path)
{
    Result<RasterFile> source = RasterFile::open(source_path);
    Result<RasterFile> copy = RasterFile::open(copy_path);
    ASSERT_TRUE(source) << source.error().message;
    ASSERT_TRUE(copy) << copy.error().message;
    const RasterInfo& a = source->info();
    const RasterInfo& b = copy->info();
    EXPECT_EQ(b.driver, "GTiff");
    EXPECT_EQ(b.columns, a.columns);
    EXPECT_EQ(b.rows, a.rows);
    EXPECT_EQ(b.type, a.type);
    EXPECT_EQ(b.nodata.has_value(), a.nodata.has_value());
    if (a.nodata && b.nodata && !(std::isnan(*a.nodata) && std::isnan(*b.nodata))) {
        EXPECT_EQ(*b.nodata, *a.nodata);
    }
    EXPECT_EQ(b.has_mask_band, a.has_mask_band);
    EXPECT_EQ(b.scale, a.scale);
    EXPECT_EQ(b.offset, a.offset);
    EXPECT_EQ(b.unit, a.unit);
    EXPECT_EQ(b.is_unit_declared, a.is_unit_declared);
    EXPECT_EQ(b.reference_radius_m, a.reference_radius_m);
    EXPECT_EQ(b.vertical_datum, a.vertical_datum);
    EXPECT_EQ(b.typical_raw, a.typical_raw);
    EXPECT_EQ(b.transform.has_value(), a.transform.has_value());
    if (a.transform && b.transform) {
        EXPECT_EQ(b.transform->terms(), a.transform->terms());
    }
    EXPECT_EQ(b.body, a.body);
    ASSERT_EQ(b.crs.has_value(), a.crs.has_value());
    if (a.crs) {
        EXPECT_EQ(b.crs->kind(), a.crs->kind());
        EXPECT_EQ(b.crs->unit(), a.crs->unit());
        EXPECT_EQ(b.crs->latitudeKind(), a.crs->latitudeKind());
        EXPECT_EQ(b.crs->eastSign(), a.crs->eastSign());
        ASSERT_EQ(b.crs->ellipsoid().has_value(), a.crs->ellipsoid().has_value());
        if (a.crs->ellipsoid()) {
            EXPECT_NEAR(b.crs->ellipsoid()->equatorial_m, a.crs->ellipsoid()->equatorial_m, 1e-6);
            EXPECT_NEAR(b.crs->ellipsoid()->polar_m, a.crs->ellipsoid()->polar_m, 1e-6);
        }
        // The positions themselves, through the CRS.
        for (const GridPoint grid :
             {GridPoint{0.0, 0.0},
              GridPoint{static_cast<double>(a.columns) - 1.0, static_cast<double>(a.rows) - 1.0}}) {
            if (!a.transform) {
                break;
            }
            const auto from = a.crs->toGeographic(a.transform->toMap(grid));
            const auto to = b.crs->toGeographic(b.transform->toMap(grid));
            ASSERT_EQ(to.has_value(), from.has_value());
            if (from) {
                EXPECT_NEAR(to->longitude.degrees(), from->longitude.degrees(), 1e-10);
                EXPECT_NEAR(to->latitude.degrees(), from->latitude.degrees(), 1e-10);
            }
        }
    }
}

constexpr const char* kAbsent = "(absent)";

std::vector<std::string> readableFiles()
{
    std::vector<std::string> paths;
    for (const test::CatalogueEntry& entry : test::catalogue()) {
        const bool is_truncated = entry.path.find("truncated.") != std::string::npos;
        if (entry.driver != "DOES NOT OPEN" && !is_truncated) {
            paths.push_back(entry.path);
        }
    }
    if (paths.empty()) {
        paths.emplace_back(kAbsent);
    }
    return paths;
}

class TiledCopyOf : public testing::TestWithParam<std::string> {};

TEST_P(TiledCopyOf, IsIdenticalToItsSource)
{
    if (GetParam() == kAbsent) {
        GTEST_SKIP() << "the real elevation data is not at " << test::sharedData();
    }
    const std::string source = (test::sharedData() / GetParam()).string();
    const test::TempFolder folder;
    const std::string path = folder.file("copy.tif");
    prepare(jobFor(source, path));
    expectNothingLeftBeside(path);
    expectSameMap(source, path);
    Result<RasterFile> opened = RasterFile::open(source);
    ASSERT_TRUE(opened);
    EXPECT_EQ(samplesOf(path), samplesOf(opened->info().path));
    EXPECT_EQ(test::maskOf(path), test::maskOf(opened->info().path));
    const nlohmann::json info = test::gdalInfo(path);
    const nlohmann::json& band = test::firstBand(info);
    EXPECT_EQ(band.at("block"), nlohmann::json::array({256, 256}));
    EXPECT_EQ(band.value("overviews", nlohmann::json::array()).size(),
              overviewCount(opened->info().columns, opened->info().rows));
}

INSTANTIATE_TEST_SUITE_P(Catalogue,
                         TiledCopyOf,
                         testing::ValuesIn(readableFiles()),
                         [](const auto& file) {
                             std::string name = file.param;
                             for (char& c : name) {
                                 c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                             }
                             return name;
                         });

// The known content of a synthetic map, for brute force.
template <typename T>
struct Truth {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<T> samples;
    std::vector<bool> is_void;
    std::optional<T> nodata;
};

// The mean of a block as the header defines it; nullopt if the whole block is void.
template <typename T>
std::optional<T> blockMean(const Truth<T>& truth, std::size_t level, std::size_t x, std::size_t y)
{
    const std::size_t side = std::size_t{1} << level;
    long double sum = 0.0L;
    std::size_t count = 0;
    for (std::size_t r = y * side; r < std::min((y + 1) * side, truth.rows); ++r) {
        for (std::size_t c = x * side; c < std::min((x + 1) * side, truth.columns); ++c) {
            if (!truth.is_void[r * truth.columns + c]) {
                sum += static_cast<long double>(truth.samples[r * truth.columns + c]);
                ++count;
            }
        }
    }
    if (count == 0) {
        return std::nullopt;
    }
    const long double mean = sum / static_cast<long double>(count);
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(mean);
    } else {
        return static_cast<T>(std::round(mean));
    }
}

template <typename T>
void expectOverviewsAreMeans(const std::string& path, const Truth<T>& truth, std::size_t step)
{
    for (std::size_t level = 1; level <= overviewCount(truth.columns, truth.rows); ++level) {
        SCOPED_TRACE(fmt::format("level {}", level));
        const std::string bytes = samplesOf(path, static_cast<int>(level) - 1);
        const std::size_t columns = (truth.columns + (std::size_t{1} << level) - 1) >> level;
        const std::size_t rows = (truth.rows + (std::size_t{1} << level) - 1) >> level;
        ASSERT_EQ(bytes.size(), columns * rows * sizeof(T));
        const std::size_t stride = level < 3 ? step : 1;
        for (std::size_t i = 0; i < columns * rows; i += stride) {
            T found{};
            std::memcpy(&found, bytes.data() + i * sizeof(T), sizeof(T));
            const std::optional<T> mean = blockMean(truth, level, i % columns, i / columns);
            if (!mean) {
                if (truth.nodata) {
                    ASSERT_EQ(found, *truth.nodata) << i;
                } else if constexpr (std::is_floating_point_v<T>) {
                    ASSERT_TRUE(std::isnan(found)) << i;
                }
            } else if (truth.nodata && *mean == *truth.nodata) {
                ASSERT_NE(found, *truth.nodata) << i;
                ASSERT_NEAR(static_cast<double>(found), static_cast<double>(*mean), 1.0) << i;
            } else if constexpr (std::is_floating_point_v<T>) {
                ASSERT_NEAR(static_cast<double>(found), static_cast<double>(*mean),
                            4.0 * static_cast<double>(std::numeric_limits<T>::epsilon()) *
                                30'000.0) // of the terms
                    << i;
            } else {
                ASSERT_EQ(found, *mean) << i;
            }
        }
    }
}

template <typename T>
Truth<T> randomMap(std::size_t columns, std::size_t rows, double low, double high)
{
    test::Random random;
    Truth<T> truth{
        columns, rows, std::vector<T>(columns * rows), std::vector<bool>(columns * rows), {}};
    for (T& sample : truth.samples) {
        sample = static_cast<T>(random.uniform(low, high));
    }
    return truth;
}

// Voids: a large rectangle, and one sample in ten elsewhere.
template <typename T>
void punchVoids(Truth<T>& truth, T value)
{
    test::Random random(7);
    for (std::size_t r = 0; r < truth.rows; ++r) {
        for (std::size_t c = 0; c < truth.columns; ++c) {
            if ((c >= 300 && c < 700 && r >= 200 && r < 560) || random.chance(0.1)) {
                truth.samples[r * truth.columns + c] = value;
                truth.is_void[r * truth.columns + c] = true;
            }
        }
    }
}

template <typename T>
class TiledGeoTiffType : public testing::Test {};
TYPED_TEST_SUITE(TiledGeoTiffType, test::AllSampleTypes);

TYPED_TEST(TiledGeoTiffType, KeepsSamplesAndAveragesThoseThatAreNotVoid)
{
    using T = TypeParam;
    const test::TempFolder folder;
    constexpr double kRange = sizeof(T) == 1 ? 100.0 : 30'000.0;
    Truth<T> truth = randomMap<T>(1031, 777, std::is_signed_v<T> ? -kRange : 0.0, kRange);
    truth.nodata = static_cast<T>(7); // among the valid elevations
    for (std::size_t i = 0; i < truth.samples.size(); ++i) {
        truth.is_void[i] = truth.samples[i] == *truth.nodata;
    }
    punchVoids(truth, *truth.nodata);
    test::RasterRecipe recipe = test::recipeFor(truth.columns, truth.samples);
    recipe.band_xml += "<NoDataValue>7</NoDataValue>";
    const std::string source = test::writeVrt(folder, "source", recipe);
    const std::string path = folder.file("copy.tif");
    prepare(jobFor(source, path));
    EXPECT_EQ(samplesOf(path), recipe.bytes);
    expectSameMap(source, path);
    expectOverviewsAreMeans(path, truth, 7);
}

TEST(TiledGeoTiff, TreatsNanAndInfinityAsVoid)
{
    const test::TempFolder folder;
    Truth<float> truth = randomMap<float>(900, 600, -5000.0, 5000.0);
    punchVoids(truth, std::numeric_limits<float>::quiet_NaN());
    truth.samples[5] = std::numeric_limits<float>::infinity();
    truth.is_void[5] = true;
    const test::RasterRecipe recipe = test::recipeFor(truth.columns, truth.samples);
    const std::string path = folder.file("copy.tif");
    prepare(jobFor(test::writeVrt(folder, "source", recipe), path));
    EXPECT_EQ(samplesOf(path), recipe.bytes);
    expectOverviewsAreMeans(path, truth, 7);
}

TEST(TiledGeoTiff, CopiesAMaskAndItsOverviews)
{
    const test::TempFolder folder;
    Truth<std::int16_t> truth = randomMap<std::int16_t>(1030, 780, -5000.0, 5000.0);
    punchVoids<std::int16_t>(truth, 1234);
    std::string mask(truth.samples.size(), '\xFF');
    for (std::size_t i = 0; i < mask.size(); ++i) {
        mask[i] = truth.is_void[i] ? '\0' : '\xFF';
    }
    folder.write("mask.raw", mask);
    test::RasterRecipe recipe = test::recipeFor(truth.columns, truth.samples);
    recipe.extra_xml =
        "<MaskBand><VRTRasterBand dataType=\"Byte\" subClass=\"VRTRawRasterBand\">"
        "<SourceFilename relativeToVRT=\"1\">mask.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>1</PixelOffset><LineOffset>1030</LineOffset></VRTRasterBand></MaskBand>";
    const std::string source = test::writeVrt(folder, "source", recipe);
    const std::string path = folder.file("copy.tif");
    prepare(jobFor(source, path));
    EXPECT_EQ(samplesOf(path), recipe.bytes);
    expectSameMap(source, path);
    EXPECT_EQ(samplesOf(path, -1, "mask"), mask);
    expectOverviewsAreMeans(path, truth, 7);
    for (std::size_t level = 1; level <= 3; ++level) {
        const std::string valid = samplesOf(path, static_cast<int>(level) - 1, "mask");
        const std::size_t columns = (truth.columns + (std::size_t{1} << level) - 1) >> level;
        ASSERT_EQ(valid.size() % columns, 0U);
        for (std::size_t i = 0; i < valid.size(); ++i) {
            ASSERT_EQ(valid[i] != '\0',
                      blockMean(truth, level, i % columns, i / columns).has_value())
                << "level " << level << ", pixel " << i;
        }
    }
}

TEST(TiledGeoTiff, AveragesAcrossTilesOfAVeryLargeMap)
{
    const test::TempFolder folder;
    Truth<std::int16_t> truth = randomMap<std::int16_t>(30, 140'003, -5000.0, 5000.0);
    ASSERT_EQ(overviewCount(truth.columns, truth.rows), 10U);
    const std::string path = folder.file("copy.tif");
    prepare(jobFor(test::writeVrt(folder, "source", test::recipeFor(truth.columns, truth.samples)),
                   path));
    expectOverviewsAreMeans(path, truth, 97);
}

TEST(TiledGeoTiff, ReadsEveryLayout)
{
    const test::TempFolder folder;
    const Truth<std::int16_t> truth = randomMap<std::int16_t>(1500, 1100, -5000.0, 5000.0);
    const test::RasterRecipe recipe = test::recipeFor(truth.columns, truth.samples);
    const std::vector<std::vector<std::string>> layouts{
        {"-co", "COMPRESS=LZW", "-co", "BLOCKYSIZE=7"},
        {"-co", "TILED=YES", "-co", "BLOCKXSIZE=512", "-co", "BLOCKYSIZE=512", "-co",
         "COMPRESS=DEFLATE"},
        {"-co", "TILED=YES", "-co", "BLOCKXSIZE=16", "-co", "BLOCKYSIZE=1008"},
        {"-co", "BLOCKYSIZE=1100"},
    };
    for (const std::vector<std::string>& layout : layouts) {
        const std::string source = test::writeRaster(folder, "source.tif", "GTiff", recipe, layout);
        const std::string path = folder.file("copy.tif");
        prepare(jobFor(source, path));
        EXPECT_EQ(samplesOf(path), recipe.bytes) << layout[1];
    }
}

TEST(TiledGeoTiff, ReadsTheRequestedBand)
{
    const test::TempFolder folder;
    const Truth<std::int16_t> truth = randomMap<std::int16_t>(300, 300, -5000.0, 5000.0);
    test::RasterRecipe recipe = test::recipeFor(truth.columns, truth.samples);
    recipe.extra_xml =
        "<VRTRasterBand dataType=\"Int16\" band=\"2\" subClass=\"VRTRawRasterBand\">"
        "<SourceFilename "
        "relativeToVRT=\"1\">source.raw</SourceFilename><ImageOffset>2</ImageOffset>"
        "<PixelOffset>2</PixelOffset><LineOffset>598</LineOffset></VRTRasterBand>";
    const std::string source = test::writeVrt(folder, "source", recipe);
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    job.band = 2;
    prepare(job);
    const std::string second = samplesOf(source, -1, "2");
    EXPECT_EQ(samplesOf(job.path), second);
    EXPECT_NE(second, recipe.bytes);
}

TEST(TiledGeoTiff, WritesTheUsersOverrides)
{
    const test::TempFolder folder;
    const std::string source =
        test::writeVrt(folder, "source", test::recipeFor<std::int16_t>(2, {1, 2, -9, 4}));
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    job.overrides.nodata = -9.0;
    job.overrides.crs = "EPSG:32611";
    job.overrides.vertical_unit = "ft";
    prepare(job);
    const nlohmann::json info = test::gdalInfo(job.path);
    EXPECT_EQ(test::firstBand(info)["noDataValue"], -9.0);
    EXPECT_EQ(test::firstBand(info)["unit"], "ft");
    EXPECT_THAT(info["coordinateSystem"]["wkt"].get<std::string>(), HasSubstr("UTM zone 11N"));
}

TEST(TiledGeoTiff, KeepsCrsPropertiesThatGeoTiffCannotExpress)
{
    const test::TempFolder folder;
    test::RasterRecipe recipe = test::recipeFor<std::int16_t>(2, {1, 2, 3, 4});
    recipe.transform = {10.0, 0.5, 0.0, 20.0, 0.0, -0.5};
    // West-positive longitudes; planetocentric latitudes on an ellipsoid; both in a projection.
    for (const char* crs : {"IAU_2015:49900", "IAU_2015:49901", "IAU_2015:49902", "IAU_2015:49910",
                            "IAU_2015:49911", "IAU_2015:49912", "EPSG:32611", "EPSG:2853"}) {
        SCOPED_TRACE(crs);
        recipe.srs = crs;
        const std::string source = test::writeVrt(folder, "source", recipe);
        const std::string path = folder.file("copy.tif");
        prepare(jobFor(source, path));
        expectSameMap(source, path);
    }
}

// A tall map: many checkpoints, little work.
std::string tallMap(const test::TempFolder& folder, const std::string& name)
{
    return test::writeVrt(folder, name,
                          test::recipeFor<std::int16_t>(
                              260, randomMap<std::int16_t>(260, 20'000, -5000.0, 5000.0).samples));
}

void setModified(const std::string& path, const timespec& time)
{
    const std::array<timespec, 2> times{timespec{0, UTIME_OMIT}, time};
    ASSERT_EQ(utimensat(AT_FDCWD, path.c_str(), times.data(), 0), 0);
}

// All statistics of gdalinfo.
nlohmann::json checksumsOf(const std::string& path)
{
    nlohmann::json info =
        nlohmann::json::parse(test::runTool({"gdalinfo", "-json", "-checksum", path}));
    info.erase("description");
    info.erase("files");
    return info;
}

// Prepares until `fraction` and cancels there.
Result<TiledGeoTiffReport> prepareUntil(const TiledGeoTiffJob& job, double fraction)
{
    JobMonitor monitor;
    std::jthread canceller([&](const std::stop_token& stop) {
        while (!stop.stop_requested() && monitor.fraction() < fraction) {
            std::this_thread::yield();
        }
        monitor.cancel();
    });
    return writeTiledGeoTiff(job, monitor);
}

TEST(TiledGeoTiff, ResumesAfterACancel)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    const TiledGeoTiffJob whole = jobFor(source, folder.file("whole.tif"));
    prepare(whole);
    const TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    for (const double fraction : {0.2, 0.4, 0.6}) {
        const Result<TiledGeoTiffReport> stopped = prepareUntil(job, fraction);
        ASSERT_FALSE(stopped);
        EXPECT_EQ(stopped.error().code, ErrorCode::Canceled);
        EXPECT_THAT(stopped.error().message, StartsWith(job.path));
        EXPECT_THAT(stopped.error().message, HasSubstr("prepare it again to resume"));
        EXPECT_FALSE(fs::exists(job.path));
    }
    const TiledGeoTiffReport report = prepare(job);
    EXPECT_LT(report.samples_read, report.samples);
    ASSERT_EQ(report.notes.size(), 1U);
    EXPECT_THAT(report.notes[0], HasSubstr("resumed after row"));
    EXPECT_EQ(checksumsOf(job.path), checksumsOf(whole.path));
    // Data written after the last checkpoint is written again at the same place.
    EXPECT_TRUE(test::readFile(job.path) == test::readFile(whole.path));
    expectNothingLeftBeside(job.path);
}

TEST(TiledGeoTiff, RestartsIfTheUnfinishedFileIsDamagedOrOfAnotherSource)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    const TiledGeoTiffJob whole = jobFor(source, folder.file("whole.tif"));
    prepare(whole);
    const nlohmann::json truth = checksumsOf(whole.path);
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    const std::string part = job.path + ".part";
    const std::string checkpoint = part + ".checkpoint";
    const std::vector<std::pair<const char*, std::function<void()>>> damages{
        {"cut", [&] { fs::resize_file(part, placeInCheckpoint(checkpoint)->file_bytes - 1); }},
        {"empty", [&] { fs::resize_file(part, 0); }},
        {"no TIFF", [&] { folder.write("copy.tif.part", std::string(100'000, 'x')); }},
        {"zeroed tiles",
         [&] {
             std::string bytes = test::readFile(part);
             const auto noted =
                 static_cast<std::ptrdiff_t>(placeInCheckpoint(checkpoint)->file_bytes);
             std::fill(bytes.begin() + noted / 2, bytes.end(), '\0');
             folder.write("copy.tif.part", bytes);
         }},
        {"checkpoint of nonsense", [&] { folder.write("copy.tif.part.checkpoint", "nonsense"); }},
        {"checkpoint with a flipped bit",
         [&] {
             std::string bytes = test::readFile(checkpoint);
             bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
             folder.write("copy.tif.part.checkpoint", bytes);
         }},
        {"another source's",
         [&] {
             fs::last_write_time(folder.file("source.raw"),
                                 fs::file_time_type::clock::now() + std::chrono::seconds(10));
         }},
        {"other settings", [&] { job.overrides.nodata = 12.0; }},
    };
    for (const auto& [name, damage] : damages) {
        SCOPED_TRACE(name);
        ASSERT_FALSE(prepareUntil(job, 0.5));
        ASSERT_TRUE(fs::exists(checkpoint));
        damage();
        const TiledGeoTiffReport report = prepare(job);
        ASSERT_EQ(report.notes.size(), 1U);
        EXPECT_THAT(report.notes[0], HasSubstr("restarted"));
        EXPECT_EQ(report.samples_read, report.samples);
        if (!job.overrides.nodata) {
            nlohmann::json found = checksumsOf(job.path);
            nlohmann::json expected = truth;
            found.erase("metadata"); // the source's time
            expected.erase("metadata");
            EXPECT_EQ(found, expected);
        }
        fs::remove(job.path);
    }
}

TEST(TiledGeoTiff, NeverResumesFromTilesWithAFlippedBit)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    const std::string part = job.path + ".part";
    const std::string checkpoint_path = part + ".checkpoint";
    const std::string empty = folder.file("empty.tif"); // the file as it is before the first tile
    Result<RasterFile> file = RasterFile::open(source);
    ASSERT_TRUE(file);
    ASSERT_TRUE(writeGeoTiffSkeleton(empty, file->info(), {"key", source}));
    ASSERT_FALSE(prepareUntil(job, 0.5));
    job.checkpoint_interval = TiledGeoTiffJob{}.checkpoint_interval;
    const std::string left = test::readFile(part);
    const std::string checkpoint = test::readFile(checkpoint_path);
    const std::uint64_t begin = fs::file_size(empty) + 1000; // the real key is longer
    const std::uint64_t end = placeInCheckpoint(checkpoint_path)->file_bytes;
    ASSERT_GT(end, 10 * begin);
    const std::string truth = samplesOf(source);
    test::Random random;
    std::size_t unused = 0; // tiles after the checkpoint, of levels that are written at the end
    for (int i = 0; i < 16; ++i) {
        std::string damaged = left;
        const std::uint64_t at = begin + random.below(end - begin);
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.below(8)));
        folder.write("copy.tif.part", damaged);
        folder.write("copy.tif.part.checkpoint", checkpoint);
        const TiledGeoTiffReport report = prepare(job);
        ASSERT_EQ(report.notes.size(), 1U);
        const bool is_begun_again = report.notes[0].ends_with("restarted");
        unused += is_begun_again ? 0U : 1U;
        EXPECT_TRUE(samplesOf(job.path) == truth) << "byte " << at;
        EXPECT_TRUE(isWholeTiledGeoTiff(job.path));
        fs::remove(job.path);
    }
    std::cout << unused << " of 16 flips hit no data that the resumed run used\n";
    EXPECT_LE(unused, 2U);
}

TEST(TiledGeoTiff, PublishesNothingIfTheSourceChanges)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    const TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    JobMonitor monitor;
    std::jthread writer([&](const std::stop_token& stop) {
        while (!stop.stop_requested() && monitor.fraction() < 0.1) {
            std::this_thread::yield();
        }
        const std::string raw = folder.file("source.raw");
        fs::last_write_time(raw, fs::last_write_time(raw) + std::chrono::seconds(5));
    });
    const Result<TiledGeoTiffReport> report = writeTiledGeoTiff(job, monitor);
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, StartsWith(source + ": changed while it was being read"));
    EXPECT_FALSE(fs::exists(job.path));
    expectNothingLeftBeside(job.path);
}

// Overwrites three of the tall map's rows, in a part of the file that the source identity does not
// read, within the same second in which the map was written.
void overwriteWithinTheSecond(const std::string& vrt, const std::string& raw)
{
    const auto before = identify(vrt);
    std::fstream file(raw, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(fs::file_size(raw) / 17 * 5 + 20'000));
    file << std::string(std::size_t{3} * 260 * 2, 'x');
    ASSERT_TRUE(file.flush());
    setModified(raw, {1'700'000'000, 600'000'000});
    const auto after = identify(vrt);
    ASSERT_TRUE(before && after && isSameContent(*before, *after)) << "the identity differs";
}

TEST(TiledGeoTiff, PublishesNothingIfTheSourceIsOverwrittenWithinASecond)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    const std::string raw = folder.file("source.raw");
    setModified(raw, {1'700'000'000, 20'000'000});
    const TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    JobMonitor monitor;
    std::jthread writer([&](const std::stop_token& stop) {
        while (!stop.stop_requested() && monitor.fraction() < 0.05) {
            std::this_thread::yield();
        }
        overwriteWithinTheSecond(source, raw);
    });
    const Result<TiledGeoTiffReport> report = writeTiledGeoTiff(job, monitor);
    writer.join();
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, StartsWith(source + ": changed while it was being read"));
    EXPECT_FALSE(fs::exists(job.path));
    expectNothingLeftBeside(job.path);
    prepare(job);
    EXPECT_TRUE(samplesOf(job.path) == samplesOf(source));
}

TEST(TiledGeoTiff, RestartsIfTheSourceWasOverwrittenWithinASecond)
{
    const test::TempFolder folder;
    const std::string source = tallMap(folder, "source");
    const std::string raw = folder.file("source.raw");
    setModified(raw, {1'700'000'000, 20'000'000});
    const TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    ASSERT_FALSE(prepareUntil(job, 0.5));
    ASSERT_TRUE(fs::exists(job.path + ".part.checkpoint"));
    overwriteWithinTheSecond(source, raw);
    const TiledGeoTiffReport report = prepare(job);
    ASSERT_EQ(report.notes.size(), 1U);
    EXPECT_THAT(report.notes[0], HasSubstr("restarted"));
    EXPECT_EQ(report.samples_read, report.samples);
    EXPECT_TRUE(samplesOf(job.path) == samplesOf(source));
}

TEST(TiledGeoTiff, NamesATruncatedSource)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    const test::TempFolder folder;
    const TiledGeoTiffJob job =
        jobFor((test::sharedData() / "derived/megt90n000cb_truncated.lbl").string(),
               folder.file("copy.tif"));
    const Error error = failureOf(job);
    EXPECT_THAT(error.message, StartsWith(job.source));
    EXPECT_THAT(error.message, HasSubstr("cut short"));
    EXPECT_FALSE(fs::exists(job.path));
    expectNothingLeftBeside(job.path);
}

TEST(TiledGeoTiff, RefusesToOverwriteItsSource)
{
    const test::TempFolder folder;
    const std::string source = test::writeRaster(folder, "map.tif", "GTiff",
                                                 test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const std::string vrt =
        test::writeVrt(folder, "other", test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const std::string before = test::readFile(source);
    fs::create_symlink(source, folder.file("symlink.tif"));
    fs::create_hard_link(source, folder.file("hardlink.tif"));
    for (const auto& [from, to] :
         {std::pair{source, source}, std::pair{source, folder.file("symlink.tif")},
          std::pair{source, folder.file("hardlink.tif")},
          std::pair{folder.file("symlink.tif"), source},
          std::pair{vrt, folder.file("other.raw")}}) {
        const Error error = failureOf(jobFor(from, to));
        EXPECT_EQ(error.code, ErrorCode::Invalid);
        EXPECT_THAT(error.message, StartsWith(to + ": belongs to the source map"));
    }
    EXPECT_EQ(test::readFile(source), before);
}

TEST(TiledGeoTiff, ExplainsWhyAFolderIsNotWritable)
{
    const test::TempFolder folder;
    const std::string source =
        test::writeVrt(folder, "source", test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    for (const std::string& path :
         {folder.file("missing/copy.tif"), folder.file("source.raw/copy.tif"),
          std::string("/proc/copy.tif")}) {
        const Error error = failureOf(jobFor(source, path));
        EXPECT_THAT(error.message, StartsWith(path + ": cannot be written"));
        EXPECT_THAT(error.message, HasSubstr("choose another folder"));
    }
}

TEST(TiledGeoTiff, DoesNotTouchAFileThatAnotherProgramIsWriting)
{
    const test::TempFolder folder;
    const std::string source =
        test::writeVrt(folder, "source", test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    Result<std::optional<FileLock>> lock =
        FileLock::tryLock(job.path + ".lock", FileLock::Kind::Exclusive);
    ASSERT_TRUE(lock && *lock);
    const Error error = failureOf(job);
    EXPECT_THAT(error.message, StartsWith(job.path + ": is being prepared by another program"));
    EXPECT_THAT(error.message, HasSubstr(fmt::format("(process {})", getpid())));

    job.when_busy = TiledGeoTiffJob::WhenBusy::Wait;
    JobMonitor canceled;
    canceled.cancel();
    const Result<TiledGeoTiffReport> given_up = writeTiledGeoTiff(job, canceled);
    ASSERT_FALSE(given_up);
    EXPECT_EQ(given_up.error().code, ErrorCode::Canceled);

    JobMonitor monitor;
    auto waiting = std::async(std::launch::async, [&] { return writeTiledGeoTiff(job, monitor); });
    *lock = std::nullopt;
    const Result<TiledGeoTiffReport> report = waiting.get();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(fs::exists(job.path));
    expectNothingLeftBeside(job.path);
}

TEST(TiledGeoTiff, DoesNothingIfTheFileIsUpToDate)
{
    const test::TempFolder folder;
    const std::string source =
        test::writeVrt(folder, "source", test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    TiledGeoTiffJob job = jobFor(source, folder.file("copy.tif"));
    EXPECT_EQ(prepare(job).samples_read, 4U);
    const std::string before = test::readFile(job.path);
    folder.write("copy.tif.part.checkpoint", "of a kill in the moment of publishing");
    const TiledGeoTiffReport again = prepare(job);
    EXPECT_EQ(again.samples_read, 0U);
    EXPECT_EQ(again.bytes, before.size());
    ASSERT_EQ(again.notes.size(), 1U);
    EXPECT_THAT(again.notes[0], HasSubstr("is up to date with its source"));
    EXPECT_EQ(test::readFile(job.path), before);
    expectNothingLeftBeside(job.path);
    job.overrides.nodata = 4.0;
    EXPECT_EQ(prepare(job).samples_read, 4U);
}

TEST(TiledGeoTiff, RemovesMetadataOfTheFileThatItReplaces)
{
    const test::TempFolder folder;
    const std::string source =
        test::writeVrt(folder, "source", test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const std::string path = folder.write("copy.tif", "something else");
    folder.write("copy.tif.aux.xml",
                 "<PAMDataset><PAMRasterBand "
                 "band=\"1\"><NoDataValue>3</NoDataValue></PAMRasterBand></PAMDataset>");
    prepare(jobFor(source, path));
    expectSameMap(source, path);
}

// If a level ends with a tile of a single column or row, that is the last of the raster.
TEST(TiledLayout, NestedLevelsEndWithTheRastersLastSamples)
{
    const test::TempFolder folder;
    for (const auto& [columns, rows] :
         {std::pair<std::size_t, std::size_t>{512, 300}, {513, 512}, {1024, 514}, {1023, 1024}}) {
        std::vector<std::int16_t> samples(columns * rows);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] = static_cast<std::int16_t>(i * 7 % 30011);
        }
        const auto file = RasterFile::open(
            test::writeRaster(folder, "map.tif", "GTiff", test::recipeFor(columns, samples)));
        ASSERT_TRUE(file);
        const auto source = GeotiffTileSource::of(*file, {});
        ASSERT_TRUE(source);
        const TileLayout& layout = (*source)->layout();
        const auto reader = (*source)->open();
        ASSERT_TRUE(reader);
        for (std::uint8_t level = 0; level <= GeotiffTileSource::kLastLevel; ++level) {
            for (std::uint32_t y = 0; y < layout.tileRows(TileKind::Samples, level); ++y) {
                for (std::uint32_t x = 0; x < layout.tileColumns(TileKind::Samples, level); ++x) {
                    const auto tile = (*reader)->read({TileKind::Samples, level, x, y});
                    ASSERT_TRUE(tile) << tile.error().message;
                    tile->samples.visit([&, x, y](auto view) {
                        for (std::size_t j = 0; j < tile->samples.rows(); ++j) {
                            for (std::size_t i = 0; i < tile->samples.columns(); ++i) {
                                const std::size_t column =
                                    std::min((x * kTileSide + i) << level, columns - 1);
                                const std::size_t row =
                                    std::min((y * kTileSide + j) << level, rows - 1);
                                ASSERT_EQ(static_cast<int>(view(i, j)),
                                          static_cast<int>(samples[row * columns + column]));
                            }
                        }
                    });
                }
            }
        }
    }
}

} // namespace
} // namespace marsview
