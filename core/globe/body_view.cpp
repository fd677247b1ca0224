#include "core/globe/body_view.h"

#include <algorithm>

namespace marsview {

BodyView::BodyView(const CameraPose& pose,
                   const Viewport& viewport,
                   const Ellipsoid& ellipsoid,
                   const BodyRelief& relief)
    : pose_(pose)
    , viewport_(viewport)
    , ellipsoid_(ellipsoid)
    , relief_(relief)
    , frustum_(pose, viewport)
    , horizon_(ellipsoid, relief.lowest_m * relief.exaggeration)
{}

bool BodyView::isOutOfSight(const ScenePoint& middle, double reach_m) const noexcept
{
    const OrientedBox box{.center = middle,
                          .axes = {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                          .half_m = {reach_m, reach_m, reach_m}};
    return frustum_.isOutside(box) || horizon_.hides(box, pose_.eye);
}

bool BodyView::isOutOfSight(const ScenePoint& from,
                            const ScenePoint& to,
                            double length_m) const noexcept
{
    constexpr double kArc = 1.1; // of a chord
    const double half_m = 0.5 * std::max(length_m, kArc * length(to - from));
    const double relief_m = std::min(relief_.highest_m - relief_.lowest_m, half_m);
    return isOutOfSight((from + to) * 0.5, half_m + relief_m * relief_.exaggeration);
}

} // namespace marsview
