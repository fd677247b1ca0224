#include "core/prepare/map_folder.h"
#include "core/prepare/tiled_geotiff.h"
#include "tests/support/make_raster.h"
#include "tests/support/scoped_variable.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

MapFolder folderAt(const fs::path& path)
{
    Result<MapFolder> folder = MapFolder::open(path);
    EXPECT_TRUE(folder) << folder.error().message;
    return std::move(folder).value();
}

// A map of `bytes`, last used `age` ago.
void addMap(const test::TempFolder& folder,
            const std::string& name,
            std::size_t bytes,
            std::chrono::hours age)
{
    const fs::file_time_type time = fs::file_time_type::clock::now() - age;
    for (const std::string& file : {folder.write(name + ".map.tif", std::string(bytes, 'x')),
                                    folder.write(name + ".map.tif.levels", std::string(10, 'x'))}) {
        fs::last_write_time(file, time);
    }
}

std::vector<std::string> namesIn(const MapFolder& folder)
{
    Result<std::vector<PreparedMap>> maps = folder.list();
    EXPECT_TRUE(maps);
    std::vector<std::string> names;
    for (const PreparedMap& map : *maps) {
        names.push_back(map.name);
    }
    return names;
}

} // namespace

TEST(MapFolder, FollowsTheEnvironment)
{
    const test::ScopedVariable home("HOME", "/home/someone");
    const test::ScopedVariable cache("XDG_CACHE_HOME", nullptr);
    const test::ScopedVariable chosen("MARSVIEW_CACHE_DIR", nullptr);
    EXPECT_EQ(MapFolder::defaultPath(), "/home/someone/.cache/marsview/maps");
    const test::ScopedVariable other_cache("XDG_CACHE_HOME", "/var/caches");
    EXPECT_EQ(MapFolder::defaultPath(), "/var/caches/marsview/maps");
    const test::ScopedVariable other_folder("MARSVIEW_CACHE_DIR", "/big/disk");
    EXPECT_EQ(MapFolder::defaultPath(), "/big/disk");
}

TEST(MapFolder, IsATemporaryOneForTests)
{
    const fs::path temporary = fs::temp_directory_path();
    const fs::path folder = MapFolder::defaultPath();
    EXPECT_EQ(std::mismatch(temporary.begin(), temporary.end(), folder.begin(), folder.end()).first,
              temporary.end())
        << folder;
}

TEST(MapFolder, IsCreatedIfMissing)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path() / "a" / "b");
    EXPECT_TRUE(fs::is_directory(temp.path() / "a" / "b"));
    EXPECT_TRUE(namesIn(folder).empty());
    EXPECT_GT(folder.defaultBytesMax(), 0U);
    EXPECT_LE(folder.defaultBytesMax(), 100'000'000'000U);
}

TEST(MapFolder, NamesTheProblemOfAnUnusableFolder)
{
    const test::TempFolder temp;
    const std::string file = temp.write("file", "x");
    for (const fs::path& path :
         {fs::path(file), fs::path(file) / "below", fs::path("/proc/maps")}) {
        const Result<MapFolder> folder = MapFolder::open(path);
        ASSERT_FALSE(folder) << path;
        EXPECT_THAT(folder.error().message, testing::StartsWith(path.string()));
        EXPECT_THAT(folder.error().message, HasSubstr("MARSVIEW_CACHE_DIR"));
    }
}

TEST(MapFolder, GivesEveryContentAndBandItsOwnName)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    const SourceIdentity source{"/data/Mars 200m.lbl", 1000, 77, "0123456789abcdef"};
    SourceIdentity moved = source;
    moved.path = "/elsewhere/Mars 200m.lbl";
    EXPECT_EQ(folder.pathFor(source, 1), folder.pathFor(moved, 1));
    EXPECT_THAT(folder.pathFor(source, 1), HasSubstr("Mars_200m-0123456789abcdef"));
    SourceIdentity grown = source;
    grown.bytes += 1;
    SourceIdentity later = source;
    later.modified_s += 1;
    SourceIdentity other = source;
    other.digest = "1123456789abcdef";
    const std::set<std::string> paths{
        folder.pathFor(source, 1), folder.pathFor(source, 2),
        folder.pathFor(grown, 1),  folder.pathFor(later, 1),
        folder.pathFor(other, 1),  folder.pathFor(source, 1, "nodata 0")};
    EXPECT_EQ(paths.size(), 6U);
}

TEST(MapFolder, ListsMapsWithTheirSources)
{
    const test::TempFolder temp;
    const test::TempFolder maps;
    const std::string source = test::writeRaster(temp, "little.tif", "GTiff",
                                                 test::recipeFor<std::int16_t>(2, {1, 2, 3, 4}));
    const MapFolder folder = folderAt(maps.path());
    const Result<SourceIdentity> identity = identify(source);
    ASSERT_TRUE(identity);
    TiledGeoTiffJob job;
    job.source = source;
    job.path = folder.pathFor(*identity, 1);
    JobMonitor monitor;
    ASSERT_TRUE(writeTiledGeoTiff(job, monitor));
    maps.write(fs::path(job.path).filename().string() + ".levels", std::string(100, 'x'));
    maps.write("unrelated.txt", "x");
    const Result<std::vector<PreparedMap>> list = folder.list();
    ASSERT_TRUE(list);
    ASSERT_EQ(list->size(), 1U);
    EXPECT_EQ(list->front().path, job.path);
    EXPECT_EQ(list->front().source, source);
    EXPECT_EQ(list->front().bytes, fs::file_size(job.path) + 100);
    EXPECT_FALSE(list->front().is_in_use);
}

TEST(MapFolder, OrdersMapsByLastUse)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "old", 100, std::chrono::hours(3));
    addMap(temp, "new", 100, std::chrono::hours(2));
    EXPECT_THAT(namesIn(folder), ElementsAre("new.map.tif", "old.map.tif"));
    const fs::file_time_type written = fs::last_write_time(temp.file("old.map.tif"));
    {
        const Result<FileLock> use = folder.use(temp.file("old.map.tif"));
        ASSERT_TRUE(use) << use.error().message;
        EXPECT_THAT(namesIn(folder), ElementsAre("old.map.tif", "new.map.tif"));
    }
    EXPECT_THAT(namesIn(folder), ElementsAre("old.map.tif", "new.map.tif"));
    EXPECT_EQ(fs::last_write_time(temp.file("old.map.tif")), written); // part of its identity
}

TEST(MapFolder, RemovesTheLeastRecentlyUsedMapsThatAreNotOpen)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "a", 990, std::chrono::hours(4));
    addMap(temp, "b", 990, std::chrono::hours(3));
    addMap(temp, "c", 990, std::chrono::hours(2));
    addMap(temp, "d", 990, std::chrono::hours(1));
    const fs::file_time_type before = fs::last_write_time(temp.file("a.map.tif"));
    const Result<FileLock> use = folder.use(temp.file("a.map.tif"));
    ASSERT_TRUE(use);
    fs::last_write_time(temp.file("a.map.tif.use"), before); // last used long ago, but still open
    const Result<std::vector<PreparedMap>> removed = folder.trim(2500);
    ASSERT_TRUE(removed);
    ASSERT_EQ(removed->size(), 2U);
    EXPECT_EQ(removed->at(0).name, "b.map.tif");
    EXPECT_EQ(removed->at(1).name, "c.map.tif");
    EXPECT_THAT(namesIn(folder), ElementsAre("d.map.tif", "a.map.tif"));
    EXPECT_FALSE(fs::exists(temp.file("b.map.tif.levels")));
    EXPECT_FALSE(fs::exists(temp.file("b.map.tif.use")));
    EXPECT_TRUE(folder.trim(2500)->empty());
}

TEST(MapFolder, KeepsMapsThatAreInUseOrBeingPrepared)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "used", 100, std::chrono::hours(2));
    addMap(temp, "made", 100, std::chrono::hours(2));
    const Result<FileLock> use = folder.use(temp.file("used.map.tif"));
    const Result<std::optional<FileLock>> work =
        FileLock::tryLock(temp.file("made.map.tif.lock"), FileLock::Kind::Exclusive);
    ASSERT_TRUE(use && work && *work);
    const Result<std::vector<PreparedMap>> maps = folder.list();
    ASSERT_TRUE(maps);
    for (const PreparedMap& map : *maps) {
        EXPECT_TRUE(map.is_in_use) << map.name;
        const Status removed = folder.remove(map.name);
        ASSERT_FALSE(removed);
        EXPECT_THAT(removed.error().message, HasSubstr("is in use"));
    }
    EXPECT_TRUE(folder.trim(0)->empty());
    EXPECT_EQ(namesIn(folder).size(), 2U);
}

TEST(MapFolder, KeepsTheLevelsOfARasterThatIsUsedInPlace)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    temp.write("old.map.tif.marsview", std::string(100, 'x'));
    fs::last_write_time(temp.file("old.map.tif.marsview"),
                        fs::file_time_type::clock::now() - std::chrono::hours(5));
    addMap(temp, "new", 100, std::chrono::hours(1));
    {
        const Result<FileLock> use = folder.use(temp.file("old.map.tif"));
        ASSERT_TRUE(use) << use.error().message;
        EXPECT_THAT(namesIn(folder), ElementsAre("old.map.tif", "new.map.tif"));
        EXPECT_EQ(folder.trim(0)->size(), 1U);
        EXPECT_TRUE(fs::exists(temp.file("old.map.tif.marsview")));
    }
    EXPECT_EQ(folder.trim(0)->size(), 1U);
    EXPECT_TRUE(fs::is_empty(temp.path()));
}

TEST(MapFolder, RemembersDamageUntilTheMapIsRebuilt)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "a", 100, std::chrono::hours(1));
    const std::string path = temp.file("a.map.tif");
    EXPECT_FALSE(folder.damage(path));
    EXPECT_TRUE(folder.noteDamage(path, "a tile is torn"));
    EXPECT_EQ(folder.damage(path), "a tile is torn");
    EXPECT_EQ(namesIn(folder).size(), 1U);
    folder.forgetDamage(path);
    EXPECT_FALSE(folder.damage(path));
    EXPECT_TRUE(folder.noteDamage(path, "a tile is torn"));
    EXPECT_TRUE(folder.remove("a.map.tif"));
    EXPECT_TRUE(fs::is_empty(temp.path()));
    EXPECT_FALSE(MapFolder::at(temp.path() / "none").noteDamage("/no/such/folder/a.map.tif", ""));
}

TEST(MapFolder, RemovesNothingIfThatWouldNotFreeEnoughSpace)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "a", 1000, std::chrono::hours(2));
    EXPECT_TRUE(folder.makeRoom(1, "")->empty());
    EXPECT_TRUE(folder.makeRoom(std::uint64_t{1} << 60, "")->empty());
    EXPECT_EQ(namesIn(folder).size(), 1U);
}

TEST(MapFolder, RemovesAMapWithAllItsFiles)
{
    const test::TempFolder temp;
    const MapFolder folder = folderAt(temp.path());
    addMap(temp, "a", 100, std::chrono::hours(2));
    temp.write("b.map.tif.part", "x");
    temp.write("b.map.tif.part.checkpoint", "x");
    EXPECT_TRUE(folder.remove("a.map.tif"));
    EXPECT_TRUE(folder.remove("b.map.tif"));
    EXPECT_TRUE(fs::is_empty(temp.path()));
    EXPECT_EQ(folder.remove("a.map.tif").error().code, ErrorCode::NotFound);
    EXPECT_EQ(folder.use(temp.file("a.map.tif")).error().code, ErrorCode::NotFound);
    EXPECT_TRUE(fs::is_empty(temp.path()));
}

} // namespace marsview
