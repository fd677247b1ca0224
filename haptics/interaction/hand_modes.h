// The modes of the paper's section 4.2 with a device: how a grab affects the map and the hand.
#pragma once

#include "haptics/interaction/mouse_stylus.h"
#include "haptics/interaction/pan_motion.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/interaction/zoom_detents.h"

namespace marsview {

struct ModeOptions {
    PanOptions pan;
    ZoomOptions zoom;
    double scene_per_meter_min = 1e-3; // zoom limits
    double scene_per_meter_max = 1e9;
};

/// The change between two ticks.
struct ModeInput {
    WorkspacePoint hand{};       // now
    Vec3 hand_shift{};           // since the last time
    double twist_change_rad = 0; // of the stylus; counterclockwise seen from above
    bool is_grabbing = false;
    bool is_in_contact = false;
    double free_share = 1.0;       // 0 at a wall: WallContact::ground_share
    double stiffness_n_per_m = 0.; // of holds
    Vec3 surface_force_n{};        // on the hand, while it does not hold
    /// Of the hand over the terrain straight below it in `frame`, in workspace meters.
    double clearance_m = 0.0;
    WorkspaceFrame frame;
};

struct ModeState {
    StylusMode mode = StylusMode::Hover;
    PanState pan;
    /// Rest position of the hold: a pan holds the touched point's height, at which the force of
    /// the surface continues.
    WorkspacePoint grabbed{};
    /// While zooming: of the hand over the nearest detent. At a limit of the zoom the detents go
    /// on, so that no force is left that pushes on.
    double above_detent_m = 0.0;
};

struct ModeStep {
    WorkspaceFrame frame;
    /// The frame from which the view follows to `frame`. A zoom lifts the surface in the workspace
    /// first, where the view does not follow: it zooms about the same point of the scene.
    WorkspaceFrame seen_from;
    Vec3 force_n{};                // of the mode; 0 unless it grabs
    bool has_changed_mode = false; // in the rendered force: hovering and pressing count as one
    bool has_moved_map = false;    // pulled, gliding, zoomed or turned
};

/// Above the surface, in the workspace: the height of the point about which a zoom magnifies. It is
/// less than the rise that doubles the zoom, divided by ln 2, so that the surface rises with the
/// hand.
inline constexpr double kZoomHeightM = 0.02;

/// Whether the mode holds the map: the surface force is then off.
constexpr bool isHolding(StylusMode mode) noexcept
{
    return mode == StylusMode::Pan || mode == StylusMode::Zoom;
}

/// Pan: the map follows with inertia, and the hand's height is held; at the grab the surface force
/// continues. Zoom: the hand carries the surface below it up and down, and its height zooms about a
/// point between the two, at most kZoomHeightM above the surface: a raised hand always raises the
/// surface, and the surface never passes the hand. With detents; twisting rotates the map, and the
/// horizontal position is held.
/// Otherwise a released map glides. The forces of a mode act along different axes, so they are
/// added; a force along a wall's axis fades out before the wall (`free_share`). Servo thread.
ModeStep stepModes(const ModeOptions& options,
                   const ModeInput& input,
                   ModeState& state,
                   double dt_s) noexcept;

} // namespace marsview
