// The icons: present, readable in both themes, crisp on every screen.

#include "tests/ui/color_contrast.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/dialogs/about_dialog.h"
#include "ui/widgets/icons.h"
#include "ui/window/theme.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QMenu>
#include <QStyle>
#include <QTest>
#include <QToolBar>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

// The color of a picture's most opaque pixel.
QColor inkOf(const QPixmap& pixmap)
{
    const QImage image = pixmap.toImage().convertToFormat(QImage::Format_ARGB32);
    QColor ink(0, 0, 0, 0);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor color = image.pixelColor(x, y);
            if (color.alpha() > ink.alpha()) {
                ink = color;
            }
        }
    }
    return ink;
}

class IconsTest : public testing::Test {
protected:
    void TearDown() override { applyTheme(Theme::System); }

    static QList<QIcon> glyphsOfTheStyle()
    {
        QList<QIcon> icons;
        for (const auto which :
             {QStyle::SP_TitleBarCloseButton, QStyle::SP_TitleBarNormalButton,
              QStyle::SP_LineEditClearButton, QStyle::SP_ToolBarHorizontalExtensionButton}) {
            icons.append(QApplication::style()->standardIcon(which));
        }
        return icons;
    }
};

TEST_F(IconsTest, ContrastWithWhatTheyAreDrawnOnInBothThemes)
{
    const QIcon pan = lineIcon(QStringLiteral("pan")); // created once, like those of actions
    for (const Theme theme : {Theme::Light, Theme::Dark, Theme::Light}) {
        applyTheme(theme);
        const QColor ground = QApplication::palette().color(QPalette::Window);
        QList<QIcon> icons = glyphsOfTheStyle();
        icons.append(pan);
        for (const QIcon& icon : icons) {
            const QColor normal = inkOf(icon.pixmap(20, QIcon::Normal));
            ASSERT_GT(normal.alpha(), 200);
            EXPECT_GE(contrast(normal, ground), 7.0);
            const QColor disabled = inkOf(icon.pixmap(20, QIcon::Disabled));
            EXPECT_GE(contrast(disabled, ground), 2.5);
            EXPECT_GE(contrast(disabled, normal), 1.8) << "differs from enabled icons";
        }
    }
}

TEST_F(IconsTest, AreDrawnInThePixelsOfTheScreen)
{
    const QIcon icon = lineIcon(QStringLiteral("home"));
    for (const qreal ratio : {1.0, 1.5, 2.0}) {
        const QPixmap pixmap = icon.pixmap(QSize(20, 20), ratio);
        EXPECT_EQ(pixmap.width(), qRound(20 * ratio));
        EXPECT_EQ(pixmap.devicePixelRatio(), ratio);
        // Not a scaled-up small picture: neighboring pixels differ at the finest step.
        const QImage image = pixmap.toImage();
        int edges = 0;
        for (int x = 1; x < image.width(); ++x) {
            edges += std::abs(qAlpha(image.pixel(x, image.height() / 2)) -
                              qAlpha(image.pixel(x - 1, image.height() / 2))) > 120
                         ? 1
                         : 0;
        }
        EXPECT_GE(edges, 4) << ratio;
    }
}

TEST_F(IconsTest, EveryButtonOfTheToolbarAndEveryPanelHasOne)
{
    MainWindow window(testWindowOptions());
    auto* bar = window.findChild<QToolBar*>(QStringLiteral("mainToolBar"));
    int count = 0;
    for (const QToolButton* button :
         bar->findChildren<QToolButton*>(QString(), Qt::FindDirectChildrenOnly)) {
        EXPECT_FALSE(button->icon().isNull()) << button->text().toStdString();
        ++count;
    }
    EXPECT_GE(count, 10);
    for (const QDockWidget* dock : {window.docks()->datasets(), window.docks()->georeferencing(),
                                    window.docks()->haptics()}) {
        EXPECT_NE(dock->windowIcon().cacheKey(), window.windowIcon().cacheKey());
    }
    const WindowActions& actions = window.actionSet();
    for (const QAction* action : {actions.open, actions.save_picture, actions.preferences,
                                  actions.home, actions.layer.remove, actions.keys}) {
        EXPECT_FALSE(action->icon().isNull()) << action->text().toStdString();
    }
    EXPECT_FALSE(window.windowIcon().isNull());
}

TEST_F(IconsTest, TheAboutBoxShowsTheProgramsIcon)
{
    const AboutDialog about(QString(), nullptr);
    const auto* label = about.findChild<QLabel*>(QStringLiteral("programIcon"));
    ASSERT_NE(label, nullptr);
    const QImage picture = label->pixmap(Qt::ReturnByValue).toImage();
    ASSERT_FALSE(picture.isNull());
    // The red cone of the cursor is in it.
    bool has_red = false;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const QColor color = picture.pixelColor(x, y);
            has_red = has_red || (color.red() > 200 && color.green() < 60 && color.blue() < 70);
        }
    }
    EXPECT_TRUE(has_red);
}

// No button moves into the overflow menu of the toolbar.
TEST_F(IconsTest, TheToolbarShowsAllItsButtonsInAWindowOf1280AndOf853Points)
{
    MainWindow window(testWindowOptions());
    window.show();
    auto* bar = window.findChild<QToolBar*>(QStringLiteral("mainToolBar"));
    auto* more = bar->findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
    for (const int width : {1280, 853}) { // 1280 pixels at 100 and at 150 %
        window.resize(width, 700);
        ASSERT_TRUE(QTest::qWaitFor([&] { return bar->width() == width; }, kTimeout)) << width;
        QCoreApplication::processEvents();
        EXPECT_FALSE(more->isVisible()) << width;
        for (const QToolButton* button :
             bar->findChildren<QToolButton*>(QString(), Qt::FindDirectChildrenOnly)) {
            EXPECT_TRUE(button == more || button->isVisible()) << button->text().toStdString();
        }
    }
    window.resize(1600, 700);
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->width() == 1600; }, kTimeout));
    const auto* open = qobject_cast<QToolButton*>(bar->widgetForAction(window.actionSet().open));
    EXPECT_EQ(open->toolButtonStyle(), Qt::ToolButtonTextBesideIcon) << "space for every text";
}

} // namespace
} // namespace marsview
