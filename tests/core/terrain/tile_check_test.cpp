#include "core/terrain/tile_check.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

namespace marsview {
namespace {

using test::Random;

constexpr ElevationScale kScale{-0.37, 12.5};

template <typename T>
SampleGrid gridOf(std::size_t columns, std::size_t rows, Random& random, double void_share)
{
    SampleGrid grid =
        SampleGrid::create(sizeof(T) == 2 ? SampleType::Int16 : SampleType::Float32, columns, rows)
            .value();
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            const auto sample = static_cast<T>(random.uniform(-4000.0, 4000.0));
            std::memcpy(grid.rowData(r) + c * sizeof(T), &sample, sizeof(T));
            if (random.chance(void_share)) {
                grid.markVoid(c, r);
            }
        }
    }
    return grid;
}

// Every 2^level-th sample of a tile, clamped to the last.
SampleGrid cut(const SampleGrid& map, const TileLayout& layout, const TileId& id)
{
    SampleGrid tile =
        SampleGrid::create(map.type(), layout.tileWidth(id), layout.tileHeight(id)).value();
    const std::size_t bytes = sampleBytes(map.type());
    map.visit([&](auto view) {
        for (std::size_t r = 0; r < tile.rows(); ++r) {
            const std::size_t row = std::min((id.row * kTileSide + r) << id.level, map.rows() - 1);
            for (std::size_t c = 0; c < tile.columns(); ++c) {
                const std::size_t column =
                    std::min((id.column * kTileSide + c) << id.level, map.columns() - 1);
                const auto sample = view(column, row);
                std::memcpy(tile.rowData(r) + c * bytes, &sample, bytes);
                if (map.isVoid(column, row)) {
                    tile.markVoid(c, r);
                }
            }
        }
    });
    return tile;
}

struct Map {
    SampleGrid samples;
    TileLayout layout;
    MinMaxPyramid bounds;
};

template <typename T>
Map mapOf(std::size_t columns, std::size_t rows, Random& random, double void_share)
{
    auto grid = std::make_shared<SampleGrid>(gridOf<T>(columns, rows, random, void_share));
    JobMonitor monitor;
    MinMaxPyramid bounds = MinMaxPyramid::from(RawRanges::of(*grid, monitor), kScale);
    const TileLayout layout{.columns = columns, .rows = rows, .type = grid->type()};
    return {std::move(*grid), layout, std::move(bounds)};
}

template <typename F>
void eachTile(const TileLayout& layout, std::uint8_t level, F&& function)
{
    const auto along = [level](std::size_t count) {
        const std::size_t samples = TileLayout::samplesAlong(TileKind::Samples, level, count);
        return (samples + kTileSide - 1) / kTileSide;
    };
    for (std::uint32_t row = 0; row < along(layout.rows); ++row) {
        for (std::uint32_t column = 0; column < along(layout.columns); ++column) {
            function(TileId{TileKind::Samples, level, column, row});
        }
    }
}

TEST(TileCheck, AcceptsEveryTileOfItsMap)
{
    Random random;
    // Sizes at which the last tile has one sample, or ends with a block, or in one.
    for (const auto& [columns, rows] : {std::pair<std::size_t, std::size_t>{257, 513},
                                        {256, 300},
                                        {258, 289},
                                        {800, 545},
                                        {2, 3}}) {
        for (const double void_share : {0.0, 0.3, 0.9995}) {
            const Map shorts = mapOf<std::int16_t>(columns, rows, random, void_share);
            const Map floats = mapOf<float>(columns, rows, random, void_share);
            for (const Map* map : {&shorts, &floats}) {
                for (std::uint8_t level = 0; level <= 2; ++level) {
                    eachTile(map->layout, level, [&](const TileId& id) {
                        EXPECT_TRUE(isWithinBounds(cut(map->samples, map->layout, id), id,
                                                   map->layout, map->bounds, kScale))
                            << columns << " x " << rows << ", level " << int{level} << ", tile "
                            << id.column << ", " << id.row;
                    });
                }
            }
        }
    }
}

TEST(TileCheck, RefusesWhatADamagedTileDecodesTo)
{
    Random random;
    const Map map = mapOf<std::int16_t>(900, 700, random, 0.01);
    int checked = 0;
    for (int round = 0; round < 300; ++round) {
        const TileId id{TileKind::Samples, 0, static_cast<std::uint32_t>(random.below(3)),
                        static_cast<std::uint32_t>(random.below(2))};
        SampleGrid tile = cut(map.samples, map.layout, id);
        // As differences that were summed up from a wrong one: all the rest of some rows is off by
        // as much.
        const std::size_t first_row = random.below(tile.rows() - 34);
        const std::size_t rows = 1 + random.below(tile.rows() - first_row);
        const std::size_t first_column = random.below(tile.columns() - 34);
        const auto off = static_cast<std::int16_t>(1 + random.below(2000));
        for (std::size_t r = first_row; r < first_row + rows; ++r) {
            for (std::size_t c = first_column; c < tile.columns(); ++c) {
                std::int16_t sample = 0;
                std::memcpy(&sample, tile.rowData(r) + c * 2, 2);
                sample = static_cast<std::int16_t>(sample + off);
                std::memcpy(tile.rowData(r) + c * 2, &sample, 2);
            }
        }
        // With 34 rows and columns a whole block has changed in every sample.
        const bool has_changed_block = rows >= 66 && tile.columns() - first_column >= 66;
        if (has_changed_block) {
            ++checked;
            EXPECT_FALSE(isWithinBounds(tile, id, map.layout, map.bounds, kScale)) << off;
        }
    }
    EXPECT_GT(checked, 50);
    // Another tile in its place.
    const TileId here{TileKind::Samples, 0, 1, 1};
    EXPECT_FALSE(isWithinBounds(cut(map.samples, map.layout, {TileKind::Samples, 0, 2, 1}), here,
                                map.layout, map.bounds, kScale));
}

} // namespace
} // namespace marsview
