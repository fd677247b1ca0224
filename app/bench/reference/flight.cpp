#include "app/bench/reference/flight.h"

#include "core/base/check.h"
#include "core/globe/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

// Width of a sample in pixels at the bottom of a dive, and in a sweep.
constexpr double kDivePixels = 16.0;
constexpr double kSweepPixels = 3.0;

// The fraction of a dive that descends; the rest ascends by half of the factors of distance.
constexpr double kDownShare = 0.7;
constexpr double kBackUp = 0.5;
constexpr Angle kDiveTilt = Angle::degrees(60.0);

constexpr Angle kSweepTilt = Angle::degrees(70.0);
constexpr Angle kSweepHeading = Angle::degrees(60.0); // not along a grid line

// Maximum length of a sweep in camera distances: in four seconds about the speed of a hand drag.
constexpr double kSweepReach = 4.0;
constexpr double kSweepShareMax = 0.8; // fraction of the map's shorter side

ScenePoint onGround(const FlightGround& ground, double x, double y)
{
    const double z = ground.height(x, y);
    return {x, y, std::isfinite(z) ? z : ground.box.center().z};
}

// The distance at which a sample in the center of the picture, seen face on, has this width in
// pixels.
double distanceFor(double sample_px, double pixel_m, Angle field_of_view, const Viewport& viewport)
{
    return pixel_m / sample_px * viewport.height / (2.0 * std::tan(field_of_view.radians() / 2.0));
}

// How deep a dive is, 0 … 1.
double depthOfDive(double t)
{
    return t < kDownShare ? t / kDownShare : 1.0 - kBackUp * (t - kDownShare) / (1.0 - kDownShare);
}

OrbitCamera
dive(double t, const OrbitCamera& home, const FlightGround& ground, const Viewport& viewport)
{
    OrbitCamera low = home;
    const ScenePoint middle = ground.box.center();
    low.target = onGround(ground, middle.x, middle.y);
    low.tilt = kDiveTilt;
    low.distance_m = std::min(
        home.distance_m, distanceFor(kDivePixels, ground.pixel_m, home.field_of_view, viewport));
    return interpolated(home, low, depthOfDive(t));
}

OrbitCamera
sweep(double t, const OrbitCamera& home, const FlightGround& ground, const Viewport& viewport)
{
    OrbitCamera camera = home;
    camera.tilt = kSweepTilt;
    camera.azimuth = kSweepHeading;
    camera.distance_m = std::min(
        home.distance_m, distanceFor(kSweepPixels, ground.pixel_m, home.field_of_view, viewport));
    const Vec3 size = ground.box.maximum - ground.box.minimum;
    const double way_m =
        std::min(kSweepReach * camera.distance_m, kSweepShareMax * std::min(size.x, size.y));
    const double along_m = (t - 0.5) * way_m;
    const ScenePoint middle = ground.box.center();
    camera.target = onGround(ground, middle.x + along_m * std::sin(kSweepHeading.radians()),
                             middle.y + along_m * std::cos(kSweepHeading.radians()));
    return camera;
}

BodyCamera onGround(const BodyFlightGround& ground, BodyCamera camera)
{
    const double height_m = ground.height(camera.target);
    if (std::isfinite(height_m)) {
        camera.height_m = height_m;
    }
    return camera;
}

BodyCamera
bodyDive(double t, const BodyCamera& home, const BodyFlightGround& ground, const Viewport& viewport)
{
    BodyCamera low = onGround(ground, home);
    low.tilt = kDiveTilt;
    low.distance_m = std::min(
        home.distance_m, distanceFor(kDivePixels, ground.pixel_m, home.field_of_view, viewport));
    return flown(home, low, ground.limits.ellipsoid, depthOfDive(t));
}

BodyCamera bodySweep(double t,
                     const BodyCamera& home,
                     const BodyFlightGround& ground,
                     const Viewport& viewport)
{
    BodyCamera camera = home;
    camera.tilt = kSweepTilt;
    camera.distance_m = std::min(
        home.distance_m, distanceFor(kSweepPixels, ground.pixel_m, home.field_of_view, viewport));
    const double radius_m = ground.limits.ellipsoid.equatorial_m;
    const double reach = std::min(ground.limits.area.reach.radians(), std::numbers::pi / 2.0);
    const double way_m =
        std::min(kSweepReach * camera.distance_m, kSweepShareMax * 2.0 * reach * radius_m);
    const double along = (t - 0.5) * way_m / radius_m;
    // On a sphere, whose places are planetocentric as those of the camera are.
    const LocalAxes middle = localAxes({.equatorial_m = 1.0, .polar_m = 1.0}, home.target);
    const Vec3 ahead = middle.east * std::sin(kSweepHeading.radians()) +
                       middle.north * std::cos(kSweepHeading.radians());
    const Vec3 there = middle.up * std::cos(along) + ahead * std::sin(along);
    const Vec3 onward = ahead * std::cos(along) - middle.up * std::sin(along);
    camera.target = {.longitude = Angle::radians(std::atan2(there.y, there.x)),
                     .latitude = Angle::radians(std::atan2(there.z, std::hypot(there.x, there.y)))};
    const LocalAxes local = localAxes(ground.limits.ellipsoid, camera.target);
    camera.azimuth = Angle::radians(std::atan2(dot(onward, local.east), dot(onward, local.north)));
    return onGround(ground, camera);
}

} // namespace

std::string_view flightName(Flight flight)
{
    switch (flight) {
    case Flight::Orbit:
        return "orbit";
    case Flight::Dive:
        return "dive";
    case Flight::Sweep:
        return "sweep";
    }
    return "";
}

OrbitCamera cameraOn(Flight flight, double t, const FlightGround& ground, const Viewport& viewport)
{
    MARSVIEW_CHECK(t >= 0.0 && t <= 1.0 && ground.pixel_m > 0.0);
    OrbitCamera home = homeCamera(ground.box, viewport);
    switch (flight) {
    case Flight::Orbit:
        home.azimuth = Angle::degrees(360.0 * t);
        return home;
    case Flight::Dive:
        return dive(t, home, ground, viewport);
    case Flight::Sweep:
        return sweep(t, home, ground, viewport);
    }
    return home;
}

BodyCamera
bodyCameraOn(Flight flight, double t, const BodyFlightGround& ground, const Viewport& viewport)
{
    MARSVIEW_CHECK(t >= 0.0 && t <= 1.0 && ground.pixel_m > 0.0);
    BodyCamera home = homeCamera(ground.limits, viewport);
    switch (flight) {
    case Flight::Orbit:
        home.azimuth = Angle::degrees(360.0 * t);
        home.tilt = std::max(home.tilt, kHomeTilt);
        return home;
    case Flight::Dive:
        return bodyDive(t, home, ground, viewport);
    case Flight::Sweep:
        return bodySweep(t, home, ground, viewport);
    }
    return home;
}

} // namespace marsview
