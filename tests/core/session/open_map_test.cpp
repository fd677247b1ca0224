#include "core/levels/level_file.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/prepare_map.h"
#include "core/session/map_opening.h"
#include "core/session/open_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

constexpr std::size_t kColumns = 700;
constexpr std::size_t kRows = 1300;

double heightAt(std::size_t column, std::size_t row)
{
    return std::floor(300.0 * std::sin(0.01 * static_cast<double>(column)) +
                      static_cast<double>(row * 7919 % 13));
}

// Maps that are always tiled, prepared in a separate folder.
class OpenMap : public testing::Test {
protected:
    OpenMap()
    {
        resources_.tiles = std::make_shared<TileCache>(
            TileCacheOptions{.bytes_max = std::size_t{64} << 20, .loader_threads = 2});
        resources_.held_bytes_max = 0;
        resources_.folder = maps_.path();
        std::vector<std::int16_t> samples;
        for (std::size_t row = 0; row < kRows; ++row) {
            for (std::size_t column = 0; column < kColumns; ++column) {
                samples.push_back(static_cast<std::int16_t>(heightAt(column, row)));
            }
        }
        source_ = test::writeVrt(folder_, "map", test::recipeFor(kColumns, samples));
    }

    // A raster that can be used in place, with its overviews in a separate file; uncompressed, so
    // that damaged bytes give wrong elevations without an error.
    std::string tiled() const
    {
        const std::string path = folder_.file("tiled.tif");
        test::runTool({"gdal_translate", "-q", "-co", "TILED=YES", source_, path});
        addOverviews(path, "average");
        return path;
    }
    static void addOverviews(const std::string& path, const std::string& how)
    {
        fs::remove(path + ".ovr");
        test::runTool({"gdaladdo", "-q", "-ro", "-r", how, path, "2", "4"});
    }

    Result<std::shared_ptr<const Map>> open(const std::string& path)
    {
        JobMonitor monitor;
        return openMap({.path = path}, resources_, monitor);
    }
    Result<MapOpening> begin(const std::string& path) const
    {
        return MapOpening::begin(openRaster({.path = path}).value(), resources_);
    }
    void prepare(const std::string& path) const
    {
        JobMonitor monitor;
        const auto prepared = prepareMapFiles(*openRaster({.path = path}), {}, monitor);
        ASSERT_TRUE(prepared) << prepared.error().message;
    }

    // The number of unreadable tiles of the finest level; checks that all others are correct.
    static std::size_t unreadable(const std::shared_ptr<const Map>& map)
    {
        std::size_t count = 0;
        for (std::uint32_t row = 0; row * kTileSide < kRows; ++row) {
            for (std::uint32_t column = 0; column * kTileSide < kColumns; ++column) {
                const std::size_t c = column * kTileSide;
                const std::size_t r = row * kTileSide;
                const Heightfield& heightfield = map->heightfield();
                if (!heightfield.isTiled()) {
                    EXPECT_EQ(heightfield.sample(c, r), heightAt(c, r));
                } else if (const auto tile = heightfield.tiles()->raster().get(
                               {TileKind::Samples, 0, column, row})) {
                    EXPECT_EQ((*tile)->samples.raw(0, 0), heightAt(c, r));
                } else {
                    ++count;
                }
            }
        }
        return count;
    }

    // Keeps the size and the time of the file.
    static void damage(const std::string& path, double share, std::size_t bytes = 50)
    {
        const fs::file_time_type time = fs::last_write_time(path);
        std::string content = test::readFile(path);
        const auto at = static_cast<std::size_t>(share * static_cast<double>(content.size()));
        for (std::size_t i = at; i < std::min(at + bytes, content.size()); ++i) {
            content[i] = static_cast<char>(content[i] ^ 0x5A);
        }
        std::ofstream(path, std::ios::binary) << content;
        fs::last_write_time(path, time);
    }

    std::string keptPath(const std::string& path) const
    {
        return preparedPathFor(*openRaster({.path = path}), maps_.path()).value();
    }

    test::TempFolder folder_;
    test::TempFolder maps_;
    MapResources resources_;
    std::string source_;
};

} // namespace

TEST_F(OpenMap, RebuildsACopyInWhichATileWasFoundDamaged)
{
    const std::string kept = keptPath(source_);
    std::size_t noticed_late = 0;
    for (const double share : {0.15, 0.25, 0.3, 0.37, 0.45, 0.53, 0.6, 0.68, 0.75}) {
        {
            const Result<std::shared_ptr<const Map>> map = open(source_);
            ASSERT_TRUE(map) << map.error().message;
            ASSERT_EQ(unreadable(*map), 0U);
        }
        damage(kept, share);
        {
            const Result<std::shared_ptr<const Map>> map = open(source_);
            ASSERT_TRUE(map) << map.error().message;
            if (unreadable(*map) == 0) {
                continue; // the damage was detected on opening
            }
            ++noticed_late;
            EXPECT_TRUE(MapFolder::at(maps_.path()).damage(kept));
            EXPECT_EQ(begin(source_)->storage(), MapStorage::NeedsOverviews);
        }
        const Result<std::shared_ptr<const Map>> map = open(source_);
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_EQ(unreadable(*map), 0U);
        EXPECT_FALSE(MapFolder::at(maps_.path()).damage(kept));
    }
    EXPECT_GT(noticed_late, 0U);
}

TEST_F(OpenMap, RebuildsADamagedCopyThatIsStillOpen)
{
    Result<std::shared_ptr<const Map>> first = open(source_);
    ASSERT_TRUE(first);
    MapFolder::at(maps_.path()).noteDamage(keptPath(source_), "a tile is torn; open it again");
    const Result<std::shared_ptr<const Map>> second = open(source_);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_EQ(unreadable(*second), 0U);
    EXPECT_FALSE(MapFolder::at(maps_.path()).damage(keptPath(source_)));
}

TEST_F(OpenMap, NeverReadsAWrongHeightWhileAnotherProgramRebuildsTheCopy)
{
    const std::string kept = keptPath(source_);
    Result<std::shared_ptr<const Map>> first = open(source_);
    std::size_t damaged = 0;
    for (const double share : {0.15, 0.25, 0.3, 0.37, 0.45, 0.53, 0.6, 0.68, 0.75}) {
        ASSERT_TRUE(first) << first.error().message;
        first = Error{ErrorCode::Canceled, "closed"};
        damage(kept, share);
        first = open(source_);
        ASSERT_TRUE(first) << first.error().message;
        damaged = unreadable(*first);
        if (damaged > 0) {
            break; // otherwise the damage was detected on opening, and the copy rebuilt
        }
    }
    ASSERT_GT(damaged, 0U);
    ASSERT_TRUE(MapFolder::at(maps_.path()).damage(kept));
    MapResources of_another_program = resources_;
    of_another_program.tiles = std::make_shared<TileCache>(TileCacheOptions{});
    JobMonitor monitor;
    const Result<std::shared_ptr<const Map>> second =
        openMap({.path = source_}, of_another_program, monitor);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_EQ(unreadable(*second), 0U);
    // Every tile that the first map still reads is correct (unreadable() checks that), through open
    // readers and through new ones.
    for (int i = 0; i < 3; ++i) {
        resources_.tiles->clear();
        unreadable(*first);
    }
    EXPECT_FALSE(MapFolder::at(maps_.path()).damage(kept)) << "the new one is none";
    const Result<std::shared_ptr<const Map>> again = open(source_);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(unreadable(*again), 0U);
}

TEST_F(OpenMap, ReportsInvalidNumbersInTheEnvironmentOnce)
{
    const std::string tiff =
        test::writeRaster(folder_, "small.tif", "GTiff",
                          test::recipeFor(4, std::vector<std::int16_t>{1, 2, 3, 4, 5, 6, 7, 8}));
    for (const char* text : {"abc", "-1", "1e12", "12 MB"}) {
        ASSERT_EQ(setenv("MARSVIEW_HELD_MB", text, 1), 0); // NOLINT(concurrency-mt-unsafe)
        MapResources resources = defaultMapResources();
        ASSERT_EQ(unsetenv("MARSVIEW_HELD_MB"), 0); // NOLINT(concurrency-mt-unsafe)
        resources.folder = maps_.path();
        EXPECT_EQ(resources.held_bytes_max, defaultMapResources().held_bytes_max);
        JobMonitor monitor;
        const auto first = openMap({.path = tiff}, resources, monitor);
        const auto second = openMap({.path = tiff}, resources, monitor);
        ASSERT_TRUE(first && second);
        const auto sentence =
            HasSubstr(std::string("MARSVIEW_HELD_MB is \"") + text + "\", not a number");
        EXPECT_THAT((*first)->info().notices, testing::Contains(sentence));
        EXPECT_THAT((*second)->info().notices, testing::Not(testing::Contains(sentence)));
    }
    EXPECT_TRUE(defaultMapResources().notices->take().empty());
}

TEST_F(OpenMap, NeverRebuildsTheLevelsOfADamagedRaster)
{
    const std::string path = tiled();
    {
        const Result<std::shared_ptr<const Map>> map = open(path); // its levels lie in the folder
        ASSERT_TRUE(map) << map.error().message;
        ASSERT_EQ(unreadable(*map), 0U);
    }
    const std::string levels = LevelFile::pathFor(keptPath(path));
    ASSERT_TRUE(fs::exists(levels));
    const std::string before = test::readFile(levels);
    damage(path, 0.5, 4000);
    for (int attempt = 0; attempt < 2; ++attempt) {
        const Result<std::shared_ptr<const Map>> map = open(path);
        if (map) {
            EXPECT_GT(unreadable(*map), 0U);
        } else {
            EXPECT_THAT(map.error().message, HasSubstr("restore or fetch it again"));
        }
        EXPECT_TRUE(test::readFile(levels) == before);
    }
}

TEST_F(OpenMap, RebuildsLevelsIfTheOverviewsNextToTheRasterChanged)
{
    const std::string path = tiled();
    prepare(path);
    EXPECT_EQ(begin(path)->levelPath(), LevelFile::pathFor(path));
    addOverviews(path, "nearest");
    const Result<MapOpening> outdated = begin(path);
    ASSERT_TRUE(outdated);
    EXPECT_EQ(outdated->storage(), MapStorage::NeedsOverviews);
    EXPECT_THAT(outdated->notices(),
                Contains(HasSubstr("its level file is not used: it was built from another")));
    {
        const Result<std::shared_ptr<const Map>> map = open(path); // with levels in the folder
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_EQ(unreadable(*map), 0U);
        EXPECT_THAT((*map)->info().notices, Contains(HasSubstr("is not used")));
    }
    prepare(path);
    EXPECT_EQ(begin(path)->levelPath(), LevelFile::pathFor(path));
    EXPECT_TRUE(begin(path)->notices().empty());
    const Result<std::shared_ptr<const Map>> map = open(path);
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(unreadable(*map), 0U);
}

// The opener would take it for another raster, and would show the damage as terrain.
TEST_F(OpenMap, RefusesAChangedRasterWithAnUnchangedTime)
{
    const std::string path = tiled();
    const auto time = fs::last_write_time(path) - std::chrono::hours(1);
    fs::last_write_time(path, time);
    fs::last_write_time(path + ".ovr", time);
    prepare(path);
    std::string bytes = test::readFile(path);
    for (std::size_t i = bytes.size() - 64; i < bytes.size(); ++i) {
        bytes[i] = static_cast<char>(~bytes[i]);
    }
    std::ofstream(path, std::ios::binary) << bytes;
    fs::last_write_time(path, time);
    for (const std::size_t held_bytes_max : {std::size_t{0}, std::size_t{1} << 30}) {
        resources_.held_bytes_max = held_bytes_max;
        const Result<MapOpening> refused = begin(path);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Damaged);
        EXPECT_THAT(refused.error().message, HasSubstr("remove " + LevelFile::pathFor(path)));
    }
    fs::remove(LevelFile::pathFor(path));
    EXPECT_TRUE(begin(path));
}

TEST_F(OpenMap, ExplainsWhyALevelFileNextToTheRasterIsNotUsed)
{
    const std::string path = tiled();
    prepare(path);
    const std::string levels = LevelFile::pathFor(path);
    const std::string good = test::readFile(levels);
    std::string of_another_version = good;
    of_another_version[8] = 9;
    const std::vector<std::pair<std::string, std::string>> cases{
        {good.substr(0, 1000), "cut short"},
        {of_another_version, "is of version 9"},
        {"hello, this is not a level file, whatever it may be called by its name",
         "is not a level file"},
        {"", "has only 0 bytes"}};
    for (const auto& [content, why] : cases) {
        std::ofstream(levels, std::ios::binary) << content;
        for (const std::size_t held_bytes_max : {std::size_t{0}, std::size_t{1} << 30}) {
            resources_.held_bytes_max = held_bytes_max;
            const Result<std::shared_ptr<const Map>> map = open(path);
            ASSERT_TRUE(map) << map.error().message;
            EXPECT_THAT((*map)->info().notices, Contains(HasSubstr(why)));
            EXPECT_EQ(unreadable(*map), 0U);
        }
    }
}

TEST_F(OpenMap, KeepsTheLevelsOfAMapUsedInPlaceWhileItIsOpen)
{
    const std::string path = tiled();
    const MapFolder folder = MapFolder::at(maps_.path());
    {
        const Result<std::shared_ptr<const Map>> map = open(path);
        ASSERT_TRUE(map) << map.error().message;
        ASSERT_EQ(folder.list()->size(), 1U);
        EXPECT_TRUE(folder.list()->front().is_in_use);
        EXPECT_TRUE(folder.trim(0)->empty());
        EXPECT_EQ(unreadable(*map), 0U);
    }
    EXPECT_EQ(folder.trim(0)->size(), 1U);
}

TEST_F(OpenMap, ReadsAMapIntoMemoryWithoutAFolderOfPreparedMaps)
{
    MapResources resources;
    const Result<MapOpening> opening =
        MapOpening::begin(openRaster({.path = source_}).value(), resources);
    ASSERT_TRUE(opening) << opening.error().message;
    EXPECT_EQ(opening->storage(), MapStorage::InMemory);
}

// A small archive may unpack to more than memory.
TEST_F(OpenMap, ReadsNoLargeMapOfAnArchiveIntoMemory)
{
    const std::string path = folder_.file("large.tif");
    test::runTool({"gdal_create", "-q", "-of", "GTiff", "-outsize", "30000", "20000", "-ot",
                   "Int16", "-co", "SPARSE_OK=TRUE", "-co", "TILED=YES", path});
    test::runTool({"python3", "-c",
                   "import sys,zipfile\n"
                   "zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)"
                   ".write(sys.argv[2], 'large.tif')",
                   folder_.file("large.zip"), path});
    MapResources resources;
    resources.held_bytes_max = std::size_t{1} << 40;
    const Result<MapOpening> file =
        MapOpening::begin(openRaster({.path = path}).value(), resources);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->storage(), MapStorage::InMemory);
    const Result<MapOpening> packed =
        MapOpening::begin(openRaster({.path = folder_.file("large.zip")}).value(), resources);
    ASSERT_TRUE(packed) << packed.error().message;
    EXPECT_EQ(packed->storage(), MapStorage::NeedsOverviews);
}

TEST_F(OpenMap, RefusesARasterThatIsNotASurfaceBeforePreparingIt)
{
    for (const std::size_t columns : {1U, 600U}) {
        const std::string path = test::writeVrt(
            folder_, "line", test::recipeFor(columns, std::vector<std::int16_t>(600, 5)));
        const Result<MapOpening> refused = begin(path);
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message,
                    HasSubstr("samples are not a surface; at least 2 × 2 are needed"));
        JobMonitor monitor;
        const auto prepared = prepareMapFiles(*openRaster({.path = path}),
                                              {.raster_path = folder_.file("out.tif")}, monitor);
        ASSERT_FALSE(prepared);
        EXPECT_EQ(prepared.error().message, refused.error().message);
        EXPECT_FALSE(fs::exists(folder_.file("out.tif")));
    }
    EXPECT_TRUE(fs::is_empty(maps_.path()));
}

} // namespace marsview
