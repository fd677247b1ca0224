#include "core/prepare/map_folder.h"
#include "core/tiles/tile_disk_cache.h"
#include "tests/support/grid_tile_source.h"
#include "tests/support/make_terrain.h"
#include "tests/support/scoped_variable.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/dialogs/large_maps_page.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/window_actions.h"

#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace marsview {
namespace {

class LargeMapsPageTest : public testing::Test {
protected:
    void SetUp() override { folder_ = root_.path() / "maps"; }

    // A prepared map of `bytes`, as far as the folder can see.
    std::string addMap(const std::string& digest, std::size_t bytes) const
    {
        const Result<MapFolder> maps = MapFolder::open(folder_);
        EXPECT_TRUE(maps) << maps.error().message;
        const SourceIdentity source{
            .path = "/data/" + digest + ".tif", .bytes = bytes, .modified_s = 1, .digest = digest};
        const std::string path = maps->pathFor(source, 1);
        std::ofstream(path) << std::string(bytes, 'x');
        return path;
    }
    LargeMapDefaults standard() const { return {.folder = folder_, .tile_bytes = 512U << 20}; }
    std::string fetched() const { return fetchedTilesFolder(folder_); }
    void addTile(const std::string& name, std::size_t bytes) const
    {
        const auto path = std::filesystem::path(fetched()) / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << std::string(bytes, 'x');
    }
    static QTreeWidget& list(LargeMapsPage& page)
    {
        return *page.findChild<QTreeWidget*>(QStringLiteral("preparedMaps"));
    }

    test::TempFolder root_;
    std::filesystem::path folder_;
    // It would go before what is chosen.
    const test::ScopedVariable cache_home_{"XDG_CACHE_HOME", root_.path().c_str()};
    const test::ScopedVariable no_cache_folder_{"MARSVIEW_CACHE_DIR", nullptr};
};

TEST_F(LargeMapsPageTest, ListsAndRemovesPreparedMaps)
{
    const std::string first = addMap("aaaa", 3'000'000);
    const std::string second = addMap("bbbb", 1'000'000);
    LargeMapsPage page(standard());
    page.fill({});
    ASSERT_EQ(list(page).topLevelItemCount(), 2);
    auto* remove = page.findChild<QPushButton*>(QStringLiteral("removePrepared"));
    EXPECT_FALSE(remove->isEnabled());
    QTreeWidgetItem* large = list(page).topLevelItem(0)->text(1) == QStringLiteral("3.0 MB")
                                 ? list(page).topLevelItem(0)
                                 : list(page).topLevelItem(1);
    EXPECT_EQ(large->text(1), QStringLiteral("3.0 MB"));
    large->setSelected(true);
    ASSERT_TRUE(remove->isEnabled());
    remove->click();
    EXPECT_FALSE(std::filesystem::exists(first));
    EXPECT_TRUE(std::filesystem::exists(second));
    EXPECT_EQ(list(page).topLevelItemCount(), 1);
}

TEST_F(LargeMapsPageTest, DoesNotCreateTheFolderJustToShowIt)
{
    LargeMapsPage page(standard());
    page.fill({});
    EXPECT_EQ(list(page).topLevelItemCount(), 0);
    EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(LargeMapsPageTest, ReportsTheChosenSettings)
{
    LargeMapsPage page(standard());
    page.fill({.tile_memory_mb = 700,
               .map_folder = QStringLiteral("/elsewhere"),
               .map_folder_gb = 20,
               .fetched_gb = 9});
    Preferences chosen;
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, 700);
    EXPECT_EQ(chosen.map_folder, QStringLiteral("/elsewhere"));
    EXPECT_EQ(chosen.map_folder_gb, 20);
    EXPECT_EQ(chosen.fetched_gb, 9);
    const QSignalSpy changes(&page, &LargeMapsPage::changed);
    const QList<QSpinBox*> boxes = page.findChildren<QSpinBox*>();
    boxes[0]->setValue(5); // too little space for a picture
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, kTileMemoryMbMin);
    boxes[0]->setValue(0);
    boxes[1]->setValue(0);
    boxes[2]->setValue(0);
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, 0);
    EXPECT_EQ(chosen.map_folder_gb, 0);
    EXPECT_EQ(chosen.fetched_gb, 0);
    EXPECT_EQ(changes.count(), 4);
}

TEST_F(LargeMapsPageTest, ListsAndRemovesDownloadedTiles)
{
    addTile("0123/s0-0-0.tile", 1'500'000);
    addTile("0123/s0-0-1.tile", 500'000);
    LargeMapsPage page(standard());
    page.fill({});
    const auto* total = page.findChild<QLabel*>(QStringLiteral("fetchedTotal"));
    auto* empty = page.findChild<QPushButton*>(QStringLiteral("emptyFetched"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return total->text() == QStringLiteral("2 tiles, 2.0 MB"); },
                                kTimeout));
    empty->click();
    auto* box = page.findChild<QMessageBox*>();
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(keptTilesIn(fetched()).count, 2U) << "not before confirmation";
    for (QAbstractButton* button : box->buttons()) {
        if (box->buttonRole(button) == QMessageBox::DestructiveRole) {
            button->click();
        }
    }
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return total->text() == QStringLiteral("No tiles are stored here."); }, kTimeout));
    EXPECT_EQ(keptTilesIn(fetched()).count, 0U);
    EXPECT_FALSE(empty->isEnabled());
}

TEST_F(LargeMapsPageTest, DownloadedTilesAreKeptNextToPreparedMaps)
{
    addTile("0123/s0-0-0.tile", 1'500'000);
    LargeMapsPage page(standard());
    page.fill({});
    const auto* total = page.findChild<QLabel*>(QStringLiteral("fetchedTotal"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return total->text() == QStringLiteral("One tile, 1.5 MB"); },
                                kTimeout));
    page.fill({.map_folder = QString::fromStdString(root_.file("elsewhere"))});
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return total->text() == QStringLiteral("No tiles are stored here."); }, kTimeout));
    EXPECT_FALSE(std::filesystem::exists(root_.file("elsewhere")));
}

TEST_F(LargeMapsPageTest, PreferencesComeBackFromSettings)
{
    QSettings settings(QString::fromStdString(root_.file("settings.ini")), QSettings::IniFormat);
    EXPECT_EQ(preferencesFrom(settings), Preferences{});
    const Preferences chosen{.tile_memory_mb = 900,
                             .map_folder = QStringLiteral("/data/prepared"),
                             .map_folder_gb = 55,
                             .fetched_gb = 7};
    save(chosen, settings);
    EXPECT_EQ(preferencesFrom(settings), chosen);
    settings.setValue(QStringLiteral("preferences/tileMemoryMB"), 3);
    settings.setValue(QStringLiteral("preferences/mapFolderGB"), -3);
    settings.setValue(QStringLiteral("preferences/fetchedGB"), QStringLiteral("many"));
    EXPECT_EQ(preferencesFrom(settings).tile_memory_mb, kTileMemoryMbMin);
    EXPECT_EQ(preferencesFrom(settings).map_folder_gb, 0);
    EXPECT_EQ(preferencesFrom(settings).fetched_gb, 0);
    EXPECT_EQ(fetchedBytesMax(preferencesFrom(settings)), kFetchedBytesMax);
    EXPECT_EQ(fetchedBytesMax(chosen), 7'000'000'000U);
}

TEST_F(LargeMapsPageTest, PreferencesReplaceOnlyDefaults)
{
    MapResources standard;
    standard.folder = "/standard";
    standard.held_bytes_max = 77;
    const MapResources same = resourcesFor(standard, {});
    EXPECT_EQ(same.folder, "/standard");
    EXPECT_EQ(same.folder_bytes_max, 0U);
    const MapResources other =
        resourcesFor(standard, {.map_folder = QStringLiteral("/mine"), .map_folder_gb = 3});
    EXPECT_EQ(other.folder, "/mine");
    EXPECT_EQ(other.folder_bytes_max, 3'000'000'000U);
    EXPECT_EQ(other.held_bytes_max, 77U);
}

TEST_F(LargeMapsPageTest, MemoryTakesEffectAtOnce)
{
    WindowOptions options = testWindowOptions();
    options.opener.resources.tiles =
        std::make_shared<TileCache>(TileCacheOptions{.bytes_max = std::size_t{300} << 20});
    const auto tiles = options.opener.resources.tiles;
    MainWindow window(options);
    window.show();
    window.actionSet().preferences->trigger();
    auto* dialog = window.findChild<PreferencesDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* memory = dialog->findChild<QSpinBox*>(QStringLiteral("tileMemory"));
    ASSERT_NE(memory, nullptr);
    memory->setValue(200);
    EXPECT_EQ(tiles->bytesMax(), std::size_t{200} << 20);
    memory->setValue(0);
    EXPECT_EQ(tiles->bytesMax(), std::size_t{300} << 20);
}

TEST_F(LargeMapsPageTest, DownloadedTilesFollowTheChosenFolder)
{
    WindowOptions options = testWindowOptions();
    options.opener.resources.folder = folder_;
    options.opener.resources.fetched_tiles =
        std::make_shared<TileDiskCache>(TileDiskCacheOptions{.folder = fetched()});
    const auto& kept = *options.opener.resources.fetched_tiles;
    MainWindow window(options);
    EXPECT_EQ(kept.folder(), fetched());
    EXPECT_EQ(kept.bytesMax(), kFetchedBytesMax);
    window.setPreferences(
        {.map_folder = QString::fromStdString(root_.file("elsewhere")), .fetched_gb = 2});
    EXPECT_EQ(kept.folder(), fetchedTilesFolder(root_.file("elsewhere")));
    EXPECT_EQ(kept.bytesMax(), 2'000'000'000U);
    window.setPreferences({});
    EXPECT_EQ(kept.folder(), fetched());
    EXPECT_EQ(kept.bytesMax(), kFetchedBytesMax);
}

TEST_F(LargeMapsPageTest, ReportsOnceThatTilesCannotBeCachedAndContinues)
{
    const TestMaps maps;
    WindowOptions options = testWindowOptions();
    options.opener.resources.folder = root_.write("not a folder", "x");
    const auto kept = std::make_shared<TileDiskCache>(
        TileDiskCacheOptions{.folder = fetchedTilesFolder(options.opener.resources.folder)});
    options.opener.resources.fetched_tiles = kept;
    MainWindow window(options);
    window.show();
    ASSERT_TRUE(openAndWait(window, maps.hill()));
    auto* bar = window.findChild<NoticeBar*>();
    const auto shown = [bar] {
        return bar->isVisible() ? bar->findChild<QLabel*>(QStringLiteral("noticeText"))->toolTip()
                                : QString();
    };
    const QString sentence = QStringLiteral("cannot be cached here (Not a directory)");
    EXPECT_FALSE(shown().contains(sentence));
    const auto source = cachedOnDisk(std::make_shared<test::GridTileSource>(
                                         test::int16Terrain(60, 40, {},
                                                            [](std::size_t column, std::size_t) {
                                                                return static_cast<double>(column);
                                                            }),
                                         test::GridTileSource::Options{}),
                                     kept, "key");
    const auto reader = source->open();
    EXPECT_TRUE((*reader)->read({}));
    ASSERT_TRUE(kept->trouble());
    const auto draw = [&window] {
        window.view()->goHome();
        window.view()->setExaggeration(window.view()->exaggeration() * 2.0);
        return waitUntilSettled(window);
    };
    ASSERT_TRUE(draw());
    EXPECT_TRUE(shown().contains(sentence)) << shown().toStdString();
    auto* next = bar->findChild<QToolButton*>(QStringLiteral("noticeNext"));
    const auto* text = bar->findChild<QLabel*>(QStringLiteral("noticeText"));
    for (int i = 0; i < 5 && !text->text().contains(sentence); ++i) {
        next->click();
    }
    bar->findChild<QToolButton*>(QStringLiteral("noticeClose"))->click();
    ASSERT_TRUE(draw());
    EXPECT_FALSE(shown().contains(sentence));
    ASSERT_TRUE(openAndWait(window, maps.hill(QStringLiteral("other.asc"))));
    EXPECT_FALSE(shown().contains(sentence)) << "it has been shown already";
}

} // namespace
} // namespace marsview
