#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/terrain/servo_terrain.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

namespace marsview {
namespace {

using test::Random;
using test::samplesTile;
using test::TiledMap;
using Clock = ClipmapStreamer::Clock;

constexpr std::size_t kColumns = 2100;
constexpr std::size_t kRows = 560;

TiledMap roughMap(test::GridTileSource::Options options = {})
{
    const auto heights = test::fractalHeights(kColumns, kRows, 9);
    return test::tiledMap(test::int16Terrain(kColumns, kRows, {.gain = 0.01},
                                             [&](std::size_t column, std::size_t row) {
                                                 return static_cast<double>(
                                                     heights[row * kColumns + column]);
                                             }),
                          std::move(options));
}

HandMotion handAt(GridPoint at, GridPoint per_second = {})
{
    return {.at = at,
            .columns_per_s = per_second.column,
            .rows_per_s = per_second.row,
            .time_ns = std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(),
            .is_active = true};
}

/// Whether the 3 × 3 tiles around a position are resident and blended in at full resolution.
bool isFineAround(const Clipmap& window, GridPoint at)
{
    for (const double dc : {-256.0, 0.0, 256.0}) {
        for (const double dr : {-256.0, 0.0, 256.0}) {
            const double column = at.column + dc;
            const double row = at.row + dr;
            if (column >= 0.0 && row >= 0.0 && column < kColumns && row < kRows &&
                !window.has(samplesTile(0, static_cast<std::size_t>(column) / 256,
                                        static_cast<std::size_t>(row) / 256))) {
                return false;
            }
        }
    }
    return true;
}

TEST(ClipmapStreamer, EverythingOnTheHandsWayIsThereInTheEnd)
{
    const TiledMap map = roughMap();
    // Smaller than a window.
    const TileCache cache({.bytes_max = std::size_t{1} << 20, .loader_threads = 2});
    const auto streamer =
        ClipmapStreamer::create(TiledRaster(cache, map.source), map.heights).value();
    ServoTerrain servo(streamer->exchange(), streamer->heights());
    streamer->start();
    for (const GridPoint at : {GridPoint{100.0, 100.0}, GridPoint{1200.0, 400.0},
                               GridPoint{2099.0, 559.0}, GridPoint{130.0, 90.0}}) {
        while (!isFineAround(servo.resident().window(), at)) {
            servo.refresh(handAt(at), 0.001);
            std::this_thread::yield();
        }
        // Blended for a while; then it equals the reference.
        for (int tick = 0; !servo.resident().blend().isEmpty(); ++tick) {
            ASSERT_LT(tick, 10'000'000);
            servo.refresh(handAt(at), 0.001);
        }
        const auto column = static_cast<std::size_t>(at.column);
        const auto row = static_cast<std::size_t>(at.row);
        EXPECT_EQ(servo.terrain()->sample(column, row), map.filled->sample(column, row));
    }
    streamer->stop();
    // 14 tiles surround the first three positions; for the fourth one the window has to return.
    EXPECT_GE(streamer->statistics().tiles_put, 14U);
    EXPECT_GE(streamer->statistics().published, 4U);
    EXPECT_GT(streamer->statistics().tiles_per_s, 0.0);
}

TEST(ClipmapStreamer, HasTheTilesAheadOfAHandThatMovesOn)
{
    const TiledMap map = roughMap();
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const TiledRaster raster(cache, map.source);
    const auto streamer = ClipmapStreamer::create(raster, map.heights).value();
    ServoTerrain servo(streamer->exchange(), streamer->heights());
    // One cell per millisecond, with time for one tile every five milliseconds, and not for half of
    // the map.
    GridPoint at{300.0, 300.0};
    std::uint64_t missed = 0;
    for (int tick = 0; tick < 1500; ++tick) {
        servo.refresh(handAt(at, {1000.0, 0.0}), 0.001);
        if (tick % 5 == 0) {
            ASSERT_TRUE(streamer->feed(Clock::now()));
            // Loads as fast as possible, however slow the machine is.
            for (const TileId& id : planWindow(map.layout(), handAt(at, {1000.0, 0.0}), {}).tiles) {
                if (raster.find(id) == nullptr) {
                    ASSERT_TRUE(raster.get(id));
                    break;
                }
            }
        }
        if (tick > 500) {
            const std::uint64_t before = servo.resident().misses().count;
            servo.terrain()->sample(static_cast<std::size_t>(at.column),
                                    static_cast<std::size_t>(at.row));
            missed += servo.resident().misses().count - before;
        }
        at.column += 1.0;
    }
    EXPECT_EQ(missed, 0U);
}

TEST(ClipmapStreamer, RequestsNothingWithoutAHand)
{
    const TiledMap map = roughMap();
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const TiledRaster raster(cache, map.source);
    const auto streamer = ClipmapStreamer::create(raster, map.heights).value();
    const std::uint64_t read = map.source->readCount();
    EXPECT_EQ(read, 1U) << "the coarsest tile";
    EXPECT_FALSE(streamer->feed(Clock::now()));
    streamer->exchange()->motion.write(handAt({700.0, 300.0}));
    EXPECT_FALSE(streamer->feed(Clock::now() + std::chrono::seconds(5))) << "idle for long";
    EXPECT_EQ(streamer->statistics().published, 0U);
    EXPECT_EQ(map.source->readCount(), read);
    EXPECT_TRUE(streamer->feed(Clock::now()));
}

TEST(ClipmapStreamer, StopsAtOnceWhileTilesAreOnTheirWay)
{
    std::atomic<bool> is_open{false};
    std::atomic<int> waiting{0};
    const TiledMap map = roughMap({.before_read = [&](const TileId& id) -> std::optional<Error> {
        if (id.level < 4) {
            ++waiting;
            is_open.wait(false);
        }
        return std::nullopt;
    }});
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto streamer =
        ClipmapStreamer::create(TiledRaster(cache, map.source), map.heights).value();
    streamer->exchange()->motion.write(handAt({700.0, 300.0}));
    streamer->start();
    while (waiting == 0) {
        streamer->exchange()->motion.write(handAt({700.0, 300.0}));
        std::this_thread::yield();
    }
    streamer->stop(); // while the loader waits
    const std::uint64_t read = map.source->readCount();
    is_open = true;
    is_open.notify_all();
    EXPECT_LE(map.source->readCount(), read);
    streamer->start(); // and continues
    while (!isFineAround(*streamer->exchange()->windows.front(), {700.0, 300.0})) {
        streamer->exchange()->motion.write(handAt({700.0, 300.0}));
        streamer->exchange()->windows.take();
        std::this_thread::yield();
    }
}

TEST(ClipmapStreamer, ContinuesWhenTilesFailAndLoadsThemOnceReadable)
{
    std::atomic<bool> is_broken{true};
    std::atomic<int> failures{0};
    const TiledMap map = roughMap({.before_read = [&](const TileId& id) -> std::optional<Error> {
        if (is_broken && id.level == 0) {
            ++failures;
            return Error{ErrorCode::Unreadable, "no luck"};
        }
        return std::nullopt;
    }});
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto streamer =
        ClipmapStreamer::create(TiledRaster(cache, map.source), map.heights).value();
    ServoTerrain servo(streamer->exchange(), streamer->heights());
    const GridPoint at{900.0, 400.0};
    streamer->start();
    while (failures < 9 || !servo.resident().window().has(samplesTile(1, 1, 0))) {
        servo.refresh(handAt(at), 0.001);
        std::this_thread::yield();
    }
    servo.terrain()->sample(901, 401);
    EXPECT_GT(servo.resident().misses().count, 0U);
    is_broken = false;
    while (!isFineAround(servo.resident().window(), at)) {
        servo.refresh(handAt(at), 0.001);
        std::this_thread::yield();
    }
}

TEST(ClipmapStreamer, NoTileOutlivesTheWindowsThatHaveIt)
{
    const TiledMap map = roughMap();
    const TileCache cache({.bytes_max = 0, .loader_threads = 1}); // stores nothing itself
    const TiledRaster raster(cache, map.source);
    auto streamer = ClipmapStreamer::create(raster, map.heights).value();
    const auto exchange = streamer->exchange();
    const GridPoint first{100.0, 100.0};
    const GridPoint second{2000.0, 500.0};
    exchange->motion.write(handAt(second));
    std::weak_ptr<const Clipmap> old;
    streamer->feed(Clock::now());
    ASSERT_TRUE(exchange->windows.take());
    old = exchange->windows.front();
    // The servo keeps it, whatever is published in the meantime.
    for (int i = 0; i < 6; ++i) {
        exchange->motion.write(handAt(i % 2 == 0 ? first : second));
        streamer->feed(Clock::now());
        EXPECT_FALSE(old.expired());
    }
    ASSERT_TRUE(exchange->windows.take());
    EXPECT_FALSE(old.expired()) << "freed by the streamer, not by the servo";
    for (int i = 0; i < 3; ++i) {
        exchange->motion.write(handAt(i % 2 == 0 ? first : second));
        streamer->feed(Clock::now());
    }
    EXPECT_TRUE(old.expired());
    streamer.reset();
    EXPECT_NE(exchange->windows.front(), nullptr) << "the servo's window stays alive";
}

TEST(ClipmapStreamer, AServoAtWorkNeverWaitsAndNeverReadsWhatIsGone)
{
    // A stress test for the thread and address sanitizers.
    Random random;
    const TiledMap map = roughMap();
    const TileCache cache({.bytes_max = std::size_t{512} << 10, .loader_threads = 2});
    const auto streamer =
        ClipmapStreamer::create(TiledRaster(cache, map.source), map.heights).value();
    streamer->start();
    std::atomic<bool> is_done{false};
    std::thread servo_thread([&] {
        ServoTerrain servo(streamer->exchange(), streamer->heights());
        GridPoint at{500.0, 200.0};
        GridPoint velocity{3.0, 2.0};
        for (int tick = 0; tick < 30'000; ++tick) {
            at = {at.column + velocity.column, at.row + velocity.row};
            if (at.column < 0.0 || at.column >= kColumns - 1.0) {
                velocity.column = -velocity.column;
                at.column += 2.0 * velocity.column;
            }
            if (at.row < 0.0 || at.row >= kRows - 1.0) {
                velocity.row = -velocity.row;
                at.row += 2.0 * velocity.row;
            }
            servo.refresh(handAt(at, {1e3 * velocity.column, 1e3 * velocity.row}), 0.001);
            const auto column = static_cast<std::size_t>(at.column);
            const auto row = static_cast<std::size_t>(at.row);
            const double height = servo.terrain()->sample(column, row);
            ASSERT_LE(height, map.heights->ceiling(column, row));
        }
        is_done = true;
    });
    servo_thread.join();
    EXPECT_TRUE(is_done);
    streamer->stop();
}

} // namespace
} // namespace marsview
