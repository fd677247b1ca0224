// Help for newcomers: the hint over the map, full screen, What's This and the list of shortcuts.

#include "tests/ui/pointer_moves.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/keys_dialog.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QGroupBox>
#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QWhatsThis>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace marsview {
namespace {

class FirstMinuteTest : public testing::Test {
protected:
    void SetUp() override { QSettings().clear(); }
    void TearDown() override
    {
        window_.reset();
        QSettings().clear();
    }

    void open(WindowOptions::Geometry geometry = WindowOptions::Geometry::Remembered)
    {
        WindowOptions options = testWindowOptions();
        options.geometry = geometry;
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(1280, 800);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // possibly without a window manager
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
        view().setFocus();
        ASSERT_TRUE(QTest::qWaitFor([this] { return view().hasFocus(); }, kTimeout));
    }

    TerrainView& view() { return *window_->view(); }
    GestureHint& hint() { return *window_->overlays()->hint(); }
    void drag(Qt::MouseButton button)
    {
        const QPointF from = QRectF(view().rect()).center() + QPointF(0.0, 60.0);
        const auto send = [&](QEvent::Type type, QPointF at, Qt::MouseButton b,
                              Qt::MouseButtons held) {
            QMouseEvent event(type, at, view().mapToGlobal(at), b, held, Qt::NoModifier);
            QApplication::sendEvent(&view(), &event);
        };
        send(QEvent::MouseButtonPress, from, button, button);
        send(QEvent::MouseMove, from + QPointF(30.0, 5.0), Qt::NoButton, button);
        send(QEvent::MouseButtonRelease, from + QPointF(30.0, 5.0), button, Qt::NoButton);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(FirstMinuteTest, TheHintNamesTheGesturesUntilItIsClosed)
{
    open();
    ASSERT_TRUE(hint().isVisible());
    EXPECT_FALSE(hint().accessibleName().isEmpty());
    for (const char* word : {"Drag or arrow keys", "Right-drag or Q, E, R, F",
                             "Wheel or Page Up/Down", "Double-click", "Choose Touch (T)"}) {
        EXPECT_TRUE(hint().accessibleDescription().contains(QString::fromLatin1(word))) << word;
    }
    for (const QWidget* other : std::initializer_list<const QWidget*>{
             window_->overlays()->legend(), window_->overlays()->minimap()}) {
        EXPECT_TRUE(other->isVisible());
        EXPECT_FALSE(hint().geometry().intersects(other->geometry()));
    }
    QTest::mouseClick(hint().findChild<QToolButton*>(QStringLiteral("closeHint")), Qt::LeftButton);
    EXPECT_FALSE(hint().isVisible());
    open(); // the next start
    EXPECT_FALSE(hint().isVisible());
}

TEST_F(FirstMinuteTest, TheHintMakesRoomForToolsWhoseClicksDoSomethingElse)
{
    open();
    ASSERT_TRUE(hint().isVisible());
    for (const Tool tool : {Tool::Measure, Tool::Annotate}) {
        window_->view()->setTool(tool);
        EXPECT_FALSE(hint().isVisible());
        window_->view()->setTool(Tool::Pan);
        EXPECT_TRUE(hint().isVisible());
    }
}

TEST_F(FirstMinuteTest, EscClosesTheHint)
{
    open();
    ASSERT_TRUE(hint().isVisible());
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_FALSE(hint().isVisible());
    open();
    EXPECT_FALSE(hint().isVisible());
}

TEST_F(FirstMinuteTest, EscInAFieldOrAMenuKeepsWhatIsOnTheMap)
{
    open();
    window_->overlays()->markPlace(GridPoint{5.0, 5.0});
    const auto expect_kept = [this](const char* where) {
        EXPECT_TRUE(hint().isVisible()) << where;
        EXPECT_TRUE(window_->overlays()->isPlaceMarked()) << where;
    };
    window_->actionSet().find_name->trigger();
    ASSERT_FALSE(view().hasFocus());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
    expect_kept("search field");
    EXPECT_TRUE(view().hasFocus());
    QMenu* menu = window_->menuBar()->actions().front()->menu();
    QTest::keyClick(&view(), Qt::Key_F, Qt::AltModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return menu->isVisible(); }, kTimeout));
    QTest::keyClick(menu, Qt::Key_Escape);
    EXPECT_FALSE(menu->isVisible());
    expect_kept("menu");
    if (!view().hasFocus()) {
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
        expect_kept("menu bar");
    }
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_FALSE(window_->overlays()->isPlaceMarked());
    EXPECT_TRUE(hint().isVisible()) << "one thing at a time";
}

TEST_F(FirstMinuteTest, F10OpensTheMenus)
{
    open();
    QMenu* menu = window_->menuBar()->actions().front()->menu();
    QTest::keyClick(&view(), Qt::Key_F10);
    ASSERT_TRUE(QTest::qWaitFor([&] { return menu->isVisible(); }, kTimeout));
    QTest::keyClick(menu, Qt::Key_Escape);
    EXPECT_FALSE(menu->isVisible());
}

// A menu passes arrows on to the menu bar: they were taken for those of the map.
TEST_F(FirstMinuteTest, ArrowsGoFromMenuToMenu)
{
    open();
    ASSERT_TRUE(QTest::qWaitFor([this] { return !view().isMoving(); }, kTimeout));
    const OrbitCamera before = view().camera();
    const QList<QAction*> menus = window_->menuBar()->actions();
    QTest::keyClick(&view(), Qt::Key_F, Qt::AltModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return menus[0]->menu()->isVisible(); }, kTimeout));
    QTest::keyClick(menus[0]->menu(), Qt::Key_Right);
    ASSERT_TRUE(QTest::qWaitFor([&] { return menus[1]->menu()->isVisible(); }, kTimeout));
    QTest::keyClick(menus[1]->menu(), Qt::Key_Escape);
    EXPECT_EQ(view().camera(), before);
    EXPECT_FALSE(view().isMoving());
}

TEST_F(FirstMinuteTest, TheHintGoesWhenAllWasTried)
{
    open();
    drag(Qt::LeftButton);
    EXPECT_TRUE(hint().isDone(MapAction::Pan));
    EXPECT_FALSE(hint().isDone(MapAction::Orbit));
    drag(Qt::RightButton);
    EXPECT_TRUE(hint().isDone(MapAction::Orbit));
    const QPointF middle = QRectF(view().rect()).center();
    QWheelEvent wheel(middle, view().mapToGlobal(middle), {}, {0, 120}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &wheel);
    EXPECT_TRUE(hint().isDone(MapAction::Zoom));
    QTest::keyClick(&view(), Qt::Key_T);
    drag(Qt::LeftButton);
    EXPECT_TRUE(hint().isDone(MapAction::Touch));
    EXPECT_TRUE(hint().isVisible());
    doubleClick(view(), middle.toPoint());
    EXPECT_FALSE(hint().isVisible());
    open();
    EXPECT_FALSE(hint().isVisible());
}

TEST_F(FirstMinuteTest, KeysCountAsTheGesturesTheyStandFor)
{
    const auto press_all = [this](QWidget& map, const GestureHint& shown) {
        for (const auto& [key, action] :
             {std::pair{Qt::Key_Left, MapAction::Pan}, std::pair{Qt::Key_Q, MapAction::Orbit},
              std::pair{Qt::Key_PageUp, MapAction::Zoom}}) {
            EXPECT_FALSE(shown.isDone(action)) << key;
            QTest::keyClick(&map, key);
            EXPECT_TRUE(shown.isDone(action)) << key;
        }
    };
    open();
    press_all(view(), hint());
    window_->actionSet().globe->trigger();
    GlobeView& globe = *window_->globe();
    ASSERT_TRUE(QTest::qWaitFor([&] { return globe.isVisible(); }, kTimeout));
    globe.setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return globe.hasFocus(); }, kTimeout));
    press_all(globe, *globe.findChild<GestureHint*>());
}

// With large fonts or scaling the window has this size in points.
TEST_F(FirstMinuteTest, ASmallWindowKeepsTheSearchReachable)
{
    open();
    window_->resize(640, 390);
    auto* more =
        window_->toolBar()->findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return more->isVisible(); }, kTimeout));
    const QLineEdit& field = window_->toolBar()->searchField();
    ASSERT_FALSE(field.isVisible());
    QTest::mouseClick(more, Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor([&] { return field.isVisible(); }, kTimeout));
}

TEST_F(FirstMinuteTest, ThereIsNoHintInPicturesOfTheWindow)
{
    open(WindowOptions::Geometry::Fixed);
    EXPECT_FALSE(hint().isVisible());
}

TEST_F(FirstMinuteTest, FullScreenIsEnteredAndLeftByKey)
{
    open();
    QTest::keyClick(&view(), Qt::Key_F11);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->isFullScreen(); }, kTimeout));
    EXPECT_TRUE(window_->actionSet().full_screen->isChecked());
    EXPECT_TRUE(window_->menuBar()->isVisible());
    QTest::keyClick(&view(), Qt::Key_F11);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->isFullScreen(); }, kTimeout));
    window_->actionSet().full_screen->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->isFullScreen(); }, kTimeout));
    QTest::keyClick(&view(), Qt::Key_Escape);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->isFullScreen(); }, kTimeout));
    EXPECT_FALSE(window_->actionSet().full_screen->isChecked());
    EXPECT_TRUE(hint().isVisible()) << "one thing at a time";
    // The same from a button, but not from a field.
    window_->actionSet().full_screen->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->isFullScreen(); }, kTimeout));
    window_->toolBar()->searchField().setFocus();
    QTest::keyClick(&window_->toolBar()->searchField(), Qt::Key_Escape);
    EXPECT_TRUE(window_->actionSet().full_screen->isChecked());
    EXPECT_TRUE(view().hasFocus());
    QWidget* button = window_->findChild<QToolButton*>(QStringLiteral("trueScale"));
    button->setFocus();
    QTest::keyClick(button, Qt::Key_Escape);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->isFullScreen(); }, kTimeout));
    EXPECT_TRUE(view().hasFocus());
}

TEST_F(FirstMinuteTest, WhatsThisExplainsTheMainControls)
{
    open();
    QTest::keyClick(&view(), Qt::Key_F1, Qt::ShiftModifier);
    EXPECT_TRUE(QWhatsThis::inWhatsThisMode());
    QWhatsThis::leaveWhatsThisMode();
    for (QWidget* control : std::initializer_list<QWidget*>{&view(), window_->overlays()->legend(),
                                                            window_->overlays()->minimap()}) {
        QHelpEvent asked(QEvent::QueryWhatsThis, QPoint(5, 5), control->mapToGlobal(QPoint(5, 5)));
        QApplication::sendEvent(control, &asked);
        EXPECT_TRUE(asked.isAccepted());
        EXPECT_GT(control->whatsThis().size(), 20);
    }
    for (const QAction* action : window_->actionSet().tools->actions()) {
        EXPECT_GT(action->whatsThis().size(), 20);
    }
    window_->actionSet().globe->trigger();
    GlobeView& globe = *window_->globe();
    ASSERT_TRUE(QTest::qWaitFor([&] { return globe.isVisible(); }, kTimeout));
    QWidgetList others{&globe,
                       globe.findChild<Legend*>(),
                       globe.findChild<Minimap*>(),
                       globe.findChild<Compass*>(),
                       globe.findChild<ScaleBarView*>(),
                       &window_->toolBar()->searchField(),
                       window_->findChild<NoticeBar*>()};
    for (QToolButton* button :
         window_->toolBar()->findChildren<QToolButton*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (button->objectName() != QStringLiteral("qt_toolbar_ext_button")) {
            others.append(button);
        }
    }
    EXPECT_GT(others.size(), 17);
    for (QWidget* control : std::as_const(others)) {
        EXPECT_GT(control->whatsThis().size(), 20)
            << control->metaObject()->className() << control->accessibleName().toStdString();
    }
}

TEST_F(FirstMinuteTest, TheListOfKeysHasEveryKeyOfTheMenusInGroups)
{
    open();
    QTest::keyClick(&view(), Qt::Key_F1, Qt::ControlModifier);
    auto* dialog = window_->findChild<KeysDialog*>();
    ASSERT_NE(dialog, nullptr);
    QStringList texts;
    for (const QLabel* label : dialog->findChildren<QLabel*>()) {
        texts.append(label->text());
    }
    int count = 0;
    for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
        for (const QAction* action : menu->actions()) {
            if (action->menu() == nullptr && !action->shortcut().isEmpty()) {
                ++count;
                const QString own = action->property(kKeyTextProperty).toString();
                const QString text =
                    own.isEmpty() ? action->text().remove(QLatin1Char('&')).remove(QChar(0x2026))
                                  : own;
                EXPECT_TRUE(texts.contains(text)) << text.toStdString();
                const QString key = action->shortcut().toString(QKeySequence::NativeText);
                EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [&](const QString& t) {
                    return t.startsWith(key) || key == QStringLiteral("-");
                })) << key.toStdString();
            }
        }
    }
    EXPECT_GT(count, 25);
    for (const Qt::Key key : {Qt::Key_Enter, Qt::Key_Backspace, Qt::Key_Delete, Qt::Key_Escape}) {
        const QString name = QKeySequence(key).toString(QKeySequence::NativeText);
        EXPECT_TRUE(texts.contains(name)) << name.toStdString();
    }
    QStringList titles;
    for (const QGroupBox* group : dialog->findChildren<QGroupBox*>()) {
        titles.append(group->title());
        EXPECT_FALSE(group->findChildren<QLabel*>().isEmpty());
    }
    for (const char* title : {"Mouse", "File", "View", "Tool", "Move", "Help"}) {
        EXPECT_TRUE(titles.contains(QString::fromLatin1(title))) << title;
    }
    dialog->close();
}

} // namespace
} // namespace marsview
