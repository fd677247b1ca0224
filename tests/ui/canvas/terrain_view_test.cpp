#include "core/view/navigation.h"
#include "tests/support/shared_data.h"
#include "tests/ui/pointer_moves.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"

#include <QApplication>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

class TerrainViewTest : public testing::Test {
protected:
    void SetUp() override
    {
        window_ = std::make_unique<MainWindow>(testWindowOptions());
        window_->resize(1000, 700);
        window_->show();
        ASSERT_TRUE(openAndWait(*window_, maps_.hill()));
    }

    TerrainView& view() { return *window_->view(); }
    QPoint middle() { return view().rect().center(); }
    // Waits until the camera has arrived. The picture may not yet have its full detail.
    bool arrive()
    {
        return QTest::qWaitFor([this] { return !view().isMoving(); }, kTimeout);
    }
    bool rest()
    {
        return QTest::qWaitFor([this] { return view().isPictureComplete(); }, kTimeout);
    }
    void wheel(QPointF position, int angle, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QWheelEvent event(position, view().mapToGlobal(position), {}, {0, angle}, Qt::NoButton,
                          modifiers, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view(), &event);
    }
    void drag(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPoint by)
    {
        const QPoint from = middle();
        const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton b,
                              Qt::MouseButtons held) {
            QMouseEvent event(type, at, view().mapToGlobal(at), b, held, modifiers);
            QApplication::sendEvent(&view(), &event);
        };
        send(QEvent::MouseButtonPress, from, button, button);
        for (int i = 1; i <= 10; ++i) {
            send(QEvent::MouseMove, from + by * i / 10, Qt::NoButton, button);
        }
        send(QEvent::MouseButtonRelease, from + by, button, Qt::NoButton);
    }
    QColor colorAt(QPointF position)
    {
        return view().grabFramebuffer().pixelColor(
            (position * view().devicePixelRatioF()).toPoint());
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

TEST_F(TerrainViewTest, ShowsTheSurfaceWherePickingFindsIt)
{
    const Map& map = *view().map();
    for (const GridPoint grid : {GridPoint{20.0, 12.0}, GridPoint{5.5, 30.25}, GridPoint{50, 3}}) {
        const auto position = view().positionOf(grid);
        ASSERT_TRUE(position);
        const auto hit = view().surfaceAt(*position);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height_m, map.heightfield().height(hit->grid), 1e-9);
        // The far side of the hill may be hidden; these places are not.
        EXPECT_NEAR(hit->grid.column, grid.column, 1e-6);
        EXPECT_NEAR(hit->grid.row, grid.row, 1e-6);
    }
}

TEST_F(TerrainViewTest, OrbitsWithTheRightAndMiddleButtons)
{
    for (const Qt::MouseButton button : {Qt::RightButton, Qt::MiddleButton}) {
        OrbitCamera before = view().camera();
        before.tilt = kHomeTilt; // far from both limits
        view().setCamera(before);
        before = view().camera();
        drag(button, Qt::NoModifier, {100, 40});
        const OrbitCamera& after = view().camera();
        EXPECT_NEAR(after.azimuth.degrees() - before.azimuth.degrees(), 30.0, 1e-6);
        EXPECT_NEAR(after.tilt.degrees() - before.tilt.degrees(), -12.0, 1e-6);
        EXPECT_EQ(view().isMoving(), false);
    }
}

TEST_F(TerrainViewTest, PansWithShift)
{
    for (const auto& [button, modifiers] :
         {std::pair{Qt::LeftButton, Qt::KeyboardModifiers(Qt::ShiftModifier)},
          std::pair{Qt::RightButton, Qt::KeyboardModifiers(Qt::ShiftModifier)}}) {
        const auto grabbed = view().surfaceAt(middle());
        ASSERT_TRUE(grabbed);
        const OrbitCamera before = view().camera();
        drag(button, modifiers, {60, -30});
        EXPECT_EQ(view().camera().azimuth, before.azimuth);
        EXPECT_EQ(view().camera().tilt, before.tilt);
        const auto now = view().positionOf(grabbed->grid);
        ASSERT_TRUE(now);
        EXPECT_NEAR(now->x(), middle().x() + 60, 0.01);
        EXPECT_NEAR(now->y(), middle().y() - 30, 0.01);
    }
}

TEST_F(TerrainViewTest, ZoomsToThePointerWithTheWheel)
{
    const QPointF pointer = *view().positionOf(GridPoint{20.0, 12.0});
    const double before = view().camera().distance_m;
    wheel(pointer, 240);
    ASSERT_TRUE(arrive());
    const double after = view().camera().distance_m;
    EXPECT_LT(after, 0.75 * before);
    const auto now = view().positionOf(GridPoint{20.0, 12.0});
    ASSERT_TRUE(now);
    EXPECT_NEAR(now->x(), pointer.x(), 0.5);
    EXPECT_NEAR(now->y(), pointer.y(), 0.5);
    wheel(pointer, 120, Qt::ControlModifier);
    ASSERT_TRUE(arrive());
    EXPECT_GT(view().camera().distance_m, 0.85 * after) << "Ctrl is for fine steps";
}

TEST_F(TerrainViewTest, RisesFromTheGroundWhenZoomedOutOverTheSky)
{
    OrbitCamera low = view().camera();
    low.distance_m = 200.0;
    low.azimuth = Angle::degrees(90.0); // away from the hill
    low.tilt = Angle::degrees(85.0);
    view().setCamera(low);
    const QPointF sky(view().width() * 0.7, 20.0);
    double distance_m = view().camera().distance_m;
    double eye_z = eyeOf(view().camera()).z;
    for (int i = 0; i < 8; ++i) {
        ASSERT_FALSE(view().surfaceAt(sky));
        wheel(sky, -120);
        ASSERT_TRUE(arrive());
        distance_m /= 0.8;
        ASSERT_NEAR(view().camera().distance_m, distance_m, 1e-6 * distance_m);
        EXPECT_GT(eyeOf(view().camera()).z, eye_z);
        eye_z = eyeOf(view().camera()).z;
    }
    wheel(sky, -120 * 40);
    ASSERT_TRUE(arrive());
    EXPECT_GT(view().camera().distance_m, 6000.0);
    EXPECT_GT(eyeOf(view().camera()).z, 500.0);
}

// From the slopes of Mount St Helens, strongly exaggerated, the view left the map across its edge.
TEST_F(TerrainViewTest, NeverShowsOnlySky)
{
    ASSERT_TRUE(openAndWait(
        *window_,
        QString::fromStdString((test::bundledSamples() / "mount_st_helens_30m.tif").string())));
    view().setExaggeration(10.0);
    const Heightfield& heights = view().map()->heightfield();
    const double last_column = static_cast<double>(heights.columns() - 1);
    const double last_row = static_cast<double>(heights.rows() - 1);
    const auto is_ground_seen = [this] {
        bool is_seen = false;
        for (double y = 0.05; y < 1.0; y += 0.05) {
            is_seen = is_seen || view().surfaceAt({view().width() * 0.5, view().height() * y});
        }
        return is_seen;
    };
    for (const auto& [grid, azimuth] : {std::pair{GridPoint{last_column / 2.0, 0.0}, 0.0},
                                        std::pair{GridPoint{last_column, last_row / 2.0}, 90.0},
                                        std::pair{GridPoint{last_column / 3.0, last_row}, 180.0},
                                        std::pair{GridPoint{0.0, last_row / 3.0}, -90.0}}) {
        OrbitCamera camera = view().camera();
        camera.target = view().map()->georeference().sceneFrame().toScene(
            grid, 10.0 * heights.range()->maximum_m);
        camera.distance_m = 3000.0;
        camera.azimuth = Angle::degrees(azimuth);
        camera.tilt = Angle::degrees(85.0);
        view().setCamera(camera);
        EXPECT_TRUE(is_ground_seen()) << "looking towards " << azimuth;
        view().step(NavigationStep::ZoomIn);
        ASSERT_TRUE(arrive());
        EXPECT_TRUE(is_ground_seen()) << "nearer, looking towards " << azimuth;
    }
}

// The straight path from one side of a ridge to the other passes through it. How many frames a
// motion has depends on the machine: it is repeated until one of them is above the ridge.
TEST_F(TerrainViewTest, StaysAboveTheGroundWhileItMoves)
{
    const QString ridge = maps_.write(QStringLiteral("ridge.asc"), {}, [](int column, int /*row*/) {
        return column < 33 ? 400.0 : 0.0;
    });
    ASSERT_TRUE(openAndWait(*window_, ridge));
    view().setExaggeration(1.0);
    const Map& map = *view().map();
    const SceneFrame& frame = map.georeference().sceneFrame();
    int frames_over_ridge = 0;
    QObject::connect(&view(), &TerrainView::pointerMoved, &view(), [&] {
        const ScenePoint eye = eyeOf(view().camera());
        const double ground_m = map.heightfield().height(frame.toGrid(eye));
        if (std::isfinite(ground_m)) {
            EXPECT_GT(eye.z, ground_m);
            frames_over_ridge += ground_m > 300.0 ? 1 : 0;
        }
    });
    // The turn takes the eye around the target from north through west to south, over the ridge.
    for (int turn = 0; turn < 50 && frames_over_ridge == 0; ++turn) {
        view().setCamera({.target = frame.toScene({38.0, 20.0}, 0.0),
                          .distance_m = 500.0,
                          .azimuth = Angle::degrees(170.0),
                          .tilt = Angle::degrees(70.0)});
        ASSERT_EQ(frames_over_ridge, 0) << "already at the start";
        view().turnNorthUp();
        ASSERT_TRUE(arrive());
    }
    EXPECT_GT(frames_over_ridge, 0);
}

TEST_F(TerrainViewTest, FliesToWhereItIsDoubleClicked)
{
    const QPointF pointer = *view().positionOf(GridPoint{20.0, 12.0});
    doubleClick(view(), pointer.toPoint());
    EXPECT_TRUE(view().isMoving());
    ASSERT_TRUE(arrive());
    const auto hit = view().surfaceAt(QPointF(view().width() / 2.0, view().height() / 2.0));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->grid.column, 20.0, 0.3);
    EXPECT_NEAR(hit->grid.row, 12.0, 0.3);
}

// 2026-11: it flew on to where a few samples filled the picture.
TEST_F(TerrainViewTest, FliesNearerAsLongAsThatShowsMore)
{
    const double sample_m = view().map()->georeference().pixelWidthMeters();
    const auto samplePoints = [&] {
        return sample_m / view().metersPerPoint(*view().surfaceAt(middle()));
    };
    OrbitCamera camera = view().camera();
    camera.distance_m *= 100.0; // as far as its limits allow
    view().setCamera(camera);
    const double before = samplePoints();
    ASSERT_LT(before, 4.0);
    for (int i = 0; i < 3; ++i) {
        doubleClick(view(), middle());
        ASSERT_TRUE(arrive());
        EXPECT_NEAR(samplePoints(), i == 0 ? std::min(8.0, before / 0.3) : 8.0, 0.6);
    }
    camera = view().camera();
    camera.distance_m *= 0.5; // by other means
    view().setCamera(camera);
    doubleClick(view(), middle());
    ASSERT_TRUE(arrive());
    EXPECT_NEAR(samplePoints(), 16.0, 1.2);
}

TEST_F(TerrainViewTest, StopsFlyingWhenPressed)
{
    view().goHome();
    view().step(NavigationStep::ZoomIn);
    EXPECT_TRUE(view().isMoving());
    QTest::mousePress(&view(), Qt::LeftButton, {}, middle());
    EXPECT_FALSE(view().isMoving());
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, middle());
}

// An opening view follows the size of the window; one that was asked for does not.
TEST_F(TerrainViewTest, AResizeKeepsTheViewThatHomeOrNorthUpLeft)
{
    for (void (TerrainView::*const go)() : {&TerrainView::goHome, &TerrainView::turnNorthUp}) {
        window_.reset();
        ASSERT_NO_FATAL_FAILURE(SetUp());
        (view().*go)();
        ASSERT_TRUE(arrive());
        const OrbitCamera camera = view().camera();
        const QSize size = view().size();
        window_->resize(window_->width(), window_->height() - 150);
        ASSERT_TRUE(QTest::qWaitFor([&] { return view().size() != size; }, kTimeout));
        EXPECT_EQ(view().camera(), camera);
    }
}

TEST_F(TerrainViewTest, ObeysTheKeys)
{
    QApplication::setActiveWindow(window_.get()); // possibly without a window manager
    view().setFocus();
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().hasFocus(); }, kTimeout));
    const OrbitCamera before = view().camera();
    QTest::keyClick(&view(), Qt::Key_E);
    ASSERT_TRUE(arrive());
    EXPECT_NEAR(view().camera().azimuth.degrees(), before.azimuth.degrees() + 10.0, 1e-6);
    QTest::keyClick(&view(), Qt::Key_R);
    ASSERT_TRUE(arrive());
    EXPECT_NEAR(view().camera().tilt.degrees(), before.tilt.degrees() + 5.0, 1e-6);
    QTest::keyClick(&view(), Qt::Key_PageUp);
    ASSERT_TRUE(arrive());
    EXPECT_LT(view().camera().distance_m, before.distance_m);
    QTest::keyClick(&view(), Qt::Key_N);
    ASSERT_TRUE(arrive());
    EXPECT_EQ(view().camera().azimuth, Angle{});
    QTest::keyClick(&view(), Qt::Key_Home);
    ASSERT_TRUE(arrive());
    EXPECT_NEAR(view().camera().distance_m, before.distance_m, 1.0);
    const double exaggeration = view().exaggeration();
    QTest::keyClick(&view(), Qt::Key_Plus);
    EXPECT_GT(view().exaggeration(), exaggeration);
    QTest::keyClick(&view(), Qt::Key_Minus);
    EXPECT_EQ(view().exaggeration(), exaggeration);
}

TEST_F(TerrainViewTest, KeepsTheMiddleThroughExaggeration)
{
    view().setCamera([this] {
        OrbitCamera camera = view().camera();
        camera.distance_m *= 0.5;
        return camera;
    }());
    const QPointF center(view().width() / 2.0, view().height() / 2.0);
    const auto before = view().surfaceAt(center);
    ASSERT_TRUE(before);
    view().setExaggeration(view().exaggeration() * 3.0);
    const auto after = view().surfaceAt(center);
    ASSERT_TRUE(after);
    EXPECT_NEAR(after->grid.column, before->grid.column, 1e-6);
    EXPECT_NEAR(after->grid.row, before->grid.row, 1e-6);
}

TEST_F(TerrainViewTest, ShowsSkyThroughHoles)
{
    const QColor sky = colorAt({3.0, view().height() / 2.0});
    ASSERT_TRUE(openAndWait(*window_, maps_.ring()));
    OrbitCamera camera = view().camera();
    camera.tilt = {};
    view().setCamera(camera);
    ASSERT_TRUE(rest());
    const SceneFrame& frame = view().map()->georeference().sceneFrame();
    const auto hole = project(view().camera(), {.width = view().width(), .height = view().height()},
                              frame.toScene({29.5, 19.5}, 130.0 * view().exaggeration()));
    ASSERT_TRUE(hole);
    const auto place = view().surfaceAt({hole->x, hole->y});
    ASSERT_TRUE(place);
    EXPECT_TRUE(std::isnan(place->height_m));
    const QColor in_hole = colorAt({hole->x, hole->y});
    const QColor beside = colorAt({3.0, hole->y});
    EXPECT_NEAR(in_hole.red(), beside.red(), 2);
    EXPECT_NEAR(in_hole.green(), beside.green(), 2);
    EXPECT_NEAR(in_hole.blue(), beside.blue(), 2);
    const auto ground = view().positionOf(GridPoint{10.0, 20.0});
    ASSERT_TRUE(ground);
    EXPECT_GT(colorAt(*ground).lightness(), sky.lightness() + 20);
}

TEST_F(TerrainViewTest, DrawsNothingWhenNothingChanges)
{
    int frames = 0;
    QObject::connect(&view(), &QOpenGLWidget::frameSwapped, window_.get(), [&] { ++frames; });
    ASSERT_TRUE(rest());
    // The window system may still request a frame or two; then it requests none.
    const auto is_quiet = [&] {
        frames = 0;
        QTest::qWait(300);
        return frames == 0;
    };
    EXPECT_TRUE(QTest::qWaitFor(is_quiet, kTimeout));
}

} // namespace
} // namespace marsview
