#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <vector>

namespace marsview {
namespace {

using test::Random;
using test::samplesTile;
using test::TiledMap;

/// Rough terrain with holes, some of them large.
test::HeightFunction holedHeights(std::size_t columns, std::size_t rows, double scale)
{
    auto heights = std::make_shared<std::vector<float>>(test::fractalHeights(columns, rows, 11));
    return [=](std::size_t column, std::size_t row) {
        const bool is_hole = (column / 40) % 5 == 2 && (row / 30) % 4 == 1;
        return is_hole || (column * 7 + row * 13) % 101 == 0
                   ? kNan
                   : scale * static_cast<double>((*heights)[row * columns + column]);
    };
}

test::HeightFunction roughHeights(std::size_t columns, std::size_t rows, double scale)
{
    auto heights = std::make_shared<std::vector<float>>(test::fractalHeights(columns, rows, 5));
    return [=](std::size_t column, std::size_t row) {
        return scale * static_cast<double>((*heights)[row * columns + column]);
    };
}

/// Samples of any type, some of them void; the scale is odd, and its gain negative.
Heightfield terrainOfType(SampleType type, std::size_t columns, std::size_t rows, bool has_voids)
{
    const auto heights = test::fractalHeights(columns, rows, 3);
    SampleGrid grid = SampleGrid::create(type, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const double z = static_cast<double>(heights[row * columns + column]);
            const bool is_void = has_voids && (column * 3 + row * 5) % 17 < 3;
            dispatchSampleType(type, [&](auto zero) {
                using T = decltype(zero);
                const auto value =
                    static_cast<T>(is_void ? 101.0 : std::clamp(z + 50.0, 1.0, 100.0));
                std::memcpy(grid.rowData(row) + column * sizeof(T), &value, sizeof(T));
            });
        }
    }
    const SampleStatistics statistics = grid.applyRule({.nodata = 101.0}, 0, rows);
    if (statistics.void_count == 0) {
        grid.clearVoids();
    }
    return {std::make_shared<const SampleGrid>(std::move(grid)),
            statistics,
            {.gain = -0.37, .offset_m = 12.5}};
}

/// The expected content of a window, from the rules alone: in long double, with tiles stored in a
/// map.
class BruteWindow {
public:
    BruteWindow(const TiledMap& map, const Clipmap& window)
        : map_(map)
    {
        for (const TileId& id : test::tilesOf(window)) {
            if (window.has(id)) {
                tiles_.emplace(std::array<std::size_t, 3>{id.level, id.column, id.row}, true);
            }
        }
    }

    struct Said {
        long double height;
        std::size_t level;
    };
    Said at(std::size_t column, std::size_t row) const
    {
        for (std::size_t k = 0;; ++k) {
            long double height = 0.0L;
            if (atLevel(k, column, row, height)) {
                return {std::min(height, ceiling(column, row)), k};
            }
        }
    }
    /// Over all nodes of the finest level that contain the sample.
    long double ceiling(std::size_t column, std::size_t row) const
    {
        long double least = std::numeric_limits<long double>::infinity();
        const std::size_t columns = (map_.layout().columns + 30) / 32;
        const std::size_t rows = (map_.layout().rows + 30) / 32;
        for (std::size_t r = row / 32 > 0 ? row / 32 - 1 : 0; r <= row / 32 && r < rows; ++r) {
            for (std::size_t c = column / 32 > 0 ? column / 32 - 1 : 0;
                 c <= column / 32 && c < columns; ++c) {
                if (column >= c * 32 && column <= c * 32 + 32 && row >= r * 32 &&
                    row <= r * 32 + 32) {
                    least =
                        std::min(least, static_cast<long double>(map_.filled->maximum(0, c, r)));
                }
            }
        }
        return least;
    }

private:
    bool atLevel(std::size_t k, std::size_t column, std::size_t row, long double& height) const
    {
        const std::size_t step = std::size_t{1} << k;
        const auto before = [step](std::size_t at, std::size_t count) {
            return at == count - 1 ? at : at / step * step;
        };
        const auto behind = [step](std::size_t at, std::size_t count) {
            return std::min((at / step + 1) * step, count - 1);
        };
        const std::size_t w = before(column, map_.layout().columns);
        const std::size_t e = behind(column, map_.layout().columns);
        const std::size_t n = before(row, map_.layout().rows);
        const std::size_t s = behind(row, map_.layout().rows);
        const long double u =
            column == w ? 0.0L
                        : static_cast<long double>(column - w) / static_cast<long double>(e - w);
        const long double v =
            row == n ? 0.0L : static_cast<long double>(row - n) / static_cast<long double>(s - n);
        struct Part {
            std::size_t column;
            std::size_t row;
            long double weight;
        };
        const std::array<Part, 3> parts =
            u >= v ? std::array<Part, 3>{{{w, n, 1.0L - u}, {e, n, u - v}, {e, s, v}}}
                   : std::array<Part, 3>{{{w, n, 1.0L - v}, {w, s, v - u}, {e, s, u}}};
        height = 0.0L;
        for (const Part& part : parts) {
            if (part.weight == 0.0L) {
                continue;
            }
            const auto index = [step](std::size_t at) { return (at + step - 1) / step; };
            if (!tiles_.contains({k, index(part.column) / 256, index(part.row) / 256})) {
                return false;
            }
            height +=
                part.weight * static_cast<long double>(map_.filled->sample(part.column, part.row));
        }
        return true;
    }

    const TiledMap& map_;
    std::map<std::array<std::size_t, 3>, bool> tiles_;
};

std::vector<std::size_t> interesting(std::size_t count)
{
    std::vector<std::size_t> places{0,   1,   2,   31,  32,  33,  254,  255,  256,
                                    257, 511, 512, 513, 767, 768, 1023, 1024, 1025};
    for (std::size_t i = 1; i <= 12; ++i) {
        places.push_back(count - i);
    }
    std::erase_if(places, [count](std::size_t at) { return at >= count; });
    return places;
}

class ResidentWindowOfType : public testing::TestWithParam<std::tuple<SampleType, bool>> {};

TEST_P(ResidentWindowOfType, HasTheHeightsOfTheMapInMemoryToTheBit)
{
    const auto [type, has_voids] = GetParam();
    const TiledMap map = test::tiledMap(terrainOfType(type, 600, 523, has_voids));
    Clipmap window = map.window({300.0, 260.0});
    for (const TileId& id : test::tilesOf(window)) {
        if (id.level == 0) {
            window.put(map.tile(id), 0.0);
        }
    }
    const ResidentTerrain terrain(window, map.heights);
    for (std::size_t row = 0; row < 523; ++row) {
        for (std::size_t column = 0; column < 600; ++column) {
            const auto truth = std::bit_cast<std::uint64_t>(map.filled->sample(column, row));
            ASSERT_EQ(std::bit_cast<std::uint64_t>(window.height(column, row)), truth)
                << column << ", " << row;
            ASSERT_EQ(std::bit_cast<std::uint64_t>(terrain.sample(column, row)), truth);
            ASSERT_EQ(window.isVoid(column, row), map.filled->isVoid(column, row));
            ASSERT_EQ(window.read(column, row).level, 0U);
        }
    }
    EXPECT_EQ(terrain.misses().count, 0U);
}

INSTANTIATE_TEST_SUITE_P(Types,
                         ResidentWindowOfType,
                         testing::Combine(testing::Values(SampleType::UInt8,
                                                          SampleType::Int8,
                                                          SampleType::UInt16,
                                                          SampleType::Int16,
                                                          SampleType::UInt32,
                                                          SampleType::Int32,
                                                          SampleType::UInt64,
                                                          SampleType::Int64,
                                                          SampleType::Float32,
                                                          SampleType::Float64),
                                          testing::Bool()),
                         [](const auto& p) {
                             return std::string(sampleTypeName(std::get<0>(p.param))) +
                                    (std::get<1>(p.param) ? "Voids" : "");
                         });

TEST(Clipmap, ReplacesMissingTilesByTheFinestResidentLevel)
{
    Random random;
    // A multiple of a power of two plus or minus one, and sizes that are not.
    for (const auto& [columns, rows] : {std::pair{1025, 770}, {1500, 1111}, {2048, 513}}) {
        const auto width = static_cast<std::size_t>(columns);
        const auto height = static_cast<std::size_t>(rows);
        const TiledMap map =
            test::tiledMap(test::floatTerrain(width, height, holedHeights(width, height, 1.0)));
        for (const double share : {0.0, 0.3, 0.7}) {
            Clipmap window = map.window({random.uniform(0.0, columns), random.uniform(0.0, rows)},
                                        {.finest = 4, .coarser = 3});
            for (const TileId& id : test::tilesOf(window)) {
                if (random.chance(share)) {
                    window.put(map.tile(id), 0.0);
                }
            }
            const BruteWindow brute(map, window);
            std::vector<std::pair<std::size_t, std::size_t>> places;
            for (const std::size_t c : interesting(width)) {
                for (const std::size_t r : interesting(height)) {
                    places.emplace_back(c, r);
                }
            }
            for (int i = 0; i < 5000; ++i) {
                places.emplace_back(random.below(width), random.below(height));
            }
            for (const auto& [c, r] : places) {
                const auto said = brute.at(c, r);
                const auto read = window.read(c, r);
                ASSERT_EQ(read.level, said.level) << c << ", " << r;
                ASSERT_NEAR(read.height_m, static_cast<double>(said.height),
                            1e-12 * (1.0 + std::abs(read.height_m)))
                    << c << ", " << r;
            }
        }
    }
}

TEST(Clipmap, IsNeverHigherThanWhatCastsSkipBy)
{
    Random random;
    const TiledMap map =
        test::tiledMap(test::floatTerrain(1500, 1111, holedHeights(1500, 1111, 20.0)));
    for (const double share : {0.0, 0.5}) {
        Clipmap window = map.window({700.0, 500.0}, {.finest = 3, .coarser = 3});
        for (const TileId& id : test::tilesOf(window)) {
            if (random.chance(share)) {
                window.put(map.tile(id), 0.0);
            }
        }
        std::size_t bounded = 0;
        for (std::size_t row = 0; row < 1111; ++row) {
            for (std::size_t column = 0; column < 1500; ++column) {
                const double height = window.height(column, row);
                for (std::size_t level = 0; level < 3; ++level) {
                    const std::size_t side = std::size_t{32} << level;
                    // Every cell around the sample, and the node of that cell.
                    for (const std::size_t c : {column, column + 1}) {
                        for (const std::size_t r : {row, row + 1}) {
                            if (c > 0 && r > 0 && c < 1500 && r < 1111) {
                                ASSERT_LE(height, map.filled->maximum(level, (c - 1) / side,
                                                                      (r - 1) / side))
                                    << column << ", " << row;
                            }
                        }
                    }
                }
                bounded += height == map.heights->ceiling(column, row) ? 1U : 0U;
            }
        }
        EXPECT_GT(bounded, 300U) << "no bound may be too low";
    }
}

TEST(Clipmap, CoversThreeTilesPerSideAroundItsCenterAtEveryLevel)
{
    Random random;
    const TiledMap map =
        test::tiledMap(test::int16Terrain(2300, 1900, {}, roughHeights(2300, 1900, 1.0)));
    for (int i = 0; i < 300; ++i) {
        const GridPoint hand{random.uniform(-50.0, 2350.0), random.uniform(-50.0, 1950.0)};
        const Clipmap window = map.window(hand, {.finest = 4 + random.below(3), .coarser = 4});
        for (std::size_t k = 0; k < window.levelCount(); ++k) {
            const auto tile_under = [k](double at, double last) {
                return static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, last)) >> (8 + k);
            };
            const std::ptrdiff_t column = tile_under(hand.column, 2299.0);
            const std::ptrdiff_t row = tile_under(hand.row, 1899.0);
            for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(row - 1, 0); r <= row + 1; ++r) {
                for (std::ptrdiff_t c = std::max<std::ptrdiff_t>(column - 1, 0); c <= column + 1;
                     ++c) {
                    const TileId id =
                        samplesTile(k, static_cast<std::size_t>(c), static_cast<std::size_t>(r));
                    EXPECT_TRUE(!map.layout().contains(id) || window.slot(id) != nullptr)
                        << "level " << k << ", hand " << hand.column << ", " << hand.row;
                }
            }
        }
    }
}

TEST(Clipmap, DifferenceBoundsWhatATileChanges)
{
    Random random;
    long checked = 0;
    double tightest = 0.0;
    for (const auto& [columns, rows] : {std::pair{1025, 770}, {1333, 900}}) {
        const auto width = static_cast<std::size_t>(columns);
        const auto height = static_cast<std::size_t>(rows);
        const TiledMap map =
            test::tiledMap(test::floatTerrain(width, height, holedHeights(width, height, 3.0)));
        for (int round = 0; round < 12; ++round) {
            const GridPoint center{random.uniform(0.0, columns), random.uniform(0.0, rows)};
            Clipmap before = map.window(center, {.finest = 4, .coarser = 3});
            Clipmap after = map.window(center, {.finest = 4, .coarser = 3});
            const auto tiles = test::tilesOf(before);
            const TileId arriving = tiles[random.below(tiles.size())];
            for (const TileId& id : tiles) {
                if (!(id == arriving) && random.chance(0.5)) {
                    const auto tile = map.tile(id);
                    before.put(tile, 0.0);
                    after.put(tile, 0.0);
                }
            }
            if (arriving.level == map.layout().topLevel()) {
                continue;
            }
            after.put(map.tile(arriving), 0.0);
            const double difference_m = after.differenceFromCoarser(arriving);
            double most = 0.0;
            const SampleBox reach = ClipmapBlend::reach(map.layout(), arriving);
            for (std::size_t row = 0; row < height; ++row) {
                for (std::size_t column = 0; column < width; ++column) {
                    const double change =
                        std::abs(after.height(column, row) - before.height(column, row));
                    most = std::max(most, change);
                    const bool is_inside = column >= reach.left && column <= reach.right &&
                                           row >= reach.upper && row <= reach.lower;
                    ASSERT_TRUE(is_inside || change == 0.0) << column << ", " << row;
                }
            }
            EXPECT_LE(most, difference_m + 1e-12)
                << "level " << int{arriving.level} << " of " << columns << " columns";
            if (most > 0.0) {
                ++checked;
                tightest = std::max(tightest, most / difference_m);
            }
        }
    }
    EXPECT_GT(checked, 5);
    EXPECT_GT(tightest, 0.5) << "this bound is useless";
}

} // namespace
} // namespace marsview
