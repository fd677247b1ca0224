// Extreme maps and pictures: voids, layers, the smallest and the largest sizes.

#include "core/view/navigation.h"
#include "tests/render/render_fixture.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace marsview::test {
namespace {

// Straight down onto a grid position, so close that a sample is `pixels` wide.
OrbitCamera above(const DrawnMap& map,
                  GridPoint grid,
                  double height_m,
                  double pixels_per_sample,
                  const Viewport& size)
{
    OrbitCamera camera;
    camera.target = map.frame.toScene(grid, height_m);
    camera.distance_m = map.frame.east_per_column / pixels_per_sample * size.height /
                        (2.0 * std::tan(camera.field_of_view.radians() / 2.0));
    return camera;
}

// The point where a pixel's ray meets a height.
GridPoint gridAt(const DrawnMap& map,
                 const OrbitCamera& camera,
                 const Viewport& size,
                 std::size_t pixel,
                 double height_m)
{
    const auto width = static_cast<std::size_t>(size.width);
    const Ray ray = pickRay(
        camera, size,
        {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5});
    return map.frame.toGrid(ray.at((height_m - ray.origin.z) / ray.direction.z));
}

// Whether the result is the same at all points `margin` samples away from a position.
template <typename Is>
bool isSettled(const Is& is, const GridPoint& p, double margin)
{
    const bool here = is(p);
    for (const double dx : {-margin, 0.0, margin}) {
        for (const double dy : {-margin, 0.0, margin}) {
            if (is(GridPoint{p.column + dx, p.row + dy}) != here) {
                return false;
            }
        }
    }
    return true;
}

using SpecialMaps = RenderTest;

TEST_F(SpecialMaps, HolesAreTheTrianglesWithAVoidCorner)
{
    Random random;
    constexpr std::size_t kSide = 300;
    const DrawnMap map(floatTerrain(kSide, kSide,
                                    [&](std::size_t c, std::size_t r) {
                                        const bool is_hole = c > 100 && c < 120 && r > 80 && r < 90;
                                        return is_hole || random.chance(0.06) ? kNan : 5.0;
                                    }),
                       northUpFrame(kSide, kSide, 10.0));
    renderer_->setLayers({map.layer()});
    const Viewport size{.width = 480, .height = 360};
    const auto isHole = [&](const GridPoint& p) { return std::isnan(map.field->height(p)); };
    std::size_t holes = 0;
    std::size_t ground = 0;
    for (const GridPoint target : {GridPoint{110.0, 85.0}, GridPoint{40.5, 200.25},
                                   GridPoint{257.0, 255.5}, GridPoint{280.0, 20.0}}) {
        for (const double pixels : {40.0, 12.0, 5.0}) {
            const OrbitCamera camera = above(map, target, 5.0, pixels, size);
            const OffscreenPicture picture = draw(camera, size, {}, {});
            for (std::size_t i = 0; i < picture.colors.rgb.size() / 3; ++i) {
                const GridPoint p = gridAt(map, camera, size, i, 5.0);
                constexpr double kMargin = 0.02;
                if (!isSettled(isHole, p, kMargin)) {
                    continue;
                }
                (isHole(p) ? holes : ground) += 1;
                ASSERT_EQ(isSky(picture.colors, i), isHole(p))
                    << p.column << ", " << p.row << " at " << pixels << " pixels per sample";
            }
        }
    }
    EXPECT_GT(holes, 100000U);
    EXPECT_GT(ground, 100000U);
}

TEST_F(SpecialMaps, LargeHolesShowTheSkyFromFarAway)
{
    Random random;
    constexpr std::size_t kSide = 1500;
    const auto heights = fractalHeights(random, kSide, kSide, 300.0, 0.5);
    const auto isVoid = [](std::size_t c, std::size_t r) {
        return (c > 500 && c < 900 && r > 400 && r < 700) || c + r < 500;
    };
    const DrawnMap map(floatTerrain(kSide, kSide,
                                    [&](std::size_t c, std::size_t r) {
                                        return isVoid(c, r) ? kNan : heights[r * kSide + c];
                                    }),
                       northUpFrame(kSide, kSide, 100.0));
    renderer_->setLayers({map.layer()});
    const Viewport size{.width = 400, .height = 400};
    const OrbitCamera camera = above(map, {749.5, 749.5}, 0.0, 0.24, size);
    const OffscreenPicture picture = draw(camera, size, {}, {});
    const auto isHole = [&](const GridPoint& p) { return std::isnan(map.field->height(p)); };
    std::size_t compared = 0;
    for (std::size_t i = 0; i < picture.colors.rgb.size() / 3; ++i) {
        const GridPoint p = gridAt(map, camera, size, i, 0.0);
        constexpr double kMargin = 12.0; // a texel of 8 samples, and the parallax of the height
        if (isSettled(isHole, p, kMargin)) {
            ++compared;
            ASSERT_EQ(isSky(picture.colors, i), isHole(p)) << p.column << ", " << p.row;
        }
    }
    EXPECT_GT(compared, 120000U);
}

TEST_F(SpecialMaps, TheSmallestAndTheLongestMapAreDrawn)
{
    Random random;
    for (const auto& [columns, rows] :
         {std::pair<std::size_t, std::size_t>{2, 2}, {2, 100000}, {100000, 2}, {33, 2}}) {
        SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
        const DrawnMap map(
            floatTerrain(columns, rows,
                         heightsFrom(fractalHeights(random, columns, rows, 20.0, 0.6), columns)),
            northUpFrame(columns, rows, 10.0));
        renderer_->setLayers({map.layer()});
        const Viewport size{.width = 300, .height = 200};
        draw(homeCamera(map.box(1.0), size), size, {}, {});
        for (const double share : {0.0, 0.3, 0.999}) {
            const GridPoint target{share * static_cast<double>(columns - 1) + 0.3 * (1.0 - share),
                                   share * static_cast<double>(rows - 1) + 0.4 * (1.0 - share)};
            const OrbitCamera camera = above(map, target, map.field->height(target), 150.0, size);
            const OffscreenPicture picture = draw(camera, size, {}, {});
            for (std::size_t i = 0; i < picture.colors.rgb.size() / 3; ++i) {
                // All of it is within 20 m of 0; the eye is some 27 m above the terrain.
                const GridPoint p = gridAt(map, camera, size, i, map.field->height(target));
                if (std::abs(p.column - target.column) < 1e-3 &&
                    std::abs(p.row - target.row) < 1e-3) {
                    EXPECT_FALSE(isSky(picture.colors, i));
                }
            }
            EXPECT_LT(skyPixels(picture.colors), picture.colors.rgb.size() / 3);
        }
    }
}

TEST_F(SpecialMaps, FlatTerrainIsDrawnInOneColorWithFewTriangles)
{
    const DrawnMap map(int16Terrain(2000, 2000, {}, [](auto...) { return -37.0; }),
                       northUpFrame(2000, 2000, 10.0));
    renderer_->setLayers({map.layer()});
    const Viewport size{.width = 400, .height = 300};
    for (const ShadingMode mode : {ShadingMode::Tint, ShadingMode::Hillshade, ShadingMode::Slope}) {
        DrawStyle style;
        style.look = {.mode = mode, .has_contours = true};
        OrbitCamera camera = above(map, {999.5, 999.5}, -37.0, 1.0, size);
        camera.tilt = Angle::degrees(40.0);
        const OffscreenPicture picture = draw(camera, size, {}, style);
        EXPECT_EQ(skyPixels(picture.colors), 0U);
        for (std::size_t i = 3; i < picture.colors.rgb.size(); ++i) {
            ASSERT_NEAR(picture.colors.rgb[i], picture.colors.rgb[i % 3], 1);
        }
        EXPECT_LT(picture.report.triangle_count, 100000U);
    }
}

TEST_F(SpecialMaps, PicturesMayHaveOneToTwelveMillionPixels)
{
    Random random;
    const DrawnMap map(
        floatTerrain(200, 200, heightsFrom(fractalHeights(random, 200, 200, 300.0, 0.5), 200)),
        northUpFrame(200, 200, 30.0));
    renderer_->setLayers({map.layer()});
    for (const Viewport& size :
         {Viewport{.width = 1, .height = 1}, Viewport{.width = 1, .height = 90},
          Viewport{.width = 90, .height = 1}, Viewport{.width = 4000, .height = 3000}}) {
        const OrbitCamera camera = above(map, {99.5, 99.5}, 0.0, size.height / 100.0, size);
        const OffscreenPicture picture = draw(camera, size, {}, {});
        EXPECT_EQ(picture.colors.width, size.width);
        EXPECT_EQ(picture.colors.height, size.height);
        ASSERT_EQ(picture.colors.rgb.size(), static_cast<std::size_t>(3) *
                                                 static_cast<std::size_t>(size.width) *
                                                 static_cast<std::size_t>(size.height));
        const std::size_t middle =
            static_cast<std::size_t>(size.height / 2) * static_cast<std::size_t>(size.width) +
            static_cast<std::size_t>(size.width / 2);
        EXPECT_FALSE(isSky(picture.colors, middle));
    }
}

TEST_F(SpecialMaps, RefusesAPictureLargerThanTheDriverAllows)
{
    const DrawnMap map(floatTerrain(4, 4, [](auto...) { return 0.0; }), northUpFrame(4, 4, 30.0));
    renderer_->setLayers({map.layer()});
    const Viewport size{.width = 1 << 20, .height = 1};
    const auto picture = drawOffscreen(
        *renderer_, {.camera = homeCamera(map.box(1.0), size), .viewport = size, .detail = {}}, {},
        DepthUse::No);
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::OutOfRange);
}

// The upper map lies below the lower one, so it is visible only where the lower one is cut away.
TEST_F(SpecialMaps, TheUpperMapHidesTheLowerOneExceptAtItsVoids)
{
    constexpr double kUpper = 0.0;
    constexpr double kLower = 50.0;
    const DrawnMap lower(floatTerrain(400, 400, [](auto...) { return kLower; }),
                         northUpFrame(400, 400, 10.0));
    for (const auto& [columns, rows, hole] :
         {std::tuple<std::size_t, std::size_t, bool>{201, 161, false},
          {201, 161, true},
          {100, 100, true},
          {73, 90, true},
          {17, 17, true}}) {
        SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
        // Holes of whole blocks of samples, so that their sides are known exactly.
        const std::size_t first = columns < 20 ? 0 : 48;
        const std::size_t last = columns < 20 ? 7 : 63; // the last void sample
        const bool has_hole = hole;
        const auto isVoid = [&](std::size_t c, std::size_t r) {
            return has_hole && c >= first && c <= last && r >= first && r <= last;
        };
        const DrawnMap upper(floatTerrain(columns, rows,
                                          [&](std::size_t c, std::size_t r) {
                                              return isVoid(c, r) ? kNan : kUpper;
                                          }),
                             northUpFrame(columns, rows, 10.0));
        renderer_->setLayers({upper.layer(), lower.layer()});
        const Viewport size{.width = 600, .height = 600};
        const double pixels = columns < 20 ? 20.0 : 2.5;
        OrbitCamera camera = above(
            upper, {static_cast<double>(columns - 1) / 2.0, static_cast<double>(rows - 1) / 2.0},
            kUpper, pixels, size);
        const OffscreenPicture picture = draw(camera, size, {}, {});
        const double upper_depth = camera.distance_m;
        const double lower_depth = camera.distance_m - kLower;
        const auto isUpperThere = [&](const GridPoint& p) {
            const bool is_on_map = p.column >= 0.0 && p.row >= 0.0 &&
                                   p.column <= static_cast<double>(columns - 1) &&
                                   p.row <= static_cast<double>(rows - 1);
            const double from = first == 0 ? -1.0 : static_cast<double>(first) - 0.5;
            const double to = static_cast<double>(last) + 0.5;
            const bool is_in_hole =
                has_hole && p.column > from && p.column < to && p.row > from && p.row < to;
            return is_on_map && !is_in_hole;
        };
        std::size_t seen_upper = 0;
        std::size_t seen_lower = 0;
        for (std::size_t i = 0; i < picture.depths_m.size(); ++i) {
            // The lower map is cut where the upper one is straight below its terrain.
            const GridPoint on_lower = gridAt(upper, camera, size, i, kLower);
            const GridPoint on_upper = gridAt(upper, camera, size, i, kUpper);
            // Corners of holes are round: shares of blocks are interpolated between block centers.
            const auto isNearCorner = [&](const GridPoint& p) {
                const double from = static_cast<double>(first) - 0.5;
                const double to = static_cast<double>(last) + 0.5;
                return has_hole &&
                       std::min(std::abs(p.column - from), std::abs(p.column - to)) < 6.0 &&
                       std::min(std::abs(p.row - from), std::abs(p.row - to)) < 6.0;
            };
            constexpr double kMargin = 1.0; // samples
            if (!isSettled(isUpperThere, on_lower, kMargin) ||
                !isSettled(isUpperThere, on_upper, kMargin) || isNearCorner(on_lower) ||
                isNearCorner(on_upper)) {
                continue;
            }
            if (!isUpperThere(on_lower)) {
                ++seen_lower;
                ASSERT_NEAR(picture.depths_m[i], lower_depth, 1.0)
                    << on_lower.column << ", " << on_lower.row;
            } else if (isUpperThere(on_upper)) {
                ++seen_upper;
                ASSERT_NEAR(picture.depths_m[i], upper_depth, 1.0)
                    << on_upper.column << ", " << on_upper.row;
            }
        }
        EXPECT_GT(seen_upper, columns < 20 ? 0U : 10000U);
        EXPECT_GT(seen_lower, 10000U);
    }
}

TEST_F(SpecialMaps, EveryKindOfShadingIsDrawnWithAndWithoutContoursVoidsAndCovers)
{
    Random random;
    const auto heights = fractalHeights(random, 120, 100, 300.0, 0.5);
    const auto map = [&](bool has_voids, std::size_t columns, std::size_t rows) {
        return DrawnMap(floatTerrain(columns, rows,
                                     [&](std::size_t c, std::size_t r) {
                                         return has_voids && c > 100 && r > 80
                                                    ? kNan
                                                    : heights[r * 120 + c];
                                     }),
                        northUpFrame(columns, rows, 20.0));
    };
    const Viewport size{.width = 120, .height = 90};
    for (const bool has_voids : {false, true}) {
        const DrawnMap lowest = map(has_voids, 120, 100);
        const DrawnMap cover = map(false, 20, 20);
        for (std::size_t covers = 0; covers <= 5; ++covers) { // more than the shaders support
            std::vector<TerrainLayer> layers;
            for (std::size_t i = 0; i < covers; ++i) {
                TerrainLayer layer = cover.layer();
                layer.frame.origin.column += 25.0 * static_cast<double>(i) - 45.0;
                layers.push_back(layer);
            }
            layers.push_back(lowest.layer());
            renderer_->setLayers(layers);
            std::vector<Picture> pictures;
            for (const ShadingMode mode :
                 {ShadingMode::Tint, ShadingMode::Hillshade, ShadingMode::Slope}) {
                for (const bool has_contours : {false, true}) {
                    DrawStyle style;
                    style.look = {.mode = mode, .has_contours = has_contours};
                    const OrbitCamera camera = above(lowest, {50.0, 50.0}, 0.0, 2.0, size);
                    pictures.push_back(draw(camera, size, {}, style).colors);
                    // At the edge of a cover that lies deeper, the sky may show.
                    EXPECT_LT(skyPixels(pictures.back()), covers == 0 ? 1U : 2000U);
                }
            }
            for (std::size_t i = 0; i < pictures.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    EXPECT_NE(pictures[i].rgb, pictures[j].rgb) << i << " and " << j;
                }
            }
        }
    }
}

TEST_F(SpecialMaps, SeveralLayersAroundTheEyeAreDrawn)
{
    const auto cliffs = [](std::size_t c, std::size_t r) {
        return (c / 40 + r / 40) % 2 == 0 ? 0.0 : 900.0;
    };
    const DrawnMap map(floatTerrain(1100, 1100, cliffs), northUpFrame(1100, 1100, 10.0));
    std::vector<TerrainLayer> layers;
    for (int i = 0; i < 4; ++i) {
        TerrainLayer layer = map.layer();
        layer.frame.origin.column += i;
        layers.push_back(layer);
    }
    renderer_->setLayers(layers);
    const Viewport size{.width = 100, .height = 80};
    OrbitCamera camera;
    camera.target = map.frame.toScene({550.0, 550.0}, 300.0);
    camera.distance_m = 100.0;
    camera.tilt = Angle::degrees(80.0);
    const OffscreenPicture picture = draw(camera, size, {}, {});
    EXPECT_LT(skyPixels(picture.colors), picture.colors.rgb.size() / 3);
}

} // namespace
} // namespace marsview::test
