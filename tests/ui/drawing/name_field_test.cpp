// Naming annotations where they are placed, by mouse and by keyboard.

#include "tests/ui/map_window.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/test_map.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/drawing/name_field.h"
#include "ui/panels/annotation_list.h"
#include "ui/panels/annotation_panel.h"
#include "ui/window/window_actions.h"

#include <QActionGroup>
#include <QTest>
#include <QUndoStack>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class NameFieldTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
        field_ = window_->findChild<NameField*>();
        ASSERT_NE(field_, nullptr);
    }
    AnnotationController& annotating() { return *window_->annotating(); }
    const QString& lastName() { return annotating().state().items.back().name; }
    void choose(FeatureShape shape)
    {
        for (QAction* action : window_->actionSet().annotation_shapes->actions()) {
            if (action->data().toInt() == static_cast<int>(shape)) {
                action->trigger();
            }
        }
        // The panel below the map makes it smaller.
        ASSERT_TRUE(waitFor([this] { return window_->annotationPanel()->list()->isVisible(); }));
        ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
        ASSERT_TRUE(focusMap());
    }
    QPoint at(double right, double down)
    {
        return {static_cast<int>((0.5 + right) * view().width()),
                static_cast<int>((0.5 + down) * view().height())};
    }
    void click(QPoint position) { QTest::mouseClick(&view(), Qt::LeftButton, {}, position); }
    // What the keyboard does in the window: the widget that has the focus gets the key.
    void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {})
    {
        QTest::keyClick(window_->focusWidget(), key, modifiers);
    }
    bool isNaming() { return field_->isVisible() && window_->focusWidget() == field_; }

    NameField* field_ = nullptr;
};

} // namespace

TEST_F(NameFieldTest, APointIsNamedWhereItWasClicked)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    click(at(-0.2, -0.1));
    ASSERT_TRUE(isNaming());
    EXPECT_EQ(field_->text(), QStringLiteral("Point 1"));
    EXPECT_EQ(field_->selectedText(), QStringLiteral("Point 1"));
    EXPECT_LT((field_->pos() - at(-0.2, -0.1)).manhattanLength(), 40) << "beside the mark";
    const int steps = window_->undoStack().index();
    QTest::keyClicks(field_, QStringLiteral("Layer of rock"));
    press(Qt::Key_Return);
    EXPECT_FALSE(field_->isVisible());
    EXPECT_EQ(window_->focusWidget(), &view());
    EXPECT_EQ(lastName(), QStringLiteral("Layer of rock"));
    EXPECT_EQ(annotating().state().items.size(), 1U) << "Enter places no point";
    EXPECT_EQ(window_->undoStack().index(), steps + 1);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Rename"));
    window_->undoStack().undo();
    EXPECT_EQ(lastName(), QStringLiteral("Point 1"));
}

TEST_F(NameFieldTest, EscapeKeepsTheUsualName)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    click(at(-0.2, -0.1));
    ASSERT_TRUE(isNaming());
    const int steps = window_->undoStack().index();
    QTest::keyClicks(field_, QStringLiteral("no"));
    press(Qt::Key_Escape);
    EXPECT_FALSE(field_->isVisible());
    EXPECT_EQ(window_->focusWidget(), &view());
    EXPECT_EQ(lastName(), QStringLiteral("Point 1"));
    EXPECT_EQ(window_->undoStack().index(), steps) << "no step of undo";
    EXPECT_NE(annotating().current(), nullptr) << "still selected";
}

TEST_F(NameFieldTest, TheNextClickKeepsTheNameAndPlacesAPoint)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    click(at(-0.2, -0.1));
    QTest::keyClicks(field_, QStringLiteral("first"));
    click(at(0.2, 0.1));
    ASSERT_EQ(annotating().state().items.size(), 2U);
    EXPECT_EQ(annotating().state().items[0].name, QStringLiteral("first"));
    ASSERT_TRUE(isNaming()) << "of the second one";
    EXPECT_EQ(field_->text(), QStringLiteral("Point 2"));
    // Untouched, the name is no step of undo.
    const int steps = window_->undoStack().index();
    view().setFocus();
    EXPECT_FALSE(field_->isVisible());
    EXPECT_EQ(window_->undoStack().index(), steps);
}

TEST_F(NameFieldTest, LinesAndPolygonsAreNamedWhenTheyAreFinished)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    click(at(-0.1, 0.1));
    EXPECT_FALSE(field_->isVisible());
    click(at(0.1, 0.1));
    EXPECT_FALSE(field_->isVisible());
    doubleClick(view(), at(0.1, 0.1));
    ASSERT_TRUE(isNaming());
    EXPECT_EQ(field_->text(), QStringLiteral("Line 1"));
    QTest::keyClicks(field_, QStringLiteral("fault"));
    press(Qt::Key_Enter);
    EXPECT_EQ(lastName(), QStringLiteral("fault"));
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Polygon));
    for (const QPoint& corner : {at(0.1, -0.2), at(0.25, -0.2), at(0.2, 0.0), at(0.1, -0.2)}) {
        EXPECT_FALSE(field_->isVisible());
        click(corner);
    }
    ASSERT_TRUE(isNaming()) << "its first point closes it";
    EXPECT_EQ(field_->text(), QStringLiteral("Polygon 2"));
    // Something else begins: it keeps its name, and no field opens for the line that is open then.
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    EXPECT_FALSE(field_->isVisible());
    click(at(-0.1, 0.2));
    click(at(0.1, 0.2));
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    EXPECT_FALSE(field_->isVisible());
}

TEST_F(NameFieldTest, TheKeyboardPlacesNamesAndGoesOn)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    leaveTheMap();
    ASSERT_TRUE(view().isCrosshairShown());
    press(Qt::Key_Return);
    ASSERT_TRUE(isNaming());
    QTest::keyClicks(field_, QStringLiteral("a"));
    EXPECT_EQ(view().tool(), Tool::Annotate) << "letters are text and no commands";
    press(Qt::Key_Left); // text was typed: a key of the field
    EXPECT_TRUE(isNaming());
    press(Qt::Key_Return);
    EXPECT_EQ(lastName(), QStringLiteral("a"));
    // The arrow keys move the map although the field is open, and the next point is placed.
    press(Qt::Key_Right);
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    press(Qt::Key_Return);
    ASSERT_EQ(annotating().state().items.size(), 2U);
    ASSERT_TRUE(isNaming());
    const OrbitCamera before = view().cameraGoal();
    press(Qt::Key_Up);
    EXPECT_FALSE(field_->isVisible());
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    EXPECT_FALSE(view().cameraGoal() == before);
    EXPECT_EQ(window_->focusWidget(), &view());
    press(Qt::Key_Return);
    ASSERT_EQ(annotating().state().items.size(), 3U);
    // Undo is that of the window.
    ASSERT_TRUE(isNaming());
    press(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(annotating().state().items.size(), 2U);
    EXPECT_FALSE(field_->isVisible());
    EXPECT_EQ(annotating().state().items[1].name, QStringLiteral("Point 2"));
}

TEST_F(NameFieldTest, ItFollowsTheMapAndKeepsTheNameWhenItsMarkLeaves)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    click(at(-0.1, -0.1));
    ASSERT_TRUE(isNaming());
    QTest::keyClicks(field_, QStringLiteral("cone"));
    OrbitCamera camera = view().camera();
    camera.azimuth = camera.azimuth + Angle::degrees(40.0);
    view().setCamera(camera);
    const auto beside = [this] {
        const auto place = annotating().namePlace(1);
        return place && (field_->pos() - place->toPoint()).manhattanLength() < 40;
    };
    EXPECT_TRUE(waitFor(beside));
    EXPECT_TRUE(isNaming());
    camera.target.x += 40.0 * camera.distance_m;
    view().setCamera(camera);
    EXPECT_TRUE(waitFor([this] { return !field_->isVisible(); }));
    EXPECT_EQ(lastName(), QStringLiteral("cone"));
}

} // namespace marsview
