// Moves the workspace slowly to where it covers what the view shows.
#pragma once

#include "haptics/interaction/workspace_frame.h"

namespace marsview {

/// Where the workspace covers what a camera sees.
struct WorkspaceFit {
    WorkspaceFrame seen;   // the frame that the camera follows, as it was for that camera
    WorkspaceFrame fitted; // the frame that fits
};

/// A hand in free space feels no force; this is slow enough not to lead it astray.
struct FitOptions {
    double speed_m_per_s = 0.015; // of the surface in the workspace
    double octaves_per_s = 0.3;   // of the scale
    /// Where it brings the surface closer to the hand, it slows down from the sum of both on, and
    /// rests from the first on.
    double clearance_min_m = 0.003;
    double clearance_fade_m = 0.01;
};

/// The share of the speed that remains at that clearance: 0 to 1.
double fitShare(const FitOptions& options, double clearance_m) noexcept;

/// `frame` after `dt_s` on its way to `fit`, at a share of the speed, for a hand in free space.
/// `seen` is the frame that the camera follows now. Returns `frame` if it fits. Servo thread.
WorkspaceFrame fitted(const FitOptions& options,
                      const WorkspaceFit& fit,
                      const WorkspaceFrame& frame,
                      const WorkspaceFrame& seen,
                      const WorkspacePoint& hand,
                      double share,
                      double dt_s) noexcept;

} // namespace marsview
