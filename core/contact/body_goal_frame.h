// Goals and proxies in longitude, latitude and elevation, as in files, and in the body-fixed frame.
#pragma once

#include "core/contact/goal_frame.h"
#include "core/geo/body.h"

namespace marsview {

/// Converts between the two for a map on its body. A goal's x and y are east longitude and
/// planetocentric latitude, in degrees, of its foot point on the raster's ellipsoid, and z is the
/// elevation along the normal there, in meters, not exaggerated. A value; any thread, the servo
/// thread included. Converting to a file uses GeographicLib (C. F. F. Karney's inversion, error
/// below 1e-8 m).
class BodyGoalFrame {
public:
    /// Longitudes in files are within half a turn of `middle_longitude`. Radii are > 0.
    BodyGoalFrame(const Ellipsoid& ellipsoid, double exaggeration, Angle middle_longitude);

    /// Not finite if the latitude is beyond ±90° or the goal is not finite.
    ScenePoint toScene(const TracePoint& goal) const noexcept;
    TracePoint fromScene(const ScenePoint& point) const noexcept;

    const Ellipsoid& ellipsoid() const noexcept { return ellipsoid_; }
    double exaggeration() const noexcept { return exaggeration_; }

private:
    Ellipsoid ellipsoid_;
    double exaggeration_;
    double middle_deg_;
};

/// For a map that lies on `ellipsoid`: longitudes are those around the middle of its grid.
BodyGoalFrame
bodyGoalFrame(const Georeference& map, const Ellipsoid& ellipsoid, double exaggeration);

} // namespace marsview
