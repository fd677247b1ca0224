// The modes of the paper's section 4.2 at a device: what a grab does to the map and to the hand.
#pragma once

#include "haptics/interaction/mouse_stylus.h"
#include "haptics/interaction/pan_motion.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/interaction/zoom_detents.h"

namespace marsview {

struct ModeOptions {
    PanOptions pan;
    ZoomOptions zoom;
    double scene_per_metre_min = 1e-3; // how far zooms go
    double scene_per_metre_max = 1e9;
};

/// Between two moments.
struct ModeInput {
    WorkspacePoint hand{};       // now
    Vec3 hand_shift{};           // since the last time
    double twist_change_rad = 0; // of the stylus; counter-clockwise seen from above
    bool is_grabbing = false;
    bool is_in_contact = false;
    double free_share = 1.0;       // 0 at a wall: WallContact::ground_share
    double stiffness_n_per_m = 0.; // of holds
    WorkspaceFrame frame;
};

struct ModeState {
    StylusMode mode = StylusMode::Hover;
    PanState pan;
    WorkspacePoint grabbed{}; // where the hand was when it grabbed
};

struct ModeStep {
    WorkspaceFrame frame;
    Vec3 force_n{};                // of the mode; 0 unless it grabs
    bool has_changed_mode = false; // in what is felt: hovering and pressing are one
    bool has_moved_map = false;    // pulled, gliding, zoomed or turned
};

/// Whether the mode is one that holds the map: the ground is not felt meanwhile.
constexpr bool isHolding(StylusMode mode) noexcept
{
    return mode == StylusMode::Pan || mode == StylusMode::Zoom;
}

/// Pan: the map follows with inertia, the height is held. Zoom: height zooms about the hand, with
/// detents, twisting turns, the place is held. Otherwise a map that has been let go glides on. The
/// forces of a mode are along different axes, so they are added; what would be along a wall's fades
/// out before the wall (`free_share`). Servo thread.
ModeStep stepModes(const ModeOptions& options,
                   const ModeInput& input,
                   ModeState& state,
                   double dt_s) noexcept;

} // namespace marsview
