#include "haptics/sound/contact_listener.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview::test {
namespace {

constexpr WorkspaceBox kReach{{-0.08, -0.05, -0.05}, {0.08, 0.05, 0.05}};
constexpr std::int64_t kLookNs = 16'666'667;

// A millimeter of the workspace is a meter of the scene; the map is turned by 90 degrees.
const WorkspaceFrame kFrame{
    .place = {5000.0, 7000.0, 100.0}, .scene_per_meter = 1000.0, .turn = Angle::degrees(90.0)};

// The device at `at` presses `depth_m` deep into a surface with this `normal`.
ContactMoment pressed(std::int64_t number,
                      const WorkspacePoint& at,
                      double depth_m = 0.002,
                      const Vec3& normal = {0.0, 0.0, 1.0})
{
    return {.time_ns = 1'000'000'000 + number * kLookNs,
            .proxy = kFrame.toScene(at),
            .goal = kFrame.toScene(at + normal * -depth_m),
            .height_m = kFrame.toScene(at).z,
            .is_in_contact = true,
            .frame = kFrame,
            .stiffness_n_per_m = 300.0};
}

ContactListener listener()
{
    return ContactListener({.lowest_m = 0.0, .highest_m = 200.0, .reach = kReach});
}

TEST(ContactListener, HearsForceHeightAndSideInTheHandsFrame)
{
    ContactListener ears = listener();
    const ContactFeel feel = ears.hear(pressed(0, {0.04, -0.01, 0.05}));
    EXPECT_TRUE(feel.is_in_contact);
    EXPECT_NEAR(feel.force_n, 0.6, 1e-9);       // 2 mm at 300 N/m
    EXPECT_NEAR(feel.height_share, 0.75, 1e-9); // 100 m + 50 mm at 1:1000, of 200 m
    EXPECT_NEAR(feel.across, 0.5, 1e-9);        // to the right, whatever the orientation of the map
    EXPECT_EQ(feel.speed_m_per_s, 0.0);
}

TEST(ContactListener, HearsHowFastTheHandSlides)
{
    ContactListener ears = listener();
    ContactFeel feel;
    for (int i = 0; i < 60; ++i) {
        feel = ears.hear(pressed(i, {-0.08 + 0.1 * i * 16.666667e-3, 0.0, 0.0}));
    }
    EXPECT_NEAR(feel.speed_m_per_s, 0.1, 1e-4);
    EXPECT_NEAR(feel.roughness_rad, 0.0, 1e-6);
    for (int i = 60; i < 120; ++i) {
        feel = ears.hear(pressed(i, {0.018, 0.0, 0.0}));
    }
    EXPECT_LT(feel.speed_m_per_s, 1e-5); // at rest
}

TEST(ContactListener, IsRougherWhereTheNormalTurnsMore)
{
    double before = -1.0;
    for (const double slope_rad : {0.0, 0.1, 0.3, 0.6}) {
        ContactListener ears = listener();
        ContactFeel feel;
        for (int i = 0; i < 200; ++i) {
            // A washboard: one slope after the other.
            const double tilt_rad = i % 2 == 0 ? slope_rad : -slope_rad;
            feel = ears.hear(pressed(i, {1e-3 * i, 0.0, 0.0}, 0.002,
                                     {std::sin(tilt_rad), 0.0, std::cos(tilt_rad)}));
        }
        EXPECT_NEAR(feel.roughness_rad, 2.0 * slope_rad, 1e-6);
        EXPECT_GT(feel.roughness_rad, before);
        before = feel.roughness_rad;
        const double rough = feel.roughness_rad;
        for (int i = 200; i < 230; ++i) {
            feel = ears.hear(pressed(i, {0.199, 0.0, 0.0}));
        }
        EXPECT_NEAR(feel.roughness_rad, rough, 1e-6) << "and still is while at rest";
    }
}

TEST(ContactListener, AMapThatMovesUnderTheHandOrJumpsIsNoSliding)
{
    ContactListener ears = listener();
    ears.hear(pressed(0, {0.0, 0.0, 0.0}));
    ContactMoment moved = pressed(1, {0.0, 0.0, 0.0});
    // The same place on the map, at another position in the workspace.
    moved.frame = kFrame.panned({0.01, 0.0, 0.0});
    EXPECT_NEAR(ears.hear(moved).speed_m_per_s, 0.0, 1e-9);
    // 100 mm in 17 ms is faster than a hand.
    EXPECT_EQ(ears.hear(pressed(2, {0.1, 0.0, 0.0})).speed_m_per_s, 0.0);
    // The same sample again, as when the loop has stopped, and one after a pause.
    const ContactFeel slid = ears.hear(pressed(3, {0.101, 0.0, 0.0}));
    EXPECT_GT(slid.speed_m_per_s, 0.0);
    EXPECT_EQ(ears.hear(pressed(3, {0.101, 0.0, 0.0})).speed_m_per_s, slid.speed_m_per_s);
    EXPECT_EQ(ears.hear(pressed(90, {0.11, 0.0, 0.0})).speed_m_per_s, 0.0);
}

TEST(ContactListener, IsSilentWithoutForce)
{
    ContactListener ears = listener();
    ContactMoment free = pressed(0, {0.0, 0.0, 0.0});
    free.is_in_contact = false;
    const ContactFeel feel = ears.hear(free);
    EXPECT_FALSE(feel.is_in_contact);
    EXPECT_EQ(contactSound(feel), SoundState{});
}

TEST(ContactListener, AFlatMapHasAMiddleTone)
{
    ContactListener ears({.lowest_m = 5.0, .highest_m = 5.0, .reach = kReach});
    EXPECT_EQ(ears.hear(pressed(0, {0.0, 0.0, 0.0})).height_share, 0.5);
}

} // namespace
} // namespace marsview::test
