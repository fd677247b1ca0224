// Measuring and annotating with a haptic device: its stylus is the pointer, its button confirms.
#include "tests/ui/controllers/haptics/touched_hill.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"

#include <QSignalSpy>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <variant>

namespace marsview {
namespace {

class StylusDrawingTest : public TouchedHillTest {
protected:
    void SetUp() override
    {
        TouchedHillTest::SetUp();
        ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
        ASSERT_TRUE(waitFor([this] { return state().tick > 10; }));
    }
    MeasureController& measuring() { return *window_->measuring(); }
    // In contact with the surface there, in the workspace.
    bool pressAt(double x, double y)
    {
        hand_->moveTo({x, y, -0.055});
        return waitFor([&] {
            const LoopState now = state();
            return std::hypot(now.hand.x - x, now.hand.y - y) < 1e-9 &&
                   now.hand.z < -0.055 + 1e-9 && now.contact.is_in_contact;
        });
    }
    // The panel of the tool changes the picture, and in free space the workspace is fitted to it.
    bool isFitted()
    {
        const LoopState before = state();
        return waitFor([&] { return state().tick > before.tick + 100; }) &&
               state().frame == before.frame;
    }
    // Until the window has heard of both.
    bool clickButton()
    {
        QSignalSpy pressed(&device(), &DeviceSession::pointPressed);
        QSignalSpy released(&device(), &DeviceSession::pointReleased);
        hand_->buttons = 1;
        if (!waitFor([&] { return pressed.count() == 1; })) {
            return false;
        }
        hand_->buttons = 0;
        return waitFor([&] { return released.count() == 1; });
    }
    // Where the scene has a vertex of a map without a CRS of a body.
    ScenePoint placeOf(const DrawnVertex& vertex)
    {
        const Map& map = *view().map();
        const Georeference& georeference = map.georeference();
        const GridPoint grid = georeference.toGrid(std::get<MapPoint>(vertex));
        return georeference.sceneFrame().toScene(grid, map.heightfield().height(grid) *
                                                           view().exaggeration());
    }
};

double distanceBetween(const ScenePoint& a, const ScenePoint& b)
{
    return length(a - b);
}

} // namespace

TEST_F(StylusDrawingTest, TheButtonSetsPointsWhereTheStylusTouches)
{
    measuring().begin(MeasurementKind::Distance);
    ASSERT_TRUE(pressAt(-0.02, 0.0));
    const ScenePoint first = state().contact.proxy;
    const OrbitCamera camera = view().camera();
    ASSERT_TRUE(clickButton());
    ASSERT_NE(measuring().current(), nullptr);
    ASSERT_EQ(measuring().current()->vertices.size(), 1U);
    EXPECT_LT(distanceBetween(placeOf(measuring().current()->vertices[0]), first),
              1e-6 * camera.distance_m);
    ASSERT_TRUE(pressAt(0.02, 0.01));
    const ScenePoint second = state().contact.proxy;
    ASSERT_TRUE(clickButton());
    ASSERT_EQ(measuring().current()->vertices.size(), 2U);
    EXPECT_LT(distanceBetween(placeOf(measuring().current()->vertices[1]), second),
              1e-6 * camera.distance_m);
    EXPECT_EQ(view().camera(), camera) << "the map stays";
    EXPECT_GT(hand_->force_n, 0.5) << "the terrain is still felt";
    ASSERT_TRUE(clickButton()); // in the same place
    EXPECT_TRUE(measuring().current()->is_finished);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
    window_->undoStack().undo();
    EXPECT_EQ(measuring().current()->vertices.size(), 1U);
}

TEST_F(StylusDrawingTest, AHandInTheAirSetsPointsStraightBelow)
{
    measuring().begin(MeasurementKind::Slope);
    hand_->moveTo({0.01, 0.01, 0.05});
    ASSERT_TRUE(waitFor([&] { return state().hand.z > 0.05 - 1e-9 && isFitted(); }));
    ASSERT_FALSE(state().contact.is_in_contact);
    const ScenePoint hand = state().goal;
    ASSERT_TRUE(clickButton());
    ASSERT_NE(measuring().current(), nullptr);
    const ScenePoint point = placeOf(measuring().current()->vertices[0]);
    EXPECT_NEAR(point.x, hand.x, 1e-6 * view().camera().distance_m);
    EXPECT_NEAR(point.y, hand.y, 1e-6 * view().camera().distance_m);
    EXPECT_LT(point.z, hand.z);
}

TEST_F(StylusDrawingTest, AHeldButtonMovesAPoint)
{
    measuring().begin(MeasurementKind::Distance);
    ASSERT_TRUE(pressAt(-0.02, 0.0));
    ASSERT_TRUE(clickButton());
    ASSERT_TRUE(pressAt(0.02, 0.01));
    ASSERT_TRUE(clickButton());
    ASSERT_TRUE(clickButton());
    ASSERT_TRUE(measuring().current()->is_finished);
    const int steps = window_->undoStack().count();
    hand_->buttons = 1; // on the last point
    ASSERT_TRUE(pressAt(0.03, -0.02));
    const ScenePoint moved = state().contact.proxy;
    ASSERT_TRUE(waitFor([&] {
        return distanceBetween(placeOf(measuring().current()->vertices[1]), moved) <
               1e-6 * view().camera().distance_m;
    }));
    hand_->buttons = 0;
    ASSERT_TRUE(waitFor([&] { return window_->undoStack().count() == steps + 1; }));
    EXPECT_EQ(measuring().state().items.size(), 1U);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
}

TEST_F(StylusDrawingTest, AtItsFirstPointAPolygonIsClosed)
{
    AnnotationController& annotating = *window_->annotating();
    annotating.begin(FeatureShape::Polygon);
    for (const auto& [x, y] : {std::pair(-0.02, 0.0), std::pair(0.02, 0.0), std::pair(0.0, 0.02),
                               std::pair(-0.02, 0.0)}) {
        ASSERT_TRUE(pressAt(x, y));
        ASSERT_TRUE(clickButton());
    }
    ASSERT_NE(annotating.current(), nullptr);
    EXPECT_TRUE(annotating.current()->is_finished);
    EXPECT_EQ(annotating.current()->vertices.size(), 3U);
}

TEST_F(StylusDrawingTest, WithAnotherToolTheButtonGrabs)
{
    measuring().begin(MeasurementKind::Distance);
    ASSERT_TRUE(pressAt(0.0, 0.0));
    view().setTool(Tool::Pan);
    hand_->buttons = 1;
    EXPECT_TRUE(waitFor([&] { return state().mode == StylusMode::Pan; }));
    EXPECT_EQ(measuring().current(), nullptr);
    hand_->buttons = 0;
    EXPECT_TRUE(waitFor([&] { return state().mode != StylusMode::Pan; }));
}

} // namespace marsview
