#include "core/tiles/mean_samples_source.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {
namespace {

using test::GridTileSource;

constexpr std::size_t kColumns = 1111;
constexpr std::size_t kRows = 777;

std::shared_ptr<GridTileSource> sourceOf(const test::HeightFunction& height,
                                         std::size_t mean_levels)
{
    return std::make_shared<GridTileSource>(test::floatTerrain(kColumns, kRows, height),
                                            GridTileSource::Options{.mean_levels = mean_levels});
}

std::vector<TileId> tilesOf(const TileLayout& layout, TileKind kind, std::size_t level)
{
    std::vector<TileId> tiles;
    for (std::uint32_t row = 0; row < layout.tileRows(kind, level); ++row) {
        for (std::uint32_t column = 0; column < layout.tileColumns(kind, level); ++column) {
            tiles.push_back({kind, static_cast<std::uint8_t>(level), column, row});
        }
    }
    return tiles;
}

// Calls function(column, row, tile, i, j) for every sample of a level: its position on the map and
// in its tile.
template <typename F>
void forEachSample(const TileSource& source, std::size_t level, const F& function)
{
    const TileLayout& layout = source.layout();
    const auto reader = source.open();
    ASSERT_TRUE(reader);
    for (const TileId& id : tilesOf(layout, TileKind::Samples, level)) {
        const auto tile = (*reader)->read(id);
        ASSERT_TRUE(tile) << tile.error().message;
        ASSERT_EQ(tile->samples.columns(), layout.tileWidth(id));
        ASSERT_EQ(tile->samples.rows(), layout.tileHeight(id));
        for (std::size_t j = 0; j < tile->samples.rows(); ++j) {
            for (std::size_t i = 0; i < tile->samples.columns(); ++i) {
                function(std::min((id.column * kTileSide + i) << level, kColumns - 1),
                         std::min((id.row * kTileSide + j) << level, kRows - 1), *tile, i, j);
            }
        }
    }
}

TEST(MeanSamplesSource, PassesFullResolutionAndMeansThrough)
{
    test::Random random;
    const auto source = sourceOf(
        test::heightsFrom(test::fractalHeights(random, kColumns, kRows, 900.0, 0.5), kColumns), 2);
    const auto made = samplesFromMeans(source);
    const auto reader = made->open();
    for (const auto& [kind, level] :
         {std::pair{TileKind::Samples, 0}, {TileKind::Means, 1}, {TileKind::Means, 2}}) {
        for (const TileId& id : tilesOf(source->layout(), kind, static_cast<std::size_t>(level))) {
            const auto tile = (*reader)->read(id);
            const Tile truth = source->tile(id);
            ASSERT_TRUE(tile);
            for (std::size_t j = 0; j < truth.samples.rows(); ++j) {
                for (std::size_t i = 0; i < truth.samples.columns(); ++i) {
                    ASSERT_EQ(tile->samples.raw(i, j), truth.samples.raw(i, j));
                }
            }
        }
    }
}

// The means of a plane are the plane at the block centers, and so are the values interpolated
// between them: a shift by half a block, or a wrong tile, is detected.
TEST(MeanSamplesSource, ReproducesAPlaneAtEveryLevel)
{
    const auto plane = [](std::size_t column, std::size_t row) {
        return 3.0 * static_cast<double>(column) - 2.0 * static_cast<double>(row);
    };
    const std::size_t mean_levels = 2;
    const auto made = samplesFromMeans(sourceOf(plane, mean_levels));
    for (std::size_t level = 1; level <= made->layout().topLevel(); ++level) {
        // Outside the outermost centers there is nothing to interpolate between.
        const std::size_t block = std::size_t{1} << std::min(level, mean_levels);
        std::size_t inner = 0;
        forEachSample(*made, level,
                      [&](std::size_t column, std::size_t row, const Tile& tile, std::size_t i,
                          std::size_t j) {
                          const double off = std::abs(tile.samples.raw(i, j) - plane(column, row));
                          if (column >= block && row >= block && column + 2 * block < kColumns &&
                              row + 2 * block < kRows) {
                              ++inner;
                              ASSERT_LT(off, 1e-3) << level << ' ' << column << ' ' << row;
                          } else {
                              ASSERT_LE(off, 5.0 * static_cast<double>(block));
                          }
                      });
        EXPECT_GT(inner, 100U >> level);
    }
}

TEST(MeanSamplesSource, SamplesAreCloseToTheTrueOnes)
{
    test::Random random;
    const std::vector<double> heights = test::fractalHeights(random, kColumns, kRows, 900.0, 0.5);
    const auto made = samplesFromMeans(sourceOf(test::heightsFrom(heights, kColumns), 3));
    double before = 0.0;
    for (std::size_t level = 1; level <= 3; ++level) {
        double squares = 0.0;
        double count = 0.0;
        forEachSample(*made, level,
                      [&](std::size_t column, std::size_t row, const Tile& tile, std::size_t i,
                          std::size_t j) {
                          const double off =
                              tile.samples.raw(i, j) - heights[row * kColumns + column];
                          squares += off * off;
                          count += 1.0;
                      });
        const double rms = std::sqrt(squares / count);
        EXPECT_GT(rms, before);
        // For terrain within ±900 m: smaller than the relief over a block.
        EXPECT_LT(rms, 10.0 * static_cast<double>(1U << level));
        before = rms;
    }
}

TEST(MeanSamplesSource, SamplesAreVoidIfAllBlocksAroundThemAre)
{
    const auto source = sourceOf(
        [](std::size_t column, std::size_t row) {
            return column >= 400 && column < 600 && row >= 300 ? kNan : 50.0;
        },
        2);
    const auto made = samplesFromMeans(source);
    for (std::size_t level = 1; level <= 2; ++level) {
        const std::size_t block = std::size_t{1} << level;
        forEachSample(*made, level,
                      [&](std::size_t column, std::size_t row, const Tile& tile, std::size_t i,
                          std::size_t j) {
                          const bool is_deep = column >= 400 + 2 * block &&
                                               column + 2 * block < 600 && row >= 300 + 2 * block;
                          const bool is_away = column + 2 * block < 400 ||
                                               column >= 600 + 2 * block || row + 2 * block < 300;
                          if (is_deep) {
                              ASSERT_TRUE(tile.samples.isVoid(i, j));
                          } else if (is_away) {
                              ASSERT_FALSE(tile.samples.isVoid(i, j));
                          }
                          if (!tile.samples.isVoid(i, j)) {
                              ASSERT_EQ(tile.samples.raw(i, j), 50.0);
                          }
                      });
    }
}

TEST(MeanSamplesSource, ReadsEachTileOfMeansOncePerRowOfTiles)
{
    std::vector<TileId> read;
    const auto source = std::make_shared<GridTileSource>(
        test::floatTerrain(kColumns, kRows, [](std::size_t, std::size_t) { return 1.0; }),
        GridTileSource::Options{.mean_levels = 3,
                                .before_read = [&read](const TileId& id) -> std::optional<Error> {
                                    read.push_back(id);
                                    return std::nullopt;
                                }});
    const auto reader = samplesFromMeans(source)->open();
    for (const TileId& id : tilesOf(source->layout(), TileKind::Samples, 1)) {
        ASSERT_TRUE((*reader)->read(id));
    }
    EXPECT_EQ(read.size(), source->layout().tileColumns(TileKind::Means, 1) *
                               source->layout().tileRows(TileKind::Means, 1));
    for (const TileId& id : read) {
        EXPECT_EQ(id.kind, TileKind::Means);
        EXPECT_EQ(id.level, 1);
    }
}

TEST(MeanSamplesSource, FinerLevelsCanBeLeftToTheSource)
{
    const auto source = sourceOf(
        [](std::size_t c, std::size_t r) { return static_cast<double>((c * 31 + r * 17) % 101); },
        3);
    const auto made = samplesFromMeans(source, 2);
    const TileId id{TileKind::Samples, 1, 1, 0};
    const auto tile = (*made->open())->read(id);
    ASSERT_TRUE(tile);
    EXPECT_EQ(tile->samples.raw(7, 9), source->tile(id).samples.raw(7, 9));
}

TEST(MeanSamplesSource, PassesErrorsOnAndRetries)
{
    bool is_failing = true;
    const auto source = std::make_shared<GridTileSource>(
        test::floatTerrain(kColumns, kRows, [](std::size_t, std::size_t) { return 1.0; }),
        GridTileSource::Options{
            .mean_levels = 3, .before_read = [&](const TileId&) -> std::optional<Error> {
                return is_failing ? std::optional<Error>(Error{ErrorCode::Unreadable, "x: broke"})
                                  : std::nullopt;
            }});
    const auto reader = samplesFromMeans(source)->open();
    const TileId id{TileKind::Samples, 2, 0, 0};
    const auto failed = (*reader)->read(id);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "x: broke");
    is_failing = false;
    EXPECT_TRUE((*reader)->read(id));
}

} // namespace
} // namespace marsview
