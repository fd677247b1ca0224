// The state that one window stores for the next.

#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/recent_files.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/window/status_readout.h"
#include "ui/window/theme.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QTest>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class WindowMemoryTest : public testing::Test {
protected:
    void SetUp() override { QSettings().clear(); }
    void TearDown() override { QSettings().clear(); }

    static WindowOptions remembering()
    {
        return {.geometry = WindowOptions::Geometry::Remembered,
                .failures = WindowOptions::Failures::BySignalOnly};
    }
    static std::unique_ptr<MainWindow> makeWindow(QSize size = {})
    {
        auto window = std::make_unique<MainWindow>(remembering());
        if (size.isValid()) {
            window->resize(size);
        }
        window->show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(window.get()));
        return window;
    }
    static QList<QAction*> recentEntries(MainWindow& window)
    {
        Q_EMIT window.actionSet().recent->aboutToShow();
        return window.actionSet().recent->actions();
    }

    TestMaps maps_;
};

TEST_F(WindowMemoryTest, RestoresSizePanelsCoordinatesAndPreferences)
{
    CoordinateFormat coordinates{.system = PositionSystem::Map,
                                 .angles = AngleNotation::DegreesMinutesSeconds,
                                 .longitudes = LongitudeNotation::West360};
    coordinates.setLatitudesOn(bodyNamed("Mars"), LatitudeKind::Planetographic);
    coordinates.setLatitudesOn(nullptr, LatitudeKind::Planetographic);
    {
        const auto window = makeWindow({1100, 650});
        ASSERT_TRUE(openAndWait(*window, maps_.mars()));
        window->docks()->georeferencing()->toggleViewAction()->trigger(); // opens it, or closes
        window->docks()->georeferencing()->hide();
        window->docks()->reveal(*window->docks()->datasets());
        window->setPreferences({.theme = Theme::Dark,
                                .height_unit = HeightUnit::Feet,
                                .coordinates = coordinates,
                                .has_antialiasing = false,
                                .frames_per_s = 60});
        window->close();
    }
    const auto window = makeWindow();
    EXPECT_EQ(window->size(), QSize(1100, 650));
    EXPECT_FALSE(window->docks()->georeferencing()->isVisible());
    EXPECT_TRUE(window->docks()->datasets()->isVisible());
    EXPECT_EQ(window->preferences().theme, Theme::Dark);
    EXPECT_EQ(window->preferences().height_unit, HeightUnit::Feet);
    EXPECT_EQ(window->preferences().frames_per_s, 60);
    EXPECT_EQ(window->preferences().coordinates, coordinates);
    EXPECT_EQ(window->readout()->format(), coordinates);
    window->setPreferences({});
}

TEST_F(WindowMemoryTest, RestoresAPanelThatOnlyLackedRoom)
{
    {
        const auto window = makeWindow({1280, 800});
        EXPECT_TRUE(window->docks()->georeferencing()->isVisible());
        window->resize(560, 480);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !window->docks()->georeferencing()->isVisible(); },
                                    kTimeout));
        window->close();
    }
    const auto window = makeWindow({1280, 800});
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return window->docks()->georeferencing()->isVisible(); }, kTimeout));
}

// 2026-11: an empty panel took a quarter of the first picture.
TEST_F(WindowMemoryTest, MeasurementsReturnOnceThereAreSome)
{
    std::vector<ProjectMeasurement> saved;
    {
        const auto window = makeWindow({1280, 800});
        ASSERT_TRUE(openAndWait(*window, maps_.mars()));
        window->measuring()->begin(MeasurementKind::Slope);
        window->measuring()->addPointAt({10.0, 10.0});
        saved = window->measuring()->saved();
        EXPECT_TRUE(window->docks()->measurements()->isVisible());
        window->close();
    }
    const auto window = makeWindow();
    EXPECT_FALSE(window->docks()->measurements()->isVisible());
    ASSERT_TRUE(openAndWait(*window, maps_.mars()));
    EXPECT_FALSE(window->docks()->measurements()->isVisible());
    window->measuring()->open(saved, {window->session().layers.front().id});
    EXPECT_TRUE(window->docks()->measurements()->isVisible());
    EXPECT_FALSE(window->docks()->annotations()->isVisible());
}

TEST_F(WindowMemoryTest, OpensARecentFile)
{
    const QString hill = maps_.hill();
    const QString ring = maps_.ring();
    {
        const auto window = makeWindow();
        ASSERT_TRUE(openAndWait(*window, hill));
        ASSERT_TRUE(openAndWait(*window, ring));
        window->close();
    }
    const auto window = makeWindow();
    ASSERT_TRUE(waitUntilSettled(*window));
    const QList<QAction*> entries = recentEntries(*window);
    EXPECT_EQ(entries[0]->text(), QStringLiteral("ring.asc")); // most recently opened first
    EXPECT_EQ(entries[1]->text(), QStringLiteral("hill.asc"));
    entries[1]->trigger();
    ASSERT_TRUE(waitUntilSettled(*window));
    EXPECT_EQ(window->view()->map()->spec().path, hill.toStdString());
    EXPECT_EQ(recentEntries(*window)[0]->text(), QStringLiteral("hill.asc"));
}

TEST_F(WindowMemoryTest, RemembersTenFilesAndMarksMissingOnes)
{
    const auto window = makeWindow();
    QStringList files;
    for (int i = 0; i < 12; ++i) {
        files.append(maps_.hill(QStringLiteral("m%1.asc").arg(i)));
        window->commands().files.recentFiles()->add(files.last());
    }
    EXPECT_EQ(window->commands().files.recentFiles()->files().size(), 10);
    ASSERT_TRUE(QFile::remove(files[11]));
    const QList<QAction*> entries = recentEntries(*window);
    EXPECT_EQ(entries[0]->text(), QStringLiteral("m10.asc"));
    EXPECT_EQ(entries[9]->text(), QStringLiteral("m11.asc (missing)"));
    EXPECT_FALSE(entries[9]->isEnabled());
    entries.last()->trigger(); // Clear Menu
    EXPECT_TRUE(window->commands().files.recentFiles()->files().isEmpty());
    EXPECT_FALSE(window->actionSet().recent->isEnabled());
    EXPECT_TRUE(QSettings().value(QStringLiteral("files/recent")).toStringList().isEmpty());
}

TEST_F(WindowMemoryTest, CoordinatePreferencesApplyToTheBodyInTheView)
{
    MainWindow window(testWindowOptions());
    window.show();
    ASSERT_TRUE(openAndWait(window, maps_.moon()));
    window.actionSet().preferences->trigger();
    auto* dialog = window.findChild<PreferencesDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* page = dialog->findChild<CoordinatesPage*>();
    auto* body = page->findChild<QComboBox*>(QStringLiteral("latitudeBody"));
    auto* kind = page->findChild<QComboBox*>(QStringLiteral("latitudeKind"));
    EXPECT_EQ(body->currentText(), QStringLiteral("Moon"));
    EXPECT_FALSE(kind->isEnabled()) << "on a sphere there is one";
    body->setCurrentText(QStringLiteral("Mars"));
    EXPECT_TRUE(kind->isEnabled());
    // One place in each notation, whichever is chosen.
    const auto example = [page](int i) {
        return page->findChild<QLabel*>(QStringLiteral("example%1").arg(i))->text();
    };
    EXPECT_EQ(example(0), QStringLiteral("18.65° N, 226.20° E"));
    EXPECT_TRUE(example(1).contains(QStringLiteral("39′"))) << example(1).toStdString();
    // The same place in meters of an equirectangular map: 3396190 m times the angles in radians.
    EXPECT_TRUE(example(2).contains(QStringLiteral("7930955"))) << example(2).toStdString();
    EXPECT_TRUE(example(2).contains(QStringLiteral("1105473"))) << example(2).toStdString();
}

TEST_F(WindowMemoryTest, AppliesPreferencesWhileTheDialogIsOpen)
{
    MainWindow window(testWindowOptions());
    window.show();
    window.actionSet().preferences->trigger();
    auto* dialog = window.findChild<PreferencesDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* theme = dialog->findChild<QComboBox*>(QStringLiteral("theme"));
    auto* unit = dialog->findChild<QComboBox*>(QStringLiteral("elevationUnit"));
    ASSERT_TRUE(theme != nullptr && unit != nullptr);
    theme->setCurrentIndex(2);
    EXPECT_EQ(window.preferences().theme, Theme::Dark);
    EXPECT_EQ(QApplication::palette().color(QPalette::Window),
              darkPalette().color(QPalette::Window));
    unit->setCurrentIndex(1);
    EXPECT_EQ(window.preferences().height_unit, HeightUnit::Feet);
    // Enter closes the dialog; it reverts nothing.
    QTest::keyClick(unit, Qt::Key_Return);
    EXPECT_EQ(window.preferences().height_unit, HeightUnit::Feet);
    EXPECT_FALSE(dialog->isVisible());
    window.setPreferences({});
}

TEST_F(WindowMemoryTest, StoresNothingIfSettingsAreDisabled)
{
    {
        MainWindow window(testWindowOptions());
        window.show();
        ASSERT_TRUE(openAndWait(window, maps_.hill()));
        window.setPreferences({.theme = Theme::Dark});
        window.setPreferences({});
        window.close();
    }
    EXPECT_TRUE(QSettings().allKeys().isEmpty())
        << QSettings().allKeys().join(QLatin1Char(' ')).toStdString();
}

TEST_F(WindowMemoryTest, TheMapKeepsTwoThirdsAtEveryWidth)
{
    const auto window = makeWindow({1600, 700});
    for (const int width : {1600, 1280, 1000, 800, 620}) {
        window->resize(width, 600);
        EXPECT_TRUE(QTest::qWaitFor(
            [&] {
                return window->width() == width && window->view()->width() * 3 >= width * 2 - 40;
            },
            kTimeout))
            << width << ": " << window->view()->width();
    }
    // In a narrow window, panels are tabs on the side of the one that was opened last.
    QDockWidget* layers = window->docks()->datasets();
    QDockWidget* georeferencing = window->docks()->georeferencing();
    window->resize(800, 600);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window->tabifiedDockWidgets(layers).contains(georeferencing); }, kTimeout));
    EXPECT_EQ(window->dockWidgetArea(georeferencing), Qt::LeftDockWidgetArea);
    window->docks()->reveal(*georeferencing);
    EXPECT_TRUE(window->tabifiedDockWidgets(georeferencing).contains(layers));
    EXPECT_EQ(window->dockWidgetArea(layers), Qt::RightDockWidgetArea);
    EXPECT_FALSE(georeferencing->visibleRegion().isEmpty());
    layers->raise();
    window->resize(805, 600);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window->width() == 805; }, kTimeout));
    EXPECT_FALSE(layers->visibleRegion().isEmpty()) << "the user has chosen the tab";
    window->resize(1600, 600);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return window->dockWidgetArea(layers) == Qt::LeftDockWidgetArea; }, kTimeout));
    EXPECT_EQ(window->dockWidgetArea(georeferencing), Qt::RightDockWidgetArea);
    EXPECT_TRUE(layers->isVisible());
}

} // namespace
} // namespace marsview
