#include "core/base/angle.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

TEST(Angle, DegreesComeBackWithinTwoUlp)
{
    test::Random random;
    for (int i = 0; i < 100000; ++i) {
        const double degrees = random.uniform(-720.0, 720.0);
        const double ulp = std::nextafter(std::abs(degrees), INFINITY) - std::abs(degrees);
        ASSERT_NEAR(Angle::degrees(degrees).degrees(), degrees, 2.0 * ulp);
    }
}

TEST(Angle, RightAnglesComeBackExactly)
{
    for (const double degrees : {0.0, 90.0, -90.0, 180.0, -180.0, 360.0}) {
        EXPECT_EQ(Angle::degrees(degrees).degrees(), degrees);
    }
}

} // namespace
} // namespace marsview
