// The contour interval and the export of contours, in the window.
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/contour_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QFileInfo>
#include <QInputDialog>

#include <gtest/gtest.h>

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
    auto* dialog = window_->findChild<QInputDialog*>();
    ASSERT_NE(dialog, nullptr);
    dialog->setDoubleValue(40.0);
    dialog->accept();
    EXPECT_TRUE(window_->session().look.has_contours);
    EXPECT_EQ(window_->session().look.contour_interval_m, 40.0);
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().look.contour_interval_m, 0.0);
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
