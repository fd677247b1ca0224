// Annotating in the window, by mouse and by keyboard.

#include "tests/support/run_program.h"
#include "tests/ui/map_window.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/project_files.h"
#include "tests/ui/test_map.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/picture_saver.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/overlay/annotation_marks.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/panels/annotation_list.h"
#include "ui/panels/annotation_panel.h"
#include "ui/project/project_controller.h"
#include "ui/text/coordinate_text.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QActionGroup>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QLineEdit>
#include <QMessageBox>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTest>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace marsview {
namespace {

class AnnotationTest : public testing::Test {
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
    AnnotationController& annotating() { return *window_->annotating(); }
    AnnotationList& list() { return *window_->annotationPanel()->list(); }
    AnnotationCommands& commands() { return window_->commands().annotating; }
    void choose(FeatureShape shape)
    {
        for (QAction* action : window_->actionSet().annotation_shapes->actions()) {
            if (action->data().toInt() == static_cast<int>(shape)) {
                action->trigger();
            }
        }
        // The panel below the map makes it smaller.
        ASSERT_TRUE(QTest::qWaitFor([this] { return list().isVisible(); }, kTimeout));
        ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    }
    // So far from the middle of the view, in shares of its sides.
    QPoint at(double right, double down) const
    {
        const QSize size = window_->view()->size();
        return {static_cast<int>((0.5 + right) * size.width()),
                static_cast<int>((0.5 + down) * size.height())};
    }
    void click(QPoint position) { QTest::mouseClick(&view(), Qt::LeftButton, {}, position); }
    void drag(QPoint from, QPoint to)
    {
        QTest::mousePress(&view(), Qt::LeftButton, {}, from);
        for (const QPoint& place : {from + (to - from) / 2, to}) {
            QMouseEvent move(QEvent::MouseMove, place, view().mapToGlobal(place), Qt::NoButton,
                             Qt::LeftButton, Qt::NoModifier);
            QApplication::sendEvent(&view(), &move);
        }
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
    }
    // A point, a line of two points and a triangle.
    void drawOneOfEach()
    {
        ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
        click(at(-0.2, -0.1));
        ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
        click(at(-0.1, 0.1));
        click(at(0.1, 0.1));
        annotating().finish();
        ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Polygon));
        for (const QPoint& corner : {at(0.1, -0.2), at(0.25, -0.2), at(0.2, 0.0)}) {
            click(corner);
        }
        annotating().finish();
        ASSERT_EQ(annotating().annotations().size(), 3U);
    }
    QString exportTo(const QString& name)
    {
        QString problem = QStringLiteral("nothing was heard");
        const auto done = QObject::connect(&commands(), &AnnotationCommands::exported,
                                           window_.get(), [&] { problem.clear(); });
        const auto failed =
            QObject::connect(&commands(), &AnnotationCommands::failed, window_.get(),
                             [&](const QString& why) { problem = why; });
        commands().exportFile(maps_.path(name));
        EXPECT_TRUE(QTest::qWaitFor([&] { return problem != QStringLiteral("nothing was heard"); },
                                    kTimeout));
        QObject::disconnect(done);
        QObject::disconnect(failed);
        return problem;
    }
    QString importFrom(const QString& name)
    {
        QString message;
        const auto done =
            QObject::connect(&commands(), &AnnotationCommands::imported, window_.get(),
                             [&](const QString& text) { message = text; });
        const auto failed =
            QObject::connect(&commands(), &AnnotationCommands::failed, window_.get(),
                             [&](const QString& why) { message = why; });
        commands().importFile(maps_.path(name));
        EXPECT_TRUE(QTest::qWaitFor([&] { return !message.isEmpty(); }, kTimeout));
        QObject::disconnect(done);
        QObject::disconnect(failed);
        return message;
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

} // namespace

TEST_F(AnnotationTest, ClicksDrawPointsLinesAndPolygons)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    EXPECT_EQ(view().tool(), Tool::Annotate);
    click(at(-0.2, -0.1));
    click(at(-0.1, -0.1));
    ASSERT_EQ(annotating().state().items.size(), 2U) << "a point each";
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    click(at(-0.1, 0.1));
    click(at(0.1, 0.1));
    doubleClick(view(), at(0.1, 0.1));
    ASSERT_NE(annotating().current(), nullptr);
    EXPECT_TRUE(annotating().current()->is_finished);
    EXPECT_EQ(annotating().current()->vertices.size(), 2U);
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Polygon));
    click(at(0.1, -0.2));
    click(at(0.25, -0.2));
    click(at(0.2, 0.0));
    click(at(0.1, -0.2)); // its first point closes it
    EXPECT_TRUE(annotating().current()->is_finished);
    EXPECT_EQ(annotating().current()->vertices.size(), 3U);
    EXPECT_EQ(annotating().current()->name, QStringLiteral("Polygon 4"));
    EXPECT_EQ(annotating().current()->body.name, "Mars");
    // Where it was clicked.
    const auto& vertex = std::get<GeographicPoint>(annotating().current()->vertices[1]);
    const auto hit = view().surfaceAt(at(0.25, -0.2));
    const auto place = view().map()->georeference().toGeographic(hit->grid);
    EXPECT_NEAR(vertex.longitude.degrees(), place->longitude.degrees(), 1e-9);
    EXPECT_NEAR(vertex.latitude.degrees(), place->latitude.degrees(), 1e-9);
}

TEST_F(AnnotationTest, VerticesAreDraggedInsertedRemovedAndUndone)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    QUndoStack& undo = window_->undoStack();
    const std::vector<Annotation> before = annotating().annotations();
    drag(at(0.2, 0.0), at(0.22, 0.05));
    EXPECT_EQ(undo.undoText(), QStringLiteral("Move Point"));
    EXPECT_NE(annotating().annotations(), before);
    undo.undo();
    EXPECT_EQ(annotating().annotations(), before);
    drag((at(0.1, -0.2) + at(0.25, -0.2)) / 2, at(0.17, -0.25));
    EXPECT_EQ(undo.undoText(), QStringLiteral("Insert Point"));
    EXPECT_EQ(annotating().current()->vertices.size(), 4U);
    // The key removes the point under the pointer.
    QTest::mouseMove(&view(), at(0.17, -0.25));
    QMouseEvent move(QEvent::MouseMove, at(0.17, -0.25), view().mapToGlobal(at(0.17, -0.25)),
                     Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view(), &move);
    QTest::keyClick(&view(), Qt::Key_Backspace);
    EXPECT_EQ(undo.undoText(), QStringLiteral("Remove Point"));
    EXPECT_EQ(annotating().annotations(), before);
    // A click on a symbol selects its point.
    click(at(-0.2, -0.1));
    EXPECT_EQ(annotating().current()->shape, FeatureShape::Point);
    drag(at(-0.2, -0.1), at(-0.25, -0.05));
    EXPECT_EQ(undo.undoText(), QStringLiteral("Move Point"));
}

TEST_F(AnnotationTest, PointsSnapToMeasurementsAndToEachOther)
{
    window_->measuring()->begin(MeasurementKind::Distance);
    QTest::qWait(50);
    click(at(-0.1, 0.05));
    click(at(0.1, 0.05));
    window_->measuring()->finish();
    const DrawnVertex end = window_->measuring()->current()->vertices.back();
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    const auto handles = window_->measuring()->handles();
    ASSERT_EQ(handles.size(), 2U);
    click(handles[1].place.toPoint() + QPoint(5, 3));
    click(at(0.0, -0.2));
    annotating().finish();
    ASSERT_EQ(annotating().current()->vertices.size(), 2U);
    EXPECT_EQ(annotating().current()->vertices.front(), end);
    annotating().select(0);
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Polygon));
    click(at(0.0, -0.2) + QPoint(-4, 4));
    EXPECT_EQ(annotating().current()->vertices.front(), annotating().state().items[0].vertices[1]);
}

TEST_F(AnnotationTest, ADraggedPointSnapsToOthersButNotToItsOwnLine)
{
    window_->measuring()->begin(MeasurementKind::Distance);
    QTest::qWait(50);
    click(at(-0.1, 0.05));
    click(at(0.1, 0.05));
    window_->measuring()->finish();
    const std::vector<DrawnVertex> measured = window_->measuring()->current()->vertices;
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    const auto handles = window_->measuring()->handles();
    ASSERT_EQ(handles.size(), 2U);
    click(at(0.0, -0.2));
    click(at(0.1, -0.2));
    annotating().finish();
    const DrawnVertex first = annotating().current()->vertices[0];
    drag(at(0.1, -0.2), handles[1].place.toPoint() + QPoint(4, -4));
    EXPECT_EQ(annotating().current()->vertices[1], measured[1]);
    EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("Move Point"));
    drag(handles[1].place.toPoint(), at(0.0, -0.2) + QPoint(5, 0));
    EXPECT_NE(annotating().current()->vertices[1], measured[1]);
    EXPECT_NE(annotating().current()->vertices[1], first);
}

TEST_F(AnnotationTest, TheKeyboardDrawsAndTypes)
{
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_A);
    EXPECT_EQ(view().tool(), Tool::Annotate);
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    view().setFocus();
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view(), &leave);
    ASSERT_TRUE(view().isCrosshairShown());
    QTest::keyClick(&view(), Qt::Key_Return);
    window_->actionSet().add_annotation_point->trigger();
    auto* dialog = window_->findChild<GoToDialog*>();
    ASSERT_NE(dialog, nullptr);
    auto* field = dialog->findChild<QLineEdit*>(QStringLiteral("coordinate"));
    field->setText(QStringLiteral("14.25 N 17.5 E"));
    QTest::keyClick(field, Qt::Key_Return);
    ASSERT_NE(annotating().current(), nullptr);
    ASSERT_EQ(annotating().current()->vertices.size(), 2U);
    const auto& typed = std::get<GeographicPoint>(annotating().current()->vertices.back());
    EXPECT_NEAR(typed.latitude.degrees(), 14.25, 1e-9);
    EXPECT_NEAR(typed.longitude.degrees(), 17.5, 1e-9);
    window_->actionSet().finish_annotation->trigger();
    EXPECT_TRUE(annotating().current()->is_finished);
}

TEST_F(AnnotationTest, TheTableRenamesColorsSortsFindsAndRemovesSeveral)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    QUndoStack& undo = window_->undoStack();
    ASSERT_EQ(list().rowCount(), 3);
    list().setTextAt(0, AnnotationList::NameColumn, QStringLiteral("Zeta"));
    EXPECT_EQ(annotating().state().items[0].name, QStringLiteral("Zeta"));
    EXPECT_EQ(undo.undoText(), QStringLiteral("Rename"));
    list().setTextAt(1, AnnotationList::NoteColumn, QStringLiteral("a fault"));
    EXPECT_EQ(annotating().state().items[1].note, QStringLiteral("a fault"));
    list().sortByColumn(AnnotationList::NameColumn, Qt::DescendingOrder);
    EXPECT_EQ(list().textAt(0, AnnotationList::NameColumn), QStringLiteral("Zeta"));
    EXPECT_EQ(list().textAt(0, AnnotationList::ShapeColumn), QStringLiteral("Point"));
    EXPECT_EQ(list().textAt(0, AnnotationList::BodyColumn), QStringLiteral("Mars"));
    Q_EMIT list().activated(list().model()->index(0, AnnotationList::NameColumn));
    EXPECT_EQ(annotating().current()->name, QStringLiteral("Zeta"));
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    const auto found = annotating().labelPlace(*annotating().current());
    ASSERT_TRUE(found);
    EXPECT_LT((found->toPoint() - at(0.0, 0.0)).manhattanLength(), 20) << "in the middle";
    list().selectRow(1);
    list().selectionModel()->select(list().model()->index(2, 0),
                                    QItemSelectionModel::Select | QItemSelectionModel::Rows);
    const std::vector<std::uint32_t> two = list().selectedIds();
    ASSERT_EQ(two.size(), 2U);
    annotating().setColors(two, Rgb8{255, 0, 0});
    EXPECT_EQ(undo.undoText(), QStringLiteral("Color of 2 Items"));
    EXPECT_EQ(list().selectedIds(), two) << "the selection stays";
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_EQ(annotating().state().items.size(), 1U);
    EXPECT_EQ(undo.undoText(), QStringLiteral("Remove 2 Items"));
    undo.undo();
    EXPECT_EQ(annotating().state().items.size(), 3U);
    annotating().setSymbols({annotating().state().items[0].id}, MarkSymbol::Star);
    EXPECT_EQ(annotating().annotations().front().symbol, MarkSymbol::Star);
}

TEST_F(AnnotationTest, TheyAreDrapedAndInSavedPictures)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    std::vector<std::uint32_t> ids;
    for (const AnnotationItem& item : annotating().state().items) {
        ids.push_back(item.id);
    }
    annotating().setColors(ids, Rgb8{255, 0, 0});
    annotating().select(0);
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    const auto is_red = [](const QColor& seen) {
        return seen.red() > 200 && seen.green() < 80 && seen.blue() < 80;
    };
    // The line follows the terrain: it is not exactly straight on the screen.
    const auto has_line = [&](const QImage& image) {
        for (int y = -8; y <= 8; ++y) {
            if (is_red(image.pixelColor(at(0.0, 0.1) + QPoint(0, y)))) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(has_line(view().terrainPicture()));
    auto* marks = window_->findChild<AnnotationMarks*>();
    ASSERT_NE(marks, nullptr);
    EXPECT_EQ(marks->labelBoxes().size(), 3U);
    const QString file = maps_.path(QStringLiteral("picture.png"));
    auto* saver = window_->findChild<PictureSaver*>();
    bool is_saved = false;
    QObject::connect(saver, &PictureSaver::saved, window_.get(), [&] { is_saved = true; });
    saver->save(
        file, view().camera(),
        {.size = view().size(), .has_legend = false, .has_scale = false, .has_labels = true});
    ASSERT_TRUE(QTest::qWaitFor([&] { return is_saved; }, kTimeout));
    const QImage picture(file);
    EXPECT_TRUE(is_red(picture.pixelColor(at(-0.2, -0.1)))) << "the symbol";
    EXPECT_TRUE(has_line(picture));
}

// Names and results keep clear of each other, and of the symbols where there is room.
TEST_F(AnnotationTest, NoLabelLiesOverAnother)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    for (int i = 0; i < 12; ++i) {
        click(at(-0.15 + 0.025 * i, 0.02 * (i % 3)));
    }
    MeasureController& measuring = *window_->measuring();
    for (const QPoint& place : {at(-0.1, -0.04), at(0.05, 0.06), at(0.05, 0.08)}) {
        measuring.begin(MeasurementKind::Distance);
        click(place);
        click(place + QPoint(120, 0));
        measuring.finish();
    }
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            const auto& items = measuring.state().items;
            return std::all_of(items.begin(), items.end(), [&](const MeasureItem& item) {
                return measuring.outcome(item.id).result != nullptr;
            });
        },
        kTimeout));
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout));
    const auto* annotations = window_->findChild<AnnotationMarks*>();
    const auto* measurements = window_->findChild<MeasureMarks*>();
    EXPECT_GE(annotations->labelBoxes().size(), 5U);
    EXPECT_GE(measurements->labelBoxes().size(), 2U);
    // Names of places follow in a moment.
    const auto is_clear = [&] {
        std::vector<QRectF> boxes = annotations->labelBoxes();
        const std::vector<QRectF> results = measurements->labelBoxes();
        boxes.insert(boxes.end(), results.begin(), results.end());
        for (const MapLabels::Label& name : window_->overlays()->labels()->nameLabels()) {
            boxes.push_back(name.box);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                if (boxes[i].intersects(boxes[k])) {
                    return false;
                }
            }
        }
        return true;
    };
    EXPECT_TRUE(QTest::qWaitFor(is_clear, kTimeout));
}

TEST_F(AnnotationTest, TheMenuRevealsTheTableThoughTheToolIsChosen)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    window_->docks()->annotations()->hide();
    ASSERT_EQ(view().tool(), Tool::Annotate);
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point)); // waits for the table
    EXPECT_TRUE(list().isVisible());
}

TEST_F(AnnotationTest, EnterAtTheLastPointAddsNoOther)
{
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Point));
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().hasFocus(); }, kTimeout));
    click(at(-0.2, -0.1));
    ASSERT_EQ(annotating().state().items.size(), 1U);
    QTest::mouseMove(&view(), at(-0.2, -0.1) + QPoint(1, 0));
    QTest::keyClick(&view(), Qt::Key_Return);
    EXPECT_EQ(annotating().state().items.size(), 1U);
    ASSERT_NO_FATAL_FAILURE(choose(FeatureShape::Line));
    click(at(-0.1, 0.1));
    click(at(0.1, 0.1));
    QTest::mouseMove(&view(), at(0.1, 0.1) + QPoint(1, 0));
    QTest::keyClick(&view(), Qt::Key_Return);
    ASSERT_EQ(annotating().state().items.size(), 2U);
    EXPECT_TRUE(annotating().current()->is_finished);
    EXPECT_EQ(annotating().current()->vertices.size(), 2U);
    QTest::keyClick(&view(), Qt::Key_Return);
    EXPECT_EQ(annotating().state().items.size(), 2U) << "the line is finished";
}

TEST_F(AnnotationTest, AProjectKeepsThemAndTheirStepsAreChanges)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    ProjectController& project = window_->commands().project;
    EXPECT_TRUE(project.isModified());
    const std::vector<Annotation> drawn = annotating().annotations();
    const QString file = maps_.path(QStringLiteral("rims.mvproj"));
    QStringList written;
    QObject::connect(&project, &ProjectController::written, window_.get(),
                     [&](const QStringList& files) { written = files; });
    ASSERT_TRUE(saveProject(project, file));
    EXPECT_FALSE(project.isModified());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project.isWriting(); }, kTimeout));
    EXPECT_EQ(written, QStringList({file, maps_.path(QStringLiteral("rims-annotations.gpkg"))}));
    const QString message = window_->statusBar()->currentMessage();
    EXPECT_TRUE(message.startsWith(QStringLiteral("Saved rims.mvproj"))) << qPrintable(message);
    EXPECT_TRUE(message.endsWith(QStringLiteral(" rims-annotations.gpkg"))) << qPrintable(message);
    EXPECT_NE(test::runTool({"ogrinfo", "-ro", "-so", "-al",
                             maps_.path(QStringLiteral("rims-annotations.gpkg")).toStdString()})
                  .find("Layer name: polygons"),
              std::string::npos);
    annotating().rename(annotating().state().items.front().id, QStringLiteral("other"));
    EXPECT_TRUE(project.isModified());
    project.startNew();
    EXPECT_TRUE(annotating().state().items.empty());
    ASSERT_TRUE(openProject(project, file));
    EXPECT_EQ(annotating().annotations(), drawn);
    ASSERT_TRUE(QTest::qWaitFor([this] { return !window_->session().layers.empty(); }, kTimeout));
}

TEST_F(AnnotationTest, FilesOfOtherProgramsComeAndGo)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    const std::vector<Annotation> drawn = annotating().annotations();
    for (const char* name : {"all.gpkg", "all.kml", "all.geojson", "all.csv"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(exportTo(QString::fromLatin1(name)), QString());
        EXPECT_TRUE(importFrom(QString::fromLatin1(name)).startsWith(QStringLiteral("3 annot")));
        ASSERT_EQ(annotating().state().items.size(), 6U);
        EXPECT_EQ(window_->undoStack().undoText(),
                  QStringLiteral("Import %1").arg(QString::fromLatin1(name)));
        const std::vector<Annotation> all = annotating().annotations();
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(all[3 + i].name, drawn[i].name);
            EXPECT_EQ(all[3 + i].shape, drawn[i].shape);
        }
        window_->undoStack().undo();
    }
    // What is selected alone.
    list().selectAll();
    list().selectionModel()->select(list().model()->index(2, 0),
                                    QItemSelectionModel::Deselect | QItemSelectionModel::Rows);
    EXPECT_EQ(exportTo(QStringLiteral("two.csv")), QString());
    EXPECT_TRUE(importFrom(QStringLiteral("two.csv")).startsWith(QStringLiteral("2 annot")));
}

// A Shapefile holds one kind of shape.
TEST_F(AnnotationTest, TheMessageNamesTheShapefilesThatWereWritten)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    const auto named = [this](const QString& name) {
        QSignalSpy exported(&commands(), &AnnotationCommands::exported);
        EXPECT_EQ(exportTo(name), QString());
        QString file = exported.value(0).value(0).toString();
        EXPECT_TRUE(withPlainDirections(window_->statusBar()->currentMessage())
                        .endsWith(QDir::toNativeSeparators(file)));
        return file;
    };
    QFile stale(maps_.path(QStringLiteral("a.shp"))); // of an earlier export
    ASSERT_TRUE(stale.open(QIODevice::WriteOnly));
    stale.close();
    EXPECT_EQ(named(QStringLiteral("a.shp")), maps_.path(QStringLiteral("a-*.shp")));
    for (const char* written : {"a-points.shp", "a-lines.shp", "a-polygons.shp"}) {
        EXPECT_TRUE(QFile::exists(maps_.path(QString::fromLatin1(written)))) << written;
    }
    EXPECT_EQ(named(QStringLiteral("a.gpkg")), maps_.path(QStringLiteral("a.gpkg")));
    annotating().removeItems({annotating().state().items[2].id, annotating().state().items[1].id});
    ASSERT_EQ(annotating().annotations().size(), 1U);
    EXPECT_EQ(named(QStringLiteral("b.shp")), maps_.path(QStringLiteral("b.shp")));
    EXPECT_TRUE(QFile::exists(maps_.path(QStringLiteral("b.shp"))));
}

TEST_F(AnnotationTest, AFileOfAnotherBodyIsRefusedWithTheReason)
{
    ASSERT_NO_FATAL_FAILURE(drawOneOfEach());
    EXPECT_EQ(exportTo(QStringLiteral("mars.gpkg")), QString());
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_TRUE(importFrom(QStringLiteral("mars.gpkg"))
                    .contains(QStringLiteral("is on Mars, but the map is on the Moon")));
    EXPECT_EQ(annotating().state().items.size(), 3U);
    // Those on Mars are not in a picture of the Moon.
    EXPECT_FALSE(annotating().isShown(annotating().state().items.front()));
    EXPECT_TRUE(annotating().handles().empty());
}

} // namespace marsview
