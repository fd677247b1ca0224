// Saved views in the window: saving, flying, renaming, order, undo, pictures.
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/map_window.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/project_files.h"
#include "ui/commands/window_commands.h"
#include "ui/project/project_controller.h"
#include "ui/views/saved_views.h"

#include <QAbstractItemDelegate>
#include <QAction>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSignalSpy>
#include <QTest>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <set>

namespace marsview {
namespace {

QStringList listOf(std::initializer_list<const char*> texts)
{
    QStringList list;
    for (const char* text : texts) {
        list.append(QString::fromLatin1(text));
    }
    return list;
}

class SavedViewsTest : public MapWindowTest {
protected:
    void openMars()
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
        ASSERT_TRUE(focusMap());
    }
    SavedViews& views() { return window_->commands().views; }
    SavedViewsPanel& panel() { return *window_->savedViewsPanel(); }
    QListWidget& list() { return *panel().list(); }
    const std::vector<SavedView>& saved() { return window_->session().views; }
    QUndoStack& stack() { return window_->undoStack(); }
    QLineEdit* editor() { return list().findChild<QLineEdit*>(); }
    // With Ctrl+B on the map; the suggested name, or the given one, is accepted with Return.
    void save(const QString& name = {})
    {
        view().setFocus();
        QTest::keyClick(window_.get(), Qt::Key_B, Qt::ControlModifier);
        ASSERT_TRUE(waitFor([this] { return editor() != nullptr && editor()->hasFocus(); }));
        if (!name.isEmpty()) {
            editor()->selectAll();
            QTest::keyClicks(editor(), name);
        }
        QTest::keyClick(editor(), Qt::Key_Return);
        ASSERT_TRUE(waitFor([this] { return editor() == nullptr; }));
    }
    OrbitCamera moved(double azimuth_deg, double distance_factor)
    {
        OrbitCamera camera = view().camera();
        camera.azimuth = Angle::degrees(azimuth_deg);
        camera.distance_m *= distance_factor;
        view().setCamera(camera);
        return view().camera();
    }
    bool isAt(const OrbitCamera& camera)
    {
        const OrbitCamera here = view().camera();
        return length(here.target - camera.target) < 1e-3 * camera.distance_m &&
               std::abs(here.distance_m / camera.distance_m - 1.0) < 1e-6 &&
               std::abs(std::remainder((here.azimuth - camera.azimuth).degrees(), 360.0)) < 1e-4;
    }
    bool waitUntilLanded()
    {
        return waitFor([this] { return !views().flight().isPlaying(); });
    }
    QStringList names()
    {
        QStringList names;
        for (const SavedView& view : saved()) {
            names.append(QString::fromStdString(view.name));
        }
        return names;
    }
    QPoint middleOf(int row) { return list().visualItemRect(list().item(row)).center(); }
};

TEST_F(SavedViewsTest, AnEmptyPanelSaysWhatToDo)
{
    openMars();
    views().showPanel()->trigger();
    auto* label = panel().findChild<QLabel*>(QStringLiteral("noViews"));
    ASSERT_NE(label, nullptr);
    EXPECT_TRUE(label->isVisible());
    EXPECT_TRUE(label->text().contains(QStringLiteral("Ctrl+B")));
    save();
    EXPECT_FALSE(label->isVisible());
    EXPECT_TRUE(list().isVisible());
}

TEST_F(SavedViewsTest, SavesWithTheNameOfWhatIsInTheMiddleAndFliesBackByKeyboard)
{
    openMars();
    const auto grid = view().map()->georeference().toGrid(
        GeographicPoint{.longitude = Angle::degrees(226.2), .latitude = Angle::degrees(18.65)});
    ASSERT_TRUE(grid);
    OrbitCamera camera = view().camera();
    camera.target = view().map()->georeference().sceneFrame().toScene(*grid, 1e4);
    camera.distance_m = 1.2e6;
    view().setCamera(camera);
    const OrbitCamera at_volcano = view().camera();
    const double exaggeration = view().exaggeration();
    save();
    ASSERT_EQ(names(), QStringList{QStringLiteral("Olympus Mons")});
    EXPECT_EQ(saved()[0].body, "Mars");
    EXPECT_EQ(stack().undoText(), QStringLiteral("Save View Olympus Mons"));
    save();
    EXPECT_EQ(names()[1], QStringLiteral("Olympus Mons (2)"));

    window_->controller().setExaggeration(exaggeration * 2.0);
    moved(77.0, 1.8);
    const int steps = stack().count();
    list().setFocus();
    list().setCurrentRow(0);
    QTest::keyClick(&list(), Qt::Key_Return);
    EXPECT_TRUE(views().flight().isPlaying());
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_TRUE(isAt(at_volcano));
    EXPECT_DOUBLE_EQ(view().exaggeration(), exaggeration);
    EXPECT_EQ(stack().count(), steps + 1) << "the exaggeration is part of the document";
    EXPECT_EQ(stack().undoText(), QStringLiteral("Go to View Olympus Mons"));
    stack().undo();
    EXPECT_DOUBLE_EQ(view().exaggeration(), exaggeration * 2.0);
}

TEST_F(SavedViewsTest, FliesWithADoubleClickAndWithCtrlAndANumber)
{
    openMars();
    const OrbitCamera first = moved(10.0, 0.6);
    save(QStringLiteral("first"));
    const OrbitCamera second = moved(-120.0, 0.5);
    save(QStringLiteral("second"));
    const int steps = stack().count();
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, middleOf(0));
    doubleClick(*list().viewport(), middleOf(0));
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_TRUE(isAt(first));
    view().setFocus();
    QTest::keyClick(window_.get(), Qt::Key_2, Qt::ControlModifier);
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_TRUE(isAt(second));
    EXPECT_EQ(stack().count(), steps) << "moving the camera is not a change";
}

TEST_F(SavedViewsTest, AnyInputTakesTheCameraOver)
{
    openMars();
    moved(10.0, 0.2);
    save(QStringLiteral("near"));
    moved(170.0, 6.0);
    views().goTo(saved()[0].id);
    QSignalSpy interruptions(&views().flight(), &CameraFlight::interrupted);
    ASSERT_TRUE(views().flight().isPlaying());
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_PageDown);
    ASSERT_TRUE(waitFor([this] { return !view().isMoving(); }));
    EXPECT_EQ(interruptions.count(), 1);
    EXPECT_FALSE(views().flight().isPlaying());
    const OrbitCamera camera = view().camera();
    QCoreApplication::processEvents();
    EXPECT_EQ(view().camera(), camera);
}

TEST_F(SavedViewsTest, RenamingMovingUpdatingAndRemovingAreStepsOfUndo)
{
    openMars();
    save(QStringLiteral("a"));
    save(QStringLiteral("b"));
    save(QStringLiteral("c"));
    const SavedView before = saved()[2];
    EXPECT_EQ(names(), listOf({"a", "b", "c"}));
    list().setFocus();
    list().setCurrentRow(2);
    QTest::keyClick(&list(), Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(names(), listOf({"a", "c", "b"}));
    EXPECT_EQ(list().currentItem()->text(), QStringLiteral("c"));
    QTest::keyClick(&list(), Qt::Key_F2);
    ASSERT_TRUE(waitFor([this] { return editor() != nullptr; }));
    editor()->selectAll();
    QTest::keyClicks(editor(), QStringLiteral("Rim"));
    QTest::keyClick(editor(), Qt::Key_Return);
    ASSERT_TRUE(waitFor([this] { return editor() == nullptr; }));
    EXPECT_EQ(names(), listOf({"a", "Rim", "b"}));
    moved(45.0, 0.5);
    views().actions().update->trigger();
    EXPECT_NE(saved()[1].camera, before.camera);
    EXPECT_EQ(saved()[1].name, "Rim");
    EXPECT_EQ(saved()[1].id, before.id);
    list().setFocus();
    QTest::keyClick(&list(), Qt::Key_Delete);
    EXPECT_EQ(names(), listOf({"a", "b"}));
    EXPECT_EQ(list().count(), 2);

    EXPECT_EQ(stack().undoText(), QStringLiteral("Remove View Rim"));
    stack().undo();
    EXPECT_EQ(names(), listOf({"a", "Rim", "b"}));
    EXPECT_EQ(stack().undoText(), QStringLiteral("Update View Rim"));
    stack().undo();
    EXPECT_EQ(saved()[1].camera, before.camera);
    EXPECT_EQ(stack().undoText(), QStringLiteral("Rename View c"));
    stack().undo();
    EXPECT_EQ(stack().undoText(), QStringLiteral("Move View c"));
    stack().undo();
    EXPECT_EQ(names(), listOf({"a", "b", "c"}));
    EXPECT_EQ(list().item(2)->text(), QStringLiteral("c"));
    EXPECT_EQ(saved()[2], before);
    // It was saved under the name of what is in the middle, and renamed.
    EXPECT_TRUE(stack().undoText().startsWith(QStringLiteral("Rename View ")));
    stack().undo();
    EXPECT_TRUE(stack().undoText().startsWith(QStringLiteral("Save View ")));
    stack().undo();
    EXPECT_EQ(list().count(), 2);
}

TEST_F(SavedViewsTest, ADropReordersThemAndAnEmptyNameIsRefused)
{
    openMars();
    save(QStringLiteral("a"));
    save(QStringLiteral("b"));
    save(QStringLiteral("c"));
    // What the list does with a drop.
    ASSERT_TRUE(list().model()->moveRow({}, 2, {}, 0));
    ASSERT_TRUE(waitFor([this] { return names().first() == QStringLiteral("c"); }));
    EXPECT_EQ(names(), listOf({"c", "a", "b"}));
    EXPECT_EQ(list().item(0)->text(), QStringLiteral("c"));
    list().item(1)->setText(QStringLiteral("  "));
    EXPECT_EQ(list().item(1)->text(), QStringLiteral("a"));
}

TEST_F(SavedViewsTest, PicturesShowTheViewsAndFollowTheLook)
{
    openMars();
    view().setCamera(homeCamera(view().ground().box(view().exaggeration()), view().viewport()));
    save(QStringLiteral("all"));
    moved(90.0, 0.1);
    save(QStringLiteral("near"));
    const auto complete = [this] { return views().thumbnails().isComplete(); };
    ASSERT_TRUE(waitFor(complete));
    const auto picture = [this](std::size_t i) {
        return views().thumbnails().thumbnail(saved()[i].id).toImage();
    };
    const auto colors = [](const QImage& image) {
        std::set<QRgb> found;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                found.insert(image.pixel(x, y));
            }
        }
        return found.size();
    };
    ASSERT_FALSE(picture(0).isNull());
    ASSERT_FALSE(picture(1).isNull());
    EXPECT_GT(colors(picture(0)), 200U);
    EXPECT_NE(picture(0), picture(1));
    EXPECT_FALSE(list().item(0)->icon().isNull());
    const QImage colored = picture(0);
    window_->controller().setShading(ShadingMode::Hillshade);
    ASSERT_TRUE(waitFor([&] { return complete() && picture(0) != colored; }));
}

TEST_F(SavedViewsTest, AViewOnAnotherBodyShowsItsLayer)
{
    makeWindow(kWithPanels);
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    save(QStringLiteral("on Mars"));
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    const LayerId mars = saved()[0].layer;
    window_->controller().setVisible(window_->session().layers.front().id, true);
    ASSERT_EQ(view().map()->info().body->name, "Moon");
    views().goTo(saved()[0].id);
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_EQ(view().map()->info().body->name, "Mars");
    EXPECT_EQ(stack().undoText(), QStringLiteral("Go to View on Mars"));

    // Another map of the body serves as well; without one, the status bar says so.
    window_->controller().remove(mars);
    QSignalSpy reports(&views(), &SavedViews::reported);
    views().goTo(saved()[0].id);
    ASSERT_EQ(reports.count(), 1);
    EXPECT_EQ(reports[0][0].toString(),
              QStringLiteral("on Mars is on Mars: open a map of it first"));
    ASSERT_TRUE(openAndWait(*window_, maps_.mars("other")));
    window_->controller().setVisible(window_->session().layers.back().id, true);
    views().goTo(saved()[0].id);
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_EQ(reports.count(), 1);
    EXPECT_EQ(view().map()->info().body->name, "Mars");
}

TEST_F(SavedViewsTest, AProjectKeepsThem)
{
    const test::TempFolder folder;
    openMars();
    const OrbitCamera first = moved(33.0, 0.4);
    save(QStringLiteral("first"));
    moved(-70.0, 1.5);
    save(QStringLiteral("second"));
    const std::vector<SavedView> before = saved();
    ASSERT_TRUE(
        saveProject(window_->commands().project, QString::fromStdString(folder.file("a.mvproj"))));
    EXPECT_FALSE(window_->isWindowModified());
    window_->controller().renameView(saved()[0].id, QStringLiteral("x"));
    EXPECT_TRUE(window_->isWindowModified());
    window_.reset();

    makeWindow(kWithPanels);
    window_->open(QString::fromStdString(folder.file("a.mvproj")));
    ASSERT_TRUE(waitFor([this] { return names() == listOf({"first", "second"}); }));
    ASSERT_TRUE(
        waitFor([this] { return !window_->controller().isBusy() && view().isPictureComplete(); }));
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(saved()[i].camera, before[i].camera);
        EXPECT_EQ(saved()[i].exaggeration, before[i].exaggeration);
        EXPECT_EQ(saved()[i].layer, window_->session().layers.front().id);
    }
    views().goTo(saved()[0].id);
    ASSERT_TRUE(waitUntilLanded());
    EXPECT_TRUE(isAt(first));
    EXPECT_EQ(stack().count(), 0);
}

TEST_F(SavedViewsTest, ActionsAreOffWithoutAMapOrAView)
{
    makeWindow(kWithPanels);
    const SavedViewActions& actions = views().actions();
    EXPECT_FALSE(actions.save->isEnabled());
    EXPECT_FALSE(actions.go_to->isEnabled());
    EXPECT_FALSE(actions.fly_through->isEnabled());
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    EXPECT_TRUE(actions.save->isEnabled());
    EXPECT_FALSE(actions.update->isEnabled());
    EXPECT_FALSE(actions.remove->isEnabled());
    save(QStringLiteral("local"));
    EXPECT_TRUE(actions.update->isEnabled());
    EXPECT_TRUE(saved()[0].body.empty());
    views().goTo(saved()[0].id);
    EXPECT_TRUE(waitUntilLanded());
}

} // namespace
} // namespace marsview
