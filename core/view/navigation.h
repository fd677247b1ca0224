// Camera navigation: pure functions from one camera to the next.
//
// None of them keeps the camera within the limits; call constrained() once at the end.
#pragma once

#include "core/geo/georeference.h"
#include "core/view/camera.h"
#include "core/view/scene_box.h"

#include <functional>
#include <optional>
#include <span>

namespace marsview {

/// Height of the terrain in scene meters (exaggerated) at a scene position; NaN without terrain.
using GroundQuery = std::function<double(double east_m, double north_m)>;

inline constexpr Angle kTiltMax = Angle::degrees(85.0);

/// Minimum height of the eye above the terrain as a fraction of its distance: four times that of
/// the near plane, so that the near plane does not clip the terrain.
inline constexpr double kClearanceShare = 1.0 / 50.0;

/// The lowest position in the picture of the terrain under a target in the air, between the middle
/// (0) and the lower edge (1).
inline constexpr double kGroundLowest = 0.75;

/// Of the first view: its size over that of what it shows, and its tilt.
inline constexpr double kHomeMargin = 1.04;
inline constexpr Angle kHomeTilt = Angle::degrees(40.0);
inline constexpr Angle kFillingTiltMin = Angle::degrees(20.0);
inline constexpr Angle kFillingTiltMax = Angle::degrees(50.0);

/// The limits of the camera.
struct NavigationLimits {
    SceneBox box{};
    double distance_min_m = 1.0;
    double distance_max_m = 1e9;
};

/// From two pixels of the raster to four times the box's diagonal.
NavigationLimits navigationLimits(const SceneBox& box, double pixel_m);

/// The camera within the limits: target inside the box, distance within the limits, tilt in [0,
/// 85°], azimuth in [-180°, 180°], and the eye at least 1/50 of its distance above the terrain
/// under it. Some terrain is in the picture: under the target, whose height is limited so that this
/// terrain does not leave the picture at the bottom, or nearby. An eye that is too low rises with
/// the target up to that limit, then by reducing the tilt. A target far from any terrain moves to
/// the nearest.
OrbitCamera
constrained(OrbitCamera camera, const NavigationLimits& limits, const GroundQuery& ground);

/// Rotates the camera around the target.
OrbitCamera orbited(OrbitCamera camera, Angle azimuth_change, Angle tilt_change);

/// Zooms in (factor < 1) or out with `anchor` fixed in the picture. The limits of distance bound
/// the factor.
OrbitCamera
zoomed(OrbitCamera camera, double factor, const ScenePoint& anchor, const NavigationLimits& limits);

/// The anchor of a zoom if the ray through the pointer hits nothing: the point at the level of the
/// target, at most two camera distances away, or the target if the ray does not go down. Zooming
/// about a point in the sky would push the eye into the terrain.
ScenePoint anchorBesideMap(const OrbitCamera& camera, const Ray& ray);

/// A drag over the picture.
struct Drag {
    PixelPoint from{};
    PixelPoint to{};
    double grabbed_z_m = 0.0; // scene height of the grabbed point
};

/// Moves horizontally so that the grabbed point follows the pointer. Near the horizon the motion is
/// limited to a few camera distances.
OrbitCamera dragged(OrbitCamera camera, const Viewport& viewport, const Drag& drag);

/// Moves horizontally by fractions of the camera's distance: to the right and away from the viewer.
OrbitCamera panned(OrbitCamera camera, double right_share, double forward_share);

/// The same picture, with the target on the view axis at `distance_m` from the eye.
OrbitCamera retargeted(OrbitCamera camera, double distance_m);

/// Shows the whole box from the south at a tilt of 40°. constrained() does not change it unless the
/// box is many times as high as wide.
OrbitCamera
homeCamera(const SceneBox& box, const Viewport& viewport, Angle field_of_view = Angle::degrees(40));

/// The same from any direction.
struct ViewDirection {
    Angle azimuth{};
    Angle tilt = kHomeTilt;
};
OrbitCamera homeCamera(const SceneBox& box, const Viewport& viewport, const ViewDirection& from);

/// Shows all of the boxes, parts of a map, from the south: as large as the picture has room for, at
/// the tilt between 20° and 50° at which they fill it best. `boxes` must not be empty.
OrbitCamera fillingCamera(std::span<const SceneBox> boxes,
                          const Viewport& viewport,
                          Angle field_of_view = Angle::degrees(40));

/// A first view of a map around its body, oblique and filled by the map: on Mars, Tharsis and
/// Valles Marineris from the southeast, otherwise its middle from the south. Empty for other maps.
std::optional<OrbitCamera> openingCamera(const Georeference& georeference);
/// Whether that view shows a particular place rather than the middle of the map.
bool hasOpeningPlace(const Georeference& georeference);

/// The intersection of a ray with the level z = `level_m`, at most `distance_max_m` away; the point
/// at that distance if there is none in front of the origin.
ScenePoint pointOnLevel(const Ray& ray, double level_m, double distance_max_m);

/// Between two cameras, t in [0, 1]. Distance changes by equal factors in equal times, and the
/// target moves in proportion, so a zoom to a point keeps that point fixed throughout; azimuth
/// takes the shorter direction.
OrbitCamera interpolated(const OrbitCamera& from, const OrbitCamera& to, double t);

} // namespace marsview
