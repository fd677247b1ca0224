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
                      const FitPace& pace,
                      double dt_s) noexcept
{
    if (!(pace.share > 0.0) || !(dt_s > 0.0)) {
        return frame;
    }
    // The camera has moved since; the workspace moves with it.
    const WorkspaceFrame goal = fit.fitted.moved(fit.seen, seen);
    constexpr double kNearM = 2e-5;
    constexpr double kNearOctaves = 1e-4;
    const double octaves = std::log2(goal.scene_per_meter / frame.scene_per_meter);
    const double hurry_per_s = std::clamp(pace.haste, 0.0, 1.0) / options.settle_s;
    const Vec3 turn = goal.body_axes && frame.body_axes
                          ? (*goal.body_axes * frame.body_axes->inverse()).turn()
                          : Vec3{};
    const double turn_rad = length(turn);
    constexpr double kNearRad = 1e-5;
    const double octaves_max =
        std::max(options.octaves_per_s, std::abs(octaves) * hurry_per_s) * pace.share * dt_s;
    const double step = std::clamp(octaves, -octaves_max, octaves_max);
    const Vec3 way = goal.toWorkspace(frame.toScene(hand)) - hand;
    const double way_m = length(way);
    if (std::abs(octaves) < kNearOctaves && way_m < kNearM && turn_rad < kNearRad) {
        return frame;
    }
    const double speed = std::max(options.speed_m_per_s, way_m * hurry_per_s);
    const double shift_m = std::min(way_m, speed * pace.share * dt_s);
    WorkspaceFrame next =
        frame.zoomed(hand, std::exp2(-step)).panned(way_m > 0.0 ? way * (shift_m / way_m) : Vec3{});
    if (turn_rad > 0.0) {
        const double turn_max =
            std::max(options.turn_rad_per_s, turn_rad * hurry_per_s) * pace.share * dt_s;
        next = {.anchor = hand,
                .place = next.toScene(hand),
                .scene_per_meter = next.scene_per_meter,
                .body_axes =
                    (Rotation::by(turn * std::min(1.0, turn_max / turn_rad)) * *next.body_axes)
                        .orthonormal()};
    }
    return next.isSound() ? next : frame;
}

} // namespace marsview
