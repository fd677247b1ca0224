#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/clipmap_blend.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

using test::samplesTile;

constexpr TileLayout kLayout{.columns = 3000, .rows = 2000};

TEST(ClipmapBlend, WeightGrowsFromZeroToOneAtTheRate)
{
    ClipmapBlend blend;
    const TileId tile = samplesTile(0, 2, 3);
    EXPECT_EQ(blend.weight(tile), 1.0);
    blend.add(kLayout, tile, 8.0);
    EXPECT_EQ(blend.weight(tile), 0.0);
    blend.advance(0.5, 2.0); // 1 m of 8
    EXPECT_EQ(blend.weight(tile), 0.125);
    blend.advance(0.0, 2.0);
    EXPECT_EQ(blend.weight(tile), 0.125);
    blend.add(kLayout, tile, 8.0);
    EXPECT_EQ(blend.weight(tile), 0.125) << "a blend in progress continues";
    blend.advance(3.0, 2.0);
    EXPECT_EQ(blend.weight(tile), 0.875);
    blend.advance(1.0, 2.0);
    EXPECT_EQ(blend.weight(tile), 1.0);
    EXPECT_TRUE(blend.isEmpty());
}

TEST(ClipmapBlend, KeepsAWeightThatItIsGiven)
{
    ClipmapBlend blend;
    const TileId tile = samplesTile(0, 2, 3);
    blend.put(kLayout, tile, 0.3);
    blend.put(kLayout, tile, 0.4);
    blend.advance(1e6, 1e6);
    EXPECT_EQ(blend.weight(tile), 0.3);
    EXPECT_EQ(blend.count(), 1U);
}

TEST(ClipmapBlend, TilesThatChangeNothingAreUsedAtOnce)
{
    ClipmapBlend blend;
    blend.add(kLayout, samplesTile(0, 0, 0), 0.0);
    EXPECT_TRUE(blend.isEmpty());
}

TEST(ClipmapBlend, ACoarserTileWaitsForTheFinerOnesUponIt)
{
    ClipmapBlend blend;
    const TileId coarse = samplesTile(1, 1, 1); // samples 511 to 1023
    const TileId fine = samplesTile(0, 2, 3);
    const TileId elsewhere = samplesTile(0, 5, 5);
    blend.add(kLayout, coarse, 1.0);
    blend.advance(0.25, 1.0);
    blend.add(kLayout, fine, 1.0);
    blend.add(kLayout, elsewhere, 4.0);
    blend.advance(0.5, 1.0);
    EXPECT_EQ(blend.weight(coarse), 0.25);
    EXPECT_EQ(blend.weight(fine), 0.5);
    EXPECT_EQ(blend.weight(elsewhere), 0.125);
    blend.advance(0.5, 1.0);
    EXPECT_EQ(blend.weight(fine), 1.0);
    EXPECT_EQ(blend.weight(coarse), 0.25) << "not within the same step";
    blend.advance(0.5, 1.0);
    EXPECT_EQ(blend.weight(coarse), 0.75);
}

TEST(ClipmapBlend, UsesAtOnceTilesThatDoNotFit)
{
    ClipmapBlend blend;
    for (std::size_t i = 0; i < ClipmapBlend::kTilesMax + 5; ++i) {
        blend.add(kLayout, samplesTile(0, i % 11, i / 11), 1.0);
    }
    EXPECT_EQ(blend.count(), ClipmapBlend::kTilesMax);
    EXPECT_EQ(blend.overflowCount(), 5U);
    blend.keepOnly([](const TileId& id, const SampleBox&) { return id.row == 0; });
    EXPECT_EQ(blend.count(), 11U);
    EXPECT_EQ(blend.weight(samplesTile(0, 0, 1)), 1.0);
    EXPECT_EQ(blend.weight(samplesTile(0, 1, 0)), 0.0);
}

TEST(ClipmapBlend, ReachCoversTheSamplesThatATileInfluences)
{
    for (const TileLayout layout : {TileLayout{.columns = 1025, .rows = 700}, kLayout}) {
        for (std::size_t level = 0; level <= layout.topLevel(); ++level) {
            const std::size_t step = std::size_t{1} << level;
            for (std::size_t c = 0; c < layout.tileColumns(TileKind::Samples, level); ++c) {
                const SampleBox reach = ClipmapBlend::reach(layout, samplesTile(level, c, 0));
                // For every sample of the map, the samples of the level before and after it.
                for (std::size_t at = 0; at < layout.columns; ++at) {
                    const bool is_sample = at % step == 0 || at == layout.columns - 1;
                    const std::size_t before = is_sample ? (at + step - 1) / step : at / step;
                    const std::size_t behind = is_sample ? before : before + 1;
                    const bool has_a_say = before / kTileSide == c || behind / kTileSide == c;
                    ASSERT_EQ(at >= reach.left && at <= reach.right, has_a_say)
                        << "level " << level << ", tile " << c << ", sample " << at;
                }
            }
        }
    }
}

} // namespace
} // namespace marsview
