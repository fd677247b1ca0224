// Pictures with nine samples a pixel: the means over pixels, whatever the blocks.

#include "core/view/navigation.h"
#include "tests/render/render_fixture.h"
#include "tests/support/random.h"
#include "ui/render/supersampled_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace marsview::test {
namespace {

// Gray columns of these levels.
Picture columnsOf(const std::vector<int>& levels, int height)
{
    Picture picture{.width = static_cast<int>(levels.size()), .height = height, .rgb = {}};
    for (int y = 0; y < height; ++y) {
        for (const int level : levels) {
            picture.rgb.insert(picture.rgb.end(), 3, static_cast<std::uint8_t>(level));
        }
    }
    return picture;
}

TEST(Contrast, IsTheDistanceFromTheMeanOfTheNeighbors)
{
    EXPECT_EQ(contrastOf(columnsOf({10, 20, 30, 40, 50}, 9), {}), 0) << "a slope has none";
    EXPECT_EQ(contrastOf(columnsOf({10, 90, 10, 90, 10}, 9), {}), 80);
    EXPECT_EQ(contrastOf(columnsOf({10, 90}, 9), {}), 0) << "no pixel has two neighbors";
    std::vector<int> one_edge(400, 10);
    one_edge[200] = 250;
    EXPECT_EQ(contrastOf(columnsOf(one_edge, 9), {}), 0) << "3 of 398 columns differ";
    one_edge[100] = one_edge[300] = 250;
    EXPECT_EQ(contrastOf(columnsOf(one_edge, 9), {}), 120) << "9 of 398 columns differ";
}

TEST(Contrast, IsThatOfRowsAsWell)
{
    Picture picture = columnsOf({0, 0, 0, 0}, 6);
    for (std::size_t y = 0; y < 6; y += 2) {
        std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(12 * y), 12,
                    std::uint8_t{50});
    }
    EXPECT_EQ(contrastOf(picture, {}), 50);
}

// Half of the picture is sky, in the default colors, which differ from row to row.
TEST(Contrast, IsThatOfTheTerrainUnderTheSky)
{
    const DrawStyle style;
    std::vector<int> levels(200, 100);
    levels[100] = 200;
    Picture picture = columnsOf(levels, 80);
    EXPECT_EQ(contrastOf(picture, style), 50) << "3 of 198 columns differ";
    for (int y = 0; y < 50; ++y) {
        const double up = 1.0 - (y + 0.5) / 80.0;
        const auto mixed = [up](std::uint8_t top, std::uint8_t bottom) {
            return static_cast<std::uint8_t>(std::lround(bottom + up * (top - bottom)));
        };
        for (int x = 0; x < 200; ++x) {
            std::uint8_t* pixel = &picture.rgb.at(static_cast<std::size_t>(3 * (200 * y + x)));
            pixel[0] = mixed(style.sky_top.red, style.sky_bottom.red);
            pixel[1] = mixed(style.sky_top.green, style.sky_bottom.green);
            pixel[2] = mixed(style.sky_top.blue, style.sky_bottom.blue);
        }
    }
    EXPECT_EQ(contrastOf(picture, style), 50) << "neither the sky nor the horizon counts";
    const Picture sky{.width = 200,
                      .height = 50,
                      .rgb = {picture.rgb.begin(), picture.rgb.begin() + 3 * 200 * 50}};
    DrawStyle of_part = style;
    of_part.sky_bottom = {sky.rgb.at(3 * 200 * 49), sky.rgb.at(3 * 200 * 49 + 1),
                          sky.rgb.at(3 * 200 * 49 + 2)};
    EXPECT_EQ(contrastOf(sky, of_part), 0) << "nothing else to see";
}

class SupersampledPictureTest : public RenderTest {
protected:
    void SetUp() override
    {
        RenderTest::SetUp();
        if (IsSkipped()) {
            return;
        }
        Random random(5);
        const auto heights = heightsFrom(fractalHeights(random, 700, 500, 3000.0, 0.55), 700);
        map_.emplace(floatTerrain(700, 500, heights), northUpFrame(700, 500, 50.0));
        renderer_->setLayers({map_->layer()});
        style_.exaggeration = 4.0;
        // Nothing that depends on the height of a picture in pixels.
        style_.sky_top = kSkyColor;
        style_.sky_bottom = kSkyColor;
        request_.viewport = {.width = 431, .height = 257};
        request_.camera = homeCamera(map_->box(style_.exaggeration), request_.viewport);
    }

    std::optional<DrawnMap> map_;
    DrawStyle style_;
    DrawRequest request_;
};

TEST_F(SupersampledPictureTest, IsTheMeanOfALargerPicture)
{
    DrawRequest large = supersampled(request_, *renderer_, style_.exaggeration);
    ASSERT_EQ(large.viewport.width, 3 * request_.viewport.width);
    const Picture samples = drawOffscreen(*renderer_, large, style_, DepthUse::No).value().colors;
    SupersampledPicture picture(*renderer_, request_, style_);
    ASSERT_TRUE(picture.finish());
    const Picture& means = picture.colors();
    ASSERT_EQ(means.width, request_.viewport.width);
    ASSERT_EQ(means.height, request_.viewport.height);
    std::size_t different = 0;
    for (int y = 0; y < means.height; ++y) {
        for (int x = 0; x < 3 * means.width; ++x) {
            int sum = 0;
            for (int i = 0; i < 9; ++i) {
                const int row = 3 * y + i / 3;
                const int column = 3 * (x / 3) + i % 3;
                sum += samples.rgb.at(
                    static_cast<std::size_t>(3 * (row * samples.width + column) + x % 3));
            }
            const int mean = static_cast<int>(std::lround(sum / 9.0));
            const int drawn = means.rgb.at(static_cast<std::size_t>(3 * y * means.width + x));
            // Blocks select nodes of their own, so that a few pixels have other triangles.
            different += std::abs(mean - drawn) > 1 ? 1U : 0U;
        }
    }
    EXPECT_LT(static_cast<double>(different), 0.002 * static_cast<double>(means.rgb.size()));
    EXPECT_GT(skyPixels(means), 0U);
    EXPECT_LT(skyPixels(means), means.rgb.size() / 4) << "most of it is terrain or mixed";
}

// The reason for it: half a pixel of error of the mesh shows less.
TEST_F(SupersampledPictureTest, IsWithinFourLevelsOfTheOneWithEverySample)
{
    DrawRequest full = request_;
    full.detail.has_every_sample = true;
    request_.samples = kSmoothSamples;
    const Picture smooth = drawOffscreen(*renderer_, request_, style_, DepthUse::No)->colors;
    ASSERT_GT(contrastOf(smooth, style_), kSmoothContrastMax);
    const auto levels = [](const Picture& a, const Picture& b) {
        std::vector<int> differences;
        for (std::size_t i = 0; i < a.rgb.size(); ++i) {
            differences.push_back(std::abs(a.rgb[i] - b.rgb[i]));
        }
        const auto at = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 100);
        std::nth_element(differences.begin(), at, differences.end(), std::greater<>());
        return *at;
    };
    SupersampledPicture picture(*renderer_, request_, style_);
    SupersampledPicture reference(*renderer_, full, style_);
    ASSERT_TRUE(picture.finish() && reference.finish());
    EXPECT_LE(levels(picture.colors(), reference.colors()), 4);
    EXPECT_GT(levels(smooth, reference.colors()), 8) << contrastOf(smooth, style_);
}

// Twice as wide a picture shows as much terrain, with more sky around it.
TEST_F(SupersampledPictureTest, IsNeededWhateverTheShareOfTheSky)
{
    style_.sky_top = DrawStyle{}.sky_top;
    style_.sky_bottom = DrawStyle{}.sky_bottom;
    request_.samples = kSmoothSamples;
    request_.viewport = {.width = 500, .height = 300};
    const Picture narrow = drawOffscreen(*renderer_, request_, style_, DepthUse::No)->colors;
    request_.viewport.width = 2000;
    const Picture wide = drawOffscreen(*renderer_, request_, style_, DepthUse::No)->colors;
    const int contrast = contrastOf(narrow, style_);
    EXPECT_GT(contrast, kSmoothContrastMax);
    EXPECT_NEAR(contrastOf(wide, style_), contrast, 2);
}

TEST_F(SupersampledPictureTest, HasContourLinesAsWideAsTheSmoothPicture)
{
    style_.exaggeration = 0.2;
    style_.look.mode = ShadingMode::Hillshade;
    request_.camera = homeCamera(map_->box(style_.exaggeration), request_.viewport);
    request_.samples = kSmoothSamples;
    const auto brightness = [](const Picture& picture) {
        double sum = 0.0;
        for (const std::uint8_t value : picture.rgb) {
            sum += value;
        }
        return sum / static_cast<double>(picture.rgb.size());
    };
    const auto ink = [&](auto draw) {
        style_.look.has_contours = false;
        const double without = brightness(draw());
        style_.look.has_contours = true;
        return without - brightness(draw());
    };
    const double smooth =
        ink([&] { return drawOffscreen(*renderer_, request_, style_, DepthUse::No)->colors; });
    const double supersampled = ink([&] {
        SupersampledPicture picture(*renderer_, request_, style_);
        EXPECT_TRUE(picture.finish());
        return picture.colors();
    });
    EXPECT_GT(smooth, 1.0);
    EXPECT_NEAR(supersampled / smooth, 1.0, 0.25) << "not a third";
}

} // namespace
} // namespace marsview::test
