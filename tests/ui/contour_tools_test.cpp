// The contour interval and the export of contours, in the window.
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/contour_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/dialogs/interval_dialog.h"
#include "ui/text/number_text.h"
#include "ui/widgets/elevation_box.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

#include <tuple>

namespace marsview {
namespace {

class ContourToolsTest : public MapWindowTest {
protected:
    void openMountain()
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMountain())));
    }
};

TEST_F(ContourToolsTest, ATypedIntervalShowsContoursAndCanBeUndone)
{
    openMountain();
    window_->actionSet().contour_interval->trigger();
    auto* dialog = window_->findChild<IntervalDialog*>();
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(dialog->box()->text(), QStringLiteral("Automatic"));
    dialog->box()->setValue(40.0);
    EXPECT_EQ(dialog->box()->text(), QStringLiteral("40 m"));
    dialog->accept();
    EXPECT_TRUE(window_->session().look.has_contours);
    EXPECT_EQ(window_->session().look.contour_interval_m, 40.0);
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().look.contour_interval_m, 0.0);
}

TEST_F(ContourToolsTest, IntervalsHaveTheDigitsThatTheyNeed)
{
    IntervalDialog dialog({}, IntervalDialog::Automatic::Allowed, 2000.0);
    dialog.show();
    EXPECT_EQ(dialog.box()->text(), numberText(2000.0, 0) + QStringLiteral(" m"));
    for (const auto& [typed, value, shown] : {std::tuple{"2.50", 2.5, "2.5 m"},
                                              {"0.125", 0.125, "0.125 m"},
                                              {"0", 0.0, "Automatic"},
                                              {"100", 100.0, "100 m"}}) {
        dialog.box()->setFocus();
        dialog.box()->selectAll();
        QTest::keyClicks(dialog.box(), QString::fromLatin1(typed));
        dialog.box()->interpretText();
        EXPECT_EQ(dialog.box()->value(), value) << typed;
        EXPECT_EQ(dialog.box()->text(), QString::fromLatin1(shown)) << typed;
    }
}

TEST_F(ContourToolsTest, AnImpossibleIntervalIsRefusedBesideItsField)
{
    IntervalDialog dialog({}, IntervalDialog::Automatic::Allowed, 20.0);
    dialog.show();
    const auto type = [&dialog](const char* text) {
        dialog.box()->setFocus();
        dialog.box()->selectAll();
        QTest::keyClicks(dialog.box(), QString::fromLatin1(text));
    };
    const auto* ok = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
    const auto* note = dialog.findChild<QLabel*>(QStringLiteral("intervalNote"));
    ASSERT_NE(note, nullptr);
    type("-3");
    EXPECT_FALSE(ok->isEnabled());
    EXPECT_TRUE(note->isVisible());
    EXPECT_TRUE(note->text().startsWith(QStringLiteral("Enter an interval")))
        << note->text().toStdString();
    QTest::keyClick(dialog.box(), Qt::Key_Enter);
    EXPECT_EQ(dialog.box()->value(), 20.0) << "as before";
    EXPECT_TRUE(ok->isEnabled());
    EXPECT_FALSE(note->isVisible());
    type("30");
    EXPECT_TRUE(ok->isEnabled());
    EXPECT_FALSE(note->isVisible());
    dialog.box()->interpretText();
    EXPECT_EQ(dialog.box()->value(), 30.0);
}

TEST_F(ContourToolsTest, ContoursOfTheActiveLayerAreExported)
{
    openMountain();
    ContourTools& tools = window_->commands().contours;
    const QString file = maps_.path(QStringLiteral("contours.gpkg"));
    QString exported;
    QObject::connect(&tools, &ContourTools::exported, window_.get(),
                     [&exported](const QString& path) { exported = path; });
    tools.exportTo(file, 50.0);
    EXPECT_TRUE(waitFor([&exported] { return !exported.isEmpty(); }));
    EXPECT_EQ(exported, file);
    EXPECT_TRUE(QFileInfo::exists(file));
    EXPECT_FALSE(tools.isExporting());
    QString problem;
    QObject::connect(window_.get(), &MainWindow::openFailed,
                     [&problem](const QString& text) { problem = text; });
    tools.exportTo(maps_.path(QStringLiteral("none/contours.gpkg")), 50.0);
    EXPECT_TRUE(
        waitFor([&problem] { return problem.contains(QStringLiteral("cannot be written")); }));
}

} // namespace
} // namespace marsview
