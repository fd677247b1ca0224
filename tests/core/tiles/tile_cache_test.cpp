#include "app/bench/reference/fractal_heights.h"
#include "core/tiles/tile_cache.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <fmt/format.h>
#include <mutex>
#include <set>
#include <thread>

namespace marsview {
namespace {

using test::GridTileSource;

constexpr std::size_t kColumns = 1100; // 5 × 4 tiles, the last ones narrow
constexpr std::size_t kRows = 800;

const Heightfield& terrain()
{
    static const Heightfield heightfield =
        test::int16Terrain(kColumns, kRows, {}, [](std::size_t column, std::size_t row) {
            return static_cast<double>((column * 7 + row * 13) % 3001) - 1500.0;
        });
    return heightfield;
}

TileId tileId(std::uint32_t column, std::uint32_t row, std::uint8_t level = 0)
{
    return {.kind = TileKind::Samples, .level = level, .column = column, .row = row};
}

std::vector<TileId> allOfLevel0()
{
    std::vector<TileId> ids;
    for (std::uint32_t row = 0; row < 4; ++row) {
        for (std::uint32_t column = 0; column < 5; ++column) {
            ids.push_back(tileId(column, row));
        }
    }
    return ids;
}

// Every sample of a tile equals the map's.
void expectWhole(const Tile& tile)
{
    const TileId& id = tile.id;
    ASSERT_EQ(id.level, 0);
    for (std::size_t row = 0; row < tile.samples.rows(); ++row) {
        for (std::size_t column = 0; column < tile.samples.columns(); ++column) {
            ASSERT_EQ(
                tile.samples.raw(column, row),
                terrain().samples().raw(id.column * kTileSide + column, id.row * kTileSide + row));
        }
    }
}

// Blocks readers until it is opened.
class Gate {
public:
    void open()
    {
        {
            const std::lock_guard lock(mutex_);
            is_open_ = true;
        }
        changed_.notify_all();
    }
    void pass()
    {
        std::unique_lock lock(mutex_);
        ++waiting_;
        changed_.notify_all();
        changed_.wait(lock, [this] { return is_open_; });
    }
    // Waits until `count` readers have arrived.
    void awaitReaders(int count)
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return waiting_ >= count; });
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_open_ = false;
    int waiting_ = 0;
};

TEST(TileCache, LoadsRequestedTilesOnce)
{
    const auto source = std::make_shared<GridTileSource>(terrain());
    TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 3});
    const TiledRaster raster(cache, source);
    TileRequests requests(raster, TileUrgency::View);
    EXPECT_EQ(raster.find(tileId(0, 0)), nullptr);
    requests.request(allOfLevel0());
    requests.waitForPending();
    for (const TileId& id : allOfLevel0()) {
        const auto tile = raster.find(id);
        ASSERT_NE(tile, nullptr);
        expectWhole(*tile);
    }
    EXPECT_EQ(requests.missingCount(), 0U);
    EXPECT_EQ(source->readCount(), 20U);
    EXPECT_EQ(raster.generation(), 20U);
    requests.request(allOfLevel0());
    requests.waitForPending();
    EXPECT_EQ(source->readCount(), 20U);
    EXPECT_LE(source->openCount(), 3U) << "a reader is used again";
}

TEST(TileCache, ServesTouchedTilesBeforeTheView)
{
    Gate gate;
    std::mutex mutex;
    std::vector<TileId> order;
    GridTileSource::Options options;
    options.before_read = [&](const TileId& id) -> std::optional<Error> {
        gate.pass();
        const std::lock_guard lock(mutex);
        order.push_back(id);
        return std::nullopt;
    };
    const auto source = std::make_shared<GridTileSource>(terrain(), options);
    TileCache cache({.loader_threads = 1});
    const TiledRaster raster(cache, source);
    TileRequests ahead(raster, TileUrgency::Ahead);
    TileRequests view(raster, TileUrgency::View);
    TileRequests hand(raster, TileUrgency::Hand);
    const TileId first = tileId(4, 3);
    view.request(std::vector{first});
    gate.awaitReaders(1); // the loader is busy with the first tile
    const std::vector later{tileId(0, 0), tileId(1, 0)};
    const std::vector viewed{tileId(2, 2), tileId(1, 2)};
    const std::vector touched{tileId(3, 1), tileId(2, 1)};
    ahead.request(later);
    view.request(viewed);
    hand.request(touched);
    gate.open();
    ahead.waitForPending();
    view.waitForPending();
    hand.waitForPending();
    const std::vector expected{first,     touched[0], touched[1], viewed[0],
                               viewed[1], later[0],   later[1]};
    EXPECT_EQ(order, expected);
}

TEST(TileCache, ServesTouchedTilesWhileTheViewWaitsForASlowSource)
{
    for (const std::size_t threads : {2U, 4U}) {
        Gate gate; // the view's tiles come after it
        const TileId touched = tileId(3, 1);
        GridTileSource::Options options;
        options.before_read = [&](const TileId& id) -> std::optional<Error> {
            if (id != touched) {
                gate.pass();
            }
            return std::nullopt;
        };
        const auto source = std::make_shared<GridTileSource>(terrain(), options);
        TileCache cache({.loader_threads = threads});
        const TiledRaster raster(cache, source);
        TileRequests view(raster, TileUrgency::View);
        TileRequests hand(raster, TileUrgency::Hand);
        const std::vector viewed{tileId(0, 0), tileId(1, 0), tileId(2, 0),
                                 tileId(3, 0), tileId(4, 0), tileId(0, 1)};
        view.request(viewed);
        gate.awaitReaders(static_cast<int>(threads)); // as many as are needed for the view
        hand.request(std::vector{touched});
        hand.waitForPending();
        EXPECT_NE(raster.find(touched), nullptr);
        EXPECT_EQ(view.missingCount(), viewed.size());
        gate.open();
        view.waitForPending();
        EXPECT_EQ(view.missingCount(), 0U);
    }
}

TEST(TileCache, SkipsCanceledRequests)
{
    Gate gate;
    GridTileSource::Options options;
    options.before_read = [&](const TileId&) -> std::optional<Error> {
        gate.pass();
        return std::nullopt;
    };
    const auto source = std::make_shared<GridTileSource>(terrain(), options);
    TileCache cache({.loader_threads = 1});
    const TiledRaster raster(cache, source);
    TileRequests requests(raster, TileUrgency::View);
    requests.request(allOfLevel0());
    gate.awaitReaders(1);
    requests.request(std::vector{tileId(4, 3)});
    gate.open();
    requests.waitForPending();
    EXPECT_NE(raster.find(tileId(4, 3)), nullptr);
    EXPECT_EQ(source->readCount(), 2U) << "the tile in progress, and the requested one";
    EXPECT_EQ(cache.statistics().canceled, 18U);
}

TEST(TileCache, KeepsTheMostRecentlyUsedTilesWithinItsLimit)
{
    const auto source = std::make_shared<GridTileSource>(terrain());
    const std::size_t tile_bytes = source->tile(tileId(0, 0)).bytes();
    TileCache cache({.bytes_max = 3 * tile_bytes, .loader_threads = 1});
    const TiledRaster raster(cache, source);
    for (std::uint32_t column = 0; column < 3; ++column) {
        ASSERT_TRUE(raster.get(tileId(column, 0)));
    }
    EXPECT_NE(raster.find(tileId(0, 0)), nullptr); // used again
    ASSERT_TRUE(raster.get(tileId(3, 0)));
    EXPECT_NE(raster.find(tileId(0, 0)), nullptr);
    EXPECT_EQ(raster.find(tileId(1, 0)), nullptr) << "least recently used";
    EXPECT_NE(raster.find(tileId(2, 0)), nullptr);
    EXPECT_LE(cache.statistics().bytes_held, 3 * tile_bytes);
    EXPECT_EQ(cache.statistics().evicted, 1U);
    cache.setBytesMax(tile_bytes);
    EXPECT_LE(cache.statistics().bytes_held, tile_bytes);
}

TEST(TileCache, NeverEvictsATileInUse)
{
    const auto source = std::make_shared<GridTileSource>(terrain());
    TileCache cache({.bytes_max = 1, .loader_threads = 1});
    const TiledRaster raster(cache, source);
    const auto held = raster.get(tileId(1, 1));
    ASSERT_TRUE(held);
    for (const TileId& id : allOfLevel0()) {
        ASSERT_TRUE(raster.get(id));
    }
    expectWhole(**held);
    EXPECT_EQ(raster.find(tileId(1, 1)), *held) << "there is only one of it";
    EXPECT_EQ(raster.find(tileId(2, 2)), nullptr);
}

TEST(TileCache, ReportsWhyATileFailedAndRetries)
{
    std::atomic<int> failures_left{3};
    GridTileSource::Options options;
    options.before_read = [&](const TileId& id) -> std::optional<Error> {
        if (id == tileId(2, 1) && failures_left.fetch_sub(1) > 0) {
            return Error{ErrorCode::Unreadable, "map in memory: the disk stumbled"};
        }
        return std::nullopt;
    };
    const auto source = std::make_shared<GridTileSource>(terrain(), options);
    TileCache cache({.loader_threads = 2});
    const TiledRaster raster(cache, source);
    TileRequests requests(raster, TileUrgency::Hand);
    requests.request(std::vector{tileId(2, 1), tileId(0, 0)});
    requests.waitForPending();
    EXPECT_NE(raster.find(tileId(0, 0)), nullptr) << "a failure affects only that tile";
    const auto first = raster.get(tileId(2, 1));
    if (!first) {
        EXPECT_EQ(first.error().message, "map in memory: the disk stumbled");
    }
    while (raster.find(tileId(2, 1)) == nullptr) {
        std::this_thread::yield(); // retried for as long as it is requested
    }
    EXPECT_FALSE(raster.failure(tileId(2, 1)));
    expectWhole(*raster.find(tileId(2, 1)));
    EXPECT_EQ(cache.statistics().failed, 3U);
}

TEST(TileCache, ReopensAReaderAfterItFailed)
{
    std::atomic<bool> is_broken{true};
    GridTileSource::Options options;
    options.before_read = [&](const TileId&) -> std::optional<Error> {
        return is_broken ? std::optional(Error{ErrorCode::Unreadable, "gone"}) : std::nullopt;
    };
    const auto source = std::make_shared<GridTileSource>(terrain(), options);
    TileCache cache({.loader_threads = 1});
    const TiledRaster raster(cache, source);
    EXPECT_FALSE(raster.get(tileId(0, 0)));
    EXPECT_EQ(raster.failure(tileId(0, 0))->message, "gone");
    is_broken = false;
    EXPECT_TRUE(raster.get(tileId(0, 0)));
    EXPECT_EQ(source->openCount(), 2U);
    EXPECT_FALSE(raster.failure(tileId(0, 0)));
}

TEST(TileCache, ReportsThatTheSourceCannotBeOpened)
{
    GridTileSource::Options options;
    options.before_open = [] {
        return std::optional(Error{ErrorCode::NotFound, "map in memory: was moved"});
    };
    TileCache cache({.loader_threads = 1});
    const TiledRaster raster(cache, std::make_shared<GridTileSource>(terrain(), options));
    const auto tile = raster.get(tileId(0, 0));
    ASSERT_FALSE(tile);
    EXPECT_EQ(tile.error().message, "map in memory: was moved");
}

TEST(TileCache, NotifiesClientsOnlyWhileTheirRequestsExist)
{
    const auto source = std::make_shared<GridTileSource>(terrain());
    TileCache cache({.loader_threads = 2});
    const TiledRaster raster(cache, source);
    std::atomic<int> notified{0};
    {
        TileRequests requests(raster, TileUrgency::View, [&notified] { ++notified; });
        requests.request(allOfLevel0());
        requests.waitForPending();
    }
    const int so_far = notified;
    EXPECT_LE(so_far, 20);
    EXPECT_GE(so_far, 17) << "the last ones may be reported while the requests end";
    cache.clear();
    EXPECT_TRUE(raster.get(tileId(0, 0)));
    EXPECT_EQ(notified, so_far);
}

TEST(TileCache, RemovesARasterWithItsLastUser)
{
    TileCache cache({.loader_threads = 1});
    const auto source = std::make_shared<GridTileSource>(terrain());
    {
        const TiledRaster raster(cache, source);
        const TiledRaster copy = raster; // NOLINT(performance-unnecessary-copy-initialization)
        ASSERT_TRUE(copy.get(tileId(0, 0)));
        EXPECT_GT(cache.statistics().bytes_held, 0U);
    }
    EXPECT_EQ(cache.statistics().bytes_held, 0U);
    EXPECT_EQ(source.use_count(), 1);
}

TEST(TileCache, KeepsLoadingWhileItsRastersExist)
{
    for (int round = 0; round < 20; ++round) {
        const auto source = std::make_shared<GridTileSource>(terrain());
        auto cache = std::make_unique<TileCache>(TileCacheOptions{.loader_threads = 2});
        const TiledRaster raster(*cache, source);
        TileRequests requests(raster, TileUrgency::View);
        requests.request(allOfLevel0());
        cache.reset();
        requests.waitForPending();
        for (const TileId& id : allOfLevel0()) {
            ASSERT_TRUE(raster.find(id));
        }
    }
}

TEST(TileCache, IsDestroyedWhileRequestsArePending)
{
    for (int round = 0; round < 20; ++round) {
        const auto source = std::make_shared<GridTileSource>(terrain());
        const TileCache cache({.loader_threads = 2});
        const TiledRaster raster(cache, source);
        TileRequests requests(raster, TileUrgency::View);
        requests.request(allOfLevel0());
    }
}

TEST(TileCache, ServesCompleteTilesToManyThreads)
{
    const std::uint64_t seed = 20251;
    SCOPED_TRACE(fmt::format("seed {}", seed));
    GridTileSource::Options options;
    std::atomic<std::uint64_t> reads{0};
    options.before_read = [&](const TileId&) -> std::optional<Error> {
        // Every seventh read fails.
        return reads.fetch_add(1) % 7 == 6 ? std::optional(Error{ErrorCode::Unreadable, "stumbled"})
                                           : std::nullopt;
    };
    const auto source = std::make_shared<GridTileSource>(terrain(), options);
    const std::size_t tile_bytes = source->tile(tileId(0, 0)).bytes();
    TileCache cache({.bytes_max = 5 * tile_bytes, .loader_threads = 3});
    const TiledRaster raster(cache, source);
    std::vector<std::jthread> threads;
    for (std::uint64_t i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] {
            test::Random random(seed + i);
            TileRequests requests(raster, i % 2 == 0 ? TileUrgency::Hand : TileUrgency::View);
            const std::vector<TileId> all = allOfLevel0();
            for (int step = 0; step < 60; ++step) {
                std::vector<TileId> some;
                for (const TileId& id : all) {
                    if (random.uniform(0.0, 1.0) < 0.3) {
                        some.push_back(id);
                    }
                }
                requests.request(some);
                const TileId id = all[static_cast<std::size_t>(random.uniform(0.0, 19.999))];
                if (i % 2 == 0) {
                    if (const auto tile = raster.get(id)) {
                        expectWhole(**tile);
                    }
                } else if (const auto tile = raster.find(id)) {
                    expectWhole(*tile);
                }
            }
        });
    }
    threads.clear();
    EXPECT_GT(cache.statistics().loaded, 0U);
    EXPECT_GT(cache.statistics().evicted, 0U);
}

} // namespace
} // namespace marsview
