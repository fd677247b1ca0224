// Notices: which are on the bar, the effect of their buttons, and that closed ones stay closed.

#include "tests/support/run_program.h"
#include "tests/ui/map_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/file_opening.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/contact_sounds.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/recent_files.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/project/project_controller.h"
#include "ui/widgets/notice_bar.h"
#include "ui/widgets/notice_center.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QApplication>
#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

QString textOn(const NoticeBar& bar)
{
    return bar.isHidden() ? QString()
                          : bar.findChild<QLabel*>(QStringLiteral("noticeText"))->text();
}

QToolButton* noticeButton(const NoticeBar& bar, const char* name)
{
    return bar.findChild<QToolButton*>(QLatin1String(name));
}

Notice noticeNamed(const QString& id)
{
    return {.id = id, .text = id};
}

class NoticeCenterTest : public testing::Test {
protected:
    NoticeBar bar_;
    NoticeCenter center_{bar_};
};

TEST_F(NoticeCenterTest, ShowsTheMostUrgentFirstAndTheOthersOneByOne)
{
    center_.setNotices(NoticeSource::Layer,
                       {noticeNamed(QStringLiteral("a")), noticeNamed(QStringLiteral("b"))});
    EXPECT_EQ(textOn(bar_), QStringLiteral("a"));
    EXPECT_EQ(noticeButton(bar_, "noticeNext")->text(), QStringLiteral("1 of 2 ›"));
    noticeButton(bar_, "noticeNext")->click();
    EXPECT_EQ(textOn(bar_), QStringLiteral("b"));
    noticeButton(bar_, "noticeNext")->click();
    EXPECT_EQ(textOn(bar_), QStringLiteral("a"));
    center_.setNotices(NoticeSource::Device, {noticeNamed(QStringLiteral("d"))});
    EXPECT_EQ(textOn(bar_), QStringLiteral("d"));
    center_.setNotices(NoticeSource::Device, {});
    center_.setNotices(NoticeSource::Layer, {noticeNamed(QStringLiteral("a"))});
    EXPECT_EQ(textOn(bar_), QStringLiteral("a"));
    EXPECT_TRUE(noticeButton(bar_, "noticeNext")->isHidden());
}

TEST_F(NoticeCenterTest, ClosesOneNoticeAtATime)
{
    center_.setNotices(NoticeSource::Layer,
                       {noticeNamed(QStringLiteral("a")), noticeNamed(QStringLiteral("b")),
                        noticeNamed(QStringLiteral("c"))});
    noticeButton(bar_, "noticeNext")->click();
    noticeButton(bar_, "noticeClose")->click();
    EXPECT_EQ(textOn(bar_), QStringLiteral("a"));
    EXPECT_EQ(noticeButton(bar_, "noticeNext")->text(), QStringLiteral("1 of 2 ›"));
    noticeButton(bar_, "noticeClose")->click();
    EXPECT_EQ(textOn(bar_), QStringLiteral("c"));
    noticeButton(bar_, "noticeClose")->click();
    EXPECT_TRUE(bar_.isHidden());
}

TEST_F(NoticeCenterTest, KeepsWhatWasClosedClosedWhileOtherLayersComeAndGo)
{
    const QList<Notice> of_layer{noticeNamed(QStringLiteral("a"))};
    center_.setNotices(NoticeSource::Layer, of_layer);
    noticeButton(bar_, "noticeClose")->click();
    EXPECT_TRUE(bar_.isHidden());
    center_.setNotices(NoticeSource::Layer, {});
    center_.setNotices(NoticeSource::Layer, of_layer);
    EXPECT_TRUE(bar_.isHidden());
    center_.setNotices(NoticeSource::Layer,
                       {noticeNamed(QStringLiteral("a")), noticeNamed(QStringLiteral("new"))});
    EXPECT_EQ(textOn(bar_), QStringLiteral("new"));
}

TEST_F(NoticeCenterTest, ReportsTheNextEmergencyStopAfterOneWasClosed)
{
    const QList<Notice> stopped{noticeNamed(QStringLiteral("stopped"))};
    center_.setNotices(NoticeSource::Device, stopped);
    noticeButton(bar_, "noticeClose")->click();
    center_.setNotices(NoticeSource::Device, stopped);
    EXPECT_TRUE(bar_.isHidden());
    center_.setNotices(NoticeSource::Device, {});
    center_.setNotices(NoticeSource::Device, stopped);
    EXPECT_EQ(textOn(bar_), QStringLiteral("stopped"));
}

TEST_F(NoticeCenterTest, RunsTheActionOfTheNoticeThatIsShown)
{
    QStringList done;
    const auto action = [&done](const QString& name) {
        return NoticeAction{name, [&done, name] { done.append(name); }};
    };
    Notice one = noticeNamed(QStringLiteral("one"));
    one.actions = {action(QStringLiteral("Try Again"))};
    Notice several = noticeNamed(QStringLiteral("several"));
    several.actions = {action(QStringLiteral("Mars")), action(QStringLiteral("Moon"))};
    several.menu_text = QStringLiteral("Set CRS");
    several.show_details = [&done] { done.append(QStringLiteral("details")); };
    center_.setNotices(NoticeSource::Layer, {one, several});
    QToolButton* button = noticeButton(bar_, "noticeAction");
    EXPECT_EQ(button->text(), QStringLiteral("Try Again"));
    EXPECT_TRUE(noticeButton(bar_, "noticeDetails")->isHidden()); // it would show nothing
    button->click();
    EXPECT_EQ(done, QStringList{QStringLiteral("Try Again")});
    noticeButton(bar_, "noticeNext")->click();
    EXPECT_EQ(button->text(), QStringLiteral("Set CRS"));
    ASSERT_NE(button->menu(), nullptr);
    button->menu()->actions().at(1)->trigger();
    noticeButton(bar_, "noticeDetails")->click();
    EXPECT_EQ(done.mid(1), (QStringList{QStringLiteral("Moon"), QStringLiteral("details")}));
}

class NoticesTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow({1280, 500});
        ASSERT_TRUE(waitUntilSettled(*window_));
    }
    NoticeBar& bar() { return *window_->findChild<NoticeBar*>(); }
    QString shown() { return textOn(bar()); }
};

TEST_F(NoticesTest, StayClosedAfterUndoAndWhenLayersChange)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    ASSERT_TRUE(shown().contains(QStringLiteral("CRS"))) << shown().toStdString();
    noticeButton(bar(), "noticeClose")->click();
    EXPECT_EQ(shown(), QString());
    const LayerId hill = window_->session().active;
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->controller().activate(hill);
    EXPECT_EQ(shown(), QString());
    window_->controller().rename(hill, QStringLiteral("Hill"));
    window_->undoStack().undo();
    EXPECT_EQ(shown(), QString());
    window_->controller().remove(hill);
    window_->undoStack().undo();
    window_->controller().activate(hill);
    EXPECT_EQ(shown(), QString());
    // The same file opened again is reported again.
    window_->controller().remove(hill);
    ASSERT_TRUE(openAndWait(*window_, maps_.path(QStringLiteral("hill.asc"))));
    EXPECT_NE(shown(), QString());
}

// GDAL's names of files in archives are long: a button opens each of the others.
TEST_F(NoticesTest, RastersOfAnArchiveOpenFromItsNotice)
{
    for (const char* name : {"small.asc", "large.asc", "other & more.asc"}) {
        TestMaps::Shape shape;
        shape.columns = name[0] == 'l' ? 90 : 60;
        maps_.write(QString::fromLatin1(name), shape,
                    [](int column, int row) { return column + row; });
    }
    const QString archive = maps_.path(QStringLiteral("maps.zip"));
    test::runTool({"python3", "-c",
                   "import sys, zipfile\n"
                   "with zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED) as z:\n"
                   "    for name in ('small.asc', 'large.asc', 'other & more.asc'):\n"
                   "        z.write(sys.argv[2] + name, name)",
                   archive.toStdString(), maps_.path(QString()).toStdString() + "/"});
    ASSERT_TRUE(openAndWait(*window_, archive));
    EXPECT_EQ(activeLayer(window_->session())->name, "large.asc");
    // Without a CRS, another notice comes first.
    while (!shown().contains(QStringLiteral("maps.zip"))) {
        ASSERT_FALSE(noticeButton(bar(), "noticeNext")->text().startsWith(QStringLiteral("2 of 2")))
            << shown().toStdString();
        noticeButton(bar(), "noticeNext")->click();
    }
    EXPECT_EQ(shown(), QStringLiteral("large.asc is shown, one of the 3 rasters in maps.zip"));
    QMenu* menu = noticeButton(bar(), "noticeAction")->menu();
    ASSERT_NE(menu, nullptr);
    ASSERT_EQ(menu->actions().size(), 2);
    EXPECT_EQ(menu->actions()[0]->text(), QStringLiteral("other && more.asc (60 × 40)"));
    EXPECT_EQ(menu->actions()[1]->text(), QStringLiteral("small.asc (60 × 40)"));
    menu->actions()[1]->trigger();
    ASSERT_TRUE(waitFor([this] { return window_->session().layers.size() == 2; }));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(activeLayer(window_->session())->name, "small.asc");
    const RecentFiles& recent = *window_->commands().files.recentFiles();
    EXPECT_TRUE(recent.files().front().endsWith(QStringLiteral("maps.zip/small.asc")));
}

TEST_F(NoticesTest, DetailsRevealsTheNoticeAmongTheFacts)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    GeoreferencingPanel& panel = *window_->georeferencingPanel();
    const auto fact = [&panel, this]() -> const QLabel* {
        for (const QLabel* label : panel.findChildren<QLabel*>(QStringLiteral("notice"))) {
            if (shown().endsWith(label->text().mid(3))) {
                return label;
            }
        }
        return nullptr;
    };
    ASSERT_NE(fact(), nullptr);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !fact()->visibleRegion().isEmpty(); }, kTimeout));
    QScrollBar* scroll = panel.findChild<QScrollArea*>()->verticalScrollBar();
    ASSERT_TRUE(QTest::qWaitFor([&] { return scroll->maximum() > 0; }, kTimeout))
        << "the panel shows everything; make the window lower";
    scroll->setValue(scroll->maximum());
    ASSERT_TRUE(fact()->visibleRegion().isEmpty());
    window_->view()->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->view()->hasFocus(); }, kTimeout));
    QTest::mouseClick(noticeButton(bar(), "noticeDetails"), Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return fact()->visibleRegion().boundingRect().height() == fact()->height(); },
        kTimeout));
    EXPECT_TRUE(window_->view()->hasFocus()) << "the keys of the map stay in effect";
    // The same with the panel closed, and by keyboard.
    window_->docks()->georeferencing()->close();
    noticeButton(bar(), "noticeDetails")->setFocus();
    QTest::keyClick(noticeButton(bar(), "noticeDetails"), Qt::Key_Space);
    EXPECT_TRUE(QTest::qWaitFor([&] { return fact()->hasFocus(); }, kTimeout));
}

TEST_F(NoticesTest, TheReplacedSampleCanBeKept)
{
    window_->openSample(maps_.mars("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    const LayerId sample = window_->session().active;
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_EQ(shown(), QStringLiteral("The sample map of Mars was closed to show your file"));
    QToolButton* keep = noticeButton(bar(), "noticeAction");
    EXPECT_EQ(keep->text(), QStringLiteral("Keep Mars"));
    QTest::mouseClick(keep, Qt::LeftButton);
    ASSERT_EQ(window_->session().layers.size(), 2U);
    EXPECT_EQ(window_->session().layers[1].id, sample);
    EXPECT_FALSE(window_->session().layers[1].is_sample);
    EXPECT_FALSE(shown().contains(QStringLiteral("sample")));
    // Further maps do not close it, and the decision to keep it can be undone.
    ASSERT_TRUE(openAndWait(*window_, maps_.mars("other")));
    EXPECT_EQ(window_->session().layers.size(), 3U);
    window_->undoStack().undo();
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().layers.size(), 1U);
    window_->undoStack().undo();
    EXPECT_EQ(window_->session().layers.at(0).id, sample);
    EXPECT_TRUE(window_->session().layers.at(0).is_sample);
    EXPECT_FALSE(shown().contains(QStringLiteral("sample")));
}

// Closing it would take the results along.
TEST_F(NoticesTest, ASampleThatWasMeasuredStays)
{
    window_->openSample(maps_.mars("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    MeasureController& measuring = *window_->measuring();
    measuring.begin(MeasurementKind::Distance);
    measuring.addPointAt({10.0, 10.0});
    measuring.addPointAt({20.0, 15.0});
    measuring.finish();
    const LayerId measured = measuring.state().items.back().layer;
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    ASSERT_EQ(window_->session().layers.size(), 2U);
    EXPECT_EQ(window_->session().layers[1].id, measured);
    EXPECT_FALSE(window_->session().layers[1].is_sample);
    EXPECT_FALSE(shown().contains(QStringLiteral("sample")));
}

TEST_F(NoticesTest, ASampleInASavedProjectStays)
{
    window_->openSample(maps_.mars("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_TRUE(
        saveProject(window_->commands().project, maps_.path(QStringLiteral("kept.mvproj"))));
    ASSERT_TRUE(openAndWait(*window_, maps_.moon()));
    EXPECT_EQ(window_->session().layers.size(), 2U);
}

// A hole of -32767 that the file does not declare: it is a hole from the first picture on, and the
// decision comes before all other notices.
TEST_F(NoticesTest, UndeclaredNodataIsAHoleAndAnElevationByOneClick)
{
    const QString declared = maps_.write(QStringLiteral("lake.asc"), {}, [](int column, int row) {
        return column > 20 && column < 30 && row > 10 && row < 20 ? -32767.0 : 1000.0 + row;
    });
    const QString lake = maps_.path(QStringLiteral("lake.tif"));
    test::runTool({"gdal_translate", "-q", "-ot", "Int16", "-a_nodata", "none", "-a_srs",
                   "EPSG:32610", declared.toStdString(), lake.toStdString()});
    window_->openSample(maps_.mars("sample"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    ASSERT_TRUE(openAndWait(*window_, lake));
    const auto lowest = [this] {
        const Layer* layer = activeLayer(window_->session());
        return layer != nullptr ? layer->map->heightfield().range()->minimum_m : 0.0;
    };
    EXPECT_EQ(lowest(), 1000.0);
    EXPECT_EQ(window_->undoStack().count(), 1) << "opening is one step";
    EXPECT_FALSE(window_->isWindowModified());
    EXPECT_EQ(shown(), QStringLiteral("Samples of −32767 are shown as nodata, although the file "
                                      "declares no nodata value"));
    const auto is_fact = [this](const QString& text) {
        const auto labels = window_->georeferencingPanel()->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(),
                           [&text](const QLabel* label) { return label->text() == text; });
    };
    EXPECT_TRUE(is_fact(QStringLiteral("−32767, assumed")));
    EXPECT_FALSE(is_fact(QStringLiteral("Set by you")));
    QToolButton* button = noticeButton(bar(), "noticeAction");
    EXPECT_EQ(button->text(), QStringLiteral("Show as Elevations"));
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] { return lowest() == -32767.0; })) << lowest();
    EXPECT_EQ(shown(), QStringLiteral("Samples of −32767 often mark nodata, but the file declares "
                                      "no nodata value"));
    EXPECT_EQ(button->text(), QStringLiteral("Set −32767 as Nodata"));
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] { return lowest() == 1000.0; })) << lowest();
    window_->undoStack().undo();
    EXPECT_EQ(lowest(), -32767.0);
    EXPECT_TRUE(shown().contains(QStringLiteral("often mark"))) << shown().toStdString();
}

// -3276.7 m may be the bottom of a sea: it stays an elevation until the user decides.
TEST_F(NoticesTest, UndeclaredNodataThatMayBeAnElevationIsKept)
{
    const auto lowest = [this] {
        return activeLayer(window_->session())->map->heightfield().range()->minimum_m;
    };
    const QString file = maps_.path(QStringLiteral("half.tif"));
    test::runTool(
        {"gdal_translate", "-q", "-ot", "Int16", "-a_nodata", "none", "-a_scale", "0.1",
         "-a_offset", "0",
         maps_
             .write(QStringLiteral("half.asc"), {},
                    [](int column, int row) { return column < 3 ? -32767.0 : 1000.0 + row; })
             .toStdString(),
         file.toStdString()});
    ASSERT_TRUE(openAndWait(*window_, file));
    EXPECT_NEAR(lowest(), -3276.7, 1e-3);
    EXPECT_TRUE(shown().contains(QStringLiteral("often mark"))) << shown().toStdString();
    // All samples are of that value: the map is shown as the file has it.
    const QString flat = maps_.path(QStringLiteral("flat.tif"));
    test::runTool({"gdal_translate", "-q", "-ot", "Int16", "-a_nodata", "none",
                   maps_.write(QStringLiteral("flat.asc"), {}, [](int, int) { return -32767.0; })
                       .toStdString(),
                   flat.toStdString()});
    ASSERT_TRUE(openAndWait(*window_, flat));
    EXPECT_EQ(lowest(), -32767.0);
    EXPECT_FALSE(window_->controller().isNodataAssumed(*activeLayer(window_->session())));
}

// The highest of the samples is above Mount Everest, if they are in meters.
TEST_F(NoticesTest, ElevationsInFeetAreReadAsSuchByOneClick)
{
    const QString file =
        maps_.write(QStringLiteral("peaks.asc"), {}, [](int, int row) { return 9000.0 + row; });
    const QString placed = maps_.path(QStringLiteral("peaks.tif"));
    test::runTool(
        {"gdal_translate", "-q", "-a_srs", "EPSG:32613", file.toStdString(), placed.toStdString()});
    ASSERT_TRUE(openAndWait(*window_, placed));
    const auto highest = [this] {
        return activeLayer(window_->session())->map->heightfield().range()->maximum_m;
    };
    const double as_meters = highest();
    EXPECT_EQ(shown(), QStringLiteral("Looks like feet, but the file has no unit of elevation: no "
                                      "place on the Earth is as high as %1 m")
                           .arg(QLocale().toString(as_meters, 'f', 0)));
    QToolButton* button = noticeButton(bar(), "noticeAction");
    EXPECT_EQ(button->text(), QStringLiteral("Use Feet"));
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] { return highest() < as_meters; }));
    EXPECT_NEAR(highest(), as_meters * 0.3048, 1e-6);
    EXPECT_FALSE(shown().contains(QStringLiteral("feet"))) << shown().toStdString();
    window_->undoStack().undo();
    EXPECT_EQ(highest(), as_meters);
}

// Twice what the Moon has, and a grid in meters with a CRS in degrees.
TEST_F(NoticesTest, WhatCannotBeOnTheBodyOpensItsFields)
{
    const QString grid = maps_.write(QStringLiteral("high.asc"), {}, [](int column, int row) {
        return 20000.0 + 10.0 * row + column;
    });
    const QString high = maps_.path(QStringLiteral("high.tif"));
    test::runTool({"gdal_translate", "-q", "-ot", "Int16", "-a_srs", "IAU_2015:30110",
                   grid.toStdString(), high.toStdString()});
    const QString line = maps_.path(QStringLiteral("line.tif"));
    test::runTool({"gdal_translate", "-q", "-ot", "Byte", "-a_srs", "IAU_2015:49900", "-a_ullr",
                   "376313.65", "3350820", "380000", "3340000", grid.toStdString(),
                   line.toStdString()});
    for (const auto& [file, beginning] :
         {std::pair{high, QStringLiteral("The elevations reach 20449 m, ")},
          {line, QStringLiteral("The CRS \"Mars (2015) - Sphere / Ocentric\" of the file is not "
                                "used: it is in degrees, but the grid covers x 376314 to 380000 "
                                "and y 3340000 to 3350820")}}) {
        ASSERT_TRUE(openAndWait(*window_, file));
        EXPECT_TRUE(shown().startsWith(beginning)) << shown().toStdString();
        QToolButton* button = noticeButton(bar(), "noticeAction");
        EXPECT_EQ(button->text(), QStringLiteral("Set Body, CRS…"));
        QTest::mouseClick(button, Qt::LeftButton);
        const auto* field =
            window_->georeferencingPanel()->findChild<QWidget*>(QStringLiteral("crs"));
        EXPECT_TRUE(field != nullptr && field->isVisible());
    }
    EXPECT_FALSE(activeLayer(window_->session())->map->info().crs);
}

class FailureNoticesTest : public NoticesTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.failures = WindowOptions::Failures::AsNotices;
        makeWindow({1280, 500}, options);
        ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    }
};

TEST_F(FailureNoticesTest, AFileThatCannotBeOpenedIsReportedOverTheMapThatStays)
{
    QFile file(maps_.path(QStringLiteral("broken.tif")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("not a TIFF");
    file.close();
    const auto open = [&] {
        window_->open(file.fileName());
        ASSERT_TRUE(waitUntilSettled(*window_));
    };
    open();
    EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
    EXPECT_TRUE(shown().startsWith(QStringLiteral("Cannot Open Map: ") + file.fileName()))
        << shown().toStdString();
    EXPECT_EQ(window_->session().layers.size(), 1U);
    // A map that was opened with it does not hide it; it is old news when another one is asked for.
    window_->commands().files.open({file.fileName(), maps_.mars("other")});
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_EQ(window_->session().layers.size(), 2U);
    EXPECT_TRUE(shown().contains(file.fileName()));
    EXPECT_TRUE(noticeButton(bar(), "noticeNext")->isHidden());
    window_->open(maps_.mars("third"));
    ASSERT_TRUE(waitUntilSettled(*window_));
    EXPECT_FALSE(shown().contains(file.fileName())) << shown().toStdString();
    open();
    EXPECT_TRUE(shown().contains(file.fileName()));
    noticeButton(bar(), "noticeClose")->click();
    EXPECT_EQ(shown(), QString());
    open();
    EXPECT_TRUE(shown().contains(file.fileName())) << "it failed once more";
}

class SoundMemoryTest : public testing::Test {
protected:
    void SetUp() override { QSettings().clear(); }
    void TearDown() override { QSettings().clear(); }
    static bool remembered()
    {
        return QSettings().value(QStringLiteral("haptics/sound"), false).toBool();
    }
    static WindowOptions remembering()
    {
        return {.geometry = WindowOptions::Geometry::Remembered,
                .failures = WindowOptions::Failures::BySignalOnly};
    }
};

TEST_F(SoundMemoryTest, IsNotOnAtTheNextStartIfItFailed)
{
    WindowOptions options = remembering();
    options.open_sound = []() -> Result<SoundPlayer> {
        return Error{ErrorCode::NotFound, "sound: no output device"};
    };
    MainWindow window(options);
    const QSignalSpy failures(&window, &MainWindow::openFailed);
    QAction* action = window.actionSet().contact_sound;
    action->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return failures.count() == 1; }, kTimeout));
    EXPECT_FALSE(action->isChecked());
    EXPECT_FALSE(remembered());
}

TEST_F(SoundMemoryTest, FailsSilentlyAtTheStartAndIsForgotten)
{
    QSettings().setValue(QStringLiteral("haptics/sound"), true);
    WindowOptions options = remembering();
    options.open_sound = []() -> Result<SoundPlayer> {
        return Error{ErrorCode::NotFound, "sound: no output device"};
    };
    MainWindow window(options);
    const QSignalSpy failures(&window, &MainWindow::openFailed);
    ASSERT_TRUE(QTest::qWaitFor([] { return !remembered(); }, kTimeout));
    EXPECT_FALSE(window.actionSet().contact_sound->isChecked());
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SoundMemoryTest, IsOnAtTheNextStartIfItPlayed)
{
    WindowOptions options = remembering();
    options.open_sound = [] { return SoundPlayer::openLoopback(); };
    MainWindow window(options);
    window.actionSet().contact_sound->trigger();
    ASSERT_TRUE(QTest::qWaitFor([] { return remembered(); }, kTimeout));
    window.actionSet().contact_sound->trigger();
    EXPECT_FALSE(remembered());
}

} // namespace
} // namespace marsview
