#include "core/levels/waiting_terrain.h"
#include "core/terrain/touch_terrain.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <vector>

namespace marsview {
namespace {

using test::Random;
using test::samplesTile;
using test::TiledMap;

static_assert(TouchTerrain<FilledHeightfield>);
static_assert(TouchTerrain<ResidentTerrain>);
static_assert(TouchTerrain<WaitingTerrain>);

constexpr std::size_t kColumns = 1400;
constexpr std::size_t kRows = 1100;

const TiledMap& roughMap()
{
    static const TiledMap kMap = [] {
        const auto heights = test::fractalHeights(kColumns, kRows, 21);
        return test::tiledMap(
            test::floatTerrain(kColumns, kRows, [&](std::size_t column, std::size_t row) {
                const bool is_void = (column / 50) % 6 == 3 && (row / 60) % 5 == 2;
                return is_void ? std::numeric_limits<double>::quiet_NaN()
                               : 4.0 * static_cast<double>(heights[row * kColumns + column]);
            }));
    }();
    return kMap;
}

/// Simulates a streamer: windows that grow tile by tile, each a modified copy of the previous one.
class Arrivals {
public:
    Arrivals(const TiledMap& map, GridPoint center)
        : map_(map)
        , center_(center)
        , window_(std::make_shared<Clipmap>(map.window(center, kSides)))
    {}

    const Clipmap& window() const { return *window_; }
    std::vector<TileId> tiles() const { return test::tilesOf(*window_); }
    /// By then the previous window is freed.
    void arrive(const TileId& id)
    {
        auto next = std::make_shared<Clipmap>(map_.window(center_, kSides));
        for (const TileId& old : tiles()) {
            const Clipmap::Slot* slot = window_->slot(old);
            if (slot->tile) {
                next->put(slot->tile, slot->difference_m);
            }
        }
        if (!next->has(id)) {
            next->put(map_.tile(id), 0.0);
            next->put(next->slot(id)->tile, next->differenceFromCoarser(id));
        }
        window_ = std::move(next);
    }

private:
    static constexpr WindowSides kSides{.finest = 4, .coarser = 3};

    const TiledMap& map_;
    GridPoint center_;
    std::shared_ptr<Clipmap> window_;
};

struct Place {
    std::size_t column;
    std::size_t row;
};

/// In the 3 × 3 tiles around the proxy.
std::vector<Place> placesNear(Random& random, GridPoint hand, std::size_t count)
{
    const auto along = [&](double at, std::size_t samples) {
        const auto tile = static_cast<std::size_t>(at) / kTileSide;
        const std::size_t low = (std::max<std::size_t>(tile, 1) - 1) * kTileSide;
        const std::size_t high = std::min((tile + 2) * kTileSide, samples);
        // Often near a border between tiles.
        const std::size_t any = low + random.below(high - low);
        return random.chance(0.3)
                   ? std::clamp((any + 128) / 256 * 256 + random.below(3) - 1, low, high - 1)
                   : any;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back({along(hand.column, kColumns), along(hand.row, kRows)});
    }
    return places;
}

std::vector<double> heightsAt(const ResidentTerrain& terrain, const std::vector<Place>& places)
{
    std::vector<double> heights;
    for (const Place& place : places) {
        heights.push_back(terrain.sample(place.column, place.row));
    }
    return heights;
}

TEST(ResidentTerrain, GoesFromWhatWasFeltToWhatArrivedSteadilyAndNoFasterThanTheRate)
{
    Random random;
    const TiledMap& map = roughMap();
    const GridPoint hand{700.0, 500.0};
    const double rate = 3.0;
    for (const std::size_t level : {0U, 1U, 2U}) {
        Arrivals arrivals(map, hand);
        auto terrain = ResidentTerrain(arrivals.window(), map.heights, {.rate_m_per_s = rate});
        const TileId tile =
            samplesTile(level, std::size_t{700} >> (8 + level), std::size_t{500} >> (8 + level));
        const std::vector<Place> places = placesNear(random, hand, 4000);
        const std::vector<double> before = heightsAt(terrain, places);
        arrivals.arrive(tile);
        EXPECT_TRUE(terrain.show(arrivals.window(), hand));
        EXPECT_EQ(heightsAt(terrain, places), before) << "nothing jumps";
        std::vector<double> last = before;
        int ticks = 0;
        for (; !terrain.blend().isEmpty(); ++ticks) {
            ASSERT_LT(ticks, 100'000);
            const double dt = random.uniform(0.0, 0.02);
            EXPECT_TRUE(terrain.advance(hand, dt));
            const std::vector<double> now = heightsAt(terrain, places);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const double end = arrivals.window().height(places[i].column, places[i].row);
                ASSERT_LE(std::abs(now[i] - last[i]), rate * dt + 1e-12);
                ASSERT_LE(std::abs(now[i] - end), std::abs(last[i] - end) + 1e-12) << "moved back";
            }
            last = now;
        }
        EXPECT_GT(ticks, 10);
        for (const Place& place : places) {
            ASSERT_EQ(terrain.sample(place.column, place.row),
                      arrivals.window().height(place.column, place.row));
        }
        EXPECT_FALSE(terrain.advance(hand, 1.0));
    }
}

TEST(ResidentTerrain, HeightsUnderARestingHandChangeNoFasterThanTheRateWhateverArrivesWhen)
{
    Random random;
    const TiledMap& map = roughMap();
    const double rate = 20.0;
    double fastest = 0.0;
    for (int round = 0; round < 6; ++round) {
        const GridPoint hand{random.uniform(0.0, kColumns - 1.0), random.uniform(0.0, kRows - 1.0)};
        Arrivals arrivals(map, hand);
        auto terrain = ResidentTerrain(arrivals.window(), map.heights, {.rate_m_per_s = rate});
        const std::vector<Place> places = placesNear(random, hand, 1500);
        std::vector<TileId> missing = arrivals.tiles();
        std::vector<double> last = heightsAt(terrain, places);
        for (int tick = 0; tick < 400 || !terrain.blend().isEmpty(); ++tick) {
            ASSERT_LT(tick, 20'000);
            const double dt = random.uniform(0.0, 0.004);
            for (std::size_t n = random.chance(0.2) ? random.below(4) : 0;
                 n > 0 && !missing.empty(); --n) {
                const std::size_t which = random.below(missing.size());
                arrivals.arrive(missing[which]);
                missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(which));
                if (n == 1) { // windows published in between are not seen
                    terrain.show(arrivals.window(), hand);
                }
            }
            terrain.show(arrivals.window(), hand);
            terrain.advance(hand, dt);
            const std::vector<double> now = heightsAt(terrain, places);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const double change = std::abs(now[i] - last[i]);
                fastest = std::max(fastest, dt > 0.0 ? change / (rate * dt) : 0.0);
                ASSERT_LE(change, rate * dt + 1e-11)
                    << places[i].column << ", " << places[i].row << " at tick " << tick;
                ASSERT_LE(now[i], map.heights->ceiling(places[i].column, places[i].row));
            }
            last = now;
        }
        for (const Place& place : places) {
            ASSERT_EQ(terrain.sample(place.column, place.row),
                      arrivals.window().height(place.column, place.row));
        }
    }
    EXPECT_GT(fastest, 0.9) << "a rate that cannot be reached";
}

TEST(ResidentTerrain, FeelsAtOnceWhatArrivesFarFromTheHand)
{
    const TiledMap& map = roughMap();
    const GridPoint hand{100.0, 100.0};
    Arrivals arrivals(map, {500.0, 500.0});
    auto terrain = ResidentTerrain(arrivals.window(), map.heights, {.rate_m_per_s = 0.001});
    arrivals.arrive(samplesTile(0, 3, 3));
    EXPECT_FALSE(terrain.show(arrivals.window(), hand));
    EXPECT_EQ(terrain.sample(800, 800), map.filled->sample(800, 800));
    arrivals.arrive(samplesTile(0, 1, 1));
    EXPECT_TRUE(terrain.show(arrivals.window(), hand));
    EXPECT_NE(terrain.sample(301, 301), map.filled->sample(301, 301));
    EXPECT_TRUE(terrain.advance({900.0, 100.0}, 0.0)) << "the proxy has left the tile";
    EXPECT_EQ(terrain.sample(301, 301), map.filled->sample(301, 301));
}

TEST(ResidentTerrain, FeelsAtOnceWhereNoRateIsAskedFor)
{
    const TiledMap& map = roughMap();
    const GridPoint hand{300.0, 300.0};
    Arrivals arrivals(map, hand);
    auto terrain = ResidentTerrain(arrivals.window(), map.heights,
                                   {.rate_m_per_s = std::numeric_limits<double>::infinity()});
    arrivals.arrive(samplesTile(0, 1, 1));
    EXPECT_TRUE(terrain.show(arrivals.window(), hand));
    EXPECT_EQ(terrain.sample(301, 301), map.filled->sample(301, 301));
}

TEST(ResidentTerrain, CountsWhatWasNotThere)
{
    const TiledMap& map = roughMap();
    Arrivals arrivals(map, {300.0, 300.0});
    auto terrain = ResidentTerrain(arrivals.window(), map.heights);
    terrain.sample(301, 301);
    EXPECT_EQ(terrain.misses().count, 1U);
    EXPECT_EQ(terrain.misses().last_level, map.layout().topLevel());
    arrivals.arrive(samplesTile(1, 0, 0));
    terrain.show(arrivals.window(), {300.0, 300.0});
    terrain.sample(301, 301);
    EXPECT_EQ(terrain.misses().count, 2U);
    EXPECT_EQ(terrain.misses().last_level, 1U);
    EXPECT_EQ(terrain.misses().worst_level, map.layout().topLevel());
    terrain.resetMisses();
    arrivals.arrive(samplesTile(0, 1, 1));
    terrain.show(arrivals.window(), {300.0, 300.0});
    terrain.sample(301, 301);
    EXPECT_EQ(terrain.misses().count, 0U) << "it is resident, even if not yet fully blended in";
}

TEST(WaitingTerrain, HasTheHeightsOfTheMapInMemoryToTheBit)
{
    Random random;
    const TiledMap& map = roughMap();
    const TileCache cache({.bytes_max = std::size_t{1} << 20, .loader_threads = 1});
    const WaitingTerrain terrain(TiledRaster(cache, map.source), map.heights);
    for (int i = 0; i < 20'000; ++i) {
        const std::size_t column = random.below(kColumns);
        const std::size_t row = random.below(kRows);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(terrain.sample(column, row)),
                  std::bit_cast<std::uint64_t>(map.filled->sample(column, row)));
        ASSERT_EQ(terrain.isVoid(column, row), map.filled->isVoid(column, row));
    }
    EXPECT_FALSE(terrain.error().has_value());
    EXPECT_GE(terrain.fetchCount(), 30U);
}

TEST(WaitingTerrain, KeepsTheFirstErrorAndStaysBelowWhatCastsSkipBy)
{
    const TiledMap map = test::tiledMap(
        test::floatTerrain(600, 600,
                           [](std::size_t c, std::size_t r) { return static_cast<double>(c + r); }),
        {.before_read = [](const TileId& id) -> std::optional<Error> {
            return id.column == 1 && id.level == 0
                       ? std::optional(Error{ErrorCode::Unreadable, "the disk is gone"})
                       : std::nullopt;
        }});
    const TileCache cache({.bytes_max = std::size_t{1} << 24, .loader_threads = 1});
    const WaitingTerrain terrain(TiledRaster(cache, map.source), map.heights);
    EXPECT_EQ(terrain.sample(10, 10), 20.0);
    EXPECT_FALSE(terrain.error().has_value());
    EXPECT_LE(terrain.sample(300, 10), map.filled->maximum(0, 9, 0));
    ASSERT_TRUE(terrain.error().has_value());
    EXPECT_EQ(terrain.error()->message, "the disk is gone");
}

} // namespace
} // namespace marsview
