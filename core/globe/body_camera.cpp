#include "core/globe/body_camera.h"

#include "core/body/body_positions.h"

#include <GeographicLib/Geocentric.hpp>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Of a distance, the depth at the corner of a wide picture.
constexpr double kDepthShareMin = 0.5;

} // namespace

LocalAxes localAxes(const Ellipsoid& ellipsoid, const GeographicPoint& place)
{
    const Vec3 up = footOf(ellipsoid, place).normal;
    const Vec3 east{-std::sin(place.longitude.radians()), std::cos(place.longitude.radians()), 0.0};
    return {.east = east, .north = cross(up, east), .up = up};
}

ScenePoint targetOf(const BodyCamera& camera, const Ellipsoid& ellipsoid)
{
    const BodyPositions::Foot foot = footOf(ellipsoid, camera.target);
    return foot.surface_m + foot.normal * camera.height_m;
}

CameraPose poseOf(const BodyCamera& camera, const Ellipsoid& ellipsoid)
{
    const LocalAxes local = localAxes(ellipsoid, camera.target);
    const CameraAxes level = axesOf(OrbitCamera{.azimuth = camera.azimuth, .tilt = camera.tilt});
    const auto turned = [&local](const Vec3& v) {
        return local.east * v.x + local.north * v.y + local.up * v.z;
    };
    const CameraAxes axes{
        .right = turned(level.right), .up = turned(level.up), .forward = turned(level.forward)};
    return {targetOf(camera, ellipsoid) - axes.forward * camera.distance_m, axes, camera.distance_m,
            camera.field_of_view};
}

BodyPlace placeOf(const ScenePoint& point, const Ellipsoid& ellipsoid)
{
    const GeographicLib::Geocentric frame(ellipsoid.equatorial_m, ellipsoid.flattening());
    BodyPlace place;
    double latitude_deg = 0.0; // planetographic
    double longitude_deg = 0.0;
    frame.Reverse(point.x, point.y, point.z, latitude_deg, longitude_deg, place.height_m);
    place.foot = {.longitude = Angle::degrees(longitude_deg),
                  .latitude = ellipsoid.planetocentric(Angle::degrees(latitude_deg))};
    return place;
}

ClipRange
bodyClipRange(const CameraPose& pose, const Ellipsoid& ellipsoid, double lowest_m, double highest_m)
{
    const double inner_m = std::max(
        std::min(ellipsoid.equatorial_m, ellipsoid.polar_m) + std::min(lowest_m, 0.0), 0.0);
    const double outer_m =
        std::max(ellipsoid.equatorial_m, ellipsoid.polar_m) + std::max(highest_m, 0.0);
    const double eye_m = length(pose.eye);
    const auto tangent = [inner_m](double distance_m) {
        return std::sqrt(std::max(distance_m * distance_m - inner_m * inner_m, 0.0));
    };
    const double near_m =
        std::max(kDepthShareMin * (eye_m - outer_m), kNearShare * pose.distance_m);
    // The furthest terrain stands behind the horizon and just reaches above it.
    return {.near_m = near_m,
            .far_m = std::max(1.001 * (tangent(eye_m) + tangent(outer_m)), 2.0 * near_m)};
}

} // namespace marsview
