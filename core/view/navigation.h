// Moving the camera: pure functions from one camera to the next.
//
// None of them keeps the camera in bounds on its own; constrained() does that, once, at the end.
#pragma once

#include "core/geo/georeference.h"
#include "core/view/camera.h"
#include "core/view/scene_box.h"

#include <functional>
#include <optional>

namespace marsview {

/// Height of the ground in scene metres (exaggerated) at a scene position; NaN where there is none.
using GroundQuery = std::function<double(double east_m, double north_m)>;

/// How far the camera may go.
struct NavigationLimits {
    SceneBox box{};
    double distance_min_m = 1.0;
    double distance_max_m = 1e9;
};

/// From two pixels of the raster to four times the box's diagonal.
NavigationLimits navigationLimits(const SceneBox& box, double pixel_m);

/// The camera within bounds: target inside the box, distance within the limits, tilt in [0, 85°],
/// azimuth in [-180°, 180°], and the eye at least 1/50 of its distance above the ground under it.
/// Some ground is in the picture: under the target, which is not so high over it that it would
/// leave the picture at the bottom, or near by. An eye that is too low rises with the target only
/// so far, then by less tilt; a target far from any ground goes to the nearest.
OrbitCamera
constrained(OrbitCamera camera, const NavigationLimits& limits, const GroundQuery& ground);

/// Turned around the target.
OrbitCamera orbited(OrbitCamera camera, Angle azimuth_change, Angle tilt_change);

/// Brought nearer (factor < 1) or further, so that `anchor` stays where it is in the picture. The
/// factor gives way to the limits of distance.
OrbitCamera
zoomed(OrbitCamera camera, double factor, const ScenePoint& anchor, const NavigationLimits& limits);

/// What a zoom holds in its place where the ray through the pointer hits nothing: what is level
/// with the target, at most two camera distances away, or the target where the ray does not go
/// down. To shrink the picture towards a point of the sky would press the eye into the ground.
ScenePoint anchorBesideMap(const OrbitCamera& camera, const Ray& ray);

/// A drag over the picture.
struct Drag {
    PixelPoint from{};
    PixelPoint to{};
    double grabbed_z_m = 0.0; // scene height of what was grabbed
};

/// Moved level so that what was grabbed follows the pointer. Near the horizon the motion is bounded
/// to a few camera distances.
OrbitCamera dragged(OrbitCamera camera, const Viewport& viewport, const Drag& drag);

/// Moved level by fractions of the camera's distance: to the right and away from the viewer.
OrbitCamera panned(OrbitCamera camera, double right_share, double forward_share);

/// The same picture, turned about a point of the view axis at `distance_m` from the eye.
OrbitCamera retargeted(OrbitCamera camera, double distance_m);

/// The whole box in the picture, seen from the south at 40° from straight down. constrained()
/// leaves it alone unless the box is many times as high as wide.
OrbitCamera
homeCamera(const SceneBox& box, const Viewport& viewport, Angle field_of_view = Angle::degrees(40));

/// A sight worth opening with: Tharsis and Valles Marineris from the south-east where the map is
/// one of all Mars. Nothing for other maps.
std::optional<OrbitCamera> openingCamera(const Georeference& georeference);

/// Where a ray meets the level z = `level_m`, at most `distance_max_m` away; at that distance where
/// it does not meet it in front of the origin.
ScenePoint pointOnLevel(const Ray& ray, double level_m, double distance_max_m);

/// Between two cameras, t in [0, 1]. Distance changes by equal factors in equal times and the
/// target in step with it, so a zoom to a point keeps that point fixed all the way; azimuth takes
/// the shorter way round.
OrbitCamera interpolated(const OrbitCamera& from, const OrbitCamera& to, double t);

} // namespace marsview
