// Hand, tick, frame, camera and its limits together, at 1 kHz and 60 Hz,
// without window or clock. The sentences are those of the paper's section 4.2,
// numbers without another source are the figures that the program promises:
// 0.02 N at a grab, 0.05 N at a release, 0.2 mm of height.
#include "app/bench/closed_loop.h"
#include "tests/haptics/loop/tick_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace marsview::test {
namespace {

constexpr double kHeightM = 10.0; // of the level terrain, 200 m wide
constexpr double kHalfM = 100.0;
constexpr double kStiffness = 400.0;
constexpr double kSoft = 1.0; // N/m
constexpr double kWallM = 0.08;

// A passive hand that presses with a force: a weak spring toward a distant aim.
class PressingHand {
public:
    PressingHand()
        : loop({.device = desktopDevice(),
                .hand = {.grip_n_per_m = kSoft, .grip_n_s_per_m = 0.0},
                .hand_begin = {0.0, 0.0, 0.005},
                .stiffness_n_per_m = kStiffness},
               servoMap(201, 201, [](std::size_t, std::size_t) { return kHeightM; }),
               [](double x, double y) {
                   return std::max(std::abs(x), std::abs(y)) <= kHalfM ? kHeightM : std::nan("");
               })
    {}

    ClosedLoop loop;

    void press(const Vec3& force_n) { force_n_ = force_n; }
    const StepResult& tick()
    {
        loop.hand().aimAt(loop.hand().position() + force_n_ * (1.0 / kSoft));
        return loop.tick();
    }
    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            tick();
        }
    }
    void grab(bool is_grabbing) { loop.settings.is_grabbing = is_grabbing; }

    WorkspacePoint at() const { return loop.hand().position(); }
    const StepResult& last() const { return loop.last(); }
    Vec3 mapVelocity() const { return loop.state().modes.pan.velocity_m_per_s; }

    // Presses for three seconds, until it is at rest on the terrain.
    void rest(double press_n)
    {
        press({0.0, 0.0, -press_n});
        run(3000);
        ASSERT_TRUE(last().contact.is_in_contact);
        ASSERT_NEAR(last().force_n.z, press_n, 0.01);
    }
    // Moves vertically by about `way_m` at some 0.15 m/s, and comes to rest.
    void lift(double way_m)
    {
        const double end = at().z + way_m;
        const double side = way_m > 0.0 ? 1.0 : -1.0;
        for (int i = 0; i < 4000 && (end - at().z) * side > 0.0; ++i) {
            press({0.0, 0.0, side * 0.3});
            tick();
        }
        press({});
        run(500);
    }

private:
    Vec3 force_n_{};
};

// The largest step of the force, and the largest change of the hand's height.
struct Watch {
    explicit Watch(const PressingHand& hand)
        : force_n(hand.last().force_n)
        , z_m(hand.at().z)
    {}
    void look(const PressingHand& hand)
    {
        step_n = std::max(step_n, length(hand.last().force_n - force_n));
        force_n = hand.last().force_n;
        sink_m = std::max(sink_m, std::abs(hand.at().z - z_m));
    }
    Vec3 force_n;
    double z_m;
    double step_n = 0.0;
    double sink_m = 0.0;
};

// "pushing or pulling the surface horizontally while the vertical position is
// held constant"
TEST(ClosedLoop, APanHoldsTheVerticalPosition)
{
    PressingHand hand;
    hand.rest(0.4);
    Watch watch(hand);
    hand.grab(true);
    for (int i = 0; i < 2000; ++i) {
        hand.press({i < 300 ? 0.1 : 0.0, 0.0, -0.4});
        hand.tick();
        watch.look(hand);
        ASSERT_EQ(hand.last().mode, StylusMode::Pan);
        // What is drawn is where the hand is.
        const ScenePoint at = hand.loop.frame().toScene(hand.last().hand);
        ASSERT_NEAR(length(hand.last().goal - at), 0.0, 1e-6);
    }
    EXPECT_LE(watch.step_n, 0.02);
    EXPECT_LE(watch.sink_m, 0.2e-3);
    hand.grab(false);
    hand.press({0.0, 0.0, -0.4});
    for (int i = 0; i < 1000; ++i) {
        hand.tick();
        watch.look(hand);
    }
    EXPECT_LE(watch.step_n, 0.02);
    EXPECT_LE(watch.sink_m, 0.2e-3);
}

// "inertia (any change in velocity is resisted by an inertial force)": a hand at rest feels none.
TEST(ClosedLoop, AGrabByAHandAtRestAddsNoHorizontalForce)
{
    PressingHand hand;
    hand.rest(0.4);
    hand.grab(true);
    for (int i = 0; i < 1000; ++i) {
        hand.tick();
        ASSERT_LE(std::hypot(hand.last().force_n.x, hand.last().force_n.y), 1e-9) << i;
    }
}

// The same sentence: the map that a moving hand grabs is at rest, so that its inertia resists. The
// force on the hand is what changes the map's momentum, m dv/dt = -F - m c v with the mass and drag
// of PanOptions, and it has no step.
TEST(ClosedLoop, AGrabByAMovingHandIsResistedByTheInertiaOfTheMapWithoutAStep)
{
    for (const double speed : {0.05, 0.1, 0.2, 0.3}) {
        SCOPED_TRACE(speed);
        PressingHand hand;
        hand.rest(0.4);
        for (int i = 0; i < 2000 && hand.loop.hand().velocity().x < speed; ++i) {
            hand.press({0.8, 0.0, -0.4});
            hand.tick();
        }
        // Against the arm's friction of 2 N s/m.
        hand.press({2.0 * speed, 0.0, -0.4});
        hand.run(20);
        ASSERT_NEAR(hand.last().force_n.x, 0.0, 1e-9);
        ASSERT_LT(hand.at().x, 0.03);
        hand.grab(true);
        const PanOptions pan;
        Watch watch(hand);
        double impulse_n_s = 0.0;
        double drag_n_s = 0.0;
        double strongest_n = 0.0;
        for (int i = 0; i < 80 && hand.last().ground_share == 1.0; ++i) {
            hand.tick();
            watch.look(hand);
            ASSERT_EQ(hand.last().mode, StylusMode::Pan);
            if (i < 60) {                                    // later the map swings past the hand
                EXPECT_LE(hand.last().force_n.x, 1e-9) << i; // against the motion
                EXPECT_LE(watch.step_n, 0.02 + 1e-9) << i;
            }
            impulse_n_s -= 1e-3 * hand.last().force_n.x;
            drag_n_s += 1e-3 * pan.mass_kg * pan.drag_per_s * hand.mapVelocity().x;
            strongest_n = std::max(strongest_n, -hand.last().force_n.x);
        }
        EXPECT_LE(watch.sink_m, 0.2e-3);
        EXPECT_NEAR(impulse_n_s, pan.mass_kg * hand.mapVelocity().x + drag_n_s, 1e-3 * impulse_n_s);
        EXPECT_GT(hand.mapVelocity().x, 0.5 * hand.loop.hand().velocity().x); // it follows
        // Of a spring between a mass and a wall that moves at this speed.
        EXPECT_LE(strongest_n, speed * std::sqrt(pan.grip_n_per_m * pan.mass_kg));
    }
}

// A surface without friction pushes along its normal, and only while it is touched: nothing holds a
// hand that slides on it, or leaves it.
TEST(ClosedLoop, AHandThatLeavesTheTerrainIsNeverPulledBack)
{
    for (const double press_n : {0.4, 1.0, 2.0}) {
        for (const double lift_n : {0.05, 0.3, 1.0}) {
            SCOPED_TRACE(testing::Message() << press_n << " N, then " << lift_n << " N");
            PressingHand hand;
            hand.rest(press_n);
            hand.press({0.05, 0.0, lift_n});
            int touching = 0;
            for (int i = 0; i < 400; ++i) {
                hand.tick();
                ASSERT_GE(hand.last().force_n.z, -1e-12) << i;
                ASSERT_NEAR(hand.last().force_n.x, 0.0, 1e-9) << i;
                touching += hand.last().contact.is_in_contact ? 1 : 0;
            }
            EXPECT_LT(touching, 200);
            EXPECT_FALSE(hand.last().contact.is_in_contact);
            EXPECT_EQ(hand.last().force_n, Vec3{});
        }
    }
}

TEST(ClosedLoop, AHandSlidesOverLevelTerrainWithoutFriction)
{
    PressingHand hand;
    hand.rest(1.0);
    hand.press({0.2, 0.0, -0.4}); // less than before: the surface returns energy
    while (hand.at().x < 0.05) {
        hand.tick();
        ASSERT_NEAR(hand.last().force_n.x, 0.0, 1e-9);
    }
    EXPECT_TRUE(hand.last().contact.is_in_contact);
    EXPECT_GT(hand.loop.hand().velocity().x, 0.05);
}

// "momentum (the surface will continue moving if the user releases their hold
// while the surface is in motion) ... allows the user to explore the surface as
// it moves"
TEST(ClosedLoop, AReleasedMapGlidesOnBelowATouchingHand)
{
    PressingHand hand;
    hand.rest(0.4);
    hand.grab(true);
    hand.press({0.1, 0.0, -0.4});
    hand.run(350);
    const Vec3 released = hand.mapVelocity();
    ASSERT_GT(released.x, 0.01);
    hand.grab(false);
    hand.press({-0.1, 0.0, -0.4}); // brakes
    Watch watch(hand);
    for (int i = 0; i < 300; ++i) {
        hand.press({hand.loop.hand().velocity().x > 0.0 ? -0.1 : 0.0, 0.0, -0.4});
        hand.tick();
        watch.look(hand);
        ASSERT_TRUE(hand.last().contact.is_in_contact);
    }
    // A drag of 0.7 /s: v0 exp(-0.7 t).
    EXPECT_NEAR(hand.mapVelocity().x, released.x * std::exp(-0.7 * 0.3), 2e-3 * released.x);
    EXPECT_LE(watch.step_n, 0.02);
    EXPECT_LE(watch.sink_m, 0.2e-3);
}

TEST(ClosedLoop, AFlungMapEndsAtTheLimitAndTheTerrainNeverGivesWay)
{
    PressingHand hand;
    hand.rest(0.6);
    hand.grab(true);
    hand.press({0.6, 0.0, -0.6});
    for (int i = 0; i < 2000 && hand.at().x < 0.06; ++i) {
        hand.tick();
    }
    ASSERT_GT(length(hand.mapVelocity()), 0.1);
    hand.grab(false);
    Watch watch(hand);
    int drops = 0;
    for (int i = 0; i < 4000; ++i) {
        hand.press({hand.at().x > 0.05 ? -0.1 : 0.0, 0.0, -0.6});
        hand.tick();
        watch.look(hand);
        drops += hand.last().ground_share == 1.0 && hand.last().force_n.z < 0.15 ? 1 : 0;
    }
    EXPECT_EQ(drops, 0);
    EXPECT_LE(watch.sink_m, 0.6 / kStiffness);
    EXPECT_NEAR(hand.loop.camera().target.x, -kHalfM, 1e-6);
    EXPECT_EQ(hand.mapVelocity(), Vec3{});
}

// A hand that goes on pulling at the limit feels the hold: its spring has 250
// N/m.
TEST(ClosedLoop, AtTheLimitTheHoldBecomesASpring)
{
    PressingHand hand;
    hand.rest(0.5);
    hand.grab(true);
    hand.press({0.1, 0.0, -0.5});
    for (int i = 0; i < 8000 && hand.loop.camera().target.x > -kHalfM + 1e-6; ++i) {
        hand.press({hand.loop.hand().velocity().x > 0.1 ? 0.0 : 0.1, 0.0, -0.5});
        hand.tick();
        if (hand.at().x > 0.06) { // another stroke
            hand.grab(false);
            for (int j = 0; j < 3000 && hand.at().x > -0.04; ++j) {
                hand.press({-0.2, 0.0, -0.5});
                hand.tick();
            }
            hand.press({0.2, 0.0, -0.5});
            hand.run(300);
            hand.grab(true);
        }
    }
    ASSERT_NEAR(hand.loop.camera().target.x, -kHalfM, 1e-6);
    hand.press({0.25, 0.0, -0.5});
    hand.run(4000);
    ASSERT_EQ(hand.last().mode, StylusMode::Pan);
    ASSERT_LT(hand.at().x, kWallM - 0.01);
    EXPECT_NEAR(hand.last().force_n.x, -0.25, 0.01);
    EXPECT_NEAR(hand.mapVelocity().x, 0.0, 1e-12);
    EXPECT_NEAR(hand.loop.camera().target.x, -kHalfM, 1e-6);
}

// "causing the mass of the surface to go to zero as soon as the wall is
// contacted. This cuts off all inertial forces and dissipates any surface
// momentum."
TEST(ClosedLoop, AtAWallThePulledMapHasNoMassAndNoMomentum)
{
    PressingHand hand;
    hand.rest(0.4);
    for (int i = 0; i < 5000 && hand.at().x < 0.05; ++i) {
        hand.press({0.1, 0.0, -0.4});
        hand.tick();
    }
    hand.rest(0.4);
    hand.grab(true);
    hand.press({0.4, 0.0, -0.4});
    for (int i = 0; i < 3000 && hand.at().x < kWallM + 1e-4; ++i) {
        hand.tick();
    }
    ASSERT_GT(hand.at().x, kWallM);
    hand.press({0.4, 0.0, -0.4});
    hand.run(2000);
    EXPECT_EQ(hand.last().ground_share, 0.0);
    // The wall's spring alone.
    EXPECT_NEAR(hand.last().force_n.x, -kStiffness * (hand.at().x - kWallM), 0.01);
    hand.grab(false);
    hand.run(2);
    EXPECT_EQ(hand.mapVelocity(), Vec3{});
}

// "grabbing empty space and ratcheting up or down, while the horizontal
// position is held fixed, to move the surface towards or away from the camera"
TEST(ClosedLoop, AZoomTakesTheSurfaceUpAndDownWithTheHand)
{
    PressingHand hand;
    hand.run(10);
    const double ground = hand.loop.surfaceZ();
    const double distance_m = hand.loop.camera().distance_m;
    hand.grab(true);
    hand.tick();
    ASSERT_EQ(hand.last().mode, StylusMode::Zoom);
    hand.lift(0.03);
    EXPECT_LT(hand.loop.camera().distance_m, 0.6 * distance_m); // nearer
    EXPECT_GT(hand.loop.surfaceZ(), ground + 0.015);            // and up
    EXPECT_LT(hand.loop.surfaceZ(), hand.at().z);               // never past the hand
    hand.lift(-0.05);
    EXPECT_GT(hand.loop.camera().distance_m, 1.2 * distance_m); // away
    EXPECT_LT(hand.loop.surfaceZ(), ground - 0.005);
    EXPECT_LT(hand.loop.surfaceZ(), hand.at().z);
    const Vec3 before_n = hand.last().force_n;
    hand.grab(false);
    double change_n = 0.0;
    for (int i = 0; i < 300; ++i) {
        change_n = std::max(change_n, length(hand.tick().force_n - before_n));
    }
    EXPECT_EQ(hand.last().mode, StylusMode::Hover);
    EXPECT_LT(change_n, 0.05);
}

TEST(ClosedLoop, AnyNumberOfRatchetsLeavesTheSurfaceInReach)
{
    for (const double side : {1.0, -1.0}) {
        PressingHand hand;
        hand.lift(0.01);
        for (int stroke = 0; stroke < 6; ++stroke) {
            const double distance_m = hand.loop.camera().distance_m;
            hand.lift(side > 0.0 ? 0.0 : 0.03);
            hand.grab(true);
            hand.tick();
            ASSERT_EQ(hand.last().mode, StylusMode::Zoom);
            hand.lift(side * 0.03);
            const Vec3 before_n = hand.last().force_n;
            hand.grab(false);
            double change_n = 0.0;
            for (int i = 0; i < 6000; ++i) {
                change_n = std::max(change_n, length(hand.tick().force_n - before_n));
                ASSERT_FALSE(hand.last().contact.is_in_contact);
            }
            EXPECT_LT(change_n, 0.05);
            const double ground = hand.loop.surfaceZ();
            EXPECT_LT(std::abs(ground), 0.05) << stroke;
            if (side > 0.0) {
                hand.lift(ground + 0.01 - hand.at().z); // back down, for the next stroke
            }
            // Until a limit of the distance.
            EXPECT_GE((distance_m - hand.loop.camera().distance_m) * side, -1e-9 * distance_m)
                << stroke;
        }
    }
}

// "the surface can be rotated around the vertical axis through the cursor by
// rotating the PHANTOM stylus": in the sense of the hand.
TEST(ClosedLoop, ATwistTurnsTheMapAboutTheCursorInTheSenseOfTheHand)
{
    PressingHand hand;
    hand.run(10);
    hand.grab(true);
    hand.tick();
    const ScenePoint held = hand.loop.frame().toScene(hand.last().hand);
    const ScenePoint right = hand.loop.frame().toScene(hand.last().hand + Vec3{0.01, 0.0, 0.0});
    const double azimuth_deg = hand.loop.camera().azimuth.degrees();
    for (int i = 1; i <= 90; ++i) { // counterclockwise seen from above
        hand.loop.twist(i * 3.14159265358979 / 180.0);
        hand.tick();
    }
    hand.run(32);
    EXPECT_NEAR(length(hand.loop.frame().toScene(hand.last().hand) - held), 0.0, 0.05);
    const Vec3 now = hand.loop.frame().toWorkspace(right) - hand.last().hand;
    EXPECT_NEAR(now.x, 0.0, 1e-4);
    EXPECT_NEAR(now.y, 0.01, 1e-4);
    // A map that turns counterclockwise in the picture is seen with a heading
    // that turns clockwise.
    EXPECT_NEAR(hand.loop.camera().azimuth.degrees() - azimuth_deg, 90.0, 0.1);
}

// Beyond the edge of the map the hand feels a wall, from inside.
TEST(ClosedLoop, AGlidingMapStopsWhereItsEdgeReachesTheHand)
{
    PressingHand hand;
    OrbitCamera camera = hand.loop.camera();
    camera.target.x = -60.0; // the western edge is in the picture
    hand.loop.moveCamera(camera);
    hand.run(2000);
    hand.press({-0.05, 0.0, -0.5});
    for (int i = 0; i < 4000 && hand.loop.frame().toScene(hand.at()).x > -60.0; ++i) {
        hand.tick();
    }
    hand.rest(0.5);
    hand.grab(true);
    hand.press({0.5, 0.0, -0.5});
    hand.run(150);
    ASSERT_GT(hand.mapVelocity().x, 0.1);
    hand.grab(false);
    double most_m = 0.0;
    for (int i = 0; i < 5000; ++i) {
        hand.press({hand.loop.hand().velocity().x > 0.0 ? -0.2 : 0.0, 0.0, -0.5});
        hand.tick();
        most_m = std::max(most_m, -kHalfM - hand.loop.frame().toScene(hand.last().hand).x);
    }
    EXPECT_LE(most_m, 0.2 / kStiffness * hand.loop.frame().scene_per_meter + 1.0);
    EXPECT_EQ(hand.mapVelocity(), Vec3{});
    EXPECT_TRUE(hand.last().contact.is_in_contact);
}

// A spring of this stiffness sinks by force / stiffness, whatever else the hand presses against.
TEST(ClosedLoop, AHandThatPressesHardAgainstTheEdgeOfTheMapSinksNoDeeper)
{
    PressingHand hand;
    OrbitCamera camera = hand.loop.camera();
    camera.target.x = -90.0;
    hand.loop.moveCamera(camera);
    hand.run(1000);
    for (int i = 0; i < 8000 && !hand.last().is_at_edge; ++i) {
        hand.press({hand.loop.hand().velocity().x > -0.05 ? -0.1 : 0.0, 0.0, -0.6});
        hand.tick();
    }
    hand.press({-0.2, 0.0, -0.6});
    hand.run(1500);
    ASSERT_TRUE(hand.last().is_at_edge);
    ASSERT_EQ(hand.last().ground_share, 1.0);
    const double surface_m = hand.loop.frame().toWorkspace({-kHalfM, 0.0, kHeightM}).z;
    double deepest_m = 0.0;
    double strongest_n = 0.0;
    // The hand rebounds from the edge with more than the device's 3.3 N.
    for (const double side_n : {1.0, 2.5, 3.0}) {
        hand.press({-side_n, 0.0, -0.6});
        for (int i = 0; i < 700; ++i) {
            hand.tick();
            deepest_m = std::max(deepest_m, surface_m - hand.at().z);
            strongest_n = std::max(strongest_n, length(hand.last().force_n));
        }
    }
    EXPECT_NEAR(strongest_n, 3.3, 1e-3);
    EXPECT_LE(deepest_m, 0.6 / kStiffness + 1e-4);
}

} // namespace
} // namespace marsview::test
