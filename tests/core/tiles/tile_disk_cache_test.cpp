#include "app/bench/reference/fractal_heights.h"
#include "core/raster/raster_file.h"
#include "core/tiles/geotiff_tile_source.h"
#include "core/tiles/tile_disk_cache.h"
#include "core/tiles/tile_file.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/http_server.h"
#include "tests/support/make_raster.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;
using test::GridTileSource;
using testing::HasSubstr;

bool isSame(const Tile& a, const Tile& b)
{
    const SampleGrid& x = a.samples;
    const SampleGrid& y = b.samples;
    if (!(a.id == b.id) || x.type() != y.type() || x.columns() != y.columns() ||
        x.rows() != y.rows() || a.filled_m.size() != b.filled_m.size() ||
        (!a.filled_m.empty() && std::memcmp(a.filled_m.data(), b.filled_m.data(),
                                            a.filled_m.size() * sizeof(float)) != 0)) {
        return false;
    }
    for (std::size_t row = 0; row < x.rows(); ++row) {
        for (std::size_t column = 0; column < x.columns(); ++column) {
            const double p = x.raw(column, row);
            const double q = y.raw(column, row);
            if (std::memcmp(&p, &q, sizeof p) != 0 ||
                x.isVoid(column, row) != y.isVoid(column, row)) {
                return false;
            }
        }
    }
    return true;
}

std::vector<fs::path> filesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::uint64_t bytesIn(const fs::path& folder)
{
    std::uint64_t bytes = 0;
    for (const fs::path& file : filesIn(folder)) {
        bytes += fs::file_size(file);
    }
    return bytes;
}

std::vector<TileId> allTiles(const TileLayout& layout, std::size_t level)
{
    std::vector<TileId> tiles;
    for (std::uint32_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
        for (std::uint32_t column = 0; column < layout.tileColumns(TileKind::Samples, level);
             ++column) {
            tiles.push_back({TileKind::Samples, static_cast<std::uint8_t>(level), column, row});
        }
    }
    return tiles;
}

Tile readTile(const TileSource& source, const TileId& id)
{
    auto reader = source.open();
    EXPECT_TRUE(reader);
    auto tile = (*reader)->read(id);
    EXPECT_TRUE(tile) << tile.error().message;
    return std::move(tile).value();
}

class TileDiskCacheTest : public testing::Test {
protected:
    TileDiskCacheTest()
    {
        test::Random random;
        const std::vector<double> heights =
            test::fractalHeights(random, kColumns, kRows, 3000.0, 0.5);
        const auto height = [&](std::size_t column, std::size_t row) {
            return column > 100 && column < 130 && row < 300
                       ? std::numeric_limits<double>::quiet_NaN()
                       : heights[row * kColumns + column];
        };
        plain_ = std::make_shared<GridTileSource>(
            test::int16Terrain(kColumns, kRows, {.gain = 0.5, .offset_m = 10.0},
                               [&](std::size_t column, std::size_t row) {
                                   return heights[row * kColumns + column];
                               }),
            GridTileSource::Options{.mean_levels = 2});
        holed_ = std::make_shared<GridTileSource>(test::floatTerrain(kColumns, kRows, height),
                                                  GridTileSource::Options{.mean_levels = 2});
    }

    std::shared_ptr<TileDiskCache> cache(std::uint64_t bytes_max = std::uint64_t{1} << 30)
    {
        return std::make_shared<TileDiskCache>(
            TileDiskCacheOptions{.folder = folder_.file("tiles"), .bytes_max = bytes_max});
    }

    static constexpr std::size_t kColumns = 1100;
    static constexpr std::size_t kRows = 900;
    test::TempFolder folder_;
    std::shared_ptr<GridTileSource> plain_;
    std::shared_ptr<GridTileSource> holed_;
};

TEST_F(TileDiskCacheTest, ASecondReadComesFromDiskWithTheSameBits)
{
    for (const auto& source : {plain_, holed_}) {
        const std::string key = source == plain_ ? "plain" : "holed";
        std::vector<TileId> tiles = allTiles(source->layout(), 0);
        for (const TileId& id : allTiles(source->layout(), 1)) {
            tiles.push_back(id);
        }
        tiles.push_back({TileKind::Means, 2, 1, 0});
        const auto first = cache();
        for (const TileId& id : tiles) {
            EXPECT_TRUE(isSame(readTile(*cachedOnDisk(source, first, key), id), source->tile(id)));
        }
        EXPECT_EQ(source->readCount(), tiles.size());
        EXPECT_EQ(first->statistics().written, tiles.size());
        const std::uint64_t opened = source->openCount();
        const auto second = cache();
        for (const TileId& id : tiles) {
            EXPECT_TRUE(isSame(readTile(*cachedOnDisk(source, second, key), id), source->tile(id)));
        }
        EXPECT_EQ(source->readCount(), tiles.size());
        EXPECT_EQ(source->openCount(), opened) << "with a warm cache the reader opens nothing";
        EXPECT_EQ(second->statistics().found, tiles.size());
        EXPECT_EQ(second->statistics().missed, 0U);
    }
}

TEST_F(TileDiskCacheTest, FilesAreSmallerThanSamples)
{
    const auto kept = cache();
    const auto source = cachedOnDisk(plain_, kept, "key");
    for (const TileId& id : allTiles(plain_->layout(), 0)) {
        readTile(*source, id);
    }
    const std::uint64_t bytes = bytesIn(folder_.file("tiles"));
    std::cout << bytes << " bytes for " << kColumns * kRows * 2 << " of samples\n";
    EXPECT_LT(bytes, kColumns * kRows * 2 * 9 / 10);
}

TEST_F(TileDiskCacheTest, AnotherKeyIsAnotherSource)
{
    const TileId id{TileKind::Samples, 0, 1, 1};
    const auto kept = cache();
    readTile(*cachedOnDisk(plain_, kept, "edition 1"), id);
    readTile(*cachedOnDisk(plain_, kept, "edition 2"), id);
    EXPECT_EQ(plain_->readCount(), 2U);
}

TEST_F(TileDiskCacheTest, IgnoresFilesOfAnotherSource)
{
    // As if two keys had the same hash.
    const TileId id{TileKind::Samples, 0, 1, 1};
    const auto kept = cache();
    readTile(*cachedOnDisk(plain_, kept, "one"), id);
    const fs::path one = filesIn(folder_.file("tiles")).front();
    readTile(*cachedOnDisk(holed_, kept, "two"), id);
    for (const fs::path& file : filesIn(folder_.file("tiles"))) {
        if (file != one) {
            fs::copy_file(one, file, fs::copy_options::overwrite_existing);
        }
    }
    EXPECT_TRUE(isSame(readTile(*cachedOnDisk(holed_, kept, "two"), id), holed_->tile(id)));
    EXPECT_EQ(kept->statistics().damaged, 0U);
    EXPECT_EQ(holed_->readCount(), 2U);
}

TEST_F(TileDiskCacheTest, RemovesDamagedFilesAndFetchesThemAgain)
{
    test::Random random;
    const TileId id{TileKind::Samples, 0, 0, 0};
    const Tile truth = holed_->tile(id);
    const auto kept = cache();
    const auto source = cachedOnDisk(holed_, kept, "key");
    readTile(*source, id);
    const fs::path path = filesIn(folder_.file("tiles")).front();
    const std::string good = test::readFile(path);
    for (int i = 0; i < 200; ++i) {
        std::string bad = good;
        if (i % 3 == 0) {
            bad.resize(random.below(bad.size())); // 0 included
        } else if (i % 3 == 1) {
            bad[random.below(bad.size())] ^= static_cast<char>(1U << random.below(8));
        } else {
            bad += static_cast<char>(random.below(256));
        }
        std::ofstream(path, std::ios::binary) << bad;
        const std::uint64_t before = kept->statistics().damaged;
        ASSERT_TRUE(isSame(readTile(*source, id), truth)) << i;
        ASSERT_EQ(kept->statistics().damaged, before + 1) << i;
        ASSERT_EQ(test::readFile(path), good) << "is written again";
    }
}

TEST_F(TileDiskCacheTest, EvictsTheLeastRecentlyUsedTilesFirst)
{
    const std::vector<TileId> tiles = allTiles(plain_->layout(), 0);
    const auto all = cache();
    const auto source = cachedOnDisk(plain_, all, "key");
    const auto now = fs::file_time_type::clock::now();
    std::vector<fs::path> paths;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        readTile(*source, tiles[i]);
        for (const fs::path& file : filesIn(folder_.file("tiles"))) {
            if (std::find(paths.begin(), paths.end(), file) == paths.end()) {
                paths.push_back(file);
                fs::last_write_time(file, now - std::chrono::hours(tiles.size() - i));
            }
        }
    }
    ASSERT_EQ(paths.size(), tiles.size());
    // The second oldest is used: now it is the youngest.
    readTile(*source, tiles[1]);
    const std::uint64_t bytes = bytesIn(folder_.file("tiles"));
    const auto small = cache(bytes / 2);
    readTile(*cachedOnDisk(plain_, small, "key"), {TileKind::Samples, 1, 0, 0});
    EXPECT_LE(bytesIn(folder_.file("tiles")), bytes / 2);
    EXPECT_GT(small->statistics().removed, 0U);
    EXPECT_TRUE(fs::exists(paths[1]));
    EXPECT_TRUE(fs::exists(paths.back()));
    EXPECT_FALSE(fs::exists(paths[0]));
    EXPECT_FALSE(fs::exists(paths[2]));
    // No evicted file is younger than a remaining one.
    bool is_kept = false;
    for (std::size_t i = 2; i < paths.size(); ++i) {
        EXPECT_TRUE(!is_kept || fs::exists(paths[i])) << i;
        is_kept = is_kept || fs::exists(paths[i]);
    }
}

TEST_F(TileDiskCacheTest, StaysWithinItsLimitWhileTilesArrive)
{
    const std::uint64_t bytes_max = 400'000;
    const auto kept = cache(bytes_max);
    const auto source = cachedOnDisk(plain_, kept, "key");
    for (const TileId& id : allTiles(plain_->layout(), 0)) {
        EXPECT_TRUE(isSame(readTile(*source, id), plain_->tile(id)));
        EXPECT_LE(bytesIn(folder_.file("tiles")), bytes_max * 17 / 16);
    }
    EXPECT_GT(kept->statistics().removed, 0U);
}

TEST_F(TileDiskCacheTest, ProgramsShareAFolderWhileOneDeletes)
{
    const std::vector<TileId> tiles = allTiles(plain_->layout(), 0);
    std::atomic<int> wrong{0};
    std::vector<std::thread> programs;
    for (int program = 0; program < 4; ++program) {
        programs.emplace_back([&, program] {
            // Each with its own object, as in separate programs; the limit of two of them is almost
            // zero.
            const auto source =
                cachedOnDisk(plain_, cache(program < 2 ? 150'000 : 100'000'000), "key");
            const auto reader = source->open();
            std::uint64_t state = static_cast<std::uint64_t>(program) + 1;
            for (int i = 0; i < 150; ++i) {
                state = state * 6364136223846793005ULL + 1442695040888963407ULL;
                const TileId& id = tiles[(state >> 33) % tiles.size()];
                const auto tile = (*reader)->read(id);
                wrong += tile && isSame(*tile, plain_->tile(id)) ? 0 : 1;
                if (program == 3 && i % 20 == 0) {
                    std::error_code ignored;
                    fs::remove_all(folder_.file("tiles"), ignored);
                }
            }
        });
    }
    for (std::thread& program : programs) {
        program.join();
    }
    EXPECT_EQ(wrong, 0);
}

TEST_F(TileDiskCacheTest, TilesArriveEvenIfNothingCanBeWritten)
{
    const std::string file = folder_.write("not a folder", "x");
    const auto kept = std::make_shared<TileDiskCache>(
        TileDiskCacheOptions{.folder = file + "/tiles", .bytes_max = 1'000'000});
    const auto source = cachedOnDisk(plain_, kept, "key");
    const TileId id{TileKind::Samples, 0, 1, 1};
    EXPECT_EQ(kept->trouble(), std::nullopt);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(isSame(readTile(*source, id), plain_->tile(id)));
    }
    EXPECT_EQ(kept->statistics().written, 0U);
    ASSERT_TRUE(kept->trouble());
    EXPECT_THAT(*kept->trouble(), HasSubstr(file + "/tiles"));
    EXPECT_THAT(*kept->trouble(), HasSubstr("cannot be cached here (Not a directory)"));
}

TEST_F(TileDiskCacheTest, AFullDiskLeavesNoPartialFilesAndIsRetriedLater)
{
    const auto kept = cache();
    const auto source = cachedOnDisk(plain_, kept, "key");
    const TileId id{TileKind::Samples, 0, 1, 1};
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{5000, before.rlim_max}; // the disk is full in the middle of a file
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const Tile tile = readTile(*source, id);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, ignored);
    EXPECT_TRUE(isSame(tile, plain_->tile(id)));
    EXPECT_TRUE(filesIn(folder_.file("tiles")).empty());
    EXPECT_TRUE(kept->trouble());
    for (int i = 0; i < 100; ++i) {
        readTile(*source, id);
    }
    EXPECT_EQ(kept->statistics().written, 1U);
    EXPECT_EQ(kept->trouble(), std::nullopt);
}

TEST_F(TileDiskCacheTest, ChangesOfFolderAndLimitApplyFromTheNextTileOn)
{
    const auto kept = std::make_shared<TileDiskCache>(
        TileDiskCacheOptions{.folder = folder_.write("not a folder", "x") + "/tiles"});
    EXPECT_EQ(kept->bytesMax(), kFetchedBytesMax);
    const auto source = cachedOnDisk(plain_, kept, "key");
    const auto reader = source->open(); // stays open throughout
    const std::vector<TileId> tiles = allTiles(plain_->layout(), 0);
    const auto read = [&](const TileId& id) {
        const auto tile = (*reader)->read(id);
        EXPECT_TRUE(tile && isSame(*tile, plain_->tile(id)));
    };
    read(tiles[0]);
    ASSERT_TRUE(kept->trouble());
    kept->setFolder(folder_.file("tiles"));
    EXPECT_EQ(kept->folder(), folder_.file("tiles"));
    EXPECT_EQ(kept->trouble(), std::nullopt) << "that error concerned the other folder";
    for (const TileId& id : tiles) {
        read(id);
    }
    EXPECT_EQ(kept->statistics().written, tiles.size());
    const std::uint64_t bytes = bytesIn(folder_.file("tiles"));
    kept->setBytesMax(bytes / 2);
    EXPECT_EQ(bytesIn(folder_.file("tiles")), bytes);
    read({TileKind::Samples, 1, 0, 0});
    EXPECT_LE(bytesIn(folder_.file("tiles")), bytes / 2);
    kept->setFolder(folder_.file("elsewhere"));
    read(tiles[0]);
    EXPECT_EQ(keptTilesIn(folder_.file("elsewhere")).count, 1U);
    EXPECT_LE(bytesIn(folder_.file("tiles")), bytes / 2) << "the files stay";
    EXPECT_GT(bytesIn(folder_.file("tiles")), 0U);
}

TEST_F(TileDiskCacheTest, CountsAndRemovesTilesOnly)
{
    EXPECT_EQ(keptTilesIn(folder_.file("tiles")).count, 0U);
    EXPECT_TRUE(removeKeptTiles(folder_.file("tiles"))) << "the folder does not exist";
    const auto kept = cache();
    const auto source = cachedOnDisk(plain_, kept, "key");
    const std::vector<TileId> tiles = allTiles(plain_->layout(), 0);
    for (const TileId& id : tiles) {
        readTile(*source, id);
    }
    const KeptTiles all = keptTilesIn(folder_.file("tiles"));
    EXPECT_EQ(all.count, tiles.size());
    EXPECT_EQ(all.bytes, bytesIn(folder_.file("tiles")));
    const std::string foreign = folder_.write("tiles/mine.txt", "not a tile");
    ASSERT_TRUE(removeKeptTiles(folder_.file("tiles")));
    EXPECT_EQ(keptTilesIn(folder_.file("tiles")).bytes, 0U);
    EXPECT_EQ(filesIn(folder_.file("tiles")), std::vector<fs::path>{foreign});
    EXPECT_TRUE(isSame(readTile(*source, tiles[0]), plain_->tile(tiles[0]))) << "fetched again";
    EXPECT_EQ(keptTilesIn(folder_.file("tiles")).count, 1U);
}

TEST_F(TileDiskCacheTest, RemovesFilesLeftByKilledPrograms)
{
    const auto kept = cache();
    const auto source = cachedOnDisk(plain_, kept, "key");
    fs::create_directories(folder_.file("tiles/0123"));
    const std::string old = folder_.write("tiles/0123/s0-1-1-99-1.part", "half a ti");
    const std::string young = folder_.write("tiles/0123/s0-1-2-99-2.part", "half a ti");
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
    readTile(*source, {TileKind::Samples, 0, 1, 1});
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(young));
}

TEST_F(TileDiskCacheTest, PassesErrorsOfTheSourceOnWithoutCachingThem)
{
    bool is_failing = true;
    const auto source = std::make_shared<GridTileSource>(
        plain_->heightfield(),
        GridTileSource::Options{.before_read = [&](const TileId&) -> std::optional<Error> {
            return is_failing ? std::optional<Error>(
                                    Error{ErrorCode::Unreadable, "x: the connection was lost"})
                              : std::nullopt;
        }});
    const auto kept = cachedOnDisk(source, cache(), "key");
    const auto reader = kept->open();
    const auto failed = (*reader)->read({});
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "x: the connection was lost");
    is_failing = false;
    EXPECT_TRUE((*reader)->read({}));
}

TEST_F(TileDiskCacheTest, ASecondVisitToAServerRequestsAlmostNothing)
{
    constexpr std::size_t side = 1536;
    const std::vector<float> heights = fractalHeights(side, side, 3);
    std::vector<std::int16_t> samples(heights.size());
    std::transform(heights.begin(), heights.end(), samples.begin(), [](float height) {
        return static_cast<std::int16_t>(std::lround(height * 10.0F));
    });
    const std::string path = test::writeRaster(
        folder_, "map.tif", "COG", test::recipeFor(side, samples),
        {"-co", "COMPRESS=DEFLATE", "-co", "BLOCKSIZE=256", "-co", "RESAMPLING=AVERAGE"});
    test::HttpServer server(folder_.path());
    const auto visit = [&] {
        const auto file = RasterFile::open(server.url("map.tif"));
        EXPECT_TRUE(file);
        const auto source = GeotiffTileSource::of(*file, {});
        EXPECT_TRUE(source);
        const auto kept =
            cachedOnDisk(*source, cache(), server.url("map.tif") + file->info().remote_version);
        const auto reader = kept->open();
        for (const TileId& id : allTiles((*source)->layout(), 0)) {
            EXPECT_TRUE((*reader)->read(id));
        }
    };
    visit();
    const test::HttpCounts first = server.counts();
    server.resetCounts();
    visit();
    const test::HttpCounts second = server.counts();
    std::cout << "first visit: " << first.requests << " requests, " << first.body_bytes
              << " bytes; second: " << second.requests << ", " << second.body_bytes << '\n';
    EXPECT_GT(first.body_bytes, fs::file_size(path) / 2);
    EXPECT_LE(second.requests, 2U);
    EXPECT_LE(second.body_bytes, 16'384U);
}

} // namespace
} // namespace marsview
