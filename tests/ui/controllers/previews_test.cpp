// Maps that are viewed while they are being prepared.

#include "tests/ui/large_maps.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/load_status.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

class PreviewsTest : public testing::Test {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.opener = large_.opener();
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(1280, 800);
        window_->show();
        ASSERT_TRUE(waitUntilSettled(*window_));
    }
    void TearDown() override
    {
        large_.holdTiles(false);
        window_.reset();
    }

    QString map(const QString& name = QStringLiteral("large.asc"))
    {
        TestMaps::Shape shape;
        shape.columns = 620;
        shape.rows = 410;
        return maps_.write(name, shape, [](int column, int row) {
            return 500.0 + 200.0 * std::sin(column / 40.0) * std::cos(row / 50.0) + column % 7;
        });
    }

    SessionController& controller() { return window_->controller(); }
    const Layer& layer(std::size_t index = 0) { return window_->session().layers.at(index); }
    TerrainView& view() { return *window_->view(); }
    // Sends its own event, because the pointer may already be there.
    void hover(QPoint position)
    {
        QMouseEvent event(QEvent::MouseMove, position, view().mapToGlobal(position), Qt::NoButton,
                          Qt::NoButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &event);
    }
    template <typename Condition>
    static bool waitFor(const Condition& condition)
    {
        return QTest::qWaitFor(condition, kTimeout);
    }
    // Waits until the preview is on screen and the map is being prepared.
    bool openPreview(const QString& file)
    {
        const std::size_t count = window_->session().layers.size();
        window_->open(file);
        return waitFor([&] {
            return window_->session().layers.size() == count + 1 && !controller().isBusy() &&
                   large_.begunCount() > 0 && view().map() == layer().map;
        });
    }
    bool waitUntilWhole()
    {
        return waitFor([this] {
            return !controller().isBusy() && !controller().isPreparing() &&
                   std::none_of(window_->session().layers.begin(), window_->session().layers.end(),
                                [](const Layer& l) { return l.map->isPreview(); });
        });
    }
    PreparationState state() { return controller().preparationOf(layer().id).state; }
    QString notice()
    {
        auto* bar = window_->findChild<NoticeBar*>();
        return bar->isVisible() ? bar->findChild<QLabel*>(QStringLiteral("noticeText"))->text()
                                : QString();
    }
    QToolButton* noticeButton()
    {
        return window_->findChild<NoticeBar*>()->findChild<QToolButton*>(
            QStringLiteral("noticeAction"));
    }
    QString fact(const QString& name)
    {
        for (const QLabel* label : window_->georeferencingPanel()->findChildren<QLabel*>()) {
            if (label->accessibleName() == name) {
                return label->text();
            }
        }
        return {};
    }

    LargeMaps large_;
    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(PreviewsTest, GiveWayToTheirMapsInPlace)
{
    ASSERT_TRUE(openPreview(map()));
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_EQ(state(), PreparationState::Running);
    EXPECT_FALSE(view().map()->heightfield().isTiled());
    const LayerId id = layer().id;
    // Everything that may change in the meantime.
    controller().rename(id, QStringLiteral("Plain"));
    controller().setRamp(id, QStringLiteral("grey"));
    controller().setLight(Angle::degrees(80.0), Angle::degrees(35.0));
    OrbitCamera camera = view().camera();
    camera.azimuth = Angle::degrees(33.0);
    camera.distance_m *= 0.4;
    view().setCamera(camera);
    controller().setExaggeration(7.5);
    camera = view().camera();
    const QRect place = view().geometry();
    EXPECT_FALSE(notice().isEmpty());
    const Session before = window_->session();
    const int steps = window_->undoStack().count();
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    EXPECT_TRUE(layer().map->heightfield().isTiled());
    EXPECT_EQ(view().map(), layer().map);
    EXPECT_EQ(layer().id, id);
    EXPECT_EQ(layer().name, "Plain");
    EXPECT_EQ(layer().ramp, "grey");
    EXPECT_EQ(window_->session().look, before.look);
    EXPECT_EQ(window_->session().active, before.active);
    EXPECT_EQ(view().camera(), camera);
    EXPECT_EQ(view().geometry(), place); // although the notice is gone
    EXPECT_EQ(view().exaggeration(), 7.5);
    EXPECT_EQ(window_->undoStack().count(), steps);
    EXPECT_FALSE(notice().contains(QStringLiteral("preview")));
}

TEST_F(PreviewsTest, GiveWayWhereverTheyAreInTheList)
{
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(openPreview(map(QStringLiteral("above.asc"))));
    const LayerId below = layer(1).id;
    controller().setVisible(layer(0).id, false);
    controller().move(below, 0);
    controller().setVisible(below, false);
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_EQ(layer(0).id, below);
    EXPECT_FALSE(layer(0).is_visible);
    EXPECT_FALSE(layer(1).is_visible);
    // Visible again as it was.
    controller().setVisible(below, true);
    ASSERT_TRUE(waitFor([this] { return view().map() == layer(0).map; }));
    EXPECT_TRUE(view().map()->heightfield().isTiled());
}

TEST_F(PreviewsTest, AreGoneFromTheStepsOfUndoToo)
{
    ASSERT_TRUE(openPreview(map()));
    controller().rename(layer().id, QStringLiteral("Plain"));
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    const auto whole = layer().map;
    window_->undoStack().undo();
    EXPECT_EQ(layer().map, whole);
    window_->undoStack().undo();
    EXPECT_TRUE(window_->session().layers.empty());
    window_->undoStack().redo();
    window_->undoStack().redo();
    EXPECT_EQ(layer().map, whole);
    EXPECT_EQ(layer().name, "Plain");
    EXPECT_FALSE(controller().isPreparing());
}

TEST_F(PreviewsTest, AreNotPreparedForNobodyAndComeBackWithUndo)
{
    ASSERT_TRUE(openPreview(map()));
    controller().remove(layer().id);
    EXPECT_FALSE(controller().isPreparing());
    ASSERT_TRUE(waitFor([this] { return large_.stoppedCount() == 1; }));
    window_->undoStack().undo();
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_TRUE(controller().isPreparing());
    ASSERT_TRUE(waitFor([this] { return large_.begunCount() == 2; }));
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    // Undone and redone after the map was ready.
    window_->undoStack().redo();
    EXPECT_TRUE(window_->session().layers.empty());
    window_->undoStack().undo();
    EXPECT_FALSE(layer().map->isPreview());
}

TEST_F(PreviewsTest, RemovedWhileTheirMapIsReadyAreCompletedWhenTheyComeBack)
{
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(openPreview(map(QStringLiteral("other.asc"))));
    const LayerId first = layer(1).id;
    // The step after which the map is prepared is undone: only an undo step still has the preview.
    large_.finishPreparing();
    ASSERT_TRUE(waitFor([this] { return !large_.prepared().empty(); }));
    controller().remove(first);
    ASSERT_TRUE(waitUntilWhole());
    window_->undoStack().undo();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_EQ(window_->session().layers.size(), 2U);
}

TEST_F(PreviewsTest, StayWhenPreparingIsStoppedUntilItGoesOn)
{
    ASSERT_TRUE(openPreview(map()));
    EXPECT_FALSE(window_->actionSet().layer.prepare->isEnabled());
    EXPECT_NE(notice().indexOf(QStringLiteral("preview while its overviews are being built")), -1);
    EXPECT_FALSE(noticeButton()->isVisible());
    window_->actionSet().stop_preparing->trigger();
    EXPECT_EQ(state(), PreparationState::Stopped);
    EXPECT_FALSE(controller().isPreparing());
    ASSERT_TRUE(waitFor([this] { return large_.stoppedCount() == 1; }));
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_TRUE(window_->actionSet().layer.prepare->isEnabled());
    // It can be viewed and touched as before.
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    view().setTool(Tool::Touch);
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
    ASSERT_TRUE(view().stylus());
    EXPECT_TRUE(view().stylus()->is_in_contact);
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
    EXPECT_NE(notice().indexOf(QStringLiteral("Build its overviews to see")), -1);
    EXPECT_TRUE(noticeButton()->isVisible());
    // No other action starts it again.
    controller().rename(layer().id, QStringLiteral("Plain"));
    window_->undoStack().undo();
    EXPECT_EQ(state(), PreparationState::Stopped);
    noticeButton()->click();
    EXPECT_EQ(state(), PreparationState::Running);
    EXPECT_FALSE(noticeButton()->isVisible());
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
}

TEST_F(PreviewsTest, StayWhenPreparingFailsAndSayWhy)
{
    const QString file = map();
    ASSERT_TRUE(openPreview(file));
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    large_.finishPreparing(
        Error{ErrorCode::Unreadable, file.toStdString() + ": the disk is full; make room"});
    ASSERT_TRUE(waitFor([this] { return state() == PreparationState::Failed; }));
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_TRUE(notice().startsWith(file + QStringLiteral(": the disk is full; make room")))
        << notice().toStdString();
    EXPECT_EQ(failures.count(), 0); // no dialog in the way
    large_.finishPreparing();
    noticeButton()->click();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_FALSE(notice().contains(QStringLiteral("disk")));
}

TEST_F(PreviewsTest, AreTakenForFailedWhereWhatWasPreparedIsGone)
{
    ASSERT_TRUE(openPreview(map()));
    large_.losePrepared();
    large_.finishPreparing();
    ASSERT_TRUE(waitFor([this] { return state() == PreparationState::Failed; }));
    EXPECT_NE(notice().indexOf(QStringLiteral("its overviews are gone")), -1);
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_FALSE(controller().isBusy());
}

TEST_F(PreviewsTest, ArePreparedOneAfterTheOther)
{
    const QString first = map(QStringLiteral("first.asc"));
    const QString second = map(QStringLiteral("second.asc"));
    ASSERT_TRUE(openPreview(first));
    ASSERT_TRUE(openPreview(second));
    EXPECT_EQ(controller().preparationOf(layer(1).id).state, PreparationState::Running);
    EXPECT_EQ(controller().preparationOf(layer(0).id).state, PreparationState::Waiting);
    EXPECT_EQ(large_.begunCount(), 1);
    // The running one is stopped, and the next one starts.
    controller().stopPreparing();
    EXPECT_EQ(controller().preparationOf(layer(1).id).state, PreparationState::Stopped);
    EXPECT_EQ(controller().preparationOf(layer(0).id).state, PreparationState::Running);
    controller().prepare(layer(1).id);
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_EQ(large_.prepared(),
              (std::vector<std::string>{second.toStdString(), first.toStdString()}));
}

TEST_F(PreviewsTest, TakeWhatTheUserTellsMeanwhile)
{
    ASSERT_TRUE(openPreview(map()));
    RasterOverrides overrides;
    overrides.vertical_unit = "ft";
    const double height_m = layer().map->heightfield().sample(5, 5);
    controller().overrideGeoreferencing(layer().id, overrides);
    ASSERT_TRUE(waitFor([this] { return !controller().isBusy(); }));
    EXPECT_TRUE(layer().map->isPreview());
    EXPECT_NEAR(layer().map->heightfield().sample(5, 5), height_m * 0.3048, 1e-9);
    EXPECT_EQ(large_.begunCount(), 1); // the same samples
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_EQ(layer().map->spec().overrides, overrides);
    EXPECT_TRUE(layer().map->heightfield().isTiled());
    // Back before it was reported, that map is completed too.
    window_->undoStack().undo();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_TRUE(layer().map->spec().overrides.isEmpty());
    EXPECT_TRUE(layer().map->heightfield().isTiled());
}

TEST_F(PreviewsTest, GetBetterWhereTheFirstWasRough)
{
    large_.makeRoughPreviews();
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(waitFor([this] { return layer().map->kind() == MapKind::Preview; }));
    EXPECT_GT(layer().map->heightfield().columns(), 32U);
    EXPECT_EQ(window_->undoStack().count(), 1);
    window_->undoStack().undo();
    window_->undoStack().redo();
    EXPECT_EQ(layer().map->kind(), MapKind::Preview);
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
}

TEST_F(PreviewsTest, AreLetGoOfByTheStylusBeforeTheyGo)
{
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    view().setTool(Tool::Touch);
    const QPoint middle = view().rect().center();
    QTest::mouseMove(&view(), middle);
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
    QTest::mouseMove(&view(), middle + QPoint(5, 0));
    ASSERT_TRUE(view().stylus());
    ASSERT_TRUE(view().stylus()->is_in_contact);
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_FALSE(view().stylus() && view().stylus()->is_in_contact);
    QTest::mouseMove(&view(), middle + QPoint(10, 5));
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(10, 5));
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
}

TEST_F(PreviewsTest, StopBeingPreparedWithTheirWindow)
{
    ASSERT_TRUE(openPreview(map()));
    window_->close();
    EXPECT_FALSE(controller().isPreparing());
    ASSERT_TRUE(waitFor([this] { return large_.stoppedCount() == 1; }));
    window_.reset();
    EXPECT_TRUE(large_.prepared().empty());
}

TEST_F(PreviewsTest, TellOfTheWholeMapAndThatTheyAreNone)
{
    ASSERT_TRUE(openPreview(map()));
    const QString samples = fact(QStringLiteral("Samples"));
    const QString pixel = fact(QStringLiteral("Pixel size"));
    const QString extent = fact(QStringLiteral("Extent"));
    const QString transform = fact(QStringLiteral("Geotransform"));
    EXPECT_TRUE(samples.startsWith(QStringLiteral("620 × 410"))) << samples.toStdString();
    const LayerModel& model = *window_->datasetPanel()->model();
    EXPECT_EQ(model.index(0).data(LayerModel::SizeRole).toString(), QStringLiteral("620 × 410"));
    EXPECT_EQ(model.index(0).data(LayerModel::NoteRole).toString(), QStringLiteral("Preview"));
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    EXPECT_EQ(fact(QStringLiteral("Samples")), samples);
    EXPECT_EQ(fact(QStringLiteral("Pixel size")), pixel);
    EXPECT_EQ(fact(QStringLiteral("Extent")), extent);
    EXPECT_EQ(fact(QStringLiteral("Geotransform")), transform);
    EXPECT_EQ(model.index(0).data(LayerModel::NoteRole).toString(), QString());
}

TEST_F(PreviewsTest, MarkTheHeightsThatAreReadFromThem)
{
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    hover(view().rect().center());
    ASSERT_TRUE(waitFor([this] { return !window_->readout()->heightLabel().isEmpty(); }));
    EXPECT_TRUE(window_->readout()->heightLabel().startsWith(QStringLiteral("≈ ")));
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilWhole());
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    // The tiles are evicted and held back: coarser ones replace them.
    large_.holdTiles(true);
    large_.forgetTiles();
    hover(view().rect().center() + QPoint(3, 1));
    EXPECT_TRUE(window_->readout()->heightLabel().startsWith(QStringLiteral("≈ ")));
    // It becomes exact without further action.
    large_.holdTiles(false);
    EXPECT_TRUE(waitFor([this] {
        const QString label = window_->readout()->heightLabel();
        return !label.isEmpty() && !label.startsWith(QStringLiteral("≈ "));
    }));
}

// Unreadable tiles are reported while they are needed, and retried.
TEST_F(PreviewsTest, AreFollowedByMapsThatSayWhatCannotBeRead)
{
    large_.finishPreparing();
    window_->open(map());
    ASSERT_TRUE(waitFor([this] { return !window_->session().layers.empty(); }));
    ASSERT_TRUE(waitUntilWhole());
    large_.failTiles(true);
    large_.forgetTiles();
    OrbitCamera camera = view().camera();
    camera.distance_m *= 0.05;
    view().setCamera(camera);
    ASSERT_TRUE(waitFor([this] { return notice().contains(QStringLiteral("the disk is gone")); }));
    EXPECT_EQ(window_->readout()->detailLabel(), QStringLiteral("incomplete"));
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); })); // as far as possible
    large_.failTiles(false);
    ASSERT_TRUE(waitFor([this] { return !notice().contains(QStringLiteral("the disk is gone")); }));
    EXPECT_TRUE(waitFor(
        [this] { return window_->readout()->detailLabel().contains(QStringLiteral("detail")); }));
}

TEST_F(PreviewsTest, SayHowFarPreparingIs)
{
    ASSERT_TRUE(openPreview(map()));
    auto* status = window_->findChild<LoadStatus*>();
    ASSERT_TRUE(waitFor([status] {
        return status->isVisible() &&
               status->findChild<QLabel*>()->text().contains(QStringLiteral("37 %"));
    }));
    EXPECT_TRUE(status->findChild<QLabel*>()->text().startsWith(
        QStringLiteral("Building overviews of large.asc")));
    status->findChild<QToolButton*>(QStringLiteral("cancelLoading"))->click();
    EXPECT_FALSE(status->isVisible());
    EXPECT_EQ(state(), PreparationState::Stopped);
}

TEST_F(PreviewsTest, AreNotTakenForTheEndOfLoading)
{
    const QSignalSpy settled(window_.get(), &MainWindow::settled);
    ASSERT_TRUE(openPreview(map()));
    ASSERT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    EXPECT_EQ(settled.count(), 0);
    large_.finishPreparing();
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_FALSE(layer().map->isPreview());
}

} // namespace
} // namespace marsview
