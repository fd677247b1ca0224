// Navigation over a body: pure functions from one camera to the next.
//
// None of them keeps the camera within the limits; call constrained() once at the end.
#pragma once

#include "core/body/body_grid.h"
#include "core/globe/body_camera.h"

#include <functional>
#include <span>
#include <vector>

namespace marsview {

/// The exaggerated height in meters of the terrain at a place; NaN without terrain.
using BodyGround = std::function<double(const GeographicPoint&)>;

/// The part of a body that terrain covers: all places within an angle from the middle, seen from
/// the body's center.
struct BodyArea {
    GeographicPoint middle{};
    Angle reach = Angle::degrees(180.0);
};

/// Around all samples of a map. For a map of the whole body, the middle is at 0°, 0°.
BodyArea areaOf(const BodyGrid& grid);

/// The limits of the camera. Heights are exaggerated.
struct BodyLimits {
    Ellipsoid ellipsoid;
    BodyArea area;
    double lowest_m = 0.0;
    double highest_m = 0.0;
    double distance_min_m = 1.0;
    double distance_max_m = 1e9;
};

/// From two cells to where the whole area is small.
BodyLimits bodyLimits(const BodyGrid& grid, double lowest_m, double highest_m);

/// For several maps of one body: around all of both areas, as near as the finer one allows.
BodyLimits united(const BodyLimits& a, const BodyLimits& b);

/// The camera within the limits: target in the area, distance and tilt (0 to 85°) limited, azimuth
/// in [-180°, 180°], longitude likewise, the eye at least 1/50 of its distance above the terrain
/// under it. The target is at most so high above the terrain under it that this terrain does not
/// leave the picture at the bottom. An eye that is too low rises with the target up to that limit,
/// then by reducing the tilt.
BodyCamera constrained(BodyCamera camera, const BodyLimits& limits, const BodyGround& ground);

/// The camera with its tilt reduced, as far as needed and possible, so that the horizon is in the
/// upper tenth of the picture or above it: a flat map has no horizon, and its camera may see the
/// ground up to the upper edge of the picture. On the sphere through the target.
BodyCamera withGroundAhead(BodyCamera camera, const Ellipsoid& ellipsoid);

/// Places all over a map, its corners included, at the lowest and the highest exaggerated height.
std::vector<ScenePoint> placesOver(const BodyGrid& grid, double lowest_m, double highest_m);

/// From the side of `camera`, at the least distance from its target from where all of `places` are
/// in the picture with some margin. `places` must not be empty.
BodyCamera framed(BodyCamera camera,
                  std::span<const ScenePoint> places,
                  const Viewport& viewport,
                  const Ellipsoid& ellipsoid);

/// Whether an area is looked at as a ball, from straight above.
bool isBall(const BodyArea& area);

/// Shows the whole area: from straight above if it is most of the body, otherwise from the south
/// at a tilt of 40°.
BodyCamera homeCamera(const BodyLimits& limits,
                      const Viewport& viewport,
                      Angle field_of_view = Angle::degrees(40));
/// The same as near as `places`, which are in the area, allow.
BodyCamera
homeCamera(const BodyLimits& limits, std::span<const ScenePoint> places, const Viewport& viewport);

} // namespace marsview
