// Maps drawn on their bodies: no gaps, and where the samples are.

#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "tests/render/render_fixture.h"

#include <GeographicLib/Geocentric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr Viewport kViewport{480, 360};

// Closed: samples of one place, at the poles and in the first and last column, are equal.
enum class Edges : std::uint8_t { Free, Closed };

// A map with mountains, placed.
struct BodyPictureMap {
    Georeference georeference;
    DrawnMap drawn;
    std::shared_ptr<const BodyGrid> grid;

    BodyPictureMap(const char* crs,
                   std::size_t columns,
                   std::size_t rows,
                   const GeoTransform::Terms& terms,
                   double relief_m,
                   Edges edges = Edges::Free,
                   std::size_t turned_by = 0) // columns
        : georeference(columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs))
        , drawn(terrain(columns, rows, relief_m, edges, turned_by), georeference.sceneFrame())
    {
        JobMonitor monitor;
        grid = BodyGrid::make(georeference, monitor).value();
    }

    static Heightfield terrain(
        std::size_t columns, std::size_t rows, double relief_m, Edges edges, std::size_t turned_by)
    {
        Random random(17);
        const auto heights =
            heightsFrom(fractalHeights(random, columns, rows, relief_m, 0.5), columns);
        return floatTerrain(columns, rows, [&](std::size_t column, std::size_t row) {
            if (edges == Edges::Free) {
                return heights((column + turned_by) % columns, row);
            }
            const bool is_pole = row == 0 || row == rows - 1;
            return heights(is_pole || column == columns - 1 ? 0 : column, row);
        });
    }
    TerrainLayer layer() const
    {
        TerrainLayer made = drawn.layer();
        made.body = grid;
        return made;
    }
    BodyLimits limits(double exaggeration) const
    {
        const HeightRange range = drawn.field->range().value();
        return bodyLimits(*grid, range.minimum_m * exaggeration, range.maximum_m * exaggeration);
    }
};

BodyPictureMap wholeMars()
{
    return {"IAU_2015:49900", 360, 180, {0, 1, 0, 90, 0, -1}, 8000.0};
}

class BodyPicture : public RenderTest {
protected:
    OffscreenPicture drawFrom(const BodyPictureMap& map,
                              const BodyCamera& camera,
                              double exaggeration,
                              DetailTarget detail = {})
    {
        renderer_->setLayers({map.layer()});
        DrawStyle style;
        style.exaggeration = exaggeration;
        style.sky_top = kSkyColor;
        style.sky_bottom = kSkyColor;
        DrawRequest request{.viewport = kViewport, .detail = detail};
        request.body_pose = poseOf(camera, map.grid->ellipsoid());
        OffscreenPicture picture = drawOffscreen(*renderer_, request, style, DepthUse::Yes).value();
        EXPECT_TRUE(picture.report.is_complete);
        return picture;
    }
};

// Depths along the view direction by intersecting all triangles with the rays through the pixels'
// middles, in double. Positions are CartConvert's.
std::vector<double>
castDepths(const BodyPictureMap& map, const CameraPose& pose, double exaggeration)
{
    const Ellipsoid& body = map.grid->ellipsoid();
    const GeographicLib::Geocentric frame(body.equatorial_m, body.flattening());
    const double axes = body.polar_m / body.equatorial_m;
    const std::size_t columns = map.grid->columns();
    const std::size_t rows = map.grid->rows();
    std::vector<Vec3> points(columns * rows);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t sample = map.grid->rasterColumn(column);
            const auto place = map.georeference.toGeographic(
                GridPoint{static_cast<double>(sample), static_cast<double>(row)});
            const double graphic_deg =
                std::atan(std::tan(place->latitude.radians()) / (axes * axes)) * 180.0 /
                std::numbers::pi;
            Vec3& p = points[row * columns + column];
            frame.Forward(graphic_deg, place->longitude.degrees(),
                          exaggeration * map.drawn.field->sample(sample, row), p.x, p.y, p.z);
        }
    }
    std::vector<double> depths(static_cast<std::size_t>(kViewport.width * kViewport.height), kFar);
    const auto cast = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        std::array<std::optional<PixelPoint>, 3> corners{
            project(pose, kViewport, a), project(pose, kViewport, b), project(pose, kViewport, c)};
        if (!corners[0] || !corners[1] || !corners[2]) {
            return;
        }
        const auto [left, right] = std::minmax({corners[0]->x, corners[1]->x, corners[2]->x});
        const auto [top, bottom] = std::minmax({corners[0]->y, corners[1]->y, corners[2]->y});
        const auto pixel = [](double value, int most) {
            return static_cast<int>(std::clamp(std::floor(value), 0.0, most - 1.0));
        };
        const Vec3 u = b - a;
        const Vec3 v = c - a;
        for (int y = pixel(top, kViewport.height); y <= pixel(bottom, kViewport.height); ++y) {
            for (int x = pixel(left, kViewport.width); x <= pixel(right, kViewport.width); ++x) {
                const Ray ray = pickRay(pose, kViewport, {x + 0.5, y + 0.5});
                const Vec3 across = cross(ray.direction, v);
                const double determinant = dot(u, across);
                const Vec3 from = ray.origin - a;
                const double s = dot(from, across) / determinant;
                const Vec3 other = cross(from, u);
                const double t = dot(ray.direction, other) / determinant;
                if (s >= -1e-9 && t >= -1e-9 && s + t <= 1.0 + 1e-9) {
                    const double depth =
                        dot(v, other) / determinant * dot(ray.direction, pose.axes.forward);
                    double& nearest = depths[static_cast<std::size_t>(y * kViewport.width + x)];
                    if (depth > 0.0) {
                        nearest = std::min(nearest, depth);
                    }
                }
            }
        }
    };
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const Vec3& a = points[row * columns + column];
            const Vec3& d = points[(row + 1) * columns + column + 1];
            cast(a, points[row * columns + column + 1], d);
            cast(a, points[(row + 1) * columns + column], d);
        }
    }
    return depths;
}

// The share of pixels whose surface is within a pixel of the exact one: between the depths around,
// or no farther from them along the view than a pixel is wide there.
double shareWithinAPixel(const std::vector<double>& drawn,
                         const std::vector<double>& exact,
                         const CameraPose& pose)
{
    const double pixel = 2.0 * std::tan(0.5 * pose.field_of_view.radians()) / kViewport.height;
    std::size_t count = 0;
    std::size_t within = 0;
    const auto width = static_cast<std::size_t>(kViewport.width);
    for (std::size_t y = 1; y + 1 < static_cast<std::size_t>(kViewport.height); ++y) {
        for (std::size_t x = 1; x + 1 < width; ++x) {
            double low = kFar;
            double high = 0.0;
            for (std::size_t j = y - 1; j <= y + 1; ++j) {
                for (std::size_t i = x - 1; i <= x + 1; ++i) {
                    low = std::min(low, exact[j * width + i]);
                    high = std::max(high, exact[j * width + i]);
                }
            }
            if (low == kFar && drawn[y * width + x] == kFar) {
                continue;
            }
            ++count;
            const double depth = drawn[y * width + x];
            within += depth >= low * (1.0 - pixel) && depth <= high * (1.0 + pixel) ? 1U : 0U;
        }
    }
    return count == 0 ? 1.0 : static_cast<double>(within) / static_cast<double>(count);
}

BodyCamera over(double longitude_deg, double latitude_deg, double distance_m, double tilt_deg = 0.0)
{
    return {.target = {.longitude = Angle::degrees(longitude_deg),
                       .latitude = Angle::degrees(latitude_deg)},
            .height_m = 0.0,
            .distance_m = distance_m,
            .azimuth = Angle::degrees(30.0),
            .tilt = Angle::degrees(tilt_deg)};
}

// The same planet as two maps whose sides meet at 0° and at 180°.
TEST_F(BodyPicture, HasNoSeamWhereTheSidesOfAMapMeet)
{
    const BodyPictureMap mars = wholeMars();
    const BodyPictureMap turned("IAU_2015:49900", 360, 180, {-180, 1, 0, 90, 0, -1}, 8000.0,
                                Edges::Free, 180);
    for (const double distance_m : {8e6, 1e6}) {
        BodyCamera camera = homeCamera(mars.limits(3.0), kViewport);
        camera.target = {.longitude = Angle::degrees(0.5), .latitude = Angle::degrees(-20.0)};
        camera.distance_m = distance_m;
        const Picture seam = drawFrom(mars, camera, 3.0).colors;
        const Picture none = drawFrom(turned, camera, 3.0).colors;
        std::size_t different = 0;
        for (std::size_t i = 0; i < seam.rgb.size(); ++i) {
            different += std::abs(seam.rgb[i] - none.rgb[i]) > 8 ? 1U : 0U;
        }
        EXPECT_LT(static_cast<double>(different), 0.002 * static_cast<double>(seam.rgb.size()))
            << distance_m;
    }
}

TEST_F(BodyPicture, IsWithinAPixelOfEverySampleCastInDouble)
{
    struct View {
        BodyCamera camera;
        double exaggeration;
    };
    const BodyPictureMap mars = wholeMars();
    for (const View& view :
         {View{over(20.0, 10.0, 1.0e7), 1.0}, View{over(0.5, -5.0, 1.5e6, 50.0), 5.0},
          View{over(-120.0, 60.0, 3e6, 30.0), 10.0}, View{over(100.0, -40.0, 4e5, 70.0), 3.0}}) {
        const CameraPose pose = poseOf(view.camera, mars.grid->ellipsoid());
        const OffscreenPicture picture = drawFrom(mars, view.camera, view.exaggeration);
        EXPECT_GT(
            shareWithinAPixel(picture.depths_m, castDepths(mars, pose, view.exaggeration), pose),
            0.99)
            << view.camera.target.longitude.degrees() << "° E";
    }
}

// On a fine local map too, in the projections of such maps.
TEST_F(BodyPicture, ProjectedMapsLieWhereTheirCoordinatesSay)
{
    const std::vector<BodyPictureMap> maps{
        {"EPSG:32611", 200, 150, {390045, 30, 0, 3797505, 0, -30}, 500.0},
        {"+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m",
         161,
         150,
         {-155000, 2000, 0, 150000, 0, -2000},
         4000.0},
        {"+proj=sinu +lon_0=137 +R=3396190 +units=m",
         180,
         200,
         {-150000, 1000, 0, 1200000, 0, -1000},
         3000.0}};
    for (const BodyPictureMap& map : maps) {
        for (const double tilt_deg : {0.0, 60.0}) {
            BodyCamera camera = homeCamera(map.limits(2.0), kViewport);
            camera.tilt = Angle::degrees(tilt_deg);
            camera.distance_m *= tilt_deg > 0.0 ? 0.4 : 1.0;
            const CameraPose pose = poseOf(camera, map.grid->ellipsoid());
            const OffscreenPicture picture = drawFrom(map, camera, 2.0);
            EXPECT_GT(shareWithinAPixel(picture.depths_m, castDepths(map, pose, 2.0), pose), 0.99)
                << map.georeference.crs()->name() << ", tilt " << tilt_deg;
        }
    }
}

// Sky through the ground is a crack: between nodes, at the seam and at the poles.
TEST_F(BodyPicture, HasNoGapsAtTheSeamOrAtThePolesOrBetweenNodes)
{
    const std::vector<BodyPictureMap> maps{
        wholeMars(),
        {"IAU_2015:49900", 361, 181, {-0.5, 1, 0, 90.5, 0, -1}, 8000.0, Edges::Closed},
        {"IAU_2015:49900", 321, 150, {-180, 360.0 / 321, 0, 90, 0, -1.2}, 8000.0}};
    Random random(18);
    for (const BodyPictureMap& map : maps) {
        std::size_t sky = 0;
        for (int i = 0; i < 40; ++i) {
            const double latitude_deg = i % 4 == 0   ? 90.0 - std::pow(10.0, random.uniform(-3, 1))
                                        : i % 4 == 1 ? -90.0 + std::pow(10.0, random.uniform(-3, 1))
                                                     : random.uniform(-80.0, 80.0);
            const double longitude_deg =
                i % 2 == 0 ? random.uniform(-180.0, 180.0) : random.uniform(-1.0, 1.0);
            BodyCamera camera =
                over(longitude_deg, latitude_deg, std::pow(10.0, random.uniform(5.0, 6.5)),
                     random.uniform(0.0, 20.0));
            camera.height_m = 2e4; // so that no pixel sees past the limb
            camera.distance_m = std::min(camera.distance_m, 1.5e6);
            sky += skyPixels(
                drawFrom(map, camera, 1.5, {.error_px = random.uniform(0.7, 4.0)}).colors);
        }
        EXPECT_EQ(sky, 0U) << map.drawn.field->columns() << " columns";
    }
}

// Slopes of a sphere's map are compressed near the poles: light must not show that.
TEST_F(BodyPicture, LightAtAPlaceDependsOnItsSlopeAndNotOnTheMapsProjection)
{
    // The same tilted plane near 60° N, in degrees and in a local projection.
    const double step = 0.02;
    const auto plane = [&](const Georeference& georeference) {
        return floatTerrain(
            georeference.columns(), georeference.rows(), [&](std::size_t c, std::size_t r) {
                const auto place = georeference.toGeographic(
                    GridPoint{static_cast<double>(c), static_cast<double>(r)});
                const double east_m = 3396190.0 * std::cos(60.0 * std::numbers::pi / 180.0) *
                                      (place->longitude.radians());
                const double north_m =
                    3396190.0 * (place->latitude.radians() - std::numbers::pi / 3.0);
                return 0.3 * east_m + 0.1 * north_m;
            });
    };
    const auto color_of = [&](const char* crs, const GeoTransform::Terms& terms) {
        const Georeference georeference(97, 97, *GeoTransform::fromTerms(terms),
                                        *Crs::fromText(crs));
        const DrawnMap map(plane(georeference), georeference.sceneFrame());
        JobMonitor monitor;
        TerrainLayer layer = map.layer();
        layer.body = BodyGrid::make(georeference, monitor).value();
        renderer_->setLayers({layer});
        DrawStyle style;
        style.look.mode = ShadingMode::Hillshade;
        style.sky_top = kSkyColor;
        style.sky_bottom = kSkyColor;
        DrawRequest request{.viewport = {64, 64}};
        request.body_pose = poseOf(over(0.0, 60.0, 1e5), layer.body->ellipsoid());
        const OffscreenPicture picture =
            drawOffscreen(*renderer_, request, style, DepthUse::No).value();
        return picture.colors.rgb[3 * (32 * 64 + 32)];
    };
    const double m = step * 3396190.0 * std::numbers::pi / 180.0;
    const int degrees =
        color_of("+proj=longlat +R=3396190", {-48.5 * step, step, 0, 60.0 + 48.5 * step, 0, -step});
    const int local = color_of("+proj=ortho +lat_0=60 +lon_0=0 +R=3396190 +units=m",
                               {-48.5 * m, m, 0, 48.5 * m, 0, -m});
    EXPECT_NEAR(degrees, local, 2);
    EXPECT_GT(degrees, 20);
    EXPECT_LT(degrees, 235);
}

// A level map of a sphere.
struct LevelMap {
    Georeference georeference;
    DrawnMap drawn;
    std::shared_ptr<const BodyGrid> grid;

    LevelMap(const char* crs,
             std::size_t columns,
             std::size_t rows,
             const GeoTransform::Terms& terms,
             double height_m)
        : georeference(columns, rows, *GeoTransform::fromTerms(terms), *Crs::fromText(crs))
        , drawn(floatTerrain(
                    columns, rows, [height_m](std::size_t, std::size_t) { return height_m; }),
                georeference.sceneFrame())
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
    // Whether a place lies so many samples within the outermost ones.
    bool has(const GeographicPoint& place, double inside) const
    {
        const auto at = georeference.toGrid(place);
        const auto within = [inside](double value, std::size_t count) {
            return value >= inside && value <= static_cast<double>(count - 1) - inside;
        };
        return at && within(at->row, georeference.rows()) &&
               (grid->closes() || within(at->column, georeference.columns()));
    }
};

// The lower layer is higher here: it would hide the upper one.
TEST_F(BodyPicture, TheUpperLayerIsSeenWhereItHasDataWhateverItsProjection)
{
    constexpr double kRadius = 1737400.0;
    constexpr double kDepth = 1e5;
    const LevelMap lower("+proj=longlat +R=1737400", 360, 180, {0, 1, 0, 90, 0, -1}, 0.0);
    struct Nested {
        LevelMap map;
        std::vector<BodyCamera> cameras;
    };
    const std::vector<Nested> all{
        {{"+proj=tmerc +lat_0=-43 +lon_0=0 +R=1737400 +units=m",
          121,
          101,
          {-240000, 4000, 0, 200000, 0, -4000},
          -kDepth},
         {over(0.0, -43.0, 1.5e6), over(0.0, -43.0, 1e7), over(3.0, -40.0, 6e5, 30.0)}},
        {{"+proj=stere +lat_0=-90 +lat_ts=-90 +lon_0=0 +R=1737400 +units=m",
          201,
          201,
          {-800000, 8000, 0, 800000, 0, -8000},
          -kDepth},
         {over(0.0, -90.0, 2e6), over(0.0, -75.0, 8e6), over(179.9, -65.0, 1e6)}},
        {{"+proj=longlat +R=1737400", 80, 60, {170, 0.5, 0, 20, 0, -0.5}, -kDepth},
         {over(180.0, 5.0, 3e6), over(-170.0, -5.0, 6e5)}},
        {{"+proj=longlat +R=1737400", 720, 100, {-180, 0.5, 0, 20, 0, -0.5}, -kDepth},
         {over(180.0, 5.0, 3e6), over(0.0, -20.0, 6e6)}}};
    const auto depth_on = [](const CameraPose& pose, const Ray& ray, double radius_m) {
        const double middle = -dot(ray.origin, ray.direction);
        const Vec3 nearest = ray.at(middle);
        const double rest = radius_m * radius_m - dot(nearest, nearest);
        return rest > 0.0 ? (middle - std::sqrt(rest)) * dot(ray.direction, pose.axes.forward)
                          : kFar;
    };
    for (const Nested& nested : all) {
        for (const BodyCamera& camera : nested.cameras) {
            renderer_->setLayers({nested.map.layer(), lower.layer()});
            DrawStyle style;
            style.sky_top = kSkyColor;
            style.sky_bottom = kSkyColor;
            DrawRequest request{.viewport = kViewport};
            const CameraPose pose = poseOf(camera, lower.grid->ellipsoid());
            request.body_pose = pose;
            const OffscreenPicture picture =
                drawOffscreen(*renderer_, request, style, DepthUse::Yes).value();
            std::size_t upper = 0;
            std::size_t others = 0;
            std::size_t wrong = 0;
            for (int y = 0; y < kViewport.height; ++y) {
                for (int x = 0; x < kViewport.width; ++x) {
                    const Ray ray = pickRay(pose, kViewport, {x + 0.5, y + 0.5});
                    const double on_lower = depth_on(pose, ray, kRadius);
                    const double on_upper = depth_on(pose, ray, kRadius - kDepth);
                    if (on_lower == kFar || on_upper == kFar) {
                        continue;
                    }
                    const double along = dot(ray.direction, pose.axes.forward);
                    const auto has = [&](double depth, double inside) {
                        const BodyPlace place =
                            placeOf(ray.at(depth / along), lower.grid->ellipsoid());
                        return nested.map.has(place.foot, inside);
                    };
                    const double drawn =
                        picture.depths_m[static_cast<std::size_t>(y * kViewport.width + x)];
                    // Triangles are off by up to a pixel: from afar, by 20 km.
                    const bool is_upper = std::abs(drawn - on_upper) < std::abs(drawn - on_lower);
                    if (has(on_lower, 2.0) && has(on_upper, 2.0)) {
                        ++upper;
                        wrong += is_upper ? 0U : 1U;
                    } else if (!has(on_lower, -2.0)) {
                        ++others;
                        wrong += is_upper ? 1U : 0U;
                    }
                }
            }
            EXPECT_GT(upper, 200U) << nested.map.georeference.crs()->name();
            EXPECT_LE(wrong, (upper + others) / 2000)
                << nested.map.georeference.crs()->name() << " from " << camera.distance_m
                << " m: of " << upper << " above and " << others << " elsewhere";
        }
    }
}

} // namespace
} // namespace marsview::test
