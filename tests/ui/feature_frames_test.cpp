// How long a frame takes with many features over the map, and with none. For figures, on an idle
// machine:
//     MARSVIEW_FRAME_FEATURES=1000000 xvfb-run -a build/release/tests/ui/marsview_ui_test
//         --gtest_filter='FeatureFrames*'
#include "core/annotations/annotation.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"
#include "tests/ui/map_window.h"
#include "ui/commands/vector_tools.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/window/window_actions.h"

#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace marsview {
namespace {

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
    AnnotationController& annotating = *window_->annotating();
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
    annotating.add(annotations, QStringLiteral("Import"));
    std::printf("%d annotations added in %.2f s\n", number,
                static_cast<double>(timer.elapsed()) * 1e-3);
    ASSERT_EQ(annotating.state().items.size(), static_cast<std::size_t>(number));
    const double with_ms = frameMs();
    std::printf("%d annotations: %.1f ms a frame, without %.1f ms, ratio %.2f\n", number, with_ms,
                without_ms, with_ms / without_ms);
    timer.start();
    annotating.rename(annotating.state().items.front().id, QStringLiteral("first"));
    std::printf("a step of undo: %.0f ms\n", static_cast<double>(timer.elapsed()));
}

} // namespace marsview
