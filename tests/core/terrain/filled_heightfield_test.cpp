#include "core/terrain/filled_heightfield.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace marsview {
namespace {

FilledHeightfield filled(std::size_t columns, const std::vector<float>& heights)
{
    const std::size_t rows = heights.size() / columns;
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(grid.rowData(row), heights.data() + row * columns, columns * sizeof(float));
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics,
                                  {});
    JobMonitor monitor;
    return FilledHeightfield::build(heightfield, *analyze(heightfield, monitor), monitor).value();
}

bool isInDisc(std::size_t column, std::size_t row)
{
    const double c = static_cast<double>(column) - 60.0;
    const double r = static_cast<double>(row) - 50.0;
    return c * c + r * r < 900.0;
}

std::vector<float> holed(test::Random& random, std::size_t columns, std::size_t rows)
{
    std::vector<float> heights;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const bool is_void = isInDisc(column, row) || random.chance(0.05);
            heights.push_back(is_void
                                  ? kNanFloat
                                  : static_cast<float>(column) + static_cast<float>(random.unit()));
        }
    }
    return heights;
}

TEST(FilledHeightfield, KeepsValidSamplesAndFillsTheRestWithinTheRange)
{
    test::Random random;
    const std::vector<float> heights = holed(random, 130, 100);
    const FilledHeightfield terrain = filled(130, heights);
    const auto range = *terrain.heightfield().range();
    for (std::size_t row = 0; row < 100; ++row) {
        for (std::size_t column = 0; column < 130; ++column) {
            const double height = terrain.sample(column, row);
            const float measured = heights[row * 130 + column];
            EXPECT_EQ(terrain.isVoid(column, row), std::isnan(measured));
            if (!std::isnan(measured)) {
                EXPECT_EQ(height, static_cast<double>(measured));
            }
            EXPECT_GE(height, range.minimum_m);
            EXPECT_LE(height, range.maximum_m);
        }
    }
}

TEST(FilledHeightfield, FillsSmoothly)
{
    test::Random random;
    const FilledHeightfield terrain = filled(130, holed(random, 130, 100));
    for (std::size_t row = 30; row < 70; ++row) {
        for (std::size_t column = 40; column < 80; ++column) {
            if (isInDisc(column, row) && isInDisc(column + 1, row)) {
                // The slope measured around the hole is 1; across it the average is the same.
                EXPECT_NEAR(terrain.sample(column + 1, row) - terrain.sample(column, row), 1.0,
                            1.5);
            }
        }
    }
    EXPECT_NEAR(terrain.sample(60, 50), 60.5, 6.0) << "the middle of the hole";
}

TEST(FilledHeightfield, MaximaBoundEverySampleOfEveryNode)
{
    test::Random random;
    const FilledHeightfield terrain = filled(130, holed(random, 130, 100));
    for (std::size_t level = 0; level < terrain.levelCount(); ++level) {
        const std::size_t side = MinMaxPyramid::kBlock << level;
        for (std::size_t row = 0; row < 99; ++row) {
            for (std::size_t column = 0; column < 129; ++column) {
                const double bound = terrain.maximum(level, column / side, row / side);
                const CellHeights z = terrain.cell(column, row);
                EXPECT_LE(std::max({z.upper_left, z.upper_right, z.lower_left, z.lower_right}),
                          bound);
            }
        }
    }
}

TEST(FilledHeightfield, FillsAMapWithOneSample)
{
    std::vector<float> heights(std::size_t{50} * 40, kNanFloat);
    heights[123] = -7.5F;
    const FilledHeightfield terrain = filled(50, heights);
    EXPECT_EQ(terrain.sample(0, 0), -7.5);
    EXPECT_EQ(terrain.sample(49, 39), -7.5);
}

TEST(FilledHeightfield, StopsWhenCanceled)
{
    test::Random random;
    const FilledHeightfield terrain = filled(130, holed(random, 130, 100));
    JobMonitor monitor;
    const auto analysis = *analyze(terrain.heightfield(), monitor);
    monitor.cancel();
    const auto canceled = FilledHeightfield::build(terrain.heightfield(), analysis, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

} // namespace
} // namespace marsview
