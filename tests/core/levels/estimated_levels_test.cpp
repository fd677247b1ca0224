#include "core/levels/estimated_levels.h"
#include "core/terrain/surface_analysis.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"
#include "tests/support/random.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::GridTileSource;

constexpr std::size_t kColumns = 2500;
constexpr std::size_t kRows = 1700;
constexpr ElevationScale kScale{.gain = 0.5, .offset_m = 100.0};
constexpr std::size_t kMeansMax = 40'000; // here: level 4

MapLevels estimated(const TileSource& source, std::size_t means_max = kMeansMax)
{
    JobMonitor monitor;
    auto levels = estimateLevels(source, kScale, monitor, means_max);
    EXPECT_TRUE(levels) << levels.error().message;
    return std::move(levels).value();
}

class EstimatedLevelsTest : public testing::Test {
protected:
    // Rough terrain, a plain in a corner, and a hole.
    static void SetUpTestSuite()
    {
        test::Random random;
        const std::vector<double> heights =
            test::fractalHeights(random, kColumns, kRows, 4000.0, 0.55);
        const auto height = [&heights](std::size_t column, std::size_t row) {
            return column > 2000 && row > 1300 ? 20.0 : heights[row * kColumns + column];
        };
        whole_ = new Map(height);
        holed_ = new Map([&](std::size_t column, std::size_t row) {
            return column >= 640 && column < 1280 && row >= 320 && row < 960 ? kNan
                                                                             : height(column, row);
        });
    }
    static void TearDownTestSuite()
    {
        delete std::exchange(whole_, nullptr);
        delete std::exchange(holed_, nullptr);
    }

    struct Map {
        explicit Map(const test::HeightFunction& height)
            : heightfield(test::int16Terrain(kColumns, kRows, kScale, height))
            , truth(test::analyzed(heightfield))
            , source(heightfield, GridTileSource::Options{.mean_levels = 5})
            , estimate(estimated(source))
            , read_count(source.readCount())
        {}

        Heightfield heightfield;
        std::shared_ptr<const SurfaceAnalysis> truth;
        GridTileSource source;
        MapLevels estimate;
        std::uint64_t read_count; // tiles, for the estimate
    };

    static Map* whole_;
    static Map* holed_;
};

EstimatedLevelsTest::Map* EstimatedLevelsTest::whole_ = nullptr;
EstimatedLevelsTest::Map* EstimatedLevelsTest::holed_ = nullptr;

TEST_F(EstimatedLevelsTest, ReadsOneLevelOfMeansAndFiveTiles)
{
    const TileLayout& layout = whole_->source.layout();
    EXPECT_EQ(whole_->read_count,
              layout.tileColumns(TileKind::Means, 4) * layout.tileRows(TileKind::Means, 4) + 5);
}

TEST_F(EstimatedLevelsTest, MeansMatchTheMap)
{
    for (const Map* map : {whole_, holed_}) {
        const BlockMeans& means = map->estimate.analysis->means;
        const BlockMeans& truth = map->truth->means;
        ASSERT_EQ(means.blockSamples(), 16U);
        for (std::size_t level = 0; level < means.levelCount(); ++level) {
            const GridView<const float> some = means.means(level);
            const GridView<const float> all = truth.means(level + 1); // from 8 samples
            ASSERT_EQ(some.columns(), all.columns());
            ASSERT_EQ(some.rows(), all.rows());
            for (std::size_t row = 0; row < some.rows(); ++row) {
                for (std::size_t column = 0; column < some.columns(); ++column) {
                    ASSERT_EQ(std::isnan(some(column, row)), std::isnan(all(column, row)));
                    if (!std::isnan(all(column, row))) {
                        // The overview's means are rounded to whole raw values.
                        ASSERT_NEAR(some(column, row), all(column, row), kScale.gain);
                    }
                }
            }
        }
    }
}

TEST_F(EstimatedLevelsTest, HardlyAnySampleLiesOutsideItsBounds)
{
    for (const Map* map : {whole_, holed_}) {
        const MinMaxPyramid& bounds = map->estimate.analysis->bounds;
        const MinMaxPyramid& truth = map->truth->bounds;
        ASSERT_EQ(bounds.levelCount(), truth.levelCount());
        std::size_t outside = 0;
        double widths = 0.0;
        double true_widths = 0.0;
        for (std::size_t row = 0; row < kRows; ++row) {
            for (std::size_t column = 0; column < kColumns; ++column) {
                const double height_m = map->heightfield.sample(column, row);
                const auto& node = bounds.bounds(0, column / 32, row / 32);
                const bool is_outside = height_m < static_cast<double>(node.minimum_m) ||
                                        height_m > static_cast<double>(node.maximum_m);
                outside += is_outside ? 1U : 0U;
                ASSERT_FALSE(!std::isnan(height_m) && node.isEmpty());
            }
        }
        for (std::size_t row = 0; row < truth.rows(0); ++row) {
            for (std::size_t column = 0; column < truth.columns(0); ++column) {
                const auto& node = truth.bounds(0, column, row);
                if (!node.isEmpty()) {
                    true_widths += static_cast<double>(node.maximum_m - node.minimum_m);
                    const auto& wide = bounds.bounds(0, column, row);
                    widths += static_cast<double>(wide.maximum_m - wide.minimum_m);
                }
            }
        }
        std::cout << outside << " of " << kColumns * kRows << " samples outside; "
                  << widths / true_widths << " times as wide as necessary\n";
        EXPECT_LE(outside, kColumns * kRows / 1000);
        EXPECT_LT(widths, 6.0 * true_widths);
    }
}

TEST_F(EstimatedLevelsTest, BoundsOfCoarserNodesEncloseThoseOfFinerOnes)
{
    const MinMaxPyramid& bounds = whole_->estimate.analysis->bounds;
    for (std::size_t level = 1; level < bounds.levelCount(); ++level) {
        for (std::size_t row = 0; row < bounds.rows(level - 1); ++row) {
            for (std::size_t column = 0; column < bounds.columns(level - 1); ++column) {
                const auto& finer = bounds.bounds(level - 1, column, row);
                const auto& coarser = bounds.bounds(level, column / 2, row / 2);
                ASSERT_LE(coarser.minimum_m, finer.minimum_m);
                ASSERT_GE(coarser.maximum_m, finer.maximum_m);
            }
        }
    }
}

TEST_F(EstimatedLevelsTest, ErrorsAreApproximatelyRight)
{
    const DetailErrors& errors = whole_->estimate.analysis->errors;
    const DetailErrors& truth = whole_->truth->errors;
    ASSERT_EQ(errors.levelCount(), truth.levelCount());
    for (std::size_t level = 1; level < truth.levelCount(); ++level) {
        ASSERT_EQ(errors.columns(level), truth.columns(level));
        std::vector<double> ratios;
        for (std::size_t row = 0; row < truth.rows(level); ++row) {
            for (std::size_t column = 0; column < truth.columns(level); ++column) {
                const DetailNode node{level, column, row};
                if (truth.nodeError(node) > 1.0F) {
                    ratios.push_back(static_cast<double>(errors.nodeError(node)) /
                                     static_cast<double>(truth.nodeError(node)));
                }
            }
        }
        ASSERT_FALSE(ratios.empty());
        std::sort(ratios.begin(), ratios.end());
        const double tenth = ratios[ratios.size() / 10];
        const double middle = ratios[ratios.size() / 2];
        const double last_tenth = ratios[ratios.size() * 9 / 10];
        std::cout << "level " << level << ": estimated over measured " << tenth << ", " << middle
                  << ", " << last_tenth << " (10 %, 50 %, 90 %)\n";
        EXPECT_GT(middle, 0.5);
        EXPECT_LT(middle, 2.0);
        EXPECT_GT(tenth, 0.25);
        EXPECT_LT(last_tenth, 4.0);
    }
}

TEST_F(EstimatedLevelsTest, ErrorsGrowAsDrawingRequires)
{
    const DetailErrors& errors = holed_->estimate.analysis->errors;
    for (std::size_t level = 1; level < errors.levelCount(); ++level) {
        for (std::size_t row = 0; row < errors.rows(level); ++row) {
            for (std::size_t column = 0; column < errors.columns(level); ++column) {
                const float error = errors.nodeError({level, column, row});
                ASSERT_TRUE(std::isfinite(error));
                for (const auto& [c, r] : {std::pair{column, row}, {column + 1, row + 1}}) {
                    ASSERT_GE(errors.cornerError(level, c, r), error);
                }
                if (level > 1) {
                    ASSERT_GE(errors.cornerError(level, column, row),
                              DetailErrors::kGrowth *
                                  errors.cornerError(level - 1, 2 * column, 2 * row));
                }
            }
        }
    }
}

TEST_F(EstimatedLevelsTest, StatisticsIncludeRangeAndVoids)
{
    const SampleStatistics& whole = whole_->estimate.statistics;
    const HeightRange range = *whole_->heightfield.range();
    EXPECT_EQ(whole.sample_count, kColumns * kRows);
    EXPECT_EQ(whole.void_count, 0U);
    EXPECT_LE(kScale.height(whole.raw_minimum), range.minimum_m + 100.0);
    EXPECT_GE(kScale.height(whole.raw_maximum), range.maximum_m - 100.0);
    EXPECT_FALSE(whole_->estimate.layout.has_voids);
    const double holes = static_cast<double>(holed_->estimate.statistics.void_count);
    EXPECT_NEAR(holes, 640.0 * 640.0, 0.05 * 640.0 * 640.0);
    EXPECT_TRUE(holed_->estimate.layout.has_voids);
}

// Some samples exceed the estimated bounds. The proxy must not fall through them.
TEST_F(EstimatedLevelsTest, NoSampleExceedsTheBoundsUsedForTouching)
{
    const std::vector<std::vector<float>>& maxima = whole_->estimate.filled_maxima_m;
    const MinMaxPyramid& truth = whole_->truth->bounds;
    ASSERT_EQ(maxima.size(), truth.levelCount());
    for (std::size_t level = 0; level < truth.levelCount(); ++level) {
        for (std::size_t row = 0; row < truth.rows(level); ++row) {
            for (std::size_t column = 0; column < truth.columns(level); ++column) {
                ASSERT_GE(maxima[level][row * truth.columns(level) + column],
                          truth.bounds(level, column, row).maximum_m);
            }
        }
    }
}

TEST_F(EstimatedLevelsTest, NoFillExceedsTheMaximumOfItsNodes)
{
    const MapLevels& levels = holed_->estimate;
    const MinMaxPyramid& bounds = levels.analysis->bounds;
    ASSERT_EQ(levels.filled_maxima_m.size(), bounds.levelCount());
    for (std::size_t row = 0; row < kRows; row += 7) {
        for (std::size_t column = 0; column < kColumns; column += 7) {
            const float fill = levels.analysis->means.filled(column, row);
            for (std::size_t level = 0; level < bounds.levelCount(); ++level) {
                const std::size_t node =
                    (std::min(row, kRows - 2) >> (level + 5)) * bounds.columns(level) +
                    (std::min(column, kColumns - 2) >> (level + 5));
                ASSERT_LE(fill, levels.filled_maxima_m[level][node] + 1e-3F);
            }
        }
    }
}

TEST_F(EstimatedLevelsTest, ASmallMapIsMeasuredExactly)
{
    test::Random random;
    const Heightfield heightfield = test::int16Terrain(
        300, 200, kScale,
        test::heightsFrom(test::fractalHeights(random, 300, 200, 500.0, 0.5), 300));
    const MapLevels levels = estimated(GridTileSource(heightfield), 300 * 200);
    const auto truth = test::analyzed(heightfield);
    EXPECT_EQ(levels.statistics.raw_minimum, (heightfield.range()->minimum_m - 100.0) / 0.5);
    for (std::size_t level = 1; level < truth->errors.levelCount(); ++level) {
        EXPECT_EQ(levels.analysis->errors.nodeError({level, 0, 0}),
                  truth->errors.nodeError({level, 0, 0}));
    }
    EXPECT_EQ(levels.analysis->bounds.bounds(0, 3, 3).minimum_m,
              truth->bounds.bounds(0, 3, 3).minimum_m);
}

TEST_F(EstimatedLevelsTest, RefusesMapsWithoutASmallOverview)
{
    JobMonitor monitor;
    const auto levels = estimateLevels(whole_->source, kScale, monitor, 1000);
    ASSERT_FALSE(levels);
    EXPECT_EQ(levels.error().code, ErrorCode::TooLarge);
    EXPECT_EQ(levels.error().message, "map in memory: has no overviews that are small enough");
}

TEST_F(EstimatedLevelsTest, ReadErrorsAndCancelingEndIt)
{
    JobMonitor monitor;
    const GridTileSource broken(
        whole_->heightfield,
        GridTileSource::Options{
            .mean_levels = 5, .before_read = [](const TileId& id) -> std::optional<Error> {
                return id.column == 0
                           ? std::nullopt
                           : std::optional<Error>(Error{ErrorCode::Unreadable, "x: broke"});
            }});
    const auto failed = estimateLevels(broken, kScale, monitor, 200'000);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "x: broke");
    monitor.cancel();
    const auto canceled = estimateLevels(whole_->source, kScale, monitor, kMeansMax);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

TEST_F(EstimatedLevelsTest, AMapOfVoidsHasNoHeights)
{
    const Heightfield nothing =
        test::int16Terrain(600, 400, kScale, [](std::size_t, std::size_t) { return kNan; });
    const MapLevels levels =
        estimated(GridTileSource(nothing, GridTileSource::Options{.mean_levels = 2}));
    EXPECT_FALSE(levels.statistics.hasSamples());
    EXPECT_TRUE(levels.analysis->bounds.bounds(0, 1, 1).isEmpty());
    EXPECT_EQ(levels.analysis->errors.nodeError({1, 0, 0}), 0.0F);
}

} // namespace
} // namespace marsview
