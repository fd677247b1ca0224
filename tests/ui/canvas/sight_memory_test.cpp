#include "core/view/exaggeration.h"
#include "tests/support/map_maker.h"
#include "tests/ui/test_map.h"
#include "ui/canvas/sight_memory.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace marsview {
namespace {

class SightMemoryTest : public testing::Test {
protected:
    ShownScene sceneOf(const std::vector<std::shared_ptr<const Map>>& maps,
                       double exaggeration = 1.0)
    {
        ShownScene scene;
        std::vector<ShownLayer> layers;
        for (const auto& map : maps) {
            layers.push_back({.map = map, .ramp = colorRampNamed("grey")});
        }
        scene.setLayers(layers);
        scene.style.exaggeration = exaggeration;
        return scene;
    }

    TestMaps maps_;
    std::shared_ptr<const Map> hill_ = test::loadedMap(maps_.hill().toStdString());
    // Next to it.
    std::shared_ptr<const Map> slope_ =
        test::loadedMap(maps_
                            .write(QStringLiteral("slope.asc"),
                                   {.columns = 50, .x_lower_left = 501800.0},
                                   [](int column, int) { return 10.0 * column; })
                            .toStdString());
    OrbitCamera camera_{.target = {120.0, -80.0, 5.0}, .distance_m = 900.0};
    SightMemory memory_;
};

TEST_F(SightMemoryTest, ANewMapGetsItsOpeningViewAndTheExaggerationThatSuitsIt)
{
    const NextSight next = nextSight({}, sceneOf({hill_}), camera_, memory_, std::nullopt);
    EXPECT_TRUE(next.is_opening);
    EXPECT_FALSE(next.camera);
    EXPECT_EQ(next.exaggeration, suitableExaggeration(*hill_));
}

// Two tiles of one size: scene coordinates count from the center of each.
TEST_F(SightMemoryTest, ANeighborOfTheSameSizeIsAnotherPlace)
{
    const auto height = [](int column, int row) { return 10.0 * column + row; };
    const auto tile = [&](const char* name, double x_lower_left) {
        return test::loadedMap(maps_
                                   .write(QString::fromLatin1(name),
                                          {.columns = 50, .x_lower_left = x_lower_left}, height)
                                   .toStdString());
    };
    const auto west = tile("west.asc", 500000.0);
    const auto east = tile("east.asc", 501500.0);
    ASSERT_EQ(west->georeference().sceneFrame(), east->georeference().sceneFrame());
    const NextSight next =
        nextSight(sceneOf({west}), sceneOf({east}), camera_, memory_, std::nullopt);
    EXPECT_TRUE(next.is_opening);
    const auto twin = tile("twin.asc", 500000.0);
    EXPECT_FALSE(
        nextSight(sceneOf({west}), sceneOf({twin}), camera_, memory_, std::nullopt).is_opening);
}

TEST_F(SightMemoryTest, AMapThatWasShownBeforeIsSeenAsItWasLeft)
{
    const ShownScene before = sceneOf({slope_});
    memory_.remember(hill_, {.camera = camera_, .exaggeration = 7.0});
    const NextSight next =
        nextSight(before, sceneOf({hill_}), OrbitCamera{}, memory_, std::nullopt);
    EXPECT_FALSE(next.is_opening);
    ASSERT_TRUE(next.camera);
    EXPECT_EQ(*next.camera, camera_);
    EXPECT_EQ(next.exaggeration, 7.0);
}

TEST_F(SightMemoryTest, AMapThatStaysInSightKeepsItsPieceOfTerrainInThePicture)
{
    const ShownScene before = sceneOf({hill_}, 3.0);
    const ShownScene now = sceneOf({slope_, hill_}, 3.0);
    const NextSight next = nextSight(before, now, camera_, memory_, std::nullopt);
    ASSERT_FALSE(next.is_opening);
    EXPECT_EQ(next.exaggeration, 3.0);
    const OrbitCamera camera = next.camera.value_or(camera_);
    const GridPoint seen = before.ground().maps()[0].frame.toGrid(camera_.target);
    const GridPoint still = now.ground().maps()[1].frame.toGrid(camera.target);
    EXPECT_NEAR(still.column, seen.column, 1e-9);
    EXPECT_NEAR(still.row, seen.row, 1e-9);
}

TEST_F(SightMemoryTest, AnEmptySceneKeepsCameraAndExaggeration)
{
    const NextSight next = nextSight(sceneOf({hill_}, 4.0), {}, camera_, memory_, std::nullopt);
    EXPECT_FALSE(next.is_opening);
    EXPECT_FALSE(next.camera);
    EXPECT_EQ(next.exaggeration, 4.0);
}

TEST_F(SightMemoryTest, TheExaggerationThatIsAskedForWinsAndMovesTheTargetWithTheTerrain)
{
    const ShownScene before = sceneOf({hill_}, 2.0);
    const NextSight next = nextSight(before, sceneOf({hill_}, 2.0), camera_, memory_, 6.0);
    EXPECT_EQ(next.exaggeration, 6.0);
    ASSERT_TRUE(next.camera);
    EXPECT_DOUBLE_EQ(next.camera->target.z, 15.0); // three times as high
}

TEST_F(SightMemoryTest, APreviewHandsItsSightToTheMap)
{
    memory_.remember(hill_, {.camera = camera_, .exaggeration = 2.0});
    memory_.replacePreview(hill_, slope_);
    EXPECT_FALSE(memory_.find(hill_));
    ASSERT_TRUE(memory_.find(slope_));
    EXPECT_EQ(memory_.find(slope_)->camera, camera_);
}

} // namespace
} // namespace marsview
