#include "core/base/grid_view.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace marsview {
namespace {

TEST(GridView, ElementsAreCountedFromTheFirstRowWithTheStride)
{
    std::vector<int> data(5 * 7);
    std::iota(data.begin(), data.end(), 0);
    const GridView<int> view(data.data() + 1, 3, 7, 5);
    for (std::size_t r = 0; r < 7; ++r) {
        ASSERT_EQ(view.row(r).size(), 3U);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(view(c, r), static_cast<int>(r * 5 + c + 1));
            EXPECT_EQ(&view.row(r)[c], &view(c, r));
        }
    }
}

TEST(GridView, AViewOfMutableElementsIsAViewOfConstantOnes)
{
    int value = 4;
    const GridView<int> mutable_view(&value, 1, 1);
    const GridView<const int> constant_view = mutable_view;
    mutable_view(0, 0) = 5;
    EXPECT_EQ(constant_view(0, 0), 5);
}

TEST(GridViewDeathTest, AStrideBelowTheColumnsIsABug)
{
    int value = 0;
    EXPECT_DEATH(GridView<int>(&value, 2, 1, 1), "check failed: row_stride >= columns");
}

} // namespace
} // namespace marsview
