// How long a frame takes with many features over the map, and with none. For figures, on an idle
// machine:
//     MARSVIEW_FRAME_FEATURES=1000000 xvfb-run -a build/release/tests/ui/marsview_ui_test
//         --gtest_filter='FeatureFrames*'
#include "core/annotations/annotation.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/ui/map_window.h"
#include "tests/ui/project_files.h"
#include "ui/commands/vector_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/project/project_controller.h"
#include "ui/window/window_actions.h"

#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QSignalSpy>
#include <QTimer>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace marsview {
namespace {

// The longest time since its construction in which the event loop did not run.
class PauseMeter {
public:
    PauseMeter()
    {
        since_.start();
        QObject::connect(&timer_, &QTimer::timeout, [this] { note(); });
        timer_.start(1);
    }
    double longestMs()
    {
        note();
        return longest_ms_;
    }

private:
    void note()
    {
        longest_ms_ = std::fmax(longest_ms_, static_cast<double>(since_.nsecsElapsed()) * 1e-6);
        since_.start();
    }

    QElapsedTimer since_;
    QTimer timer_;
    double longest_ms_ = 0.0;
};

class FeatureFramesTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(kWithPanels);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    // A few thousand in a test, as many as the environment says in a benchmark.
    static int count()
    {
        bool is_set = false;
        const int count = qEnvironmentVariableIntValue("MARSVIEW_FRAME_FEATURES", &is_set);
        return is_set ? count : 5000;
    }
    VectorOverlays& overlays() { return window_->commands().vector_files.overlays(); }
    // Milliseconds a frame while the camera goes round.
    double frameMs()
    {
        EXPECT_TRUE(waitFor([this] { return !overlays().isBusy() && view().isPictureComplete(); }));
        const OrbitCamera home = view().camera();
        constexpr int kFrames = 60;
        constexpr int kWarmUp = 10; // the governor learns what a frame costs
        QElapsedTimer timer;
        for (int i = 0; i < kWarmUp + kFrames; ++i) {
            if (i == kWarmUp) {
                timer.start();
            }
            OrbitCamera camera = home;
            camera.distance_m *= 0.4;
            camera.azimuth = home.azimuth + Angle::degrees(0.5 * i);
            QSignalSpy swapped(&view(), &QOpenGLWidget::frameSwapped);
            view().setCamera(camera);
            while (swapped.isEmpty()) {
                QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
            }
        }
        const double ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6 / kFrames;
        view().setCamera(home);
        return ms;
    }
    void openVector(const QString& file)
    {
        QElapsedTimer timer;
        timer.start();
        overlays().open(file, QString::fromStdString(view().map()->georeference().crs()->wkt()));
        constexpr int kLongMs = 300'000;
        ASSERT_TRUE(QTest::qWaitFor([this] { return !overlays().isBusy(); }, kLongMs));
        std::printf("%s: %.1f MB opened in %.1f s\n", qPrintable(QFileInfo(file).fileName()),
                    static_cast<double>(QFileInfo(file).size()) * 1e-6,
                    static_cast<double>(timer.elapsed()) * 1e-3);
        ASSERT_EQ(window_->session().overlays.size(), 1U);
    }
    QString points(int number)
    {
        const QString path = maps_.path(QStringLiteral("points.csv"));
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        test::Random random(1);
        file.write("lon,lat,name\n");
        for (int i = 0; i < number; ++i) {
            file.write(QByteArray::number(random.uniform(0.0, 360.0), 'f', 5) + ',' +
                       QByteArray::number(random.uniform(-85.0, 85.0), 'f', 5) + ",p" +
                       QByteArray::number(i) + '\n');
        }
        return path;
    }
    void addAnnotations()
    {
        test::Random random(3);
        std::vector<Annotation> annotations;
        Annotation annotation;
        annotation.body = drawnBody(view().map()->georeference(), view().map()->info().body);
        const int number = count(); // a file may have a hundred thousand, a project has many files
        for (int i = 0; i < number; ++i) {
            annotation.name = "p" + std::to_string(i);
            annotation.vertices = {
                DrawnVertex(GeographicPoint{Angle::degrees(random.uniform(0.0, 360.0)),
                                            Angle::degrees(random.uniform(-85.0, 85.0))})};
            annotations.push_back(annotation);
        }
        QElapsedTimer timer;
        timer.start();
        window_->annotating()->add(annotations, QStringLiteral("Import"));
        std::printf("%d annotations added in %.2f s\n", number,
                    static_cast<double>(timer.elapsed()) * 1e-3);
        ASSERT_EQ(window_->annotating()->state().items.size(), static_cast<std::size_t>(number));
    }
    static qint64 fileSize(const std::string& file)
    {
        return QFileInfo(QString::fromStdString(file)).size();
    }
    // Rough lines around the body, of 250 points each and some 40 bytes a point.
    QString coastline(int vertices)
    {
        const QString path = maps_.path(QStringLiteral("coast.geojson"));
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::WriteOnly));
        test::Random random(2);
        file.write("{\"type\":\"FeatureCollection\",\"features\":[\n");
        constexpr int kLine = 250;
        for (int line = 0; line < vertices / kLine; ++line) {
            double longitude = random.uniform(5.0, 355.0);
            double latitude = random.uniform(-80.0, 80.0);
            file.write(line > 0 ? ",\n" : "");
            file.write(
                "{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":"
                "\"LineString\",\"coordinates\":[");
            for (int i = 0; i < kLine; ++i) {
                longitude =
                    std::fmin(359.0, std::fmax(1.0, longitude + random.uniform(-0.02, 0.02)));
                latitude =
                    std::fmin(85.0, std::fmax(-85.0, latitude + random.uniform(-0.02, 0.02)));
                file.write((i > 0 ? ",[" : "[") + QByteArray::number(longitude, 'f', 14) + ',' +
                           QByteArray::number(latitude, 'f', 14) + ']');
            }
            file.write("]}}");
        }
        file.write("]}\n");
        return path;
    }
};

} // namespace

TEST_F(FeatureFramesTest, PointsOfAVectorFile)
{
    const double without_ms = frameMs();
    ASSERT_NO_FATAL_FAILURE(openVector(points(count())));
    const double with_ms = frameMs();
    std::printf("%d points of a file: %.1f ms a frame, without %.1f ms, ratio %.2f\n", count(),
                with_ms, without_ms, with_ms / without_ms);
}

TEST_F(FeatureFramesTest, LinesOfAVectorFile)
{
    const double without_ms = frameMs();
    const int vertices = count() * 5 / 2;
    ASSERT_NO_FATAL_FAILURE(openVector(coastline(vertices)));
    const double with_ms = frameMs();
    std::printf("lines of %d vertices: %.1f ms a frame, without %.1f ms, ratio %.2f\n", vertices,
                with_ms, without_ms, with_ms / without_ms);
}

TEST_F(FeatureFramesTest, Annotations)
{
    const double without_ms = frameMs();
    ASSERT_NO_FATAL_FAILURE(addAnnotations());
    AnnotationController& annotating = *window_->annotating();
    const double with_ms = frameMs();
    std::printf("%d annotations: %.1f ms a frame, without %.1f ms, ratio %.2f\n", count(), with_ms,
                without_ms, with_ms / without_ms);
    QElapsedTimer timer;
    timer.start();
    annotating.rename(annotating.state().items.front().id, QStringLiteral("first"));
    std::printf("a step of undo: %.0f ms\n", static_cast<double>(timer.elapsed()));
}

// The longest time in which the window does not react, while one annotation is edited and copies
// of the project are written.
TEST_F(FeatureFramesTest, EditsWhileCopiesAreWritten)
{
    const test::TempFolder folder;
    WindowOptions options = testWindowOptions();
    options.autosave_folder = folder.path();
    makeWindow(kWithPanels, options);
    ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    ASSERT_NO_FATAL_FAILURE(addAnnotations());
    ProjectController& project = window_->commands().project;
    QElapsedTimer timer;
    timer.start();
    project.autosaveNow();
    std::printf("first copy: %.2f s on its thread\n", static_cast<double>(timer.elapsed()) * 1e-3);
    AnnotationController& annotating = *window_->annotating();
    const std::uint32_t id = annotating.state().items.front().id;
    constexpr int kEdits = 5;
    double edit_ms = 0.0;
    double copy_ms = 0.0;
    for (int i = 0; i < kEdits; ++i) {
        timer.start();
        annotating.setNote(id, QString::number(i));
        QCoreApplication::processEvents();
        edit_ms = std::fmax(edit_ms, static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        timer.start();
        project.autosaveNow();
        copy_ms = std::fmax(copy_ms, static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        EXPECT_TRUE(waitFor([this] { return view().isPictureComplete(); }));
    }
    std::printf("%d annotations, one edited: %.0f ms at most, a copy %.0f ms at most\n", count(),
                edit_ms, copy_ms);
    timer.start();
    PauseMeter saving_pauses;
    ASSERT_TRUE(saveProject(project, QString::fromStdString(folder.file("a.mvproj"))));
    std::printf("saved in %.2f s, %.0f MB, the window does not react for %.0f ms at most\n",
                static_cast<double>(timer.elapsed()) * 1e-3,
                static_cast<double>(fileSize(folder.file("a.mvproj"))) * 1e-6,
                saving_pauses.longestMs());
    constexpr int kLongMs = 300'000;
    ASSERT_TRUE(QTest::qWaitFor([&] { return !project.isWriting(); }, kLongMs));
    timer.start();
    PauseMeter opening_pauses;
    ASSERT_TRUE(openProject(project, QString::fromStdString(folder.file("a.mvproj"))));
    std::printf("opened in %.2f s, the window does not react for %.0f ms at most\n",
                static_cast<double>(timer.elapsed()) * 1e-3, opening_pauses.longestMs());
    EXPECT_EQ(annotating.state().items.size(), static_cast<std::size_t>(count()));
    EXPECT_TRUE(waitFor([this] { return !window_->controller().isBusy(); }));
}

} // namespace marsview
