#include "haptics/terrain/clipmap_plan.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace marsview {
namespace {

using test::Random;
using test::samplesTile;

constexpr TileLayout kLayout{.columns = 106'694, .rows = 53'347};

std::size_t rankOf(const ClipmapPlan& plan, const TileId& id)
{
    return static_cast<std::size_t>(std::find(plan.tiles.begin(), plan.tiles.end(), id) -
                                    plan.tiles.begin());
}

TileId tileUnder(std::size_t level, GridPoint at)
{
    return samplesTile(level, static_cast<std::size_t>(at.column) >> (8 + level),
                       static_cast<std::size_t>(at.row) >> (8 + level));
}

TEST(ClipmapPlan, RequestsEachTileOnceAndOnlyWithinTheWindow)
{
    Random random;
    for (int i = 0; i < 200; ++i) {
        const double speed = std::exp(random.uniform(0.0, 13.0));
        const double heading = random.uniform(0.0, 6.3);
        const HandMotion motion{.at = {random.uniform(-1e3, 1.1e5), random.uniform(-1e3, 6e4)},
                                .columns_per_s = speed * std::cos(heading),
                                .rows_per_s = speed * std::sin(heading),
                                .is_active = true};
        const ClipmapPlan plan = planWindow(kLayout, motion, {});
        std::set<std::tuple<int, std::size_t, std::size_t>> seen;
        ASSERT_EQ(plan.centers.size(), kLayout.topLevel() + 1);
        for (const TileId& id : plan.tiles) {
            EXPECT_TRUE(kLayout.contains(id));
            EXPECT_GE(id.level, plan.finest_level);
            EXPECT_TRUE(seen.emplace(id.level, id.column, id.row).second);
            const std::size_t side = id.level == 0 ? 8 : 4;
            const std::size_t columns = kLayout.tileColumns(TileKind::Samples, id.level);
            const std::size_t rows = kLayout.tileRows(TileKind::Samples, id.level);
            const std::size_t column = Clipmap::firstTile(plan.centers[id.level].column, id.level,
                                                          columns, std::min(side, columns));
            const std::size_t row = Clipmap::firstTile(plan.centers[id.level].row, id.level, rows,
                                                       std::min(side, rows));
            EXPECT_TRUE(id.column >= column && id.column < column + side);
            EXPECT_TRUE(id.row >= row && id.row < row + side);
        }
    }
}

TEST(ClipmapPlan, BeginsUnderTheHandFromCoarseToFine)
{
    const GridPoint at{30'100.0, 20'200.0};
    const ClipmapPlan plan = planWindow(kLayout, {.at = at, .is_active = true}, {});
    EXPECT_EQ(plan.finest_level, 0U);
    const std::size_t top = kLayout.topLevel();
    for (std::size_t rank = 0; rank < top; ++rank) {
        EXPECT_EQ(plan.tiles[rank], tileUnder(top - 1 - rank, at));
    }
    for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
            EXPECT_LT(rankOf(plan, tileUnder(0, {at.column + 256.0 * dc, at.row + 256.0 * dr})),
                      plan.tiles.size());
        }
    }
}

TEST(ClipmapPlan, FollowsTheHandsWayInTheOrderOfItsTime)
{
    // Three tiles to the right within the look-ahead time.
    const GridPoint at{30'150.0, 20'200.0};
    const ClipmapPlan plan =
        planWindow(kLayout, {.at = at, .columns_per_s = 1400.0, .is_active = true},
                   {.sides = {}, .tiles_per_s = 1000.0});
    EXPECT_EQ(plan.finest_level, 0U);
    std::size_t last = 0;
    for (int tiles = 1; tiles <= 3; ++tiles) {
        const std::size_t rank = rankOf(plan, tileUnder(0, {at.column + 256.0 * tiles, at.row}));
        EXPECT_GT(rank, last) << tiles;
        EXPECT_LT(rank, plan.tiles.size()) << tiles;
        last = rank;
    }
    EXPECT_GT(rankOf(plan, tileUnder(0, {at.column - 256.0, at.row})),
              rankOf(plan, tileUnder(0, {at.column + 256.0, at.row})));
}

TEST(ClipmapPlan, RequestsOnlyTilesThatArriveInTime)
{
    std::size_t last = 0;
    for (const double speed : {0.0, 1e3, 1e4, 5e4, 2e5, 1e6}) {
        for (const double tiles_per_s : {20.0, 2000.0}) {
            const ClipmapPlan plan =
                planWindow(kLayout, {.at = {5e4, 2e4}, .columns_per_s = speed, .is_active = true},
                           {.sides = {}, .tiles_per_s = tiles_per_s});
            // The tiles per second that the corridor needs.
            const double needed =
                3.0 * speed / (256.0 * std::pow(2.0, static_cast<double>(plan.finest_level)));
            EXPECT_TRUE(needed <= tiles_per_s || plan.finest_level == kLayout.topLevel());
            if (tiles_per_s > 1000.0) {
                EXPECT_GE(plan.finest_level, last);
                last = plan.finest_level;
            }
        }
    }
    EXPECT_GE(last, 2U);
}

} // namespace
} // namespace marsview
