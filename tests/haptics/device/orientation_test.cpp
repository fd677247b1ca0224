#include "haptics/device/orientation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace marsview::test {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Rodrigues' formula; the axis has unit length.
Matrix rotationAbout(const std::array<double, 3>& axis, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto [x, y, z] = axis;
    const double t = 1.0 - c;
    return {{{t * x * x + c, t * x * y - s * z, t * x * z + s * y},
             {t * x * y + s * z, t * y * y + c, t * y * z - s * x},
             {t * x * z - s * y, t * y * z + s * x, t * z * z + c}}};
}

TEST(Orientation, OfARotationHasHalfItsAngleAboutItsAxis)
{
    constexpr std::uint32_t kSeed = 20031;
    std::mt19937 random(kSeed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angles(0.0, 3.14159265358979);
    for (int i = 0; i < 10'000; ++i) {
        std::array<double, 3> axis{normal(random), normal(random), normal(random)};
        const double length = std::hypot(axis[0], axis[1], axis[2]);
        for (double& component : axis) {
            component /= length;
        }
        const double angle = angles(random);
        const Orientation q = orientationOf(rotationAbout(axis, angle));
        const double s = std::sin(0.5 * angle);
        EXPECT_NEAR(q.w, std::cos(0.5 * angle), 1e-12) << "seed " << kSeed << ", " << i;
        EXPECT_NEAR(q.x, s * axis[0], 1e-12);
        EXPECT_NEAR(q.y, s * axis[1], 1e-12);
        EXPECT_NEAR(q.z, s * axis[2], 1e-12);
        EXPECT_TRUE(isUnit(q));
    }
}

TEST(Orientation, OfWhatIsNotARotationIsTheIdentity)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Matrix& m : {Matrix{}, Matrix{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}}},
                            Matrix{{{1.0, 0.1, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
                            Matrix{{{1.0, 0.0, 0.0}, {0.0, nan, 0.0}, {0.0, 0.0, 1.0}}}}) {
        EXPECT_EQ(orientationOf(m), Orientation{});
    }
    EXPECT_FALSE(isUnit({0.0, 0.0, 0.0, 0.0}));
    EXPECT_FALSE(isUnit({nan, 0.0, 0.0, 0.0}));
    EXPECT_FALSE(isFinite({1.0, nan, 0.0, 0.0}));
}

TEST(Orientation, TwistIsTheTurnAboutTheStylusBeforeItIsTilted)
{
    // The stylus's axis from the tip to the back end is -y in the reference orientation. Seen from
    // the back end, a positive angle about it is counter-clockwise.
    for (const double twist : {-3.0, -1.0, -0.1, 0.0, 0.5, 2.0, 3.1}) {
        for (const double tilt : {0.0, -1.5707963267948966, 0.7, 1.4}) {
            // Tilting about x, an axis perpendicular to the stylus, adds no twist.
            const Orientation turn{std::cos(0.5 * twist), 0.0, -std::sin(0.5 * twist), 0.0};
            const double c = std::cos(0.5 * tilt);
            const double s = std::sin(0.5 * tilt);
            const Orientation both{c * turn.w, s * turn.w, c * turn.y, s * turn.y};
            EXPECT_NEAR(twistOf(both), twist, 1e-12) << tilt;
            EXPECT_NEAR(twistOf({-both.w, -both.x, -both.y, -both.z}), twist, 1e-12)
                << "the same rotation";
        }
    }
    EXPECT_EQ(twistOf({0.0, 0.0, 0.0, 1.0}), 0.0) << "it points backward: undefined";
}

} // namespace
} // namespace marsview::test
