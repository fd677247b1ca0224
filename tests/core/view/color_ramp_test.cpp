#include "core/view/color_ramp.h"

#include <gtest/gtest.h>

namespace marsview {
namespace {

TEST(ColorRamp, GrowsEvenlyInLightness)
{
    for (const ColorRamp& ramp : colorRamps()) {
        const auto colors = sampledRamp(ramp);
        const double low = lightness(colors.front());
        const double high = lightness(colors.back());
        EXPECT_GT(high - low, 0.4) << ramp.name;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const double even = low + (high - low) * static_cast<double>(i) / 255.0;
            EXPECT_NEAR(lightness(colors[i]), even, 0.01) << ramp.name << " at " << i;
        }
    }
}

TEST(ColorRamp, BeginsAndEndsWithItsStops)
{
    for (const ColorRamp& ramp : colorRamps()) {
        const auto colors = sampledRamp(ramp);
        EXPECT_EQ(colors.front(), ramp.stops.front().color) << ramp.name;
        EXPECT_EQ(colors.back(), ramp.stops.back().color) << ramp.name;
    }
}

TEST(ColorRamp, IsFoundByName)
{
    EXPECT_EQ(colorRampNamed("grey"), &colorRamps()[2]);
    EXPECT_EQ(colorRampNamed("none such"), nullptr);
    EXPECT_EQ(defaultColorRamp("Mars").name, "rust");
    EXPECT_EQ(defaultColorRamp("Moon").name, "grey");
    EXPECT_EQ(defaultColorRamp("").name, "dawn");
}

} // namespace
} // namespace marsview
