#include "core/base/float_rounding.h"
#include "core/terrain/detail_errors.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace marsview {
namespace {

constexpr std::size_t kNode = DetailErrors::kNodeCells;

struct Analysis {
    Heightfield field;
    BlockMeans means;
    DrawnSurface surface;
    DetailErrors errors;

    explicit Analysis(const Heightfield& heightfield)
        : field(heightfield)
        , means(built<BlockMeans>(field))
        , surface(field, means)
        , errors(built<DetailErrors>(surface))
    {}
    Analysis(const Analysis&) = delete; // surface is a view of its neighboring members
    Analysis& operator=(const Analysis&) = delete;

    template <typename T, typename From>
    static T built(const From& from)
    {
        JobMonitor monitor;
        return T::build(from, monitor).value();
    }
};

// The surface of a level at a sample, over the base of the map: triangulation.h on the samples that
// the level keeps.
double
levelHeight(const DrawnSurface& surface, std::size_t level, std::size_t column, std::size_t row)
{
    const std::size_t step = std::size_t{1} << level;
    const std::size_t last_column = surface.heightfield().columns() - 1;
    const std::size_t last_row = surface.heightfield().rows() - 1;
    // The last column and row belong to the last cell.
    const std::size_t left = std::min(column, last_column - 1) / step * step;
    const std::size_t upper = std::min(row, last_row - 1) / step * step;
    const std::size_t right = std::min(left + step, last_column);
    const std::size_t lower = std::min(upper + step, last_row);
    const auto height = [&](std::size_t c, std::size_t r) {
        return static_cast<double>(surface.height(c, r));
    };
    const CellHeights cell{height(left, upper), height(right, upper), height(left, lower),
                           height(right, lower)};
    return heightInCell(cell,
                        static_cast<double>(column - left) / static_cast<double>(right - left),
                        static_cast<double>(row - upper) / static_cast<double>(lower - upper));
}

// Largest distance and root mean square over the samples of a block of kNode × kNode cells.
struct BlockError {
    double largest = 0.0;
    double rms = 0.0;
};

BlockError blockError(const DrawnSurface& surface, std::size_t level, std::size_t i, std::size_t j)
{
    const Heightfield& field = surface.heightfield();
    BlockError error;
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t row = j * kNode; row <= std::min((j + 1) * kNode, field.rows() - 1); ++row) {
        for (std::size_t column = i * kNode;
             column <= std::min((i + 1) * kNode, field.columns() - 1); ++column) {
            if (field.samples().isVoid(column, row)) {
                continue;
            }
            const double off = std::abs(static_cast<double>(surface.height(column, row)) -
                                        levelHeight(surface, level, column, row));
            error.largest = std::max(error.largest, off);
            squares += off * off;
            ++count;
        }
    }
    error.rms = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
    return error;
}

std::size_t partCount(std::size_t samples, std::size_t level)
{
    const std::size_t side = kNode << level;
    return (samples - 1 + side - 1) / side;
}

void expectMeasured(const Heightfield& heightfield)
{
    const Analysis analysis(heightfield);
    const DetailErrors& errors = analysis.errors;
    SCOPED_TRACE(std::to_string(heightfield.columns()) + " x " +
                 std::to_string(heightfield.rows()));
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    const double tolerance = 2e-6 * (range.maximum_m - range.minimum_m);
    ASSERT_EQ(errors.columns(errors.levelCount() - 1), 1U);
    ASSERT_EQ(errors.rows(errors.levelCount() - 1), 1U);
    const std::size_t block_columns = partCount(heightfield.columns(), 0);
    const std::size_t block_rows = partCount(heightfield.rows(), 0);
    for (std::size_t level = 0; level < errors.levelCount(); ++level) {
        ASSERT_EQ(errors.columns(level), partCount(heightfield.columns(), level));
        ASSERT_EQ(errors.rows(level), partCount(heightfield.rows(), level));
        std::vector<double> expected(errors.columns(level) * errors.rows(level));
        std::vector<double> largest(expected.size());
        for (std::size_t j = 0; level > 0 && j < block_rows; ++j) {
            for (std::size_t i = 0; i < block_columns; ++i) {
                const BlockError block = blockError(analysis.surface, level, i, j);
                const std::size_t at = (j >> level) * errors.columns(level) + (i >> level);
                expected[at] = std::max({expected[at],
                                         block.largest / static_cast<double>(DetailErrors::kPeak),
                                         1.25 * block.rms});
                largest[at] = std::max(largest[at], block.largest);
            }
        }
        for (std::size_t row = 0; row < errors.rows(level); ++row) {
            for (std::size_t column = 0; column < errors.columns(level); ++column) {
                const std::size_t at = row * errors.columns(level) + column;
                const auto error = static_cast<double>(errors.nodeError({level, column, row}));
                // Rounded up to 8 bits.
                EXPECT_GE(error, expected[at] * (1.0 - 1e-4) - tolerance)
                    << "level " << level << ": " << column << ", " << row;
                EXPECT_LE(error, (expected[at] * (1.0 + 1e-4) + tolerance) *
                                     (1.0 + static_cast<double>(kShortRounding)))
                    << "level " << level << ": " << column << ", " << row;
                EXPECT_LE(largest[at],
                          static_cast<double>(DetailErrors::kPeak) * error + tolerance);
            }
        }
    }
    for (std::size_t row = 0; row < errors.rows(0); ++row) {
        for (std::size_t column = 0; column < errors.columns(0); ++column) {
            EXPECT_EQ(errors.nodeError({0, column, row}), 0.0F);
        }
    }
}

// A corner's error is at least that of the nodes that meet there, and at least kGrowth times that
// of all finer corners of these nodes.
void expectGrowingCorners(const DetailErrors& errors)
{
    for (std::size_t level = 1; level < errors.levelCount(); ++level) {
        for (std::size_t row = 0; row < errors.rows(level); ++row) {
            for (std::size_t column = 0; column < errors.columns(level); ++column) {
                for (const auto& [c, r] : {std::pair{column, row},
                                           {column + 1, row},
                                           {column, row + 1},
                                           {column + 1, row + 1}}) {
                    const float corner = errors.cornerError(level, c, r);
                    EXPECT_GE(corner, errors.nodeError({level, column, row}));
                    for (std::size_t y = 2 * row; level > 1 && y <= 2 * row + 2; ++y) {
                        for (std::size_t x = 2 * column; x <= 2 * column + 2; ++x) {
                            if (x <= errors.columns(level - 1) && y <= errors.rows(level - 1)) {
                                EXPECT_GE(corner, DetailErrors::kGrowth *
                                                      errors.cornerError(level - 1, x, y));
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(DetailErrors, MatchTheDistancesOfAllSamplesFromEveryLevel)
{
    test::Random random;
    constexpr std::array<std::array<std::size_t, 2>, 9> kSizes{{{2, 2},
                                                                {3, 3},
                                                                {33, 33},
                                                                {34, 33},
                                                                {65, 34},
                                                                {3, 1000},
                                                                {1000, 3},
                                                                {300, 171},
                                                                {129, 257}}};
    for (const auto& [columns, rows] : kSizes) {
        const auto heights =
            test::heightsFrom(test::fractalHeights(random, columns, rows, 4000.0, 0.55), columns);
        expectMeasured(test::floatTerrain(columns, rows, heights));
        expectMeasured(
            test::int16Terrain(columns, rows, {.gain = -0.25, .offset_m = 200.0}, heights));
    }
}

TEST(DetailErrors, ExcludeVoids)
{
    test::Random random;
    constexpr std::size_t kColumns = 200;
    constexpr std::size_t kRows = 150;
    for (const double share : {0.02, 0.4, 0.98}) {
        const auto heights = test::fractalHeights(random, kColumns, kRows, 900.0, 0.6);
        expectMeasured(test::floatTerrain(kColumns, kRows, [&](std::size_t c, std::size_t r) {
            const bool is_hole = c > 90 && c < 140 && r > 30 && r < 100;
            return is_hole || random.chance(share) ? kNan : heights[r * kColumns + c];
        }));
    }
}

TEST(DetailErrors, AreZeroOnFlatTerrainAndPlanes)
{
    const Analysis even(test::int16Terrain(130, 97, {}, [](auto...) { return -1234.0; }));
    const Analysis plane(test::floatTerrain(130, 97, [](std::size_t c, std::size_t r) {
        return 2.0 * static_cast<double>(c) - static_cast<double>(r);
    }));
    for (std::size_t level = 0; level < even.errors.levelCount(); ++level) {
        for (std::size_t row = 0; row < even.errors.rows(level); ++row) {
            for (std::size_t column = 0; column < even.errors.columns(level); ++column) {
                EXPECT_EQ(even.errors.nodeError({level, column, row}), 0.0F);
                EXPECT_NEAR(plane.errors.nodeError({level, column, row}), 0.0F, 1e-6F * 360.0F);
            }
        }
    }
}

// A single outlier is far from its surroundings but rare: it counts with a quarter of its height.
TEST(DetailErrors, CountAPeakByAQuarter)
{
    const Analysis analysis(test::floatTerrain(
        257, 257, [](std::size_t c, std::size_t r) { return c == 129 && r == 77 ? 100.0 : 0.0; }));
    EXPECT_NEAR(analysis.errors.nodeError({1, 2, 1}), 25.0F, 1e-3F);
    EXPECT_EQ(analysis.errors.nodeError({1, 0, 1}), 0.0F);
}

TEST(DetailErrors, GrowAtTheCornersFromLevelToLevel)
{
    test::Random random;
    for (const std::size_t columns : {34U, 65U, 700U, 1025U}) {
        const std::size_t rows = 1100 - columns;
        const auto heights = test::fractalHeights(random, columns, rows, 4000.0, 0.5);
        // A rough corner in a plain is where large corner errors have to spread.
        const Analysis analysis(
            test::floatTerrain(columns, rows, [&](std::size_t c, std::size_t r) {
                return c < columns / 4 && r < rows / 4 ? heights[r * columns + c] : 0.0;
            }));
        expectGrowingCorners(analysis.errors);
    }
}

TEST(DetailErrors, StopWhenCanceled)
{
    const Heightfield field = test::floatTerrain(9, 9, [](auto...) { return 1.0; });
    JobMonitor monitor;
    const BlockMeans means = BlockMeans::build(field, monitor).value();
    monitor.cancel();
    EXPECT_EQ(DetailErrors::build({field, means}, monitor).error().code, ErrorCode::Canceled);
}

} // namespace
} // namespace marsview
