// Dots on the terrain: their size, their symbols, and what the terrain does to them.

#include "tests/render/render_fixture.h"
#include "ui/render/dot_renderer.h"
#include "ui/render/opengl/frame_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

constexpr Viewport kPictureSize{.width = 640, .height = 400};
constexpr Rgb8 kDotColor{0, 0, 255}; // the gray terrain has no such color

class DotRendererTest : public RenderTest {
protected:
    void SetUp() override
    {
        RenderTest::SetUp();
        if (renderer_) {
            dots_ = DotRenderer::create().value();
        }
    }
    void TearDown() override
    {
        dots_.reset();
        RenderTest::TearDown();
    }

    // Red, green, blue, rows from the bottom. The picture of the terrain may be smaller.
    std::vector<std::uint8_t>
    drawn(const DrawnMap& map, const OrbitCamera& camera, const DotSet& set, double scale = 1.0)
    {
        renderer_->setLayers({map.layer()});
        DrawStyle style;
        style.look.mode = ShadingMode::Hillshade;
        const FrameBuffer frame(kPictureSize);
        renderer_->drawComplete(
            {.camera = camera, .viewport = kPictureSize, .scale = scale, .is_kept = true}, style,
            frame.id());
        glBindFramebuffer(GL_FRAMEBUFFER, frame.id());
        dots_->draw(0, set, ++revision_,
                    {.camera = camera,
                     .viewport = kPictureSize,
                     .clip = renderer_->clip(camera, style.exaggeration)},
                    renderer_->keptDepths());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        std::vector<std::uint8_t> rgb = readColors(kPictureSize);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        return rgb;
    }

    std::unique_ptr<DotRenderer> dots_;
    std::uint64_t revision_ = 0;
};

// How much of a pixel has the color of the dot, 0 to 1: blue over the gray of the rest.
double dotShare(const std::vector<std::uint8_t>& rgb, int x, int y_up)
{
    const std::size_t at =
        3 * (static_cast<std::size_t>(y_up) * kPictureSize.width + static_cast<std::size_t>(x));
    return (static_cast<double>(rgb[at + 2]) - static_cast<double>(rgb[at])) / 255.0;
}

double dotPixels(const std::vector<std::uint8_t>& rgb)
{
    double pixels = 0.0;
    for (int y = 0; y < kPictureSize.height; ++y) {
        for (int x = 0; x < kPictureSize.width; ++x) {
            pixels += dotShare(rgb, x, y);
        }
    }
    return pixels;
}

DrawnMap plain()
{
    return {floatTerrain(257, 257, [](std::size_t, std::size_t) { return 0.0; }),
            northUpFrame(257, 257, 10.0)};
}

OrbitCamera fromAbove(double distance_m)
{
    OrbitCamera camera;
    camera.distance_m = distance_m;
    return camera;
}

TEST_F(DotRendererTest, DiscsHaveTheirWidthAtEveryDistance)
{
    for (const double distance_m : {300.0, 900.0, 2000.0}) {
        const auto rgb = drawn(plain(), fromAbove(distance_m),
                               {.dots = {{.place = {13.0, -17.0, 0.0}, .color = kDotColor}},
                                .width_points = 9.0,
                                .stamps = nullptr});
        EXPECT_NEAR(dotPixels(rgb), 0.25 * std::numbers::pi * 9.0 * 9.0, 1.5) << distance_m;
    }
}

// Half of it is in the picture.
TEST_F(DotRendererTest, ADiscWhoseCenterIsOutsideThePictureIsCutOff)
{
    const OrbitCamera camera = fromAbove(900.0);
    const double pixel_m = metersPerPixel(camera, kPictureSize, {0.0, 0.0, 0.0});
    const auto rgb = drawn(plain(), camera,
                           {.dots = {{.place = {-pixel_m * 322.0, 0.0, 0.0}, .color = kDotColor}},
                            .width_points = 12.0,
                            .stamps = nullptr});
    // A segment beyond 2 of 6 pixels.
    const double segment = 36.0 * std::acos(2.0 / 6.0) - 2.0 * std::sqrt(36.0 - 4.0);
    EXPECT_NEAR(dotPixels(rgb), segment, 2.0);
}

TEST_F(DotRendererTest, SymbolsArePixelsOfTheirStamps)
{
    // The second symbol: a corner at the top left, the rest of its first row half covered.
    auto stamps = std::make_shared<DotStamps>();
    stamps->side_px = 4;
    stamps->count = 2;
    stamps->filled_sides_px = {2, 4};
    stamps->coverage.assign(32, {0, 0});
    stamps->coverage[16] = {255, 0};
    for (std::size_t i = 17; i < 20; ++i) {
        stamps->coverage[i] = {51, 0};
    }
    stamps->coverage[31] = {255, 255}; // the rim is over it
    const auto rgb = drawn(plain(), fromAbove(900.0),
                           {.dots = {{.place = {0.0, 0.0, 0.0}, .color = kDotColor, .symbol = 1}},
                            .width_points = 0.0,
                            .stamps = stamps});
    const int left = kPictureSize.width / 2 - 2;
    const int top = kPictureSize.height / 2 + 1;
    EXPECT_NEAR(dotShare(rgb, left, top), 1.0, 0.01);
    EXPECT_NEAR(dotShare(rgb, left + 1, top), 0.2, 0.01);
    EXPECT_NEAR(dotShare(rgb, left + 3, top), 0.2, 0.01);
    EXPECT_NEAR(dotPixels(rgb), 1.6, 0.03);
    EXPECT_EQ(rgb[3 * static_cast<std::size_t>((top - 3) * kPictureSize.width + left + 3)], 0)
        << "the rim is black";
}

// Behind a wall in front of a plain, also where the picture of the terrain is smaller.
TEST_F(DotRendererTest, HiddenDotsAreEquallyFaintWhereTheyLieOverEachOther)
{
    const DrawnMap map{floatTerrain(257, 257,
                                    [](std::size_t, std::size_t row) {
                                        return row > 140 && row < 150 ? 900.0 : 0.0;
                                    }),
                       northUpFrame(257, 257, 10.0)};
    OrbitCamera camera;
    camera.distance_m = 2500.0;
    camera.tilt = Angle::degrees(70.0);
    DotSet hidden{.dots = {}, .width_points = 9.0, .stamps = nullptr};
    for (double x = -300.0; x <= 300.0; x += 7.0) {
        hidden.dots.push_back({.place = {x, 200.0, 0.0}, .color = kDotColor});
    }
    const DotSet shown{.dots = {{.place = {0.0, -400.0, 0.0}, .color = kDotColor}},
                       .width_points = 9.0,
                       .stamps = nullptr};
    for (const double scale : {1.0, 0.5}) {
        const auto faint = drawn(map, camera, hidden, scale);
        const auto behind = project(camera, kPictureSize, hidden.dots.front().place);
        ASSERT_TRUE(behind);
        const int y = kPictureSize.height - 1 - static_cast<int>(behind->y);
        for (int x = kPictureSize.width / 2 - 60; x < kPictureSize.width / 2 + 60; ++x) {
            EXPECT_NEAR(dotShare(faint, x, y), 0.35, 0.02) << x;
        }
        const auto clear = drawn(map, camera, shown, scale);
        const auto before = project(camera, kPictureSize, shown.dots.front().place);
        ASSERT_TRUE(before);
        EXPECT_NEAR(dotShare(clear, static_cast<int>(before->x),
                             kPictureSize.height - 1 - static_cast<int>(before->y)),
                    1.0, 0.01);
    }
}

} // namespace
} // namespace marsview::test
