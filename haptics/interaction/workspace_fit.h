// Moves the workspace slowly to where it covers what the view shows.
#pragma once

#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// Where the workspace covers what a camera sees.
struct WorkspaceFit {
    WorkspaceFrame seen;   // the frame that the camera follows, as it was for that camera
    WorkspaceFrame fitted; // the frame that fits
};

/// A hand in free space feels no force, whatever moves below it. Near the surface, where it may be
/// about to touch, the workspace moves slowly.
struct FitOptions {
    double speed_m_per_s = 0.015; // of the surface in the workspace, near it
    double octaves_per_s = 0.3;   // of the scale
    double turn_rad_per_s = 0.1;  // of a body
    /// Away from the surface, what is left of the way takes no longer than this at the present
    /// speed: a workspace that is 160 mm and one octave off has settled in less than 5 s where the
    /// hand is 60 mm above the ground.
    double settle_s = 1.0;
    /// Within the sum of both of the surface it slows down; where it brings the surface closer to
    /// the hand, it rests from the first on.
    double clearance_min_m = 0.003;
    double clearance_fade_m = 0.01;
};

/// The share that remains at that clearance: 0 to 1.
double fitShare(const FitOptions& options, double clearance_m) noexcept;

struct FitPace {
    double share = 1.0; // of the speed
    double haste = 0.0; // share of settle_s that applies: 0 to 1
};

/// `frame` after `dt_s` on its way to `fit`, for a hand in free space.
/// `seen` is the frame that the camera follows now. Returns `frame` if it fits. Servo thread.
WorkspaceFrame fitted(const FitOptions& options,
                      const WorkspaceFit& fit,
                      const WorkspaceFrame& frame,
                      const WorkspaceFrame& seen,
                      const WorkspacePoint& hand,
                      const FitPace& pace,
                      double dt_s) noexcept;

} // namespace marsview
