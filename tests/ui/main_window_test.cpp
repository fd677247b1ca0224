#include "tests/ui/pointer_moves.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/recent_files.h"
#include "ui/main_window.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QAbstractItemModel>
#include <QAbstractItemView>
#include <QApplication>
#include <QDir>
#include <QDropEvent>
#include <QFileDialog>
#include <QFrame>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

class MainWindowTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->show();
    }

    TerrainView& view() { return *window_->view(); }
    std::string shownFile() { return view().map() ? view().map()->spec().path : std::string(); }
    bool waitForLoad()
    {
        return QTest::qWaitFor([this] { return !window_->loader().isLoading(); }, kTimeout);
    }

    // As from a file manager.
    void drop(const QString& file)
    {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(file)});
        QDragEnterEvent enter({100, 100}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(window_.get(), &enter);
        EXPECT_TRUE(enter.isAccepted());
        QDropEvent drop(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(window_.get(), &drop);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(MainWindowTest, FramesTheMapWhileFilesAreDraggedOverTheWindow)
{
    window_->show();
    const auto frames = window_->findChildren<QFrame*>(QStringLiteral("dropFrame"));
    ASSERT_EQ(frames.size(), 1);
    QFrame& frame = *frames.front();
    EXPECT_FALSE(frame.isVisible());
    const auto enter = [&](const QMimeData& data) {
        QDragEnterEvent event({100, 100}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(window_.get(), &event);
    };
    QMimeData text;
    text.setText(QStringLiteral("18 N 226 E"));
    enter(text);
    EXPECT_FALSE(frame.isVisible()) << "not what can be dropped";
    QMimeData files;
    files.setUrls({QUrl::fromLocalFile(maps_.hill())});
    enter(files);
    EXPECT_TRUE(frame.isVisible());
    const QRect shown(frame.mapTo(window_.get(), QPoint()), frame.size());
    const QRect map(view().mapTo(window_.get(), QPoint()), view().size());
    EXPECT_EQ(shown, map);
    EXPECT_EQ(window_->childAt(map.center()), &view()) << "the mouse passes through it";
    QDragLeaveEvent leave;
    QApplication::sendEvent(window_.get(), &leave);
    EXPECT_FALSE(frame.isVisible());
    drop(maps_.hill());
    EXPECT_FALSE(frame.isVisible());
    EXPECT_TRUE(waitForLoad());
}

TEST_F(MainWindowTest, OpensAFileAskedForBeforeItWasShown)
{
    MainWindow window(testWindowOptions());
    const QString file = maps_.hill();
    window.open(file);
    window.show();
    ASSERT_TRUE(waitUntilSettled(window));
    EXPECT_EQ(window.view()->map()->spec().path, file.toStdString());
    EXPECT_TRUE(window.windowTitle().contains(QStringLiteral("hill.asc")));
}

TEST_F(MainWindowTest, TheTitleNamesALayerInThePicture)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    ASSERT_TRUE(openAndWait(*window_, maps_.mars("other")));
    SessionController& controller = window_->controller();
    const LayerId top = window_->session().layers[0].id;
    const LayerId below = window_->session().layers[1].id;
    const auto titleHas = [this](const char* name) {
        return window_->windowTitle().contains(QLatin1String(name));
    };
    EXPECT_TRUE(titleHas("other.vrt"));
    controller.activate(below);
    EXPECT_TRUE(titleHas("mars.vrt"));
    controller.setVisible(below, false);
    EXPECT_TRUE(titleHas("other.vrt")) << "the selected layer is hidden";
    controller.setVisible(top, false);
    EXPECT_TRUE(titleHas("mars.vrt"));
}

TEST_F(MainWindowTest, OpensAFolderOfAdjoiningRastersAsOneMap)
{
    const TestMaps::Height slope = [](int column, int row) { return column + 2.0 * row; };
    ASSERT_TRUE(QDir().mkpath(maps_.path(QStringLiteral("tiles"))));
    maps_.write(QStringLiteral("tiles/west.asc"), {}, slope);
    maps_.write(QStringLiteral("tiles/east.asc"), {.x_lower_left = 500000.0 + 60 * 30.0}, slope);
    ASSERT_TRUE(waitUntilSettled(*window_));
    window_->actionSet().open_folder->trigger();
    auto* dialog = window_->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    const QString folder = maps_.path(QStringLiteral("tiles"));
    Q_EMIT dialog->filesSelected({folder});
    dialog->close();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(shownFile(), folder.toStdString());
    ASSERT_TRUE(view().map());
    EXPECT_EQ(view().map()->info().columns, 120U);
    EXPECT_EQ(view().map()->heightfield().height({90.0, 10.0}), 30.0 + 20.0);
    EXPECT_TRUE(window_->windowTitle().contains(QStringLiteral("tiles")));
    EXPECT_TRUE(window_->commands().files.recentFiles()->files().contains(folder));
}

TEST_F(MainWindowTest, ShowsTheRastersOfAFolderThatIsChosen)
{
    ASSERT_TRUE(QDir().mkpath(maps_.path(QStringLiteral("tiles"))));
    maps_.hill(QStringLiteral("tiles/hill.asc"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    window_->actionSet().open_folder->trigger();
    auto* dialog = window_->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    dialog->setDirectory(maps_.path(QStringLiteral("tiles")));
    const auto is_listed = [dialog] {
        for (const QAbstractItemView* list : dialog->findChildren<QAbstractItemView*>()) {
            const QAbstractItemModel* model = list->model();
            for (int row = 0; model != nullptr && row < model->rowCount(list->rootIndex()); ++row) {
                if (model->index(row, 0, list->rootIndex()).data().toString() ==
                    QStringLiteral("hill.asc")) {
                    return true;
                }
            }
        }
        return false;
    };
    EXPECT_TRUE(QTest::qWaitFor(is_listed, kTimeout));
    dialog->reject();
}

TEST_F(MainWindowTest, OpensAFolderThatIsDropped)
{
    ASSERT_TRUE(QDir().mkpath(maps_.path(QStringLiteral("tiles"))));
    maps_.hill(QStringLiteral("tiles/hill.asc"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    drop(maps_.path(QStringLiteral("tiles/")));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(shownFile(), maps_.path(QStringLiteral("tiles")).toStdString());
}

TEST_F(MainWindowTest, OpensTheFileChosenInTheDialog)
{
    const QString file = maps_.hill();
    ASSERT_TRUE(waitUntilSettled(*window_));
    window_->actionSet().open->trigger();
    auto* dialog = window_->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    Q_EMIT dialog->filesSelected({file});
    dialog->reject();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(shownFile(), file.toStdString());
}

TEST_F(MainWindowTest, OpensAFileDroppedOnIt)
{
    const QString file = maps_.hill();
    ASSERT_TRUE(waitUntilSettled(*window_));
    drop(file);
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(shownFile(), file.toStdString());
}

TEST_F(MainWindowTest, TheNameOfAFileThatIsOpenedFitsIntoTheView)
{
    auto* hint = view().findChild<QLabel*>(QStringLiteral("emptyHint"));
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return hint->isVisible() && hint->width() > 300; }, kTimeout));
    view().setHint(QString(300, QLatin1Char('M')));
    const QImage picture = hint->grab().toImage();
    const auto is_empty = [&picture](int column) {
        for (int y = 0; y < picture.height(); ++y) {
            if (picture.pixel(column, y) != picture.pixel(0, 0)) {
                return false;
            }
        }
        return true;
    };
    EXPECT_FALSE(is_empty(picture.width() / 4)) << "there is text";
    EXPECT_TRUE(is_empty(0));
    EXPECT_TRUE(is_empty(picture.width() - 1));
}

TEST_F(MainWindowTest, KeepsTheMapWhenAnotherCannotBeOpened)
{
    const QString file = maps_.hill();
    ASSERT_TRUE(openAndWait(*window_, file));
    const OrbitCamera camera = view().camera();
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    window_->open(QStringLiteral("/no/such/map.tif"));
    ASSERT_TRUE(waitForLoad());
    ASSERT_EQ(failures.count(), 1);
    EXPECT_TRUE(failures[0][0].toString().startsWith(QStringLiteral("/no/such/map.tif: ")));
    EXPECT_EQ(shownFile(), file.toStdString());
    EXPECT_EQ(view().camera(), camera);
}

TEST_F(MainWindowTest, KeepsTheMapWhenLoadingIsCanceled)
{
    const QString file = maps_.hill();
    ASSERT_TRUE(openAndWait(*window_, file));
    window_->open(maps_.ring());
    EXPECT_TRUE(window_->loader().isLoading());
    window_->controller().cancel();
    EXPECT_FALSE(window_->loader().isLoading());
    QTest::qWait(100);
    EXPECT_EQ(shownFile(), file.toStdString());
}

TEST_F(MainWindowTest, TellsPositionAndHeightUnderThePointer)
{
    const QString file = maps_.hill();
    ASSERT_TRUE(openAndWait(*window_, file));
    const QPoint pointer = view().rect().center();
    ASSERT_TRUE(movePointer(view(), pointer));
    const auto hit = view().surfaceAt(pointer);
    ASSERT_TRUE(hit);
    const Map& dataset = *view().map();
    const double height_m = dataset.heightfield().height(hit->grid);
    const auto is_told = [&] {
        const QString height = window_->readout()->heightLabel().section(QLatin1Char(' '), 0, 0);
        return !height.isEmpty() && std::abs(height.toDouble() - height_m) < 0.06;
    };
    EXPECT_TRUE(QTest::qWaitFor(is_told, kTimeout)) << height_m;
    const MapPoint map = dataset.georeference().toMap(hit->grid);
    const QString text = window_->readout()->coordinateLabel();
    EXPECT_NEAR(text.section(QStringLiteral(", "), 0, 0).toDouble(), map.x, 0.51);
    EXPECT_NEAR(text.section(QStringLiteral(", "), 1, 1).toDouble(), map.y, 0.51);
}

TEST_F(MainWindowTest, TakesAndUndoesToldGeoreferencing)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_EQ(view().map()->georeference().body(), nullptr);
    GeoreferencingPanel& panel = *window_->georeferencingPanel();
    panel.edit();
    panel.findChild<QLineEdit*>(QStringLiteral("crs"))->setText(QStringLiteral("EPSG:32611"));
    panel.findChild<QPushButton*>(QStringLiteral("apply"))->click();
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_NE(view().map()->georeference().body(), nullptr);
    EXPECT_EQ(view().map()->georeference().body()->name, "Earth");
    EXPECT_EQ(formatName(window_->readout()->format(), view().map()->info()),
              QStringLiteral("geodetic"));

    window_->undoStack().undo();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(view().map()->georeference().body(), nullptr);
    window_->undoStack().redo();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_NE(view().map()->georeference().body(), nullptr);
}

// PROJ names a method in the CRS's name, in one word: Hotine_Oblique_Mercator_Azimuth_Center.
TEST_F(MainWindowTest, LongNamesOfCrssStayInThePanel)
{
    ASSERT_TRUE(openAndWait(
        *window_,
        maps_.placed("oblique", "+proj=omerc +lat_0=40 +lonc=0 +alpha=35 +gamma=35 +R=3396000",
                     {-20000.0, 1000.0, 0.0, 15000.0, 0.0, -1000.0})));
    int count = 0;
    const GeoreferencingPanel& panel = *window_->georeferencingPanel();
    for (const QLabel* label : panel.findChildren<QLabel*>()) {
        if (label->isVisible() && !label->text().isEmpty()) {
            ++count;
            EXPECT_LE(label->mapTo(&panel, QPoint(label->width(), 0)).x(), panel.width())
                << label->text().toStdString();
        }
    }
    EXPECT_GT(count, 20);
}

TEST_F(MainWindowTest, RefusesGeoreferencingThatMakesNoSenseInItsForm)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    GeoreferencingPanel& panel = *window_->georeferencingPanel();
    panel.edit();
    panel.findChild<QLineEdit*>(QStringLiteral("crs"))->setText(QStringLiteral("EPSG:nonsense"));
    panel.findChild<QPushButton*>(QStringLiteral("apply"))->click();
    ASSERT_TRUE(waitForLoad());
    EXPECT_EQ(failures.count(), 0);             // reported next to the field instead
    EXPECT_EQ(window_->undoStack().count(), 1); // opening the map
    EXPECT_TRUE(view().map()->spec().overrides.isEmpty());
}

TEST_F(MainWindowTest, ReadsTheFileAgainForAnotherNodataValue)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.ring()));
    GeoreferencingPanel& panel = *window_->georeferencingPanel();
    panel.edit();
    panel.findChild<QLineEdit*>(QStringLiteral("nodata"))->setText(QStringLiteral("100"));
    panel.findChild<QPushButton*>(QStringLiteral("apply"))->click();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_TRUE(std::isnan(view().map()->heightfield().sample(0, 0)));
    EXPECT_FALSE(std::isnan(view().map()->heightfield().sample(30, 20)));
}

TEST_F(MainWindowTest, LeavesTwoThirdsOfTheWidthToTheMap)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    for (const QSize size : {QSize(1000, 700), QSize(1280, 800), QSize(1550, 900)}) {
        window_->resize(size);
        EXPECT_TRUE(QTest::qWaitFor([&] {
            return window_->size() == size && view().width() * 3 >= size.width() * 2;
        })) << view().width()
            << " of " << size.width();
    }
}

TEST_F(MainWindowTest, MayBeClosedWhileLoading)
{
    ASSERT_TRUE(waitUntilSettled(*window_));
    window_->open(maps_.hill());
    window_.reset();
    QCoreApplication::processEvents();
}

} // namespace
} // namespace marsview
