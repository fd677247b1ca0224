// Maps that the program prepares itself, with faulty folders and files.

#include "core/levels/level_file.h"
#include "core/prepare/prepare_map.h"
#include "tests/support/make_raster.h"
#include "tests/support/scoped_variable.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/load_status.h"

#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr int kColumns = 1400; // together with the rows too many to view without a copy
constexpr int kRows = 1100;

float heightOf(int column, int row)
{
    return static_cast<float>(500.0 + 200.0 * std::sin(column / 40.0) * std::cos(row / 50.0) +
                              column % 7);
}

class PreparationTest : public testing::Test {
protected:
    void SetUp() override
    {
        std::vector<float> samples;
        for (int row = 0; row < kRows; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                samples.push_back(heightOf(column, row));
            }
        }
        file_ = QString::fromStdString(
            test::writeRaster(root_, "large.tif", "GTiff", test::recipeFor(kColumns, samples)));
        folder_ = root_.path() / "prepared";
    }

    // The program's own opener, with almost no memory for maps.
    WindowOptions options() const
    {
        WindowOptions options = testWindowOptions();
        options.opener.resources.held_bytes_max = 1000;
        options.opener.resources.folder = folder_;
        return options;
    }
    static std::unique_ptr<MainWindow> makeWindow(const WindowOptions& options)
    {
        auto window = std::make_unique<MainWindow>(options);
        window->resize(700, 500);
        window->show();
        EXPECT_TRUE(waitUntilSettled(*window));
        return window;
    }
    static const Layer& layerOf(MainWindow& window) { return window.session().layers.at(0); }
    static PreparationState stateOf(MainWindow& window)
    {
        return window.session().layers.empty()
                   ? PreparationState::None
                   : window.controller().preparationOf(layerOf(window).id).state;
    }
    static QString noticeOf(MainWindow& window)
    {
        auto* bar = window.findChild<NoticeBar*>();
        return bar->isVisible() ? bar->findChild<QLabel*>(QStringLiteral("noticeText"))->text()
                                : QString();
    }
    static void tryAgain(MainWindow& window)
    {
        window.findChild<NoticeBar*>()
            ->findChild<QToolButton*>(QStringLiteral("noticeAction"))
            ->click();
    }
    // Compares samples with the file's.
    static void expectRightHeights(MainWindow& window)
    {
        const Heightfield& heightfield = layerOf(window).map->heightfield();
        ASSERT_TRUE(heightfield.isTiled());
        for (const auto& [column, row] : {std::pair{0, 0}, {300, 200}, {1399, 1099}, {256, 511}}) {
            const GridPoint grid{static_cast<double>(column), static_cast<double>(row)};
            ASSERT_TRUE(QTest::qWaitFor(
                [&] {
                    static_cast<void>(heightfield.height(grid)); // requests the tile
                    return heightfield.isExact(grid);
                },
                kTimeout));
            EXPECT_NEAR(heightfield.heightNow(grid), static_cast<double>(heightOf(column, row)),
                        1e-9);
        }
    }
    // The preview can be viewed and touched, and no job is running.
    static void expectUsablePreview(MainWindow& window)
    {
        ASSERT_EQ(window.session().layers.size(), 1U);
        EXPECT_TRUE(layerOf(window).map->isPreview());
        EXPECT_FALSE(window.controller().isBusy());
        EXPECT_FALSE(window.controller().isPreparing());
        EXPECT_FALSE(window.findChild<LoadStatus*>()->isVisible());
        TerrainView& view = *window.view();
        ASSERT_TRUE(QTest::qWaitFor([&] { return view.isPictureComplete(); }, kTimeout));
        const QPoint middle = view.rect().center();
        view.setTool(Tool::Touch);
        QTest::mouseMove(&view, middle);
        QTest::mousePress(&view, Qt::LeftButton, Qt::NoModifier, middle);
        ASSERT_TRUE(view.stylus());
        EXPECT_TRUE(view.stylus()->is_in_contact);
        QTest::mouseRelease(&view, Qt::LeftButton, Qt::NoModifier, middle);
    }
    std::string preparedFile() const
    {
        const auto path = preparedPathFor(*openRaster({.path = file_.toStdString()}), folder_);
        EXPECT_TRUE(path);
        return *path;
    }

    test::TempFolder root_;
    std::filesystem::path folder_;
    QString file_;
};

TEST_F(PreparationTest, ShowsTheMapItselfInTheEndAndAtOnceTheNextTime)
{
    const auto window = makeWindow(options());
    ASSERT_TRUE(openAndWait(*window, file_));
    expectRightHeights(*window);
    EXPECT_TRUE(std::filesystem::exists(preparedFile())) << preparedFile();
    WindowOptions again = options();
    again.opener.prepare = [](const RasterSpec&, const MapResources&, JobMonitor&) -> Status {
        return Error{ErrorCode::Unreadable, "prepared twice"};
    };
    // although it would fit into memory
    again.opener.resources.held_bytes_max = std::size_t{1} << 30;
    const auto second = makeWindow(again);
    ASSERT_TRUE(openAndWait(*second, file_));
    expectRightHeights(*second);
}

TEST_F(PreparationTest, TellsItsProgressWithoutGoingBack)
{
    std::vector<double> reported;
    WindowOptions some = options();
    const auto window = makeWindow(some);
    QObject::connect(
        &window->controller(), &SessionController::preparingProgressed, window.get(),
        [&](const PrepareProgress& progress) { reported.push_back(progress.fraction); });
    ASSERT_TRUE(openAndWait(*window, file_));
    ASSERT_FALSE(reported.empty());
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
}

TEST_F(PreparationTest, SaysWhatIsWrongWithTheFolderAndGoesOnInAnother)
{
    const test::ScopedVariable none("MARSVIEW_CACHE_DIR", nullptr); // it overrides the preferences
    // No folder can be created where a file is, even by users who may write everywhere.
    const std::string in_the_way = root_.write("file", "no folder");
    WindowOptions blocked = options();
    blocked.opener.resources.folder = std::filesystem::path(in_the_way) / "prepared";
    const auto window = makeWindow(blocked);
    const QSignalSpy dialogs(window.get(), &MainWindow::openFailed);
    window->open(file_);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return stateOf(*window) == PreparationState::Failed; }, kTimeout));
    expectUsablePreview(*window);
    EXPECT_TRUE(noticeOf(*window).contains(QString::fromStdString(in_the_way)))
        << noticeOf(*window).toStdString();
    EXPECT_EQ(dialogs.count(), 0);
    Preferences preferences;
    preferences.map_folder = QString::fromStdString(folder_.string());
    window->setPreferences(preferences);
    tryAgain(*window);
    ASSERT_TRUE(waitUntilSettled(*window));
    expectRightHeights(*window);
    EXPECT_EQ(noticeOf(*window).indexOf(QStringLiteral("file")), -1);
}

TEST_F(PreparationTest, SaysThatTheFileIsNoLongerWhole)
{
    WindowOptions some = options();
    some.opener.prepare = [](const RasterSpec& spec, const MapResources& resources,
                             JobMonitor& monitor) {
        std::filesystem::resize_file(spec.path, std::filesystem::file_size(spec.path) / 3);
        return buildOverviews(spec, resources, monitor);
    };
    const auto window = makeWindow(some);
    const QSignalSpy dialogs(window.get(), &MainWindow::openFailed);
    window->open(file_);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return stateOf(*window) == PreparationState::Failed; }, kTimeout));
    expectUsablePreview(*window);
    EXPECT_TRUE(noticeOf(*window).startsWith(file_)) << noticeOf(*window).toStdString();
    EXPECT_EQ(dialogs.count(), 0);
}

TEST_F(PreparationTest, WhatIsDamagedIsPreparedAgain)
{
    std::string raster;
    {
        const auto window = makeWindow(options());
        ASSERT_TRUE(openAndWait(*window, file_));
        raster = preparedFile();
    }
    const std::string levels = LevelFile::pathFor(raster);
    const auto spoil_middle = [](const std::string& path) {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(path) / 2));
        file << std::string(64, '\x5a');
        file.close();
        // File times are compared in whole seconds, and a test is faster than that.
        std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) +
                                                   std::chrono::seconds(2));
    };
    const auto cut_in_half = [](const std::string& path) {
        std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    };
    const std::vector<std::pair<const char*, std::function<void()>>> accidents{
        {"levels cut short", [&] { cut_in_half(levels); }},
        {"levels spoilt", [&] { spoil_middle(levels); }},
        {"raster cut short", [&] { cut_in_half(raster); }},
        {"raster spoilt", [&] { spoil_middle(raster); }},
        {"both gone", [&] { std::filesystem::remove(raster), std::filesystem::remove(levels); }},
    };
    for (const auto& [what, happen] : accidents) {
        SCOPED_TRACE(what);
        happen();
        const auto window = makeWindow(options());
        const QSignalSpy preparing(&window->controller(), &SessionController::preparingProgressed);
        ASSERT_TRUE(openAndWait(*window, file_));
        EXPECT_GT(preparing.count(), 0);
        EXPECT_EQ(stateOf(*window), PreparationState::None) << noticeOf(*window).toStdString();
        expectRightHeights(*window);
    }
}

TEST_F(PreparationTest, TwoWindowsPrepareOneMapOnce)
{
    const auto first = makeWindow(options());
    const auto second = makeWindow(options());
    first->open(file_);
    second->open(file_);
    for (MainWindow* window : {first.get(), second.get()}) {
        ASSERT_TRUE(QTest::qWaitFor(
            [window] {
                return !window->session().layers.empty() && !window->controller().isBusy() &&
                       !window->controller().isPreparing();
            },
            kTimeout));
        EXPECT_EQ(stateOf(*window), PreparationState::None) << noticeOf(*window).toStdString();
        expectRightHeights(*window);
    }
    // The map, its levels, and the mark of its last use.
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        EXPECT_EQ(entry.path().string().rfind(preparedFile(), 0), 0U) << entry.path();
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
}

} // namespace
} // namespace marsview
