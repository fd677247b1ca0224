// Lines on the terrain: their width, their color, and what the terrain does to them.

#include "app/bench/reference/fractal_heights.h"
#include "core/terrain/ray_cast.h"
#include "tests/render/render_fixture.h"
#include "ui/render/line_renderer.h"
#include "ui/render/offscreen_picture.h"
#include "ui/render/opengl/frame_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace marsview::test {
namespace {

constexpr Viewport kPictureSize{.width = 640, .height = 400};
constexpr Rgb8 kLineColor{0, 0, 255}; // the gray terrain has no such color

class LineRendererTest : public RenderTest {
protected:
    void SetUp() override
    {
        RenderTest::SetUp();
        if (renderer_) {
            lines_ = LineRenderer::create().value();
        }
    }
    void TearDown() override
    {
        lines_.reset();
        RenderTest::TearDown();
    }

    // Red, green, blue, rows from the bottom.
    std::vector<std::uint8_t> drawn(const DrawnMap& map,
                                    const OrbitCamera& camera,
                                    const std::vector<DrapedLine>& lines,
                                    double pixels_per_point = 1.0)
    {
        renderer_->setLayers({map.layer()});
        DrawStyle style;
        style.look.mode = ShadingMode::Hillshade;
        const FrameBuffer frame(kPictureSize);
        renderer_->drawComplete({.camera = camera, .viewport = kPictureSize}, style, frame.id());
        glBindFramebuffer(GL_FRAMEBUFFER, frame.id());
        area_ = lines_->project(lines, {.camera = camera,
                                        .viewport = kPictureSize,
                                        .clip = renderer_->clip(camera, style.exaggeration),
                                        .pixels_per_point = pixels_per_point});
        lines_->drawProjected();
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        std::vector<std::uint8_t> rgb = readColors(kPictureSize);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        return rgb;
    }

    std::unique_ptr<LineRenderer> lines_;
    PixelArea area_{}; // of the lines that were drawn last
};

std::size_t offsetOf(int x, int y_up)
{
    return 3 * (static_cast<std::size_t>(y_up) * kPictureSize.width + static_cast<std::size_t>(x));
}

// How much of a pixel has the color of the line, 0 to 1: blue over the gray of the rest.
double lineShare(const std::vector<std::uint8_t>& rgb, int x, int y_up)
{
    const std::size_t at = offsetOf(x, y_up);
    return (static_cast<double>(rgb[at + 2]) - static_cast<double>(rgb[at])) / 255.0;
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

TEST_F(LineRendererTest, LinesHaveTheirWidthAtEveryDistance)
{
    const DrapedLine line{.points = {{0.0, -5000.0, 0.0}, {0.0, 5000.0, 0.0}},
                          .color = kLineColor,
                          .width_points = 3.0};
    for (const double distance_m : {300.0, 900.0, 2000.0}) {
        for (const double pixels_per_point : {1.0, 2.0}) {
            const auto rgb = drawn(plain(), fromAbove(distance_m), {line}, pixels_per_point);
            double width_px = 0.0;
            for (int x = 0; x < kPictureSize.width; ++x) {
                width_px += lineShare(rgb, x, kPictureSize.height / 2);
            }
            EXPECT_NEAR(width_px, 3.0 * pixels_per_point, 0.05) << distance_m;
        }
    }
}

// The ground below the near side of a line is nearer to the eye than the line.
TEST_F(LineRendererTest, LinesHaveTheirWidthOnGroundThatIsTilted)
{
    const DrapedLine line{.points = {{-5000.0, 0.0, 0.0}, {5000.0, 0.0, 0.0}},
                          .color = kLineColor,
                          .width_points = 4.0};
    for (const double tilt_deg : {30.0, 60.0, 75.0}) {
        OrbitCamera camera = fromAbove(900.0);
        camera.tilt = Angle::degrees(tilt_deg);
        const auto rgb = drawn(plain(), camera, {line});
        double width_px = 0.0;
        // Without the sky.
        for (int y = kPictureSize.height / 2 - 20; y < kPictureSize.height / 2 + 20; ++y) {
            width_px += lineShare(rgb, kPictureSize.width / 2, y);
        }
        EXPECT_NEAR(width_px, 4.0, 0.1) << tilt_deg;
    }
}

TEST_F(LineRendererTest, ADarkBorderSeparatesALineFromTheGround)
{
    const DrapedLine line{.points = {{0.0, -500.0, 0.0}, {0.0, 500.0, 0.0}},
                          .color = kLineColor,
                          .width_points = 4.0};
    const auto without = drawn(plain(), fromAbove(900.0), {});
    const auto rgb = drawn(plain(), fromAbove(900.0), {line});
    for (const int x : {kPictureSize.width / 2 - 3, kPictureSize.width / 2 + 2}) {
        const std::size_t at = offsetOf(x, kPictureSize.height / 2);
        EXPECT_LT(rgb[at], 0.7 * without[at]) << x;
    }
    const std::size_t beyond = offsetOf(kPictureSize.width / 2 + 8, kPictureSize.height / 2);
    EXPECT_EQ(rgb[beyond], without[beyond]);
}

// At turns of every angle, to both sides, and where points coincide.
TEST_F(LineRendererTest, JointsAreRoundAndWithoutGaps)
{
    constexpr double kWidthPx = 9.0;
    const OrbitCamera camera = fromAbove(900.0);
    DrapedLine line{.points = {{-260.0, 0.0, 0.0}}, .color = kLineColor, .width_points = kWidthPx};
    for (double turn_deg = -170.0; turn_deg <= 180.0; turn_deg += 25.0) {
        const ScenePoint& from = line.points.back();
        const double turn = Angle::degrees(turn_deg).radians();
        line.points.push_back({from.x + 25.0, from.y + 12.0, 0.0});
        line.points.push_back(line.points.back());
        line.points.push_back({line.points.back().x + 20.0 * std::cos(turn),
                               line.points.back().y + 20.0 * std::sin(turn), 0.0});
    }
    const auto rgb = drawn(plain(), camera, {line});
    std::vector<PixelPoint> pixels;
    for (const ScenePoint& point : line.points) {
        const auto pixel = project(camera, kPictureSize, point);
        ASSERT_TRUE(pixel);
        pixels.push_back(*pixel);
    }
    const auto distance = [&](double x, double y) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < pixels.size(); ++i) {
            const double dx = pixels[i].x - pixels[i - 1].x;
            const double dy = pixels[i].y - pixels[i - 1].y;
            const double square = dx * dx + dy * dy;
            const double along = (x - pixels[i - 1].x) * dx + (y - pixels[i - 1].y) * dy;
            const double share = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, std::hypot(x - pixels[i - 1].x - share * dx,
                                                   y - pixels[i - 1].y - share * dy));
        }
        return nearest;
    };
    int inside = 0;
    for (int y = 0; y < kPictureSize.height; ++y) {
        for (int x = 0; x < kPictureSize.width; ++x) {
            const double from_line = distance(x + 0.5, y + 0.5);
            const double share = lineShare(rgb, x, kPictureSize.height - 1 - y);
            if (from_line < 0.5 * kWidthPx - 0.6) {
                EXPECT_GT(share, 0.95) << x << ' ' << y;
                ++inside;
            } else if (from_line > 0.5 * kWidthPx + 0.6) {
                EXPECT_LT(share, 0.05) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(inside, 2000);
}

TEST_F(LineRendererTest, ChangesNothingOutsideItsArea)
{
    const std::vector<DrapedLine> lines{
        {.points = {{-200.0, -80.0, 0.0}, {150.0, 30.0, 0.0}, {120.0, 90.0, 0.0}},
         .color = kLineColor,
         .width_points = 5.0}};
    const OrbitCamera camera = fromAbove(900.0);
    const auto without = drawn(plain(), camera, {});
    const auto rgb = drawn(plain(), camera, lines);
    const PixelArea area = area_;
    ASSERT_GT(area.width, 0);
    ASSERT_LT(area.width, kPictureSize.width);
    std::size_t changed = 0;
    for (int y = 0; y < kPictureSize.height; ++y) {
        for (int x = 0; x < kPictureSize.width; ++x) {
            const std::size_t at = offsetOf(x, y);
            if (rgb[at] == without[at] && rgb[at + 2] == without[at + 2]) {
                continue;
            }
            ++changed;
            EXPECT_TRUE(x >= area.left && x < area.left + area.width && y >= area.bottom &&
                        y < area.bottom + area.height)
                << x << ", " << y;
        }
    }
    EXPECT_GT(changed, 500U);
}

// A picture that is drawn in parts has no seams in its lines.
TEST_F(LineRendererTest, PartsOfAPictureHaveTheLinesOfTheWhole)
{
    const OrbitCamera camera = fromAbove(900.0);
    const std::vector<DrapedLine> lines{
        {.points = {{-200.0, -80.0, 0.0}, {150.0, 30.0, 0.0}, {120.0, 90.0, 0.0}},
         .color = kLineColor,
         .width_points = 5.0}};
    const auto whole = drawn(plain(), camera, lines);
    DrawStyle style;
    style.look.mode = ShadingMode::Hillshade;
    constexpr int kSide = 96; // divides neither side of the picture
    std::size_t differing = 0;
    std::size_t of_lines = 0;
    for (int bottom = 0; bottom < kPictureSize.height; bottom += kSide) {
        for (int left = 0; left < kPictureSize.width; left += kSide) {
            const PixelArea part{.left = left,
                                 .bottom = bottom,
                                 .width = std::min(kSide, kPictureSize.width - left),
                                 .height = std::min(kSide, kPictureSize.height - bottom)};
            std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(part.width) *
                                          static_cast<std::size_t>(part.height));
            const auto report = drawPart(
                *renderer_, {.camera = camera, .viewport = kPictureSize, .part = part}, style,
                {.first = rgb.data(), .line_length = std::ptrdiff_t{3} * part.width}, [&] {
                    lines_->draw(lines, {.camera = camera,
                                         .viewport = kPictureSize,
                                         .clip = renderer_->clip(camera, style.exaggeration),
                                         .pixels_per_point = 1.0,
                                         .part = part});
                });
            ASSERT_TRUE(report && report->is_complete);
            for (int y = 0; y < part.height; ++y) {
                for (int x = 0; x < part.width; ++x) {
                    const auto* const pixel =
                        &rgb[3 * static_cast<std::size_t>((part.height - 1 - y) * part.width + x)];
                    const std::size_t at = offsetOf(left + x, bottom + y);
                    const auto off = [&](std::size_t c) {
                        return std::abs(int{pixel[c]} - int{whole[at + c]});
                    };
                    differing += std::max({off(0), off(1), off(2)}) > 2 ? 1U : 0U;
                    of_lines += whole[at + 2] > whole[at] + 60 ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GT(of_lines, 1000U);
    EXPECT_EQ(differing, 0U);
}

// Whether terrain lies in front of a point on the ground is found by casting a ray.
TEST_F(LineRendererTest, PartsThatTheTerrainHidesAreFaintAndTheOthersAreNot)
{
    Random random;
    const auto heights = fractalHeights(random, 513, 513, 4000.0, 0.6);
    const DrawnMap map{floatTerrain(513, 513, heightsFrom(heights, 513)),
                       northUpFrame(513, 513, 30.0)};
    std::size_t shown = 0;
    std::size_t hidden = 0;
    std::size_t wrong = 0;
    for (const double azimuth_deg : {20.0, 140.0, 260.0}) {
        OrbitCamera camera;
        camera.target = {0.0, 0.0, map.ground(0.0, 0.0, 1.0)};
        camera.distance_m = 9000.0;
        camera.tilt = Angle::degrees(80.0);
        camera.azimuth = Angle::degrees(azimuth_deg);
        for (int k = -6; k <= 6; ++k) {
            DrapedLine line{.points = {}, .color = kLineColor, .width_points = 4.0};
            for (double x = -5000.0; x <= 5000.0; x += 5.0) {
                const double y = 500.0 * k + 0.3 * x;
                line.points.push_back({x, y, map.ground(x, y, 1.0)});
            }
            const auto rgb = drawn(map, camera, {line});
            for (std::size_t i = 0; i < line.points.size(); i += 7) {
                const auto pixel = project(camera, kPictureSize, line.points[i]);
                if (!pixel || pixel->x < 2 || pixel->x > kPictureSize.width - 2 || pixel->y < 2 ||
                    pixel->y > kPictureSize.height - 2) {
                    continue;
                }
                // Clear cases only: the mesh of the picture is off by up to a pixel.
                const double way_m = length(line.points[i] - eyeOf(camera));
                const double pixel_m = metersPerPixel(camera, kPictureSize, line.points[i]);
                const auto hitOf = [&](double rise_px) {
                    const ScenePoint aim = line.points[i] + Vec3{0.0, 0.0, rise_px * pixel_m};
                    const Vec3 direction = normalized(aim - eyeOf(camera));
                    const auto hit = castRay(*map.field, map.analysis->bounds,
                                             gridRay(eyeOf(camera), direction, map.frame, 1.0));
                    return hit ? length(map.frame.toScene(hit->grid, hit->height_m) - eyeOf(camera))
                               : 1e30;
                };
                const bool is_clear = hitOf(-2.0) > 0.97 * way_m && hitOf(0.1) > 0.995 * way_m;
                const bool is_covered = hitOf(4.0) < 0.97 * way_m;
                if (is_clear == is_covered) {
                    continue;
                }
                const double share =
                    lineShare(rgb, static_cast<int>(pixel->x),
                              kPictureSize.height - 1 - static_cast<int>(pixel->y));
                (is_clear ? shown : hidden) += 1U;
                // A visible part of the same line may cover a hidden one.
                wrong += (is_clear ? share < 0.6 : share < 0.1) ? 1U : 0U;
            }
        }
    }
    std::printf("%zu places shown, %zu hidden, %zu drawn wrong\n", shown, hidden, wrong);
    EXPECT_GT(shown, 2000U);
    EXPECT_GT(hidden, 300U);
    EXPECT_LE(wrong, (shown + hidden) / 100);
}

TEST_F(LineRendererTest, HiddenPartsHaveNoDarkerJoints)
{
    // A wall in front of a plain.
    const DrawnMap map{floatTerrain(257, 257,
                                    [](std::size_t, std::size_t row) {
                                        return row > 140 && row < 150 ? 900.0 : 0.0;
                                    }),
                       northUpFrame(257, 257, 10.0)};
    OrbitCamera camera;
    camera.distance_m = 2500.0;
    camera.tilt = Angle::degrees(70.0);
    DrapedLine line{.points = {}, .color = kLineColor, .width_points = 5.0};
    for (double x = -300.0; x <= 300.0; x += 7.0) {
        line.points.push_back({x, 200.0, 0.0});
    }
    const auto rgb = drawn(map, camera, {line});
    const auto pixel = project(camera, kPictureSize, {0.0, 200.0, 0.0});
    ASSERT_TRUE(pixel);
    const int y = kPictureSize.height - 1 - static_cast<int>(pixel->y);
    for (int x = kPictureSize.width / 2 - 60; x < kPictureSize.width / 2 + 60; ++x) {
        EXPECT_NEAR(lineShare(rgb, x, y), 0.35, 0.02) << x;
    }
}

} // namespace
} // namespace marsview::test
