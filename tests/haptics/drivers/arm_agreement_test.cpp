// The same arm through both drivers. The kinematics of a PHANTOM as published (M. C. Cavusoglu, D.
// Feygin, F. Tendick, A Critical Study of the Mechanical and Electrical Properties of the PHANToM
// Haptic Interface, Presence 11(6), 2002, equations 1 and 3) are those of a Polhem arm with bodies
// of the same length, with other angles and axes. OpenHaptics' frame and its conversion must
// therefore agree with the Polhem driver on the position of the end effector and on the torques
// that produce a force there.
#include "haptics/drivers/openhaptics/openhaptics_frame.h"
#include "haptics/drivers/polhem/polhem_kinematics.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace marsview::test {
namespace {

using Angles = std::array<double, 3>;

// Of a PHANTOM Premium 1.0.
constexpr double kLength1Mm = 139.7;
constexpr double kLength2Mm = 139.7;

// In the frame of OpenHaptics: mm, x right, y up, z toward the user; all angles zero in the middle.
std::array<double, 3> phantomPositionMm(const Angles& q)
{
    const double reach = kLength1Mm * std::cos(q[1]) + kLength2Mm * std::sin(q[2]);
    return {std::sin(q[0]) * reach,
            kLength2Mm - kLength2Mm * std::cos(q[2]) + kLength1Mm * std::sin(q[1]),
            -kLength1Mm + std::cos(q[0]) * reach};
}

// The same arm as the Polhem driver describes it: the lower body's angle starts at the vertical
// there, and at the horizontal here.
PolhemParameters polhemLikePhantom()
{
    PolhemParameters p;
    p.body_length_m = {kLength2Mm / 1000.0, kLength1Mm / 1000.0, kLength2Mm / 1000.0};
    p.origin_m = {kLength1Mm / 1000.0, 0.0, 0.0};
    return p;
}

PolhemPose poseOf(const Angles& q)
{
    return {q[0], std::numbers::pi / 2.0 - q[1], q[2]};
}

// Within the workspace of a PHANTOM, and somewhat beyond.
Angles anyAngles(Random& random)
{
    const double turn = random.uniform(-1.2, 1.2);
    const double lower = random.uniform(-0.3, 1.7);
    const double upper = random.uniform(-0.9, 1.3);
    return {turn, lower, upper};
}

Vec3 anyForce(Random& random)
{
    const double x = random.uniform(-8.0, 8.0);
    const double y = random.uniform(-8.0, 8.0);
    const double z = random.uniform(-8.0, 8.0);
    return {x, y, z};
}

// The displacement of the end effector per radian of one joint, from central differences of the
// position alone, in the frame of OpenHaptics and in meters.
std::array<double, 3> phantomDerivative(const Angles& q, std::size_t joint)
{
    constexpr double kStep = 1e-5;
    Angles more = q;
    Angles less = q;
    more[joint] += kStep;
    less[joint] -= kStep;
    const std::array<double, 3> high = phantomPositionMm(more);
    const std::array<double, 3> low = phantomPositionMm(less);
    std::array<double, 3> derivative{};
    for (std::size_t i = 0; i < 3; ++i) {
        derivative[i] = (high[i] - low[i]) / (2.0 * kStep) / 1000.0;
    }
    return derivative;
}

} // namespace

TEST(ArmAgreement, BothDriversPutTheHandOfOneArmInOnePlace)
{
    Random random;
    double worst_m = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const Angles q = anyAngles(random);
        const WorkspacePoint by_phantom = fromOpenHaptics(phantomPositionMm(q));
        const WorkspacePoint by_polhem = polhemPosition(polhemLikePhantom(), poseOf(q));
        worst_m = std::max(worst_m, length(by_phantom - by_polhem));
    }
    std::printf("largest distance %.2g m\n", worst_m);
    EXPECT_LT(worst_m, 1e-15);
    // By hand: both bodies at right angles, the base turned a quarter to the right.
    const WorkspacePoint right =
        fromOpenHaptics(phantomPositionMm({std::numbers::pi / 2.0, 0.0, 0.0}));
    EXPECT_NEAR(right.x, 0.1397, 1e-15);
    EXPECT_NEAR(right.y, 0.1397, 1e-15);
    EXPECT_NEAR(right.z, 0.0, 1e-15);
}

// Virtual work: torques times joint motion equal force times end effector motion, in every frame.
// One driver sends the force itself, in the vendor's axes; the other sends torques.
TEST(ArmAgreement, BothDriversHoldAForceWithTheSameTorques)
{
    Random random;
    double worst_nm = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const Angles q = anyAngles(random);
        const Vec3 force_n = anyForce(random);
        const std::array<double, 3> sent = forceToOpenHaptics(force_n);
        const std::array<double, 3> torques =
            polhemTorques(polhemLikePhantom(), poseOf(q), force_n);
        for (std::size_t joint = 0; joint < 3; ++joint) {
            const std::array<double, 3> way_m = phantomDerivative(q, joint);
            const double by_phantom_nm =
                sent[0] * way_m[0] + sent[1] * way_m[1] + sent[2] * way_m[2];
            // The lower body's angle increases in the other direction.
            const double by_polhem_nm = joint == 1 ? -torques[joint] : torques[joint];
            worst_nm = std::max(worst_nm, std::abs(by_phantom_nm - by_polhem_nm));
        }
    }
    std::printf("largest difference %.2g N·m\n", worst_nm);
    // The error of the differences: 1e-13 mm of rounding over 1e-5 rad, and 14 N.
    EXPECT_LT(worst_nm, 1e-9);
}

// The velocity of an end effector while all joints move, as the loop measures it, and the power.
TEST(ArmAgreement, BothDriversSeeTheSamePower)
{
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const Angles q = anyAngles(random);
        const Angles rate{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0),
                          random.uniform(-3.0, 3.0)};
        const Vec3 force_n = anyForce(random);
        constexpr double kStepS = 1e-5;
        Angles later = q;
        Angles earlier = q;
        for (std::size_t j = 0; j < 3; ++j) {
            later[j] += rate[j] * kStepS;
            earlier[j] -= rate[j] * kStepS;
        }
        const Vec3 velocity = (fromOpenHaptics(phantomPositionMm(later)) -
                               fromOpenHaptics(phantomPositionMm(earlier))) *
                              (0.5 / kStepS);
        const std::array<double, 3> torques =
            polhemTorques(polhemLikePhantom(), poseOf(q), force_n);
        const double power_w = torques[0] * rate[0] - torques[1] * rate[1] + torques[2] * rate[2];
        EXPECT_NEAR(dot(force_n, velocity), power_w, 1e-7);
    }
}

} // namespace marsview::test
