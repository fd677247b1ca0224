#include "haptics/interaction/mouse_stylus.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr std::array kModes{StylusMode::Hover, StylusMode::Press, StylusMode::Pan,
                            StylusMode::Zoom};
constexpr std::array kBooleans{false, true};

struct Transition {
    StylusMode from;
    bool is_pressing;
    bool is_grabbing;
    bool is_in_contact;
    StylusMode to;
};

// All cases: 4 modes × button and keys × contact.
constexpr std::array kTransitions{
    Transition{StylusMode::Hover, false, false, false, StylusMode::Hover},
    Transition{StylusMode::Hover, false, false, true, StylusMode::Hover},
    Transition{StylusMode::Hover, true, false, false, StylusMode::Press},
    Transition{StylusMode::Hover, true, false, true, StylusMode::Press},
    Transition{StylusMode::Hover, false, true, false, StylusMode::Zoom},
    Transition{StylusMode::Hover, false, true, true, StylusMode::Pan},
    Transition{StylusMode::Hover, true, true, false, StylusMode::Zoom},
    Transition{StylusMode::Hover, true, true, true, StylusMode::Pan},
    Transition{StylusMode::Press, false, false, false, StylusMode::Hover},
    Transition{StylusMode::Press, false, false, true, StylusMode::Hover},
    Transition{StylusMode::Press, true, false, false, StylusMode::Press},
    Transition{StylusMode::Press, true, false, true, StylusMode::Press},
    Transition{StylusMode::Press, false, true, false, StylusMode::Zoom},
    Transition{StylusMode::Press, false, true, true, StylusMode::Pan},
    Transition{StylusMode::Press, true, true, false, StylusMode::Zoom},
    Transition{StylusMode::Press, true, true, true, StylusMode::Pan},
    Transition{StylusMode::Pan, false, false, false, StylusMode::Hover},
    Transition{StylusMode::Pan, false, false, true, StylusMode::Hover},
    Transition{StylusMode::Pan, true, false, false, StylusMode::Press},
    Transition{StylusMode::Pan, true, false, true, StylusMode::Press},
    Transition{StylusMode::Pan, false, true, false, StylusMode::Pan},
    Transition{StylusMode::Pan, false, true, true, StylusMode::Pan},
    Transition{StylusMode::Pan, true, true, false, StylusMode::Pan},
    Transition{StylusMode::Pan, true, true, true, StylusMode::Pan},
    Transition{StylusMode::Zoom, false, false, false, StylusMode::Hover},
    Transition{StylusMode::Zoom, false, false, true, StylusMode::Hover},
    Transition{StylusMode::Zoom, true, false, false, StylusMode::Press},
    Transition{StylusMode::Zoom, true, false, true, StylusMode::Press},
    Transition{StylusMode::Zoom, false, true, false, StylusMode::Zoom},
    Transition{StylusMode::Zoom, false, true, true, StylusMode::Zoom},
    Transition{StylusMode::Zoom, true, true, false, StylusMode::Zoom},
    Transition{StylusMode::Zoom, true, true, true, StylusMode::Zoom},
};

TEST(NextMode, IsThatOfThePaperFromEveryState)
{
    std::array<int, 32> seen{};
    for (const Transition& t : kTransitions) {
        const std::size_t place = static_cast<std::size_t>(t.from) * 8 + (t.is_pressing ? 4U : 0U) +
                                  (t.is_grabbing ? 2U : 0U) + (t.is_in_contact ? 1U : 0U);
        ++seen[place];
        EXPECT_EQ(nextMode(t.from, {.is_pressing = t.is_pressing, .is_grabbing = t.is_grabbing},
                           t.is_in_contact),
                  t.to)
            << place;
    }
    for (const int count : seen) {
        EXPECT_EQ(count, 1) << "the table has each state once";
    }
}

TEST(NextMode, KeepsAGrabUntilItEnds)
{
    test::Random random;
    for (int i = 0; i < 1000; ++i) {
        const StylusMode first =
            nextMode(kModes[random.below(2)],
                     {.is_pressing = random.chance(0.5), .is_grabbing = true}, random.chance(0.5));
        StylusMode mode = first;
        for (int j = 0; j < 20; ++j) {
            mode = nextMode(mode, {.is_pressing = random.chance(0.5), .is_grabbing = true},
                            random.chance(0.5));
            ASSERT_EQ(mode, first);
        }
    }
}

TEST(NextMode, HasSettledAfterOneStep)
{
    for (const StylusMode from : kModes) {
        for (const bool is_pressing : kBooleans) {
            for (const bool is_grabbing : kBooleans) {
                for (const bool is_in_contact : kBooleans) {
                    const StylusButtons buttons{.is_pressing = is_pressing,
                                                .is_grabbing = is_grabbing};
                    const StylusMode mode = nextMode(from, buttons, is_in_contact);
                    EXPECT_EQ(nextMode(mode, buttons, is_in_contact), mode);
                }
            }
        }
    }
}

TEST(StylusGoal, IsAsManyPointsOverOrUnderTheGround)
{
    const ScenePoint ground{100.0, -200.0, 50.0};
    const StylusReach reach{.hover_points = 20.0, .depth_points = 30.0};
    EXPECT_EQ(stylusGoal(ground, reach, false, 2.0), (ScenePoint{100.0, -200.0, 90.0}));
    EXPECT_EQ(stylusGoal(ground, reach, true, 2.0), (ScenePoint{100.0, -200.0, -10.0}));
}

class StylusForceTest : public testing::Test {
protected:
    Vec3 vector(double size)
    {
        return {random_.uniform(-size, size), random_.uniform(-size, size),
                random_.uniform(-size, size)};
    }
    double pointMeters() { return std::exp(random_.uniform(-10.0, 10.0)); }

    test::Random random_;
};

TEST_F(StylusForceTest, PullsFromTheGoalToTheProxyWithinTheLimit)
{
    int cut = 0;
    for (int i = 0; i < 20000; ++i) {
        const double point_m = pointMeters();
        const ScenePoint proxy = vector(1e6);
        // Up to 100 points from the proxy: the force limit is at 55.
        const Vec3 from_goal = vector(random_.uniform(0.0, 100.0) * point_m);
        const Vec3 force_n = stylusForce(proxy, proxy - from_goal, point_m);
        const double distance_m = length(proxy - (proxy - from_goal)); // after rounding
        ASSERT_LE(length(force_n), kForceNMax * (1.0 + 1e-12));
        if (distance_m < 0.01 * point_m) {
            continue; // the rounding of positions at a distance of a thousand kilometers
        }
        // Hooke's law for the device; one point is 0.2 mm.
        const double hand_m = distance_m / point_m * kHandMetersPerPoint;
        const double expected_n = std::min(hand_m * kStiffnessNPerM, kForceNMax);
        ASSERT_NEAR(length(force_n), expected_n, 1e-9);
        cut += expected_n == kForceNMax ? 1 : 0;
        ASSERT_LE(length(cross(force_n, proxy - (proxy - from_goal))),
                  1e-9 * kForceNMax * distance_m);
        ASSERT_GT(dot(force_n, proxy - (proxy - from_goal)), 0.0);
    }
    EXPECT_GT(cut, 2000);
    EXPECT_LT(cut, 18000);
}

TEST_F(StylusForceTest, FeelsTheSameAtEveryZoom)
{
    for (int i = 0; i < 1000; ++i) {
        const Vec3 apart = vector(50.0);
        const double scale = pointMeters();
        const Vec3 near = stylusForce(apart, {}, 1.0);
        const Vec3 far = stylusForce(apart * scale, {}, scale);
        ASSERT_LT(length(near - far), 1e-12);
    }
}

TEST_F(StylusForceTest, IsZeroWithoutPenetration)
{
    EXPECT_EQ(length(stylusForce({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.5)), 0.0);
}

TEST_F(StylusForceTest, GrowsWithTheDepthAndNeverJumps)
{
    double before_n = 0.0;
    for (int depth = 1; depth <= 1200; ++depth) { // tenths of a point, beyond the largest depth
        const double force_n = stylusForce({}, {0.0, 0.0, -0.1 * depth}, 1.0).z;
        EXPECT_GE(force_n, before_n - 1e-12);
        EXPECT_LE(force_n - before_n, 0.1 * kHandMetersPerPoint * kStiffnessNPerM * 1.000001);
        before_n = force_n;
    }
    EXPECT_DOUBLE_EQ(before_n, kForceNMax);
}

} // namespace
} // namespace marsview
