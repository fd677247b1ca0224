// Fly-throughs in the window: along views and lines, playing, recording.
#include "tests/support/temp_folder.h"
#include "tests/ui/map_window.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/measure_controller.h"
#include "ui/views/fly_through_tools.h"
#include "ui/views/saved_views.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

class FlyThroughTest : public MapWindowTest {
protected:
    void openHill()
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }
    // Two views of the map; the camera is at the second one.
    void saveTwoViews()
    {
        first_ = moved(20.0, 1.0);
        save("first");
        second_ = moved(80.0, 0.5);
        save("second");
    }
    OrbitCamera moved(double azimuth_deg, double distance_factor)
    {
        OrbitCamera camera = view().camera();
        camera.azimuth = Angle::degrees(azimuth_deg);
        camera.distance_m *= distance_factor;
        view().setCamera(camera);
        return view().camera();
    }
    void save(const char* name)
    {
        const Map& map = *view().map();
        window_->controller().addView(
            {.name = name,
             .camera = *viewCamera(map.georeference(), view().camera(), view().exaggeration()),
             .exaggeration = view().exaggeration(),
             .layer = window_->session().layers.front().id});
    }
    FlyThroughDialog& openDialog()
    {
        window_->commands().views.actions().fly_through->trigger();
        FlyThroughDialog& dialog = *window_->commands().fly_through.dialog();
        QApplication::setActiveWindow(&dialog); // there is no window manager
        return dialog;
    }
    FlyThroughRecorder& recorder() { return window_->commands().fly_through.recorder(); }
    QString path(const char* name) const { return QString::fromStdString(folder_.file(name)); }
    static RecordingOptions small(int frame_count)
    {
        return {.size = {96, 64},
                .frames_per_s = 25,
                .frame_count = frame_count,
                .has_legend = false,
                .has_labels = false};
    }
    CameraPath viewPath()
    {
        return CameraPath::throughCameras({first_, second_}, FlightPace::Constant);
    }
    // A program called ffmpeg that is found before any other.
    void installFfmpeg(const std::string& script)
    {
        const std::string file = folder_.write("ffmpeg", "#!/bin/sh\n" + script);
        QFile::setPermissions(QString::fromStdString(file),
                              QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        path_before_ = qgetenv("PATH");
        qputenv("PATH", QByteArray::fromStdString(folder_.path().string()) + ":" + path_before_);
    }
    void TearDown() override
    {
        if (!path_before_.isNull()) {
            qputenv("PATH", path_before_);
        }
    }
    bool isNear(const OrbitCamera& a, const OrbitCamera& b)
    {
        return length(a.target - b.target) < 1e-3 * b.distance_m &&
               std::abs(a.distance_m / b.distance_m - 1.0) < 1e-6 &&
               std::abs((a.azimuth - b.azimuth).degrees()) < 1e-4;
    }

    test::TempFolder folder_;
    OrbitCamera first_;
    OrbitCamera second_;
    QByteArray path_before_;
};

} // namespace

TEST_F(FlyThroughTest, WithoutViewsAndLinesItSaysWhatToDo)
{
    openHill();
    FlyThroughDialog& dialog = openDialog();
    EXPECT_FALSE(dialog.path());
    EXPECT_FALSE(dialog.playButton()->isEnabled());
    EXPECT_FALSE(dialog.recordButton()->isEnabled());
    bool is_said = false;
    for (const QLabel* label : dialog.findChildren<QLabel*>()) {
        is_said |= label->isVisible() && label->text().contains(QStringLiteral("Ctrl+B"));
    }
    EXPECT_TRUE(is_said);
    save("one");
    saveTwoViews();
    ASSERT_TRUE(waitFor([&] { return dialog.playButton()->isEnabled(); }));
}

TEST_F(FlyThroughTest, PlaysPausesAndEndsAtTheLastView)
{
    openHill();
    saveTwoViews();
    FlyThroughDialog& dialog = openDialog();
    dialog.duration()->setValue(2.0);
    ASSERT_TRUE(waitFor([&] { return dialog.playButton()->hasFocus(); }));
    QTest::keyClick(dialog.playButton(), Qt::Key_Space);
    ASSERT_TRUE(dialog.flight().isPlaying());
    EXPECT_EQ(dialog.playButton()->accessibleName(), QStringLiteral("Pause"));
    ASSERT_TRUE(waitFor([&] { return dialog.slider()->value() > 100; }));
    QTest::mouseClick(dialog.playButton(), Qt::LeftButton);
    EXPECT_FALSE(dialog.flight().isPlaying());
    const int paused_at = dialog.slider()->value();
    const OrbitCamera camera = view().camera();
    EXPECT_LT(paused_at, dialog.slider()->maximum());
    EXPECT_FALSE(isNear(camera, second_));
    QTest::mouseClick(dialog.playButton(), Qt::LeftButton);
    EXPECT_GE(dialog.slider()->value(), paused_at - 1);
    ASSERT_TRUE(waitFor([&] { return !dialog.flight().isPlaying(); }));
    EXPECT_EQ(dialog.slider()->value(), dialog.slider()->maximum());
    EXPECT_TRUE(isNear(view().camera(), second_));
    EXPECT_EQ(dialog.playButton()->accessibleName(), QStringLiteral("Play"));
    // At the end, it begins again.
    QTest::mouseClick(dialog.playButton(), Qt::LeftButton);
    EXPECT_LT(dialog.slider()->value(), 100);
    dialog.close();
    EXPECT_TRUE(waitFor([this] { return window_->commands().fly_through.dialog() == nullptr; }));
}

TEST_F(FlyThroughTest, TheSliderShowsAnyMomentAndAnInputOfTheMapPauses)
{
    openHill();
    saveTwoViews();
    FlyThroughDialog& dialog = openDialog();
    dialog.slider()->setFocus();
    QTest::keyClick(dialog.slider(), Qt::Key_Home);
    QTest::keyClick(dialog.slider(), Qt::Key_PageUp);
    EXPECT_EQ(dialog.slider()->value(), 50);
    EXPECT_TRUE(isNear(view().camera(), dialog.path()->at(0.05)));
    dialog.duration()->setValue(10.0);
    dialog.playButton()->click();
    ASSERT_TRUE(dialog.flight().isPlaying());
    view().step(NavigationStep::TurnLeft);
    ASSERT_TRUE(waitFor([&] { return !dialog.flight().isPlaying() && !view().isMoving(); }));
    EXPECT_EQ(dialog.playButton()->accessibleName(), QStringLiteral("Play"));
}

TEST_F(FlyThroughTest, FollowsAMeasuredLine)
{
    openHill();
    MeasureController& measure = *window_->measuring();
    measure.begin(MeasurementKind::Distance);
    measure.addPointAt({10.0, 10.0});
    measure.addPointAt({50.0, 30.0});
    measure.finish();
    FlyThroughDialog& dialog = openDialog();
    ASSERT_EQ(dialog.source()->count(), 2);
    EXPECT_EQ(dialog.source()->currentIndex(), 1) << "there are no views to fly along";
    ASSERT_TRUE(dialog.path());
    const Georeference& georeference = view().map()->georeference();
    const auto at = [&](double share) {
        return georeference.sceneFrame().toGrid(dialog.path()->at(share).target);
    };
    EXPECT_NEAR(at(0.0).column, 10.0, 1e-6);
    EXPECT_NEAR(at(0.0).row, 10.0, 1e-6);
    // On the line, and near its middle: the terrain is not symmetric, and the camera keeps above
    // it.
    EXPECT_NEAR(at(0.5).column, 30.0, 1.0);
    EXPECT_NEAR(at(0.5).row - 10.0, (at(0.5).column - 10.0) / 2.0, 1e-3);
    EXPECT_NEAR(at(1.0).column, 50.0, 1e-6);
    EXPECT_NEAR(dialog.path()->at(0.5).azimuth.degrees(),
                90.0 + std::atan2(20.0, 40.0) * 180.0 / 3.14159265358979, 0.5);
}

TEST_F(FlyThroughTest, RecordsNumberedPicturesOfThePath)
{
    openHill();
    saveTwoViews();
    QSignalSpy saved(&recorder(), &FlyThroughRecorder::saved);
    QSignalSpy progress(&recorder(), &FlyThroughRecorder::progressed);
    recorder().start(viewPath(), path("flight.png"), small(5));
    EXPECT_TRUE(recorder().isRecording());
    ASSERT_TRUE(waitFor([&] { return saved.count() == 1; }));
    EXPECT_EQ(saved[0][0].toString(), path("flight_0001.png"));
    EXPECT_EQ(progress.last()[1].toDouble(), 1.0);
    for (int i = 1; i <= 5; ++i) {
        const QImage frame(FlyThroughRecorder::frameFile(path("flight.png"), i));
        EXPECT_EQ(frame.size(), QSize(96, 64)) << i;
    }
    EXPECT_FALSE(QFile::exists(path("flight_0006.png")));
    // The last picture is that of the window's own camera.
    QImage last(96, 64, QImage::Format_RGB888);
    const auto drawn = view().drawPart(second_, view().style(), last.rect(),
                                       {.lines = PictureLines::Omitted}, last);
    ASSERT_TRUE(drawn && *drawn);
    EXPECT_EQ(QImage(path("flight_0005.png")).convertToFormat(QImage::Format_RGB888), last);
    EXPECT_NE(QImage(path("flight_0001.png")), QImage(path("flight_0005.png")));
}

TEST_F(FlyThroughTest, CancelingLeavesNothingBehind)
{
    openHill();
    saveTwoViews();
    QSignalSpy canceled(&recorder(), &FlyThroughRecorder::canceled);
    recorder().start(viewPath(), path("flight.png"), small(200));
    ASSERT_TRUE(waitFor([this] { return QFile::exists(path("flight_0003.png")); }));
    recorder().cancel();
    EXPECT_EQ(canceled.count(), 1);
    EXPECT_FALSE(recorder().isRecording());
    EXPECT_TRUE(waitFor([this] { return std::filesystem::is_empty(folder_.path()); }));
}

TEST_F(FlyThroughTest, NeverReplacesPicturesThatAreThere)
{
    openHill();
    saveTwoViews();
    folder_.write("flight_0003.png", "mine");
    QSignalSpy failed(&recorder(), &FlyThroughRecorder::failed);
    recorder().start(viewPath(), path("flight.png"), small(5));
    ASSERT_EQ(failed.count(), 1);
    EXPECT_TRUE(failed[0][0].toString().contains(QStringLiteral("flight_0003.png exists already")));
    QFile file(path("flight_0003.png"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll(), "mine");
    EXPECT_FALSE(QFile::exists(path("flight_0001.png")));
}

// A program that keeps the pictures that it gets shows what ffmpeg would encode.
TEST_F(FlyThroughTest, SendsEveryPictureToFfmpeg)
{
    openHill();
    saveTwoViews();
    installFfmpeg("for last; do :; done\necho \"$@\" > \"$last.arguments\"\ncat > \"$last\"\n");
    QSignalSpy saved(&recorder(), &FlyThroughRecorder::saved);
    recorder().start(viewPath(), path("flight.mp4"), small(4));
    ASSERT_TRUE(waitFor([&] { return saved.count() == 1; }));
    QFile video(path("flight.mp4"));
    ASSERT_TRUE(video.open(QIODevice::ReadOnly));
    const QByteArray pixels = video.readAll();
    constexpr qsizetype kFrameBytes = 96 * 64 * 3;
    ASSERT_EQ(pixels.size(), 4 * kFrameBytes);
    QImage last(96, 64, QImage::Format_RGB888);
    const auto drawn = view().drawPart(second_, view().style(), last.rect(),
                                       {.lines = PictureLines::Omitted}, last);
    ASSERT_TRUE(drawn && *drawn);
    const QImage sent(reinterpret_cast<const uchar*>(pixels.constData()) + 3 * kFrameBytes, 96, 64,
                      qsizetype{96} * 3, QImage::Format_RGB888);
    EXPECT_EQ(sent, last);
    QFile arguments(path("flight.mp4.part.arguments"));
    ASSERT_TRUE(arguments.open(QIODevice::ReadOnly));
    const QByteArray text = arguments.readAll();
    EXPECT_TRUE(text.contains("-video_size 96x64"));
    EXPECT_TRUE(text.contains("-framerate 25"));
    EXPECT_FALSE(QFile::exists(path("flight.mp4.part")));
}

TEST_F(FlyThroughTest, ReportsWhatFfmpegSays)
{
    openHill();
    saveTwoViews();
    installFfmpeg("echo first line >&2\necho Unknown encoder libx264 >&2\nexit 1\n");
    folder_.write("flight.mp4", "old");
    QSignalSpy failed(&recorder(), &FlyThroughRecorder::failed);
    recorder().start(viewPath(), path("flight.mp4"), small(50));
    ASSERT_TRUE(waitFor([&] { return failed.count() == 1; }));
    EXPECT_TRUE(failed[0][0].toString().contains(QStringLiteral("Unknown encoder libx264")))
        << failed[0][0].toString().toStdString();
    QFile file(path("flight.mp4"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll(), "old");
}

TEST_F(FlyThroughTest, TheDialogRecordsWhatItPlays)
{
    openHill();
    saveTwoViews();
    FlyThroughDialog& dialog = openDialog();
    dialog.duration()->setValue(1.0);
    dialog.format()->setCurrentIndex(dialog.format()->count() - 1); // pictures
    EXPECT_EQ(dialog.recordingOptions().frame_count, 30);
    EXPECT_EQ(dialog.recordingOptions().size, QSize(1920, 1080));
    QSignalSpy requests(&dialog, &FlyThroughDialog::recordRequested);
    QTest::mouseClick(dialog.recordButton(), Qt::LeftButton);
    auto* files = dialog.findChild<QFileDialog*>(QStringLiteral("recordDialog"));
    ASSERT_NE(files, nullptr);
    Q_EMIT files->fileSelected(path("flight.png"));
    ASSERT_EQ(requests.count(), 1);
    EXPECT_TRUE(recorder().isRecording());
    recorder().cancel();
    files->close();
}

} // namespace marsview
