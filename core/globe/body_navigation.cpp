#include "core/globe/body_navigation.h"

#include "core/base/check.h"
#include "core/view/clear_tilt.h"
#include "core/view/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr double kCellsNearest = 2.0;
constexpr double kNearestShare = 1e-7; // of the radius
constexpr double kSizesFarthest = 4.0;
constexpr double kRadiiFarthest = 12.0;

// A place at the edge of the area stays where it is: a hundredth of a millimeter on a planet.
constexpr double kEdgeRad = 1e-12;

// An area of at least this reach is looked at as a ball.
constexpr Angle kBallReach = Angle::degrees(50.0);

// Samples of a map that are looked at, evenly spread along either side.
constexpr std::size_t kMeasured = 17;

ScenePoint placeOver(const BodyGrid& grid, std::size_t i, std::size_t j, double height_m)
{
    return grid.at(i * (grid.columns() - 1) / (kMeasured - 1),
                   j * (grid.rows() - 1) / (kMeasured - 1), height_m);
}

Angle shortTurn(Angle angle)
{
    return Angle::radians(std::remainder(angle.radians(), 2.0 * std::numbers::pi));
}

double largestRadius(const Ellipsoid& ellipsoid)
{
    return std::max(ellipsoid.equatorial_m, ellipsoid.polar_m);
}

Vec3 directionOf(const GeographicPoint& place)
{
    const double cosine = std::cos(place.latitude.radians());
    return {cosine * std::cos(place.longitude.radians()),
            cosine * std::sin(place.longitude.radians()), std::sin(place.latitude.radians())};
}

GeographicPoint placeInDirection(const Vec3& direction)
{
    return {.longitude = Angle::radians(std::atan2(direction.y, direction.x)),
            .latitude =
                Angle::radians(std::atan2(direction.z, std::hypot(direction.x, direction.y)))};
}

double angleBetween(const Vec3& a, const Vec3& b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

// The place itself, or where the way from the area's middle to it leaves the area.
GeographicPoint withinArea(const GeographicPoint& place, const BodyArea& area)
{
    const Vec3 middle = directionOf(area.middle);
    const Vec3 there = directionOf(place);
    if (angleBetween(middle, there) <= area.reach.radians() + kEdgeRad) {
        return place;
    }
    const Vec3 aside = normalized(there - middle * dot(there, middle));
    return isFinite(aside) ? placeInDirection(middle * std::cos(area.reach.radians()) +
                                              aside * std::sin(area.reach.radians()))
                           : area.middle;
}

// How much the eye is too low. Negative if it is high enough or not above terrain.
double
clearanceMissing(const BodyCamera& camera, const BodyLimits& limits, const BodyGround& ground)
{
    const BodyPlace eye = placeOf(poseOf(camera, limits.ellipsoid).eye, limits.ellipsoid);
    const double clear_m = kClearanceShare * camera.distance_m;
    if (eye.height_m >= limits.highest_m + clear_m) {
        return -1.0;
    }
    const double ground_m = ground(eye.foot);
    return std::isfinite(ground_m) ? ground_m + clear_m - eye.height_m : -1.0;
}

BodyCamera cleared(BodyCamera camera, const BodyLimits& limits, const BodyGround& ground)
{
    const double ground_m = ground(camera.target);
    double highest_m = limits.highest_m;
    if (std::isfinite(ground_m)) {
        highest_m =
            std::clamp(highest_m, ground_m,
                       ground_m + hangMax(camera.distance_m, camera.tilt, camera.field_of_view));
        camera.height_m = std::max(camera.height_m, ground_m);
    }
    camera.height_m = std::min(camera.height_m, highest_m);
    const double missing_m = clearanceMissing(camera, limits, ground);
    if (missing_m > 0.0) {
        // The surplus compensates for rounding and for the angle between both normals.
        camera.height_m =
            std::min(camera.height_m + 1.01 * missing_m + 1e-6 * camera.distance_m, highest_m);
        if (clearanceMissing(camera, limits, ground) > 0.0) {
            camera.tilt = clearTilt(camera.tilt, [&](Angle tilt) {
                BodyCamera tilted = camera;
                tilted.tilt = tilt;
                return clearanceMissing(tilted, limits, ground) <= 0.0;
            });
        }
    }
    return camera;
}

} // namespace

BodyArea areaOf(const BodyGrid& grid)
{
    const auto at = [&](std::size_t i, std::size_t j) { return placeOver(grid, i, j, 0.0); };
    BodyArea area{.middle = placeOf(at(kMeasured / 2, kMeasured / 2), grid.ellipsoid()).foot,
                  .reach = {}};
    const Vec3 middle = directionOf(area.middle);
    double reach = 0.0;
    for (std::size_t j = 0; j < kMeasured; ++j) {
        for (std::size_t i = 0; i < kMeasured; ++i) {
            reach = std::max(reach, angleBetween(middle, at(i, j)));
        }
    }
    // A map that goes around the body and leaves out a pole covers less, but is looked at alike.
    area.reach = Angle::radians(std::min(1.001 * reach, std::numbers::pi));
    // Its farthest samples are on the other side of the body: the map covers all of it.
    if (reach + 2.0 * grid.stepMaxM() / largestRadius(grid.ellipsoid()) >= std::numbers::pi) {
        area = {}; // its middle is that of overview maps
    }
    return area;
}

BodyLimits bodyLimits(const BodyGrid& grid, double lowest_m, double highest_m)
{
    const double radius_m = largestRadius(grid.ellipsoid());
    const BodyArea area = areaOf(grid);
    const double size_m =
        2.0 * radius_m * std::sin(std::min(area.reach.radians(), std::numbers::pi / 2.0)) +
        highest_m - lowest_m;
    return {.ellipsoid = grid.ellipsoid(),
            .area = area,
            .lowest_m = lowest_m,
            .highest_m = highest_m,
            .distance_min_m = std::max(kCellsNearest * grid.stepMaxM(), kNearestShare * radius_m),
            .distance_max_m = isBall(area) ? kRadiiFarthest * radius_m : kSizesFarthest * size_m};
}

BodyCamera constrained(BodyCamera camera, const BodyLimits& limits, const BodyGround& ground)
{
    camera.target = withinArea(camera.target, limits.area);
    camera.target.longitude = shortTurn(camera.target.longitude);
    camera.distance_m = std::clamp(camera.distance_m, limits.distance_min_m, limits.distance_max_m);
    camera.azimuth = shortTurn(camera.azimuth);
    camera.tilt = std::clamp(camera.tilt, Angle{}, kTiltMax);
    camera.height_m = std::clamp(camera.height_m, limits.lowest_m, limits.highest_m);
    return cleared(camera, limits, ground);
}

BodyCamera withGroundAhead(BodyCamera camera, const Ellipsoid& ellipsoid)
{
    constexpr double kUpperTenth = 0.8; // of half of the picture's height, from its middle
    const double radius_m = length(targetOf(camera, ellipsoid));
    const double wanted = std::atan(kUpperTenth * std::tan(camera.field_of_view.radians() / 2.0));
    // From the view axis up to the horizon, seen from the eye.
    const auto horizon_above = [&](double tilt) {
        const double along = camera.distance_m * std::sin(tilt);
        const double up = radius_m + camera.distance_m * std::cos(tilt);
        const double from_center = std::hypot(along, up);
        const double to_target = std::asin(radius_m * std::sin(tilt) / from_center);
        return std::asin(std::min(1.0, radius_m / from_center)) - to_target;
    };
    double low = 0.0;
    double high = camera.tilt.radians();
    if (horizon_above(high) >= wanted) {
        return camera;
    }
    constexpr int kHalvings = 20;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (horizon_above(middle) >= wanted ? low : high) = middle;
    }
    camera.tilt = Angle::radians(low);
    return camera;
}

std::vector<ScenePoint> placesOver(const BodyGrid& grid, double lowest_m, double highest_m)
{
    std::vector<ScenePoint> places;
    for (std::size_t j = 0; j < kMeasured; ++j) {
        for (std::size_t i = 0; i < kMeasured; ++i) {
            places.push_back(placeOver(grid, i, j, lowest_m));
            places.push_back(placeOver(grid, i, j, highest_m));
        }
    }
    return places;
}

// A place is in the picture from where its distance to the axis is a share of its depth.
BodyCamera framed(BodyCamera camera,
                  std::span<const ScenePoint> places,
                  const Viewport& viewport,
                  const Ellipsoid& ellipsoid)
{
    MARSVIEW_CHECK(!places.empty());
    const double up_slope = std::tan(camera.field_of_view.radians() / 2.0) / kHomeMargin;
    const double right_slope = up_slope * viewport.aspect();
    const ScenePoint target = targetOf(camera, ellipsoid);
    const CameraAxes axes = poseOf(camera, ellipsoid).axes;
    double distance_m = 0.0;
    for (const ScenePoint& place : places) {
        const Vec3 from_target = place - target;
        const double needed_m = std::max(std::abs(dot(from_target, axes.right)) / right_slope,
                                         std::abs(dot(from_target, axes.up)) / up_slope);
        distance_m = std::max(distance_m, needed_m - dot(from_target, axes.forward));
    }
    camera.distance_m = distance_m;
    return camera;
}

bool isBall(const BodyArea& area)
{
    return area.reach >= kBallReach;
}

BodyCamera homeCamera(const BodyLimits& limits, const Viewport& viewport, Angle field_of_view)
{
    BodyCamera camera{.target = limits.area.middle,
                      .height_m = std::clamp(0.0, limits.lowest_m, limits.highest_m),
                      .field_of_view = field_of_view};
    const double radius_m = largestRadius(limits.ellipsoid);
    const double slope =
        std::tan(field_of_view.radians() / 2.0) * std::min(1.0, viewport.aspect()) / kHomeMargin;
    if (isBall(limits.area)) {
        const double outer_m = radius_m + std::max(limits.highest_m, 0.0);
        camera.distance_m =
            outer_m / std::sin(std::atan(slope)) - length(targetOf(camera, limits.ellipsoid));
        return camera;
    }
    // The near edge of the area, the widest in the picture, decides.
    const double half_m = radius_m * std::sin(limits.area.reach.radians());
    camera.tilt = kHomeTilt;
    camera.distance_m = half_m * (1.0 / slope + std::sin(kHomeTilt.radians()));
    return camera;
}

BodyCamera
homeCamera(const BodyLimits& limits, std::span<const ScenePoint> places, const Viewport& viewport)
{
    const BodyCamera around = homeCamera(limits, viewport);
    return isBall(limits.area) ? around : framed(around, places, viewport, limits.ellipsoid);
}

namespace {

// The smallest circle around both.
BodyArea united(const BodyArea& a, const BodyArea& b)
{
    const Vec3 from = directionOf(a.middle);
    const Vec3 to = directionOf(b.middle);
    const double between = angleBetween(from, to);
    const double a_reach = a.reach.radians();
    const double b_reach = b.reach.radians();
    if (between + b_reach <= a_reach) {
        return a;
    }
    if (between + a_reach <= b_reach) {
        return b;
    }
    const double reach = 0.5 * (between + a_reach + b_reach);
    if (reach >= std::numbers::pi || between < 1e-12) {
        return {.middle = a.middle, .reach = Angle::radians(std::min(reach, std::numbers::pi))};
    }
    const double turn = reach - a_reach; // from the one middle toward the other
    const Vec3 middle =
        (from * std::sin(between - turn) + to * std::sin(turn)) * (1.0 / std::sin(between));
    return {.middle = placeInDirection(middle), .reach = Angle::radians(reach)};
}

} // namespace

BodyLimits united(const BodyLimits& a, const BodyLimits& b)
{
    return {.ellipsoid = a.ellipsoid,
            .area = united(a.area, b.area),
            .lowest_m = std::min(a.lowest_m, b.lowest_m),
            .highest_m = std::max(a.highest_m, b.highest_m),
            .distance_min_m = std::min(a.distance_min_m, b.distance_min_m),
            .distance_max_m = std::max(a.distance_max_m, b.distance_max_m)};
}

} // namespace marsview
