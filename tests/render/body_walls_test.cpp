// The edge of a map over another one on the body is a step, which is drawn closed.

#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "tests/render/render_fixture.h"
#include "tests/support/grid_tile_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kRadius = 3396190.0;
constexpr Viewport kViewport{480, 360};

// A map of a sphere.
struct StepMap {
    Georeference georeference;
    DrawnMap drawn;
    std::shared_ptr<const BodyGrid> grid;

    StepMap(const std::string& crs,
            std::size_t columns,
            std::size_t rows,
            const GeoTransform::Terms& terms,
            const std::function<double(std::size_t, std::size_t)>& height_m)
        : georeference(columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs))
        , drawn(floatTerrain(columns, rows, height_m), georeference.sceneFrame())
    {
        JobMonitor monitor;
        grid = BodyGrid::make(georeference, monitor).value();
    }
    TerrainLayer layer() const
    {
        TerrainLayer made = drawn.layer();
        made.body = grid;
        return made;
    }
    // NaN where the map has no surface.
    double height(const GeographicPoint& place) const
    {
        auto at = georeference.toGrid(place);
        if (at && grid->closes()) {
            const auto turn = static_cast<double>(grid->columns() - 1);
            at->column -= turn * std::floor(at->column / turn);
            at->row = std::clamp(at->row, 0.0, static_cast<double>(georeference.rows() - 1));
            at->column = std::min(at->column, static_cast<double>(georeference.columns() - 1));
        }
        return at ? drawn.field->height(*at) : kNaN;
    }
};

struct Position {
    double distance_m;
    double tilt_deg;
};
const std::vector<Position> kPositions{{1e4, 0.0}, {1e4, 60.0}, {3e4, 75.0}, {1e5, 80.0}};

class BodyWalls : public RenderTest {
protected:
    OffscreenPicture drawFrom(const std::vector<TerrainLayer>& layers,
                              const BodyCamera& camera,
                              double exaggeration = 1.0,
                              const DetailTarget& detail = {})
    {
        renderer_->setLayers(layers);
        DrawStyle style;
        style.exaggeration = exaggeration;
        style.sky_top = kSkyColor;
        style.sky_bottom = kSkyColor;
        DrawRequest request{.viewport = kViewport, .detail = detail};
        request.body_pose = poseOf(camera, layers.back().body->ellipsoid());
        OffscreenPicture picture = drawOffscreen(*renderer_, request, style, DepthUse::Yes).value();
        EXPECT_TRUE(picture.report.is_complete);
        return picture;
    }

    // Pixels without terrain whose ray meets the ball below all terrain.
    static std::size_t open(const Picture& picture, const BodyCamera& camera, double lowest_m)
    {
        const CameraPose pose = poseOf(camera, Ellipsoid{kRadius, kRadius});
        std::size_t count = 0;
        for (int y = 0; y < kViewport.height; ++y) {
            for (int x = 0; x < kViewport.width; ++x) {
                const Ray ray = pickRay(pose, kViewport, {x + 0.5, y + 0.5});
                const double middle = -dot(ray.origin, ray.direction);
                const Vec3 nearest = ray.at(middle);
                const auto pixel = static_cast<std::size_t>(y * kViewport.width + x);
                count +=
                    middle > 0.0 && length(nearest) < kRadius + lowest_m && isSky(picture, pixel)
                        ? 1U
                        : 0U;
            }
        }
        return count;
    }
};

BodyCamera over(const Position& from)
{
    return {.target = {.longitude = Angle::degrees(77.4), .latitude = Angle::degrees(18.5)},
            .height_m = 0.0,
            .distance_m = from.distance_m,
            .azimuth = Angle::degrees(30.0),
            .tilt = Angle::degrees(from.tilt_deg)};
}

StepMap globe(const std::function<double(std::size_t, std::size_t)>& height_m)
{
    return {"+proj=longlat +R=3396190", 1440, 720, {-180, 0.25, 0, 90, 0, -0.25}, height_m};
}

double level(std::size_t, std::size_t)
{
    return 0.0;
}

bool isInCrater(std::size_t column, std::size_t row)
{
    return std::hypot(static_cast<double>(column) - 60.0, static_cast<double>(row) - 45.0) < 8.0;
}

TEST_F(BodyWalls, NoPixelIsSeenThroughTheStepAtAnEdge)
{
    const StepMap lower = globe(level);
    for (const auto& [step_m, projection] :
         {std::pair(200.0, "tmerc"), {-200.0, "stere"}, {2000.0, "stere"}, {-2000.0, "tmerc"}}) {
        const StepMap upper(
            fmt::format("+proj={} +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", projection), 121,
            101, {-12000, 200, 0, 10000, 0, -200}, [step = step_m](std::size_t c, std::size_t r) {
                return isInCrater(c, r) ? kNaN : step;
            });
        for (const Position& from : kPositions) {
            const OffscreenPicture picture = drawFrom({upper.layer(), lower.layer()}, over(from));
            EXPECT_EQ(open(picture.colors, over(from), std::min(step_m, 0.0) - 200.0), 0U)
                << projection << " at " << step_m << " m from " << from.distance_m << " m, "
                << from.tilt_deg << "°";
        }
    }
}

// With several samples a pixel, and hardly a step, as edges are that are blended. Light alone gives
// shades of gray.
TEST_F(BodyWalls, NoSampleOfAPixelIsSeenThroughAnEdgeWithoutAStep)
{
    const StepMap lower = globe(level);
    for (const double step_m : {0.0, 3.0, -3.0}) {
        const StepMap upper("+proj=stere +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 201, 161,
                            {-300000, 3000, 0, 240000, 0, -3000},
                            [step_m](std::size_t, std::size_t) { return step_m; });
        renderer_->setLayers({upper.layer(), lower.layer()});
        DrawStyle style;
        style.exaggeration = 1.0;
        style.look.mode = ShadingMode::Hillshade;
        style.sky_top = kSkyColor;
        style.sky_bottom = kSkyColor;
        for (const Position& from :
             {Position{1.2e6, 20.0}, {1.1e6, 50.0}, {7e5, 60.0}, {9e5, 35.0}}) {
            const BodyCamera camera = over(from);
            DrawRequest request{.viewport = kViewport, .samples = 4};
            request.body_pose = poseOf(camera, lower.layer().body->ellipsoid());
            const OffscreenPicture picture =
                drawOffscreen(*renderer_, request, style, DepthUse::No).value();
            std::size_t seen_through = 0;
            for (int y = 0; y < kViewport.height; ++y) {
                for (int x = 0; x < kViewport.width; ++x) {
                    const Ray ray = pickRay(*request.body_pose, kViewport, {x + 0.5, y + 0.5});
                    const Vec3 nearest = ray.at(-dot(ray.origin, ray.direction));
                    const auto* rgb = picture.colors.rgb.data() +
                                      3 * static_cast<std::size_t>(y * kViewport.width + x);
                    const bool is_tinted = std::min(rgb[0], rgb[2]) > rgb[1] + 16;
                    seen_through += length(nearest) < 0.98 * kRadius && is_tinted ? 1U : 0U;
                }
            }
            EXPECT_EQ(seen_through, 0U)
                << step_m << " m from " << from.distance_m << " m, " << from.tilt_deg << "°";
        }
    }
}

// The map is smaller than a cell of the lower one, and near the eye its walls reach into pictures
// in which none of their rims is.
TEST_F(BodyWalls, NoPixelIsSeenThroughAroundAMapInACell)
{
    const StepMap lower = globe(level);
    for (const auto& [step_m, from] : {std::pair{20.0, Position{500.0, 0.0}},
                                       {-20.0, {2000.0, 75.0}},
                                       {200.0, {500.0, 0.0}},
                                       {-200.0, {500.0, 60.0}}}) {
        const StepMap upper("+proj=tmerc +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 500, 400,
                            {-1250, 5, 0, 1000, 0, -5},
                            [step = step_m](std::size_t c, std::size_t r) {
                                return isInCrater(c / 4, r / 4) ? kNaN : step;
                            });
        const OffscreenPicture picture = drawFrom({upper.layer(), lower.layer()}, over(from));
        EXPECT_EQ(open(picture.colors, over(from), -500.0), 0U)
            << step_m << " m from " << from.distance_m << " m, " << from.tilt_deg << "°";
    }
}

// With relief, at every level of detail.
TEST_F(BodyWalls, NoPixelIsSeenThroughBetweenMountains)
{
    Random random(5);
    const auto wide = fractalHeights(random, 1440, 720, 3000.0, 0.5);
    const StepMap lower = globe([&](std::size_t c, std::size_t r) { return wide[r * 1440 + c]; });
    const auto local = fractalHeights(random, 500, 400, 400.0, 0.6);
    const StepMap upper("+proj=tmerc +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 500, 400,
                        {-12500, 50, 0, 10000, 0, -50}, [&](std::size_t c, std::size_t r) {
                            return isInCrater(c / 4, r / 4) ? kNaN : local[r * 500 + c];
                        });
    for (const auto& [exaggeration, error_px] : {std::pair{1.0, 1.0}, {4.0, 5.0}}) {
        for (const Position& from : kPositions) {
            BodyCamera camera = over(from);
            camera.height_m = exaggeration * 500.0;
            const OffscreenPicture picture =
                drawFrom({upper.layer(), lower.layer()}, camera, exaggeration,
                         {.error_px = error_px, .texel_px = error_px > 1.0 ? 2.0 : 1.0});
            EXPECT_EQ(open(picture.colors, camera, exaggeration * -3500.0), 0U)
                << "from " << from.distance_m << " m, " << from.tilt_deg << "°, × " << exaggeration
                << ", " << error_px << " px";
        }
    }
}

// Tiles come while the picture is drawn.
TEST_F(BodyWalls, NoPixelIsSeenThroughAroundAMapInTiles)
{
    const StepMap lower = globe(level);
    for (const double step_m : {2000.0, -2000.0}) {
        const StepMap upper("+proj=tmerc +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 500, 400,
                            {-12500, 50, 0, 10000, 0, -50}, [&](std::size_t c, std::size_t r) {
                                return isInCrater(c / 4, r / 4) ? kNaN : step_m;
                            });
        const TileCache cache({.bytes_max = std::size_t{1} << 26});
        const auto tiles = TiledSamples::open(
            TiledRaster(cache, std::make_shared<GridTileSource>(
                                   *upper.drawn.field, GridTileSource::Options{.mean_levels = 2})));
        const SampleStatistics statistics{
            .raw_minimum = step_m, .raw_maximum = step_m, .void_count = 1, .sample_count = 200000};
        TerrainLayer layer = upper.layer();
        layer.heightfield = std::make_shared<const Heightfield>(tiles.value(), statistics,
                                                                upper.drawn.field->scale());
        const OffscreenPicture picture = drawFrom({layer, lower.layer()}, over(kPositions[1]));
        EXPECT_EQ(open(picture.colors, over(kPositions[1]), std::min(step_m, 0.0) - 200.0), 0U)
            << step_m << " m";
    }
}

// With more samples along a side than the texture has that cuts the lower map.
TEST_F(BodyWalls, NoPixelIsSeenThroughAroundAHoleInALongMap)
{
    const StepMap lower = globe(level);
    for (const double step_m : {2000.0, -2000.0}) {
        const StepMap upper("+proj=tmerc +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 4200, 200,
                            {-105000, 50, 0, 5000, 0, -50}, [&](std::size_t c, std::size_t r) {
                                return std::hypot(static_cast<double>(c) - 2100.0,
                                                  static_cast<double>(r) - 100.0) < 40.0
                                           ? kNaN
                                           : step_m;
                            });
        const OffscreenPicture picture =
            drawFrom({upper.layer(), lower.layer()}, over(kPositions[2]));
        EXPECT_EQ(open(picture.colors, over(kPositions[2]), std::min(step_m, 0.0) - 200.0), 0U)
            << step_m << " m";
    }
}

// The last cells of its nodes are shorter than others, and morph all the same.
TEST_F(BodyWalls, NoPixelIsSeenThroughWhereAMapEndsWithinANode)
{
    const StepMap lower = globe(level);
    const StepMap upper("+proj=tmerc +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 200, 120,
                        {-5000, 50, 0, 3000, 0, -50},
                        [](std::size_t, std::size_t) { return 2000.0; });
    BodyCamera camera = over(kPositions[1]);
    camera.azimuth = Angle::degrees(60.0);
    const OffscreenPicture picture = drawFrom({upper.layer(), lower.layer()}, camera);
    EXPECT_EQ(open(picture.colors, camera, -200.0), 0U);
}

// Voids up to three samples wide.
struct Strips {
    struct Strip {
        double column;
        double row;
        double angle;
        double half_width;
    };
    std::vector<Strip> all;

    Strips(Random& random, std::size_t columns, std::size_t rows)
    {
        const std::size_t count = 1 + random.below(12);
        constexpr std::array<double, 4> kAngles{0.0, 0.5, 0.25, 0.75}; // along the grid's lines
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t angle = random.below(6);
            all.push_back({.column = std::floor(random.uniform(0.0, static_cast<double>(columns))),
                           .row = std::floor(random.uniform(0.0, static_cast<double>(rows))),
                           .angle = std::numbers::pi * (angle < 4 ? kAngles[angle] : random.unit()),
                           .half_width = 0.5 * static_cast<double>(random.below(4)) + 0.3});
        }
    }
    bool has(std::size_t column, std::size_t row) const
    {
        return std::any_of(all.begin(), all.end(), [&](const Strip& strip) {
            const double across =
                (static_cast<double>(column) - strip.column) * std::sin(strip.angle) -
                (static_cast<double>(row) - strip.row) * std::cos(strip.angle);
            return std::abs(across) < strip.half_width;
        });
    }
};

// Texels and cells of the pictures may be larger than the voids, which none of their corners meets.
TEST_F(BodyWalls, NoPixelIsSeenThroughAtNarrowVoids)
{
    Random random(20240229);
    const auto wide = fractalHeights(random, 1440, 720, 3000.0, 0.5);
    const std::vector<StepMap> lower{
        globe(level), globe([&](std::size_t c, std::size_t r) { return wide[r * 1440 + c]; })};
    std::size_t picture_count = 0;
    for (int map = 0; map < 10; ++map) {
        const std::size_t columns = 100 + random.below(600);
        const std::size_t rows = 100 + random.below(500);
        const double cell_m = std::pow(10.0, random.uniform(1.0, 2.3));
        const double relief_m = map % 2 == 0 ? 0.0 : random.uniform(0.0, 600.0);
        const double step_m =
            (random.chance(0.5) ? 1.0 : -1.0) * std::pow(10.0, random.uniform(1.5, 3.3));
        const auto local = fractalHeights(random, columns, rows, relief_m, 0.6);
        const Strips strips(random, columns, rows);
        const double width_m = cell_m * static_cast<double>(columns - 1);
        const double height_m = cell_m * static_cast<double>(rows - 1);
        const StepMap upper(fmt::format("+proj={} +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m",
                                        random.chance(0.5) ? "tmerc" : "stere"),
                            columns, rows, {-0.5 * width_m, cell_m, 0, 0.5 * height_m, 0, -cell_m},
                            [&](std::size_t c, std::size_t r) {
                                return strips.has(c, r) ? kNaN : step_m + local[r * columns + c];
                            });
        const StepMap& under = lower[random.below(2)];
        const HeightRange own = upper.drawn.field->range().value();
        const HeightRange other = under.drawn.field->range().value();
        for (int i = 0; i < 8; ++i) {
            constexpr std::array<double, 4> kExaggerations{0.5, 1.0, 3.0, 10.0};
            constexpr std::array<double, 3> kErrors{1.0, 2.0, 8.0};
            const double exaggeration = kExaggerations.at(random.below(4));
            const DetailTarget detail{.error_px = kErrors.at(random.below(3)),
                                      .texel_px = random.chance(0.5) ? 1.0 : 2.0};
            const auto target = upper.georeference.toGeographic(
                GridPoint{random.uniform(0.0, static_cast<double>(columns - 1)),
                          random.uniform(0.0, static_cast<double>(rows - 1))});
            const BodyCamera camera{
                .target = *target,
                .height_m = exaggeration * std::max(step_m, 0.0),
                .distance_m = width_m * std::pow(10.0, random.uniform(-1.0, 0.5)),
                .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
                .tilt = Angle::degrees(random.chance(0.2) ? 0.0 : random.uniform(0.0, 80.0))};
            const CameraPose pose = poseOf(camera, Ellipsoid{kRadius, kRadius});
            if (length(pose.eye) - kRadius <
                exaggeration * std::max(own.maximum_m, other.maximum_m) + 0.1 * cell_m) {
                continue;
            }
            ++picture_count;
            const double pixel_m = camera.distance_m / kViewport.height;
            const double lowest_m = exaggeration * std::min(own.minimum_m, other.minimum_m) -
                                    300.0 - 4.0 * detail.error_px * pixel_m;
            const OffscreenPicture picture =
                drawFrom({upper.layer(), under.layer()}, camera, exaggeration, detail);
            EXPECT_EQ(open(picture.colors, camera, lowest_m), 0U)
                << "map " << map << " from " << camera.distance_m << " m, " << camera.tilt.degrees()
                << "°, × " << exaggeration << ", " << detail.error_px << " px, texels of "
                << detail.texel_px << " px";
        }
    }
    EXPECT_GT(picture_count, 60U);
}

// The first pictures of a map may have any error, and walls as long as that would reach through the
// body.
TEST_F(BodyWalls, NeverReachThroughTheBody)
{
    Random random(9);
    const auto wide = fractalHeights(random, 1440, 720, 20000.0, 0.5);
    const StepMap lower = globe([&](std::size_t c, std::size_t r) { return wide[r * 1440 + c]; });
    for (const double longitude : {-15.0, 0.0, 155.0, 170.0}) {
        const StepMap upper(
            fmt::format("+proj=stere +lat_0=18.5 +lon_0={} +R=3396190 +units=m", longitude), 121,
            101, {-600000, 10000, 0, 500000, 0, -10000},
            [](std::size_t c, std::size_t r) { return isInCrater(c, r) ? kNaN : 2000.0; });
        for (const double exaggeration : {1.0, 7.0, 20.0}) {
            const BodyCamera camera = over({5.6e6, 0.0});
            const DetailTarget coarse{.error_px = 128.0, .texel_px = 4.0};
            const OffscreenPicture alone = drawFrom({lower.layer()}, camera, exaggeration, coarse);
            const OffscreenPicture both =
                drawFrom({upper.layer(), lower.layer()}, camera, exaggeration, coarse);
            const auto highest_m = exaggeration * 25000.0;
            const CameraPose pose = poseOf(camera, Ellipsoid{kRadius, kRadius});
            std::size_t sky_count = 0;
            std::size_t covered_count = 0;
            for (int y = 0; y < kViewport.height; ++y) {
                for (int x = 0; x < kViewport.width; ++x) {
                    const Ray ray = pickRay(pose, kViewport, {x + 0.5, y + 0.5});
                    const Vec3 nearest = ray.at(-dot(ray.origin, ray.direction));
                    if (length(nearest) < kRadius + highest_m) {
                        continue;
                    }
                    const auto pixel = static_cast<std::size_t>(y * kViewport.width + x);
                    ++sky_count;
                    covered_count += isSky(both.colors, pixel) ? 0U : 1U;
                    EXPECT_TRUE(isSky(alone.colors, pixel));
                }
            }
            EXPECT_GT(sky_count, 10000U);
            EXPECT_EQ(covered_count, 0U) << longitude << "° E, × " << exaggeration;
        }
    }
}

// Rays are followed in small steps to where they are below the uppermost map with data.
TEST_F(BodyWalls, StandWhereTheUpperMapEnds)
{
    const StepMap lower = globe(level);
    for (const double step_m : {2000.0, -2000.0}) {
        const StepMap upper("+proj=stere +lat_0=18.5 +lon_0=77.4 +R=3396190 +units=m", 121, 101,
                            {-12000, 200, 0, 10000, 0, -200}, [&](std::size_t c, std::size_t r) {
                                return isInCrater(c, r) ? kNaN : step_m;
                            });
        const BodyCamera camera = over({1.5e4, 60.0});
        const OffscreenPicture picture = drawFrom({upper.layer(), lower.layer()}, camera);
        const CameraPose pose = poseOf(camera, {kRadius, kRadius});
        const auto clearance = [&](const Ray& ray, double t) {
            const BodyPlace place = placeOf(ray.at(t), {kRadius, kRadius});
            const double above = upper.height(place.foot);
            return place.height_m - (std::isnan(above) ? 0.0 : above);
        };
        const auto depth_of = [&](int x, int y) {
            const Ray ray = pickRay(pose, kViewport, {x + 0.5, y + 0.5});
            const double along = dot(ray.direction, pose.axes.forward);
            for (double t = 5000.0; t < 60000.0; t += 100.0) {
                if (clearance(ray, t) < 0.0) {
                    double low = t - 100.0;
                    for (double half = 50.0; half > 1.0; half *= 0.5) {
                        low += clearance(ray, low + half) > 0.0 ? half : 0.0;
                    }
                    return low * along;
                }
            }
            return std::numeric_limits<double>::infinity();
        };
        Random random(7);
        std::size_t wrong = 0;
        constexpr std::size_t kPixels = 200;
        for (std::size_t i = 0; i < kPixels; ++i) {
            const int x = 1 + static_cast<int>(random.uniform(0.0, kViewport.width - 2.0));
            const int y = 1 + static_cast<int>(random.uniform(0.0, kViewport.height - 2.0));
            const auto [low, high] =
                std::minmax({depth_of(x, y), depth_of(x - 1, y), depth_of(x + 1, y),
                             depth_of(x, y - 1), depth_of(x, y + 1)});
            const double drawn =
                picture.depths_m[static_cast<std::size_t>(y * kViewport.width + x)];
            wrong += drawn > low - 50.0 && drawn < high + 50.0 ? 0U : 1U;
        }
        EXPECT_LE(wrong, kPixels / 100) << step_m << " m";
    }
}

} // namespace
} // namespace marsview::test
