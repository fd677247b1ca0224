// Light that is fixed on a body: n · s at every place, from any camera.

#include "core/globe/body_camera.h"
#include "tests/render/render_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview::test {
namespace {

constexpr Viewport kSize{.width = 300, .height = 300};
constexpr double kEquatorial = 3396190.0;

GeographicPoint at(double longitude_deg, double latitude_deg)
{
    return {.longitude = Angle::degrees(longitude_deg), .latitude = Angle::degrees(latitude_deg)};
}

// A map of a whole body, as flat as the ellipsoid or with hills.
struct WholeBody {
    Georeference georeference;
    DrawnMap drawn;
    std::shared_ptr<const BodyGrid> grid;

    template <typename Height>
    WholeBody(const char* crs, Height height_m)
        : georeference(
              360, 180, *GeoTransform::fromTerms({-180, 1, 0, 90, 0, -1}), *Crs::fromText(crs))
        , drawn(floatTerrain(360, 180, height_m), georeference.sceneFrame())
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
    const Ellipsoid& ellipsoid() const { return grid->ellipsoid(); }
};

double level(std::size_t, std::size_t)
{
    return 0.0;
}

constexpr const char* kSphere = "+proj=longlat +R=3396190";
constexpr const char* kFlattened = "+proj=longlat +a=3396190 +b=3000000"; // more than any planet

class SunlightTest : public RenderTest {
protected:
    Picture drawFrom(const WholeBody& body,
                     const BodyCamera& camera,
                     const GeographicPoint& subsolar,
                     ShadingMode mode = ShadingMode::Hillshade,
                     double exaggeration = 1.0)
    {
        renderer_->setLayers({body.layer()});
        DrawStyle style;
        style.exaggeration = exaggeration;
        style.look.mode = mode;
        style.look.light_frame = LightFrame::Body;
        style.look.subsolar = subsolar;
        style.sky_top = kSkyColor;
        style.sky_bottom = kSkyColor;
        DrawRequest request{.viewport = kSize};
        request.body_pose = poseOf(camera, body.ellipsoid());
        return drawOffscreen(*renderer_, request, style, DepthUse::No).value().colors;
    }
    // The red channel in the middle of the picture.
    int redAt(const WholeBody& body, const BodyCamera& camera, const GeographicPoint& subsolar)
    {
        const Picture picture = drawFrom(body, camera, subsolar);
        return picture.rgb[3 * static_cast<std::size_t>(150 * kSize.width + 150)];
    }
};

BodyCamera
over(const GeographicPoint& place, double distance_m, double azimuth_deg, double tilt_deg)
{
    return {.target = place,
            .distance_m = distance_m,
            .azimuth = Angle::degrees(azimuth_deg),
            .tilt = Angle::degrees(tilt_deg)};
}

// The normal of an ellipsoid from its equation, at a planetocentric latitude.
Vec3 normalAt(const GeographicPoint& place, const Ellipsoid& ellipsoid)
{
    const double latitude = place.latitude.radians();
    const double longitude = place.longitude.radians();
    const double ratio = ellipsoid.equatorial_m / ellipsoid.polar_m;
    return normalized({std::cos(latitude) * std::cos(longitude),
                       std::cos(latitude) * std::sin(longitude),
                       std::sin(latitude) * ratio * ratio});
}

double expectedRed(double cosine)
{
    return std::min(255.0,
                    255.0 * kHillshadeWhite * (kNightShare + kSunShare * std::max(cosine, 0.0)));
}

TEST_F(SunlightTest, IsTheCosineOfTheAngleToTheSunOnTheLevelBody)
{
    for (const char* crs : {kSphere, kFlattened}) {
        const WholeBody body(crs, level);
        for (const GeographicPoint& subsolar : {at(40, 25), at(-170, -60)}) {
            const Vec3 sun = normalAt(subsolar, body.ellipsoid());
            for (const double away_deg : {0.0, 20.0, 45.0, 70.0, 85.0, 89.0, 95.0, 140.0}) {
                for (const double latitude_deg : {-70.0, -20.0, 0.0, 35.0, 80.0}) {
                    const GeographicPoint place =
                        at(subsolar.longitude.degrees() + away_deg, latitude_deg);
                    const double cosine = dot(normalAt(place, body.ellipsoid()), sun);
                    EXPECT_NEAR(redAt(body, over(place, 1e6, 0.0, 0.0), subsolar),
                                expectedRed(cosine), 2.0)
                        << crs << " " << away_deg << " " << latitude_deg;
                }
            }
        }
    }
}

// All of a hemisphere in one picture, pixel by pixel.
TEST_F(SunlightTest, TheTerminatorIsWhereTheSunIsOnTheHorizon)
{
    const WholeBody body(kSphere, level);
    const GeographicPoint subsolar = at(70, 10);
    const Vec3 sun = normalAt(subsolar, body.ellipsoid());
    const BodyCamera camera = over(at(0, 0), 1.5e7, 0.0, 0.0);
    const CameraPose pose = poseOf(camera, body.ellipsoid());
    const Picture picture = drawFrom(body, camera, subsolar);
    int night = 0;
    int day = 0;
    int far_off = 0;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const Ray ray = pickRay(pose, kSize, {x + 0.5, y + 0.5});
            const double middle = -dot(ray.origin, ray.direction);
            const Vec3 nearest = ray.at(middle);
            const double rest = kEquatorial * kEquatorial - dot(nearest, nearest);
            if (rest < 0.1 * kEquatorial * kEquatorial) {
                continue; // the limb
            }
            const Vec3 normal = normalized(ray.at(middle - std::sqrt(rest)));
            const double cosine = dot(normal, sun);
            const auto pixel = static_cast<std::size_t>(y * kSize.width + x);
            const int red = picture.rgb[3 * pixel];
            far_off += std::abs(red - expectedRed(cosine)) > 3.0 ? 1 : 0;
            night += cosine < 0.0 ? 1 : 0;
            day += cosine > 0.0 ? 1 : 0;
            if (cosine < -0.01) {
                ASSERT_NEAR(red, expectedRed(0.0), 1.0) << x << " " << y;
            }
        }
    }
    EXPECT_GT(night, 4000);
    EXPECT_GT(day, 4000);
    EXPECT_LE(far_off, (night + day) / 1000);
}

// A place keeps its brightness, on slopes too.
TEST_F(SunlightTest, DoesNotChangeWithTheCamera)
{
    const double step_m = kEquatorial * Angle::degrees(1.0).radians();
    const WholeBody hills(kFlattened, [&](std::size_t column, std::size_t row) {
        return 0.15 * step_m * std::sin(0.2 * static_cast<double>(column)) *
               std::cos(0.15 * static_cast<double>(row));
    });
    const GeographicPoint subsolar = at(20, 15);
    int brightest = 0;
    int darkest = 255;
    for (const GeographicPoint& place : {at(-30.3, 20.2), at(60.4, -35.1), at(95.2, 40.3)}) {
        const int red = redAt(hills, over(place, 1e6, 0.0, 0.0), subsolar);
        brightest = std::max(brightest, red);
        darkest = std::min(darkest, red);
        EXPECT_NEAR(redAt(hills, over(place, 1e6, 130.0, 0.0), subsolar), red, 2);
        EXPECT_NEAR(redAt(hills, over(place, 1e6, -70.0, 30.0), subsolar), red, 2);
        EXPECT_NEAR(redAt(hills, over(place, 1.3e6, 45.0, 0.0), subsolar), red, 2);
        // Not in the middle of the picture.
        const BodyCamera aside =
            over({.longitude = place.longitude + Angle::degrees(4.0), .latitude = place.latitude},
                 1e6, 10.0, 20.0);
        const CameraPose pose = poseOf(aside, hills.ellipsoid());
        const auto grid = hills.georeference.toGrid(place);
        const double height_m = hills.drawn.field->height(*grid);
        const BodyCamera there{.target = place, .height_m = height_m};
        const auto pixel = project(pose, kSize, targetOf(there, hills.ellipsoid()));
        ASSERT_TRUE(pixel);
        const Picture picture = drawFrom(hills, aside, subsolar);
        const auto x = static_cast<std::size_t>(pixel->x);
        const auto y = static_cast<std::size_t>(pixel->y);
        EXPECT_NEAR(picture.rgb[3 * (y * static_cast<std::size_t>(kSize.width) + x)], red, 4);
    }
    EXPECT_GT(brightest - darkest, 60);
}

// Planes that rise to the east and to the north, by closed form.
TEST_F(SunlightTest, SlopesAreLitByTheAngleOfTheirExaggeratedNormal)
{
    const double step_m = kEquatorial * Angle::degrees(1.0).radians();
    constexpr double kEast = 0.15; // on the equator
    constexpr double kNorth = 0.1;
    const WholeBody body(kSphere, [&](std::size_t column, std::size_t row) {
        return step_m * (kEast * (static_cast<double>(column % 20) - 10.0) -
                         kNorth * (static_cast<double>(row % 20) - 10.0));
    });
    const GeographicPoint place = at(10.5, 39.5); // of column 190 and row 50
    const double longitude = place.longitude.radians();
    const Vec3 up = normalAt(place, body.ellipsoid());
    const Vec3 east{-std::sin(longitude), std::cos(longitude), 0.0};
    const Vec3 north = cross(up, east);
    for (const GeographicPoint& subsolar :
         {at(10, 40), at(70, 10), at(-50, 10), at(10, -45), at(-170, 60), at(75, 35)}) {
        const Vec3 sun = normalAt(subsolar, body.ellipsoid());
        for (const double exaggeration : {1.0, 2.0}) {
            const double rise_east = exaggeration * kEast / std::cos(place.latitude.radians());
            const double rise_north = exaggeration * kNorth;
            const Vec3 normal = normalized(up - east * rise_east - north * rise_north);
            const Picture picture = drawFrom(body, over(place, 1e6, 0.0, 0.0), subsolar,
                                             ShadingMode::Hillshade, exaggeration);
            EXPECT_NEAR(picture.rgb[3 * static_cast<std::size_t>(150 * kSize.width + 150)],
                        expectedRed(dot(normal, sun)), 3.0)
                << subsolar.longitude.degrees() << " " << exaggeration;
        }
    }
}

// Slopes that face the sun are lit up to six degrees beyond the terminator, and no further.
TEST_F(SunlightTest, DoesNotShineThroughTheBody)
{
    const double step_m = kEquatorial * Angle::degrees(1.0).radians();
    // Rises to the east everywhere: its slopes face the evening sun in the west.
    const WholeBody steps(kSphere, [&](std::size_t column, std::size_t) {
        return 0.6 * step_m * static_cast<double>(column % 40);
    });
    const GeographicPoint subsolar = at(0.5, 0.0);
    EXPECT_GT(redAt(steps, over(at(88.5, 0.0), 2e6, 0.0, 0.0), subsolar), 100);
    EXPECT_GT(redAt(steps, over(at(93.5, 0.0), 2e6, 0.0, 0.0), subsolar), expectedRed(0.0) + 10);
    EXPECT_NEAR(redAt(steps, over(at(97.5, 0.0), 2e6, 0.0, 0.0), subsolar), expectedRed(0.0), 1);
    EXPECT_NEAR(redAt(steps, over(at(130.5, 0.0), 2e6, 0.0, 0.0), subsolar), expectedRed(0.0), 1);
}

TEST_F(SunlightTest, LightsEveryShadingAlike)
{
    const WholeBody body(kSphere, level);
    const BodyCamera day = over(at(0, 0), 1e6, 0.0, 0.0);
    for (const ShadingMode mode : {ShadingMode::Tint, ShadingMode::Hillshade, ShadingMode::Slope}) {
        const auto green = [&](const GeographicPoint& subsolar) {
            const Picture picture = drawFrom(body, day, subsolar, mode);
            return picture.rgb[3 * static_cast<std::size_t>(150 * kSize.width + 150) + 1];
        };
        const double noon = green(at(0, 0));
        EXPECT_NEAR(green(at(180, 0)), kNightShare * noon, 1.0);
        EXPECT_NEAR(green(at(60, 0)), (kNightShare + 0.5 * kSunShare) * noon, 1.0);
    }
}

// Pictures of flat maps have the light of the view.
TEST_F(SunlightTest, IsNotOnTheFlatMap)
{
    const DrawnMap map(floatTerrain(65, 65,
                                    [](std::size_t c, std::size_t r) {
                                        return 3.0 * std::sin(0.3 * static_cast<double>(c + r));
                                    }),
                       northUpFrame(65, 65, 1.0));
    renderer_->setLayers({map.layer()});
    OrbitCamera camera;
    camera.target = map.frame.toScene({32.0, 32.0}, 0.0);
    camera.distance_m = 80.0;
    DrawStyle style;
    const Picture before = draw(camera, kSize, {}, style).colors;
    style.look.light_frame = LightFrame::Body;
    style.look.subsolar = at(120, 40);
    EXPECT_EQ(draw(camera, kSize, {}, style).colors.rgb, before.rgb);
}

} // namespace
} // namespace marsview::test
