// Measuring, annotating, vector files and the graticule on the globe; what a project keeps of it.
#include "tests/support/run_program.h"
#include "tests/ui/globe/globe_window.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/project_files.h"
#include "ui/commands/map_menu.h"
#include "ui/commands/vector_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/dialogs/place_dialog.h"
#include "ui/globe/globe_labels.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/project/project_controller.h"

#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QLineEdit>
#include <QLineF>
#include <QMenu>
#include <QTest>
#include <QUndoStack>

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace marsview {
namespace {

class GlobeDrawingTest : public GlobeTest {
protected:
    MeasureController& measuring() { return *window_->measuring(); }
    AnnotationController& annotating() { return *window_->annotating(); }
    // So far from the middle of the globe, in shares of its sides.
    QPoint at(double right, double down)
    {
        return {static_cast<int>((0.5 + right) * globe().width()),
                static_cast<int>((0.5 + down) * globe().height())};
    }
    void click(QPoint position) { QTest::mouseClick(&globe(), Qt::LeftButton, {}, position); }
    // From straight above.
    void lookAt(double longitude, double latitude, double distance_m)
    {
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude),
                                      .latitude = Angle::degrees(latitude)},
                           .distance_m = distance_m});
    }
    bool isMeasured(std::uint32_t id)
    {
        return waitFor([this, id] {
            const MeasureOutcome& outcome = measuring().outcome(id);
            return outcome.result && !outcome.is_running;
        });
    }
    static GeographicPoint placeOf(const DrawnVertex& vertex)
    {
        return std::get<GeographicPoint>(vertex);
    }
    QImage picture()
    {
        EXPECT_TRUE(waitFor([this] { return globe().isPictureComplete(); }));
        QCoreApplication::processEvents();
        return globe().grabFramebuffer();
    }
    static int differing(const QImage& a, const QImage& b)
    {
        EXPECT_EQ(a.size(), b.size());
        int count = a.size() == b.size() ? 0 : -1;
        for (int y = 0; count >= 0 && y < a.height(); ++y) {
            for (int x = 0; x < a.width(); ++x) {
                count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
            }
        }
        return count;
    }
};

// Over 180°, by clicks; the flat map and GeographicLib have the same numbers for the same places.
TEST_F(GlobeDrawingTest, ClicksMeasureWhatTheFlatMapMeasures)
{
    ASSERT_TRUE(showGlobe());
    lookAt(179.8, 12.0, 3e6);
    measuring().begin(MeasurementKind::Distance);
    EXPECT_EQ(view().tool(), Tool::Measure);
    ASSERT_TRUE(waitFor([this] { return window_->measurePanel() != nullptr; }));
    QCoreApplication::processEvents(); // the panel makes the globe smaller
    const GeographicPoint from = placeAt(at(-0.2, 0.1));
    const GeographicPoint to = placeAt(at(0.15, -0.2));
    click(at(-0.2, 0.1));
    click(at(0.15, -0.2));
    doubleClick(globe(), at(0.15, -0.2));
    const MeasureItem* item = measuring().current();
    ASSERT_NE(item, nullptr);
    ASSERT_EQ(item->vertices.size(), 2U);
    EXPECT_TRUE(item->is_finished);
    for (const auto& [vertex, place] :
         {std::pair{item->vertices[0], from}, std::pair{item->vertices[1], to}}) {
        EXPECT_NEAR(
            std::remainder(placeOf(vertex).longitude.degrees() - place.longitude.degrees(), 360.0),
            0.0, 1e-9);
        EXPECT_NEAR(placeOf(vertex).latitude.degrees(), place.latitude.degrees(), 1e-9);
    }
    const std::uint32_t on_globe = item->id;
    ASSERT_TRUE(isMeasured(on_globe));
    const double measured_m = measuring().outcome(on_globe).as<Distance>()->geodesic_m;
    const double surface_m = measuring().outcome(on_globe).as<Distance>()->surface_m;
    ASSERT_EQ(body().equatorial_m, body().polar_m);
    double expected_m = 0.0;
    GeographicLib::Geodesic(body().equatorial_m, 0.0)
        .Inverse(from.latitude.degrees(), from.longitude.degrees(), to.latitude.degrees(),
                 to.longitude.degrees(), expected_m);
    EXPECT_NEAR(measured_m / expected_m, 1.0, 1e-9);

    scene(1)->trigger();
    EXPECT_EQ(view().tool(), Tool::Measure);
    for (const GeographicPoint& place : {from, to}) {
        measuring().addPointAt(*view().map()->georeference().toGrid(place));
    }
    const std::uint32_t on_flat = measuring().current()->id;
    ASSERT_NE(on_flat, on_globe);
    ASSERT_TRUE(isMeasured(on_flat));
    EXPECT_NEAR(measuring().outcome(on_flat).as<Distance>()->geodesic_m, measured_m,
                1e-9 * measured_m);
    EXPECT_NEAR(measuring().outcome(on_flat).as<Distance>()->surface_m, surface_m,
                1e-9 * surface_m);
}

// On a sphere of 3 396 000 m, GeodSolve gives 11 434.130 m; between the nearest samples it is 14
// km.
TEST_F(GlobeDrawingTest, PointsThatAreTypedBesideTheMeridianWhereTheMapBeginsAreMeasuredThere)
{
    ASSERT_TRUE(showGlobe());
    ASSERT_EQ(body().equatorial_m, 3396000.0);
    measuring().begin(MeasurementKind::Distance);
    for (const char* typed : {"15.3 N 359.9 E", "15.3 N 0.1 E"}) {
        window_->actionSet().add_point->trigger();
        auto* dialog = window_->findChild<GoToDialog*>();
        ASSERT_NE(dialog, nullptr);
        auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
        field->setText(QString::fromLatin1(typed));
        QTest::keyClick(field, Qt::Key_Return);
        ASSERT_TRUE(waitFor([this] { return window_->findChild<GoToDialog*>() == nullptr; }));
    }
    const MeasureItem* item = measuring().current();
    ASSERT_NE(item, nullptr);
    ASSERT_EQ(item->vertices.size(), 2U);
    const std::uint32_t id = item->id;
    ASSERT_TRUE(isMeasured(id));
    const auto* distance = measuring().outcome(id).as<Distance>();
    ASSERT_NE(distance, nullptr);
    EXPECT_NEAR(distance->geodesic_m, 11434.130, 0.001);
}

TEST_F(GlobeDrawingTest, PointsAreDraggedInsertedRemovedAndUndoneAsOnTheFlatMap)
{
    ASSERT_TRUE(showGlobe());
    lookAt(-120.0, 10.0, 2e6);
    measuring().begin(MeasurementKind::Distance);
    QCoreApplication::processEvents();
    click(at(-0.2, 0.0));
    click(at(0.2, 0.0));
    doubleClick(globe(), at(0.2, 0.0));
    ASSERT_EQ(measuring().handles().size(), 2U);
    EXPECT_LT(QLineF(measuring().handles()[0].place, QPointF(at(-0.2, 0.0))).length(), 1.5);
    const BodyCamera before = globe().camera();
    const auto drag = [this](QPoint from, QPoint to) {
        QTest::mousePress(&globe(), Qt::LeftButton, {}, from);
        move((QPointF(from) + QPointF(to)) / 2.0, Qt::LeftButton);
        move(to, Qt::LeftButton);
        QTest::mouseRelease(&globe(), Qt::LeftButton, {}, to);
    };
    drag(at(-0.2, 0.0), at(-0.2, 0.2)); // a point
    EXPECT_EQ(globe().camera(), before);
    const GeographicPoint moved = placeAt(at(-0.2, 0.2));
    EXPECT_NEAR(placeOf(measuring().current()->vertices[0]).latitude.degrees(),
                moved.latitude.degrees(), 1e-9);
    drag(at(0.0, 0.1), at(0.0, -0.2)); // the line
    EXPECT_EQ(measuring().current()->vertices.size(), 3U);
    drag(at(0.3, 0.3), at(0.2, 0.3)); // the ground
    EXPECT_NE(globe().camera(), before);
    EXPECT_EQ(measuring().current()->vertices.size(), 3U);
    QTest::keyClick(&globe(), Qt::Key_Backspace);
    EXPECT_EQ(measuring().current()->vertices.size(), 2U);
    QUndoStack& undo = window_->undoStack();
    while (undo.canUndo() && !measuring().state().items.empty()) {
        undo.undo();
    }
    EXPECT_TRUE(measuring().state().items.empty());
}

TEST_F(GlobeDrawingTest, LinesLieOnTheTerrainBeforeTheHorizonAlone)
{
    ASSERT_TRUE(showGlobe());
    annotating().begin(FeatureShape::Line);
    QCoreApplication::processEvents(); // the panel makes the globe smaller
    lookAt(0.0, 0.0, 1.2e7);
    const QImage without = picture();
    for (const double longitude : {-150.0, -60.0, 20.0}) {
        annotating().addPointAt(*view().map()->georeference().toGrid(
            {.longitude = Angle::degrees(longitude), .latitude = Angle::degrees(0.0)}));
    }
    annotating().finish();
    annotating().select(0);
    EXPECT_GT(differing(without, picture()), 300);
    lookAt(100.0, 0.0, 1.2e7); // its nearest end is 80° away, the other one behind the body
    const QImage with = picture();
    annotating().remove(annotating().state().items.back().id);
    EXPECT_LT(differing(picture(), with), 200);
    scene(1)->trigger();
    EXPECT_TRUE(annotating().state().items.empty());
}

TEST_F(GlobeDrawingTest, VectorFilesAreDrawnAndFound)
{
    const QString csv = maps_.path(QStringLiteral("ridge.csv"));
    QFile out(csv);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write("WKT,name\n\"LINESTRING (170 80,-175 85,-100 80)\",Ridge\n");
    out.close();
    const QString file = maps_.path(QStringLiteral("ridge.gpkg"));
    test::runTool({"ogr2ogr", "-q", "-oo", "KEEP_GEOM_COLUMNS=NO", "-f", "GPKG", "-s_srs",
                   "IAU_2015:49900", "-t_srs", "IAU_2015:49930", file.toStdString(),
                   csv.toStdString()});
    ASSERT_TRUE(showGlobe());
    lookAt(180.0, 80.0, 2e6);
    const QImage without = picture();
    VectorOverlays& overlays = window_->commands().vector_files.overlays();
    overlays.open(file);
    ASSERT_TRUE(waitFor([&] { return differing(without, globe().grabFramebuffer()) > 200; }));
    const GeographicPoint on_ridge{.longitude = Angle::degrees(170.0),
                                   .latitude = Angle::degrees(80.0)};
    ASSERT_EQ(overlays.featuresAt(on_ridge, 1e3).size(), 1U);
    EXPECT_EQ(overlays.featuresAt(on_ridge, 1e3).front().attributes.front().second,
              QStringLiteral("Ridge"));
    lookAt(0.0, -60.0, 2e6);
    overlays.goTo(QFileInfo(file).absoluteFilePath().toStdString());
    ASSERT_TRUE(rests());
    EXPECT_GT(globe().camera().target.latitude.degrees(), 75.0);
}

TEST_F(GlobeDrawingTest, TheContextMenuActsOnThePlaceThatWasClicked)
{
    ASSERT_TRUE(showGlobe());
    lookAt(-40.0, 30.0, 2e6);
    MapMenu& menu = *window_->commands().places.globeMenu();
    const GeographicPoint place = placeAt(at(0.1, 0.1));
    const auto choose = [&](const char* text) {
        QTest::mouseClick(&globe(), Qt::RightButton, {}, at(0.1, 0.1));
        for (QAction* entry : menu.menu() != nullptr ? menu.menu()->actions() : QList<QAction*>()) {
            if (entry->text().remove(QLatin1Char('&')).contains(QLatin1String(text))) {
                entry->trigger();
            }
        }
        delete menu.menu();
    };
    const BodyCamera before = globe().camera();
    choose("What Is Here");
    EXPECT_NE(menu.card(), nullptr);
    EXPECT_EQ(globe().camera(), before);
    delete menu.card();
    choose("Measure Distance");
    ASSERT_NE(measuring().current(), nullptr);
    ASSERT_EQ(measuring().current()->vertices.size(), 1U);
    const GeographicPoint measured = placeOf(measuring().current()->vertices.front());
    EXPECT_NEAR(measured.latitude.degrees(), place.latitude.degrees(), 1e-9);
    EXPECT_NEAR(std::remainder(measured.longitude.degrees() - place.longitude.degrees(), 360.0),
                0.0, 1e-9);
    choose("Fly Here");
    EXPECT_LT(globe().cameraGoal().distance_m, 0.5 * before.distance_m);
}

TEST_F(GlobeDrawingTest, TheGraticuleIsDrawnWithItsLabels)
{
    window_->resize(1000, 700); // room for labels on both sides of the middle
    ASSERT_TRUE(showGlobe());
    lookAt(180.0, 0.0, 1e6);
    const QImage without = picture();
    const GlobeLabels& labels = *globe().findChild<GlobeOverlays*>()->labels();
    for (QAction* action : window_->overlays()->terrainActions()) {
        if (action->objectName() == QStringLiteral("graticule")) {
            ASSERT_TRUE(action->isEnabled());
            action->trigger();
        }
    }
    const auto has = [&](const char* text) {
        return std::any_of(
            labels.graticuleLabels().begin(), labels.graticuleLabels().end(),
            [&](const auto& label) { return label.text.contains(QLatin1String(text)); });
    };
    EXPECT_TRUE(waitFor([&] { return has("178") && has("180") && has("182"); }));
    EXPECT_GT(differing(without, picture()), 1000);
}

TEST_F(GlobeDrawingTest, ProjectsAndSavedViewsKeepTheGlobeAndItsCamera)
{
    ASSERT_TRUE(showGlobe());
    const BodyCamera camera{
        .target = {.longitude = Angle::degrees(-133.5), .latitude = Angle::degrees(18.25)},
        .height_m = 9000.0,
        .distance_m = 750000.0,
        .azimuth = Angle::degrees(35.0),
        .tilt = Angle::degrees(40.0)};
    globe().setCamera(camera);
    const BodyCamera kept = globe().cameraGoal();
    window_->commands().views.save();
    const auto& views = window_->commands().views;
    ASSERT_TRUE(views.menu()->isEnabled());
    const QString file = maps_.path(QStringLiteral("globe.mvproj"));
    ProjectController& project = window_->commands().project;
    ASSERT_TRUE(saveProject(project, file));
    scene(1)->trigger();
    ASSERT_TRUE(globe().isHidden());

    ASSERT_TRUE(openProject(project, file));
    ASSERT_TRUE(waitFor([this] { return globe().terrain() != nullptr && !globe().isHidden(); }));
    const auto expect_kept = [&] {
        const BodyCamera& now = globe().cameraGoal();
        EXPECT_NEAR(now.target.longitude.degrees(), kept.target.longitude.degrees(), 1e-9);
        EXPECT_NEAR(now.target.latitude.degrees(), kept.target.latitude.degrees(), 1e-9);
        EXPECT_NEAR(now.height_m, kept.height_m, 1e-3);
        EXPECT_NEAR(now.distance_m, kept.distance_m, 1e-3);
        EXPECT_NEAR(now.azimuth.degrees(), kept.azimuth.degrees(), 1e-6);
        EXPECT_NEAR(now.tilt.degrees(), kept.tilt.degrees(), 1e-6);
    };
    expect_kept();
    EXPECT_TRUE(scene(2)->isChecked());

    // The view returns there from elsewhere on the globe, and from the flat map.
    const ViewId saved = window_->session().views.front().id;
    lookAt(10.0, 10.0, 1e6);
    window_->commands().views.goTo(saved);
    ASSERT_TRUE(rests());
    expect_kept();
    scene(1)->trigger();
    window_->commands().views.goTo(saved);
    ASSERT_TRUE(waitFor([this] { return globe().terrain() != nullptr && !globe().isHidden(); }));
    expect_kept();
    // A new project begins with the flat map.
    project.startNew();
    EXPECT_TRUE(globe().isHidden());
}

TEST_F(GlobeDrawingTest, HasSmoothEdgesIfPreferred)
{
    ASSERT_TRUE(showGlobe());
    lookAt(0.0, 0.0, 2e7); // all of it, before the sky
    Preferences preferences = window_->preferences();
    const auto pictureWith = [&](bool has_antialiasing) {
        preferences.has_antialiasing = has_antialiasing;
        window_->setPreferences(preferences);
        return picture();
    };
    const QImage rough = pictureWith(false);
    EXPECT_GT(differing(pictureWith(true), rough), 1000);
    EXPECT_EQ(differing(pictureWith(false), rough), 0);
}

} // namespace
} // namespace marsview
