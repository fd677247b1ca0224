// How long a frame takes with many features over the map, and with none. For figures, on an idle
// machine, medians of five alternating runs, with tests configured by -DMARSVIEW_TEST_OPTIMIZATION=-O2
// -DMARSVIEW_WERROR=OFF (GCC 12 warns there about its own library); another map with
// MARSVIEW_FRAME_MAP=FILE:
//     MARSVIEW_FRAME_FEATURES=1000000 MARSVIEW_FRAME_ROUNDS=5 xvfb-run -a
//     build/release/tests/ui/marsview_ui_test
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
#include <QUndoStack>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
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

// Of a frame, in milliseconds.
struct FrameCostMs {
    double wall = 0.0;
    double processor = 0.0; // of all threads: other programs change it less
};

class FrameClock {
public:
    void start()
    {
        timer_.start();
        processor_ = std::clock();
    }
    FrameCostMs perFrame(int frames) const
    {
        return {.wall = static_cast<double>(timer_.nsecsElapsed()) * 1e-6 / frames,
                .processor =
                    static_cast<double>(std::clock() - processor_) * 1e3 / CLOCKS_PER_SEC / frames};
    }

private:
    QElapsedTimer timer_;
    std::clock_t processor_ = 0;
};

class FeatureFramesTest : public MapWindowTest {
protected:
    void SetUp() override
    {
        makeWindow(windowSize());
        const QString map = qEnvironmentVariable("MARSVIEW_FRAME_MAP");
        ASSERT_TRUE(openAndWait(*window_,
                                map.isEmpty() ? QString::fromStdString(test::bundledMars()) : map));
    }
    static bool isBenchmark() { return qEnvironmentVariableIsSet("MARSVIEW_FRAME_FEATURES"); }
    // In a benchmark, so large that the view is.
    static QSize windowSize() { return isBenchmark() ? QSize(1600, 1000) : kSmall; }
    // A few in a test.
    static int frames(int of_benchmark) { return isBenchmark() ? of_benchmark : 5; }
    // A few thousand in a test, as many as the environment says in a benchmark.
    static int count()
    {
        bool is_set = false;
        const int count = qEnvironmentVariableIntValue("MARSVIEW_FRAME_FEATURES", &is_set);
        return is_set ? count : 5000;
    }
    VectorOverlays& overlays() { return window_->commands().vector_files.overlays(); }
    // Runs with features and without, in turn; the median counts.
    static int rounds()
    {
        bool is_set = false;
        const int rounds = qEnvironmentVariableIntValue("MARSVIEW_FRAME_ROUNDS", &is_set);
        return is_set ? rounds : 1;
    }
    void waitForRest()
    {
        EXPECT_TRUE(waitFor([this] { return !overlays().isBusy() && view().isPictureComplete(); }));
    }
    void waitForFrame(const QSignalSpy& swapped)
    {
        while (swapped.isEmpty()) {
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        }
    }
    // While the camera goes round.
    FrameCostMs moving()
    {
        waitForRest();
        const OrbitCamera home = view().camera();
        const int frame_count = frames(60);
        const int warm_up = frames(10); // the governor learns what a frame costs
        FrameClock clock;
        for (int i = 0; i < warm_up + frame_count; ++i) {
            if (i == warm_up) {
                clock.start();
            }
            OrbitCamera camera = home;
            camera.distance_m *= 0.4;
            camera.azimuth = home.azimuth + Angle::degrees(0.5 * i);
            const QSignalSpy swapped(&view(), &QOpenGLWidget::frameSwapped);
            view().setCamera(camera);
            waitForFrame(swapped);
        }
        const FrameCostMs cost = clock.perFrame(frame_count);
        view().setCamera(home);
        return cost;
    }
    // The view and all that lies over it are painted again.
    FrameCostMs resting()
    {
        waitForRest();
        const int frame_count = frames(20);
        constexpr int kWarmUp = 3;
        FrameClock clock;
        for (int i = 0; i < kWarmUp + frame_count; ++i) {
            if (i == kWarmUp) {
                clock.start();
            }
            const QSignalSpy swapped(&view(), &QOpenGLWidget::frameSwapped);
            for (QWidget* part : view().findChildren<QWidget*>()) {
                part->update();
            }
            view().update();
            waitForFrame(swapped);
        }
        return clock.perFrame(frame_count);
    }
    static double median(std::vector<double> values)
    {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }
    // Prints what features cost; `show` shows or hides them, which are shown now.
    void compare(const std::string& features, const std::function<void(bool)>& show)
    {
        for (const bool is_moving : {true, false}) {
            const auto measure = [&] { return is_moving ? moving() : resting(); };
            std::vector<double> with_ms;
            std::vector<double> without_ms;
            std::vector<double> ratios;
            std::vector<double> processor_ratios;
            for (int i = 0; i < rounds(); ++i) {
                const FrameCostMs with = measure();
                show(false);
                const FrameCostMs without = measure();
                show(true);
                with_ms.push_back(with.wall);
                without_ms.push_back(without.wall);
                ratios.push_back(with.wall / without.wall);
                processor_ratios.push_back(with.processor / without.processor);
            }
            std::sort(ratios.begin(), ratios.end());
            std::printf(
                "%s, %s, view of %d x %d: %.1f ms a frame, without %.1f ms, ratio %.2f "
                "(%.2f to %.2f), of processor time %.2f\n",
                features.c_str(), is_moving ? "moving" : "at rest", view().width(), view().height(),
                median(with_ms), median(without_ms), median(ratios), ratios.front(), ratios.back(),
                median(processor_ratios));
        }
    }
    // Anywhere on the map.
    GeographicPoint anywhere(test::Random& random)
    {
        const Georeference& map = view().map()->georeference();
        const Heightfield& field = view().map()->heightfield();
        const auto place =
            map.toGeographic({random.uniform(0.0, static_cast<double>(field.columns() - 1)),
                              random.uniform(0.0, static_cast<double>(field.rows() - 1))});
        EXPECT_TRUE(place);
        return *place;
    }
    void openVector(const QString& file)
    {
        QElapsedTimer timer;
        timer.start();
        const Crs geographic = Crs::geographic(*view().map()->info().body,
                                               *view().map()->georeference().crs()->ellipsoid());
        overlays().open(file, QString::fromStdString(geographic.wkt()));
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
            const GeographicPoint place = anywhere(random);
            file.write(QByteArray::number(place.longitude.degrees(), 'f', 5) + ',' +
                       QByteArray::number(place.latitude.degrees(), 'f', 5) + ",p" +
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
            annotation.vertices = {DrawnVertex(anywhere(random))};
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
    ASSERT_NO_FATAL_FAILURE(openVector(points(count())));
    compare(std::to_string(count()) + " points of a file", [this](bool is_shown) {
        Session session = window_->session();
        session.overlays.front().is_visible = is_shown;
        overlays().setSession(session);
    });
}

TEST_F(FeatureFramesTest, LinesOfAVectorFile)
{
    const int vertices = count() * 5 / 2;
    ASSERT_NO_FATAL_FAILURE(openVector(coastline(vertices)));
    compare("lines of " + std::to_string(vertices) + " vertices", [this](bool is_shown) {
        Session session = window_->session();
        session.overlays.front().is_visible = is_shown;
        overlays().setSession(session);
    });
}

TEST_F(FeatureFramesTest, Annotations)
{
    ASSERT_NO_FATAL_FAILURE(addAnnotations());
    QUndoStack& undo_stack = window_->controller().undoStack();
    compare(std::to_string(count()) + " annotations",
            [&](bool is_shown) { is_shown ? undo_stack.redo() : undo_stack.undo(); });
    AnnotationController& annotating = *window_->annotating();
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
