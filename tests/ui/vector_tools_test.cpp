// Vector files on the terrain, in a window. The files are made by GDAL's ogr2ogr.
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/feature_picker.h"
#include "ui/commands/vector_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/file_work.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/dialogs/place_dialog.h"
#include "ui/globe/globe_view.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/vector_file_list.h"
#include "ui/project/project_controller.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QMouseEvent>
#include <QScreen>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace marsview {
namespace {

constexpr double kStepDeg = 0.25; // of TestMaps::mars(), whose corner is at 10° E 20° N

class VectorToolsTest : public MapWindowTest {
protected:
    // A line from 12° E 18° N to 18° E 14° N with a bend, and a point, in a CRS on some body.
    QString file(const char* name, const char* geographic, const char* crs)
    {
        const QString csv = maps_.path(QString::fromLatin1(name) + QStringLiteral(".csv"));
        QFile out(csv);
        EXPECT_TRUE(out.open(QIODevice::WriteOnly));
        out.write(
            "WKT,name,age\n"
            "\"LINESTRING (12 18,15 15.5,18 14)\",Ridge “A”,\n"
            "POINT (16 18.5),Outcrop,3.5\n");
        out.close();
        const QString made = maps_.path(QString::fromLatin1(name) + QStringLiteral(".gpkg"));
        test::runTool({"ogr2ogr", "-q", "-oo", "KEEP_GEOM_COLUMNS=NO", "-f", "GPKG", "-s_srs",
                       geographic, "-t_srs", crs, made.toStdString(), csv.toStdString()});
        return made;
    }
    QString marsFile() { return file("ridges", "IAU_2015:49900", "IAU_2015:49910"); }
    void openMars()
    {
        makeWindow(kSmall);
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    }
    VectorOverlays& overlays() { return window_->commands().vector_files.overlays(); }
    bool openVector(const QString& path)
    {
        overlays().open(path);
        return rest();
    }
    bool rest()
    {
        return waitFor([this] { return !overlays().isBusy() && view().isPictureComplete(); });
    }
    static GridPoint gridOf(double longitude, double latitude)
    {
        return {(longitude - 10.0) / kStepDeg - 0.5, (20.0 - latitude) / kStepDeg - 0.5};
    }
    // Whether a pixel at a place of the map, or next to it, has a color.
    bool isColoredAt(double longitude, double latitude, const Rgb8& color)
    {
        const auto place = view().positionOf(gridOf(longitude, latitude));
        EXPECT_TRUE(place);
        const QImage picture = view().terrainPicture();
        const QPoint pixel = (*place * view().devicePixelRatioF()).toPoint();
        for (const QPoint aside :
             {QPoint(0, 0), QPoint(1, 0), QPoint(-1, 0), QPoint(0, 1), QPoint(0, -1)}) {
            const QColor seen = picture.pixelColor(pixel + aside);
            if (std::abs(seen.red() - color.red) < 40 &&
                std::abs(seen.green() - color.green) < 40 &&
                std::abs(seen.blue() - color.blue) < 40) {
                return true;
            }
        }
        return false;
    }
};

TEST_F(VectorToolsTest, FeaturesInAnotherCrsLieAtTheirLongitudesAndLatitudes)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(openVector(marsFile()));
    ASSERT_EQ(window_->session().overlays.size(), 1U);
    const Rgb8 color = window_->session().overlays.front().color;
    for (const double share : {0.1, 0.4, 0.8}) {
        EXPECT_TRUE(isColoredAt(12.0 + share * 3.0, 18.0 - share * 2.5, color)) << share;
        EXPECT_TRUE(isColoredAt(15.0 + share * 3.0, 15.5 - share * 1.5, color)) << share;
        EXPECT_FALSE(isColoredAt(12.5 + share * 3.0, 18.0 - share * 2.5, color)) << share;
    }
    EXPECT_TRUE(isColoredAt(16.0, 18.5, color));
}

TEST_F(VectorToolsTest, OpeningHidingAndClosingAreStepsOfUndoAndPartOfTheProject)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(rest());
    const QImage bare = view().terrainPicture();
    const QString path = marsFile();
    ASSERT_TRUE(openVector(path));
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Open ridges.gpkg"));
    const QImage drawn = view().terrainPicture();
    EXPECT_NE(drawn, bare);
    window_->undoStack().undo();
    ASSERT_TRUE(rest());
    EXPECT_EQ(view().terrainPicture(), bare);
    window_->undoStack().redo();
    ASSERT_TRUE(rest());
    EXPECT_EQ(view().terrainPicture(), drawn);

    QMenu* const menu =
        window_->actionSet().vector_files->actions().constFirst()->menu(); // of the file
    ASSERT_NE(menu, nullptr);
    menu->actions().constFirst()->trigger(); // Show
    ASSERT_TRUE(rest());
    EXPECT_EQ(view().terrainPicture(), bare);
    window_->undoStack().undo();

    const QString project = maps_.path(QStringLiteral("with.mvproj"));
    ASSERT_TRUE(saveProject(window_->commands().project, project));
    makeWindow(kSmall);
    window_->open(project);
    ASSERT_TRUE(waitFor(
        [this] { return !window_->controller().isBusy() && !window_->session().layers.empty(); }));
    ASSERT_TRUE(rest());
    ASSERT_EQ(window_->session().overlays.size(), 1U);
    EXPECT_EQ(window_->session().overlays.front().path, path.toStdString());
    EXPECT_TRUE(isColoredAt(16.0, 18.5, window_->session().overlays.front().color));
    EXPECT_FALSE(window_->isWindowModified());
}

TEST_F(VectorToolsTest, AFeatureIsFoundWithItsAttributes)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(openVector(marsFile()));
    const auto at = [&](double longitude, double latitude) {
        return overlays().featuresAt(GeographicPoint{.longitude = Angle::degrees(longitude),
                                                     .latitude = Angle::degrees(latitude)},
                                     2000.0);
    };
    const auto outcrop = at(16.0, 18.5);
    ASSERT_EQ(outcrop.size(), 1U);
    EXPECT_EQ(outcrop.front().file, QStringLiteral("ridges.gpkg"));
    using Attribute = std::pair<QString, QString>;
    EXPECT_EQ(outcrop.front().attributes,
              (std::vector<Attribute>{{QStringLiteral("name"), QStringLiteral("Outcrop")},
                                      {QStringLiteral("age"), QStringLiteral("3.5")}}));
    ASSERT_EQ(at(15.0, 15.5).size(), 1U);
    EXPECT_EQ(at(15.0, 15.5).front().attributes.front().second, QStringLiteral("Ridge “A”"));
    EXPECT_TRUE(at(11.0, 13.0).empty());
}

// Lines in another CRS have further points, which keep their course: nothing snaps to these.
TEST_F(VectorToolsTest, MeasurementsAndAnnotationsSnapToVerticesOfFiles)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(openVector(marsFile()));
    const auto click_beside = [this](double longitude, double latitude) {
        const auto place = view().positionOf(gridOf(longitude, latitude));
        QTest::mouseClick(&view(), Qt::LeftButton, {},
                          place.value_or(QPointF()).toPoint() + QPoint(3, 4));
    };
    const auto away_deg = [](const DrawnVertex& vertex, double longitude, double latitude) {
        const auto& at = std::get<GeographicPoint>(vertex);
        return std::hypot(at.longitude.degrees() - longitude, at.latitude.degrees() - latitude);
    };
    constexpr double kSameDeg = 1e-9;
    window_->measuring()->begin(MeasurementKind::Distance);
    QTest::qWait(50);
    click_beside(12.75, 17.375); // a quarter of the way along it
    click_beside(15.0, 15.5);    // its bend
    click_beside(16.0, 18.5);    // the point
    window_->measuring()->finish();
    const auto& measured = window_->measuring()->current()->vertices;
    ASSERT_EQ(measured.size(), 3U);
    EXPECT_GT(away_deg(measured[0], 12.75, 17.375), 0.01);
    EXPECT_LT(away_deg(measured[1], 15.0, 15.5), kSameDeg);
    EXPECT_LT(away_deg(measured[2], 16.0, 18.5), kSameDeg);

    window_->annotating()->begin(FeatureShape::Line);
    ASSERT_TRUE(rest());
    QTest::qWait(50);
    click_beside(18.0, 14.0); // the other end
    QMenu* const menu =
        window_->actionSet().vector_files->actions().constFirst()->menu(); // of the file
    menu->actions().constFirst()->trigger();                               // hides it
    ASSERT_TRUE(rest());
    click_beside(12.0, 18.0);
    window_->annotating()->finish();
    const auto& drawn = window_->annotating()->current()->vertices;
    ASSERT_EQ(drawn.size(), 2U);
    EXPECT_LT(away_deg(drawn[0], 18.0, 14.0), kSameDeg);
    EXPECT_GT(away_deg(drawn[1], 12.0, 18.0), 0.01) << "of a file that is hidden";
}

TEST_F(VectorToolsTest, AClickSelectsAFeatureAndShowsItsAttributes)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(focusMap());
    ASSERT_TRUE(openVector(marsFile()));
    const QString csv = maps_.path(QStringLiteral("units.csv"));
    QFile out(csv);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write("WKT,unit\n\"POLYGON ((14 19.5,19 19.5,19 17,14 17,14 19.5))\",Plains\n");
    out.close();
    const QString units = maps_.path(QStringLiteral("units.gpkg"));
    test::runTool({"ogr2ogr", "-q", "-oo", "KEEP_GEOM_COLUMNS=NO", "-f", "GPKG", "-a_srs",
                   "IAU_2015:49900", units.toStdString(), csv.toStdString()});
    ASSERT_TRUE(openVector(units));
    FeaturePicker& picker = window_->commands().places.features();
    const auto place_of = [this](double longitude, double latitude) {
        return view().positionOf(gridOf(longitude, latitude)).value().toPoint();
    };
    const auto click = [this](QPoint position) {
        QTest::mouseClick(&view(), Qt::LeftButton, {}, position);
        QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    };
    const auto shown = [&] {
        return picker.card() != nullptr && picker.card()->isVisible() ? picker.card()->text()
                                                                      : QString();
    };
    // Pixels of the light border.
    const auto light_around = [&](QPoint place) {
        EXPECT_TRUE(rest());
        const QImage picture = view().terrainPicture();
        const double scale = view().devicePixelRatioF();
        int count = 0;
        for (int y = -12; y <= 12; ++y) {
            for (int x = -12; x <= 12; ++x) {
                const QPoint pixel = (QPointF(place + QPoint(x, y)) * scale).toPoint();
                const QColor seen = picture.pixelColor(pixel);
                count += seen.red() > 235 && seen.green() > 235 && seen.blue() > 235 ? 1 : 0;
            }
        }
        return count;
    };
    const QPoint outcrop = place_of(16.0, 18.5);
    const QPoint ridge = place_of(13.5, 16.75);
    EXPECT_EQ(light_around(outcrop), 0);

    // A point before the polygon around it, though its file is drawn below.
    click(outcrop + QPoint(3, -2));
    EXPECT_EQ(shown(), QStringLiteral("Vector file: ridges.gpkg\nname: Outcrop\nage: 3.5"));
    EXPECT_TRUE(view().hasFocus()) << "the keys are still those of the map";
    EXPECT_FALSE(
        picker.card()->frameGeometry().contains(view().mapToGlobal(outcrop + QPoint(3, -2))));
    EXPECT_EQ(picker.card()->windowType(), Qt::Tool);
    EXPECT_FALSE(picker.card()->windowFlags().testFlag(Qt::WindowMaximizeButtonHint));
    // In the lower right corner of the screen there is room only on the other sides.
    const QPoint corner = picker.card()->screen()->availableGeometry().bottomRight() - QPoint(9, 9);
    picker.card()->showAt(corner);
    EXPECT_FALSE(picker.card()->frameGeometry().contains(corner));
    EXPECT_TRUE(picker.card()->screen()->availableGeometry().contains(
        picker.card()->frameGeometry().topLeft()));
    picker.card()->showAt(view().mapToGlobal(outcrop));
    EXPECT_GT(light_around(outcrop), 20);
    click(place_of(18.0, 17.8));
    EXPECT_EQ(shown(), QStringLiteral("Vector file: units.gpkg\nunit: Plains"));
    EXPECT_EQ(light_around(outcrop), 0);
    EXPECT_GT(light_around(place_of(19.0, 18.0)), 20) << "the border of the polygon";
    click(ridge + QPoint(2, 2));
    EXPECT_EQ(shown(), QStringLiteral("Vector file: ridges.gpkg\nname: Ridge “A”"));
    EXPECT_GT(light_around(ridge), 20);

    click(place_of(11.0, 13.0)); // there is nothing
    EXPECT_EQ(picker.card(), nullptr);
    EXPECT_FALSE(picker.hasFeature());
    EXPECT_EQ(light_around(ridge), 0);

    // A drag pans and selects nothing.
    const OrbitCamera before = view().camera();
    QTest::mousePress(&view(), Qt::LeftButton, {}, outcrop);
    for (const int way : {2, 6, 2, 0}) {
        const QPoint on = outcrop + QPoint(way, 0);
        QMouseEvent move(QEvent::MouseMove, on, view().mapToGlobal(on), Qt::NoButton,
                         Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&view(), &move);
        EXPECT_FALSE(view().camera() == before && way > 0) << "it pans from the first pixel on";
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, outcrop);
    EXPECT_EQ(picker.card(), nullptr);
    view().setCamera(before);

    // By touch, a short press; a longer one feels the ground.
    view().setTool(Tool::Touch);
    click(outcrop);
    EXPECT_TRUE(shown().contains(QStringLiteral("Outcrop")));
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_EQ(picker.card(), nullptr);
    EXPECT_FALSE(picker.hasFeature());
    QTest::mousePress(&view(), Qt::LeftButton, {}, outcrop);
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, outcrop,
                        QApplication::doubleClickInterval() + 100);
    EXPECT_EQ(picker.card(), nullptr);

    // The card and the border go together, and with the file.
    view().setTool(Tool::Pan);
    click(outcrop);
    ASSERT_NE(picker.card(), nullptr);
    picker.card()->reject();
    EXPECT_FALSE(picker.hasFeature());
    click(outcrop);
    ASSERT_TRUE(picker.hasFeature());
    const std::string selected = overlays().selected()->path;
    window_->controller().removeOverlay(selected);
    EXPECT_EQ(picker.card(), nullptr);
    EXPECT_FALSE(picker.hasFeature());
    click(outcrop);
    EXPECT_EQ(shown(), QStringLiteral("Vector file: units.gpkg\nunit: Plains"));
}

// The map is placed on the globe after it was loaded.
TEST_F(VectorToolsTest, AFileThatIsOpenedWithAPlanetIsDrawnOnTheGlobeAndSelectedThere)
{
    WindowOptions options = testWindowOptions();
    options.scene = SceneChoice::Automatic;
    makeWindow(kSmall, options);
    const QString csv = maps_.path(QStringLiteral("outcrop.csv"));
    QFile out(csv);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write("WKT,name\nPOINT (-94 -1),Outcrop\n"); // where the camera looks first
    out.close();
    const QString file = maps_.path(QStringLiteral("outcrop.gpkg"));
    test::runTool({"ogr2ogr", "-q", "-oo", "KEEP_GEOM_COLUMNS=NO", "-f", "GPKG", "-a_srs",
                   "IAU_2015:49900", file.toStdString(), csv.toStdString()});
    window_->openAll({QString::fromStdString(test::bundledMars()), file});
    ASSERT_TRUE(waitFor([this] { return window_->session().overlays.size() == 1; }));
    GlobeView& globe = *window_->globe();
    ASSERT_FALSE(globe.isHidden());
    const GeographicPoint place{.longitude = Angle::degrees(-94.0),
                                .latitude = Angle::degrees(-1.0)};
    ASSERT_TRUE(waitFor([&] { return overlays().featuresAt(place, 1e3).size() == 1; }));
    ASSERT_TRUE(waitUntilSettled(*window_));
    FeaturePicker& picker = window_->commands().places.features();
    QTest::mouseClick(&globe, Qt::LeftButton, {}, globe.rect().center() + QPoint(2, -2));
    ASSERT_NE(picker.card(), nullptr);
    EXPECT_EQ(picker.card()->text(), QStringLiteral("Vector file: outcrop.gpkg\nname: Outcrop"));
    QTest::mouseClick(&globe, Qt::LeftButton, {}, globe.rect().center() + QPoint(60, 60));
    EXPECT_EQ(picker.card(), nullptr);
    EXPECT_FALSE(picker.hasFeature());

    window_->measuring()->begin(MeasurementKind::Distance);
    QTest::qWait(50);
    QTest::mouseClick(&globe, Qt::LeftButton, {}, globe.rect().center() + QPoint(5, -4));
    const auto& vertices = window_->measuring()->current()->vertices;
    ASSERT_EQ(vertices.size(), 1U);
    const auto& snapped = std::get<GeographicPoint>(vertices.front());
    EXPECT_NEAR(std::remainder(snapped.longitude.degrees() + 94.0, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(snapped.latitude.degrees(), -1.0, 1e-9);
}

TEST_F(VectorToolsTest, AFileOfAnotherBodyOrNoneIsRefusedWithTheReason)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    QString problem;
    QObject::connect(&window_->commands().vector_files, &VectorTools::failed, window_.get(),
                     [&problem](const QString& text) { problem = text; });
    const QString moon = file("maria", "IAU_2015:30100", "IAU_2015:30100");
    overlays().open(moon);
    ASSERT_TRUE(waitFor([&] { return !problem.isEmpty(); }));
    EXPECT_TRUE(problem.contains(QStringLiteral("Moon"))) << problem.toStdString();
    problem.clear();
    overlays().open(maps_.path(QStringLiteral("none.gpkg")));
    ASSERT_TRUE(waitFor([&] { return !problem.isEmpty(); }));
    EXPECT_TRUE(problem.contains(QStringLiteral("none.gpkg"))) << problem.toStdString();
    EXPECT_TRUE(window_->session().overlays.empty());
    EXPECT_EQ(window_->undoStack().undoText().contains(QStringLiteral("maria")), false);
}

// GeoJSON without a CRS states the Earth's longitude and latitude.
TEST_F(VectorToolsTest, AFileOfPlainLongitudesAndLatitudesCanBeReadOnTheMapsBody)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    const QString path = maps_.path(QStringLiteral("plain.geojson"));
    QFile out(path);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
              R"("geometry":{"type":"Point","coordinates":[16,18.5]}}]})");
    out.close();
    const QSignalSpy failures(&window_->commands().vector_files, &VectorTools::failed);
    ASSERT_TRUE(openVector(path));
    const auto& bar = *window_->findChild<NoticeBar*>();
    const auto& text = *bar.findChild<QLabel*>(QStringLiteral("noticeText"));
    auto& button = *bar.findChild<QToolButton*>(QStringLiteral("noticeAction"));
    EXPECT_EQ(text.text(), QStringLiteral("plain.geojson says that it is in longitude and latitude "
                                          "on Earth, but the map is on Mars"));
    EXPECT_EQ(button.text(), QStringLiteral("Use Mars"));
    EXPECT_TRUE(window_->session().overlays.empty());
    // Another map, on which it would be another question.
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_FALSE(bar.isVisible() && text.text().contains(QStringLiteral("plain.geojson")));
    window_->undoStack().undo();
    ASSERT_TRUE(rest());
    ASSERT_TRUE(openVector(path));
    EXPECT_TRUE(bar.isVisible());
    // Closed, and asked for again.
    bar.findChild<QToolButton*>(QStringLiteral("noticeClose"))->click();
    EXPECT_FALSE(bar.isVisible() && text.text().contains(QStringLiteral("plain.geojson")));
    ASSERT_TRUE(openVector(path));
    window_->openAll({path});
    ASSERT_TRUE(rest());
    EXPECT_TRUE(bar.isVisible());
    button.click();
    ASSERT_TRUE(rest());
    ASSERT_EQ(window_->session().overlays.size(), 1U);
    EXPECT_TRUE(isColoredAt(16.0, 18.5, window_->session().overlays.front().color));
    EXPECT_FALSE(bar.isVisible() && text.text().contains(QStringLiteral("plain.geojson")));
    EXPECT_EQ(failures.count(), 0);

    const QString project = maps_.path(QStringLiteral("plain.mvproj"));
    ASSERT_TRUE(saveProject(window_->commands().project, project));
    makeWindow(kSmall);
    window_->open(project);
    ASSERT_TRUE(waitFor(
        [this] { return !window_->controller().isBusy() && !window_->session().layers.empty(); }));
    ASSERT_TRUE(rest());
    EXPECT_TRUE(isColoredAt(16.0, 18.5, window_->session().overlays.front().color));
}

TEST_F(VectorToolsTest, OpenedTogetherWithAMapAFileIsDrawnOnThatMap)
{
    ASSERT_NO_FATAL_FAILURE(makeWindow(kSmall));
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    window_->openAll({marsFile(), maps_.mars()}); // as when both are dropped on the window
    ASSERT_TRUE(waitFor([this] { return window_->session().overlays.size() == 1; }));
    ASSERT_TRUE(rest());
    EXPECT_TRUE(isColoredAt(16.0, 18.5, window_->session().overlays.front().color));
}

// A map of another body on top: the overlay waits, and is there again with its own map.
TEST_F(VectorToolsTest, TheLayersPanelListsTheFiles)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    VectorFileList& files = *window_->datasetPanel()->vectorFiles();
    QListWidget& list = *files.list();
    EXPECT_FALSE(files.isVisible()) << "there are none";
    ASSERT_TRUE(openVector(marsFile()));
    ASSERT_TRUE(openVector(file("faults", "IAU_2015:49900", "IAU_2015:49900")));
    ASSERT_TRUE(files.isVisible());
    ASSERT_EQ(list.count(), 2);
    EXPECT_EQ(list.item(0)->text(), QStringLiteral("faults.gpkg")) << "it is drawn last";
    EXPECT_EQ(list.item(1)->text(), QStringLiteral("ridges.gpkg"));
    EXPECT_EQ(list.item(1)->checkState(), Qt::Checked);
    EXPECT_LE(list.sizeHintForRow(0) + list.sizeHintForRow(1), list.viewport()->height());

    // By keyboard: Space hides, Enter flies there, Delete closes; undo brings back.
    list.setCurrentRow(1);
    list.setFocus();
    QTest::keyClick(&list, Qt::Key_Space);
    EXPECT_FALSE(window_->session().overlays.front().is_visible);
    window_->undoStack().undo();
    EXPECT_EQ(list.item(1)->checkState(), Qt::Checked);
    const OrbitCamera before = view().cameraGoal();
    QTest::keyClick(&list, Qt::Key_Return);
    EXPECT_NE(view().cameraGoal(), before);
    QTest::keyClick(&list, Qt::Key_Delete);
    ASSERT_EQ(list.count(), 1);
    EXPECT_EQ(list.item(0)->text(), QStringLiteral("faults.gpkg"));
    window_->undoStack().undo();
    ASSERT_EQ(list.count(), 2);

    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    ASSERT_TRUE(rest());
    EXPECT_EQ(list.item(0)->text(), QStringLiteral("faults.gpkg\nHidden: on another body"));
}

TEST_F(VectorToolsTest, FollowsTheMapThatIsShown)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(openVector(marsFile()));
    const auto is_on_map = [this] {
        const GeographicPoint outcrop{.longitude = Angle::degrees(16.0),
                                      .latitude = Angle::degrees(18.5)};
        return !overlays().featuresAt(outcrop, 1e5).empty();
    };
    ASSERT_TRUE(is_on_map());
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    ASSERT_TRUE(rest());
    EXPECT_FALSE(is_on_map());
    window_->undoStack().undo();
    ASSERT_TRUE(rest());
    EXPECT_TRUE(is_on_map());
    EXPECT_TRUE(isColoredAt(16.0, 18.5, window_->session().overlays.front().color));
}

// Reading and placing show their progress, and can be canceled.
TEST_F(VectorToolsTest, ReadingALargeFileCanBeCanceled)
{
    ASSERT_NO_FATAL_FAILURE(openMars());
    ASSERT_TRUE(rest());
    const QString path = maps_.path(QStringLiteral("many.csv"));
    QFile out(path);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write("lon,lat,name\n");
    for (int i = 0; i < 200'000; ++i) {
        out.write(QByteArray::number(10.0 + i * 4e-5) + ",15,p" + QByteArray::number(i) + '\n');
    }
    out.close();
    FileWork& work = window_->commands().file_work;
    QSignalSpy problems(&overlays(), &VectorOverlays::failed);
    overlays().open(path);
    EXPECT_TRUE(work.isBusy());
    work.cancel();
    ASSERT_TRUE(rest());
    EXPECT_FALSE(work.isBusy());
    EXPECT_TRUE(window_->session().overlays.empty());
    EXPECT_TRUE(problems.isEmpty()) << "the user knows";
    // The same file can be opened later.
    ASSERT_TRUE(openVector(path));
    EXPECT_EQ(window_->session().overlays.size(), 1U);
}

} // namespace
} // namespace marsview
