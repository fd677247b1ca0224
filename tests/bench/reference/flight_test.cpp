#include "app/bench/reference/flight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

constexpr Viewport kViewport{1280, 800};
constexpr int kSteps = 480;

FlightGround hills()
{
    return {
        .box = {{-1e6, -5e5, -3e3}, {1e6, 5e5, 3e3}},
        .pixel_m = 250.0,
        .height = [](double x, double y) { return 3e3 * std::sin(x / 4e4) * std::cos(y / 3e4); }};
}

BodyFlightGround planet()
{
    return {.limits = {.ellipsoid = {.equatorial_m = 3.396e6, .polar_m = 3.376e6},
                       .area = {.middle = {.longitude = Angle::degrees(20.0),
                                           .latitude = Angle::degrees(10.0)}},
                       .lowest_m = -3e3,
                       .highest_m = 3e3,
                       .distance_min_m = 500.0,
                       .distance_max_m = 4e7},
            .pixel_m = 250.0,
            .height = [](const GeographicPoint& place) {
                return 3e3 * std::sin(50.0 * place.longitude.radians());
            }};
}

BodyCamera bodyStep(Flight flight, int i)
{
    return bodyCameraOn(flight, static_cast<double>(i) / kSteps, planet(), kViewport);
}

OrbitCamera step(Flight flight, int i)
{
    return cameraOn(flight, static_cast<double>(i) / kSteps, hills(), kViewport);
}

// The width in pixels of a sample in the middle of the view, seen face on.
double samplePixels(const auto& camera)
{
    return hills().pixel_m * kViewport.height /
           (2.0 * camera.distance_m * std::tan(camera.field_of_view.radians() / 2.0));
}

} // namespace

TEST(Flight, MovesWithoutJumps)
{
    for (const Flight flight : kFlights) {
        for (int i = 1; i <= kSteps; ++i) {
            const OrbitCamera before = step(flight, i - 1);
            const OrbitCamera after = step(flight, i);
            EXPECT_LT(length(eyeOf(after) - eyeOf(before)), 0.1 * after.distance_m)
                << flightName(flight) << " " << i;
        }
    }
}

TEST(Flight, OrbitsTheWholeMapOnce)
{
    const OrbitCamera home = homeCamera(hills().box, kViewport);
    double turned_deg = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const OrbitCamera camera = step(Flight::Orbit, i);
        turned_deg += std::remainder(
            camera.azimuth.degrees() - step(Flight::Orbit, i - 1).azimuth.degrees(), 360.0);
        EXPECT_EQ(camera.target, home.target);
        EXPECT_EQ(camera.distance_m, home.distance_m);
    }
    EXPECT_NEAR(turned_deg, 360.0, 1e-6);
}

TEST(Flight, DivesFromTheWholeMapToSingleSamplesAndPartlyBack)
{
    const OrbitCamera home = homeCamera(hills().box, kViewport);
    EXPECT_NEAR(step(Flight::Dive, 0).distance_m, home.distance_m, 1e-6 * home.distance_m);
    double nearest_px = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        nearest_px = std::max(nearest_px, samplePixels(step(Flight::Dive, i)));
    }
    EXPECT_NEAR(nearest_px, 16.0, 0.1);
    const double last_px = samplePixels(step(Flight::Dive, kSteps));
    EXPECT_LT(last_px, 0.5 * nearest_px);
    EXPECT_GT(last_px, 2.0 * samplePixels(home));
}

TEST(Flight, SweepsOverTheTerrainWithSamplesOfAFewPixels)
{
    for (int i = 0; i <= kSteps; ++i) {
        const OrbitCamera camera = step(Flight::Sweep, i);
        EXPECT_NEAR(samplePixels(camera), 3.0, 1e-6);
        EXPECT_NEAR(camera.tilt.degrees(), 70.0, 1e-9);
        EXPECT_NEAR(camera.target.z, hills().height(camera.target.x, camera.target.y), 1e-6);
        EXPECT_LT(std::abs(camera.target.x), hills().box.maximum.x);
        EXPECT_LT(std::abs(camera.target.y), hills().box.maximum.y);
    }
    EXPECT_GT(length(step(Flight::Sweep, kSteps).target - step(Flight::Sweep, 0).target),
              3.0 * step(Flight::Sweep, 0).distance_m);
}

TEST(Flight, MovesOverABodyWithoutJumps)
{
    const Ellipsoid ellipsoid = planet().limits.ellipsoid;
    for (const Flight flight : kFlights) {
        for (int i = 1; i <= kSteps; ++i) {
            const BodyCamera after = bodyStep(flight, i);
            EXPECT_LT(length(poseOf(after, ellipsoid).eye -
                             poseOf(bodyStep(flight, i - 1), ellipsoid).eye),
                      0.1 * after.distance_m)
                << flightName(flight) << " " << i;
        }
    }
}

TEST(Flight, OrbitsTheMiddleOfABodyAtOneDistance)
{
    const BodyCamera home = homeCamera(planet().limits, kViewport);
    for (int i = 0; i <= kSteps; ++i) {
        const BodyCamera camera = bodyStep(Flight::Orbit, i);
        EXPECT_EQ(camera.target, planet().limits.area.middle);
        EXPECT_EQ(camera.distance_m, home.distance_m);
        EXPECT_NEAR(camera.azimuth.degrees(), 360.0 * i / kSteps, 1e-9);
        EXPECT_NEAR(camera.tilt.degrees(), 40.0, 1e-9);
    }
}

TEST(Flight, DivesFromTheWholeBodyToSingleSamplesAndPartlyBack)
{
    const BodyCamera home = homeCamera(planet().limits, kViewport);
    EXPECT_NEAR(bodyStep(Flight::Dive, 0).distance_m, home.distance_m, 1e-6 * home.distance_m);
    double nearest_px = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        nearest_px = std::max(nearest_px, samplePixels(bodyStep(Flight::Dive, i)));
    }
    EXPECT_NEAR(nearest_px, 16.0, 0.1);
    const double last_px = samplePixels(bodyStep(Flight::Dive, kSteps));
    EXPECT_LT(last_px, 0.5 * nearest_px);
    EXPECT_GT(last_px, 2.0 * samplePixels(home));
}

TEST(Flight, SweepsOverABodyAlongAGreatCircle)
{
    const auto direction = [](const GeographicPoint& place) {
        const double cosine = std::cos(place.latitude.radians());
        return Vec3{cosine * std::cos(place.longitude.radians()),
                    cosine * std::sin(place.longitude.radians()),
                    std::sin(place.latitude.radians())};
    };
    const Vec3 first = direction(bodyStep(Flight::Sweep, 0).target);
    const Vec3 last = direction(bodyStep(Flight::Sweep, kSteps).target);
    const Vec3 axis = normalized(cross(first, last));
    const double way_m = std::asin(length(cross(first, last))) * 3.396e6;
    EXPECT_NEAR(way_m, 4.0 * bodyStep(Flight::Sweep, 0).distance_m, 1.0);
    for (int i = 0; i <= kSteps; ++i) {
        const BodyCamera camera = bodyStep(Flight::Sweep, i);
        EXPECT_NEAR(dot(direction(camera.target), axis), 0.0, 1e-9);
        EXPECT_NEAR(samplePixels(camera), 3.0, 1e-6);
        EXPECT_NEAR(camera.tilt.degrees(), 70.0, 1e-9);
        EXPECT_NEAR(camera.height_m, planet().height(camera.target), 1e-6);
        // It looks along its way.
        const CameraPose pose = poseOf(camera, planet().limits.ellipsoid);
        EXPECT_NEAR(dot(pose.axes.forward, axis), 0.0, 1e-3);
        EXPECT_GT(dot(pose.axes.forward, last - first), 0.0);
    }
    const BodyCamera middle = bodyStep(Flight::Sweep, kSteps / 2);
    EXPECT_NEAR(middle.target.longitude.degrees(), 20.0, 1e-9);
    EXPECT_NEAR(middle.target.latitude.degrees(), 10.0, 1e-9);
    EXPECT_NEAR(middle.azimuth.degrees(), 60.0, 0.1);
}

TEST(Flight, FliesOverVoidsAtTheMapsMiddleHeight)
{
    FlightGround nothing = hills();
    nothing.height = [](double, double) { return std::nan(""); };
    for (const Flight flight : kFlights) {
        const OrbitCamera camera = cameraOn(flight, 0.6, nothing, kViewport);
        EXPECT_TRUE(std::isfinite(camera.target.z)) << flightName(flight);
        BodyFlightGround nowhere = planet();
        nowhere.height = [](const GeographicPoint&) { return std::nan(""); };
        EXPECT_TRUE(std::isfinite(bodyCameraOn(flight, 0.6, nowhere, kViewport).height_m));
    }
}

} // namespace marsview
