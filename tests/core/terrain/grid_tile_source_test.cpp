#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

Heightfield holedRamp(std::size_t columns, std::size_t rows)
{
    return test::int16Terrain(columns, rows, {}, [](std::size_t c, std::size_t r) {
        return c % 7 == 3 || r == 0 ? kNan : static_cast<double>(c) + 2.0 * static_cast<double>(r);
    });
}

// Compares a tile with the map, and returns how many samples it has.
std::size_t expectDecimated(const Heightfield& field, const Tile& tile)
{
    for (std::size_t row = 0; row < tile.samples.rows(); ++row) {
        for (std::size_t column = 0; column < tile.samples.columns(); ++column) {
            const std::size_t c = std::min((tile.id.column * kTileSide + column) << tile.id.level,
                                           field.columns() - 1);
            const std::size_t r =
                std::min((tile.id.row * kTileSide + row) << tile.id.level, field.rows() - 1);
            EXPECT_EQ(tile.samples.isVoid(column, row), field.samples().isVoid(c, r));
            EXPECT_EQ(tile.samples.raw(column, row), field.samples().raw(c, r));
        }
    }
    return tile.samples.columns() * tile.samples.rows();
}

TEST(GridTileSource, ReturnsEverySampleOfEveryLevelOnce)
{
    const test::GridTileSource source(holedRamp(600, 300));
    const TileLayout& layout = source.layout();
    const Heightfield& field = source.heightfield();
    ASSERT_EQ(layout.topLevel(), 2U);
    for (std::uint8_t level = 0; level <= layout.topLevel(); ++level) {
        std::size_t samples = 0;
        for (std::uint32_t row = 0; row < layout.tileRows(TileKind::Samples, level); ++row) {
            for (std::uint32_t c = 0; c < layout.tileColumns(TileKind::Samples, level); ++c) {
                samples +=
                    expectDecimated(field, source.tile({.level = level, .column = c, .row = row}));
            }
        }
        EXPECT_EQ(samples, layout.columnsAt(TileKind::Samples, level) *
                               layout.rowsAt(TileKind::Samples, level));
    }
}

TEST(GridTileSource, AveragesValidSamples)
{
    const test::GridTileSource source(holedRamp(14, 4), {.mean_levels = 2});
    const Tile means = source.tile({.kind = TileKind::Means, .level = 1, .column = 0, .row = 0});
    ASSERT_EQ(means.samples.columns(), 7U);
    // Row 0 is void; columns 2 and 3 of row 1 are 4 and void.
    EXPECT_EQ(means.samples.raw(1, 0), 4.0);
    const Tile coarse = source.tile({.kind = TileKind::Means, .level = 2, .column = 0, .row = 0});
    EXPECT_EQ(coarse.samples.raw(0, 0), 5.0); // the mean of 0, 1, 2 and of 2, 4, 6
}

TEST(GridTileSource, FailsAndCountsReadsOnDemand)
{
    const test::GridTileSource source(holedRamp(300, 300),
                                      {.before_read = [](const TileId& id) -> std::optional<Error> {
                                          if (id.column == 1) {
                                              return Error{ErrorCode::Unreadable, "no"};
                                          }
                                          return std::nullopt;
                                      }});
    auto reader = source.open();
    ASSERT_TRUE(reader);
    EXPECT_TRUE((*reader)->read({.column = 0, .row = 0}));
    EXPECT_EQ((*reader)->read({.column = 1, .row = 0}).error().message, "no");
    EXPECT_EQ(source.readCount(), 2U);
    EXPECT_EQ(source.openCount(), 1U);
}

} // namespace
} // namespace marsview
