// Maps prepared in parts against the files of one preparation, byte by byte.
#include "core/levels/level_file.h"
#include "core/prepare/level_builder.h"
#include "core/prepare/parts/join_parts.h"
#include "core/prepare/parts/part_rows.h"
#include "core/prepare/parts/prepare_part.h"
#include "core/prepare/prepare_map.h"
#include "core/prepare/source_rows.h"
#include "core/prepare/tiled_geotiff.h"
#include "core/sources/source_identity.h"
#include "core/tiles/geotiff_tile_source.h"
#include "tests/support/make_raster.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A level file without the time of its raster, and without the checksums that depend on it.
std::string withoutTime(std::string file)
{
    const std::string name = "\"modified_s\":";
    const std::size_t at = file.rfind(name);
    EXPECT_NE(at, std::string::npos);
    for (std::size_t i = at + name.size(); std::isdigit(static_cast<unsigned char>(file[i])) != 0;
         ++i) {
        file[i] = '0';
    }
    std::fill_n(file.begin() + 12, 4, '\0');
    std::fill_n(file.begin() + 60, 4, '\0');
    return file;
}

struct Files {
    std::string raster;
    std::string levels;
};

template <typename T>
std::vector<T> terrain(std::size_t columns, std::size_t rows)
{
    std::vector<T> samples;
    for (std::size_t i = 0; i < columns * rows; ++i) {
        const auto x = static_cast<double>(i % columns);
        const auto y = static_cast<double>(i / columns);
        samples.push_back(static_cast<T>(60.0 + 40.0 * std::sin(0.013 * x + 0.007 * y) +
                                         10.0 * std::sin(0.11 * y) +
                                         static_cast<double>(i * 7919 % 13)));
    }
    return samples;
}

class Parts : public testing::Test {
protected:
    std::string out() const { return folder_.file("map.tif"); }
    std::string partsFolder() const { return out() + ".parts"; }

    Files takeFiles() const
    {
        Files files{test::readFile(out()), withoutTime(test::readFile(LevelFile::pathFor(out())))};
        fs::remove(out());
        fs::remove(LevelFile::pathFor(out()));
        return files;
    }
    Files once(const std::string& source,
               TiledGeoTiffJob::Order order = TiledGeoTiffJob::Order::AsMade) const
    {
        JobMonitor monitor;
        const auto report = prepareMapFiles(*openRaster({.path = source}),
                                            {.raster_path = out(), .order = order}, monitor);
        EXPECT_TRUE(report) << report.error().message;
        return takeFiles();
    }
    Result<PartReport> part(const std::string& source, std::size_t number, std::size_t parts) const
    {
        JobMonitor monitor;
        return preparePart(
            *openRaster({.path = source}),
            {.folder = partsFolder(), .part = number, .parts = parts, .memory = memory_}, monitor);
    }
    Result<JoinReport> join(const std::string& source,
                            std::size_t parts,
                            TiledGeoTiffJob::Order order = TiledGeoTiffJob::Order::AsMade) const
    {
        JobMonitor monitor;
        return joinParts(*openRaster({.path = source}),
                         {.path = out(),
                          .folder = partsFolder(),
                          .parts = parts,
                          .order = order,
                          .memory = memory_},
                         monitor);
    }
    // Who makes the second pass.
    enum class Measured { ByParts, WhileJoining };

    Files joined(const std::string& source,
                 std::size_t parts,
                 Measured measured = Measured::ByParts) const
    {
        for (std::size_t i = 0; i < (measured == Measured::ByParts ? 2 * parts : parts); ++i) {
            const auto report = part(source, i % parts + 1, parts);
            EXPECT_TRUE(report) << report.error().message;
        }
        const auto report = join(source, parts);
        EXPECT_TRUE(report) << report.error().message;
        EXPECT_EQ(report ? report->measured : 0,
                  measured == Measured::ByParts ? 0 : parts - 1); // the last one has not to wait
        EXPECT_FALSE(fs::exists(partsFolder()));
        return report ? takeFiles() : Files{};
    }
    static void expectEqual(const Files& a, const Files& b, const std::string& what)
    {
        EXPECT_TRUE(a.raster == b.raster) << what << ": the rasters differ";
        EXPECT_TRUE(a.levels == b.levels) << what << ": the level files differ";
    }

    // Every array in a scratch file, and a tile at a time.
    static RowMemory inFiles()
    {
        return {.scratch = ScratchPlace{.folder = {}, .bytes_min = 1}, .columns_at_once = 1};
    }

    test::TempFolder folder_;
    RowMemory memory_;
};

template <typename T>
test::RasterRecipe recipeOf(std::size_t columns, std::size_t rows)
{
    return test::recipeFor(columns, terrain<T>(columns, rows));
}

} // namespace

TEST_F(Parts, AreBandsThatCoverAllRowsOnce)
{
    for (std::size_t rows = 1; rows < 40; ++rows) {
        for (std::size_t parts = 1; parts < 50; ++parts) {
            std::size_t next = 0;
            for (std::size_t part = 1; part <= parts; ++part) {
                const PartRows band = rowsOfPart(rows, part, parts);
                EXPECT_EQ(band.first, next);
                EXPECT_LE(band.end - band.first, (rows + parts - 1) / parts);
                next = band.end;
            }
            EXPECT_EQ(next, rows);
        }
    }
}

TEST_F(Parts, BecomeTheBytesOfOnePreparation)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<std::int16_t>(700, 3300));
    const Files whole = once(source);
    for (const std::size_t parts : {1U, 2U, 3U, 5U, 8U, 13U, 20U}) {
        expectEqual(joined(source, parts), whole, std::to_string(parts) + " parts");
    }
}

TEST_F(Parts, BecomeTheSameBytesForEverySampleTypeAndKindOfVoid)
{
    const auto check = [&](const std::string& name, const test::RasterRecipe& recipe) {
        const std::string source = test::writeVrt(folder_, name, recipe);
        const Files whole = once(source);
        memory_ = {};
        expectEqual(joined(source, 3), whole, name);
        memory_ = inFiles();
        expectEqual(joined(source, 3), whole, name + ", in steps of a tile");
    };
    check("bytes", recipeOf<std::uint8_t>(520, 1400));
    check("wide integers", recipeOf<std::int32_t>(520, 1400));
    check("doubles", recipeOf<double>(300, 1400));

    std::vector<std::int16_t> gaps = terrain<std::int16_t>(900, 2900);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const std::size_t row = i / 900;
        const bool is_void =
            (row > 200 && row < 1500 && i % 900 > 300 && i % 900 < 800) || i % 5077 == 0;
        gaps[i] = is_void ? std::int16_t{-9} : gaps[i];
    }
    test::RasterRecipe with_nodata = test::recipeFor(900, gaps);
    with_nodata.band_xml = "<NoDataValue>-9</NoDataValue>";
    check("nodata", with_nodata);

    std::vector<float> holes = terrain<float>(700, 1900);
    for (std::size_t i = 0; i < holes.size(); ++i) {
        holes[i] =
            i / 700 < 600 || i % 31 == 0 ? std::numeric_limits<float>::quiet_NaN() : holes[i];
    }
    check("not a number", test::recipeFor(700, holes));

    test::RasterRecipe masked = test::recipeFor(900, gaps);
    masked.extra_xml =
        "<MaskBand><VRTRasterBand dataType=\"Byte\"><SimpleSource>"
        "<SourceFilename relativeToVRT=\"1\">mask.vrt</SourceFilename>"
        "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></MaskBand>";
    std::vector<std::uint8_t> mask(gaps.size());
    std::transform(gaps.begin(), gaps.end(), mask.begin(), [](std::int16_t sample) {
        return sample == -9 ? std::uint8_t{0} : std::uint8_t{255};
    });
    test::writeVrt(folder_, "mask", test::recipeFor(900, mask));
    check("masked", masked);
}

// As for maps of a million columns: everything as wide as the map in files, a tile at a time.
TEST_F(Parts, BecomeTheSameBytesInStepsOfATile)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<std::int16_t>(1900, 2200));
    const Files whole = once(source);
    memory_ = inFiles();
    for (const std::size_t parts : {1U, 9U}) {
        expectEqual(joined(source, parts), whole, std::to_string(parts) + " parts");
    }
    expectEqual(joined(source, 4, Measured::WhileJoining), whole, "measured while joining");
}

TEST_F(Parts, ReadTheSameRowsInPieces)
{
    const std::vector<float> samples = terrain<float>(1300, 700);
    const std::string strips = test::writeVrt(folder_, "map", test::recipeFor(1300, samples));
    JobMonitor monitor;
    const std::string tiles = folder_.file("tiles.tif");
    ASSERT_TRUE(writeTiledGeoTiff({.source = strips, .path = tiles}, monitor));
    for (const std::string& path : {strips, tiles}) {
        Result<OpenRaster> raster = openRaster({.path = path});
        ASSERT_TRUE(raster);
        RowMemory memory = inFiles();
        memory.scratch->folder = folder_.path();
        SourceRows pieces(raster->file, raster->info, memory);
        std::size_t next = 0;
        const auto compare = [&](const SampleGrid& grid, std::size_t grid_row,
                                 std::size_t tile_row) -> Status {
            EXPECT_EQ(tile_row, next++);
            EXPECT_TRUE(grid.isInFile());
            for (std::size_t row = 0; row < std::min<std::size_t>(256, 700 - tile_row * 256);
                 ++row) {
                for (std::size_t column = 0; column < 1300; ++column) {
                    const std::size_t i = (tile_row * 256 + row) * 1300 + column;
                    EXPECT_EQ(grid.raw(column, grid_row + row), samples[i]);
                }
            }
            return Done{};
        };
        ASSERT_TRUE(pieces.each(0, 3, compare));
        EXPECT_EQ(next, 3U);
        EXPECT_EQ(pieces.samplesRead(), 1300U * 700U);
    }
}

// More than 256 rows of tiles: overviews that no part can make, because their pixels lie in tiles
// of several parts.
TEST_F(Parts, ShareTheCoarsestOverviews)
{
    const std::string source = test::writeVrt(folder_, "tall", recipeOf<std::int16_t>(40, 140'000));
    const Files whole = once(source);
    expectEqual(joined(source, 7), whole, "7 parts");
    // More files than a program may have open without asking for more.
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit few = before;
    few.rlim_cur = 200;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    expectEqual(joined(source, 300, Measured::WhileJoining), whole, "300 parts");
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
}

TEST_F(Parts, MayBeMadeInAnyOrderTwiceAndMeasuredBeforehand)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<float>(700, 3300));
    const Files whole = once(source);
    for (const std::size_t number : {3U, 1U, 4U}) {
        const auto report = part(source, number, 4);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_TRUE(report->is_copied);
        EXPECT_FALSE(report->is_measured);
    }
    EXPECT_THAT(part(source, 3, 4)->awaited, ElementsAre(2));
    EXPECT_FALSE(part(source, 3, 4)->is_copied);
    const auto last = part(source, 2, 4);
    ASSERT_TRUE(last) << last.error().message;
    EXPECT_THAT(last->awaited, IsEmpty());
    EXPECT_TRUE(last->is_measured); // nothing to wait for
    ASSERT_TRUE(part(source, 4, 4)->is_measured);
    EXPECT_FALSE(part(source, 4, 4)->is_copied);
    const auto report = join(source, 4);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->measured, 2U); // 1 and 3
    expectEqual(takeFiles(), whole, "two parts measured beforehand");
}

TEST_F(Parts, AreNamedIfTheyAreMissingDamagedOrOfAnotherSource)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<std::int16_t>(700, 3300));
    for (const std::size_t number : {1U, 2U, 5U}) {
        ASSERT_TRUE(part(source, number, 5));
    }
    const auto lacking = join(source, 5);
    ASSERT_FALSE(lacking);
    EXPECT_THAT(lacking.error().message, HasSubstr("lacks 2 of 5 parts: 3, 4"));
    EXPECT_FALSE(fs::exists(out()));

    for (const std::size_t number : {3U, 4U}) {
        ASSERT_TRUE(part(source, number, 5));
    }
    const std::string survey = partsFolder() + "/4-of-5.survey";
    std::string content = test::readFile(survey);
    content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
    std::ofstream(survey, std::ios::binary) << content;
    EXPECT_THAT(join(source, 5).error().message, HasSubstr("lacks 1 of 5 parts: 4"));
    ASSERT_TRUE(part(source, 4, 5)->is_copied);

    const std::string raster = partsFolder() + "/2-of-5.tiles";
    content = test::readFile(raster);
    content[content.size() - 10] = static_cast<char>(content[content.size() - 10] ^ 1);
    std::ofstream(raster, std::ios::binary) << content;
    const auto damaged = join(source, 5);
    ASSERT_FALSE(damaged);
    EXPECT_THAT(damaged.error().message, HasSubstr("2-of-5.tiles"));
    EXPECT_THAT(damaged.error().message, HasSubstr("prepare part 2 again"));
    EXPECT_FALSE(fs::exists(out()));

    const std::string other = test::writeVrt(folder_, "other", recipeOf<std::int16_t>(700, 3301));
    EXPECT_THAT(join(other, 5).error().message, HasSubstr("was made from another source"));
}

// A disk or a network may change bytes and keep the size. Each file of a part is damaged in turn.
TEST_F(Parts, AreMadeAgainWhereTheirFilesAreDamaged)
{
    // With voids, for fills.
    std::vector<float> holes = terrain<float>(900, 1100);
    for (std::size_t i = 0; i < holes.size(); ++i) {
        const bool is_void = i / 900 > 300 && i / 900 < 800 && i % 900 < 500;
        holes[i] = is_void ? std::numeric_limits<float>::quiet_NaN() : holes[i];
    }
    const std::string source = test::writeVrt(folder_, "map", test::recipeFor(900, holes));
    constexpr std::size_t kBlocks = 500; // others are on the disk
    const auto make = [&](std::size_t number) {
        JobMonitor monitor;
        return preparePart(
            *openRaster({.path = source}),
            {.folder = partsFolder(), .part = number, .parts = 2, .mean_blocks_max = kBlocks},
            monitor);
    };
    for (const std::size_t number : {1U, 2U, 1U, 2U}) {
        ASSERT_TRUE(make(number));
    }
    const std::string name = partsFolder() + "/1-of-2.";
    for (const char* ending :
         {"tiles", "levels", "survey", "means", "border", "edges", "fills", "errors"}) {
        const std::string whole = test::readFile(name + ending);
        ASSERT_FALSE(whole.empty()) << ending;
        std::string damaged = whole;
        const std::size_t at = whole.size() * 3 / 4;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        std::ofstream(name + ending, std::ios::binary) << damaged;
        const auto again = make(1);
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_TRUE(again->is_measured) << ending;
        const std::string of_measuring = "fills errors";
        EXPECT_EQ(again->is_copied, of_measuring.find(ending) == std::string::npos) << ending;
        EXPECT_TRUE(test::readFile(name + ending) == whole) << ending;
    }
    EXPECT_FALSE(make(1)->is_copied);
}

// Otherwise the parts of a large map would read as much as all of them have.
TEST_F(Parts, AreMeasuredWithoutTheSurveysOfOthers)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<std::int16_t>(700, 3300));
    const Files whole = once(source);
    for (std::size_t number = 1; number <= 5; ++number) {
        ASSERT_TRUE(part(source, number, 5));
    }
    const auto survey = [this](std::size_t number) {
        return partsFolder() + "/" + std::to_string(number) + "-of-5.survey";
    };
    for (std::size_t number = 1; number < 5; ++number) {
        std::vector<std::string> others;
        for (std::size_t other = 1; other <= 5; ++other) {
            others.push_back(test::readFile(survey(other)));
            if (other != number) {
                std::ofstream(survey(other), std::ios::binary) << "unread";
            }
        }
        const auto report = part(source, number, 5);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_TRUE(report->is_measured);
        for (std::size_t other = 1; other <= 5; ++other) {
            std::ofstream(survey(other), std::ios::binary) << others[other - 1];
        }
    }
    const auto report = join(source, 5);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->measured, 0U);
    expectEqual(takeFiles(), whole, "measured without the surveys of others");
}

// As on maps with voids whose finest means do not fit in memory.
TEST_F(Parts, FillVoidsFromMeansOnTheDisk)
{
    std::vector<float> holes = terrain<float>(900, 2900);
    for (std::size_t i = 0; i < holes.size(); ++i) {
        const bool is_void = (i / 900 > 400 && i / 900 < 2100 && i % 900 < 500) || i % 37 == 0;
        holes[i] = is_void ? std::numeric_limits<float>::quiet_NaN() : holes[i];
    }
    const std::string source = test::writeVrt(folder_, "map", test::recipeFor(900, holes));
    constexpr std::size_t kBlocks = 500;
    JobMonitor monitor;
    for (const std::size_t number : {1U, 2U, 3U, 4U, 2U, 3U}) {
        ASSERT_TRUE(preparePart(
            *openRaster({.path = source}),
            {.folder = partsFolder(), .part = number, .parts = 4, .mean_blocks_max = kBlocks},
            monitor));
    }
    ASSERT_TRUE(joinParts(
        *openRaster({.path = source}),
        {.path = out(), .folder = partsFolder(), .parts = 4, .mean_blocks_max = kBlocks}, monitor));
    EXPECT_FALSE(fs::exists(partsFolder()));

    const Result<OpenRaster> raster = openRaster({.path = out()});
    ASSERT_TRUE(raster);
    const auto tiles = GeotiffTileSource::of(raster->file, raster->voids());
    ASSERT_TRUE(tiles);
    const std::string alone = folder_.file("alone.marsview");
    ASSERT_TRUE(buildLevelFile({.source = tiles->get(),
                                .scale = raster->info.elevationScale(),
                                .key = {.raster = *identify(out(), OverviewFiles::Counted),
                                        .band = 1,
                                        .nodata = raster->info.nodata},
                                .path = alone,
                                .mean_blocks_max = kBlocks},
                               monitor));
    EXPECT_TRUE(test::readFile(alone) == test::readFile(LevelFile::pathFor(out())));
}

TEST_F(Parts, CanBeJoinedWithTheOverviewsFirst)
{
    const std::string source = test::writeVrt(folder_, "map", recipeOf<std::int16_t>(700, 3300));
    const Files whole = once(source, TiledGeoTiffJob::Order::OverviewsFirst);
    for (const std::size_t number : {1U, 2U, 3U}) {
        ASSERT_TRUE(part(source, number, 3));
    }
    ASSERT_TRUE(join(source, 3, TiledGeoTiffJob::Order::OverviewsFirst));
    expectEqual(takeFiles(), whole, "overviews first");
}

} // namespace marsview
