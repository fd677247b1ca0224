// Pictures with reduced detail, against the surface and the picture with full detail.

#include "app/bench/reference/color_error.h"
#include "app/bench/reference/picture_error.h"
#include "core/session/map.h"
#include "core/terrain/ray_cast.h"
#include "core/view/navigation.h"
#include "tests/render/render_fixture.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

// A map from a file.
struct LoadedTestMap {
    std::shared_ptr<const Map> map;

    explicit LoadedTestMap(const std::filesystem::path& path)
    {
        JobMonitor monitor;
        auto read = readMap(RasterSpec{path.string(), 1, {}}, monitor, std::size_t{1} << 30);
        map = std::move(read).value();
    }

    const Heightfield& field() const { return map->heightfield(); }
    SceneFrame frame() const { return map->georeference().sceneFrame(); }
    SceneBox box(double exaggeration) const
    {
        return sceneBox(frame(), field().columns(), field().rows(), field().range().value(),
                        exaggeration);
    }
    double ground(double east_m, double north_m, double exaggeration) const
    {
        return field().height(frame().toGrid({east_m, north_m, 0.0})) * exaggeration;
    }
};

// Views of a map: all of it, and then closer and closer to a place on it.
std::vector<OrbitCamera> views(const LoadedTestMap& map, double exaggeration, const Viewport& size)
{
    const SceneBox box = map.box(exaggeration);
    const OrbitCamera home = homeCamera(box, size);
    std::vector<OrbitCamera> cameras{home};
    const Georeference& georeference = map.map->georeference();
    const NavigationLimits limits = navigationLimits(
        box, std::min(georeference.pixelWidthMeters(), georeference.pixelHeightMeters()));
    const auto ground = [&](double east_m, double north_m) {
        return map.ground(east_m, north_m, exaggeration);
    };
    for (const double nearness : {0.3, 0.08, 0.02}) {
        for (const double tilt_deg : {0.0, 45.0, 78.0}) {
            OrbitCamera camera = home;
            camera.target.x = box.minimum.x + 0.43 * (box.maximum.x - box.minimum.x);
            camera.target.y = box.minimum.y + 0.58 * (box.maximum.y - box.minimum.y);
            camera.target.z = ground(camera.target.x, camera.target.y);
            camera.distance_m = nearness * home.distance_m;
            camera.tilt = Angle::degrees(tilt_deg);
            camera.azimuth = Angle::degrees(40.0);
            cameras.push_back(constrained(camera, limits, ground));
        }
    }
    return cameras;
}

// The largest difference of a pixel's channels, of 255, for each pixel.
std::vector<int> differences(const Picture& a, const Picture& b)
{
    std::vector<int> differences;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int largest = 0;
        for (std::size_t k = i; k < i + 3; ++k) {
            largest = std::max(largest, std::abs(a.rgb[k] - b.rgb[k]));
        }
        differences.push_back(largest);
    }
    return differences;
}

class PictureTest : public RenderTest {
protected:
    // At 1 pixel, almost all of the picture is within the threshold, and no pixel is far off.
    void expectWithinOnePixel(const std::string& name, const LoadedTestMap& map)
    {
        renderer_->setLayers(
            {terrainLayer(map.map, map.map->georeference().sceneFrame(), defaultColorRamp(""))});
        const Viewport size{.width = 640, .height = 400};
        const double suitable = suitableExaggeration(*map.map);
        for (const double exaggeration : {1.0, std::max(suitable, 3.0)}) {
            int view = 0;
            for (const OrbitCamera& camera : views(map, exaggeration, size)) {
                DrawStyle style;
                style.exaggeration = exaggeration;
                const OffscreenPicture picture = draw(camera, size, {.error_px = 1.0}, style);
                const SceneFrame frame = map.frame();
                const PictureError error = measurePictureError({map.field(), frame, exaggeration},
                                                               camera, size, picture.depths_m, 1.0);
                std::printf(
                    "%s ×%g view %d: %zu triangles, within %.4f, mean %.3f, "
                    "99%% %.3f, max %.2f px\n",
                    name.c_str(), exaggeration, view, picture.report.triangle_count,
                    error.share_within, error.mean_px, error.p99_px, error.max_px);
                EXPECT_GT(error.pixel_count, 1000U);
                EXPECT_GE(error.share_within, 0.99) << view;
                EXPECT_LE(error.max_px, 4.0) << view;
                ++view;
            }
        }
    }

    // Bounds in levels of 255 for 99 % of the channels of a picture, and for the average over its
    // views.
    struct ColorLimits {
        double view = 0.0;
        double average = 0.0;
    };
    struct ColorBounds {
        ColorLimits of_centers{.view = 3.0, .average = 2.0};
        ColorLimits of_means{.view = 4.0, .average = 2.5};
    };

    // Of the sharp picture against the color at the center of each pixel, and of the smooth one
    // that the window ends with against the mean over the pixel.
    struct ColorErrors {
        ColorError centers;
        ColorError means;
    };

    ColorErrors colorErrors(const LoadedTestMap& map,
                            const OrbitCamera& camera,
                            const Viewport& size,
                            DrawStyle style)
    {
        const ColorRamp& ramp = defaultColorRamp("");
        const SceneFrame frame = map.frame();
        const TintedScene scene{.drawn = {map.field(), frame, style.exaggeration},
                                .bounds = map.map->analysis()->bounds,
                                .ramp = ramp,
                                .range = tintedRange(ramp, map.map->tintRange())};
        DrawStyle hillshade = style;
        hillshade.look.mode = ShadingMode::Hillshade;
        const OffscreenPicture sharp = draw(camera, size, {}, style);
        const auto error_of = [&](int samples, const ColorSampling& sampling) {
            const Picture tint =
                samples == 1 ? sharp.colors : draw(camera, size, {}, style, samples).colors;
            const Picture light = draw(camera, size, {}, hillshade, samples).colors;
            return measureColorError(
                scene, camera, size,
                {.tint = tint.rgb, .light = light.rgb, .depths_m = sharp.depths_m}, sampling);
        };
        return {.centers = error_of(1, {ColorReference::Center, 3}),
                .means = error_of(4, {ColorReference::Mean, 8})};
    }

    // Each pixel has the color of the surface at full resolution, whatever the mesh: at
    // exaggeration 1 its cells are many pixels wide.
    void expectColorsOfTheSurface(const std::string& name,
                                  const LoadedTestMap& map,
                                  const ColorBounds& bounds)
    {
        renderer_->setLayers({terrainLayer(map.map, map.frame(), defaultColorRamp(""))});
        for (const double exaggeration : {0.5, 1.0, 2.0, 10.0}) {
            // The whole map, and from the side, obliquely and from above, closer and closer. Where
            // a sample is as wide as many pixels, a smaller picture shows the same.
            constexpr Viewport kWindow{.width = 1280, .height = 800};
            constexpr Viewport kSmall{.width = 640, .height = 400};
            constexpr std::array<std::size_t, 4> kViews{0, 3, 5, 7};
            constexpr std::size_t kNearest = 7;
            const auto cameras = views(map, exaggeration, kWindow);
            double centers_sum = 0.0;
            double means_sum = 0.0;
            for (const std::size_t view : kViews) {
                DrawStyle style;
                style.exaggeration = exaggeration;
                const auto [centers, means] =
                    colorErrors(map, cameras.at(view), view == kNearest ? kSmall : kWindow, style);
                std::printf(
                    "%s ×%g view %zu: 99%% of colors within %.1f of 255 of centers, %.1f "
                    "of means; of centers %.1f of means\n",
                    name.c_str(), exaggeration, view, centers.p99_levels, means.p99_levels,
                    means.center_p99_levels);
                EXPECT_GT(means.pixel_count, 500U);
                EXPECT_LE(centers.p99_levels, bounds.of_centers.view) << view;
                EXPECT_LE(means.p99_levels, bounds.of_means.view) << view;
                centers_sum += centers.p99_levels / static_cast<double>(kViews.size());
                means_sum += means.p99_levels / static_cast<double>(kViews.size());
            }
            EXPECT_LE(centers_sum, bounds.of_centers.average) << exaggeration;
            EXPECT_LE(means_sum, bounds.of_means.average) << exaggeration;
        }
    }

    // Contour lines are where the elevation at full resolution crosses a multiple of the interval.
    void expectContoursOfTheSurface(const LoadedTestMap& map, double exaggeration)
    {
        renderer_->setLayers({terrainLayer(map.map, map.frame(), defaultColorRamp(""))});
        const Viewport size{.width = 640, .height = 400};
        const auto width = static_cast<std::size_t>(size.width);
        const auto height = static_cast<std::size_t>(size.height);
        for (const OrbitCamera& camera : views(map, exaggeration, size)) {
            if (camera.tilt.degrees() > 60.0) {
                continue; // lines run together toward the horizon
            }
            DrawStyle style;
            style.exaggeration = exaggeration;
            style.look.mode = ShadingMode::Hillshade;
            const Picture plain = draw(camera, size, {}, style).colors;
            style.look.has_contours = true;
            const Picture lined = draw(camera, size, {}, style).colors;
            const double interval_m = contourInterval(style.look, map.field().range().value(),
                                                      metersPerPixel(camera, size), exaggeration);
            std::vector<int> step(width * height); // the interval of each pixel; kNone without one
            constexpr int kNone = std::numeric_limits<int>::min();
            const SceneFrame frame = map.frame();
            for (std::size_t i = 0; i < step.size(); ++i) {
                const Ray ray = pickRay(
                    camera, size,
                    {static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5});
                const auto hit = castRay(map.field(), map.map->analysis()->bounds,
                                         gridRay(ray.origin, ray.direction, frame, exaggeration));
                step[i] = hit ? static_cast<int>(std::floor(hit->height_m / interval_m)) : kNone;
            }
            // The number of different intervals around a pixel.
            const auto differs = [&](std::size_t x, std::size_t y, std::size_t reach) {
                for (std::size_t v = y - reach; v <= y + reach; ++v) {
                    for (std::size_t u = x - reach; u <= x + reach; ++u) {
                        if (step[v * width + u] != step[y * width + x]) {
                            return true;
                        }
                    }
                }
                return false;
            };
            std::size_t lines = 0;
            std::size_t misplaced = 0;
            std::size_t crossings = 0;
            std::size_t missing = 0;
            for (std::size_t y = 3; y < height - 3; ++y) {
                for (std::size_t x = 3; x < width - 3; ++x) {
                    const std::size_t i = y * width + x;
                    if (step[i] == kNone || plain.rgb[3 * i] < 30) {
                        continue;
                    }
                    const double ink =
                        1.0 - lined.rgb[3 * i] / static_cast<double>(plain.rgb[3 * i]);
                    if (ink > 0.4) {
                        ++lines;
                        misplaced += differs(x, y, 2) ? 0U : 1U;
                    }
                    const bool is_crossing = step[i + 1] != step[i];
                    if (is_crossing && step[i + 1] != kNone) {
                        ++crossings;
                        bool is_inked = false;
                        for (const std::size_t near : {i - 1, i, i + 1, i + 2}) {
                            is_inked = is_inked || plain.rgb[3 * near] > lined.rgb[3 * near] + 4;
                        }
                        missing += is_inked ? 0U : 1U;
                    }
                }
            }
            std::printf("%zu pixels of lines, %zu misplaced; %zu crossings, %zu without a line\n",
                        lines, misplaced, crossings, missing);
            EXPECT_GT(crossings, 300U);
            EXPECT_LT(static_cast<double>(misplaced), 0.05 * static_cast<double>(lines));
            EXPECT_LT(static_cast<double>(missing), 0.03 * static_cast<double>(crossings));
        }
    }

    // Pictures with selected detail look like those with every sample. Without multisampling,
    // silhouettes that are off by a fraction of a pixel differ: up to 2.1 % for the whole of Mars.
    void expectSameColors(const std::string& name, const LoadedTestMap& map)
    {
        renderer_->setLayers(
            {terrainLayer(map.map, map.map->georeference().sceneFrame(), defaultColorRamp(""))});
        const Viewport size{.width = 640, .height = 400};
        DrawStyle style;
        style.exaggeration = suitableExaggeration(*map.map);
        int view = 0;
        for (const OrbitCamera& camera : views(map, style.exaggeration, size)) {
            const Picture lod = draw(camera, size, {.error_px = 1.0}, style).colors;
            const Picture full = draw(camera, size, {.has_every_sample = true}, style).colors;
            std::size_t different = 0;
            double sum = 0.0;
            for (const int difference : differences(lod, full)) {
                sum += difference;
                different += difference > 16 ? 1U : 0U;
            }
            const double pixels = static_cast<double>(lod.rgb.size()) / 3.0;
            std::printf("%s view %d: mean difference %.3f of 255, %.3f %% of pixels above 16\n",
                        name.c_str(), view, sum / pixels,
                        100.0 * static_cast<double>(different) / pixels);
            EXPECT_LT(sum / pixels, 2.0) << view;
            EXPECT_LT(static_cast<double>(different) / pixels, 0.03) << view;
            ++view;
        }
    }
};

TEST_F(PictureTest, OfMarsIsWithinOnePixel)
{
    expectWithinOnePixel("Mars", LoadedTestMap(bundledSamples() / "mars_mola_4ppd.tif"));
}

TEST_F(PictureTest, OfMountStHelensIsWithinOnePixel)
{
    expectWithinOnePixel("Helens", LoadedTestMap(bundledSamples() / "mount_st_helens_30m.tif"));
}

TEST_F(PictureTest, OfTheMoonIsWithinOnePixel)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    expectWithinOnePixel(
        "Moon", LoadedTestMap(sharedData() / "derived/moon_gld100_64ppd_crop_8192x4096.tif"));
}

TEST_F(PictureTest, OfMarsHasTheColorsOfTheSurfaceAtEveryExaggeration)
{
    expectColorsOfTheSurface("Mars", LoadedTestMap(bundledSamples() / "mars_mola_4ppd.tif"), {});
}

TEST_F(PictureTest, OfMountStHelensHasTheColorsOfTheSurfaceAtEveryExaggeration)
{
    expectColorsOfTheSurface("Helens", LoadedTestMap(bundledSamples() / "mount_st_helens_30m.tif"),
                             {});
}

TEST_F(PictureTest, OfTheMoonAndTheEarthHasTheColorsOfTheSurfaceAtEveryExaggeration)
{
    MARSVIEW_NEEDS_SHARED_DATA();
    expectColorsOfTheSurface("SRTM", LoadedTestMap(sharedData() / "srtm/N44W072.hgt"), {});
    // From far away a pixel covers dozens of samples of rough terrain. The elevation at its center
    // is one of them: the surface's own colors at centers are up to 12 levels from their means. At
    // 78° of tilt the area of a pixel is five times as long as wide, and texels are between the
    // two; at ×10 it shows slopes on which the ramp runs through much of its colors.
    expectColorsOfTheSurface(
        "Moon", LoadedTestMap(sharedData() / "derived/moon_gld100_64ppd_crop_8192x4096.tif"),
        {.of_centers = {.view = 10.0, .average = 5.0}, .of_means = {.view = 10.5, .average = 4.5}});
}

TEST_F(PictureTest, HasContoursWhereTheSurfaceCrossesTheirElevation)
{
    const LoadedTestMap mars(bundledSamples() / "mars_mola_4ppd.tif");
    expectContoursOfTheSurface(mars, 1.0);
    expectContoursOfTheSurface(mars, 10.0);
}

TEST_F(PictureTest, HasTheColorsOfThePictureWithEverySample)
{
    expectSameColors("Mars", LoadedTestMap(bundledSamples() / "mars_mola_4ppd.tif"));
    expectSameColors("Helens", LoadedTestMap(bundledSamples() / "mount_st_helens_30m.tif"));
}

// The relief bends within a sample's cell, triangles do not: ×10 shows that (p99 was 12 of 255),
// and so do contour lines (16) where the mesh has fewer samples.
TEST_F(PictureTest, HasTheColorsOfTheTrianglesWhereSamplesAreLarge)
{
    Random random(31);
    const auto heights = fractalHeights(random, 257, 257, 600.0, 0.8);
    const DrawnMap map(
        floatTerrain(
            257, 257,
            [&](std::size_t column, std::size_t row) { return heights[row * 257 + column]; }),
        SceneFrame{.origin = {128.0, 128.0}, .east_per_column = 500.0, .north_per_row = -500.0});
    renderer_->setLayers({map.layer()});
    const Viewport size{.width = 640, .height = 400};
    const auto expect_same = [&](const DrawStyle& style, double distance_m) {
        const OrbitCamera camera{.target = {0.0, 0.0, map.ground(0.0, 0.0, style.exaggeration)},
                                 .distance_m = distance_m,
                                 .azimuth = Angle::degrees(20.0),
                                 .tilt = Angle::degrees(50.0)};
        const Picture lod = draw(camera, size, {}, style).colors;
        const Picture full = draw(camera, size, {.has_every_sample = true}, style).colors;
        std::vector<int> all = differences(lod, full);
        const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
        std::nth_element(all.begin(), p99, all.end());
        EXPECT_LE(*p99, 4) << distance_m << " m, exaggeration " << style.exaggeration
                           << (style.look.has_contours ? ", contours" : "");
    };
    DrawStyle style;
    style.exaggeration = 10.0;
    expect_same(style, 25000.0);
    expect_same(style, 40000.0);
    style.look.has_contours = true;
    for (const double exaggeration : {0.25, 0.5, 1.0}) {
        style.exaggeration = exaggeration;
        expect_same(style, 25000.0);
    }
}

// A ray that starts above the terrain, or enters above its highest point, and passes below its
// lowest point over the map has crossed the surface on the way, at every level of detail.
bool crossesGround(const Ray& ray, const DrawnMap& map, double exaggeration)
{
    const HeightRange range = map.field->range().value();
    const auto isOverMap = [&](double height_m) {
        const double t = (height_m - ray.origin.z) / ray.direction.z;
        const GridPoint grid = map.frame.toGrid(ray.at(std::max(t, 0.0)));
        constexpr double kMargin = 0.01; // samples, for rounding
        return grid.column > kMargin && grid.row > kMargin &&
               grid.column < static_cast<double>(map.field->columns() - 1) - kMargin &&
               grid.row < static_cast<double>(map.field->rows() - 1) - kMargin;
    };
    return ray.direction.z < 0.0 && isOverMap(range.maximum_m * exaggeration) &&
           isOverMap(range.minimum_m * exaggeration);
}

TEST_F(PictureTest, HasNoCracks)
{
    Random random;
    const auto fractal = heightsFrom(fractalHeights(random, 1100, 1000, 2500.0, 0.52), 1100);
    std::vector<DrawnMap> maps;
    maps.emplace_back(floatTerrain(1100, 1000, fractal), northUpFrame(1100, 1000, 30.0));
    maps.emplace_back(
        floatTerrain(1025, 900,
                     [](std::size_t c, std::size_t r) { return c < 600 && r > 77 ? 0.0 : 4000.0; }),
        northUpFrame(1025, 900, 30.0));
    maps.emplace_back(int16Terrain(1100, 1000, {},
                                   [&](std::size_t c, std::size_t r) {
                                       return c + 2 * r > 1500 ? 0.0 : fractal(c, r);
                                   }),
                      SceneFrame{.origin = {550.0, 500.0},
                                 .east_per_column = 24.0,
                                 .east_per_row = -15.0,
                                 .north_per_column = 18.0,
                                 .north_per_row = 22.0});
    std::size_t looked_at = 0;
    for (const DrawnMap& map : maps) {
        renderer_->setLayers({map.layer()});
        for (int i = 0; i < 40; ++i) {
            constexpr std::array<double, 5> kExaggerations{0.1, 1.0, 2.0, 5.0, 30.0};
            constexpr std::array<double, 3> kErrors{1.0, 2.0, 8.0};
            DrawStyle style;
            style.exaggeration = kExaggerations.at(random.below(kExaggerations.size()));
            style.look.mode = ShadingMode::Hillshade;
            const SceneBox box = map.box(style.exaggeration);
            OrbitCamera camera;
            camera.target = {random.uniform(box.minimum.x, box.maximum.x),
                             random.uniform(box.minimum.y, box.maximum.y), 0.0};
            const double ground = map.ground(camera.target.x, camera.target.y, style.exaggeration);
            camera.target.z = std::isnan(ground) ? 0.0 : ground;
            camera.distance_m = box.extent_m() * std::pow(10.0, random.uniform(-2.0, 0.2));
            camera.tilt = Angle::degrees(i % 4 == 0 ? 0.0 : random.uniform(0.0, 80.0));
            camera.azimuth = Angle::degrees(random.uniform(0.0, 360.0));
            const ScenePoint eye = eyeOf(camera);
            const double below = map.ground(eye.x, eye.y, style.exaggeration);
            if (eye.z < box.maximum.z &&
                !(eye.z > below + 0.3 * camera.distance_m && camera.distance_m > 300.0)) {
                continue; // inside the mountains
            }
            const Viewport size{.width = 300, .height = 220};
            const double error_px = kErrors.at(random.below(kErrors.size()));
            const OffscreenPicture picture = draw(camera, size, {.error_px = error_px}, style);
            std::size_t cracks = 0;
            for (std::size_t p = 0; p < picture.colors.rgb.size() / 3; ++p) {
                const PixelPoint pixel{static_cast<double>(p % 300) + 0.5,
                                       static_cast<double>(p / 300) + 0.5};
                if (crossesGround(pickRay(camera, size, pixel), map, style.exaggeration)) {
                    ++looked_at;
                    cracks += isSky(picture.colors, p) ? 1U : 0U;
                }
            }
            EXPECT_EQ(cracks, 0U) << "shot " << i << ", error " << error_px << " px, exaggeration "
                                  << style.exaggeration << ", tilt " << camera.tilt.degrees();
        }
    }
    EXPECT_GT(looked_at, 1000000U);
    std::printf("%zu pixels without a crack\n", looked_at);
}

} // namespace
} // namespace marsview::test
