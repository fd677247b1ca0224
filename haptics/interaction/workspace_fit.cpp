#include "haptics/interaction/workspace_fit.h"

#include <algorithm>
#include <cmath>

namespace marsview {

double fitShare(const FitOptions& options, double clearance_m) noexcept
{
    const double share = (clearance_m - options.clearance_min_m) / options.clearance_fade_m;
    return share > 0.0 ? std::min(share, 1.0) : 0.0; // also for NaN
}

WorkspaceFrame fitted(const FitOptions& options,
                      const WorkspaceFit& fit,
                      const WorkspaceFrame& frame,
                      const WorkspaceFrame& seen,
                      const WorkspacePoint& hand,
                      double share,
                      double dt_s) noexcept
{
    if (!(share > 0.0) || !(dt_s > 0.0)) {
        return frame;
    }
    // The camera has moved since; the workspace moves with it.
    const WorkspaceFrame goal = fit.fitted.moved(fit.seen, seen);
    constexpr double kNearM = 2e-5;
    constexpr double kNearOctaves = 1e-4;
    const double octaves = std::log2(goal.scene_per_meter / frame.scene_per_meter);
    const double octaves_max = options.octaves_per_s * share * dt_s;
    const double step = std::clamp(octaves, -octaves_max, octaves_max);
    const Vec3 way = goal.toWorkspace(frame.toScene(hand)) - hand;
    const double way_m = length(way);
    if (std::abs(octaves) < kNearOctaves && way_m < kNearM) {
        return frame;
    }
    const double shift_m = std::min(way_m, options.speed_m_per_s * share * dt_s);
    const WorkspaceFrame next =
        frame.zoomed(hand, std::exp2(-step)).panned(way_m > 0.0 ? way * (shift_m / way_m) : Vec3{});
    return next.isSound() ? next : frame;
}

} // namespace marsview
