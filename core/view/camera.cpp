#include "core/view/camera.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

double halfHeight(const CameraPose& camera)
{
    return std::tan(camera.field_of_view.radians() / 2.0);
}

} // namespace

CameraAxes axesOf(const OrbitCamera& camera)
{
    const double sin_a = std::sin(camera.azimuth.radians());
    const double cos_a = std::cos(camera.azimuth.radians());
    const double sin_t = std::sin(camera.tilt.radians());
    const double cos_t = std::cos(camera.tilt.radians());
    return {.right = {cos_a, -sin_a, 0.0},
            .up = {cos_t * sin_a, cos_t * cos_a, sin_t},
            .forward = {sin_t * sin_a, sin_t * cos_a, -cos_t}};
}

ScenePoint eyeOf(const OrbitCamera& camera)
{
    return camera.target - axesOf(camera).forward * camera.distance_m;
}

ClipRange clipRange(const CameraPose& camera, const SceneBox& box)
{
    const Vec3& forward = camera.axes.forward;
    const ScenePoint& eye = camera.eye;
    double depth_min = dot(box.minimum - eye, forward);
    double depth_max = depth_min;
    for (const ScenePoint& corner : box.corners()) {
        const double depth = dot(corner - eye, forward);
        depth_min = std::min(depth_min, depth);
        depth_max = std::max(depth_max, depth);
    }
    const double near_m = std::max(depth_min * 0.999, camera.distance_m * kNearShare);
    return {.near_m = near_m, .far_m = std::max(depth_max * 1.001, near_m * 2.0)};
}

Matrix4 viewRotation(const CameraPose& camera)
{
    const CameraAxes& axes = camera.axes;
    Matrix4 m;
    const auto set_row = [&m](std::size_t row, const Vec3& v) {
        m(row, 0) = v.x;
        m(row, 1) = v.y;
        m(row, 2) = v.z;
    };
    set_row(0, axes.right);
    set_row(1, axes.up);
    set_row(2, -axes.forward);
    return m;
}

Matrix4 projection(const CameraPose& camera, const Viewport& viewport, const ClipRange& clip)
{
    const double f = 1.0 / halfHeight(camera);
    Matrix4 m;
    m(0, 0) = f / viewport.aspect();
    m(1, 1) = f;
    m(2, 2) = (clip.far_m + clip.near_m) / (clip.near_m - clip.far_m);
    m(2, 3) = 2.0 * clip.far_m * clip.near_m / (clip.near_m - clip.far_m);
    m(3, 2) = -1.0;
    m(3, 3) = 0.0;
    return m;
}

Ray pickRay(const CameraPose& camera, const Viewport& viewport, PixelPoint pixel)
{
    const CameraAxes& axes = camera.axes;
    const double h = halfHeight(camera);
    const double x = (2.0 * pixel.x / viewport.width - 1.0) * h * viewport.aspect();
    const double y = (1.0 - 2.0 * pixel.y / viewport.height) * h;
    return {.origin = camera.eye,
            .direction = normalized(axes.forward + axes.right * x + axes.up * y)};
}

std::optional<PixelPoint>
project(const CameraPose& camera, const Viewport& viewport, const ScenePoint& point)
{
    const CameraAxes& axes = camera.axes;
    const Vec3 p = point - camera.eye;
    const double depth = dot(p, axes.forward);
    if (!(depth > 0.0)) {
        return std::nullopt;
    }
    const double h = halfHeight(camera) * depth;
    return PixelPoint{.x = (dot(p, axes.right) / (h * viewport.aspect()) + 1.0) / 2.0 *
                           viewport.width,
                      .y = (1.0 - dot(p, axes.up) / h) / 2.0 * viewport.height};
}

double metersPerPixel(const CameraPose& camera, const Viewport& viewport)
{
    return 2.0 * camera.distance_m * halfHeight(camera) / viewport.height;
}

double metersPerPixel(const CameraPose& camera, const Viewport& viewport, const ScenePoint& at)
{
    const double depth_m = dot(at - camera.eye, camera.axes.forward);
    return 2.0 * depth_m * halfHeight(camera) / viewport.height;
}

} // namespace marsview
