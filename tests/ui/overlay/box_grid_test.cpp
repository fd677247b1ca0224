#include "tests/support/random.h"
#include "ui/overlay/box_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace marsview {

TEST(BoxGrid, FindsTheSameOverlapsAsALookAtAllBoxes)
{
    test::Random random(8);
    const QRectF area(10.0, 20.0, 700.0, 500.0);
    const auto some_box = [&random](double side_max) {
        return QRectF(random.uniform(-200.0, 900.0), random.uniform(-200.0, 700.0),
                      random.uniform(1.0, side_max), random.uniform(1.0, side_max));
    };
    BoxGrid grid(area);
    std::vector<QRectF> boxes;
    int clear = 0;
    constexpr int kRounds = 600;
    for (int i = 0; i < kRounds; ++i) {
        const QRectF asked = some_box(150.0);
        const bool is_clear = std::none_of(
            boxes.begin(), boxes.end(), [&](const QRectF& box) { return box.intersects(asked); });
        EXPECT_EQ(grid.isClear(asked), is_clear) << i;
        clear += is_clear ? 1 : 0;
        boxes.push_back(some_box(60.0));
        grid.add(boxes.back());
    }
    EXPECT_GT(clear, kRounds / 20);
    EXPECT_LT(clear, kRounds / 2);
}

} // namespace marsview
