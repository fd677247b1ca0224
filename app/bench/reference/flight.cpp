#include "app/bench/reference/flight.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>

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
double distanceFor(double sample_px,
                   const FlightGround& ground,
                   const OrbitCamera& camera,
                   const Viewport& viewport)
{
    return ground.pixel_m / sample_px * viewport.height /
           (2.0 * std::tan(camera.field_of_view.radians() / 2.0));
}

OrbitCamera
dive(double t, const OrbitCamera& home, const FlightGround& ground, const Viewport& viewport)
{
    OrbitCamera low = home;
    const ScenePoint middle = ground.box.center();
    low.target = onGround(ground, middle.x, middle.y);
    low.tilt = kDiveTilt;
    low.distance_m = std::min(home.distance_m, distanceFor(kDivePixels, ground, home, viewport));
    const double depth =
        t < kDownShare ? t / kDownShare : 1.0 - kBackUp * (t - kDownShare) / (1.0 - kDownShare);
    return interpolated(home, low, depth);
}

OrbitCamera
sweep(double t, const OrbitCamera& home, const FlightGround& ground, const Viewport& viewport)
{
    OrbitCamera camera = home;
    camera.tilt = kSweepTilt;
    camera.azimuth = kSweepHeading;
    camera.distance_m =
        std::min(home.distance_m, distanceFor(kSweepPixels, ground, home, viewport));
    const Vec3 size = ground.box.maximum - ground.box.minimum;
    const double way_m =
        std::min(kSweepReach * camera.distance_m, kSweepShareMax * std::min(size.x, size.y));
    const double along_m = (t - 0.5) * way_m;
    const ScenePoint middle = ground.box.center();
    camera.target = onGround(ground, middle.x + along_m * std::sin(kSweepHeading.radians()),
                             middle.y + along_m * std::cos(kSweepHeading.radians()));
    return camera;
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

} // namespace marsview
