#include "core/terrain/block_means.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

struct Size {
    std::size_t columns;
    std::size_t rows;
};

constexpr std::array<Size, 9> kSizes{
    {{2, 2}, {3, 2}, {8, 8}, {9, 9}, {17, 31}, {64, 64}, {65, 33}, {129, 1000}, {1000, 3}}};

BlockMeans meansOf(const Heightfield& heightfield)
{
    JobMonitor monitor;
    return BlockMeans::build(heightfield, monitor).value();
}

// The mean of a block's valid samples, and their share.
struct Truth {
    double mean = kNan;
    double share = 0.0;
};

Truth truthOf(const Heightfield& field, std::size_t level, std::size_t column, std::size_t row)
{
    const std::size_t side = BlockMeans::kBlock << level;
    double sum = 0.0;
    std::size_t there = 0;
    std::size_t all = 0;
    for (std::size_t r = row * side; r < std::min((row + 1) * side, field.rows()); ++r) {
        for (std::size_t c = column * side; c < std::min((column + 1) * side, field.columns());
             ++c) {
            const double height = field.sample(c, r);
            ++all;
            if (!std::isnan(height)) {
                ++there;
                sum += height;
            }
        }
    }
    return {.mean = sum / static_cast<double>(there), // NaN for 0 / 0
            .share = static_cast<double>(there) / static_cast<double>(all)};
}

void expectMeans(const Heightfield& field)
{
    SCOPED_TRACE(std::to_string(field.columns()) + " x " + std::to_string(field.rows()));
    const BlockMeans means = meansOf(field);
    const HeightRange range = field.range().value_or(HeightRange{});
    const double tolerance = 2e-6 * (range.maximum_m - range.minimum_m) +
                             2e-7 * std::max(std::abs(range.minimum_m), std::abs(range.maximum_m));
    for (std::size_t level = 0; level < means.levelCount(); ++level) {
        const GridView<const float> blocks = means.means(level);
        const std::size_t side = BlockMeans::kBlock << level;
        ASSERT_EQ(blocks.columns(), (field.columns() + side - 1) / side);
        ASSERT_EQ(blocks.rows(), (field.rows() + side - 1) / side);
        for (std::size_t row = 0; row < blocks.rows(); ++row) {
            for (std::size_t column = 0; column < blocks.columns(); ++column) {
                const Truth truth = truthOf(field, level, column, row);
                const auto mean = static_cast<double>(blocks(column, row));
                EXPECT_NEAR(static_cast<double>(means.share(level, column, row)), truth.share, 1e-6)
                    << level << ": " << column << ", " << row;
                if (truth.share == 0.0) {
                    EXPECT_TRUE(std::isnan(mean));
                } else {
                    EXPECT_NEAR(mean, truth.mean, tolerance)
                        << level << ": " << column << ", " << row;
                }
            }
        }
    }
    EXPECT_EQ(means.means(means.levelCount() - 1).columns(), 1U);
    EXPECT_EQ(means.means(means.levelCount() - 1).rows(), 1U);
}

// Filled heights are within the range of the means and rise no faster than neighboring means
// differ.
void expectSmoothFilling(const Heightfield& field)
{
    SCOPED_TRACE(std::to_string(field.columns()) + " x " + std::to_string(field.rows()));
    const BlockMeans means = meansOf(field);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    const GridView<const float> blocks = means.means(0);
    for (std::size_t row = 0; row < blocks.rows(); ++row) {
        for (const float mean : blocks.row(row)) {
            if (!std::isnan(mean)) {
                low = std::min(low, static_cast<double>(mean));
                high = std::max(high, static_cast<double>(mean));
            }
        }
    }
    const double slack = 1e-5 * (high - low) + 1e-5;
    const double step_max = (high - low) / static_cast<double>(BlockMeans::kBlock) + slack;
    for (std::size_t row = 0; row < field.rows(); ++row) {
        for (std::size_t column = 0; column < field.columns(); ++column) {
            const auto here = static_cast<double>(means.filled(column, row));
            ASSERT_GE(here, low - slack) << column << ", " << row;
            ASSERT_LE(here, high + slack) << column << ", " << row;
            if (column > 0) {
                const auto left = static_cast<double>(means.filled(column - 1, row));
                ASSERT_LE(std::abs(here - left), step_max) << column << ", " << row;
            }
            if (row > 0) {
                const auto above = static_cast<double>(means.filled(column, row - 1));
                ASSERT_LE(std::abs(here - above), step_max) << column << ", " << row;
            }
        }
    }
}

TEST(BlockMeans, MatchTheirSamplesAtEveryLevel)
{
    test::Random random;
    for (const Size& size : kSizes) {
        const auto heights = test::heightsFrom(
            test::fractalHeights(random, size.columns, size.rows, 3000.0, 0.6), size.columns);
        expectMeans(test::floatTerrain(size.columns, size.rows, heights));
        expectMeans(test::int16Terrain(size.columns, size.rows, {.gain = 0.5, .offset_m = -700.0},
                                       heights));
    }
}

TEST(BlockMeans, ExcludeVoids)
{
    test::Random random;
    for (const Size& size : kSizes) {
        for (const double void_share : {0.01, 0.5, 0.99}) {
            const auto heights = test::fractalHeights(random, size.columns, size.rows, 100.0, 0.7);
            const auto with_voids = [&](std::size_t column, std::size_t row) {
                return random.chance(void_share) ? kNan : heights[row * size.columns + column];
            };
            const Heightfield field = test::floatTerrain(size.columns, size.rows, with_voids);
            expectMeans(field);
            if (field.range()) {
                expectSmoothFilling(field);
            }
        }
    }
}

// Voids as in real maps: large areas without any block that has data.
TEST(BlockMeans, FillLargeHolesAndEmptyCornersSmoothly)
{
    test::Random random;
    constexpr std::size_t kColumns = 203;
    constexpr std::size_t kRows = 301;
    const auto heights = test::fractalHeights(random, kColumns, kRows, 500.0, 0.5);
    const auto is_void = [](std::size_t column, std::size_t row) {
        const bool is_corner = column < 60 && row < 90;
        const bool is_other_corner = column + row > 440;
        const bool is_hole = std::hypot(static_cast<double>(column) - 120.0,
                                        static_cast<double>(row) - 180.0) < 45.0;
        return is_corner || is_other_corner || is_hole;
    };
    const Heightfield field =
        test::floatTerrain(kColumns, kRows, [&](std::size_t c, std::size_t r) {
            return is_void(c, r) ? kNan : heights[r * kColumns + c];
        });
    expectMeans(field);
    expectSmoothFilling(field);
}

TEST(BlockMeans, FillFromASingleSample)
{
    constexpr std::size_t kColumns = 100;
    const Heightfield field = test::floatTerrain(kColumns, 70, [](std::size_t c, std::size_t r) {
        return c == 99 && r == 69 ? 42.5 : kNan;
    });
    const BlockMeans means = meansOf(field);
    for (std::size_t row = 0; row < field.rows(); ++row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            ASSERT_EQ(means.filled(column, row), 42.5F);
        }
    }
}

// Interpolating between the means of a plane gives the plane.
TEST(BlockMeans, FillAPlaneExactlyBetweenWholeBlocks)
{
    constexpr std::size_t kSide = 160;
    const auto plane = [](std::size_t column, std::size_t row) {
        return 3.0 * static_cast<double>(column) - 0.25 * static_cast<double>(row) + 17.0;
    };
    for (const bool has_voids : {false, true}) {
        const Heightfield field =
            test::floatTerrain(kSide, kSide, [&](std::size_t column, std::size_t row) {
                return has_voids && column < 24 && row < 24 ? kNan : plane(column, row);
            });
        const BlockMeans means = meansOf(field);
        for (std::size_t row = 40; row < kSide - 4; ++row) {
            for (std::size_t column = 40; column < kSide - 4; ++column) {
                ASSERT_NEAR(static_cast<double>(means.filled(column, row)), plane(column, row),
                            1e-4);
            }
        }
    }
}

TEST(BlockMeans, StopWhenCanceled)
{
    const Heightfield field = test::floatTerrain(9, 9, [](auto...) { return 1.0; });
    JobMonitor monitor;
    monitor.cancel();
    EXPECT_EQ(BlockMeans::build(field, monitor).error().code, ErrorCode::Canceled);
}

} // namespace
} // namespace marsview
