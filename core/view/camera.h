// The camera: its position, its view, and the ray through each pixel.
//
// Everything is double and in scene meters. Drawing converts to float relative to the eye in the
// last step (viewRotation() has no translation), so nothing jitters far from the origin.
#pragma once

#include "core/base/angle.h"
#include "core/geo/frames.h"
#include "core/view/matrix.h"
#include "core/view/scene_box.h"

#include <optional>

namespace marsview {

/// Width and height of a picture in pixels; both at least 1.
struct Viewport {
    int width = 1;
    int height = 1;

    double aspect() const noexcept
    {
        return static_cast<double>(width) / static_cast<double>(height);
    }
};

/// A position in a picture: x right, y down, from the outer corner of the top left pixel.
struct PixelPoint {
    double x = 0.0;
    double y = 0.0;
};

/// A part of a picture, in pixels from the lower left as OpenGL counts them.
struct PixelArea {
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
};

/// A half-line. The direction has length 1.
struct Ray {
    ScenePoint origin;
    Vec3 direction;

    constexpr ScenePoint at(double distance_m) const noexcept
    {
        return origin + direction * distance_m;
    }
};

/// A camera at a distance from its target point.
struct OrbitCamera {
    ScenePoint target{};
    double distance_m = 1.0;                    // > 0
    Angle azimuth{};                            // the heading of the view, clockwise from north
    Angle tilt{};                               // 0 looks straight down, 90° along the horizon
    Angle field_of_view = Angle::degrees(40.0); // vertical

    bool operator==(const OrbitCamera&) const = default;
};

/// Unit vectors of the picture, right-handed: right × up = -forward.
struct CameraAxes {
    Vec3 right;
    Vec3 up;
    Vec3 forward;
};

CameraAxes axesOf(const OrbitCamera& camera);
ScenePoint eyeOf(const OrbitCamera& camera);

/// What a picture needs to know of a camera, in any scene.
struct CameraPose {
    ScenePoint eye;
    CameraAxes axes;
    double distance_m = 1.0; // of the target
    Angle field_of_view;     // vertical

    CameraPose(const ScenePoint& from, const CameraAxes& to, double target_m, Angle field)
        : eye(from)
        , axes(to)
        , distance_m(target_m)
        , field_of_view(field)
    {}
    // NOLINTNEXTLINE(google-explicit-constructor): every camera is at a pose
    CameraPose(const OrbitCamera& camera)
        : CameraPose(eyeOf(camera), axesOf(camera), camera.distance_m, camera.field_of_view)
    {}
};

/// Distance of the near plane as a fraction of the camera's distance. A 24-bit depth buffer then
/// still resolves a millionth of the distance at the target.
inline constexpr double kNearShare = 1.0 / 200.0;

/// The range of depths along the view direction that may contain geometry.
struct ClipRange {
    double near_m = 0.1;
    double far_m = 1.0;
};

/// 0 < near < far; encloses the part of `box` that is farther from the eye than 1/200 of the
/// camera's distance. Navigation keeps the terrain farther away than that.
ClipRange clipRange(const CameraPose& camera, const SceneBox& box);

/// Scene directions to eye directions: x right, y up, z backward. No translation: subtract the eye
/// first.
Matrix4 viewRotation(const CameraPose& camera);

/// OpenGL's perspective projection, depth -1 at near and 1 at far.
Matrix4 projection(const CameraPose& camera, const Viewport& viewport, const ClipRange& clip);

/// The ray from the eye through a position in the picture.
Ray pickRay(const CameraPose& camera, const Viewport& viewport, PixelPoint pixel);

/// The position of a point in the picture. Empty if it is not in front of the eye.
std::optional<PixelPoint>
project(const CameraPose& camera, const Viewport& viewport, const ScenePoint& point);

/// The width of a pixel in scene meters at the target and at another point, measured across the
/// view, so that tilt and exaggeration do not matter. Negative behind the eye.
double metersPerPixel(const CameraPose& camera, const Viewport& viewport);
double metersPerPixel(const CameraPose& camera, const Viewport& viewport, const ScenePoint& at);

} // namespace marsview
