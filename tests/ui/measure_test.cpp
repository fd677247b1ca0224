// Measuring in the window, by mouse and by keyboard.

#include "core/measure/statistics/profile_statistics.h"
#include "tests/support/run_program.h"
#include "tests/ui/map_window.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/project_files.h"
#include "tests/ui/test_map.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/picture_saver.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/measure_controller.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/overlay/measure_marks.h"
#include "ui/panels/attitudes_view.h"
#include "ui/panels/measure_list.h"
#include "ui/panels/measure_panel.h"
#include "ui/plots/hypsometry_plot.h"
#include "ui/plots/profile_plot.h"
#include "ui/plots/stereonet_plot.h"
#include "ui/project/project_controller.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QActionGroup>
#include <QApplication>
#include <QClipboard>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPointer>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTest>
#include <QUndoStack>

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace marsview {
namespace {

class MeasureTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1300, 800);
        window_->show();
        QApplication::setActiveWindow(window_.get());
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    }

    TerrainView& view() { return *window_->view(); }
    MeasureController& measuring() { return *window_->measuring(); }
    MeasurePanel& panel() { return *window_->measurePanel(); }
    void choose(MeasurementKind kind)
    {
        for (QAction* action : window_->actionSet().measure_kinds->actions()) {
            if (action->data().toInt() == static_cast<int>(kind)) {
                action->trigger();
            }
        }
        // The panel below the map makes it smaller.
        ASSERT_TRUE(QTest::qWaitFor([this] { return panel().isVisible(); }, kTimeout));
        QTest::qWait(50);
    }
    // So far from the middle of the view, in shares of its sides.
    QPoint at(double right, double down) const
    {
        const QSize size = window_->view()->size();
        return {static_cast<int>((0.5 + right) * size.width()),
                static_cast<int>((0.5 + down) * size.height())};
    }
    void click(QPoint position) { QTest::mouseClick(&view(), Qt::LeftButton, {}, position); }
    bool isMeasured()
    {
        return QTest::qWaitFor(
            [this] {
                const MeasureItem* item = measuring().current();
                return item != nullptr && measuring().outcome(item->id).result &&
                       !measuring().outcome(item->id).is_running;
            },
            kTimeout);
    }
    // Longitude and latitude on the map that a position shows.
    GeographicPoint placeAt(QPoint position)
    {
        const auto hit = view().surfaceAt(position);
        return *view().map()->georeference().toGeographic(hit->grid);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(MeasureTest, ClicksMeasureTheGeodesicBetweenTheirPlaces)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    EXPECT_EQ(view().tool(), Tool::Measure);
    const QPoint from = at(-0.15, 0.05);
    const QPoint to = at(0.1, -0.05);
    click(from);
    click(to);
    ASSERT_TRUE(isMeasured());
    const auto* distance = measuring().outcome(measuring().current()->id).as<Distance>();
    ASSERT_NE(distance, nullptr);
    // An independent path: GeographicLib on the map's sphere, between the places in the picture.
    const auto& ellipsoid = *view().map()->georeference().crs()->ellipsoid();
    const GeographicLib::Geodesic geodesic(ellipsoid.equatorial_m, 0.0);
    const GeographicPoint a = placeAt(from);
    const GeographicPoint b = placeAt(to);
    double expected_m = 0.0;
    geodesic.Inverse(a.latitude.degrees(), a.longitude.degrees(), b.latitude.degrees(),
                     b.longitude.degrees(), expected_m);
    EXPECT_NEAR(distance->geodesic_m / expected_m, 1.0, 1e-6);
    EXPECT_GT(distance->surface_m, distance->geodesic_m);
}

TEST_F(MeasureTest, ADoubleClickFinishesAndTheNextClickBeginsAnother)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    doubleClick(view(), at(0.1, 0.0));
    ASSERT_NE(measuring().current(), nullptr);
    EXPECT_TRUE(measuring().current()->is_finished);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
    click(at(0.0, 0.1));
    EXPECT_EQ(measuring().state().items.size(), 2U);
}

TEST_F(MeasureTest, DraggingPansAndDraggingAPointMovesIt)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    const OrbitCamera before = view().camera();
    QTest::mousePress(&view(), Qt::LeftButton, {}, at(0.0, 0.1));
    for (const double way : {0.02, 0.05, 0.08}) {
        QMouseEvent move(QEvent::MouseMove, at(way, 0.1), view().mapToGlobal(at(way, 0.1)),
                         Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &move);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.08, 0.1));
    EXPECT_FALSE(view().camera() == before);
    EXPECT_TRUE(measuring().state().items.empty()) << "a drag is no click";

    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    measuring().finish();
    const OrbitCamera after = view().camera();
    const int steps = window_->undoStack().index();
    const MeasuredVertex old = measuring().current()->vertices[1];
    QTest::mousePress(&view(), Qt::LeftButton, {}, at(0.1, 0.0));
    for (const double down : {0.02, 0.06}) {
        QMouseEvent move(QEvent::MouseMove, at(0.1, down), view().mapToGlobal(at(0.1, down)),
                         Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &move);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.1, 0.06));
    EXPECT_TRUE(view().camera() == after);
    EXPECT_FALSE(measuring().current()->vertices[1] == old);
    EXPECT_EQ(window_->undoStack().index(), steps + 1) << "a drag is one step";
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Move Point"));
    window_->undoStack().undo();
    EXPECT_TRUE(measuring().current()->vertices[1] == old);
}

// A click on a vertex of another line snaps to it instead of selecting that line.
TEST_F(MeasureTest, ALineBeginsAtAVertexOfAnotherOne)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    measuring().finish();
    const std::uint32_t first = measuring().current()->id;
    const auto vertices = measuring().current()->vertices;
    click(at(-0.2, -0.2));
    click(at(0.2, -0.2));
    measuring().finish();
    const std::uint32_t second = measuring().current()->id;

    click(at(-0.1, 0.0) + QPoint(4, -3));
    ASSERT_EQ(measuring().state().items.size(), 3U);
    EXPECT_EQ(measuring().current()->vertices.front(), vertices[0]);
    click(at(0.1, 0.0) + QPoint(-4, 3));
    measuring().finish();
    ASSERT_EQ(measuring().current()->vertices.size(), 2U);
    EXPECT_EQ(measuring().current()->vertices[1], vertices[1]);
    EXPECT_EQ(measuring().itemOf(first)->vertices, vertices);

    // A drag there pans. The selected one's points are its handles.
    measuring().select(second);
    const OrbitCamera before = view().camera();
    const auto drag = [this](QPoint from, QPoint to) {
        QTest::mousePress(&view(), Qt::LeftButton, {}, from);
        for (const double share : {0.5, 1.0}) {
            const QPoint on = from + (to - from) * share;
            QMouseEvent move(QEvent::MouseMove, on, view().mapToGlobal(on), Qt::NoButton,
                             Qt::LeftButton, Qt::NoModifier);
            QApplication::sendEvent(&view(), &move);
        }
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
    };
    const QPoint handle = at(-0.2, -0.2);
    drag(handle, handle + QPoint(0, 30));
    EXPECT_TRUE(view().camera() == before);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Move Point"));
    drag(at(-0.1, 0.0), at(-0.1, 0.1));
    EXPECT_FALSE(view().camera() == before);
    EXPECT_EQ(measuring().itemOf(first)->vertices, vertices);
    EXPECT_EQ(measuring().currentId(), second);
    EXPECT_EQ(measuring().state().items.size(), 3U);
}

// Without a tool that places points.
TEST_F(MeasureTest, AClickSelectsAMeasurementByItsPointsAndItsLine)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.1, 0.1));
    click(at(0.1, 0.1));
    measuring().finish();
    const std::uint32_t first = measuring().current()->id;
    click(at(-0.1, -0.1));
    click(at(0.1, -0.1));
    measuring().finish();
    const std::uint32_t second = measuring().current()->id;
    view().setTool(Tool::Pan);
    click(at(0.1, 0.1) + QPoint(3, 3));
    EXPECT_EQ(measuring().currentId(), first);
    click(at(0.0, -0.1) + QPoint(0, 4));
    EXPECT_EQ(measuring().currentId(), second);
    click(at(0.05, 0.1));
    EXPECT_EQ(measuring().currentId(), first);
    click(at(0.0, 0.0));
    EXPECT_EQ(measuring().currentId(), first) << "there is none";
    EXPECT_EQ(measuring().state().items.size(), 2U);
}

TEST_F(MeasureTest, BackspaceAfterADragRemovesThePointThatWasDragged)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    for (const double right : {-0.2, 0.0, 0.2}) {
        click(at(right, 0.0));
    }
    const auto vertices = measuring().current()->vertices;
    ASSERT_EQ(vertices.size(), 3U);
    QTest::mouseMove(&view(), at(0.0, 0.0));
    QTest::mousePress(&view(), Qt::LeftButton, {}, at(0.0, 0.0));
    for (const double down : {0.05, 0.1}) {
        QMouseEvent move(QEvent::MouseMove, at(0.0, down), view().mapToGlobal(at(0.0, down)),
                         Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &move);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.0, 0.1));
    ASSERT_FALSE(measuring().current()->vertices[1] == vertices[1]);
    QTest::keyClick(&view(), Qt::Key_Backspace);
    ASSERT_EQ(measuring().current()->vertices.size(), 2U);
    EXPECT_TRUE(measuring().current()->vertices[0] == vertices[0]);
    EXPECT_TRUE(measuring().current()->vertices[1] == vertices[2]);
}

TEST_F(MeasureTest, ADragOfALineInsertsAPoint)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Profile));
    click(at(-0.15, 0.0));
    click(at(0.15, 0.0));
    measuring().finish();
    QTest::qWait(0);
    const auto middle =
        view().positionOf(*view().map()->georeference().toGrid(placeAt(at(0.0, 0.0))));
    ASSERT_TRUE(middle);
    // The line runs through the map's middle row of the picture nearly; look for it.
    int grabbed_at = -1;
    for (int y = -40; y <= 40 && grabbed_at < 0; y += 4) {
        const QPoint place = middle->toPoint() + QPoint(0, y);
        QTest::mousePress(&view(), Qt::LeftButton, {}, place);
        if (measuring().current()->vertices.size() == 3) {
            grabbed_at = y;
        }
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, place);
        if (grabbed_at < 0 && measuring().state().items.size() > 1) {
            window_->undoStack().undo(); // the click began another one
            measuring().select(1);
        }
    }
    EXPECT_GE(grabbed_at, -40);
    ASSERT_EQ(measuring().current()->vertices.size(), 3U);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Insert Point"));
}

TEST_F(MeasureTest, TheKeyboardPlacesRemovesAndFinishes)
{
    QTest::keyClick(&view(), Qt::Key_M);
    EXPECT_EQ(view().tool(), Tool::Measure);
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    view().setFocus();
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view(), &leave);
    ASSERT_TRUE(view().isCrosshairShown());
    QTest::keyClick(&view(), Qt::Key_Return);
    QTest::keyClick(&view(), Qt::Key_Right);
    ASSERT_TRUE(QTest::qWaitFor([this] { return !view().isMoving(); }, kTimeout));
    QTest::keyClick(&view(), Qt::Key_Return);
    ASSERT_NE(measuring().current(), nullptr);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
    QTest::keyClick(&view(), Qt::Key_Backspace);
    EXPECT_EQ(measuring().current()->vertices.size(), 1U);
    QTest::keyClick(&view(), Qt::Key_Return);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
    QTest::keyClick(&view(), Qt::Key_Return); // again in the same place
    EXPECT_TRUE(measuring().current()->is_finished);
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_EQ(measuring().current(), nullptr) << "deselects";
    EXPECT_EQ(measuring().state().items.size(), 1U);
}

// The panel that the tool opened goes with it, unless it has something to show or was there before.
TEST_F(MeasureTest, AnEmptyPanelClosesWithItsTool)
{
    QDockWidget& dock = *window_->docks()->measurements();
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    EXPECT_TRUE(dock.isVisible());
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Pan))->trigger();
    EXPECT_FALSE(dock.isVisible());
    dock.show(); // by the user
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Pan))->trigger();
    EXPECT_TRUE(dock.isVisible());
    dock.hide();
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Return);
    ASSERT_EQ(measuring().state().items.size(), 1U);
    window_->actionSet().tools->actions().at(static_cast<int>(Tool::Pan))->trigger();
    EXPECT_TRUE(dock.isVisible());
}

// A hidden layer of another body may be the selected one.
TEST_F(MeasureTest, TheKeyboardMeasuresTheLayerUnderTheCrosshair)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    SessionController& controller = window_->controller();
    const LayerId moon = controller.session().layers.front().id;
    const LayerId mars = controller.session().layers.back().id;
    controller.activate(mars);
    ASSERT_EQ(controller.session().active, mars);
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    view().setFocus();
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view(), &leave);
    ASSERT_TRUE(view().isCrosshairShown());
    QTest::keyClick(&view(), Qt::Key_Return);
    ASSERT_NE(measuring().current(), nullptr);
    EXPECT_EQ(measuring().current()->layer, moon);
}

TEST_F(MeasureTest, TheProfileShowsTheElevationsOfItsPlaces)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Profile));
    click(at(-0.15, 0.0));
    click(at(0.15, 0.02));
    ASSERT_TRUE(isMeasured());
    ASSERT_EQ(panel().plot()->curves().size(), 1U);
    const ProfileCurve& curve = panel().plot()->curves().front();
    ASSERT_GT(curve.distance_m.size(), 10U);
    const auto hit = view().surfaceAt(at(0.15, 0.02));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(curve.elevation_m.back(), hit->height_m, 0.01);
    // Its cursor is marked on the map, where the line is.
    Q_EMIT panel().plot()->cursorMoved(curve.distance_m.back());
    const auto cursor = measuring().profileCursorPlace();
    ASSERT_TRUE(cursor);
    EXPECT_NEAR(cursor->x(), at(0.15, 0.02).x(), 2.0);
    EXPECT_NEAR(cursor->y(), at(0.15, 0.02).y(), 2.0);
}

TEST_F(MeasureTest, ResultsFollowTheLayersOverrides)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Slope));
    click(at(0.05, 0.05));
    ASSERT_TRUE(isMeasured());
    const std::uint32_t id = measuring().current()->id;
    const auto elevation = [&] {
        return measuring().outcome(id).as<std::vector<TerrainSlope>>()->front().elevation_m;
    };
    const double before_m = elevation();
    RasterOverrides overrides = window_->session().layers.front().map->spec().overrides;
    overrides.offset = 1000.0;
    window_->controller().overrideGeoreferencing(window_->session().active, overrides);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return isMeasured() && std::abs(elevation() - before_m - 1000.0) < 0.01; }, kTimeout))
        << before_m << " " << elevation();
}

TEST_F(MeasureTest, ThePanelWidensNoSmallWindow)
{
    constexpr int kWidth = 700; // 1050 pixels at 150 %
    window_->resize(kWidth, 467);
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Profile));
    click(at(-0.05, 0.0));
    click(at(0.05, 0.0));
    ASSERT_TRUE(isMeasured());
    EXPECT_EQ(window_->width(), kWidth);
    EXPECT_LE(window_->minimumSizeHint().width(), kWidth);
}

TEST_F(MeasureTest, TheListNamesShowsAndRemoves)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Attitude));
    click(at(-0.05, 0.0));
    const auto* note = panel().findChild<QLabel*>(QStringLiteral("measureNote"));
    const auto* results = panel().findChild<QTableWidget*>(QStringLiteral("measureResults"));
    EXPECT_TRUE(results->isHidden()) << "an empty table";
    measuring().rename(measuring().state().current, QStringLiteral("a <i>b</i> & c"));
    const auto labels = panel().findChildren<QLabel*>();
    const auto title = std::find_if(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->text() == QStringLiteral("a <i>b</i> & c");
    });
    ASSERT_NE(title, labels.end());
    EXPECT_EQ((*title)->textFormat(), Qt::PlainText);
    EXPECT_EQ(note->text(),
              QStringLiteral("Click to place 2 more points; Backspace removes the last one."));
    click(at(0.05, 0.0));
    click(at(0.0, 0.08));
    ASSERT_TRUE(isMeasured());
    const auto* hint = panel().findChild<QLabel*>(QStringLiteral("measureHint"));
    EXPECT_EQ(hint->text(), QStringLiteral("Click to add a point, double-click to finish. "
                                           "Backspace removes the last point."));
    measuring().finish();
    EXPECT_EQ(hint->text(), QStringLiteral("Drag a point to move it."));
    EXPECT_FALSE(results->isHidden());
    ASSERT_EQ(panel().list()->rowCount(), 1);
    panel().list()->setTextAt(0, MeasureList::NameColumn, QStringLiteral("Layer of rock"));
    EXPECT_EQ(measuring().current()->name, QStringLiteral("Layer of rock"));
    panel().copyResults();
    EXPECT_TRUE(QGuiApplication::clipboard()->text().contains(QStringLiteral("Dip\t")));
    window_->actionSet().remove_measurement->trigger();
    EXPECT_EQ(panel().list()->rowCount(), 0);
    window_->undoStack().undo();
    EXPECT_EQ(panel().list()->rowCount(), 1);
    EXPECT_EQ(measuring().state().items.front().name, QStringLiteral("Layer of rock"));
}

// Three points lie exactly on a plane and on a circle: their residuals of 0 are no errors.
TEST_F(MeasureTest, ThreePointsHaveNoErrors)
{
    const QString none = QStringLiteral("\nErrors\tthree points: no error estimate");
    for (const MeasurementKind kind : {MeasurementKind::Attitude, MeasurementKind::Crater}) {
        measuring().begin(kind);
        for (const GridPoint& place : {GridPoint{10.0, 10.0}, {20.0, 10.0}, {15.0, 18.0}}) {
            measuring().addPointAt(place);
        }
        ASSERT_TRUE(isMeasured());
        EXPECT_TRUE(panel().resultsText().contains(none)) << qPrintable(panel().resultsText());
        EXPECT_FALSE(panel().resultsText().contains(QStringLiteral("RMS")));
        EXPECT_FALSE(panel().resultsText().contains(QStringLiteral("error (95 %)")));
        measuring().addPointAt({15.0, 5.0});
        ASSERT_TRUE(isMeasured());
        EXPECT_FALSE(panel().resultsText().contains(none));
        EXPECT_TRUE(panel().resultsText().contains(QStringLiteral("\nRMS distance from the ")));
        EXPECT_EQ(panel().resultsText().contains(QStringLiteral("\nDip error (95 %)\t")),
                  kind == MeasurementKind::Attitude);
        measuring().finish();
    }
}

TEST_F(MeasureTest, ProfilesThatAreSelectedTogetherAreDrawnOverEachOther)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Profile));
    for (const double row : {10.0, 20.0}) {
        measuring().begin(MeasurementKind::Profile);
        measuring().addPointAt({10.0, row});
        measuring().addPointAt({10.0 + row, row});
        measuring().finish();
        ASSERT_TRUE(isMeasured());
    }
    const std::uint32_t first = measuring().state().items.front().id;
    const std::uint32_t second = measuring().state().items.back().id;
    const auto lengths = [&](std::uint32_t id) {
        return measuring().outcome(id).as<Profile>()->points.back().distance_m;
    };
    const auto& curves = panel().plot()->curves();
    ASSERT_EQ(curves.size(), 1U);
    panel().list()->selectAll();
    ASSERT_TRUE(QTest::qWaitFor([&] { return curves.size() == 2; }, kTimeout));
    EXPECT_EQ(curves[0].name, measuring().itemOf(second)->name) << "the current one comes first";
    EXPECT_EQ(curves[1].name, measuring().itemOf(first)->name);
    EXPECT_EQ(curves[0].distance_m.back(), lengths(second));
    EXPECT_EQ(curves[1].distance_m.back(), lengths(first));
    EXPECT_NE(curves[0].color, curves[1].color);
    measuring().setColors({first}, Rgb8{10, 20, 30});
    EXPECT_TRUE(QTest::qWaitFor([&] { return curves[1].color == QColor(10, 20, 30); }, kTimeout));
    measuring().select(first);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return !curves.empty() && curves[0].name == measuring().itemOf(first)->name; },
        kTimeout));
    panel().list()->selectRow(0);
    EXPECT_TRUE(QTest::qWaitFor([&] { return curves.size() == 1; }, kTimeout));
}

TEST_F(MeasureTest, AFailureIsNamedInTheListWithItsReason)
{
    measuring().begin(MeasurementKind::Attitude);
    for (const GridPoint& place : {GridPoint{10.0, 10.0}, {14.0, 10.0}, {18.0, 10.0}}) {
        measuring().addPointAt(place);
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    ASSERT_FALSE(measuring().outcome(measuring().current()->id).result->values);
    const QAbstractItemModel& list = *panel().list()->model();
    const QModelIndex cell = list.index(0, MeasureList::ResultColumn);
    EXPECT_EQ(cell.data().toString(), QStringLiteral("no result"));
    const QString reason = cell.data(Qt::ToolTipRole).toString();
    EXPECT_TRUE(reason.contains(QStringLiteral("nearly on a line"))) << qPrintable(reason);
    const auto* note = panel().findChild<QLabel*>(QStringLiteral("measureNote"));
    EXPECT_EQ(note->text(), reason);
}

TEST_F(MeasureTest, AttitudesAreShownTogetherAndSaved)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Attitude));
    for (const double down : {-0.15, 0.12}) {
        click(at(-0.08, down));
        click(at(0.08, down));
        click(at(0.0, down + 0.09));
        measuring().finish();
        ASSERT_TRUE(isMeasured());
    }
    AttitudesView& view = *panel().attitudes();
    EXPECT_TRUE(view.isVisible());
    const std::vector<NetPlane>& planes = view.plot()->planes();
    ASSERT_EQ(planes.size(), 2U);
    // Both lie on one slope, which is a plane.
    EXPECT_NEAR(planes[0].plane.strike_deg, planes[1].plane.strike_deg, 2.0);
    ASSERT_TRUE(view.plot()->statistics());
    EXPECT_NEAR(view.plot()->statistics()->mean.dip_deg, planes[0].plane.dip_deg, 0.5);
    EXPECT_TRUE(view.statisticsText().contains(QStringLiteral("Mean plane")));
    QTest::mouseClick(view.plot(), Qt::LeftButton, {},
                      view.plot()->placeOf(planes[0].id)->toPoint());
    const QString path = maps_.path(QStringLiteral("attitudes.csv"));
    ASSERT_TRUE(view.save(path));
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll().count('\n'), 3);
    measuring().begin(MeasurementKind::Distance);
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    EXPECT_FALSE(view.isVisible());
}

// 2026-11: a message box said why.
TEST_F(MeasureTest, FailuresOfSavingAreReportedLikeAllOthers)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Profile));
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    ASSERT_TRUE(isMeasured());
    const QSignalSpy failures(window_.get(), &MainWindow::openFailed);
    const QString file = maps_.path(QStringLiteral("none/file.csv"));
    int count = 0;
    for (const auto& ask : {std::function([this] { panel().saveTable(); }),
                            std::function([this] { panel().saveProfile(); }),
                            std::function([this] { panel().attitudes()->askFile(); })}) {
        ask();
        const QPointer<QFileDialog> dialog = panel().findChild<QFileDialog*>();
        ASSERT_NE(dialog, nullptr);
        Q_EMIT dialog->fileSelected(file);
        dialog->reject();
        ASSERT_TRUE(QTest::qWaitFor([&dialog] { return dialog == nullptr; }, kTimeout));
        EXPECT_EQ(panel().findChild<QMessageBox*>(), nullptr);
        ASSERT_EQ(failures.count(), ++count);
        EXPECT_TRUE(failures.last()[0].toString().contains(file));
    }
}

TEST_F(MeasureTest, AnAreaHasItsHypsometry)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Area));
    HypsometryPlot& plot = *window_->measurePanel()->hypsometry();
    for (const QPoint& corner : {at(-0.2, -0.15), at(0.2, -0.15), at(0.15, 0.2)}) {
        click(corner);
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    EXPECT_TRUE(plot.isVisible());
    EXPECT_FALSE(window_->measurePanel()->plot()->isVisible());
    const auto* area = measuring().outcome(measuring().current()->id).as<TerrainArea>();
    ASSERT_NE(area, nullptr);
    EXPECT_NEAR(plot.classes().totalM2(), area->covered_m2, 1e-9 * area->covered_m2);
    EXPECT_GT(plot.classes().area_m2.size(), 8U);
    EXPECT_LE(plot.classes().area_m2.size(), 40U);
    EXPECT_EQ(plot.cursorText(), QString());
    plot.setCursorAt(-1e6);
    EXPECT_TRUE(plot.cursorText().startsWith(QStringLiteral("100.0 %")))
        << qPrintable(plot.cursorText());
    QTest::keyClick(&plot, Qt::Key_End);
    EXPECT_TRUE(plot.cursorText().startsWith(QStringLiteral("0.0 %")))
        << qPrintable(plot.cursorText());
    for (const char* name : {"area.svg", "area.pdf", "area.png"}) {
        const QString file = maps_.path(QString::fromLatin1(name));
        EXPECT_TRUE(plot.savePicture(file));
        EXPECT_GT(QFileInfo(file).size(), 2000) << name;
    }
    measuring().select(0);
    EXPECT_FALSE(plot.isVisible());
}

TEST_F(MeasureTest, PointsCanBeTypedAsCoordinates)
{
    for (const char* typed : {"18.5 N 12 E", "14.25 N 17.5 E"}) {
        window_->actionSet().add_point->trigger();
        auto* dialog = window_->findChild<GoToDialog*>();
        ASSERT_NE(dialog, nullptr);
        EXPECT_EQ(dialog->windowTitle(), QStringLiteral("Add Point"));
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        field->setText(QString::fromLatin1(typed));
        QTest::keyClick(field, Qt::Key_Return);
        ASSERT_TRUE(QTest::qWaitFor([this] { return window_->findChild<GoToDialog*>() == nullptr; },
                                    kTimeout));
    }
    EXPECT_EQ(view().tool(), Tool::Measure);
    const MeasureItem* item = measuring().current();
    ASSERT_NE(item, nullptr);
    ASSERT_EQ(item->vertices.size(), 2U) << "once for each time";
    const auto& last = std::get<GeographicPoint>(item->vertices.back());
    EXPECT_NEAR(last.latitude.degrees(), 14.25, 1e-9);
    EXPECT_NEAR(last.longitude.degrees(), 17.5, 1e-9);
    EXPECT_EQ(item->layer, window_->session().active);
    ASSERT_TRUE(isMeasured());
    window_->undoStack().undo();
    EXPECT_EQ(measuring().current()->vertices.size(), 1U);
}

// The elevation of the map is 20 m for each of its columns of 0.25°, from −300 m at 10.125° E.
TEST_F(MeasureTest, ResultsListThePointsInTheFormatOfThePreferences)
{
    measuring().begin(MeasurementKind::Profile);
    const Georeference& georeference = view().map()->georeference();
    for (const auto& [longitude, latitude] : {std::pair(12.0, 18.5), {17.5, 14.25}}) {
        measuring().addPointAt(*georeference.toGrid(
            GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)}));
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    EXPECT_TRUE(
        panel().resultsText().endsWith(QStringLiteral("\nPoint 1\t18.50° N, 12.00° E, −150.0 m"
                                                      "\nPoint 2\t14.25° N, 17.50° E, 290.0 m")))
        << qPrintable(panel().resultsText());
    panel().copyResults();
    EXPECT_EQ(QGuiApplication::clipboard()->text(), panel().resultsText());
    Preferences preferences = window_->preferences();
    preferences.coordinates.angles = AngleNotation::DegreesMinutesSeconds;
    preferences.height_unit = HeightUnit::Feet;
    window_->setPreferences(preferences);
    EXPECT_TRUE(panel().resultsText().contains(QStringLiteral("\nPoint 2\t14° 15′ ")));
    EXPECT_TRUE(panel().resultsText().endsWith(QStringLiteral(", 951.4 ft"))) << "290 / 0.3048";
    // In files every number is in full.
    const QString path = maps_.path(QStringLiteral("table.csv"));
    ASSERT_EQ(panel().writeTable(path), QString());
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QString table = QString::fromUtf8(file.readAll());
    const QString points = table.section(QLatin1Char('\n'), 1).section(QLatin1Char(','), -1);
    const QStringList last =
        points.trimmed().split(QStringLiteral("; ")).last().split(QLatin1Char(' '));
    ASSERT_EQ(last.size(), 3) << qPrintable(table);
    EXPECT_NEAR(last[0].toDouble(), 17.5, 1e-9);
    EXPECT_NEAR(last[1].toDouble(), 14.25, 1e-9);
    EXPECT_NEAR(last[2].toDouble(), 290.0, 1e-6);
    // A crater has its center.
    measuring().begin(MeasurementKind::Crater);
    for (const auto& [longitude, latitude] :
         {std::pair(14.0, 18.0), {16.0, 18.0}, {15.0, 17.1}, {15.0, 18.9}}) {
        measuring().addPointAt(*georeference.toGrid(
            GeographicPoint{Angle::degrees(longitude), Angle::degrees(latitude)}));
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    ASSERT_EQ(panel().writeTable(path), QString());
    file.close();
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QString all = QString::fromUtf8(file.readAll());
    const auto* crater = measuring().outcome(measuring().current()->id).as<Crater>();
    ASSERT_NE(crater, nullptr);
    EXPECT_EQ(
        all.section(QStringLiteral("; depth_m "), 1).section(QLatin1Char(';'), 0, 0).toDouble(),
        crater->depth_m)
        << qPrintable(all);
    EXPECT_TRUE(panel().resultsText().contains(QStringLiteral("\nCenter\t18° 00′ ")))
        << qPrintable(panel().resultsText());
    EXPECT_TRUE(panel().resultsText().contains(QStringLiteral("\nPoint 4\t18° 54′ ")));
}

TEST_F(MeasureTest, CratersInAnAreaAreSavedAsACount)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Crater));
    for (const QPoint& point : {at(-0.03, 0.0), at(0.03, 0.0), at(0.0, 0.05)}) {
        click(point);
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    const QString path = maps_.path(QStringLiteral("count.scc"));
    EXPECT_TRUE(panel().writeTable(path).contains(QStringLiteral("needs the area")));
    EXPECT_FALSE(QFile::exists(path));
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Area));
    for (const QPoint& point : {at(-0.2, -0.15), at(0.2, -0.15), at(0.2, 0.2), at(-0.2, 0.2)}) {
        click(point);
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    EXPECT_EQ(panel().writeTable(path), QString());
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_TRUE(file.readAll().contains("\ncrater = {diam, fraction, lon, lat"));
    EXPECT_EQ(panel().writeTable(maps_.path(QStringLiteral("count.diam"))), QString());
    EXPECT_NE(panel().writeTable(maps_.path(QStringLiteral("none/table.csv"))), QString());
}

TEST_F(MeasureTest, NotesAndColorsAreStepsOfUndoAndPartOfTheProject)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    const std::uint32_t id = measuring().current()->id;
    panel().list()->setTextAt(0, MeasureList::NoteColumn, QStringLiteral("a fault"));
    measuring().setColor(id, Rgb8{255, 0, 0});
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    const auto is_red_at = [this](QPoint position) {
        const QColor seen = view().terrainPicture().pixelColor(position);
        return seen.red() > 200 && seen.green() < 80 && seen.blue() < 80;
    };
    const std::vector<DrawnHandle> handles = measuring().handles();
    ASSERT_EQ(handles.size(), 2U);
    const QPointF between = 0.5 * (handles[0].place + handles[1].place);
    EXPECT_TRUE(is_red_at((0.7 * between + 0.3 * handles[0].place).toPoint()));
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Color of Distance 1"));
    const std::vector<ProjectMeasurement> saved = measuring().saved();
    ASSERT_EQ(saved.size(), 1U);
    EXPECT_EQ(saved.front().note, "a fault");
    EXPECT_EQ(saved.front().color, (Rgb8{255, 0, 0}));
    measuring().open(saved, projectOrder(window_->session()));
    EXPECT_EQ(measuring().saved(), saved);
    EXPECT_EQ(panel().list()->textAt(0, MeasureList::NoteColumn), QStringLiteral("a fault"));
}

TEST_F(MeasureTest, TheListSortsResultsByTheirSize)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    for (const auto& [half, down] : {std::pair(0.02, -0.1), {0.2, 0.0}, {0.1, 0.1}}) {
        click(at(-half, down));
        click(at(half, down));
        measuring().finish();
        ASSERT_TRUE(isMeasured());
    }
    const auto names = [this] {
        QStringList ends;
        for (int i = 0; i < panel().list()->rowCount(); ++i) {
            ends.append(panel().list()->textAt(i, MeasureList::NameColumn).last(1));
        }
        return ends.join(QLatin1Char(' '));
    };
    EXPECT_EQ(names(), QStringLiteral("1 2 3"));
    panel().list()->sortByColumn(MeasureList::ResultColumn, Qt::DescendingOrder);
    EXPECT_EQ(names(), QStringLiteral("2 3 1"));
    // A row stands for its measurement wherever it is.
    panel().list()->selectRow(0);
    EXPECT_TRUE(measuring().current()->name.endsWith(QLatin1Char('2')));
    panel().list()->setTextAt(0, MeasureList::NameColumn, QStringLiteral("Rim 0"));
    EXPECT_EQ(measuring().current()->name, QStringLiteral("Rim 0"));
    EXPECT_EQ(names(), QStringLiteral("0 3 1"));
}

// A label in the corner of the window would stand for a line that is somewhere else.
TEST_F(MeasureTest, ALabelIsShownOnlyBesideItsPlaceInThePicture)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.1, 0.0));
    click(at(0.1, 0.0));
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    const MeasureMarks& marks = *window_->findChild<MeasureMarks*>();
    const std::vector<QRectF> labels = marks.labelBoxes();
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_TRUE(QRectF(view().rect()).contains(labels.front()));
    const QPointF place = *measuring().labelPlace(measuring().current()->id);
    EXPECT_TRUE(labels.front().adjusted(-15.0, -15.0, 15.0, 15.0).contains(place));
    OrbitCamera camera = view().camera();
    camera.target.x -= 0.2 * camera.distance_m;
    camera.target.y += 0.2 * camera.distance_m;
    camera.distance_m *= 0.1;
    view().setCamera(camera);
    const auto moved = measuring().labelPlace(measuring().current()->id);
    ASSERT_FALSE(moved && QRectF(view().rect()).contains(*moved));
    EXPECT_TRUE(marks.labelBoxes().empty());
}

// Its line, its points and its label, in a picture twice as large as the view.
TEST_F(MeasureTest, ASavedPictureHasTheMeasurement)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    const QPoint from = at(-0.15, 0.05);
    const QPoint to = at(0.1, -0.05);
    click(from);
    click(to);
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    auto* saver = window_->findChild<PictureSaver*>();
    ASSERT_NE(saver, nullptr);
    const QSize size = 2 * QSize(view().viewport().width, view().viewport().height);
    const auto picture = [&](bool has_labels) {
        const QString file = maps_.path(QStringLiteral("measured.png"));
        saver->save(
            file, view().camera(),
            {.size = size, .has_legend = false, .has_scale = false, .has_labels = has_labels});
        EXPECT_TRUE(QTest::qWaitFor([&] { return !saver->isSaving(); }, kTimeout));
        return QImage(file);
    };
    const QImage with = picture(true);
    const QImage without = picture(false);
    const auto differs = [&](QPointF place) {
        const QPoint pixel = (2.0 * place).toPoint();
        return with.pixel(pixel) != without.pixel(pixel);
    };
    EXPECT_TRUE(differs(from));
    EXPECT_TRUE(differs(to));
    EXPECT_TRUE(differs(0.5 * (QPointF(from) + QPointF(to))));
    // The label lies to the upper right of the last point.
    EXPECT_TRUE(differs(QPointF(to) + QPointF(25.0, -18.0)));
    EXPECT_FALSE(differs(QPointF(from) + QPointF(-30.0, 30.0)));
}

// Saved, closed, and opened in another window: the same points on the same layer, measured again.
TEST_F(MeasureTest, AProjectKeepsTheMeasurements)
{
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Distance));
    click(at(-0.15, 0.05));
    click(at(0.1, -0.05));
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    measuring().rename(measuring().current()->id, QStringLiteral("Rim “north”"));
    const MeasureItem item = *measuring().current();
    const double length_m = measuring().outcome(item.id).as<Distance>()->geodesic_m;
    ASSERT_NO_FATAL_FAILURE(choose(MeasurementKind::Attitude));
    for (const QPoint place : {at(-0.05, 0.1), at(0.05, 0.12), at(0.0, 0.2)}) {
        click(place);
    }
    measuring().finish();
    ASSERT_TRUE(isMeasured());
    const double dip_deg = measuring().outcome(measuring().current()->id).as<Attitude>()->dip_deg;
    ASSERT_TRUE(window_->isWindowModified());
    const QString file = maps_.path(QStringLiteral("measured.mvproj"));
    ASSERT_TRUE(saveProject(window_->commands().project, file));
    EXPECT_FALSE(window_->isWindowModified());
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return !window_->commands().project.isWriting(); }, kTimeout));
    // For other programs, next to it.
    const std::string beside =
        maps_.path(QStringLiteral("measured-measurements.gpkg")).toStdString();
    const std::string layers = test::runTool({"ogrinfo", "-ro", "-q", "-geom=NO", "-al", beside});
    EXPECT_NE(layers.find("name (String) = Rim “north”"), std::string::npos) << layers;
    EXPECT_NE(layers.find("dip_deg (Real) = "), std::string::npos) << layers;

    window_ = std::make_unique<MainWindow>(testWindowOptions());
    window_->resize(1300, 800);
    window_->show();
    window_->open(file);
    ASSERT_TRUE(QTest::qWaitFor(
        [this] { return !window_->controller().isBusy() && !window_->session().layers.empty(); },
        kTimeout));
    ASSERT_EQ(measuring().state().items.size(), 2U);
    const MeasureItem& again = measuring().state().items.front();
    EXPECT_EQ(again.name, item.name);
    EXPECT_EQ(again.kind, item.kind);
    EXPECT_EQ(again.time, item.time);
    EXPECT_TRUE(again.is_finished);
    ASSERT_EQ(again.vertices.size(), item.vertices.size());
    EXPECT_NE(measuring().layerOf(again), nullptr);
    const std::uint32_t first = again.id;
    const std::uint32_t last = measuring().state().items.back().id;
    for (const std::uint32_t id : {first, last}) {
        measuring().select(id);
        ASSERT_TRUE(isMeasured()) << id;
    }
    EXPECT_NEAR(measuring().outcome(first).as<Distance>()->geodesic_m / length_m, 1.0, 1e-12);
    EXPECT_NEAR(measuring().outcome(last).as<Attitude>()->dip_deg, dip_deg, 1e-9);
    EXPECT_FALSE(window_->isWindowModified());

    measuring().remove(last);
    EXPECT_TRUE(window_->isWindowModified());
    window_->undoStack().undo();
    EXPECT_FALSE(window_->isWindowModified());
    window_->commands().project.startNew();
    EXPECT_TRUE(measuring().state().items.empty());
}

} // namespace
} // namespace marsview
