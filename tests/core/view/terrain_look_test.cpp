#include "core/view/terrain_look.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

TEST(AutomaticContourInterval, GivesAReasonableNumberOfLines)
{
    test::Random random;
    for (int i = 0; i < 20000; ++i) {
        const double low_m = random.uniform(-1e4, 1e4);
        const double relief_m = std::pow(10.0, random.uniform(-3.0, 5.0));
        const double meters_per_pixel = std::pow(10.0, random.uniform(-3.0, 5.0));
        const double interval_m = automaticContourInterval(
            {.minimum_m = low_m, .maximum_m = low_m + relief_m}, meters_per_pixel);
        // From far away: 12 to 30 lines in total.
        ASSERT_LE(interval_m, relief_m / 12.0 * (1.0 + 1e-6));
        // From close up: lines on a slope of one in ten are at least 40 pixels apart, unless the
        // whole map has too little relief.
        const double apart_px = interval_m / 0.1 / meters_per_pixel;
        const double lines = relief_m / interval_m;
        ASSERT_TRUE(apart_px >= 40.0 * (1.0 - 1e-6) || lines <= 30.0 * (1.0 + 1e-6));
        ASSERT_LE(apart_px, 100.0 * (1.0 + 1e-6));
    }
}

TEST(AutomaticContourInterval, IsRound)
{
    EXPECT_EQ(automaticContourInterval({.minimum_m = -8068.0, .maximum_m = 21171.0}, 2e4), 1000.0);
    EXPECT_EQ(automaticContourInterval({.minimum_m = -8068.0, .maximum_m = 21171.0}, 20.0), 100.0);
    EXPECT_EQ(automaticContourInterval({.minimum_m = 2.0, .maximum_m = 5.0}, 20.0), 0.1);
}

TEST(AutomaticContourInterval, IsZeroOnFlatTerrain)
{
    EXPECT_EQ(automaticContourInterval({.minimum_m = 5.0, .maximum_m = 5.0}, 10.0), 0.0);
    EXPECT_EQ(automaticContourInterval({.minimum_m = 0.0, .maximum_m = 9.0}, 0.0), 0.0);
    EXPECT_EQ(automaticContourInterval({.minimum_m = 0.0, .maximum_m = std::nan("")}, 1.0), 0.0);
    EXPECT_EQ(automaticContourInterval({.minimum_m = 0.0, .maximum_m = HUGE_VAL}, 1.0), 0.0);
}

TEST(ContourInterval, IsTheRequestedOne)
{
    const HeightRange range{.minimum_m = 0.0, .maximum_m = 3000.0};
    EXPECT_EQ(contourInterval({.has_contours = false, .contour_interval_m = 50.0}, range, 10.0), 0);
    EXPECT_EQ(contourInterval({.has_contours = true, .contour_interval_m = 70.0}, range, 10.0), 70);
    EXPECT_EQ(contourInterval({.has_contours = true}, range, 10.0),
              automaticContourInterval(range, 10.0));
    // Scaled down to a hundredth, terrain has a hundredth of the lines.
    EXPECT_EQ(contourInterval({.has_contours = true}, {.minimum_m = -9000.0, .maximum_m = 9000.0},
                              1.0, 0.01),
              automaticContourInterval({.minimum_m = -9000.0, .maximum_m = 9000.0}, 100.0));
    EXPECT_EQ(contourInterval({.has_contours = true}, range, 10.0, 20.0),
              automaticContourInterval(range, 10.0));
}

} // namespace
} // namespace marsview
