// A haptic device that touches and moves the globe.
#include "core/contact/body_goal_frame.h"
#include "haptics/trace/goal_file.h"
#include "tests/ui/globe/globe_window.h"
#include "tests/ui/test_device.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/panels/haptics_panel.h"

#include <QFile>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>

#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

namespace marsview {
namespace {

class GlobeDeviceTest : public GlobeTest {
protected:
    void SetUp() override
    {
        WindowOptions options = testWindowOptions();
        options.make_drivers = testDrivers(hand_);
        makeWindow(kSmall, options);
        ASSERT_TRUE(openAndWait(*window_, QString::fromStdString(test::bundledMars())));
    }
    void TearDown() override
    {
        window_.reset();
        EXPECT_EQ(hand_->open_count, 0);
        EXPECT_EQ(hand_->force_n, 0.0);
    }
    HapticsController& haptics() { return window_->haptics(); }
    DeviceSession& device() { return haptics().device(); }
    LoopSettings& settings() { return device().settings(); }
    LoopState state() { return device().loop()->state(); }
    bool connectTo(const QString& uri)
    {
        device().connectTo(uri);
        return waitFor([&] { return device().connection() == HapticsConnection::Connected; });
    }
    bool isTouchingGlobe()
    {
        return waitFor([&] {
            return device().isRunning() && state().frame.body_axes && globe().shownStylus();
        });
    }
    // The hand touches the globe, which is seen from a distance over a place.
    bool begin(double longitude_deg, double latitude_deg, double distance_m)
    {
        if (!showGlobe() || !connectTo(QStringLiteral("hand:")) || !isTouchingGlobe()) {
            return false;
        }
        globe().setCamera({.target = {.longitude = Angle::degrees(longitude_deg),
                                      .latitude = Angle::degrees(latitude_deg)},
                           .distance_m = distance_m});
        const auto number = settings().frame_number;
        return waitFor([&] { return state().frame_number >= number; });
    }
    bool pressDown()
    {
        hand_->moveTo({0.0, 0.0, -0.055});
        return waitFor([&] { return hand_->force_n > 0.5; });
    }
    double heightAt(const ScenePoint& place)
    {
        return globe().terrain()->height(placeOf(place, body()).foot) * globe().exaggeration();
    }
    double pixelM() { return globe().terrain()->map()->georeference().pixelHeightMeters(); }

    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
};

TEST_F(GlobeDeviceTest, TheHandTouchesTheTerrainUnderItWithTheLocalVerticalUp)
{
    ASSERT_TRUE(begin(-112.0, 2.0, 8e5));
    // The local vertical at the camera's target is up, and the heading of the view away.
    const LocalAxes local = localAxes(body(), globe().camera().target);
    EXPECT_NEAR(length(state().frame.body_axes->z - local.up), 0.0, 1e-9);
    EXPECT_NEAR(length(state().frame.body_axes->y - local.north), 0.0, 1e-9);
    ASSERT_TRUE(pressDown());
    ASSERT_TRUE(waitFor([&] {
        const auto& pose = globe().shownStylus();
        return pose && pose->is_in_contact;
    }));
    const LoopState now = state();
    EXPECT_NEAR(placeOf(now.contact.proxy, body()).height_m, heightAt(now.contact.proxy),
                0.02 * pixelM());
    EXPECT_LT(placeOf(now.goal, body()).height_m, heightAt(now.goal));
    EXPECT_TRUE(globe().findChild<GlobeOverlays*>()->forceMeter()->isInUse());
    EXPECT_EQ(globe().readingSource(), ReadingSource::Stylus);
    // What is read is the terrain at the proxy.
    const auto reading = globe().reading();
    ASSERT_TRUE(reading);
    const auto place = globe().terrain()->map()->georeference().toGeographic(reading->hit.grid);
    ASSERT_TRUE(place);
    EXPECT_NEAR(length(localAxes(body(), *place).up -
                       localAxes(body(), placeOf(globe().shownStylus()->proxy, body()).foot).up),
                0.0, 1e-6);
    device().disconnectDevice();
    EXPECT_FALSE(globe().shownStylus());
}

TEST_F(GlobeDeviceTest, PullingRollsTheGlobeUnderTheHandAndTheCameraFollows)
{
    ASSERT_TRUE(begin(-112.0, 2.0, 8e5));
    globe().setFocus();
    ASSERT_TRUE(pressDown());
    // To rest just below the surface: the grip begins with the stretch that the force has, and the
    // globe rolls by that, too.
    const LoopState pressed = state();
    WorkspacePoint at = pressed.frame.toWorkspace(pressed.contact.proxy);
    at.z -= 0.001;
    hand_->moveTo(at);
    ASSERT_TRUE(waitFor([&] { return length(state().hand - at) < 1e-6; }));
    ASSERT_TRUE(state().contact.is_in_contact);
    const BodyCamera before = globe().camera();
    const Rotation axes = *state().seen_frame.body_axes;
    QTest::keyPress(&globe(), Qt::Key_Space);
    ASSERT_TRUE(waitFor([&] { return state().mode == StylusMode::Pan; }));
    const double arc = 0.02 * state().frame.scene_per_meter / body().equatorial_m;
    hand_->moveTo({at.x + 0.02, at.y, at.z});
    ASSERT_TRUE(waitFor([&] { return state().hand.x > at.x + 0.0199; }));
    // By the way of the hand, less where the grip slipped. The camera's target goes the other way,
    // to the west, as far as the body has rolled.
    double rolled = 0.0;
    double moved = 0.0;
    EXPECT_TRUE(waitFor([&] {
        rolled = length((*state().seen_frame.body_axes * axes.inverse()).turn());
        moved = length(localAxes(body(), globe().camera().target).up -
                       localAxes(body(), before.target).up);
        return rolled > 0.7 * arc && rolled < 1.2 * arc && std::abs(moved - rolled) < 0.1 * rolled;
    })) << arc
        << ", " << rolled << ", " << moved;
    EXPECT_LT(globe().camera().target.longitude, before.target.longitude);
    EXPECT_NEAR(globe().camera().distance_m, before.distance_m, 1.0);
    QTest::keyRelease(&globe(), Qt::Key_Space);
    EXPECT_TRUE(waitFor([&] { return state().mode != StylusMode::Pan; }));
}

// Two layers on top of each other are one surface, made in the background, and again where layers
// or exaggeration change.
TEST_F(GlobeDeviceTest, AStrokeFromLayerToLayerStaysOnOneSurface)
{
    // 40 × 30 samples of 20 km around 80° N, 0° E, kilometers above Mars there.
    ASSERT_TRUE(openAndWait(*window_, maps_.placed("polar", "IAU_2015:49930",
                                                   {-400e3, 20e3, 0.0, -300e3, 0.0, -20e3})));
    const auto are_joined = [&] {
        const auto& map = settings().map;
        return map && map->below.size() == 1 && map->frame.georeference().columns() == 40 &&
               map->frame.exaggeration() == globe().exaggeration();
    };
    ASSERT_TRUE(begin(20.0, 79.0, 8e5));
    ASSERT_TRUE(waitFor(are_joined));
    EXPECT_TRUE(haptics().whyApart().isEmpty());
    const std::uint64_t id = settings().map->map_id;
    // From the middle of the view to the east, beyond the border.
    const LocalAxes local =
        localAxes(body(), {.longitude = Angle::degrees(45.0), .latitude = Angle::degrees(79.0)});
    const double east_m = state().frame.toWorkspace(local.up * body().polar_m).x;
    const auto layerBelowProxy = [&] {
        return globe().scene().mapAt(placeOf(state().contact.proxy, body()).foot);
    };
    const auto moveTo = [&](const WorkspacePoint& at) { // slower than a jump
        const WorkspacePoint begin = state().hand;
        const int steps = 1 + static_cast<int>(length(at - begin) / 0.005);
        for (int i = 1; i <= steps; ++i) {
            const WorkspacePoint next = begin + (at - begin) * (static_cast<double>(i) / steps);
            hand_->moveTo(next);
            if (!waitFor([&] { return length(state().hand - next) < 1e-9; })) {
                return false;
            }
        }
        return true;
    };
    ASSERT_TRUE(moveTo({0.0, 0.0, 0.0}));
    ASSERT_TRUE(moveTo({0.0, 0.0, -0.04}));
    ASSERT_TRUE(waitFor([&] { return state().contact.is_in_contact; }));
    EXPECT_EQ(layerBelowProxy(), 0U);
    ASSERT_TRUE(moveTo({std::min(east_m, 0.07), 0.0, -0.04}));
    ASSERT_TRUE(waitFor([&] { return layerBelowProxy() == 1U; }));
    EXPECT_EQ(settings().map->map_id, id) << "the same surface";
    EXPECT_TRUE(state().contact.is_in_contact);

    view().setExaggeration(3.0);
    ASSERT_TRUE(waitFor(are_joined));
    EXPECT_EQ(settings().map->map_id, id) << "the same surface, raised";
    const LayerId polar = window_->session().layers.front().id;
    window_->controller().setVisible(polar, false);
    ASSERT_TRUE(waitFor([&] {
        return settings().map->below.empty() && settings().map->frame.georeference().columns() > 40;
    }));
    window_->controller().setVisible(polar, true);
    ASSERT_TRUE(waitFor(are_joined));
}

// The force fades out and in: from write to write by no more than the limiter allows.
TEST_F(GlobeDeviceTest, AnotherSceneTakesTheHandOverWithoutAStep)
{
    ASSERT_TRUE(connectTo(QStringLiteral("hand:")));
    ASSERT_TRUE(pressDown());
    EXPECT_FALSE(state().frame.body_axes);
    ASSERT_TRUE(showGlobe());
    ASSERT_TRUE(isTouchingGlobe());
    ASSERT_TRUE(pressDown());
    EXPECT_FALSE(view().shownStylus());
    scene(1)->trigger(); // the flat map
    ASSERT_TRUE(waitFor(
        [&] { return device().isRunning() && !state().frame.body_axes && view().shownStylus(); }));
    ASSERT_TRUE(pressDown());
    EXPECT_FALSE(globe().shownStylus());
    const std::vector<TickRecord> ticks = device().lastTicks();
    std::set<bool> scenes;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        scenes.insert(ticks[i].is_on_body);
        const double seconds = 1e-9 * static_cast<double>(ticks[i].time_ns - ticks[i - 1].time_ns);
        const SafetyLimits limits;
        const bool is_off = ticks[i].reason != ForceOffReason::None;
        const double allowed_n = (is_off ? limits.release_n_per_s_max : limits.rate_n_per_s_max) *
                                 std::max(seconds, 1e-3);
        // Times are those of the record, and the limiter's those of the write before it.
        EXPECT_LT(length(ticks[i].force_n - ticks[i - 1].force_n), 1.5 * allowed_n) << i;
    }
    EXPECT_EQ(scenes.size(), 2U);
    EXPECT_FALSE(ofLastScene(ticks).front().is_on_body);
}

// A tool that places points has the stylus as its pointer, and its button does not roll the globe.
TEST_F(GlobeDeviceTest, TheButtonSetsPointsOfAProfileWhereTheStylusTouches)
{
    ASSERT_TRUE(begin(-112.0, 2.0, 8e5));
    MeasureController& measuring = *window_->measuring();
    measuring.begin(MeasurementKind::Profile);
    QSignalSpy pressed(&device(), &DeviceSession::pointPressed);
    QSignalSpy released(&device(), &DeviceSession::pointReleased);
    const auto isStill = [&](const WorkspacePoint& at) {
        const LoopState now = state();
        return length(now.hand - at) < 1e-9 && now.contact.is_in_contact;
    };
    // Longitude and latitude on a sphere, from the proxy in the body-fixed frame.
    const auto placeOfProxy = [&] {
        const ScenePoint proxy = state().contact.proxy;
        return std::pair(std::atan2(proxy.y, proxy.x),
                         std::atan2(proxy.z, std::hypot(proxy.x, proxy.y)));
    };
    ASSERT_TRUE(body().isSphere());
    int count = 0;
    for (const WorkspacePoint& at :
         {WorkspacePoint{-0.02, 0.0, -0.055}, WorkspacePoint{0.02, 0.015, -0.055}}) {
        hand_->moveTo(at);
        ASSERT_TRUE(waitFor([&] { return isStill(at); }));
        const auto [longitude, latitude] = placeOfProxy();
        const BodyCamera camera = globe().camera();
        ++count;
        hand_->buttons = 1;
        ASSERT_TRUE(waitFor([&] { return pressed.count() == count; }));
        hand_->buttons = 0;
        ASSERT_TRUE(waitFor([&] { return released.count() == count; }));
        EXPECT_EQ(globe().camera(), camera) << "the globe stays";
        EXPECT_NE(state().mode, StylusMode::Pan);
        ASSERT_NE(measuring.current(), nullptr);
        ASSERT_EQ(measuring.current()->vertices.size(), static_cast<std::size_t>(count));
        const auto* vertex = std::get_if<GeographicPoint>(&measuring.current()->vertices.back());
        ASSERT_NE(vertex, nullptr);
        const double tolerance = 0.01 * pixelM() / body().equatorial_m;
        EXPECT_NEAR(std::remainder(vertex->longitude.radians() - longitude, 2.0 * std::numbers::pi),
                    0.0, tolerance);
        EXPECT_NEAR(vertex->latitude.radians(), latitude, tolerance);
    }
    EXPECT_GT(hand_->force_n, 0.5) << "the terrain is still felt";
}

TEST_F(GlobeDeviceTest, RecordsInLongitudeAndLatitudeAndReplaysThat)
{
    ASSERT_TRUE(begin(-112.0, 2.0, 8e5));
    ASSERT_TRUE(pressDown());
    const QString file = maps_.path(QStringLiteral("globe.csv"));
    ASSERT_TRUE(haptics().recorder().start(file));
    const std::uint64_t until = state().counts.in_contact + 300;
    ASSERT_TRUE(waitFor([&] { return state().counts.in_contact > until; }));
    haptics().recorder().stop();
    EXPECT_EQ(goalColumnsOf(file.toStdString()), GoalColumns::Geographic);
    const auto text = readGoalText(file.toStdString());
    ASSERT_TRUE(text);
    const auto recording = readGoalRecording(*text, "globe.csv", GoalColumns::Geographic);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_GT(recording->updates.size(), 200U);
    const TracePoint last = recording->updates.back().proxy;
    const GeographicPoint place{.longitude = Angle::degrees(last.x),
                                .latitude = Angle::degrees(last.y)};
    EXPECT_NEAR(last.z, globe().terrain()->height(place), 0.02 * pixelM());

    haptics().replay(file);
    ASSERT_TRUE(waitFor([&] { return device().isReplaying() && device().isRunning(); }));
    EXPECT_TRUE(
        waitFor([&] { return globe().shownStylus() && globe().shownStylus()->is_in_contact; }));
    EXPECT_NEAR(length(globe().shownStylus()->proxy - state().contact.proxy), 0.0, 2.0 * pixelM());
    EXPECT_TRUE(device().problem().isEmpty()) << device().problem().toStdString();

    scene(1)->trigger(); // the flat map: the replay ends, and is refused there
    EXPECT_FALSE(device().isReplaying());
    haptics().replay(file);
    EXPECT_FALSE(device().isReplaying());
    EXPECT_TRUE(device().problem().contains(QStringLiteral("recorded on the globe")));
}

} // namespace
} // namespace marsview
