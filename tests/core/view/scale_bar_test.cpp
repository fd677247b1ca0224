#include "core/view/scale_bar.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

TEST(MetersPerPixel, IsTheWidthOfAPixelAtTheTarget)
{
    const Viewport viewport{1280, 800};
    for (const double tilt : {0.0, 50.0, 85.0}) {
        const OrbitCamera camera{.target = {100.0, -50.0, 20.0},
                                 .distance_m = 4e4,
                                 .azimuth = Angle::degrees(70.0),
                                 .tilt = Angle::degrees(tilt)};
        const Vec3 right = axesOf(camera).right;
        const auto a = project(camera, viewport, camera.target);
        const auto b = project(camera, viewport, camera.target + right * 1000.0);
        ASSERT_TRUE(a && b);
        EXPECT_NEAR(1000.0 / (b->x - a->x), metersPerPixel(camera, viewport), 1e-6);
    }
}

TEST(ScaleBar, IsTheLongestRoundLengthThatFits)
{
    test::Random random;
    for (int i = 0; i < 20000; ++i) {
        const double meters_per_pixel = std::pow(10.0, random.uniform(-3.0, 6.0));
        const double width_max_px = random.uniform(1.0, 400.0);
        const auto bar = scaleBar(meters_per_pixel, width_max_px);
        ASSERT_TRUE(bar);
        ASSERT_LE(bar->width_px, width_max_px);
        ASSERT_GE(bar->width_px, width_max_px * 0.4 * (1.0 - 1e-6));
        ASSERT_NEAR(bar->width_px * meters_per_pixel, bar->length_m, bar->length_m * 1e-8);
        const double decade = std::pow(10.0, std::floor(std::log10(bar->length_m) + 1e-6));
        const double lead = bar->length_m / decade;
        ASSERT_TRUE(std::abs(lead - 1.0) < 1e-9 || std::abs(lead - 2.0) < 1e-9 ||
                    std::abs(lead - 5.0) < 1e-9)
            << bar->length_m;
        const double next = bar->length_m * (lead < 1.5 || lead > 4.0 ? 2.0 : 2.5);
        ASSERT_GT(next, meters_per_pixel * width_max_px) << "a longer one would have fitted";
    }
}

TEST(ScaleBar, MatchesKnownLengthsOnMars)
{
    const auto bar = scaleBar(4000.0, 160.0); // 640 km
    ASSERT_TRUE(bar);
    EXPECT_EQ(bar->length_m, 500e3);
    EXPECT_EQ(bar->width_px, 125.0);
}

TEST(ScaleBar, IsEmptyWithoutScaleOrRoom)
{
    EXPECT_FALSE(scaleBar(0.0, 100.0));
    EXPECT_FALSE(scaleBar(-1.0, 100.0));
    EXPECT_FALSE(scaleBar(std::nan(""), 100.0));
    EXPECT_FALSE(scaleBar(HUGE_VAL, 100.0));
    EXPECT_FALSE(scaleBar(1.0, 0.0));
    EXPECT_FALSE(scaleBar(1.0, std::nan("")));
    EXPECT_FALSE(scaleBar(1e-300, 1e-300));
}

} // namespace
} // namespace marsview
