// Hand, tick, frame, camera and its limits together, at 1 kHz and 60 Hz, without window or clock.
// The sentences are those of the paper's section 4.2.
#include "haptics/drivers/simulated/simulated_hand.h"
#include "haptics/interaction/hand_view.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview::test {
namespace {

constexpr double kTickS = 1e-3;
constexpr double kHeightM = 10.0; // of the level terrain
constexpr double kScenePerMeter = 1000.0;

// A passive hand that presses with a force: a weak spring toward a distant aim.
class ClosedLoop {
public:
    explicit ClosedLoop(std::shared_ptr<ServoMap> map =
                            servoMap(201, 201, [](std::size_t, std::size_t) { return kHeightM; }))
        : hand_({.grip_n_per_m = kSoft, .grip_n_s_per_m = 0.0})
    {
        settings.map = std::move(map);
        settings.stiffness_n_per_m = 400.0;
        view_ = {.camera = {.target = {0.0, 0.0, kHeightM}, .distance_m = 150.0},
                 .frame = {.place = {0.0, 0.0, kHeightM + 5.0}, .scene_per_meter = kScenePerMeter}};
        limits_ = navigationLimits({{-100.0, -100.0, kHeightM}, {100.0, 100.0, kHeightM}}, 1.0);
        takeView(FrameOrigin::View);
    }

    LoopSettings settings;
    StepResult last;

    void press(const Vec3& force_n) { force_n_ = force_n; }

    const StepResult& tick()
    {
        hand_.aimAt(hand_.position() + force_n_ * (1.0 / kSoft));
        hand_.advance(kTickS);
        input_.settings = &settings;
        input_.device = &device_;
        input_.now += std::chrono::milliseconds(1);
        input_.sample.position = hand_.measured();
        input_.sample.time = input_.now;
        last = step(options_, input_, state_, kTickS);
        hand_.push(last.force_n);
        if (++ticks_ % 16 == 0) {
            followHand();
        }
        return last;
    }
    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            tick();
        }
    }

    WorkspacePoint hand() const { return hand_.position(); }
    const WorkspaceFrame& frame() const { return state_.frame; }
    const OrbitCamera& camera() const { return view_.camera; }
    double mapSpeed() const { return length(state_.modes.pan.velocity_m_per_s); }
    // Of the terrain below the hand, in the workspace.
    double groundZ() const
    {
        ScenePoint at = frame().toScene(hand());
        at.z = kHeightM;
        return frame().toWorkspace(at).z;
    }

private:
    static constexpr double kSoft = 1.0; // N/m

    void takeView(FrameOrigin origin)
    {
        settings.frame = view_.frame;
        settings.frame_origin = origin;
        ++settings.frame_number;
        settings.view_bounds = boundsFor(view_, limits_);
        boundZoom(view_, limits_, settings.modes);
    }
    void followHand()
    {
        const OrbitCamera followed = cameraFollowing(view_, state_.frame);
        const OrbitCamera camera = constrained(followed, limits_, [](double x, double y) {
            return std::max(std::abs(x), std::abs(y)) <= 100.0 ? kHeightM : std::nan("");
        });
        const LimitedView limited =
            limitedView({.camera = followed, .frame = state_.frame}, camera);
        view_ = limited.view;
        if (limited.is_moved) {
            takeView(FrameOrigin::Limit);
        }
    }

    DeviceCapabilities device_ = desktopDevice();
    TickOptions options_ = tickOptionsFor(device_);
    TickState state_;
    TickInput input_;
    SimulatedHand hand_;
    HandView view_;
    NavigationLimits limits_;
    Vec3 force_n_{};
    int ticks_ = 0;
};

// A hand that presses for two seconds at rest on the terrain.
void rest(ClosedLoop& loop, double press_n)
{
    loop.press({0.0, 0.0, -press_n});
    loop.run(3000);
    ASSERT_TRUE(loop.last.contact.is_in_contact);
    ASSERT_NEAR(loop.last.force_n.z, press_n, 0.01);
}

TEST(ClosedLoop, APanHoldsTheVerticalPosition)
{
    ClosedLoop loop;
    rest(loop, 0.4);
    const double z = loop.hand().z;
    Vec3 force_n = loop.last.force_n;
    loop.settings.is_grabbing = true;
    double step_n = 0.0;
    double sink_m = 0.0;
    for (int i = 0; i < 2000; ++i) {
        // It pulls to the right for a while.
        loop.press({i < 300 ? 0.1 : 0.0, 0.0, -0.4});
        loop.tick();
        ASSERT_EQ(loop.last.mode, StylusMode::Pan);
        step_n = std::max(step_n, length(loop.last.force_n - force_n));
        force_n = loop.last.force_n;
        sink_m = std::max(sink_m, std::abs(loop.hand().z - z));
        ASSERT_NEAR(length(loop.last.goal - loop.frame().toScene(loop.last.hand)), 0.0, 1e-9);
    }
    EXPECT_LE(step_n, 0.02);
    EXPECT_LE(sink_m, 0.2e-3);
    loop.settings.is_grabbing = false;
    for (int i = 0; i < 1000; ++i) {
        loop.press({0.0, 0.0, -0.4});
        loop.tick();
        step_n = std::max(step_n, length(loop.last.force_n - force_n));
        force_n = loop.last.force_n;
        sink_m = std::max(sink_m, std::abs(loop.hand().z - z));
    }
    EXPECT_LE(step_n, 0.02);
    EXPECT_LE(sink_m, 0.2e-3);
}

TEST(ClosedLoop, AFlungMapEndsAtTheLimitAndTheTerrainNeverGivesWay)
{
    ClosedLoop loop;
    rest(loop, 0.6);
    const double z = loop.hand().z;
    loop.settings.is_grabbing = true;
    loop.press({0.6, 0.0, -0.6});
    for (int i = 0; i < 2000 && loop.hand().x < 0.06; ++i) {
        loop.tick();
    }
    ASSERT_GT(loop.mapSpeed(), 0.1);
    loop.settings.is_grabbing = false;
    int drops = 0;
    double sink_m = 0.0;
    for (int i = 0; i < 4000; ++i) {
        loop.press({loop.hand().x > 0.05 ? -0.1 : 0.0, 0.0, -0.6});
        loop.tick();
        drops += loop.last.force_n.z < 0.15 ? 1 : 0; // a quarter of the press
        sink_m = std::max(sink_m, std::abs(loop.hand().z - z));
    }
    EXPECT_EQ(drops, 0);
    EXPECT_LE(sink_m, 0.6 / 400.0); // the force by the stiffness
    EXPECT_NEAR(loop.camera().target.x, -100.0, 1e-6);
    EXPECT_EQ(loop.mapSpeed(), 0.0);
}

// Zoom: the hand grabs free space and lifts or lowers it.
class ZoomedLoop : public ClosedLoop {
public:
    // Moves the hand vertically at 0.1 m/s.
    void lift(double way_m)
    {
        const double end = hand().z + way_m;
        const double side = way_m > 0.0 ? 1.0 : -1.0;
        for (int i = 0; i < 4000 && (end - hand().z) * side > 0.0; ++i) {
            press({0.0, 0.0, side * 0.3});
            tick();
        }
        for (int i = 0; i < 500; ++i) {
            press({});
            tick();
        }
    }
};

TEST(ClosedLoop, AZoomTakesTheSurfaceUpAndDownWithTheHand)
{
    ZoomedLoop loop;
    loop.run(10);
    const double ground = loop.groundZ(); // 5 mm below the hand
    const double scale = loop.frame().scene_per_meter;
    const ScenePoint held = loop.frame().toScene(loop.hand());
    loop.settings.is_grabbing = true;
    loop.tick();
    ASSERT_EQ(loop.last.mode, StylusMode::Zoom);
    loop.lift(0.03);
    EXPECT_LT(loop.frame().scene_per_meter, 0.6 * scale); // nearer
    EXPECT_GT(loop.groundZ(), ground + 0.015);            // and up
    EXPECT_LT(loop.groundZ(), loop.hand().z);             // never past the hand
    EXPECT_NEAR(loop.frame().toScene(loop.hand()).z, held.z, 0.1);
    EXPECT_NEAR(length(loop.last.goal - loop.frame().toScene(loop.last.hand)), 0.0, 1e-9);
    loop.lift(-0.06);
    EXPECT_GT(loop.frame().scene_per_meter, 1.3 * scale); // away
    EXPECT_LT(loop.groundZ(), loop.hand().z);
    const Vec3 before_n = loop.last.force_n;
    loop.settings.is_grabbing = false;
    double change_n = 0.0;
    for (int i = 0; i < 300; ++i) {
        change_n = std::max(change_n, length(loop.tick().force_n - before_n));
    }
    EXPECT_EQ(loop.last.mode, StylusMode::Hover);
    EXPECT_LT(change_n, 0.05);
}

} // namespace
} // namespace marsview::test
