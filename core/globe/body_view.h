// What a picture of a body can show.
#pragma once

#include "core/geo/body.h"
#include "core/globe/horizon.h"
#include "core/view/camera.h"
#include "core/view/frustum.h"

namespace marsview {

/// The elevations of the terrain of a body, not exaggerated, and how they are drawn.
struct BodyRelief {
    double lowest_m = 0.0;
    double highest_m = 0.0;
    double exaggeration = 1.0;
};

/// A camera over a body with the bounds of its picture. A value.
class BodyView {
public:
    BodyView(const CameraPose& pose,
             const Viewport& viewport,
             const Ellipsoid& ellipsoid,
             const BodyRelief& relief);

    const CameraPose& pose() const noexcept { return pose_; }
    const Viewport& viewport() const noexcept { return viewport_; }
    const Ellipsoid& ellipsoid() const noexcept { return ellipsoid_; }
    const BodyRelief& relief() const noexcept { return relief_; }
    const Horizon& horizon() const noexcept { return horizon_; }

    bool isBehindHorizon(const ScenePoint& point) const noexcept
    {
        return horizon_.hides(point, pose_.eye);
    }
    /// Nothing within a distance of a point is in the picture. May be false for what is outside
    /// near the edges.
    bool isOutOfSight(const ScenePoint& middle, double reach_m) const noexcept;
    /// The same for a line on the terrain between two points, of at most a tenth of a turn: its
    /// terrain leaves the chord by at most the relief, and by a slope of 45° before it is
    /// exaggerated.
    bool isOutOfSight(const ScenePoint& from, const ScenePoint& to, double length_m) const noexcept;

private:
    CameraPose pose_;
    Viewport viewport_;
    Ellipsoid ellipsoid_;
    BodyRelief relief_;
    Frustum frustum_;
    Horizon horizon_;
};

} // namespace marsview
