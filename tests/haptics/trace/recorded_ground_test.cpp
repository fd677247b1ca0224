#include "haptics/terrain/clipmap_streamer.h"
#include "haptics/terrain/ground_log.h"
#include "haptics/trace/recorded_ground.h"
#include "tests/haptics/loop/tick_fixture.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace marsview::test {
namespace {

constexpr std::size_t kColumns = 2100;
constexpr std::size_t kRows = 1000;

TiledMap mapWithVoids()
{
    const auto heights = fractalHeights(kColumns, kRows, 11);
    return tiledMap(floatTerrain(kColumns, kRows, [&](std::size_t column, std::size_t row) {
        const bool is_void = (column / 50) % 6 == 3 && (row / 60) % 5 == 2;
        return is_void ? std::numeric_limits<double>::quiet_NaN()
                       : 4.0 * static_cast<double>(heights[row * kColumns + column]);
    }));
}

TEST(RecordedGround, IsTheGroundThatWasFeltToTheBitWhateverCameWhen)
{
    const TiledMap map = mapWithVoids();
    const TileCache cold({.bytes_max = std::size_t{1} << 20, .loader_threads = 1});
    const TileCache other({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto streamer =
        ClipmapStreamer::create(TiledRaster(cold, map.source), map.heights).value();
    const auto terrain = std::make_shared<ServoTerrain>(streamer->exchange(), streamer->heights());
    const auto servo_map = makeServoMap(meterFrame(kColumns, kRows), terrain, {});
    streamer->start();
    const auto again = RecordedGround::make(TiledRaster(other, map.source), map.heights).value();

    Random random;
    GroundLog log;
    GroundLog::Queue queue;
    std::size_t blended = 0;
    std::size_t coarse = 0;
    GridPoint at{100.0, 100.0};
    GridPoint aim = at;
    for (int tick = 0; tick < 20'000 || blended < 200 || coarse < 200; ++tick) {
        ASSERT_LT(tick, 2'000'000);
        if (random.chance(0.002)) { // another place, at any speed
            aim = {random.uniform(0.0, kColumns - 1.0), random.uniform(0.0, kRows - 1.0)};
        }
        const double share = tick % 1000 < 500 ? 0.002 : 0.1;
        at = {at.column + share * (aim.column - at.column), at.row + share * (aim.row - at.row)};
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        terrain->resident().setRate(random.chance(0.5) ? 5.0 : 500.0);
        terrain->resident().resetMisses();
        const bool has_changed = terrain->refresh(
            {.at = at, .time_ns = now / std::chrono::nanoseconds(1), .is_active = true}, 0.001);
        const auto count = log.record(*servo_map, has_changed, queue);
        ASSERT_TRUE(count);
        GroundRecord record;
        for (std::uint32_t i = 0; i < *count; ++i) {
            ASSERT_TRUE(queue.take(record));
            ASSERT_TRUE(again->follow(record));
        }
        EXPECT_FALSE(queue.take(record));
        ASSERT_EQ(log.record(*servo_map, false, queue), 0U) << "nothing has changed since";
        blended += terrain->resident().blend().isEmpty() ? 0U : 1U;
        for (int i = 0; i < 8; ++i) {
            const auto along = [&](double middle, std::size_t samples) {
                const double place = middle + random.uniform(-300.0, 300.0);
                return static_cast<std::size_t>(
                    std::clamp(place, 0.0, static_cast<double>(samples - 1)));
            };
            const std::size_t column = along(at.column, kColumns);
            const std::size_t row = along(at.row, kRows);
            ASSERT_EQ(again->terrain()->sample(column, row),
                      terrain->terrain()->sample(column, row))
                << "tick " << tick << ", sample " << column << ", " << row;
        }
        coarse += terrain->resident().misses().count > 0 ? 1U : 0U;
    }
    streamer->stop();
}

TEST(RecordedGround, RefusesTilesThatTheMapDoesNotHave)
{
    const TiledMap map = mapWithVoids();
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto ground = RecordedGround::make(TiledRaster(cache, map.source), map.heights).value();
    const auto top = static_cast<std::size_t>(map.layout().topLevel());
    const TileId beside{TileKind::Samples, 0, 9, 0};
    for (const GroundRecord& record : std::vector<GroundRecord>{
             GroundLevel{top + 1, {0, 0, 1, 1, 1}}, GroundLevel{0, {0, 2, 8, 8, 1}},
             GroundLevel{0, {0, 0, 9, 4, 1}}, GroundLevel{0, {0, 0, 0, 0, 0}},
             GroundLevel{0, {0, 0, 2, 2, 16}}, GroundLevel{0, {~0U, 0, 2, 2, 1}},
             GroundTile{beside, 0.5}, GroundTile{{TileKind::Samples, 200, 0, 0}, 0.5},
             GroundTile{{TileKind::Samples, static_cast<std::uint8_t>(top), 0, 0}, 0.0}}) {
        const Status refused = ground->follow(record);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Invalid);
    }
    EXPECT_TRUE(ground->follow(GroundFelt{}));
    EXPECT_EQ(ground->terrain()->sample(0, 0), map.window({}).height(0, 0));
}

// Of joined maps, each shows its own tiles, and those of older recordings, which name no map.
TEST(RecordedGround, ShowsTheTilesOfItsOwnMap)
{
    const TiledMap map = mapWithVoids();
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const double coarse_m = map.window({}).height(1, 1);
    const double fine_m = map.filled->sample(1, 1);
    ASSERT_NE(coarse_m, fine_m);
    for (const std::optional<std::uint32_t> named :
         std::vector<std::optional<std::uint32_t>>{0U, 1U, 2U, std::nullopt}) {
        const auto ground =
            RecordedGround::make(TiledRaster(cache, map.source), map.heights, 1).value();
        EXPECT_TRUE(ground->follow(GroundLevel{0, {0, 0, 2, 2, 1}, named}));
        EXPECT_TRUE(ground->follow(GroundFelt{}));
        const bool is_own = named.value_or(1) == 1;
        EXPECT_EQ(ground->terrain()->sample(1, 1), is_own ? fine_m : coarse_m);
        EXPECT_TRUE(ground->follow(GroundTile{{TileKind::Samples, 0, 0, 0}, 0.0, named}));
        EXPECT_TRUE(ground->follow(GroundFelt{}));
        EXPECT_EQ(ground->terrain()->sample(1, 1), coarse_m);
        // Invalid tiles of another map are not an error here.
        EXPECT_EQ(static_cast<bool>(ground->follow(GroundLevel{0, {0, 0, 9, 4, 1}, named})),
                  !is_own);
    }
}

TEST(RecordedGround, NamesTheTileThatCannotBeRead)
{
    const auto fails = [](const TileId& id) {
        return id.level == 0 ? std::optional(Error{ErrorCode::Unreadable, "broken"}) : std::nullopt;
    };
    const TiledMap map = tiledMap(floatTerrain(kColumns, kRows, [](auto, auto) { return 1.0; }),
                                  {.before_read = fails});
    const TileCache cache({.bytes_max = std::size_t{64} << 20, .loader_threads = 1});
    const auto ground = RecordedGround::make(TiledRaster(cache, map.source), map.heights).value();
    EXPECT_TRUE(ground->follow(GroundLevel{0, {0, 0, 2, 2, 1}}));
    const Status shown = ground->follow(GroundFelt{});
    ASSERT_FALSE(shown);
    EXPECT_NE(shown.error().message.find("broken"), std::string::npos);
}

} // namespace
} // namespace marsview::test
