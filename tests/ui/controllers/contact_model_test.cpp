// Choosing the contact model in the window.

#include "core/contact/contact_model.h"
#include "tests/ui/test_map.h"
#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/window/window_actions.h"

#include <QActionGroup>
#include <QApplication>
#include <QComboBox>
#include <QMenu>
#include <QMenuBar>
#include <QMouseEvent>
#include <QSettings>
#include <QStatusBar>
#include <QTest>

#include <gtest/gtest.h>

#include <memory>
#include <set>

namespace marsview {
namespace {

QString settingsKey()
{
    return QStringLiteral("preferences/contactModel");
}

QAction* entryOf(const MainWindow& window, ContactModelKind model)
{
    for (QAction* action : window.actionSet().contact_model_group->actions()) {
        if (action->data().toInt() == static_cast<int>(model)) {
            return action;
        }
    }
    ADD_FAILURE() << "no entry for " << contactModelName(model);
    return nullptr;
}

QString plain(const QString& text)
{
    return QString(text).remove(QLatin1Char('&'));
}

// The checked entries of the menu.
QStringList checkedEntries(const MainWindow& window)
{
    QStringList checked;
    for (const QAction* action : window.actionSet().contact_models->actions()) {
        if (action->isChecked()) {
            checked.append(plain(action->text()));
        }
    }
    return checked;
}

class ContactModelTest : public testing::Test {
protected:
    void SetUp() override { QSettings().clear(); }
    void TearDown() override { QSettings().clear(); }

    static std::unique_ptr<MainWindow> rememberingWindow()
    {
        auto window = std::make_unique<MainWindow>(
            WindowOptions{.geometry = WindowOptions::Geometry::Remembered,
                          .failures = WindowOptions::Failures::BySignalOnly});
        window->show();
        QApplication::setActiveWindow(window.get()); // without a window manager
        EXPECT_TRUE(QTest::qWaitForWindowExposed(window.get()));
        return window;
    }

    TestMaps maps_;
};

TEST_F(ContactModelTest, HasItsMenuBetweenMapAndHelp)
{
    const MainWindow window(testWindowOptions());
    QStringList menus;
    for (const QAction* action : window.menuBar()->actions()) {
        menus.append(plain(action->text()));
    }
    const auto haptics = menus.indexOf(QStringLiteral("Haptics"));
    EXPECT_GT(haptics, menus.indexOf(QStringLiteral("Map")));
    EXPECT_EQ(haptics, menus.indexOf(QStringLiteral("Help")) - 1);
    const QMenu* menu = window.menuBar()->actions().at(haptics)->menu();
    EXPECT_TRUE(menu->actions().contains(window.actionSet().contact_models->menuAction()));
}

TEST_F(ContactModelTest, OffersEveryModelOnceWithADescription)
{
    const MainWindow window(testWindowOptions());
    const QList<QAction*> entries = window.actionSet().contact_models->actions();
    EXPECT_EQ(entries, window.actionSet().contact_model_group->actions());
    std::set<int> models;
    std::set<QString> tips;
    for (const QAction* action : entries) {
        EXPECT_TRUE(action->isCheckable());
        EXPECT_TRUE(action->text().contains(QLatin1Char('&'))) << "no mnemonic for it";
        EXPECT_GT(action->statusTip().size(), 40) << action->text().toStdString();
        models.insert(action->data().toInt());
        tips.insert(action->statusTip());
    }
    EXPECT_EQ(entries.size(), static_cast<qsizetype>(kContactModelKinds.size()));
    EXPECT_EQ(models.size(), kContactModelKinds.size());
    EXPECT_EQ(tips.size(), kContactModelKinds.size());
    for (const ContactModelKind model : kContactModelKinds) {
        EXPECT_NE(entryOf(window, model), nullptr);
    }
    EXPECT_EQ(window.view()->contactModel(), kContactModelDefault);
    EXPECT_EQ(checkedEntries(window),
              QStringList{plain(entryOf(window, kContactModelDefault)->text())});
}

TEST_F(ContactModelTest, ChangesWhenAnEntryIsChosenAndIsTheOnlyOneChecked)
{
    MainWindow window(testWindowOptions());
    for (const ContactModelKind model : kContactModelKinds) {
        QAction* entry = entryOf(window, model);
        entry->trigger();
        EXPECT_EQ(window.view()->contactModel(), model);
        EXPECT_EQ(window.preferences().contact_model, model);
        EXPECT_EQ(checkedEntries(window), QStringList{plain(entry->text())});
        entry->trigger(); // chosen again, it stays checked
        EXPECT_EQ(window.view()->contactModel(), model);
        EXPECT_EQ(checkedEntries(window), QStringList{plain(entry->text())});
    }
}

TEST_F(ContactModelTest, ChangesInTheMiddleOfATouch)
{
    MainWindow window(testWindowOptions());
    window.show();
    ASSERT_TRUE(openAndWait(window, maps_.hill()));
    TerrainView& view = *window.view();
    view.setTool(Tool::Touch);
    const QPointF at = QRectF(view.rect()).center();
    QMouseEvent press(QEvent::MouseButtonPress, at, view.mapToGlobal(at), Qt::LeftButton,
                      Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&view, &press);
    ASSERT_TRUE(view.stylus());
    ASSERT_TRUE(view.stylus()->is_in_contact);
    for (const ContactModelKind model : kContactModelKinds) {
        const ScenePoint goal = view.stylus()->goal;
        entryOf(window, model)->trigger();
        EXPECT_EQ(view.contactModel(), model);
        ASSERT_TRUE(view.stylus());
        EXPECT_EQ(view.stylus()->mode, StylusMode::Press);
        EXPECT_TRUE(view.stylus()->is_in_contact) << contactModelName(model);
        EXPECT_EQ(view.stylus()->goal, goal);
    }
}

TEST_F(ContactModelTest, IsReachedByTheKeyboardAndExplainedInTheStatusBar)
{
    const auto window = rememberingWindow();
    const auto popup = [] { return QApplication::activePopupWidget(); };
    QTest::keyClick(window.get(), Qt::Key_P, Qt::AltModifier);
    ASSERT_NE(popup(), nullptr);
    QTest::keyClick(popup(), Qt::Key_C);
    ASSERT_EQ(popup(), window->actionSet().contact_models);
    window->actionSet().contact_models->setActiveAction(
        entryOf(*window, ContactModelKind::SurfaceWalk));
    EXPECT_EQ(window->statusBar()->currentMessage(),
              entryOf(*window, ContactModelKind::SurfaceWalk)->statusTip());
    QTest::keyClick(popup(), Qt::Key_S);
    EXPECT_EQ(popup(), nullptr);
    EXPECT_EQ(window->view()->contactModel(), ContactModelKind::SurfaceWalk);
}

TEST_F(ContactModelTest, IsRememberedForTheNextWindow)
{
    for (const ContactModelKind model : kContactModelKinds) {
        {
            const auto window = rememberingWindow();
            entryOf(*window, model)->trigger();
            window->close();
        }
        EXPECT_EQ(QSettings().value(settingsKey()).toString().toStdString(),
                  contactModelName(model));
        const auto window = rememberingWindow();
        EXPECT_EQ(window->view()->contactModel(), model);
        EXPECT_EQ(checkedEntries(*window), QStringList{plain(entryOf(*window, model)->text())});
    }
}

TEST_F(ContactModelTest, IsTheDefaultIfTheRememberedOneIsUnknown)
{
    for (const char* name : {"quantum-foam", "", "Surface-Walk", "2"}) {
        QSettings().setValue(settingsKey(), QString::fromLatin1(name));
        const auto window = rememberingWindow();
        EXPECT_EQ(window->view()->contactModel(), kContactModelDefault) << name;
        EXPECT_EQ(checkedEntries(*window).size(), 1);
    }
}

TEST_F(ContactModelTest, IsKeptWhenPreferencesChange)
{
    MainWindow window(testWindowOptions());
    window.show();
    entryOf(window, ContactModelKind::ProxyGraph)->trigger();
    window.actionSet().preferences->trigger();
    auto* dialog = window.findChild<PreferencesDialog*>();
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QComboBox*>(QStringLiteral("elevationUnit"))->setCurrentIndex(1);
    EXPECT_EQ(window.preferences().height_unit, HeightUnit::Feet);
    EXPECT_EQ(window.preferences().contact_model, ContactModelKind::ProxyGraph);
    EXPECT_EQ(window.view()->contactModel(), ContactModelKind::ProxyGraph);
}

} // namespace
} // namespace marsview
