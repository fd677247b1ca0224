#include "core/terrain/filled_heightfield.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
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

TEST(FilledHeightfield, KnowsTheRawValueThatAllVoidsHaveInCommon)
{
    const auto bits_of = [](const std::vector<std::int16_t>& raw, const VoidRule& rule) {
        SampleGrid grid = SampleGrid::create(SampleType::Int16, 3, 2).value();
        for (std::size_t row = 0; row < 2; ++row) {
            std::memcpy(grid.rowData(row), raw.data() + row * 3, 3 * sizeof(std::int16_t));
        }
        const SampleStatistics statistics = grid.applyRule(rule, 0, 2);
        if (!rule.nodata) {
            grid.markVoid(0, 0); // as by a mask
            grid.markVoid(2, 1);
        }
        const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid)),
                                      statistics, {});
        JobMonitor monitor;
        return FilledHeightfield::build(heightfield, *analyze(heightfield, monitor), monitor)
            .value()
            .voidBits();
    };
    EXPECT_EQ(bits_of({-2, 1, 2, 3, -2, 4}, {.nodata = -2.0}), 0xfffeU);
    EXPECT_EQ(bits_of({5, 1, 2, 3, 5, 5}, {}), 5U) << "a valid sample has it too";
    EXPECT_EQ(bits_of({5, 1, 2, 3, 5, 6}, {}), std::nullopt) << "two values";
    EXPECT_EQ(bits_of({5, 1, 2, 3, 5, 6}, {.nodata = 7.0}), std::nullopt) << "no voids";
    EXPECT_EQ(filled(3, {kNanFloat, 1, 2, 3, 4, kNanFloat}).voidBits(),
              std::bit_cast<std::uint32_t>(kNanFloat));
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
