#include "core/contact/goal_frame.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

std::shared_ptr<const Georeference> georeference()
{
    // 90 m pixels, the outer corner of the first at (600000, 5200000).
    return std::make_shared<const Georeference>(
        1000, 800, GeoTransform::fromTerms({600000.0, 90.0, 0.0, 5200000.0, 0.0, -90.0}).value(),
        std::nullopt);
}

TEST(GoalFrame, PlacesAGoalAtItsSampleWithExaggeratedHeight)
{
    const GoalFrame frame(georeference(), 3.0);
    // The center of sample (10, 20) is 489.5 columns west and 379.5 rows north of the middle.
    const ScenePoint scene =
        frame.toScene({600000.0 + 10.5 * 90.0, 5200000.0 - 20.5 * 90.0, 100.0});
    EXPECT_NEAR(scene.x, -489.5 * 90.0, 1e-6);
    EXPECT_NEAR(scene.y, 379.5 * 90.0, 1e-6);
    EXPECT_EQ(scene.z, 300.0);
    const TracePoint back = frame.fromScene(scene);
    EXPECT_EQ(back.x, 600000.0 + 10.5 * 90.0); // on a sample: without rounding
    EXPECT_EQ(back.y, 5200000.0 - 20.5 * 90.0);
    EXPECT_EQ(back.z, 100.0);
}

// Pixels of a third of a meter, which no number holds: at samples the map's coordinates are those
// of the sample, to the bit, however the conversion rounds.
TEST(GoalFrame, ReturnsTheExactPositionsOfSamples)
{
    const auto thirds = std::make_shared<const Georeference>(
        1000, 800, GeoTransform::fromTerms({0.1, 1.0 / 3.0, 0.0, 0.7, 0.0, -1.0 / 3.0}).value(),
        std::nullopt);
    const GoalFrame frame(thirds, 1.0);
    for (int i = 0; i < 800; ++i) {
        const MapPoint map =
            thirds->toMap({static_cast<double>(i), static_cast<double>((7 * i + 1) % 800)});
        const TracePoint back = frame.fromScene(frame.toScene({map.x, map.y, 0.0}));
        EXPECT_EQ(back.x, map.x) << i;
        EXPECT_EQ(back.y, map.y) << i;
    }
}

TEST(GoalFrame, RoundTripsToTheSamePosition)
{
    Random random;
    const GoalFrame frame(georeference(), 1.7);
    for (int i = 0; i < 10'000; ++i) {
        const TracePoint goal{random.uniform(600000.0, 690000.0),
                              random.uniform(5128000.0, 5200000.0), random.uniform(-1e4, 1e4)};
        const TracePoint back = frame.fromScene(frame.toScene(goal));
        EXPECT_NEAR(back.x, goal.x, 1e-6);
        EXPECT_NEAR(back.y, goal.y, 1e-6);
        EXPECT_NEAR(back.z, goal.z, 1e-9);
    }
}

TEST(GoalFrame, DetectsGoalsOutsideTheOutermostSamples)
{
    const GoalFrame frame(georeference(), 1.0);
    EXPECT_FALSE(frame.isClamped({600045.0, 5199955.0, 0.0})); // exactly the first sample
    EXPECT_TRUE(frame.isClamped({600044.0, 5199955.0, 0.0}));
    EXPECT_TRUE(frame.isClamped({600045.0, 5199956.0, 0.0}));
    EXPECT_FALSE(frame.isClamped({689955.0, 5128045.0, 0.0})); // exactly the last one
    EXPECT_TRUE(frame.isClamped({689956.0, 5128045.0, 0.0}));
    EXPECT_TRUE(frame.isClamped({std::nan(""), 5199955.0, 0.0}));
}

} // namespace
} // namespace marsview::test
