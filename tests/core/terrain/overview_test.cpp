#include "core/terrain/overview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

namespace marsview {
namespace {

Heightfield heightfieldOf(std::size_t columns,
                          std::size_t rows,
                          const std::function<double(std::size_t, std::size_t)>& height)
{
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const auto value = static_cast<float>(height(column, row));
            std::memcpy(grid.rowData(row) + column * sizeof(float), &value, sizeof(float));
        }
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    return {std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}};
}

TEST(MakeOverview, KeepsSamplesAndTheLastColumnAndRow)
{
    const Heightfield field = heightfieldOf(
        1000, 503, [](std::size_t c, std::size_t r) { return static_cast<double>(c + 2 * r); });
    JobMonitor monitor;
    const OverviewGrid grid = makeOverview(field, {.triangle_count_max = 5000}, monitor).value();
    EXPECT_LE(2 * (grid.columns - 1) * (grid.rows - 1), 5000U);
    EXPECT_GT(2 * (grid.columns - 1) * (grid.rows - 1), 3500U);
    const auto height = [&](std::size_t i, std::size_t j) {
        return static_cast<double>(grid.height(i, j)) + grid.base_height_m;
    };
    EXPECT_EQ(height(1, 1), field.sample(grid.step, grid.step));
    EXPECT_EQ(height(grid.columns - 1, grid.rows - 1), field.sample(999, 502));
}

TEST(MakeOverview, IsTheMapItselfWhereThatIsSmall)
{
    const Heightfield field = heightfieldOf(
        7, 5, [](std::size_t c, std::size_t r) { return static_cast<double>(c * r); });
    JobMonitor monitor;
    const OverviewGrid grid = makeOverview(field, {}, monitor).value();
    EXPECT_EQ(grid.step, 1U);
    EXPECT_EQ(grid.columns, 7U);
    EXPECT_EQ(grid.rows, 5U);
}

TEST(MakeOverview, BridgesSmallHolesOnly)
{
    const Heightfield field = heightfieldOf(400, 400, [](std::size_t c, std::size_t r) {
        const bool is_small_hole = c == 40 && r == 40;
        const bool is_large_hole = c >= 200 && r >= 200;
        return is_small_hole || is_large_hole ? std::nan("") : 7.0;
    });
    JobMonitor monitor;
    const OverviewGrid grid = makeOverview(field, {.triangle_count_max = 3500}, monitor).value();
    ASSERT_EQ(grid.step, 10U);
    EXPECT_FALSE(std::isnan(grid.height(4, 4)));
    EXPECT_TRUE(std::isnan(grid.height(30, 30)));
}

// A plane that rises to the east, whatever way the raster lies.
TEST(MakeReliefMap, TellsNormalsInTheScene)
{
    const SceneFrame rotated{.origin = {},
                             .east_per_column = 0.0,
                             .east_per_row = 10.0,
                             .north_per_column = 10.0,
                             .north_per_row = 0.0};
    const Heightfield field = heightfieldOf(
        20, 30, [](std::size_t, std::size_t r) { return static_cast<double>(r) * 10.0; });
    JobMonitor monitor;
    const ReliefMap map = makeReliefMap(field, rotated, {}, monitor).value();
    ASSERT_EQ(map.columns, 20U);
    ASSERT_EQ(map.rows, 30U);
    EXPECT_FALSE(map.has_voids);
    const std::uint16_t* texel = map.texels.data() + 4 * (10 * map.columns + 10);
    EXPECT_NEAR(texel[0] / 65535.0 * 2.0 - 1.0, -std::sqrt(0.5), 1e-4) << "east";
    EXPECT_NEAR(texel[1] / 65535.0 * 2.0 - 1.0, 0.0, 1e-4) << "north";
    EXPECT_NEAR(texel[2] / 65535.0, 10.0 / 29.0, 1e-4);
    EXPECT_EQ(texel[3], 65535);
}

TEST(MakeReliefMap, KeepsNormalsOfVerySteepMapsApart)
{
    const Heightfield field = heightfieldOf(20, 30, [](std::size_t c, std::size_t r) {
        return static_cast<double>(c) * (r < 15 ? 1e5 : 2e5);
    });
    JobMonitor monitor;
    const ReliefMap map =
        makeReliefMap(field, SceneFrame{}, {.exaggeration = 1e-5}, monitor).value();
    const auto east = [&](std::size_t row) {
        return map.texels[4 * (row * map.columns + 10)] / 65535.0 * 2.0 - 1.0;
    };
    EXPECT_NEAR(east(5), -std::sqrt(0.5), 1e-4);
    EXPECT_NEAR(east(25), -2.0 / std::sqrt(5.0), 1e-4);
}

TEST(MakeReliefMap, AveragesAndKeepsShareOfVoids)
{
    const Heightfield field = heightfieldOf(8, 8, [](std::size_t c, std::size_t r) {
        return c == 0 && r == 0 ? std::nan("") : std::floor(static_cast<double>(c) / 2.0);
    });
    JobMonitor monitor;
    const ReliefMap map = makeReliefMap(field, SceneFrame{}, {.side_max = 4}, monitor).value();
    ASSERT_EQ(map.step, 2U);
    EXPECT_TRUE(map.has_voids);
    EXPECT_NEAR(map.texels[3] / 65535.0, 0.75, 1e-4);
    EXPECT_NEAR(map.texels[4 * 3 + 2] / 65535.0, 1.0, 1e-4);
}

} // namespace
} // namespace marsview
