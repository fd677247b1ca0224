#include "core/contact/border_walls.h"
#include "tests/core/contact/contact_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

// Of a sheared map of 41 × 21 samples, with cells of any size, mirrored or not: the nearest wall is
// as far as the parallelogram's nearest side, negative outside.
TEST(BorderWalls, StandOnTheOutermostSamples)
{
    const auto terrain = test::filledTerrain(41, std::vector<float>(41 * 21, 0.0F));
    test::Random random;
    for (int i = 0; i < 40; ++i) {
        const auto [frame, cell_m] = test::shearedFrame(*terrain, random, i % 2 == 0);
        const BorderWalls walls = borderWalls(HeightfieldSurface(terrain, frame, 1.0));
        ASSERT_EQ(walls.count, 4U);
        for (const BorderWall& wall : walls) {
            EXPECT_NEAR(length(wall.normal), 1.0, 1e-12);
            EXPECT_EQ(wall.normal.z, 0.0);
        }
        // The distance between lines one column or one row apart: the cell's area by their length.
        const double area = std::abs(frame.east_per_column * frame.north_per_row -
                                     frame.north_per_column * frame.east_per_row);
        const double columns_m = area / std::hypot(frame.east_per_row, frame.north_per_row);
        const double rows_m = area / std::hypot(frame.east_per_column, frame.north_per_column);
        for (int k = 0; k < 50; ++k) {
            const GridPoint grid{random.uniform(-9.0, 50.0), random.uniform(-9.0, 30.0)};
            const ScenePoint at = frame.toScene(grid, random.uniform(-1.0, 1.0) * cell_m);
            double nearest = walls.walls[0].distance(at);
            for (const BorderWall& wall : walls) {
                nearest = std::min(nearest, wall.distance(at));
            }
            EXPECT_NEAR(nearest,
                        std::min({grid.column * columns_m, (40.0 - grid.column) * columns_m,
                                  grid.row * rows_m, (20.0 - grid.row) * rows_m}),
                        1e-9 * cell_m);
        }
    }
}

} // namespace
} // namespace marsview
