#include "core/terrain/seam.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

constexpr std::size_t kColumns = 360;
constexpr std::size_t kRows = 181;

TEST(Seam, LiesBetweenTheLastColumnAndTheFirst)
{
    const auto cell = seamCell({359.25, 10.5}, kColumns, kRows);
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->row, 10U);
    EXPECT_EQ(cell->u, 0.25);
    EXPECT_EQ(cell->v, 0.5);
}

TEST(Seam, PositionsLeftOfTheFirstColumnAreTheSame)
{
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const double column = random.uniform(359.0, 360.0);
        const double row = random.uniform(0.0, 180.0);
        const auto right = seamCell({column, row}, kColumns, kRows);
        const auto left = seamCell({column - 360.0, row}, kColumns, kRows);
        ASSERT_EQ(right.has_value(), left.has_value()) << column;
        if (right) {
            EXPECT_EQ(right->row, left->row);
            EXPECT_NEAR(right->u, left->u, 1e-12);
            EXPECT_EQ(right->v, left->v);
        }
    }
}

TEST(Seam, TheLastRowBelongsToTheLastCell)
{
    const auto cell = seamCell({359.5, 180.0}, kColumns, kRows);
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->row, 179U);
    EXPECT_EQ(cell->v, 1.0);
}

TEST(Seam, ExcludesTheGridAndTheOutside)
{
    for (const GridPoint p :
         {GridPoint{0.0, 10.0}, GridPoint{359.0, 10.0}, GridPoint{100.0, 10.0},
          GridPoint{360.0, 10.0}, GridPoint{-1.25, 10.0}, GridPoint{-1.5, 10.0},
          GridPoint{359.5, -0.01}, GridPoint{359.5, 180.01}, GridPoint{std::nan(""), 10.0},
          GridPoint{359.5, std::nan("")}, GridPoint{INFINITY, 10.0}, GridPoint{-INFINITY, 10.0}}) {
        EXPECT_FALSE(seamCell(p, kColumns, kRows)) << p.column << " " << p.row;
    }
}

TEST(Seam, BeginsAtTheLastColumn)
{
    const auto cell = seamCell({-1.0, 10.0}, kColumns, kRows);
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->u, 0.0);
}

// A position a rounding error to the left of the first sample is still on the map.
TEST(Seam, EndsAtTheFirstColumn)
{
    const auto cell = seamCell({-1e-18, 10.0}, kColumns, kRows);
    ASSERT_TRUE(cell);
    EXPECT_EQ(cell->u, 1.0);
}

} // namespace
} // namespace marsview
