// Devices in a real window: contact, moving the map, and disconnecting.
#include "core/contact/contact_model.h"
#include "core/view/color_ramp.h"
#include "core/view/navigation.h"
#include "haptics/trace/goal_file.h"
#include "tests/support/map_maker.h"
#include "tests/ui/controllers/haptics/touched_hill.h"
#include "tests/ui/large_maps.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/map_overlays.h"
#include "ui/window/window_actions.h"

#include <QDeadlineTimer>
#include <QFile>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QThread>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>

namespace marsview {
namespace {

QByteArray contentOf(const QString& file)
{
    QFile content(file);
    EXPECT_TRUE(content.open(QIODevice::ReadOnly));
    return content.readAll();
}

// In a second or two of strokes, from far and near, the terrain below the hand is always in the
// picture. The proxy nearly always is: where the hand presses deep into a soft slope, it rests some
// millimeters further down.
void expectStrokesInPicture(TerrainView& view, const HapticsController& haptics)
{
    const auto wait_for = [](auto condition) { return QTest::qWaitFor(condition, kTimeout); };
    const OrbitCamera home = homeCamera(view.ground().box(view.exaggeration()), view.viewport());
    struct Sight {
        const char* name;
        double distance_share;
        double tilt_deg;
        double azimuth_deg;
        double exaggeration;
    };
    const double suitable = view.exaggeration();
    for (const Sight& sight :
         {Sight{"home", 1.0, home.tilt.degrees(), 0.0, 1.0}, Sight{"oblique", 0.5, 75.0, 40.0, 1.0},
          Sight{"near", 0.1, 60.0, 200.0, 1.0}, Sight{"from above", 0.3, 0.0, 130.0, 1.0},
          Sight{"exaggerated", 0.6, 60.0, -50.0, 10.0}}) {
        SCOPED_TRACE(sight.name);
        OrbitCamera camera = home;
        camera.distance_m *= sight.distance_share;
        camera.tilt = Angle::degrees(sight.tilt_deg);
        camera.azimuth = Angle::degrees(sight.azimuth_deg);
        view.setExaggeration(suitable * sight.exaggeration);
        view.setCamera(camera);
        // Until then, strokes are within a picture of coarser terrain.
        ASSERT_TRUE(wait_for([&] { return view.isPictureComplete(); }));
        const std::uint64_t begin = haptics.device().loop()->state().tick;
        constexpr std::uint64_t kReturnTicks = 1500; // from where the hand was before
        ASSERT_TRUE(
            wait_for([&] { return haptics.device().loop()->state().tick > begin + kReturnTicks; }));
        int seen = 0;
        int looks = 0;
        int hands_outside = 0;
        int proxies_outside = 0;
        ASSERT_TRUE(wait_for([&] {
            const LoopState now = haptics.device().loop()->state();
            ScenePoint below = now.goal;
            below.z = view.ground().height(below.x, below.y) * view.exaggeration();
            ++looks;
            seen += now.contact.is_in_contact ? 1 : 0;
            hands_outside += view.isInPicture(below) ? 0 : 1;
            proxies_outside +=
                now.contact.is_in_contact && !view.isInPicture(now.contact.proxy) ? 1 : 0;
            return now.tick > begin + kReturnTicks + 2000;
        }));
        EXPECT_GT(seen, 10);
        EXPECT_EQ(hands_outside, 0) << "of " << looks;
        EXPECT_LE(proxies_outside, seen / 5) << "of " << seen;
    }
}

class HapticsControllerTest : public TouchedHillTest {
protected:
    bool record(const QString& file)
    {
        QSignalSpy recorded(&haptics().recorder(), &TouchRecorder::recorded);
        if (!haptics().recorder().start(file)) {
            return false;
        }
        const std::uint64_t until = state().counts.in_contact + 600;
        const bool is_long_enough = waitFor([&] { return state().counts.in_contact > until; });
        haptics().recorder().stop();
        EXPECT_EQ(state().counts.not_recorded, 0U);
        return is_long_enough && recorded.count() == 1 && recorded[0][1].toULongLong() > 500;
    }
    // At a corner of the map, from near by; the summit is out of sight.
    OrbitCamera lookAtACorner()
    {
        OrbitCamera camera = view().camera();
        camera.target = {-700.0, -400.0, camera.target.z};
        camera.distance_m = 300.0;
        view().setCamera(camera);
        return view().camera();
    }
    // A minute deep below the summit, until the camera has gone there.
    bool replayOutOfSight(const QString& file, const OrbitCamera& before)
    {
        writeGoals(file, 60'000, "500900,4000600,0");
        return connectTo(QStringLiteral("replay:") + file) &&
               waitFor([&] { return view().cameraGoal() != before && !view().isMoving(); });
    }

    // The batch equivalent: only the goals, fed to a model without earlier contact.
    void expectSameProxies(const QString& file)
    {
        const SceneMap& map = view().ground().maps().front();
        const auto& dataset = map.map;
        const double exaggeration = view().exaggeration();
        const GoalFrame frame({dataset, &dataset->georeference()}, map.frame, exaggeration);
        const auto model = makeContactModel(
            kContactModelDefault, {map.map->filled(), map.frame, exaggeration}, {.radius_m = 1.0});
        QFile text(file);
        ASSERT_TRUE(text.open(QIODevice::ReadOnly));
        const QList<QByteArray> lines = text.readAll().trimmed().split('\n');
        ASSERT_GT(lines.size(), 500);
        ASSERT_TRUE(lines[0].trimmed().toStdString().starts_with(kSessionColumns));
        int contacts = 0;
        for (int i = 1; i < lines.size(); ++i) {
            const QList<QByteArray> cells = lines[i].split(',');
            const TracePoint goal{cells[0].toDouble(), cells[1].toDouble(), cells[2].toDouble()};
            const ContactState at = model->update(frame.toScene(goal));
            const TracePoint proxy = at.is_in_contact ? frame.fromScene(at.proxy) : goal;
            ASSERT_EQ(cells[5].toInt() != 0, at.is_in_contact) << "line " << i;
            ASSERT_EQ(cells[6].toDouble(), proxy.x) << "line " << i;
            ASSERT_EQ(cells[7].toDouble(), proxy.y) << "line " << i;
            ASSERT_EQ(cells[8].toDouble(), proxy.z) << "line " << i;
            contacts += at.is_in_contact ? 1 : 0;
        }
        EXPECT_GT(contacts, 300);
    }
};

TEST_F(HapticsControllerTest, ASimulatedHandMovesTheStylusAndFillsTheMeter)
{
    EXPECT_FALSE(view().shownStylus());
    ASSERT_TRUE(connectTo(QStringLiteral("sim:")));
    std::set<double> places;
    EXPECT_TRUE(waitFor([&] {
        const auto& pose = view().shownStylus();
        if (pose && pose->is_in_contact && length(pose->force_n) > 0.1) {
            places.insert(pose->proxy.x);
        }
        return places.size() > 5;
    }));
    EXPECT_TRUE(window_->overlays()->forceMeter()->isInUse());
    EXPECT_GT(state().counts.in_contact, 0U);
    device().disconnectDevice();
    EXPECT_FALSE(view().shownStylus());
    EXPECT_FALSE(window_->overlays()->forceMeter()->isInUse());
    EXPECT_EQ(device().loop(), nullptr);
}

TEST_F(HapticsControllerTest, TheProxyRestsOnTheGroundThatIsShown)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    const LoopState now = state();
    ASSERT_TRUE(now.contact.is_in_contact);
    const ScenePoint proxy = now.contact.proxy;
    EXPECT_NEAR(proxy.z, view().ground().height(proxy.x, proxy.y) * view().exaggeration(), 1e-3);
    EXPECT_LT(now.goal.z, proxy.z);
}

TEST_F(HapticsControllerTest, TheHandReachesWhatIsSeen)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(waitFor([&] { return state().tick > 10; }));
    const auto spread = [&] {
        const WorkspaceFrame frame = state().frame;
        return frame.scene_per_meter;
    };
    const double before = spread();
    OrbitCamera camera = view().camera();
    camera.distance_m /= 4.0;
    camera.azimuth = Angle::degrees(90.0);
    view().setCamera(camera);
    EXPECT_TRUE(waitFor([&] { return spread() < 0.6 * before; }));
    // The workspace direction away from the user is the heading of the view: east.
    const Vec3 away = state().frame.differenceToScene({0.0, 1.0, 0.0});
    EXPECT_NEAR(away.y / away.x, 0.0, 1e-9);
    EXPECT_GT(away.x, 0.0);
}

TEST_F(HapticsControllerTest, AMapThatIsHeldStaysInTheHandThoughThePictureGetsAnotherSize)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    OrbitCamera near = view().camera();
    near.distance_m /= 3.0; // far from its limits
    view().setCamera(near);
    ASSERT_TRUE(pressDown());
    hand_->buttons = 1;
    ASSERT_TRUE(waitFor([&] { return state().mode == StylusMode::Pan; }));
    const std::uint64_t number = state().frame_number;
    const double held = state().frame.scene_per_meter;
    const int height = view().height();
    window_->resize(kSmall + QSize(0, 250));
    ASSERT_TRUE(waitFor([&] { return view().height() > height; }));
    const std::uint64_t tick = state().tick;
    ASSERT_TRUE(waitFor([&] { return state().tick > tick + 100; }));
    EXPECT_EQ(state().frame_number, number);
    EXPECT_EQ(state().frame.scene_per_meter, held);
    // Once the hand is free, the workspace fits the new picture.
    hand_->buttons = 0;
    hand_->moveTo({0.0, 0.0, 0.05});
    EXPECT_TRUE(waitFor([&] { return state().frame.scene_per_meter != held; }));
}

TEST_F(HapticsControllerTest, PullingTheMapMovesTheCamera)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    OrbitCamera near = view().camera();
    near.distance_m /= 3.0;
    view().setCamera(near);
    ASSERT_TRUE(pressDown());
    hand_->buttons = 1;
    ASSERT_TRUE(waitFor([&] { return state().mode == StylusMode::Pan; }));
    // A hand that moves at once slips (PanOptions::grip_rate_n_per_s_max), and the press on a slope
    // alone moves a map that is held, by about a centimeter.
    const std::uint64_t grab = state().tick;
    ASSERT_TRUE(waitFor([&] { return state().tick > grab + 1000; }));
    const OrbitCamera before = view().camera();
    const WorkspaceFrame frame = state().frame;
    const auto moved = [&] {
        return frame.differenceToWorkspace(view().camera().target - before.target);
    };
    hand_->moveTo({0.05, 0.0, -0.055});
    // The map moves to the right as far as the device, so the visible part lies further left.
    ASSERT_TRUE(waitFor([&] { return std::abs(moved().x + 0.05) < 5e-4; })) << moved().x;
    EXPECT_NEAR(moved().y, 0.0, 5e-4);
    hand_->buttons = 0;
    ASSERT_TRUE(waitFor([&] { return state().mode != StylusMode::Pan; }));
    EXPECT_LT(moved().x, -0.045);
    EXPECT_NEAR(view().camera().distance_m, before.distance_m, 0.05 * before.distance_m);
}

TEST_F(HapticsControllerTest, LiftingAGrabInTheAirZooms)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    OrbitCamera near = view().camera();
    near.distance_m /= 2.0;
    view().setCamera(near);
    hand_->moveTo({0.0, 0.0, 0.05});
    ASSERT_TRUE(waitFor([&] { return state().hand.z > 0.049; }));
    ASSERT_FALSE(state().contact.is_in_contact);
    hand_->buttons = 1;
    ASSERT_TRUE(waitFor([&] { return state().mode == StylusMode::Zoom; }));
    const double before = view().camera().distance_m;
    const double scale = state().frame.scene_per_meter;
    hand_->moveTo({0.0, 0.0, 0.02});
    ASSERT_TRUE(waitFor([&] {
        return std::abs(std::log(view().camera().distance_m / before)) > 0.1 &&
               std::abs(state().hand.z - 0.02) < 1e-3;
    }));
    hand_->buttons = 0;
    ASSERT_TRUE(waitFor([&] { return state().mode == StylusMode::Hover; }));
    EXPECT_TRUE(waitFor([&] { // the view lags by some frames
        const double wanted = state().frame.scene_per_meter / scale;
        return std::abs(view().camera().distance_m / before - wanted) < 0.02;
    })) << view().camera().distance_m / before
        << " instead of " << state().frame.scene_per_meter / scale;
}

TEST_F(HapticsControllerTest, AnotherMapIsTouchedInPlaceOfTheFirst)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    ASSERT_TRUE(openAndWait(
        *window_, maps_.write(QStringLiteral("flat.asc"), {}, [](int, int) { return 40.0; })));
    EXPECT_TRUE(waitFor([&] {
        const LoopState now = state();
        const ScenePoint at = now.contact.proxy;
        return now.contact.is_in_contact && std::abs(at.z - 40.0 * view().exaggeration()) < 1e-6 &&
               hand_->force_n > 0.1;
    }));
    window_->controller().remove(window_->session().active);
    window_->controller().remove(window_->session().active);
    EXPECT_TRUE(waitFor([&] { return hand_->force_n == 0.0; }));
    EXPECT_FALSE(device().loop()->isRunning());
    EXPECT_EQ(device().connection(), HapticsConnection::Connected);
}

TEST_F(HapticsControllerTest, TheHandGoesFromTheUpperMapOntoTheLowerAndBack)
{
    const auto placed = [&](const char* name, const std::array<double, 6>& transform) {
        return maps_.placed(name, "IAU_2015:49900", transform);
    };
    ASSERT_TRUE(openAndWait(*window_, placed("lower", {10, 0.25, 0, 40, 0, -0.25})));
    ASSERT_TRUE(openAndWait(*window_, placed("upper", {14, 0.05, 0, 37, 0, -0.05})));
    ASSERT_EQ(view().ground().maps().size(), 2U);
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    // In the air, too, the map below the device is selected.
    const auto comes_to_lie_over = [&](std::size_t index, const WorkspacePoint& at) {
        hand_->moveTo(at);
        return waitFor([&] {
            const LoopState now = state();
            const ScenePoint hand = now.frame.toScene(now.hand);
            return length(now.hand - at) < 1e-9 && view().ground().mapAt(hand.x, hand.y) == index &&
                   length(now.goal - hand) < 1e-6; // not limited to the border of its own map
        });
    };
    const auto over = [&](const ScenePoint& place) {
        WorkspacePoint at = state().frame.toWorkspace(place);
        at.z = 0.05;
        return at;
    };
    OrbitCamera camera = view().camera();
    camera.target = {};
    camera.distance_m = 800'000.0;
    view().setCamera(camera);
    ASSERT_TRUE(waitFor([&] {
        return length(over({0.0, 0.0, 0.0}) - WorkspacePoint{0.0, 0.0, 0.05}) < 0.03;
    }));
    EXPECT_TRUE(comes_to_lie_over(0, over({0.0, 0.0, 0.0})));
    EXPECT_TRUE(comes_to_lie_over(1, over({-120'000.0, 30'000.0, 0.0})));
    EXPECT_TRUE(comes_to_lie_over(0, over({10'000.0, 10'000.0, 0.0})));
}

TEST_F(HapticsControllerTest, ExaggerationIsFelt)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    view().setExaggeration(view().exaggeration() * 2.0);
    EXPECT_TRUE(waitFor([&] {
        const LoopState now = state();
        const ScenePoint at = now.contact.proxy;
        return now.contact.is_in_contact && hand_->force_n > 0.1 &&
               std::abs(at.z - view().ground().height(at.x, at.y) * view().exaggeration()) < 1e-3;
    }));
}

TEST_F(HapticsControllerTest, TheEmergencyStopLetsGoFromAnywhere)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    QTest::keyClick(window_->menuWidget(), Qt::Key_Period, Qt::ControlModifier);
    EXPECT_TRUE(haptics().isStopped());
    ASSERT_TRUE(waitFor([&] { return hand_->force_n == 0.0; }));
    EXPECT_EQ(state().reason, ForceOffReason::EmergencyStop);
    // Pressed again, the stop remains.
    QTest::keyClick(&view(), Qt::Key_Pause);
    EXPECT_TRUE(haptics().isStopped());
    QTest::qWait(100);
    EXPECT_EQ(hand_->force_n, 0.0);
    haptics().setStopped(false);
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.5; }));
}

TEST_F(HapticsControllerTest, ASimulatedHandLiftsOffAfterAnEmergencyStop)
{
    ASSERT_TRUE(connectTo(QStringLiteral("sim:")));
    ASSERT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
    const auto is_above = [this](const LoopState& now) {
        const double ground = view().ground().height(now.goal.x, now.goal.y);
        return now.goal.z > ground * view().exaggeration();
    };
    haptics().setStopped(true);
    const std::uint64_t stopped = state().tick;
    ASSERT_TRUE(waitFor([&] { return state().tick > stopped + 1000; }));
    int below = 0;
    ASSERT_TRUE(waitFor([&] {
        const LoopState now = state();
        below += is_above(now) ? 0 : 1;
        return now.tick > stopped + 4000;
    }));
    EXPECT_EQ(below, 0);
    haptics().setStopped(false);
    EXPECT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
}

TEST_F(HapticsControllerTest, TheEmergencyStopHoldsForADeviceThatIsBeingOpened)
{
    hand_->is_held_up = true;
    hand_->moveTo({0.0, 0.0, -0.055});
    device().connectTo(QStringLiteral("hand:"));
    ASSERT_EQ(device().connection(), HapticsConnection::Opening);
    QTest::keyClick(&view(), Qt::Key_Pause);
    EXPECT_TRUE(haptics().isStopped());
    hand_->is_held_up = false;
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::Connected; }));
    ASSERT_TRUE(waitFor([&] { return state().tick > 300; })); // and the force has returned by then
    EXPECT_EQ(state().reason, ForceOffReason::EmergencyStop);
    EXPECT_EQ(hand_->force_n, 0.0);
    haptics().setStopped(false);
    EXPECT_TRUE(waitFor([&] { return hand_->force_n > 0.5; }));
}

TEST_F(HapticsControllerTest, SaysThatARecordingCannotBegin)
{
    QSignalSpy failed(&haptics().recorder(), &TouchRecorder::failed);
    EXPECT_FALSE(haptics().recorder().start(QStringLiteral("/nowhere/touch.csv")));
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(waitFor([&] { return device().isRunning(); }));
    EXPECT_FALSE(haptics().recorder().start(QStringLiteral("/nowhere/touch.csv")));
    ASSERT_EQ(failed.count(), 2);
    EXPECT_TRUE(failed[1][0].toString().startsWith(QStringLiteral("/nowhere/touch.csv: ")));
    EXPECT_FALSE(haptics().recorder().isRecording());
}

TEST_F(HapticsControllerTest, StiffnessAndScaleAreFelt)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    HapticsSettings settings = haptics().settings();
    settings.stiffness_n_per_m = 1e6;
    haptics().setSettings(settings);
    EXPECT_EQ(haptics().stiffnessMax(), 400.0);
    EXPECT_TRUE(waitFor([&] { return state().stiffness_n_per_m > 300.0; }));
    EXPECT_LE(state().stiffness_n_per_m, 400.0);
    settings.force_share = 0.0;
    haptics().setSettings(settings);
    EXPECT_TRUE(waitFor([&] { return hand_->force_n == 0.0; }));
}

TEST_F(HapticsControllerTest, TheSpaceBarGrabsForTheDevice)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    view().setFocus();
    QTest::keyPress(&view(), Qt::Key_Space);
    EXPECT_TRUE(waitFor([&] { return state().mode == StylusMode::Pan; }));
    EXPECT_EQ(view().shownStylus()->is_in_contact, true);
    QTest::keyRelease(&view(), Qt::Key_Space);
    EXPECT_TRUE(waitFor([&] { return state().mode != StylusMode::Pan; }));
}

TEST_F(HapticsControllerTest, ARecordingReplaysToTheSameProxies)
{
    ASSERT_TRUE(connectTo(QStringLiteral("sim:speed=0.2,lift_s=1")));
    ASSERT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    for (int i = 0; i < 2; ++i) { // the second does not depend on the first
        ASSERT_TRUE(record(file));
        expectSameProxies(file);
    }

    // The program as well: the same goals without a device, and then the device again.
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    EXPECT_TRUE(device().isReplaying());
    EXPECT_TRUE(
        waitFor([&] { return view().shownStylus() && view().shownStylus()->is_in_contact; }));
    EXPECT_EQ(device().problem(), QString());
    ASSERT_TRUE(waitFor([&] { return !device().isReplaying() && device().loop() != nullptr; }));
    EXPECT_EQ(device().uri(), QStringLiteral("sim:speed=0.2,lift_s=1"));
    EXPECT_EQ(haptics().settings().device, QStringLiteral("sim:speed=0.2,lift_s=1"));
    // Not if the replay is ended by the user; in that case the device is still remembered.
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    device().disconnectDevice();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(haptics().settings().device, QStringLiteral("sim:speed=0.2,lift_s=1"));
}

TEST_F(HapticsControllerTest, SaysWhereARecordingIsOfAnotherMapOrTouch)
{
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    const auto replay = [&](const QByteArray& goal, const QByteArray& columns = {}) {
        writeGoals(file, 3000, goal, columns);
        device().connectTo(QStringLiteral("replay:") + file);
        EXPECT_EQ(device().problem(), QString());
        EXPECT_TRUE(waitFor([&] { return !device().problem().isEmpty(); }));
        return device().problem();
    };
    const QByteArray parts = ",map,part,model,radius_m,exaggeration";
    const QString other = QStringLiteral(
        "touch.csv was recorded with God-Object at exaggeration 3; it is replayed with "
        "Continuous Walk (exact) at 1.");
    EXPECT_EQ(replay("500900,4000600,5000,1,1,god-object,1,3", parts), other);
    EXPECT_TRUE(device().isReplaying());
    EXPECT_EQ(device().notice(), other);
    // The notice follows changes of the contact settings.
    haptics().setContactModel(ContactModelKind::GodObject);
    EXPECT_TRUE(device().problem().contains(QStringLiteral("with God-Object at 1.")));
    view().setExaggeration(3.0);
    EXPECT_EQ(device().problem(), QString());
    view().setExaggeration(1.0);
    haptics().setContactModel(kContactModelDefault);
    EXPECT_EQ(device().problem(), other);

    EXPECT_TRUE(replay("0,0,0").contains(QStringLiteral("are outside the map")));
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    // The device is connected again if the recording cannot replace it.
    for (const char* goal : {"0,0,0", "none"}) {
        ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
        const QString problem = replay(goal);
        EXPECT_TRUE(problem.contains(QStringLiteral("touch.csv"))) << problem.toStdString();
        EXPECT_TRUE(waitFor([&] {
            return device().loop() != nullptr && device().uri() == QStringLiteral("hand:");
        })) << goal;
        EXPECT_EQ(device().problem(), problem) << "not yet read";
        device().disconnectDevice();
    }
}

TEST_F(HapticsControllerTest, KeepsTheHandOfARecordingInThePicture)
{
    lookAtACorner();
    const ScenePoint summit{0.0, 0.0, 0.0};
    ASSERT_FALSE(view().isInPicture(summit));
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    writeGoals(file, 3000, "500900,4000600,0"); // deep below the middle of the map
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    EXPECT_TRUE(waitFor([&] {
        return !view().isMoving() && view().shownStylus() &&
               view().isInPicture(view().shownStylus()->proxy);
    }));
    EXPECT_TRUE(device().isReplaying());
    EXPECT_NEAR(view().camera().distance_m, 300.0, 50.0) << "only sideways";
}

TEST_F(HapticsControllerTest, ASimulatedHandStrokesWithinThePicture)
{
    ASSERT_TRUE(connectTo(QStringLiteral("sim:speed=0.3,lift_s=0")));
    expectStrokesInPicture(view(), haptics());
}

TEST_F(HapticsControllerTest, ASimulatedHandStrokesWithinThePictureOfAnyMap)
{
    const QString global =
        maps_.placed("global", "IAU_2015:49900", {-180.0, 9.0, 0.0, 90.0, 0.0, -6.0});
    const QString projected =
        maps_.placed("projected", "EPSG:32611", {500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0});
    for (const QString& map : {global, projected}) {
        SCOPED_TRACE(map.toStdString());
        device().disconnectDevice();
        ASSERT_TRUE(openAndWait(*window_, map));
        ASSERT_TRUE(connectTo(QStringLiteral("sim:"))); // with the path that it has by default
        expectStrokesInPicture(view(), haptics());
    }
}

TEST_F(HapticsControllerTest, TheCameraReturnsWhenAReplayEndsOrIsStopped)
{
    const OrbitCamera before = lookAtACorner();
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    ASSERT_TRUE(replayOutOfSight(file, before));
    EXPECT_GT(device().replayedShare(), 0.0);
    EXPECT_LT(device().replayedShare(), 1.0);
    device().stopReplay();
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(device().problem(), QString());
    EXPECT_TRUE(waitFor([&] { return view().camera() == before; }));

    writeGoals(file, 1500, "500900,4000600,0");
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    ASSERT_TRUE(waitFor([&] { return view().cameraGoal() != before; }));
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_TRUE(waitFor([&] { return view().camera() == before; }));
}

TEST_F(HapticsControllerTest, TheCameraStaysWhereTheUserMovesItDuringAReplay)
{
    ASSERT_TRUE(replayOutOfSight(maps_.path(QStringLiteral("touch.csv")), lookAtACorner()));
    view().step(NavigationStep::TurnLeft);
    ASSERT_TRUE(waitFor([&] { return !view().isMoving(); }));
    const OrbitCamera chosen = view().camera();
    device().stopReplay();
    EXPECT_FALSE(view().isMoving());
    EXPECT_EQ(view().camera(), chosen);
}

TEST_F(HapticsControllerTest, SaysThatARecordingIsOfAMapThatIsNotOpen)
{
    const QString mars = maps_.mars();
    ASSERT_TRUE(openAndWait(*window_, mars));
    ASSERT_TRUE(connectTo(QStringLiteral("sim:speed=0.2,lift_s=1")));
    ASSERT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    ASSERT_TRUE(record(file));
    device().disconnectDevice();
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    ASSERT_TRUE(waitFor([&] { return view().shownStylus().has_value(); }));
    EXPECT_EQ(device().problem(), QString());
    device().disconnectDevice();

    window_->controller().remove(activeLayer(window_->session())->id);
    ASSERT_TRUE(openAndWait(*window_, maps_.moon())); // of the same extent
    device().connectTo(QStringLiteral("replay:") + file);
    EXPECT_TRUE(waitFor([&] { return !device().problem().isEmpty(); }));
    const std::string problem = device().problem().toStdString();
    const std::string expected =
        "touch.csv was recorded on a map that is not open: 40 × 30 samples, Mars.";
    EXPECT_EQ(problem.substr(0, expected.size()), expected) << problem;
}

TEST_F(HapticsControllerTest, ARecordingOfALowerMapIsReplayed)
{
    ASSERT_TRUE(openAndWait(*window_, maps_.mars()));
    ASSERT_TRUE(openAndWait(
        *window_, maps_.placed("small", "IAU_2015:49900", {10.0, 0.05, 0.0, 20.0, 0.0, -0.05})));
    ASSERT_EQ(view().ground().maps().size(), 2U);
    const QString file = maps_.path(QStringLiteral("touch.csv"));
    writeGoals(file, 1000, "16,15,5000"); // outside the topmost map
    ASSERT_TRUE(connectTo(QStringLiteral("replay:") + file));
    ASSERT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::None; }));
    EXPECT_EQ(device().replayedToItsEnd(), file);
}

TEST_F(HapticsControllerTest, ARecordingEndsWithItsMap)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(haptics().recorder().start(maps_.path(QStringLiteral("a.csv"))));
    EXPECT_TRUE(haptics().recorder().isRecording());
    haptics().setContactModel(ContactModelKind::GodObject);
    view().setExaggeration(2.0 * view().exaggeration());
    EXPECT_TRUE(haptics().recorder().isRecording()) << "it is the same map";
    QSignalSpy recorded(&haptics().recorder(), &TouchRecorder::recorded);
    ASSERT_TRUE(openAndWait(*window_, maps_.hill(QStringLiteral("other.asc"))));
    EXPECT_FALSE(haptics().recorder().isRecording());
    ASSERT_EQ(recorded.count(), 1);
    EXPECT_EQ(recorded[0][2].value<RecordingEnd>(), RecordingEnd::WithItsMap);
    const Status refused = haptics().recorder().start(QStringLiteral("/no/such/folder/a.csv"));
    EXPECT_FALSE(refused);
    EXPECT_FALSE(haptics().recorder().isRecording());
    const QString map = maps_.path(QStringLiteral("other.asc"));
    const QByteArray before = contentOf(map);
    EXPECT_FALSE(haptics().recorder().start(map)) << "onto the map itself";
    EXPECT_FALSE(haptics().recorder().start(maps_.path(QStringLiteral("hill.asc"))))
        << "onto one below it, which is not visible";
    haptics().recorder().saveTicks(device().lastTicks(), map);
    EXPECT_EQ(contentOf(map), before);
    EXPECT_TRUE(device().loop()->isRunning()); // it is touched all the same
}

TEST_F(HapticsControllerTest, SettingsAndDeviceAreRemembered)
{
    QSettings().remove(QStringLiteral("haptics"));
    makeWindow(kSmall, WindowOptions::Geometry::Remembered);
    HapticsSettings settings;
    settings.stiffness_n_per_m = 120.0;
    settings.force_share = 0.5;
    settings.has_walls = false;
    haptics().setSettings(settings);
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    window_->close();
    EXPECT_EQ(hand_->open_count, 0);
    makeWindow(kSmall, WindowOptions::Geometry::Remembered);
    settings.device = QStringLiteral("hand:");
    EXPECT_EQ(haptics().settings(), settings);
    EXPECT_TRUE(waitFor([&] { return device().connection() == HapticsConnection::Connected; }));
    device().disconnectDevice();
    makeWindow(kSmall, WindowOptions::Geometry::Remembered);
    EXPECT_EQ(device().connection(), HapticsConnection::None);
    EXPECT_EQ(haptics().settings().stiffness_n_per_m, 120.0);
    QSettings().remove(QStringLiteral("haptics"));
}

TEST_F(HapticsControllerTest, SettingsThatMakeNoSenseAreDefaults)
{
    QSettings settings;
    settings.setValue(QStringLiteral("haptics/stiffness"), QStringLiteral("hard"));
    settings.setValue(QStringLiteral("haptics/forceShare"), 7.0);
    const HapticsSettings read = hapticsSettingsFrom(settings);
    EXPECT_EQ(read.stiffness_n_per_m, HapticsSettings{}.stiffness_n_per_m);
    EXPECT_EQ(read.force_share, 1.0);
    settings.remove(QStringLiteral("haptics"));
}

// A tiled map in a view, and the same map in memory.
class HapticsControllerOfTiles : public testing::Test {
protected:
    void SetUp() override
    {
        const RasterSpec spec{.path = maps_.waves().toStdString()};
        whole_ = SceneSurface({test::loadedMap(spec.path)});
        const MapOpener opener = large_.opener();
        JobMonitor monitor;
        const auto tiled = large_.openTiled(spec, opener.resources, monitor);
        ASSERT_TRUE(tiled) << tiled.error().message;
        ASSERT_TRUE((*tiled)->heightfield().isTiled());
        view_ = std::make_unique<TerrainView>();
        view_->resize(500, 400);
        haptics_ = std::make_unique<HapticsController>(*view_, testDrivers(hand_));
        view_->show();
        ASSERT_TRUE(QTest::qWaitFor([&] { return view_->isReady(); }, kTimeout));
        view_->setLayers({{.map = *tiled, .ramp = colorRampNamed("grey")}});
    }
    void TearDown() override
    {
        large_.holdAllTiles(false);
        haptics_.reset();
        view_.reset();
    }

    // Presses into the terrain there; the proxy must be within the given distance of the terrain at
    // full resolution.
    bool touches(const WorkspacePoint& at, double tolerance_m)
    {
        if (haptics_->device().loop() == nullptr) {
            return false;
        }
        const LoopState now = haptics_->device().loop()->state();
        const ScenePoint proxy = now.contact.proxy;
        return now.contact.is_in_contact && length(now.hand - at) < 1e-9 && hand_->force_n > 0.1 &&
               std::abs(proxy.z - whole_.height(proxy.x, proxy.y) * view_->exaggeration()) <
                   tolerance_m;
    }
    bool comesToTouch(const WorkspacePoint& at, double tolerance_m)
    {
        hand_->moveTo(at);
        return QTest::qWaitFor([&] { return touches(at, tolerance_m); }, kTimeout);
    }

    static constexpr double kExactM = 1e-3;

    TestMaps maps_;
    LargeMaps large_;
    SceneSurface whole_;
    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
    std::unique_ptr<TerrainView> view_;
    std::unique_ptr<HapticsController> haptics_;
};

TEST_F(HapticsControllerOfTiles, TouchesTheGroundAtFullResolution)
{
    haptics_->device().connectTo(QStringLiteral("hand:"));
    EXPECT_TRUE(comesToTouch({0.0, 0.0, -0.055}, kExactM));
    EXPECT_TRUE(comesToTouch({-0.04, 0.02, -0.055}, kExactM));
}

TEST_F(HapticsControllerOfTiles, ASimulatedHandStrokesWithinThePicture)
{
    ASSERT_TRUE(QTest::qWaitFor([&] { return view_->isPictureComplete(); }, kTimeout));
    haptics_->device().connectTo(QStringLiteral("sim:"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return haptics_->device().loop() != nullptr; }, kTimeout));
    expectStrokesInPicture(*view_, *haptics_);
}

// A disk that returns no data when contact begins, not even the coarsest tile.
TEST_F(HapticsControllerOfTiles, TouchesCoarseGroundWithoutWaitingForATile)
{
    ASSERT_TRUE(QTest::qWaitFor([&] { return view_->isPictureComplete(); }, kTimeout));
    large_.holdAllTiles(true);
    large_.forgetTiles();
    const int reads = large_.guiReadCount();
    haptics_->device().connectTo(QStringLiteral("hand:"));
    const std::array places{WorkspacePoint{0.01, 0.0, -0.055},
                            WorkspacePoint{-0.013, 0.007, -0.055},
                            WorkspacePoint{0.021, -0.012, -0.055}};
    int coarse = 0; // of the places; where the proxy rests at a sample of all levels, all are exact
    for (const WorkspacePoint& below : places) {
        EXPECT_TRUE(comesToTouch(below, HUGE_VAL));
        coarse += touches(below, kExactM) ? 0 : 1;
    }
    EXPECT_GT(coarse, 0) << "the tiles that are held back make a difference";
    // The same with the mouse.
    view_->setTool(Tool::Touch);
    QTest::mousePress(view_.get(), Qt::LeftButton, {}, view_->rect().center());
    ASSERT_TRUE(view_->stylus());
    EXPECT_TRUE(view_->stylus()->is_in_contact);
    QTest::mouseRelease(view_.get(), Qt::LeftButton, {}, view_->rect().center());
    EXPECT_EQ(large_.guiReadCount(), reads) << "the GUI thread read a tile";
    // And when tiles arrive, the contact is exact.
    large_.holdAllTiles(false);
    for (const WorkspacePoint& below : places) {
        EXPECT_TRUE(comesToTouch(below, kExactM));
    }
}

} // namespace
} // namespace marsview
