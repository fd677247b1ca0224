#include "core/terrain/relief_tile.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace marsview {
namespace {

constexpr std::size_t kTexels = ReliefTile::kTexels;
constexpr std::size_t kBorder = ReliefTile::kBorder;

// The mean slope of a profile through `height` over the samples [begin, end), extended by half a
// sample on each side as far as the profile reaches: the mean of the slopes of its segments.
double meanSlope(const std::function<double(std::size_t)>& height,
                 std::size_t begin,
                 std::size_t end,
                 std::size_t count)
{
    const double from = std::max(static_cast<double>(begin) - 0.5, 0.0);
    const double to = std::min(static_cast<double>(end) - 0.5, static_cast<double>(count - 1));
    double sum = 0.0;
    for (std::size_t piece = begin > 0 ? begin - 1 : 0; piece < std::min(end, count - 1); ++piece) {
        const double left = std::max(from, static_cast<double>(piece));
        const double right = std::min(to, static_cast<double>(piece + 1));
        sum += std::max(0.0, right - left) * (height(piece + 1) - height(piece));
    }
    return sum / (to - from);
}

struct Slope {
    double east = 0.0;
    double north = 0.0;
};

// The gradient in the scene for given slopes per column and row: the solution of slope per column =
// east · east per column + north · north per column, and likewise for rows.
Slope inScene(double per_column, double per_row, const SceneFrame& frame)
{
    const double a = frame.east_per_column;
    const double b = frame.north_per_column;
    const double c = frame.east_per_row;
    const double d = frame.north_per_row;
    const double determinant = a * d - b * c;
    return {.east = (per_column * d - b * per_row) / determinant,
            .north = (a * per_row - c * per_column) / determinant};
}

// The sample range of a texel.
struct TexelSamples {
    std::size_t x0 = 0;
    std::size_t x1 = 0; // exclusive
    std::size_t y0 = 0;
    std::size_t y1 = 0;
};

std::optional<TexelSamples>
samplesOf(const Heightfield& field, const ReliefTileId& id, std::size_t i, std::size_t j)
{
    const std::size_t step = std::size_t{1} << id.level;
    if (id.column * kTexels + i < kBorder || id.row * kTexels + j < kBorder) {
        return std::nullopt;
    }
    const std::size_t x0 = (id.column * kTexels + i - kBorder) * step;
    const std::size_t y0 = (id.row * kTexels + j - kBorder) * step;
    if (x0 >= field.columns() || y0 >= field.rows()) {
        return std::nullopt;
    }
    return TexelSamples{.x0 = x0,
                        .x1 = std::min(x0 + step, field.columns()),
                        .y0 = y0,
                        .y1 = std::min(y0 + step, field.rows())};
}

Slope trueSlope(const Heightfield& field, const SceneFrame& frame, const TexelSamples& texel)
{
    double per_column = 0.0;
    double per_row = 0.0;
    for (std::size_t y = texel.y0; y < texel.y1; ++y) {
        per_column += meanSlope([&](std::size_t x) { return field.sample(x, y); }, texel.x0,
                                texel.x1, field.columns());
    }
    for (std::size_t x = texel.x0; x < texel.x1; ++x) {
        per_row += meanSlope([&](std::size_t y) { return field.sample(x, y); }, texel.y0, texel.y1,
                             field.rows());
    }
    return inScene(per_column / static_cast<double>(texel.y1 - texel.y0),
                   per_row / static_cast<double>(texel.x1 - texel.x0), frame);
}

double slopeAt(const ReliefTile::Level& level, std::size_t i, std::size_t j, std::size_t which)
{
    const ReliefTexel& texel = level.texels[j * level.side + i];
    return (which == 0 ? texel.east : texel.north) / 32767.0;
}

double shareAt(const ReliefTile::Level& level, std::size_t i, std::size_t j)
{
    return level.texels[j * level.side + i].share / 32767.0;
}

// Times the valid share, relative to the middle of the tile's height range.
double weightedHeightAt(const ReliefTile& tile, std::size_t level, std::size_t i, std::size_t j)
{
    const ReliefTile::Level& mip = tile.levels.at(level);
    return mip.texels[j * mip.side + i].height / 32767.0 * tile.height_reach_m;
}

// Over the texel's valid samples; NaN if it has none.
double meanHeight(const Heightfield& field, const TexelSamples& texel)
{
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t y = texel.y0; y < texel.y1; ++y) {
        for (std::size_t x = texel.x0; x < texel.x1; ++x) {
            const double height_m = field.sample(x, y);
            sum += std::isnan(height_m) ? 0.0 : height_m;
            count += std::isnan(height_m) ? 0.0 : 1.0;
        }
    }
    return sum / count;
}

SceneFrame rotatedFrame(std::size_t columns, std::size_t rows)
{
    SceneFrame frame = test::northUpFrame(columns, rows, 1.0);
    frame.east_per_column = 17.0;
    frame.north_per_column = 9.0;
    frame.east_per_row = -11.0;
    frame.north_per_row = 23.0; // mirrored, too
    return frame;
}

// A texel; outside the map the nearest one on its border.
std::size_t
nearestOnMap(std::size_t texel, std::size_t tile, std::size_t level, std::size_t samples)
{
    const std::size_t step = std::size_t{1} << level;
    const std::size_t last = (samples - 1) / step; // the map's last texel
    const std::size_t on_map =
        std::min(std::max(tile * kTexels + texel, kBorder) - kBorder, last) + kBorder;
    return on_map - tile * kTexels;
}

void expectTrueSlopes(const Heightfield& field, const SceneFrame& frame, const ReliefTileId& id)
{
    SCOPED_TRACE("level " + std::to_string(id.level) + ", tile " + std::to_string(id.column) +
                 ", " + std::to_string(id.row));
    constexpr double kSlopeMax = 40.0;
    const ReliefTile tile = makeReliefTile(field, frame, id, kSlopeMax);
    const ReliefTile::Level& finest = tile.levels.front();
    ASSERT_EQ(finest.side, ReliefTile::kSide);
    std::size_t compared = 0;
    // Texels beyond the map repeat those of its edge.
    std::map<std::array<std::size_t, 2>, Slope> known;
    double low_m = std::numeric_limits<double>::infinity();
    double high_m = -low_m;
    for (std::size_t j = 0; j < finest.side; ++j) {
        for (std::size_t i = 0; i < finest.side; ++i) {
            const auto samples =
                samplesOf(field, id, nearestOnMap(i, id.column, id.level, field.columns()),
                          nearestOnMap(j, id.row, id.level, field.rows()));
            ASSERT_TRUE(samples);
            const auto [entry, is_new] = known.try_emplace({samples->x0, samples->y0});
            if (is_new) {
                entry->second = trueSlope(field, frame, *samples);
            }
            const Slope& slope = entry->second;
            const double height_m = meanHeight(field, *samples);
            low_m = std::min(low_m, height_m);
            high_m = std::max(high_m, height_m);
            ASSERT_NEAR(tile.height_middle_m + weightedHeightAt(tile, 0, i, j), height_m,
                        0.51 / 32767.0 * tile.height_reach_m + 1e-3)
                << i << ", " << j;
            ASSERT_EQ(shareAt(finest, i, j), 1.0);
            ASSERT_NEAR(slopeAt(finest, i, j, 0) * kSlopeMax, slope.east, 1.0 / 32767.0 * kSlopeMax)
                << i << ", " << j;
            ASSERT_NEAR(slopeAt(finest, i, j, 1) * kSlopeMax, slope.north,
                        1.0 / 32767.0 * kSlopeMax)
                << i << ", " << j;
            ++compared;
        }
    }
    EXPECT_EQ(compared, ReliefTile::kSide * ReliefTile::kSide);
    if (low_m < high_m) {
        EXPECT_NEAR(tile.height_reach_m, (high_m - low_m) / 2.0, 1e-3) << "all bits are used";
    }
}

TEST(ReliefTile, HasMeanSlopesAndElevationsUpToTheMapsBorders)
{
    test::Random random;
    constexpr std::size_t kColumns = 571;
    constexpr std::size_t kRows = 301;
    const auto heights =
        test::heightsFrom(test::fractalHeights(random, kColumns, kRows, 500.0, 0.5), kColumns);
    const Heightfield field = test::floatTerrain(kColumns, kRows, heights);
    const Heightfield coarse = test::int16Terrain(kColumns, kRows, {.gain = 0.5}, heights);
    for (std::size_t level = 0; level <= 5; ++level) {
        const std::size_t side = kTexels << level;
        for (std::size_t row = 0; row * side < kRows; ++row) {
            for (std::size_t column = 0; column * side < kColumns; ++column) {
                expectTrueSlopes(field, test::northUpFrame(kColumns, kRows, 30.0),
                                 {level, column, row});
                expectTrueSlopes(coarse, rotatedFrame(kColumns, kRows), {level, column, row});
            }
        }
    }
}

// Where its sides meet, a map is one turn of endless rows: a tile of it is that of a map of three
// turns, one turn further on.
TEST(ReliefTile, GoesOnAtTheOtherSideOfAMapAroundItsBody)
{
    test::Random random;
    constexpr std::size_t kRows = 70;
    for (const double void_share : {0.0, 0.05}) {
        for (std::size_t level = 0; level <= 2; ++level) {
            const std::size_t columns = 2 * kTexels << level;
            std::vector<double> turn = test::fractalHeights(random, columns, kRows, 500.0, 0.5);
            for (double& height_m : turn) {
                height_m = random.chance(void_share) ? kNan : height_m;
            }
            const auto heights = test::heightsFrom(turn, columns);
            const Heightfield map = test::floatTerrain(columns, kRows, heights);
            const Heightfield turns =
                test::floatTerrain(3 * columns, kRows, [&](std::size_t column, std::size_t row) {
                    return heights(column % columns, row);
                });
            const SceneFrame frame = test::northUpFrame(columns, kRows, 30.0);
            for (const std::size_t column : {std::size_t{0}, std::size_t{1}}) {
                const ReliefTile tile =
                    makeReliefTile(map, frame, {level, column, 0}, 40.0, MapSides::Meet);
                const ReliefTile truth = makeReliefTile(turns, frame, {level, column + 2, 0}, 40.0);
                for (std::size_t mip = 0; mip < tile.levels.size(); ++mip) {
                    EXPECT_EQ(tile.levels[mip].texels, truth.levels[mip].texels)
                        << "level " << level << ", tile " << column << ", mip " << mip;
                }
            }
        }
    }
}

TEST(ReliefTile, IsCorrectOnTheSmallestMapsAndOnStrips)
{
    test::Random random;
    for (const auto& [columns, rows] :
         {std::pair<std::size_t, std::size_t>{2, 2}, {2, 700}, {700, 2}, {257, 256}, {3, 3}}) {
        const Heightfield field = test::floatTerrain(
            columns, rows,
            test::heightsFrom(test::fractalHeights(random, columns, rows, 50.0, 0.8), columns));
        for (std::size_t level = 0; level <= 5; ++level) {
            const std::size_t side = kTexels << level;
            expectTrueSlopes(field, rotatedFrame(columns, rows),
                             {level, (columns - 1) / side, (rows - 1) / side});
        }
    }
}

TEST(ReliefTile, HasAPlanesSlopeUpToTheBordersOfMapsAndHoles)
{
    constexpr std::size_t kColumns = 333;
    constexpr std::size_t kRows = 290;
    const SceneFrame frame = rotatedFrame(kColumns, kRows);
    for (const bool has_voids : {false, true}) {
        const Heightfield field =
            test::floatTerrain(kColumns, kRows, [&](std::size_t c, std::size_t r) {
                const bool is_void = has_voids && c % 150 > 90 && r % 100 < 37;
                const ScenePoint p =
                    frame.toScene({static_cast<double>(c), static_cast<double>(r)}, 0.0);
                return is_void ? kNan : 0.125 * p.x - 0.5 * p.y;
            });
        for (std::size_t level = 0; level <= 5; ++level) {
            const ReliefTile tile = makeReliefTile(field, frame, {level, 0, 0}, 1.0);
            for (const ReliefTile::Level& mip : tile.levels) {
                for (std::size_t j = 0; j < mip.side; ++j) {
                    for (std::size_t i = 0; i < mip.side; ++i) {
                        if (shareAt(mip, i, j) < 1.0) {
                            continue; // weighted, and with data on one side only
                        }
                        constexpr double kTolerance = 3.0 / 32767.0; // half of it per level
                        ASSERT_NEAR(slopeAt(mip, i, j, 0), 0.125, kTolerance)
                            << level << ": " << i << ", " << j << " of " << mip.side;
                        ASSERT_NEAR(slopeAt(mip, i, j, 1), -0.5, kTolerance)
                            << level << ": " << i << ", " << j << " of " << mip.side;
                    }
                }
            }
        }
    }
}

// As the header describes: the sample across the texel's border replaces a void, half a sample
// away.
TEST(ReliefTile, WeighsSlopesAndElevationsByTheValidShare)
{
    test::Random random;
    constexpr std::size_t kColumns = 300;
    constexpr std::size_t kRows = 280;
    constexpr double kSlopeMax = 100.0;
    const auto heights = test::fractalHeights(random, kColumns, kRows, 200.0, 0.6);
    const Heightfield field =
        test::floatTerrain(kColumns, kRows, [&](std::size_t c, std::size_t r) {
            const bool is_hole = c > 100 && c < 200 && r > 90 && r < 130;
            return is_hole || random.chance(0.2) ? kNan : heights[r * kColumns + c];
        });
    const auto sample = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
        const bool is_on_map = c >= 0 && r >= 0 && c < static_cast<std::ptrdiff_t>(kColumns) &&
                               r < static_cast<std::ptrdiff_t>(kRows);
        return is_on_map ? field.sample(static_cast<std::size_t>(c), static_cast<std::size_t>(r))
                         : kNan;
    };
    // Slope between two borders, from the samples before and after each.
    const auto slope = [](double a, double b, double c, double d, double length) {
        const bool is_left_whole = !std::isnan(a) && !std::isnan(b);
        const bool is_right_whole = !std::isnan(c) && !std::isnan(d);
        const double left = is_left_whole ? (a + b) / 2.0 : std::isnan(a) ? b : a;
        const double right = is_right_whole ? (c + d) / 2.0 : std::isnan(c) ? d : c;
        const double left_at = is_left_whole ? 0.0 : std::isnan(a) ? 0.5 : -0.5;
        const double right_at = length + (is_right_whole ? 0.0 : std::isnan(c) ? 0.5 : -0.5);
        return right_at > left_at ? (right - left) / (right_at - left_at) : kNan;
    };
    const SceneFrame frame = test::northUpFrame(kColumns, kRows, 1.0);
    for (std::size_t level = 0; level <= 4; ++level) {
        const ReliefTileId id{level, 0, 0};
        const ReliefTile tile = makeReliefTile(field, frame, id, kSlopeMax);
        const ReliefTile::Level& finest = tile.levels.front();
        for (std::size_t j = kBorder; j < finest.side; ++j) {
            for (std::size_t i = kBorder; i < finest.side; ++i) {
                const auto texel = samplesOf(field, id, i, j);
                if (!texel) {
                    continue;
                }
                const auto x0 = static_cast<std::ptrdiff_t>(texel->x0);
                const auto x1 = static_cast<std::ptrdiff_t>(texel->x1);
                const auto y0 = static_cast<std::ptrdiff_t>(texel->y0);
                const auto y1 = static_cast<std::ptrdiff_t>(texel->y1);
                double sum = 0.0;
                double count = 0.0;
                double there = 0.0;
                for (std::ptrdiff_t y = y0; y < y1; ++y) {
                    const double s = slope(sample(x0 - 1, y), sample(x0, y), sample(x1 - 1, y),
                                           sample(x1, y), static_cast<double>(x1 - x0));
                    sum += std::isnan(s) ? 0.0 : s;
                    count += std::isnan(s) ? 0.0 : 1.0;
                    for (std::ptrdiff_t x = x0; x < x1; ++x) {
                        there += std::isnan(sample(x, y)) ? 0.0 : 1.0;
                    }
                }
                const double share =
                    there / static_cast<double>((texel->x1 - texel->x0) * (texel->y1 - texel->y0));
                const double expected = count > 0.0 ? sum / count * share : 0.0;
                ASSERT_NEAR(slopeAt(finest, i, j, 0) * kSlopeMax, expected,
                            1.0 / 32767.0 * kSlopeMax)
                    << level << ": " << i << ", " << j;
                ASSERT_NEAR(shareAt(finest, i, j), share, 0.5 / 32767.0 + 1e-6);
                const double height_m =
                    there > 0.0 ? (meanHeight(field, *texel) - tile.height_middle_m) * share : 0.0;
                ASSERT_NEAR(weightedHeightAt(tile, 0, i, j), height_m,
                            1.1 / 32767.0 * tile.height_reach_m + 1e-3);
            }
        }
    }
}

// So that shading looks the same at every source level.
TEST(ReliefTile, SmallerCopiesMatchTheCoarserLevels)
{
    test::Random random;
    constexpr std::size_t kSide = 1100;
    const Heightfield field = test::floatTerrain(
        kSide, kSide,
        test::heightsFrom(test::fractalHeights(random, kSide, kSide, 900.0, 0.5), kSide));
    const SceneFrame frame = rotatedFrame(kSide, kSide);
    for (std::size_t level = 0; level <= 1; ++level) {
        const ReliefTile fine = makeReliefTile(field, frame, {level, 1, 0}, 30.0);
        const ReliefTile coarse = makeReliefTile(field, frame, {level + 1, 0, 0}, 30.0);
        const ReliefTile::Level& half = fine.levels[1];
        // Tile (1, 0) starts in the middle of tile (0, 0) of the next level.
        for (std::size_t j = kBorder; j < kBorder / 2 + kTexels / 2; ++j) {
            for (std::size_t i = 0; i < half.side; ++i) {
                const std::size_t there_i = i + kBorder / 2 + kTexels / 2;
                const std::size_t there_j = j + kBorder / 2;
                for (const std::size_t which : {0U, 1U}) {
                    ASSERT_NEAR(slopeAt(half, i, j, which),
                                slopeAt(coarse.levels[0], there_i, there_j, which), 2.0 / 32767.0)
                        << level << ": " << i << ", " << j;
                }
                ASSERT_NEAR(fine.height_middle_m + weightedHeightAt(fine, 1, i, j),
                            coarse.height_middle_m + weightedHeightAt(coarse, 0, there_i, there_j),
                            2.0 / 32767.0 * coarse.height_reach_m)
                    << level << ": " << i << ", " << j;
            }
        }
    }
}

TEST(ReliefTile, ClampsSlopesToTheSteepest)
{
    const Heightfield field = test::floatTerrain(
        20, 20, [](std::size_t c, std::size_t) { return 10.0 * static_cast<double>(c); });
    const ReliefTile tile = makeReliefTile(field, test::northUpFrame(20, 20, 1.0), {0, 0, 0}, 2.0);
    EXPECT_EQ(tile.levels.front().texels[0].east, 32767);
    EXPECT_EQ(tile.levels.front().texels[0].north, 0);
}

} // namespace
} // namespace marsview
