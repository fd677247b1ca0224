// The effect of light on slopes.

#include "tests/render/render_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview::test {
namespace {

constexpr std::size_t kTerrainSide = 257;
constexpr Viewport kSize{.width = 256, .height = 256};

// All of a map with cells of one meter, from straight above.
OrbitCamera overview(const DrawnMap& map)
{
    OrbitCamera camera;
    camera.target = map.frame.toScene({128.0, 128.0}, 0.0);
    camera.distance_m = 1000.0;
    camera.field_of_view = Angle::radians(2.0 * std::atan(128.0 / 1000.0));
    return camera;
}

// The red channel of the pixels that show terrain, without those at its border.
std::vector<int> reds(const Picture& picture)
{
    std::vector<int> values;
    for (int y = 60; y < 200; ++y) {
        for (int x = 60; x < 200; ++x) {
            const auto pixel = static_cast<std::size_t>(y * kSize.width + x);
            if (!isSky(picture, pixel)) {
                values.push_back(picture.rgb[3 * pixel]);
            }
        }
    }
    return values;
}

double mean(const std::vector<int>& values)
{
    double sum = 0.0;
    for (const int value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

class LightTest : public RenderTest {
protected:
    Picture drawn(const DrawnMap& map, ShadingMode mode, double azimuth_deg)
    {
        renderer_->setLayers({map.layer()});
        DrawStyle style;
        style.look.mode = mode;
        style.look.light_azimuth = Angle::degrees(azimuth_deg);
        return draw(overview(map), kSize, {}, style).colors;
    }
};

// A mountainside that falls by 60 degrees toward the east, with ribs down the slope.
DrawnMap ribbedSlope()
{
    return {floatTerrain(kTerrainSide, kTerrainSide,
                         [](std::size_t c, std::size_t r) {
                             return -std::sqrt(3.0) * static_cast<double>(c) +
                                    6.0 * std::sin(static_cast<double>(r) * 0.3);
                         }),
            northUpFrame(kTerrainSide, kTerrainSide, 1.0)};
}

TEST_F(LightTest, SlopesThatFaceAwayFromTheLightShowTheirRelief)
{
    const std::vector<int> dark = reds(drawn(ribbedSlope(), ShadingMode::Hillshade, 270.0));
    ASSERT_GT(dark.size(), 10000U);
    const auto [low, high] = std::minmax_element(dark.begin(), dark.end());
    EXPECT_GT(*high - *low, 15) << "ribs in shadow";
    EXPECT_LT(*high, 120) << "it is still a shadow";
    EXPECT_GT(*low, 20) << "nothing is black";
    const std::vector<int> lit = reds(drawn(ribbedSlope(), ShadingMode::Hillshade, 90.0));
    EXPECT_GT(mean(lit), 2.0 * mean(dark));
}

TEST_F(LightTest, SlopesThatFaceTheLightAreLitByItAlone)
{
    // A plane that rises toward the light by 20 degrees: light at 45 degrees meets it at 25 from
    // its normal.
    const double rise = std::tan(Angle::degrees(20.0).radians());
    const DrawnMap map(
        floatTerrain(kTerrainSide, kTerrainSide,
                     [=](std::size_t c, std::size_t) { return -rise * static_cast<double>(c); }),
        northUpFrame(kTerrainSide, kTerrainSide, 1.0));
    const double expected =
        255.0 * kHillshadeWhite * (0.28 + 0.84 * std::cos(Angle::degrees(25.0).radians()));
    for (const int red : reds(drawn(map, ShadingMode::Hillshade, 90.0))) {
        ASSERT_NEAR(red, expected, 1.0);
    }
}

// Both sides of a roof are equally steep, so only the light makes their slope colors differ.
TEST_F(LightTest, SlopeColorsAreLitLikeTheHillshade)
{
    const DrawnMap map(floatTerrain(kTerrainSide, kTerrainSide,
                                    [](std::size_t c, std::size_t) {
                                        return -0.4 * std::abs(static_cast<double>(c) - 128.0);
                                    }),
                       northUpFrame(kTerrainSide, kTerrainSide, 1.0));
    const auto ratio = [&](ShadingMode mode) {
        const Picture picture = drawn(map, mode, 270.0);
        const auto green = [&](int x) {
            return static_cast<double>(
                picture.rgb[3 * static_cast<std::size_t>(128 * kSize.width + x) + 1]);
        };
        return green(190) / green(66);
    };
    const double light = ratio(ShadingMode::Hillshade);
    EXPECT_LT(light, 0.8);
    EXPECT_NEAR(ratio(ShadingMode::Slope), light, 0.02);
}

} // namespace
} // namespace marsview::test
