// The tools of the left button, by mouse and by keyboard, in the real window.

#include "core/view/navigation.h"
#include "tests/ui/map_window.h"
#include "ui/canvas/gestures.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/map_overlays.h"
#include "ui/window/keys_dialog.h"
#include "ui/window/window_actions.h"

#include <QAbstractItemView>
#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QSignalSpy>
#include <QTest>
#include <QToolBar>
#include <QToolButton>
#include <QWheelEvent>
#include <QWindow>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace marsview {
namespace {

class ToolsTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
        ASSERT_TRUE(focusMap());
        hover(middle());
    }

    void send(QEvent::Type type,
              QPointF at,
              Qt::MouseButton button,
              Qt::MouseButtons held,
              Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QMouseEvent event(type, at, view().mapToGlobal(at), button, held, modifiers);
        QApplication::sendEvent(&view(), &event);
    }
    void hover(QPointF at) { send(QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton); }
    void press(QPointF at, Qt::MouseButton button = Qt::LeftButton)
    {
        send(QEvent::MouseButtonPress, at, button, button);
    }
    void moveTo(QPointF at, Qt::MouseButton button = Qt::LeftButton)
    {
        send(QEvent::MouseMove, at, Qt::NoButton, button);
    }
    void release(QPointF at, Qt::MouseButton button = Qt::LeftButton)
    {
        send(QEvent::MouseButtonRelease, at, button, Qt::NoButton);
    }
    void wheel(int angle)
    {
        QWheelEvent event(middle(), view().mapToGlobal(middle()), {}, {0, angle}, Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view(), &event);
    }
    QToolButton* buttonOf(Tool tool)
    {
        auto* bar = window_->findChild<QToolBar*>(QStringLiteral("mainToolBar"));
        return qobject_cast<QToolButton*>(bar->widgetForAction(actionFor(tool)));
    }
    QAction* actionFor(Tool tool)
    {
        for (QAction* action : window_->actionSet().tools->actions()) {
            if (action->data().toInt() == static_cast<int>(tool)) {
                return action;
            }
        }
        return nullptr;
    }
};

TEST_F(ToolsTest, ALeftDragPansByDefault)
{
    EXPECT_EQ(view().tool(), Tool::Pan);
    const auto grabbed = view().surfaceAt(middle());
    ASSERT_TRUE(grabbed);
    const OrbitCamera before = view().camera();
    press(middle());
    for (int i = 1; i <= 10; ++i) {
        const QPointF at = middle() + QPointF(7.0, -4.0) * i;
        moveTo(at);
        const auto now = view().positionOf(grabbed->grid);
        ASSERT_TRUE(now);
        EXPECT_NEAR(now->x(), at.x(), 0.05) << "the terrain stays under the pointer";
        EXPECT_NEAR(now->y(), at.y(), 0.05);
        EXPECT_FALSE(view().stylus() && view().stylus()->is_in_contact);
    }
    release(middle() + QPointF(70.0, -40.0));
    EXPECT_EQ(view().camera().azimuth, before.azimuth);
    EXPECT_EQ(view().camera().tilt, before.tilt);
    EXPECT_EQ(view().camera().distance_m, before.distance_m);
    EXPECT_FALSE(view().isMoving()) << "it stops with the pointer";
}

TEST_F(ToolsTest, AreChosenOnTheToolbarInTheMenuAndByKey)
{
    EXPECT_TRUE(buttonOf(Tool::Pan)->isChecked());
    QTest::mouseClick(buttonOf(Tool::Touch), Qt::LeftButton);
    EXPECT_EQ(view().tool(), Tool::Touch);
    EXPECT_FALSE(buttonOf(Tool::Pan)->isChecked());
    actionFor(Tool::Orbit)->trigger();
    EXPECT_EQ(view().tool(), Tool::Orbit);
    EXPECT_TRUE(buttonOf(Tool::Orbit)->isChecked());
    for (const auto& [key, tool] : {std::pair{Qt::Key_T, Tool::Touch},
                                    {Qt::Key_P, Tool::Pan},
                                    {Qt::Key_O, Tool::Orbit},
                                    {Qt::Key_P, Tool::Pan}}) {
        QTest::keyClick(&view(), key);
        EXPECT_EQ(view().tool(), tool);
        for (const ToolInfo& info : toolInfos()) {
            EXPECT_EQ(actionFor(info.tool)->isChecked(), info.tool == tool);
        }
    }
}

TEST_F(ToolsTest, WhatToMeasureAndDrawIsChosenBesideTheButton)
{
    struct Case {
        Tool tool;
        const QActionGroup* kinds;
    };
    const WindowActions& actions = window_->actionSet();
    for (const auto& [tool, kinds] : {Case{Tool::Measure, actions.measure_kinds},
                                      Case{Tool::Annotate, actions.annotation_shapes}}) {
        const QMenu* menu = buttonOf(tool)->menu();
        ASSERT_NE(menu, nullptr);
        EXPECT_EQ(buttonOf(tool)->popupMode(), QToolButton::MenuButtonPopup);
        ASSERT_EQ(menu->actions(), kinds->actions());
        for (QAction* kind : menu->actions()) {
            actionFor(Tool::Pan)->trigger();
            kind->trigger();
            EXPECT_EQ(view().tool(), tool);
            EXPECT_TRUE(kind->isChecked());
            const QString name = kind->text().remove(u'&');
            EXPECT_TRUE(buttonOf(tool)->toolTip().endsWith(name)) << name.toStdString();
        }
    }
}

// A list uses letters to search its rows.
TEST_F(ToolsTest, KeysWorkWhileTheListOfLayersHasTheFocus)
{
    auto* layers = window_->findChild<QListView*>(QStringLiteral("layers"));
    ASSERT_NE(layers, nullptr);
    layers->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([layers] { return layers->hasFocus(); }, kTimeout));
    QTest::keyClick(layers, Qt::Key_T);
    EXPECT_EQ(view().tool(), Tool::Touch);
    const double before = view().exaggeration();
    QTest::keyClick(layers, Qt::Key_Plus);
    EXPECT_GT(view().exaggeration(), before);
}

// 2026-11: with the focus in the measurements, the map's keys searched the rows.
TEST_F(ToolsTest, KeysWorkInEveryListButWhileACellIsEdited)
{
    for (const char* name :
         {"measurements", "measureResults", "annotations", "savedViews", "hapticDevices"}) {
        SCOPED_TRACE(name);
        auto* list = window_->findChild<QAbstractItemView*>(QString::fromLatin1(name));
        if (list == nullptr) {
            ADD_FAILURE();
            continue;
        }
        actionFor(Tool::Pan)->trigger();
        QTest::keyClick(list, Qt::Key_T);
        EXPECT_EQ(view().tool(), Tool::Touch);
    }
    actionFor(Tool::Measure)->trigger();
    press(middle());
    release(middle());
    auto* list = window_->findChild<QAbstractItemView*>(QStringLiteral("measurements"));
    ASSERT_EQ(list->model()->rowCount(), 1);
    list->edit(list->model()->index(0, 0));
    auto* editor = list->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, QStringLiteral("top"));
    EXPECT_EQ(view().tool(), Tool::Measure);
    EXPECT_EQ(editor->text(), QStringLiteral("top"));
}

// The window gets the keys first, also while a menu is open.
TEST_F(ToolsTest, LettersBelongToAnOpenMenu)
{
    const QList<QAction*> menus = window_->menuBar()->actions();
    const auto view_menu = std::find_if(menus.begin(), menus.end(), [](const QAction* action) {
        return action->text() == QStringLiteral("&View");
    });
    ASSERT_NE(view_menu, menus.end());
    (*view_menu)->menu()->popup(window_->mapToGlobal(QPoint(50, 30)));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return QApplication::activePopupWidget() == (*view_menu)->menu(); }, kTimeout));
    QTest::keyClick(window_->windowHandle(), Qt::Key_T);
    EXPECT_EQ(view().tool(), Tool::Pan);
    auto* tools = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(tools, nullptr);
    EXPECT_EQ(tools->title(), QStringLiteral("&Tool"));
    tools->close();
    (*view_menu)->menu()->close();
    QTest::keyClick(window_->windowHandle(), Qt::Key_T);
    EXPECT_EQ(view().tool(), Tool::Touch);
}

TEST_F(ToolsTest, TouchPressesAndTheWheelPressesDeeper)
{
    view().setTool(Tool::Touch);
    const OrbitCamera before = view().camera();
    press(middle());
    ASSERT_TRUE(view().stylus());
    EXPECT_TRUE(view().stylus()->is_in_contact);
    EXPECT_EQ(view().shownStylus(), view().stylus());
    const double goal_z = view().stylus()->goal.z;
    wheel(-120);
    EXPECT_LT(view().stylus()->goal.z, goal_z);
    moveTo(middle() + QPointF(30.0, 10.0));
    release(middle() + QPointF(30.0, 10.0));
    EXPECT_EQ(view().camera(), before);
    EXPECT_FALSE(view().stylus()->is_in_contact);
}

TEST_F(ToolsTest, OrbitTurnsAndTilts)
{
    view().setTool(Tool::Orbit);
    const OrbitCamera before = view().camera();
    press(middle());
    moveTo(middle() + QPointF(100.0, 40.0));
    release(middle() + QPointF(100.0, 40.0));
    EXPECT_NEAR(view().camera().azimuth.degrees() - before.azimuth.degrees(), 30.0, 1e-6);
    EXPECT_NEAR(view().camera().tilt.degrees() - before.tilt.degrees(), -12.0, 1e-6);
}

// A double click flies there, or finishes what is being drawn.
TEST_F(ToolsTest, TheOtherButtonsShiftAndTheWheelAreTheSameWithEveryTool)
{
    for (const ToolInfo& info : toolInfos()) {
        for (const Qt::MouseButton button : {Qt::RightButton, Qt::MiddleButton}) {
            EXPECT_EQ(actionOf(Gesture::Drag, button, Qt::NoModifier, info.tool), MapAction::Orbit);
        }
        for (const Qt::MouseButton button : {Qt::LeftButton, Qt::RightButton, Qt::MiddleButton}) {
            EXPECT_EQ(actionOf(Gesture::Drag, button, Qt::ShiftModifier, info.tool),
                      MapAction::Pan);
        }
        EXPECT_EQ(actionOf(Gesture::Wheel, Qt::NoButton, Qt::NoModifier, info.tool),
                  MapAction::Zoom);
        EXPECT_EQ(actionOf(Gesture::Wheel, Qt::NoButton, Qt::ControlModifier, info.tool),
                  MapAction::ZoomFinely);
        const bool draws = info.tool == Tool::Measure || info.tool == Tool::Annotate;
        EXPECT_EQ(actionOf(Gesture::DoubleClick, Qt::LeftButton, Qt::NoModifier, info.tool),
                  draws ? MapAction::FinishDrawing : MapAction::FlyThere);
        EXPECT_EQ(actionOf(Gesture::Click, Qt::RightButton, Qt::NoModifier, info.tool),
                  MapAction::OpenMenu);
    }
}

TEST_F(ToolsTest, ThePointerShowsTheTool)
{
    const auto shape = [this] { return view().cursor().shape(); };
    const QPointF sky(view().width() / 2.0, 4.0);
    OrbitCamera low = view().camera();
    low.tilt = Angle::degrees(85.0);
    view().setCamera(low);
    ASSERT_FALSE(view().surfaceAt(sky));
    ASSERT_TRUE(view().surfaceAt(middle()));
    for (const auto& [tool, over, dragging] :
         {std::tuple{Tool::Pan, Qt::OpenHandCursor, Qt::ClosedHandCursor},
          std::tuple{Tool::Touch, Qt::CrossCursor, Qt::CrossCursor},
          std::tuple{Tool::Orbit, Qt::BitmapCursor, Qt::BitmapCursor}}) {
        view().setTool(tool);
        hover(sky);
        EXPECT_EQ(shape(), Qt::ArrowCursor);
        hover(middle());
        EXPECT_EQ(shape(), over);
        press(middle());
        EXPECT_EQ(shape(), dragging);
        release(middle());
        EXPECT_EQ(shape(), over);
        press(middle(), Qt::MiddleButton);
        EXPECT_EQ(shape(), Qt::BitmapCursor) << "turning";
        release(middle(), Qt::MiddleButton);
    }
    EXPECT_EQ(window_->overlays()->compass()->cursor().shape(), Qt::ArrowCursor);
}

TEST_F(ToolsTest, TheStylusOfTheMouseIsShownWithTheTouchToolOnly)
{
    const auto is_cursor_drawn = [this] {
        const QImage picture = view().grabFramebuffer();
        const QImage terrain = view().terrainPicture();
        return picture != terrain;
    };
    hover(middle());
    EXPECT_FALSE(view().shownStylus());
    EXPECT_FALSE(is_cursor_drawn());
    view().setTool(Tool::Touch);
    EXPECT_TRUE(view().shownStylus());
    EXPECT_TRUE(is_cursor_drawn());
    view().setTool(Tool::Orbit);
    EXPECT_FALSE(view().shownStylus());
    EXPECT_FALSE(is_cursor_drawn());
    StylusPose device;
    device.proxy = device.goal = view().camera().target;
    view().showDevice(device);
    EXPECT_TRUE(view().shownStylus()) << "a device touches with every tool";
    view().showDevice(std::nullopt);
}

TEST_F(ToolsTest, TheReadoutFollowsThePointerWithEveryTool)
{
    for (const ToolInfo& info : toolInfos()) {
        view().setTool(info.tool);
        QSignalSpy moved(&view(), &TerrainView::pointerMoved);
        hover(middle() + QPointF(5.0, 3.0));
        ASSERT_GT(moved.count(), 0);
        const auto hit = moved.last()[0].value<std::optional<RayHit>>();
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->height_m, view().surfaceAt(middle() + QPointF(5.0, 3.0))->height_m);
        hover(middle());
    }
}

TEST_F(ToolsTest, ChangingTheToolEndsTheDrag)
{
    view().setTool(Tool::Touch);
    press(middle());
    ASSERT_TRUE(view().stylus()->is_in_contact);
    QTest::keyClick(&view(), Qt::Key_P);
    EXPECT_FALSE(view().stylus()->is_in_contact);
    const OrbitCamera before = view().camera();
    moveTo(middle() + QPointF(50.0, 0.0));
    EXPECT_EQ(view().camera(), before);
    release(middle() + QPointF(50.0, 0.0));
}

TEST_F(ToolsTest, ARightClickOpensTheMenuAndARightDragDoesNot)
{
    QSignalSpy asked(&view(), &TerrainView::menuRequested);
    const OrbitCamera before = view().camera();
    press(middle(), Qt::RightButton);
    moveTo(middle() + QPointF(2.0, 1.0), Qt::RightButton);
    EXPECT_EQ(view().camera(), before) << "an unsteady hand does not turn the view";
    release(middle() + QPointF(2.0, 1.0), Qt::RightButton);
    ASSERT_EQ(asked.count(), 1);
    EXPECT_EQ(asked[0][0].toPointF(), middle() + QPointF(2.0, 1.0));
    press(middle(), Qt::RightButton);
    moveTo(middle() + QPointF(60.0, 0.0), Qt::RightButton);
    moveTo(middle(), Qt::RightButton); // back to its start
    release(middle(), Qt::RightButton);
    EXPECT_EQ(asked.count(), 1);
}

TEST_F(ToolsTest, TheListOfKeysHasEveryGesture)
{
    window_->actionSet().keys->trigger();
    auto* dialog = window_->findChild<KeysDialog*>();
    ASSERT_NE(dialog, nullptr);
    QStringList texts;
    for (const QLabel* label : dialog->findChildren<QLabel*>()) {
        texts.append(label->text());
    }
    EXPECT_GE(gestureLines().size(), 9U);
    for (const GestureLine& line : gestureLines()) {
        EXPECT_TRUE(texts.contains(line.gesture)) << line.gesture.toStdString();
        EXPECT_TRUE(texts.contains(line.action)) << line.action.toStdString();
    }
    for (const char* gesture : {"Left drag (Pan)", "Left drag (Touch)", "Left drag (Orbit)",
                                "Right or middle drag", "Shift+Drag", "Ctrl+Wheel"}) {
        EXPECT_TRUE(texts.contains(QString::fromLatin1(gesture))) << gesture;
    }
    dialog->close();
}

} // namespace
} // namespace marsview
