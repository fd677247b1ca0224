// Numbers with their units in a window that runs from right to left: each in its own order.

#include "tests/support/run_program.h"
#include "tests/ui/hand_window.h"
#include "tests/ui/widget_walk.h"
#include "ui/commands/window_commands.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/dialogs/save_picture_dialog.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/views/fly_through_dialog.h"
#include "ui/views/fly_through_tools.h"
#include "ui/views/saved_views.h"
#include "ui/widgets/elided_label.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QApplication>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QRegularExpression>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

// The text without what is isolated as running from left to right.
QString outsideIsolates(const QString& text)
{
    QString rest;
    int depth = 0;
    for (const QChar c : text) {
        if (c == QChar(0x2066)) {
            ++depth;
        } else if (c == QChar(0x2069)) {
            depth = std::max(0, depth - 1);
        } else if (depth == 0) {
            rest += c;
        }
    }
    return rest;
}

class RightToLeftTest : public HandWindowTest {
protected:
    void SetUp() override { QGuiApplication::setLayoutDirection(Qt::RightToLeft); }
    void TearDown() override
    {
        window_.reset();
        QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    }
};

TEST_F(RightToLeftTest, NumbersStayBeforeTheirUnits)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->actionSet().haptic_devices->trigger();
    ASSERT_TRUE(connectTo(QStringLiteral("sim:")));
    auto* force = window_->hapticsPanel()->findChild<QProgressBar*>(QStringLiteral("force"));
    ASSERT_TRUE(waitFor([&] { return force->value() > 0; }));
    ASSERT_TRUE(waitFor([&] { return !window_->readout()->heightLabel().isEmpty(); }));
    // A number of its own direction, and a unit outside of it, would change places.
    static const QRegularExpression kUnitAlone(
        QStringLiteral("^\\s*(N|N/m|m|km|ft|px|%|µs|ms|s|°)(\\s|$)"));
    QList<FoundText> texts = textsOf(*window_);
    texts.append({QStringLiteral("force bar"), force->format()});
    for (const FoundText& found : texts) {
        EXPECT_FALSE(kUnitAlone.match(outsideIsolates(found.text)).hasMatch() &&
                     found.text.contains(QChar(0x2066)))
            << found.place.toStdString() << ": " << found.text.toStdString();
    }
    EXPECT_EQ(outsideIsolates(force->format()), QString());
}

TEST_F(RightToLeftTest, CaptionsOfFactsAreAtTheSideOfTheirValues)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    int count = 0;
    for (const QLabel* label : window_->georeferencingPanel()->findChildren<QLabel*>()) {
        if (qobject_cast<const ElidedLabel*>(label) == nullptr && label->isVisible() &&
            !label->text().isEmpty()) {
            ++count;
            // Absolute: Qt would go by the letters, which are English here.
            EXPECT_TRUE(label->alignment().testFlags(Qt::AlignRight | Qt::AlignAbsolute))
                << label->text().toStdString();
        }
    }
    EXPECT_GT(count, 20);
}

TEST_F(RightToLeftTest, SizesInTheMenuOfANoticeKeepTheirOrder)
{
    makeWindow(kWithPanels);
    TestMaps::Shape shape;
    shape.columns = 60;
    for (const char* name : {"a.asc", "b.asc", "c.asc"}) {
        maps_.write(QString::fromLatin1(name), shape,
                    [](int column, int row) { return column + row; });
    }
    const QString archive = maps_.path(QStringLiteral("maps.zip"));
    test::runTool({"python3", "-c",
                   "import sys, zipfile\n"
                   "with zipfile.ZipFile(sys.argv[1], 'w') as z:\n"
                   "    for name in ('a.asc', 'b.asc', 'c.asc'):\n"
                   "        z.write(sys.argv[2] + name, name)",
                   archive.toStdString(), maps_.path(QString()).toStdString() + "/"});
    ASSERT_TRUE(openAndWait(*window_, archive));
    const auto* bar = window_->findChild<NoticeBar*>();
    const auto* button = bar->findChild<QToolButton*>(QStringLiteral("noticeAction"));
    const auto is_of_archive = [bar, button] {
        const auto* text = bar->findChild<QLabel*>(QStringLiteral("noticeText"));
        return text->text().contains(QStringLiteral("maps.zip")) && button->menu() != nullptr;
    };
    for (int i = 0; i < 5 && !is_of_archive(); ++i) {
        bar->findChild<QToolButton*>(QStringLiteral("noticeNext"))->click();
    }
    ASSERT_TRUE(is_of_archive());
    ASSERT_EQ(button->menu()->actions().size(), 2);
    for (const QAction* action : button->menu()->actions()) {
        EXPECT_TRUE(action->text().contains(QStringLiteral("60 × 40")))
            << action->text().toStdString();
        EXPECT_FALSE(outsideIsolates(action->text()).contains(QStringLiteral("×")))
            << action->text().toStdString();
    }
}

TEST_F(RightToLeftTest, NumbersInDialogsAreIsolated)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    const PreferencesDialog preferences({}, {}, window_.get());
    const SavePictureDialog picture({800, 600}, {}, window_.get());
    static const QRegularExpression kNumberAndUnit(QStringLiteral("\\d[\\d.,]* ?(fps|MB|GB|px)"));
    int count = 0;
    window_->commands().views.actions().fly_through->trigger();
    const QWidget* flight = window_->commands().fly_through.dialog();
    ASSERT_NE(flight, nullptr);
    for (const QWidget* dialog :
         std::initializer_list<const QWidget*>{&preferences, &picture, flight}) {
        for (const FoundText& found : textsOf(*dialog)) {
            count += kNumberAndUnit.match(found.text).hasMatch() ? 1 : 0;
            EXPECT_FALSE(kNumberAndUnit.match(outsideIsolates(found.text)).hasMatch())
                << found.place.toStdString() << ": " << found.text.toStdString();
        }
    }
    EXPECT_GE(count, 7);
}

} // namespace
} // namespace marsview
