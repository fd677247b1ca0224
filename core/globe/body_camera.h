// The camera over a body.
#pragma once

#include "core/geo/body.h"
#include "core/geo/frames.h"
#include "core/view/camera.h"

#include <variant>

namespace marsview {

/// A camera at a distance from a target over or under the ellipsoid. North is up where it looks;
/// azimuth and tilt are measured at the target.
struct BodyCamera {
    GeographicPoint target{};                   // of the foot point on the ellipsoid
    double height_m = 0.0;                      // of the target, exaggerated
    double distance_m = 1.0;                    // > 0
    Angle azimuth{};                            // the heading, clockwise from north
    Angle tilt{};                               // 0 looks straight down, 90° along the horizon
    Angle field_of_view = Angle::degrees(40.0); // vertical

    bool operator==(const BodyCamera&) const = default;
};

/// The camera of a flat map or of a body.
using SceneCamera = std::variant<OrbitCamera, BodyCamera>;

/// Unit vectors at a place on an ellipsoid, in the body-fixed frame. At a pole, as for the place's
/// longitude.
struct LocalAxes {
    Vec3 east;
    Vec3 north;
    Vec3 up;
};

LocalAxes localAxes(const Ellipsoid& ellipsoid, const GeographicPoint& place);

/// In the body-fixed frame, in meters.
ScenePoint targetOf(const BodyCamera& camera, const Ellipsoid& ellipsoid);
CameraPose poseOf(const BodyCamera& camera, const Ellipsoid& ellipsoid);

/// The place of a point in the body-fixed frame: the foot of its normal, longitude in [-180°,
/// 180°], and the height there. Rounding errors only.
struct BodyPlace {
    GeographicPoint foot;
    double height_m = 0.0;
};
BodyPlace placeOf(const ScenePoint& point, const Ellipsoid& ellipsoid);

/// The depths between which terrain between two exaggerated heights can be seen.
ClipRange bodyClipRange(const CameraPose& pose,
                        const Ellipsoid& ellipsoid,
                        double lowest_m,
                        double highest_m);

} // namespace marsview
