#include "haptics/interaction/stroke_area.h"

#include <gtest/gtest.h>

#include <limits>

namespace marsview {
namespace {

constexpr WorkspaceBox kStrokeReach{{-0.08, -0.05, -0.04}, {0.08, 0.07, 0.06}};
constexpr Viewport kStrokePicture{.width = 3000, .height = 3000};

// In columns and rows of the 32 × 24 cells that are probed.
struct Cells {
    double column;
    double row;
};
Cells cellsAt(const WorkspacePoint& at)
{
    return {(at.x + 0.08) / 0.16 * 32.0, (at.y + 0.05) / 0.12 * 24.0};
}

void expectCells(const std::optional<WorkspaceBox>& area, const Cells& low, const Cells& high)
{
    ASSERT_TRUE(area);
    EXPECT_NEAR(cellsAt(area->low).column, low.column, 1e-9);
    EXPECT_NEAR(cellsAt(area->low).row, low.row, 1e-9);
    EXPECT_NEAR(cellsAt(area->high).column, high.column, 1e-9);
    EXPECT_NEAR(cellsAt(area->high).row, high.row, 1e-9);
    EXPECT_EQ(area->low.z, kStrokeReach.low.z);
    EXPECT_EQ(area->high.z, kStrokeReach.high.z);
}

// Left, 12 × 24 cells of 60 × 15 pixels; right, 16 × 24 cells of 20 × 15 pixels, near the lower
// right corner of the picture. Between them there is no terrain.
std::optional<PixelPoint> twoParts(const Cells& at)
{
    if (at.column < 12.01) {
        return PixelPoint{200.0 + 60.0 * at.column, 200.0 + 15.0 * at.row};
    }
    if (at.column > 15.99) {
        return PixelPoint{2000.0 + 20.0 * at.column, 2000.0 + 15.0 * at.row};
    }
    return std::nullopt;
}

TEST(StrokeArea, IsTheRectangleThatTakesUpMostOfThePicture)
{
    const auto area = strokeArea(kStrokeReach, kStrokePicture, [](const WorkspacePoint& at) {
        EXPECT_EQ(at.z, 0.0); // level with the origin
        return twoParts(cellsAt(at));
    });
    expectCells(area, {0.0, 0.0}, {12.0, 24.0});
}

TEST(StrokeArea, IsProbedOnceMoreWhereItWasFound)
{
    // Of 12 columns, an eighth beyond the eighth is probed only then: the cells up to it are
    // larger.
    const auto area = strokeArea(kStrokeReach, kStrokePicture, [](const WorkspacePoint& at) {
        const Cells cells = cellsAt(at);
        return cells.column > 8.2 && cells.column < 8.3 ? std::nullopt : twoParts(cells);
    });
    expectCells(area, {0.0, 0.0}, {7.875, 24.0});
}

// The reach is 1.2 times as wide and high as the picture; 0.06 of the picture is left on each side.
TEST(StrokeArea, StaysWellInsideThePicture)
{
    const auto area = strokeArea(kStrokeReach, kStrokePicture, [](const WorkspacePoint& at) {
        const Cells cells = cellsAt(at);
        return std::optional(PixelPoint{3000.0 * (cells.column / 32.0 * 1.2 - 0.1),
                                        3000.0 * (cells.row / 24.0 * 1.2 - 0.1)});
    });
    // 0.16 / 1.2 of 32 and 24 cells, and 1.04 / 1.2 of them, to whole cells.
    expectCells(area, {5.0, 4.0}, {27.0, 20.0});
    const auto beside = [](const WorkspacePoint&) { return std::optional(PixelPoint{10.0, 10.0}); };
    EXPECT_FALSE(strokeArea(kStrokeReach, kStrokePicture, beside));
    // In a picture from so far away that all terrain is one point, there is nothing to see.
    const auto point = [](const WorkspacePoint&) { return std::optional(PixelPoint{1500.0, 9e2}); };
    EXPECT_FALSE(strokeArea(kStrokeReach, kStrokePicture, point));
}

// Four columns and rows are outside the picture, which shows more terrain beyond the reach.
TEST(StrokeArea, StaysWithinTheReach)
{
    const auto area = strokeArea(kStrokeReach, kStrokePicture, [](const WorkspacePoint& at) {
        const Cells cells = cellsAt(at);
        return std::optional(PixelPoint{70.0 * cells.column - 90.0, 90.0 * cells.row - 170.0});
    });
    expectCells(area, {4.0, 4.0}, {32.0, 24.0});
}

TEST(StrokeArea, TheHighestTerrainIsThatOfItsProbes)
{
    const auto slope = [](const WorkspacePoint& at) { return 0.5 * at.x - 0.25 * at.y; };
    EXPECT_NEAR(highestIn(kStrokeReach, slope), 0.5 * 0.08 + 0.25 * 0.05, 1e-12);
    const auto rise = [](const WorkspacePoint& at) { return 0.25 * at.y - 0.5 * at.x; };
    EXPECT_NEAR(highestIn(kStrokeReach, rise), 0.5 * 0.08 + 0.25 * 0.07, 1e-12);
    const auto ridge = [](const WorkspacePoint& at) {
        const Cells cells = cellsAt(at);
        return cells.column > 9.5 && cells.column < 10.5 && cells.row > 22.5
                   ? 0.05
                   : std::numeric_limits<double>::quiet_NaN();
    };
    EXPECT_EQ(highestIn(kStrokeReach, ridge), 0.05);
    const auto below = [](const WorkspacePoint&) { return -1.0; };
    EXPECT_EQ(highestIn(kStrokeReach, below), kStrokeReach.low.z);
}

} // namespace
} // namespace marsview
