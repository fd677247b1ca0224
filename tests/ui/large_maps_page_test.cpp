#include "core/raster/map_folder.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/test_map.h"
#include "ui/dialogs/large_maps_page.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/window_actions.h"

#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace marsview {
namespace {

class LargeMapsPageTest : public testing::Test {
protected:
    void SetUp() override { folder_ = root_.path() / "maps"; }

    // A prepared map of `bytes`, as far as the folder is concerned.
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
    static QTreeWidget& list(LargeMapsPage& page)
    {
        return *page.findChild<QTreeWidget*>(QStringLiteral("preparedMaps"));
    }

    test::TempFolder root_;
    std::filesystem::path folder_;
};

TEST_F(LargeMapsPageTest, ListsWhatWasPreparedAndRemovesIt)
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

TEST_F(LargeMapsPageTest, DoesNotMakeTheFolderJustToShowIt)
{
    LargeMapsPage page(standard());
    page.fill({});
    EXPECT_EQ(list(page).topLevelItemCount(), 0);
    EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(LargeMapsPageTest, TellsWhatIsChosen)
{
    LargeMapsPage page(standard());
    page.fill(
        {.tile_memory_mb = 700, .map_folder = QStringLiteral("/elsewhere"), .map_folder_gb = 20});
    Preferences chosen;
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, 700);
    EXPECT_EQ(chosen.map_folder, QStringLiteral("/elsewhere"));
    EXPECT_EQ(chosen.map_folder_gb, 20);
    const QSignalSpy changes(&page, &LargeMapsPage::changed);
    const QList<QSpinBox*> boxes = page.findChildren<QSpinBox*>();
    boxes[0]->setValue(5); // too little for a picture
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, kTileMemoryMbMin);
    boxes[0]->setValue(0);
    boxes[1]->setValue(0);
    page.apply(chosen);
    EXPECT_EQ(chosen.tile_memory_mb, 0);
    EXPECT_EQ(chosen.map_folder_gb, 0);
    EXPECT_EQ(changes.count(), 3);
}

TEST_F(LargeMapsPageTest, PreferencesComeBackFromSettings)
{
    QSettings settings(QString::fromStdString(root_.file("settings.ini")), QSettings::IniFormat);
    EXPECT_EQ(preferencesFrom(settings), Preferences{});
    const Preferences chosen{
        .tile_memory_mb = 900, .map_folder = QStringLiteral("/data/prepared"), .map_folder_gb = 55};
    save(chosen, settings);
    EXPECT_EQ(preferencesFrom(settings), chosen);
    settings.setValue(QStringLiteral("preferences/tileMemoryMB"), 3);
    settings.setValue(QStringLiteral("preferences/mapFolderGB"), -3);
    EXPECT_EQ(preferencesFrom(settings).tile_memory_mb, kTileMemoryMbMin);
    EXPECT_EQ(preferencesFrom(settings).map_folder_gb, 0);
}

TEST_F(LargeMapsPageTest, PreferencesReplaceWhatIsStandardAndNoMore)
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
    QSpinBox* memory = dialog->findChildren<QSpinBox*>().constFirst();
    memory->setValue(200);
    EXPECT_EQ(tiles->bytesMax(), std::size_t{200} << 20);
    memory->setValue(0);
    EXPECT_EQ(tiles->bytesMax(), std::size_t{300} << 20);
}

} // namespace
} // namespace marsview
