// Opening files: the maps that come with the program, and files of which some cannot be opened.

#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/file_opening.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/recent_files.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QLabel>
#include <QMenu>
#include <QUndoStack>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class FileOpeningTest : public MapWindowTest {
protected:
    const QMenu& bundled() { return *window_->actionSet().bundled; }
};

TEST_F(FileOpeningTest, BundledMapsOpenFromTheirMenuAndAreNoRecentFiles)
{
    WindowOptions options = testWindowOptions();
    options.bundled_maps = test::bundledSamples();
    makeWindow(kSmall, options);
    ASSERT_TRUE(bundled().menuAction()->isVisible());
    ASSERT_EQ(bundled().actions().size(), 2);
    for (QAction* action : bundled().actions()) {
        const std::size_t before = window_->session().layers.size();
        action->trigger();
        ASSERT_TRUE(waitFor([&] { return window_->session().layers.size() == before + 1; }));
    }
    // The last one opened lies on top.
    EXPECT_EQ(window_->session().layers.back().name, "mars_mola_4ppd.tif");
    EXPECT_EQ(window_->session().layers.front().name, "mount_st_helens_30m.tif");
    EXPECT_TRUE(window_->commands().files.recentFiles()->files().isEmpty());
    // Again: the layer that there is.
    bundled().actions().front()->trigger();
    EXPECT_EQ(window_->session().layers.size(), 2U);
    EXPECT_EQ(activeLayer(window_->session())->name, "mars_mola_4ppd.tif");
}

TEST_F(FileOpeningTest, AMissingProjectDoesNotKeepTheMapsAfterItFromOpening)
{
    WindowOptions options = testWindowOptions();
    options.failures = WindowOptions::Failures::AsNotices;
    makeWindow(kSmall, options);
    window_->openAll({maps_.path(QStringLiteral("missing.mvproj")), maps_.hill()});
    ASSERT_TRUE(waitFor([this] { return !window_->session().layers.empty(); }));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(window_->session().layers.size(), 1U);
    const auto* notice = window_->findChild<QLabel*>(QStringLiteral("noticeText"));
    EXPECT_TRUE(notice->isVisible());
    EXPECT_TRUE(notice->text().contains(QStringLiteral("missing.mvproj")))
        << notice->text().toStdString();
}

// 2026-11: the first Ctrl+Z after `marsview A B` removed B.
TEST_F(FileOpeningTest, FilesOfTheStartAreNotUndoneAndLaterOnesAre)
{
    makeWindow(kSmall);
    window_->openAtStart({maps_.hill(), maps_.moon()});
    ASSERT_TRUE(waitFor([this] { return window_->session().layers.size() == 2; }));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_FALSE(window_->undoStack().canUndo());
    window_->open(QString::fromStdString(test::bundledMars()));
    ASSERT_TRUE(waitFor([this] { return window_->session().layers.size() == 3; }));
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().layers.size(), 2U);
    EXPECT_FALSE(window_->undoStack().canUndo());
}

TEST_F(FileOpeningTest, AProgramWithoutItsMapsHasNoMenuOfThem)
{
    makeWindow(kSmall);
    EXPECT_FALSE(bundled().menuAction()->isVisible());
}

} // namespace
} // namespace marsview
