#include "tests/ui/map_window.h"
#include "tests/ui/widget_walk.h"
#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/address_dialog.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/dialogs/light_popup.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/dialogs/save_picture_dialog.h"
#include "ui/dialogs/stretch_dialog.h"
#include "ui/overlay/map_overlays.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/widgets/focus_frame.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAccessible>
#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QImage>
#include <QMenu>
#include <QMenuBar>
#include <QMultiMap>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace marsview {
namespace {

class AccessibilityTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        window_->controller().open({maps_.mars(), maps_.hill()});
        ASSERT_TRUE(waitUntilSettled(*window_));
    }

    static void expectNames(const QWidget& root)
    {
        const QList<QWidget*> controls = controlsOf(root);
        EXPECT_GT(controls.size(), 2);
        for (QWidget* control : controls) {
            QAccessibleInterface* access = QAccessible::queryAccessibleInterface(control);
            ASSERT_NE(access, nullptr) << describe(*control).toStdString();
            EXPECT_FALSE(access->text(QAccessible::Name).trimmed().isEmpty())
                << describe(root).toStdString() << ": " << describe(*control).toStdString();
        }
    }

    // Moves the focus with the Tab key and expects to reach every control.
    static void expectReached(const QWidget& root)
    {
        std::set<const QWidget*> met;
        for (int i = 0; i < 300; ++i) {
            QWidget* now = QApplication::focusWidget();
            ASSERT_NE(now, nullptr);
            if (!met.insert(now).second && i > 200) {
                break;
            }
            QTest::keyClick(now, Qt::Key_Tab);
        }
        for (const QWidget* control : controlsOf(root)) {
            if (control->isVisible() && control->isEnabled()) {
                EXPECT_TRUE(met.count(control) != 0)
                    << describe(root).toStdString() << ": " << describe(*control).toStdString();
            }
        }
    }
};

TEST_F(AccessibilityTest, EveryControlHasAName)
{
    expectNames(*window_);
    expectNames(PreferencesDialog({}, {}, window_.get()));
    expectNames(AddressDialog({}, window_.get()));
    expectNames(LightPopup(window_.get()));
    expectNames(SavePictureDialog({800, 600}, {}, window_.get()));
    expectNames(StretchDialog(window_.get()));
    expectNames(GoToDialog({window_->view()->map()}, {}, {}, {}, window_.get()));
}

TEST_F(AccessibilityTest, TheTabKeyReachesEveryControlOfTheWindow)
{
    expectReached(*window_);
    window_->georeferencingPanel()->edit();
    expectReached(*window_);
    window_->docks()->reveal(*window_->docks()->haptics());
    window_->hapticsPanel()->setFocus();
    expectReached(*window_);
}

TEST_F(AccessibilityTest, EveryStopOfTheTabKeyShowsThatItHasTheFocus)
{
    ASSERT_TRUE(focusMap());
    QTest::keyClick(&view(), Qt::Key_Tab);
    int stops = 0;
    for (QWidget* now = QApplication::focusWidget(); now != &view();
         now = QApplication::focusWidget()) {
        ASSERT_NE(now, nullptr);
        ASSERT_LT(++stops, 200) << "the map is never reached again";
        const QImage with_focus = now->grab().toImage();
        QTest::keyClick(now, Qt::Key_Tab);
        EXPECT_TRUE(with_focus != now->grab().toImage())
            << describe(*now).toStdString() << " of " << now->width() << " x " << now->height();
    }
    EXPECT_GT(stops, 10);
}

TEST_F(AccessibilityTest, TheTabKeyReachesEveryControlOfTheDialogs)
{
    PreferencesDialog preferences({}, {}, window_.get());
    preferences.show();
    QApplication::setActiveWindow(&preferences); // without a window manager
    expectReached(preferences);
    for (int page = 1; page < preferences.pages()->count(); ++page) {
        preferences.pages()->setCurrentIndex(page);
        expectReached(preferences);
    }
    preferences.close();
    SavePictureDialog picture({800, 600}, {}, window_.get());
    picture.show();
    QApplication::setActiveWindow(&picture);
    expectReached(picture);
    picture.close();
    AddressDialog address({}, window_.get());
    address.show();
    QApplication::setActiveWindow(&address);
    expectReached(address);
    address.close();
    GoToDialog go_to({window_->view()->map()}, {}, {}, {}, window_.get());
    go_to.show();
    QApplication::setActiveWindow(&go_to); // without a window manager
    expectReached(go_to);
}

TEST_F(AccessibilityTest, EveryButtonOfTheToolbarIsInAMenuToo)
{
    std::set<const QAction*> in_menus;
    for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
        for (const QAction* action : menu->actions()) {
            in_menus.insert(action);
        }
    }
    const WindowActions& actions = window_->actionSet();
    for (const QAction* action : {actions.open,
                                  actions.open_address,
                                  actions.save_picture,
                                  actions.home,
                                  actions.north,
                                  actions.light,
                                  actions.exaggerate_more,
                                  actions.exaggerate_less,
                                  actions.layer.remove,
                                  actions.layer.move_up,
                                  actions.layer.move_down,
                                  actions.shading->menuAction(),
                                  actions.ramps->menuAction(),
                                  actions.stretches->menuAction(),
                                  actions.cancel_loading,
                                  actions.stop_preparing,
                                  actions.layer.prepare,
                                  actions.emergency_stop,
                                  actions.full_screen,
                                  actions.tools->actions()[0],
                                  actions.tools->actions()[1],
                                  actions.tools->actions()[2],
                                  actions.record_touch,
                                  actions.replay_touch,
                                  actions.save_flight}) {
        EXPECT_TRUE(in_menus.count(action) != 0) << action->text().toStdString();
    }
}

TEST_F(AccessibilityTest, F6MovesTheFocusFromTheMapThroughAllOpenPanelsAndBack)
{
    WindowDocks& docks = *window_->docks();
    docks.haptics()->show(); // a tab behind georeferencing
    docks.measurements()->show();
    docks.georeferencing()->raise();
    QCoreApplication::processEvents();
    view().setFocus();
    const QList<QDockWidget*> panels{docks.datasets(), docks.georeferencing(), docks.haptics(),
                                     docks.measurements()};
    QList<QWidget*> controls;
    for (QDockWidget* panel : panels) {
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6);
        QCoreApplication::processEvents();
        controls.append(QApplication::focusWidget());
        ASSERT_NE(controls.last(), nullptr);
        EXPECT_TRUE(panel->isAncestorOf(controls.last()))
            << panel->windowTitle().toStdString() << ": "
            << describe(*controls.last()).toStdString();
        // In sight: not behind another tab or outside the window.
        const QWidget& control = *controls.last();
        const QWidget* seen = QApplication::widgetAt(control.mapToGlobal(control.rect().center()));
        EXPECT_TRUE(seen == &control || control.isAncestorOf(seen))
            << describe(control).toStdString();
        // And with a sign that it has the focus.
        const QImage with_focus = panel->widget()->grab().toImage();
        view().setFocus();
        EXPECT_NE(panel->widget()->grab().toImage(), with_focus) << describe(control).toStdString();
        controls.last()->setFocus(Qt::ShortcutFocusReason);
    }
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6);
    EXPECT_TRUE(view().hasFocus());
    for (auto control = controls.crbegin(); control != controls.crend(); ++control) {
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
        QCoreApplication::processEvents();
        EXPECT_EQ(QApplication::focusWidget(), *control);
    }
    docks.measurements()->hide(); // closed panels are passed over
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_TRUE(docks.haptics()->isAncestorOf(QApplication::focusWidget()));
}

TEST_F(AccessibilityTest, TheMapShowsThatItHasTheKeyboardFocus)
{
    const QWidget& frame = *window_->overlays()->focusFrame();
    ASSERT_TRUE(focusMap());
    EXPECT_FALSE(frame.isVisible()) << "not by a key";
    QTest::keyClick(&view(), Qt::Key_F6);
    EXPECT_FALSE(frame.isVisible());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
    ASSERT_TRUE(view().hasFocus());
    EXPECT_TRUE(frame.isVisible());
    EXPECT_EQ(frame.geometry(), view().rect());
    QTest::mouseClick(&view(), Qt::LeftButton, {}, middle().toPoint());
    EXPECT_FALSE(frame.isVisible());
    QTest::keyClick(&view(), Qt::Key_Tab);
    ASSERT_FALSE(view().hasFocus());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Backtab);
    ASSERT_TRUE(view().hasFocus());
    EXPECT_TRUE(frame.isVisible());
}

TEST_F(AccessibilityTest, NoTwoActionsShareAKeyWhereBothCouldBeMeant)
{
    // Keys of one widget only, such as a list, may have another meaning in another one.
    const auto could_both_be_meant = [](const QAction& a, const QAction& b) {
        const QList<QObject*> objects = a.associatedObjects();
        return a.shortcutContext() != Qt::WidgetShortcut ||
               b.shortcutContext() != Qt::WidgetShortcut ||
               std::any_of(objects.begin(), objects.end(), [&b](QObject* object) {
                   return qobject_cast<QMenu*>(object) == nullptr &&
                          b.associatedObjects().contains(object);
               });
    };
    QMultiMap<QString, const QAction*> owners;
    for (const QMenu* menu : window_->menuBar()->findChildren<QMenu*>()) {
        for (const QAction* action : menu->actions()) {
            for (const QKeySequence& key : action->shortcuts()) {
                const QString text = key.toString();
                for (const QAction* other : owners.values(text)) {
                    EXPECT_FALSE(could_both_be_meant(*action, *other))
                        << text.toStdString() << ": " << other->text().toStdString() << " and "
                        << action->text().toStdString();
                }
                owners.insert(text, action);
            }
        }
    }
    EXPECT_GT(owners.size(), 20);
}

TEST_F(AccessibilityTest, NoTwoEntriesOfAMenuShareALetter)
{
    EXPECT_EQ(sharedLetters(*window_->menuBar()).join(QStringLiteral(", ")).toStdString(), "");
}

} // namespace
} // namespace marsview
