#include "core/globe/body_motion.h"
#include "tests/support/random.h"

#include <GeographicLib/Geodesic.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

const Ellipsoid kMars{3396190.0, 3376200.0};
constexpr Viewport kViewport{1000, 700};

double mountains(const GeographicPoint& place)
{
    return 4000.0 * std::sin(40.0 * place.longitude.radians()) *
               std::cos(30.0 * place.latitude.radians()) +
           3000.0;
}

BodyLimits limits()
{
    return {.ellipsoid = kMars,
            .area = {},
            .lowest_m = -1000.0,
            .highest_m = 7000.0,
            .distance_min_m = 1.0,
            .distance_max_m = 4e7};
}

BodyCamera randomCamera(test::Random& random, double latitude_max_deg)
{
    return constrained({.target = {.longitude = Angle::degrees(random.uniform(-180.0, 180.0)),
                                   .latitude = Angle::degrees(
                                       random.uniform(-latitude_max_deg, latitude_max_deg))},
                        .height_m = 0.0,
                        .distance_m = std::pow(10.0, random.uniform(0.5, 7.3)),
                        .azimuth = Angle::degrees(random.uniform(-180.0, 180.0)),
                        .tilt = Angle::degrees(random.uniform(0.0, 70.0))},
                       limits(), mountains);
}

PixelPoint randomPixel(test::Random& random)
{
    return {random.uniform(0.0, kViewport.width), random.uniform(0.0, kViewport.height)};
}

// Where a pixel's ray meets the ellipsoid at a height, in closed form; nothing if it misses.
std::optional<ScenePoint> hit(const BodyCamera& camera, PixelPoint pixel, double height_m)
{
    const Ray ray = pickRay(poseOf(camera, kMars), kViewport, pixel);
    const double a = kMars.equatorial_m + height_m;
    const double b = kMars.polar_m + height_m;
    const Vec3 o{ray.origin.x / a, ray.origin.y / a, ray.origin.z / b};
    const Vec3 d{ray.direction.x / a, ray.direction.y / a, ray.direction.z / b};
    const double half = dot(o, d) / dot(d, d);
    const double square = half * half - (dot(o, o) - 1.0) / dot(d, d);
    return square > 0.0 && half < 0.0 ? std::optional(ray.at(-half - std::sqrt(square)))
                                      : std::nullopt;
}

double pixelsApart(const BodyCamera& camera, const ScenePoint& point, PixelPoint pixel)
{
    const auto at = project(poseOf(camera, kMars), kViewport, point);
    return at ? std::hypot(at->x - pixel.x, at->y - pixel.y) : HUGE_VAL;
}

TEST(BodyMotion, ADragKeepsTheGroundUnderThePointerAndTheHeading)
{
    test::Random random(51);
    int dragged = 0;
    for (int i = 0; i < 4000; ++i) {
        const BodyCamera camera = randomCamera(random, 70.0);
        const PixelPoint from = randomPixel(random);
        const auto ground = hit(camera, from, camera.height_m);
        const double reach_m = 3.0 * camera.distance_m;
        if (!ground || length(*ground - targetOf(camera, kMars)) > reach_m) {
            continue; // sky, or near the horizon
        }
        const PixelPoint to{from.x + random.uniform(-60.0, 60.0),
                            from.y + random.uniform(-60.0, 60.0)};
        if (!hit(camera, to, camera.height_m)) {
            continue;
        }
        const BodyCamera moved = heldAt(camera, kMars, kViewport, {*ground, to});
        EXPECT_LT(pixelsApart(moved, *ground, to), 2e-3)
            << i << ": distance " << camera.distance_m << ", tilt " << camera.tilt.degrees();
        EXPECT_EQ(moved.tilt, camera.tilt);
        EXPECT_EQ(moved.distance_m, camera.distance_m);
        // Near a pole the ground turns under a heading that stays, and may not reach the pixel.
        const double ground_deg = placeOf(*ground, kMars).foot.latitude.degrees();
        if (std::abs(moved.target.latitude.degrees()) < 80.0 && std::abs(ground_deg) < 65.0) {
            EXPECT_EQ(moved.azimuth, camera.azimuth)
                << i << ": latitude of the ground " << ground_deg << ", of the camera "
                << camera.target.latitude.degrees() << ", moved to "
                << moved.target.latitude.degrees() << ", distance " << camera.distance_m;
        }
        ++dragged;
    }
    EXPECT_GT(dragged, 1500);
}

TEST(BodyMotion, ADragOverThePoleKeepsTheGroundUnderThePointer)
{
    test::Random random(52);
    for (int i = 0; i < 500; ++i) {
        BodyCamera camera = randomCamera(random, 70.0);
        camera.target.latitude = Angle::degrees((i % 2 == 0 ? 1.0 : -1.0) *
                                                (90.0 - std::pow(10.0, random.uniform(-4.0, 0.7))));
        camera.distance_m = std::pow(10.0, random.uniform(3.0, 7.0));
        camera.tilt = Angle::degrees(random.uniform(0.0, 30.0));
        const PixelPoint from{random.uniform(300.0, 700.0), random.uniform(200.0, 500.0)};
        const auto ground = hit(camera, from, camera.height_m);
        ASSERT_TRUE(ground);
        const PixelPoint to{random.uniform(300.0, 700.0), random.uniform(200.0, 500.0)};
        if (!hit(camera, to, camera.height_m)) {
            continue; // sky
        }
        const BodyCamera moved = heldAt(camera, kMars, kViewport, {*ground, to});
        // The ellipsoid turns about its center: not exactly onto itself.
        EXPECT_LT(pixelsApart(moved, *ground, to), 2e-3)
            << i << ": distance " << camera.distance_m << ", latitude "
            << camera.target.latitude.degrees();
    }
}

TEST(BodyMotion, ZoomingFromSpaceToAMeterKeepsThePointAtThePointerWithoutAJump)
{
    test::Random random(53);
    for (int i = 0; i < 60; ++i) {
        BodyCamera camera = randomCamera(random, 70.0);
        camera.distance_m = 1.5e7;
        camera.tilt = Angle::degrees(random.uniform(0.0, 40.0));
        const PixelPoint pixel{random.uniform(400.0, 600.0), random.uniform(250.0, 450.0)};
        const auto ground = hit(camera, pixel, 2500.0);
        ASSERT_TRUE(ground);
        while (camera.distance_m > 1.0) {
            const BodyCamera nearer = zoomed(camera, 0.8, kViewport, {*ground, pixel}, limits());
            EXPECT_LT(pixelsApart(nearer, *ground, pixel), 2e-3) << camera.distance_m;
            // The eye moves by little more than it comes nearer.
            const double moved_m = length(poseOf(nearer, kMars).eye - poseOf(camera, kMars).eye);
            EXPECT_LT(moved_m, 0.9 * camera.distance_m) << camera.distance_m;
            camera = nearer;
        }
        EXPECT_NEAR(camera.height_m, 2500.0, 1.0);
    }
}

TEST(BodyMotion, FlightsFollowTheGreatCircleAndRiseAsFarAsTheyGo)
{
    test::Random random(54);
    const GeographicLib::Geodesic sphere(kMars.equatorial_m, 0.0);
    for (int i = 0; i < 500; ++i) {
        const BodyCamera from = randomCamera(random, 89.0);
        const BodyCamera to = randomCamera(random, 89.0);
        EXPECT_EQ(flown(from, to, kMars, 0.0), from);
        EXPECT_EQ(flown(from, to, kMars, 1.0), to);
        double azimuth = 0.0;
        double back = 0.0;
        double way_m = 0.0;
        sphere.Inverse(from.target.latitude.degrees(), from.target.longitude.degrees(),
                       to.target.latitude.degrees(), to.target.longitude.degrees(), way_m, azimuth,
                       back);
        double last_m = 0.0;
        double highest_m = 0.0;
        BodyCamera before = from;
        for (int step = 1; step < 200; ++step) {
            const BodyCamera camera = flown(from, to, kMars, step / 200.0);
            double here_m = 0.0;
            double heading = 0.0;
            sphere.Inverse(from.target.latitude.degrees(), from.target.longitude.degrees(),
                           camera.target.latitude.degrees(), camera.target.longitude.degrees(),
                           here_m, heading, back);
            // On the way, and onward.
            double rest_m = 0.0;
            sphere.Inverse(camera.target.latitude.degrees(), camera.target.longitude.degrees(),
                           to.target.latitude.degrees(), to.target.longitude.degrees(), rest_m);
            EXPECT_NEAR(here_m + rest_m, way_m, 1.0);
            EXPECT_GE(here_m, last_m - 0.1);
            last_m = here_m;
            highest_m = std::max(highest_m, camera.distance_m);
            // No step passes more than the picture shows, and none changes the scale by much.
            EXPECT_LT(std::abs(std::log(camera.distance_m / before.distance_m)), 0.4);
            before = camera;
        }
        EXPECT_GT(highest_m, 0.3 * way_m);
        EXPECT_LT(highest_m, std::max({from.distance_m, to.distance_m, 3.0 * way_m}) * 1.001);
    }
}

TEST(BodyMotion, AHundredThousandInputsNeverLoseTheBodyOrGoUnderTheGround)
{
    test::Random random(55);
    BodyCamera camera = homeCamera(limits(), kViewport);
    for (int i = 0; i < 100'000; ++i) {
        const int input = static_cast<int>(random.uniform(0.0, 7.999));
        const PixelPoint pixel = randomPixel(random);
        const ScenePoint level = targetOf(camera, kMars);
        const HeldPoint held{
            pointOnBody(pickRay(poseOf(camera, kMars), kViewport, pixel), kMars, level), pixel};
        switch (input) {
        case 0:
            camera = heldAt(camera, kMars, kViewport, {held.point, randomPixel(random)});
            break;
        case 1:
        case 2:
            camera = zoomed(camera, std::exp(random.uniform(-1.5, 1.3)), kViewport, held, limits());
            break;
        case 3:
            camera = orbited(camera, Angle::degrees(random.uniform(-400.0, 400.0)),
                             Angle::degrees(random.uniform(-90.0, 90.0)));
            break;
        case 4:
            camera = panned(camera, random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), kMars);
            break;
        case 5:
            camera = flown(camera, randomCamera(random, 90.0), kMars, random.uniform(0.0, 1.0));
            break;
        case 6:
            if (i % 50 == 0) {
                camera.target = {.longitude = Angle::degrees(random.uniform(-1e4, 1e4)),
                                 .latitude = Angle::degrees(i % 100 == 0 ? 90.0 : -90.0)};
            }
            break;
        default:
            camera.height_m += random.uniform(-1e5, 1e5);
            break;
        }
        camera = constrained(camera, limits(), mountains);
        const CameraPose pose = poseOf(camera, kMars);
        ASSERT_TRUE(isFinite(pose.eye) && isFinite(pose.axes.forward)) << i;
        const BodyPlace eye = placeOf(pose.eye, kMars);
        ASSERT_GT(eye.height_m, mountains(eye.foot)) << i;
        // Ground in the picture: the target hangs over it, or looks at it.
        const double ground_m = mountains(camera.target);
        const BodyPositions::Foot foot = footOf(kMars, camera.target);
        const auto below = project(pose, kViewport, foot.surface_m + foot.normal * ground_m);
        ASSERT_TRUE(below) << i;
        ASSERT_LE(below->y, 1.001 * kViewport.height) << i;
        ASSERT_GE(below->y, 0.0) << i;
    }
}

} // namespace
} // namespace marsview
