// A SpaceMouse in a real window: how its cap moves the camera, and when it does not.
#include "core/view/cap_steering.h"
#include "tests/haptics/drivers/fake_hid.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/spacemouse_controller.h"
#include "ui/globe/globe_view.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTest>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

namespace marsview {
namespace {

using namespace std::chrono_literals;
using test::FakeHid;
using test::reportOf;

constexpr auto kStep = 20ms; // of the clock below
constexpr double kStepS = 0.02;

// The report of the newer devices: x right, y toward the user, z down, and rotations about them, of
// 350.
FakeHid::Report cap(int x, int y, int z, int turn_x = 0, int turn_y = 0, int turn_z = 0)
{
    return reportOf({x, y, z, turn_x, turn_y, turn_z}, 13, {1});
}

class SpaceMouseControllerTest : public testing::Test {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        // The cap is read once per frame and time advances then, so the effect of a frame is known
        // exactly.
        options.spacemouse = {.api = &hid_.api(), .look_interval = 20ms, .now = [this] {
                                  ++looks_;
                                  return clock_ += step_;
                              }};
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(1000, 700);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
        ASSERT_TRUE(openAndWait(
            *window_, maps_.write(QStringLiteral("flat.asc"), {}, [](int, int) { return 100.0; })));
        OrbitCamera camera = view().camera();
        home_distance_m_ = camera.distance_m;
        camera.distance_m /= 4.0;
        camera.azimuth = Angle::degrees(30.0);
        view().setCamera(camera);
        ASSERT_TRUE(waitFor([&] { return view().isPictureComplete(); }));
        moved_ = std::make_unique<QSignalSpy>(&view(), &TerrainView::sightChanged);
    }
    void TearDown() override
    {
        hid_.goOnEnumerating();
        moved_.reset();
        window_.reset();
        EXPECT_EQ(hid_.openDevices(), 0U);
    }

    template <typename F>
    static bool waitFor(F condition)
    {
        return QTest::qWaitFor(condition, kTimeout);
    }
    TerrainView& view() { return *window_->view(); }
    bool isConnected() const { return window_->commands().spacemouse.isConnected(); }
    bool isAwake() const { return window_->commands().spacemouse.isAwake(); }
    bool plugIn()
    {
        hid_.say(cap(0, 0, 0));
        hid_.plugIn({"/dev/hidraw2", 0x256F, 0xC635, 0x01, 0x08});
        return waitFor([&] { return isConnected() && !isAwake(); });
    }
    // The number of frames in which the camera has moved since the last call.
    int takeMoves()
    {
        const int count = static_cast<int>(moved_->count());
        moved_->clear();
        return count;
    }
    // Holds the cap at this deflection for some frames; the number of frames in which the camera
    // moved.
    int hold(const FakeHid::Report& report)
    {
        takeMoves();
        hid_.say(report);
        EXPECT_TRUE(waitFor([&] { return moved_->count() >= 8; }));
        hid_.say(cap(0, 0, 0));
        EXPECT_TRUE(waitFor([&] { return !isAwake(); }));
        return takeMoves();
    }
    // Lets the window read the cap this many times.
    bool waitForLooks(int count)
    {
        const int until = looks_ + count;
        return waitFor([&] { return looks_ >= until; });
    }
    // The point where the picture's axis meets the ground, which is level.
    double distanceToGroundM()
    {
        const OrbitCamera& camera = view().camera();
        return (100.0 * view().exaggeration() - eyeOf(camera).z) / axesOf(camera).forward.z;
    }

    FakeHid hid_; // outlives the window
    TestMaps maps_;
    std::chrono::steady_clock::time_point clock_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::duration step_ = kStep;
    int looks_ = 0; // clock readings
    double home_distance_m_ = 0.0;
    std::unique_ptr<MainWindow> window_;
    std::unique_ptr<QSignalSpy> moved_;
};

// 189 of 350 are 0.54: halfway from the edge of the dead zone to full deflection, an eighth of the
// speed.
constexpr int kHalf = 189;
constexpr double kHalfSpeed = 0.125;

TEST_F(SpaceMouseControllerTest, APushPansInItsDirectionByTheElapsedTime)
{
    ASSERT_TRUE(plugIn());
    const OrbitCamera begin = view().camera();
    const double azimuth = begin.azimuth.radians();
    const Vec3 right{std::cos(azimuth), -std::sin(azimuth), 0.0};
    const Vec3 away{std::sin(azimuth), std::cos(azimuth), 0.0};
    for (const auto& [report, way] :
         {std::pair{cap(kHalf, 0, 0), right}, std::pair{cap(-kHalf, 0, 0), right * -1.0},
          std::pair{cap(0, -kHalf, 0), away}, std::pair{cap(0, kHalf, 0), away * -1.0}}) {
        view().setCamera(begin);
        const ScenePoint eye = eyeOf(begin);
        // one camera distance per second
        const double speed_m_per_s = kHalfSpeed * distanceToGroundM();
        const int moves = hold(report);
        const Vec3 expected = way * (moves * kStepS * speed_m_per_s);
        EXPECT_GT(length(expected), 1.0);
        EXPECT_LT(length(eyeOf(view().camera()) - eye - expected), 1e-6);
        EXPECT_EQ(view().camera().azimuth, begin.azimuth);
        EXPECT_EQ(view().camera().tilt, begin.tilt);
    }
}

TEST_F(SpaceMouseControllerTest, APushDownZoomsInAndAPullUpZoomsOut)
{
    ASSERT_TRUE(plugIn());
    const double before_m = distanceToGroundM();
    const double eye_z = eyeOf(view().camera()).z;
    int moves = hold(cap(0, 0, kHalf));
    const double near_m = distanceToGroundM();
    EXPECT_NEAR(near_m / before_m, std::pow(4.0, -moves * kStepS * kHalfSpeed), 1e-6);
    EXPECT_LT(eyeOf(view().camera()).z, eye_z);
    moves = hold(cap(0, 0, -kHalf));
    EXPECT_NEAR(distanceToGroundM() / near_m, std::pow(4.0, moves * kStepS * kHalfSpeed), 1e-6);
}

TEST_F(SpaceMouseControllerTest, ATwistTurnsAndATipTiltsAboutTheTerrainInTheMiddle)
{
    ASSERT_TRUE(plugIn());
    const QPointF middle(view().width() / 2.0, view().height() / 2.0);
    const auto ground = view().surfaceAt(middle);
    ASSERT_TRUE(ground);
    const OrbitCamera before = view().camera();
    // Clockwise as seen by the user.
    int moves = hold(cap(0, 0, 0, 0, 0, kHalf));
    const OrbitCamera turned = view().camera();
    EXPECT_NEAR((turned.azimuth - before.azimuth).degrees(), moves * kStepS * kHalfSpeed * 90.0,
                1e-9);
    EXPECT_EQ(turned.tilt, before.tilt);
    // Its front lifted: toward the horizon.
    moves = hold(cap(0, 0, 0, kHalf, 0, 0));
    EXPECT_NEAR((view().camera().tilt - before.tilt).degrees(), moves * kStepS * kHalfSpeed * 45.0,
                1e-9);
    EXPECT_EQ(view().camera().azimuth, turned.azimuth);
    const auto now = view().surfaceAt(middle);
    ASSERT_TRUE(now);
    EXPECT_NEAR(now->grid.column, ground->grid.column, 1e-6);
    EXPECT_NEAR(now->grid.row, ground->grid.row, 1e-6);
}

TEST_F(SpaceMouseControllerTest, ALongFrameDoesNotCauseAJump)
{
    ASSERT_TRUE(plugIn());
    const Angle before = view().camera().azimuth;
    step_ = 10s;
    const int moves = hold(cap(0, 0, 0, 0, 0, kHalf));
    const double degrees = (view().camera().azimuth - before).degrees();
    EXPECT_NEAR(std::remainder(degrees - moves * 0.1 * kHalfSpeed * 90.0, 360.0), 0.0, 1e-9);
}

TEST_F(SpaceMouseControllerTest, NothingRunsAndNothingIsDrawnWhileItRests)
{
    ASSERT_TRUE(plugIn());
    hold(cap(kHalf, 0, 0));
    int frames = 0;
    QObject::connect(&view(), &QOpenGLWidget::frameSwapped, window_.get(), [&] { ++frames; });
    ASSERT_TRUE(waitFor([&] { return view().isPictureComplete(); }));
    const auto enumerations = hid_.enumerations();
    // The window system may still request a frame or two; then it requests none.
    const auto is_quiet = [&] {
        frames = 0;
        const int looks = looks_;
        const auto until = hid_.readings() + 500;
        EXPECT_TRUE(waitFor([&] { return hid_.readings() >= until; }));
        return frames == 0 && looks_ == looks;
    };
    EXPECT_TRUE(waitFor(is_quiet));
    EXPECT_FALSE(isAwake());
    EXPECT_EQ(hid_.enumerations(), enumerations) << "a device is open, so no search";
}

TEST_F(SpaceMouseControllerTest, NothingIsDrawnInTheDeadZoneNorAtALimit)
{
    ASSERT_TRUE(plugIn());
    const OrbitCamera before = view().camera();
    takeMoves();
    hid_.say(cap(27, -27, 20, -25, 350, 27)); // rolled as well, which the camera ignores
    EXPECT_TRUE(waitForLooks(20));
    EXPECT_TRUE(isAwake());
    EXPECT_EQ(takeMoves(), 0);
    EXPECT_EQ(view().camera(), before);
    hid_.say(cap(0, 0, 0, 350, 0, 0));
    ASSERT_TRUE(waitFor([&] { return view().camera().tilt > Angle::degrees(84.999); }));
    ASSERT_TRUE(waitForLooks(2));
    takeMoves();
    EXPECT_TRUE(waitForLooks(20));
    EXPECT_EQ(takeMoves(), 0);
}

TEST_F(SpaceMouseControllerTest, UnpluggedWhilePushedItStopsAtOnceAndReconnects)
{
    ASSERT_TRUE(plugIn());
    EXPECT_TRUE(
        window_->statusBar()->currentMessage().contains(QStringLiteral("SpaceMouse Compact")));
    for (int i = 0; i < 2; ++i) {
        takeMoves();
        hid_.say(cap(0, 0, 0, 0, 0, 350));
        ASSERT_TRUE(waitFor([&] { return takeMoves() > 0; }));
        hid_.unplug();
        ASSERT_TRUE(waitFor([&] { return !isConnected(); }));
        EXPECT_FALSE(isAwake());
        const OrbitCamera there = view().camera();
        const auto until = hid_.enumerations() + 3;
        ASSERT_TRUE(waitFor([&] { return hid_.enumerations() >= until; }));
        EXPECT_EQ(view().camera(), there);
        hid_.say(cap(0, 0, 0));
        hid_.plugInAgain();
        ASSERT_TRUE(waitFor([&] { return isConnected(); }));
    }
}

TEST_F(SpaceMouseControllerTest, IsIgnoredWhileADialogIsOpenOrAnotherWindowIsActive)
{
    ASSERT_TRUE(plugIn());
    const OrbitCamera before = view().camera();
    const auto expect_unheard = [&] {
        takeMoves();
        hid_.sayOnce({3, 1});
        hid_.sayOnce({3, 0});
        hid_.say(cap(350, 350, 350, 350, 350, 350));
        EXPECT_TRUE(waitForLooks(5));
        EXPECT_TRUE(isAwake());
        EXPECT_EQ(takeMoves(), 0);
        EXPECT_FALSE(view().isMoving());
        EXPECT_EQ(view().camera(), before);
    };
    QDialog dialog(window_.get());
    dialog.open();
    expect_unheard();
    hid_.say(cap(0, 0, 0));
    ASSERT_TRUE(waitFor([&] { return !isAwake(); }));
    dialog.close();
    QWidget other;
    other.show();
    QApplication::setActiveWindow(&other);
    expect_unheard();
    // In front again, it continues although the cap was not released in between.
    other.close();
    QApplication::setActiveWindow(window_.get());
    EXPECT_TRUE(waitFor([&] { return takeMoves() > 0; }));
}

TEST_F(SpaceMouseControllerTest, TheFirstButtonShowsTheWholeMap)
{
    ASSERT_TRUE(plugIn());
    ASSERT_LT(view().camera().distance_m, 0.5 * home_distance_m_);
    const int until = looks_ + 2; // when it wakes, and a frame later
    hid_.sayOnce({3, 2});         // the second
    hid_.sayOnce({3, 0});
    ASSERT_TRUE(waitFor([&] { return looks_ >= until && !isAwake(); }));
    EXPECT_FALSE(view().isMoving());
    hid_.say(cap(60, 0, 0)); // slightly deflected the whole time
    ASSERT_TRUE(waitFor([&] { return takeMoves() > 0; }));
    hid_.sayOnce({3, 1});
    hid_.sayOnce({3, 0});
    ASSERT_TRUE(waitFor([&] { return view().isMoving(); }));
    ASSERT_TRUE(waitFor([&] { return !view().isMoving(); }));
    EXPECT_NEAR(view().camera().distance_m, home_distance_m_, 0.05 * home_distance_m_);
}

// On a sphere, closed forms: a push to the right pans along a great circle, a twist turns.
TEST_F(SpaceMouseControllerTest, MovesTheGlobeWhileThatIsShown)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    window_->actionSet().globe->trigger();
    GlobeView& globe = *window_->globe();
    ASSERT_TRUE(waitFor([&] { return globe.terrain() != nullptr; }));
    ASSERT_TRUE(plugIn());
    const OrbitCamera flat = view().camera();
    globe.setCamera(
        {.target = {.longitude = Angle::degrees(15.0), .latitude = Angle::degrees(16.0)},
         .distance_m = 2e5});
    QSignalSpy moved(&globe, &GlobeView::sightChanged);
    const auto hold_on_globe = [&](const FakeHid::Report& report) {
        moved.clear();
        hid_.say(report);
        EXPECT_TRUE(waitFor([&] { return moved.count() >= 4; }));
        hid_.say(cap(0, 0, 0));
        EXPECT_TRUE(waitFor([&] { return !isAwake(); }));
        return static_cast<int>(moved.count());
    };
    const BodyCamera begin = globe.camera();
    int frames = hold_on_globe(cap(kHalf, 0, 0));
    BodyCamera end = globe.camera();
    const double radius_m = globe.scene().ellipsoid().equatorial_m;
    const double way = (end.target.longitude - begin.target.longitude).radians() *
                       std::cos(begin.target.latitude.radians());
    const double expected = kCapPanPerS * kStepS * kHalfSpeed * begin.distance_m / radius_m;
    EXPECT_NEAR(way / (expected * frames), 1.0, 0.05) << frames;
    EXPECT_NEAR(end.target.latitude.degrees(), begin.target.latitude.degrees(), 0.02);
    frames = hold_on_globe(cap(0, 0, 0, 0, 0, kHalf));
    const double turned = std::remainder((globe.camera().azimuth - end.azimuth).degrees(), 360.0);
    EXPECT_NEAR(std::abs(turned), kCapTurnPerS.degrees() * kStepS * kHalfSpeed * frames, 0.05);
    end = globe.camera();
    hold_on_globe(cap(0, 0, kHalf)); // down: nearer
    EXPECT_LT(globe.camera().distance_m, end.distance_m);
    EXPECT_EQ(view().camera(), flat) << "the flat map behind it stays";
}

TEST_F(SpaceMouseControllerTest, SearchingForItBlocksNothing)
{
    hid_.stallEnumerating();
    const auto until = hid_.enumerations() + 1;
    ASSERT_TRUE(waitFor([&] { return hid_.enumerations() >= until; })); // and blocks there
    hid_.say(cap(0, 0, 0));
    hid_.plugIn({"/dev/hidraw2", 0x256F, 0xC635, 0x01, 0x08});
    const Angle before = view().camera().azimuth;
    view().step(NavigationStep::TurnRight);
    ASSERT_TRUE(waitFor([&] { return !view().isMoving(); }));
    EXPECT_NEAR((view().camera().azimuth - before).degrees(), 10.0, 1e-6);
    EXPECT_FALSE(isConnected());
    EXPECT_EQ(hid_.enumerations(), until) << "one search at a time";
    hid_.goOnEnumerating();
    EXPECT_TRUE(waitFor([&] { return isConnected(); }));
}

} // namespace
} // namespace marsview
