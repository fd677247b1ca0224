#include "tests/ui/timeout.h"
#include "ui/window/window_place.h"

#include <QGuiApplication>
#include <QScreen>
#include <QTest>
#include <QWidget>

#include <gtest/gtest.h>

namespace marsview {
namespace {

TEST(WindowPlace, MovesAndShrinksIntoTheAvailableArea)
{
    const QRect screen(100, 30, 853, 500);
    EXPECT_EQ(fittedTo({110, 40, 400, 300}, screen), QRect(110, 40, 400, 300));
    EXPECT_EQ(fittedTo({0, 0, 1280, 800}, screen), screen);
    EXPECT_EQ(fittedTo({900, 40, 400, 300}, screen), QRect(553, 40, 400, 300));
    EXPECT_EQ(fittedTo({0, -50, 400, 300}, screen), QRect(100, 30, 400, 300));
    EXPECT_EQ(fittedTo({110, 40, 2000, 300}, screen), QRect(100, 40, 853, 300));
}

TEST(WindowPlace, KeepsAShownWindowOnItsScreen)
{
    const QRect available = QGuiApplication::primaryScreen()->availableGeometry();
    QWidget window;
    new WindowPlace(window);
    window.setGeometry(QRect(available.topLeft() + QPoint(300, 300), available.size() * 2));
    window.show();
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return available.contains(window.frameGeometry()); }, kTimeout));
}

TEST(WindowPlace, ShrinksAWindowBeforeItIsShown)
{
    const QRect available = QGuiApplication::primaryScreen()->availableGeometry();
    QWidget window;
    auto* place = new WindowPlace(window);
    window.resize(available.size() * 2);
    place->fit();
    EXPECT_LE(window.width(), available.width());
    EXPECT_LT(window.height(), available.height()); // space for the title bar
}

} // namespace
} // namespace marsview
