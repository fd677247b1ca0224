// A map read from tiles against the same map in memory.

#include "core/terrain/heightfield.h"
#include "core/terrain/node_heights.h"
#include "core/terrain/ray_cast.h"
#include "core/terrain/relief_tile.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <utility>

namespace marsview {
namespace {

using test::GridTileSource;
using test::Random;

// A map in memory and the same map in tiles, of which only the coarsest is resident.
struct Pair {
    Heightfield held;
    std::shared_ptr<const SurfaceAnalysis> analysis;
    std::unique_ptr<TileCache> cache;
    Heightfield tiled;

    const TiledRaster& raster() const { return tiled.tiles()->raster(); }
    const TileLayout& layout() const { return raster().layout(); }

    // Loads every tile of Samples with probability `share`.
    void load(Random& random, double share) const
    {
        for (std::size_t level = 0; level <= layout().topLevel(); ++level) {
            for (std::size_t row = 0; row < layout().tileRows(TileKind::Samples, level); ++row) {
                for (std::size_t column = 0;
                     column < layout().tileColumns(TileKind::Samples, level); ++column) {
                    if (random.chance(share)) {
                        ASSERT_TRUE(raster().get({.kind = TileKind::Samples,
                                                  .level = static_cast<std::uint8_t>(level),
                                                  .column = static_cast<std::uint32_t>(column),
                                                  .row = static_cast<std::uint32_t>(row)}));
                    }
                }
            }
        }
    }
};

SampleStatistics statisticsOf(const Heightfield& heightfield)
{
    SampleStatistics statistics{.raw_minimum = heightfield.range()->minimum_m,
                                .raw_maximum = heightfield.range()->maximum_m,
                                .void_count = 0,
                                .sample_count = heightfield.columns() * heightfield.rows()};
    return statistics;
}

enum class Distance { Here, AtAServer };

Pair pairOf(const Heightfield& held,
            std::size_t mean_levels = 0,
            Distance distance = Distance::Here)
{
    auto cache = std::make_unique<TileCache>(TileCacheOptions{.loader_threads = 2});
    GridTileSource::Options options;
    options.mean_levels = mean_levels;
    options.is_remote = distance == Distance::AtAServer;
    const TiledRaster raster(*cache, std::make_shared<GridTileSource>(held, options));
    auto tiles = TiledSamples::open(raster).value();
    Heightfield tiled(std::move(tiles), statisticsOf(held), held.scale());
    return {held, test::analyzed(held), std::move(cache), std::move(tiled)};
}

Heightfield mountains(std::size_t columns, std::size_t rows, double void_share)
{
    Random random;
    const std::vector<double> heights = test::fractalHeights(random, columns, rows, 4000.0, 0.55);
    return test::int16Terrain(columns, rows, {}, [&](std::size_t column, std::size_t row) {
        // Holes of all sizes, some across tile borders.
        const bool is_void = std::sin(static_cast<double>(column) / 37.0) *
                                 std::cos(static_cast<double>(row) / 53.0) >
                             1.0 - void_share;
        return is_void ? std::nan("") : heights[row * columns + column];
    });
}

void expectSame(double a, double b)
{
    if (std::isnan(a) || std::isnan(b)) {
        EXPECT_EQ(std::isnan(a), std::isnan(b));
    } else {
        EXPECT_EQ(a, b);
    }
}

struct Size {
    std::size_t columns;
    std::size_t rows;
    double void_share;
};

class TiledHeightfield : public testing::TestWithParam<Size> {
protected:
    Pair maps_ = pairOf(mountains(GetParam().columns, GetParam().rows, GetParam().void_share), 3);
    Random random_;

    GridPoint anywhere()
    {
        const auto place = [this](std::size_t count) {
            const double last = static_cast<double>(count - 1);
            const double at = random_.uniform(0.0, last);
            // Samples, rows and columns as often as positions in between.
            return random_.chance(0.3) ? std::round(at) : at;
        };
        return {place(maps_.held.columns()), place(maps_.held.rows())};
    }
};

TEST_P(TiledHeightfield, WaitingGivesIdenticalHeights)
{
    for (int i = 0; i < 3000; ++i) {
        const GridPoint at = anywhere();
        expectSame(maps_.tiled.heightWaiting(at), maps_.held.height(at));
    }
}

TEST_P(TiledHeightfield, ResidentTilesGiveIdenticalHeights)
{
    maps_.load(random_, 1.0);
    for (int i = 0; i < 3000; ++i) {
        const GridPoint at = anywhere();
        EXPECT_TRUE(maps_.tiled.isExact(at));
        expectSame(maps_.tiled.height(at), maps_.held.height(at));
    }
}

// By brute force: from the finest level that has all tiles around the position.
TEST_P(TiledHeightfield, TheFinestCoarserSurfaceReplacesMissingTiles)
{
    maps_.load(random_, 0.4);
    const TileLayout& layout = maps_.layout();
    const auto is_there = [&](std::size_t level, std::size_t i, std::size_t j) {
        const TileId id{.kind = TileKind::Samples,
                        .level = static_cast<std::uint8_t>(level),
                        .column = static_cast<std::uint32_t>(i / kTileSide),
                        .row = static_cast<std::uint32_t>(j / kTileSide)};
        return level == layout.topLevel() || maps_.raster().find(id) != nullptr;
    };
    const auto expected = [&](std::size_t column, std::size_t row) {
        for (std::size_t level = 0;; ++level) {
            const std::size_t step = std::size_t{1} << level;
            const std::size_t i =
                std::min(column / step, layout.columnsAt(TileKind::Samples, level) - 2);
            const std::size_t j = std::min(row / step, layout.rowsAt(TileKind::Samples, level) - 2);
            const std::size_t left = i * step;
            const std::size_t upper = j * step;
            const std::size_t right = std::min(left + step, layout.columns - 1);
            const std::size_t lower = std::min(upper + step, layout.rows - 1);
            const double u = static_cast<double>(column - left) / static_cast<double>(right - left);
            const double v = static_cast<double>(row - upper) / static_cast<double>(lower - upper);
            // Weights of upper left, upper right, lower left and lower right.
            const double w[4] = {1.0 - std::max(u, v), std::max(u - v, 0.0), std::max(v - u, 0.0),
                                 std::min(u, v)};
            bool has_all = true;
            double sum = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                if (w[k] > 0.0) {
                    has_all = has_all && is_there(level, i + k % 2, j + k / 2);
                    sum += w[k] *
                           maps_.held.sample(k % 2 == 0 ? left : right, k / 2 == 0 ? upper : lower);
                }
            }
            if (has_all) {
                return sum;
            }
        }
    };
    std::size_t exact = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::size_t column = random_.below(layout.columns);
        const std::size_t row = random_.below(layout.rows);
        const double height = maps_.tiled.sample(column, row);
        const double truth = expected(column, row);
        EXPECT_EQ(std::isnan(height), std::isnan(truth));
        if (!std::isnan(height)) {
            EXPECT_NEAR(height, truth, 1e-9);
            exact += height == maps_.held.sample(column, row) ? 1U : 0U;
        }
    }
    EXPECT_GT(exact, 100U);
}

TEST_P(TiledHeightfield, RequestedHeightsBecomeExact)
{
    for (int i = 0; i < 40; ++i) {
        const GridPoint at = anywhere();
        maps_.tiled.height(at);
        while (maps_.tiled.tiles()->isLoading()) {
            std::this_thread::yield();
        }
        EXPECT_TRUE(maps_.tiled.isExact(at));
        expectSame(maps_.tiled.height(at), maps_.held.height(at));
    }
}

TEST_P(TiledHeightfield, RaysHitTheSameSurface)
{
    maps_.load(random_, 1.0);
    for (int i = 0; i < 500; ++i) {
        const GridPoint from = anywhere();
        const GridPoint to = anywhere();
        const GridRay ray{.origin = from,
                          .origin_height_m = random_.uniform(-3000.0, 9000.0),
                          .columns_per_t = to.column - from.column,
                          .rows_per_t = to.row - from.row,
                          .height_per_t_m = random_.uniform(-9000.0, 2000.0)};
        const auto truth = castRay(maps_.held, maps_.analysis->bounds, ray);
        const auto hit = castRay(maps_.tiled, maps_.analysis->bounds, ray);
        ASSERT_EQ(hit.has_value(), truth.has_value());
        if (hit) {
            EXPECT_EQ(hit->t, truth->t);
            EXPECT_EQ(hit->height_m, truth->height_m);
        }
    }
}

TEST_P(TiledHeightfield, NodesAreDrawnFromTheirOwnLevelAlone)
{
    const DrawnSurface held(maps_.held, maps_.analysis->means);
    const DrawnSurface tiled(maps_.tiled, maps_.analysis->means);
    const DetailErrors& errors = maps_.analysis->errors;
    std::vector<TileId> missing;
    std::array<float, kNodeSide * kNodeSide> truth{};
    std::array<float, kNodeSide * kNodeSide> heights{};
    for (int i = 0; i < 60; ++i) {
        const std::size_t level = random_.below(errors.levelCount());
        const DetailNode node{level, random_.below(errors.columns(level)),
                              random_.below(errors.rows(level))};
        missing.clear();
        readNode(tiled, node, heights, missing);
        for (const TileId& id : missing) {
            EXPECT_GE(id.level, std::min(level, maps_.layout().topLevel()));
            ASSERT_TRUE(maps_.raster().get(id));
        }
        missing.clear();
        EXPECT_EQ(readNode(tiled, node, heights, missing), NodeState::Complete);
        EXPECT_TRUE(missing.empty());
        std::vector<TileId> none;
        readNode(held, node, truth, none);
        EXPECT_EQ(std::memcmp(heights.data(), truth.data(), sizeof(heights)), 0)
            << level << ' ' << node.column << ' ' << node.row;
    }
}

// No cracks, whatever tiles are missing: the height of a sample does not depend on the node that
// shows it, provided that every resident tile has its coarser tiles resident.
TEST_P(TiledHeightfield, NodesAgreeOnSharedSamples)
{
    const TileLayout& layout = maps_.layout();
    for (int i = 0; i < 12; ++i) { // tiles together with all their coarser tiles
        TileId id{.kind = TileKind::Samples,
                  .level = 0,
                  .column = static_cast<std::uint32_t>(
                      random_.below(layout.tileColumns(TileKind::Samples, 0))),
                  .row = static_cast<std::uint32_t>(
                      random_.below(layout.tileRows(TileKind::Samples, 0)))};
        for (id.level = static_cast<std::uint8_t>(random_.below(3)); id.level <= layout.topLevel();
             ++id.level) {
            const std::size_t column = std::min<std::size_t>(
                id.column >> id.level, layout.tileColumns(TileKind::Samples, id.level) - 1);
            const std::size_t row = std::min<std::size_t>(
                id.row >> id.level, layout.tileRows(TileKind::Samples, id.level) - 1);
            ASSERT_TRUE(maps_.raster().get({.kind = id.kind,
                                            .level = id.level,
                                            .column = static_cast<std::uint32_t>(column),
                                            .row = static_cast<std::uint32_t>(row)}));
        }
    }
    const DrawnSurface tiled(maps_.tiled, maps_.analysis->means);
    const DetailErrors& errors = maps_.analysis->errors;
    std::map<std::pair<std::size_t, std::size_t>, float> seen;
    std::array<float, kNodeSide * kNodeSide> heights{};
    std::vector<TileId> missing;
    std::size_t shared = 0;
    std::size_t different = 0;
    for (std::size_t level = 0; level < std::min<std::size_t>(4, errors.levelCount()); ++level) {
        for (std::size_t row = 0; row < errors.rows(level); ++row) {
            for (std::size_t column = 0; column < errors.columns(level); ++column) {
                readNode(tiled, {level, column, row}, heights, missing);
                for (std::size_t j = 0; j < kNodeSide; ++j) {
                    for (std::size_t i = 0; i < kNodeSide; ++i) {
                        // The last column and row are samples of every level, wherever they lie
                        // within it; there the coarser tile may be a different one.
                        const std::size_t c = (column * 32 + i) << level;
                        const std::size_t r = (row * 32 + j) << level;
                        if (c >= layout.columns - 1 || r >= layout.rows - 1) {
                            continue;
                        }
                        const float height = heights[j * kNodeSide + i];
                        const auto [known, is_new] = seen.try_emplace({c, r}, height);
                        shared += is_new ? 0U : 1U;
                        different += known->second != height ? 1U : 0U;
                    }
                }
            }
        }
    }
    EXPECT_EQ(different, 0U);
    EXPECT_GT(shared, 1000U);
}

double heightOf(const ReliefTile& tile, std::size_t texel)
{
    const ReliefTexel& it = tile.levels[0].texels[texel];
    return it.share == 0 ? 0.0 : tile.height_middle_m + tile.height_reach_m * it.height / it.share;
}

// The error of slopes from tiles, as a share of the root mean square slope of the samples. Full
// texels only: those at the edge of the map may have a single sample.
double reliefError(const Pair& maps, std::size_t level)
{
    const SceneFrame frame = test::northUpFrame(maps.held.columns(), maps.held.rows(), 100.0);
    constexpr double kSlopeMax = 20.0;
    const ReliefTileId id{.level = level, .column = 0, .row = 0};
    const ReliefTile truth = makeReliefTile(maps.held, frame, id, kSlopeMax);
    const Result<ReliefTile> relief = loadReliefTile(maps.tiled, frame, id, kSlopeMax);
    EXPECT_TRUE(relief);
    double squares = 0.0;
    double differences = 0.0;
    const std::size_t border = ReliefTile::kBorder;
    const auto end = [&](std::size_t samples) {
        return std::min(border + (samples >> level), ReliefTile::kSide);
    };
    for (std::size_t row = border; row < end(maps.held.rows()); ++row) {
        for (std::size_t column = border; column < end(maps.held.columns()); ++column) {
            const std::size_t i = row * ReliefTile::kSide + column;
            const ReliefTexel& a = truth.levels[0].texels[i];
            const ReliefTexel& b = relief->levels[0].texels[i];
            squares += std::pow(a.east, 2) + std::pow(a.north, 2);
            differences += std::pow(a.east - b.east, 2) + std::pow(a.north - b.north, 2);
            // Means are stored as whole meters, like the samples of this map.
            if (a.share == 32767 && b.share == 32767) {
                EXPECT_NEAR(heightOf(truth, i), heightOf(*relief, i),
                            0.5 + 4.0 / 32767.0 * truth.height_reach_m);
            }
        }
    }
    return std::sqrt(differences / squares);
}

TEST_P(TiledHeightfield, ReliefMatchesTheSamplesUpToTheSizeOfATexel)
{
    for (std::size_t level = 0; level < 5; ++level) {
        const double error = reliefError(maps_, level);
        if (level <= 2) {
            EXPECT_EQ(error, 0.0) << "built from the samples themselves";
        }
        EXPECT_LT(error, 0.15) << level;
    }
}

// A texture made from some tiles only would omit the rest of the terrain.
TEST_P(TiledHeightfield, EveryReliefTileOfAMapWithVoidsMatchesTheOneFromMemory)
{
    const SceneFrame frame = test::northUpFrame(maps_.held.columns(), maps_.held.rows(), 100.0);
    for (std::size_t level = 0; level < 4; ++level) {
        const std::size_t side = ReliefTile::kTexels << level;
        for (std::size_t row = 0; row * side < maps_.held.rows(); ++row) {
            for (std::size_t column = 0; column * side < maps_.held.columns(); ++column) {
                const ReliefTileId id{.level = level, .column = column, .row = row};
                for (const MapSides sides : {MapSides::End, MapSides::Meet}) {
                    const ReliefTile truth = makeReliefTile(maps_.held, frame, id, 20.0, sides);
                    const Result<ReliefTile> relief =
                        loadReliefTile(maps_.tiled, frame, id, 20.0, sides);
                    ASSERT_TRUE(relief);
                    if (level <= 2) {
                        EXPECT_EQ(relief->levels[0].texels, truth.levels[0].texels);
                    }
                }
            }
        }
    }
}

TEST_P(TiledHeightfield, ReliefFromAServerUsesFewerTilesAndIsSofter)
{
    const Pair remote = pairOf(maps_.held, 5, Distance::AtAServer);
    for (std::size_t level = 0; level < 5; ++level) {
        const double error = reliefError(remote, level);
        if (level <= 1) {
            EXPECT_EQ(error, 0.0) << "built from the samples themselves";
        }
        EXPECT_LT(error, 0.3) << level;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         TiledHeightfield,
                         testing::Values(Size{1100, 800, 0.0},
                                         Size{1100, 800, 0.4},
                                         Size{513, 257, 0.0},
                                         Size{2049, 300, 0.1}));

} // namespace
} // namespace marsview
