#include "haptics/interaction/hand_modes.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

PanOptions heldPan(const ModeOptions& options, const ModeInput& input)
{
    PanOptions held = options.pan;
    held.grip_n_per_m = std::min(held.grip_n_per_m, std::max(input.stiffness_n_per_m, 1.0));
    return held;
}

// The surface force continues in the first step: the hold's spring has the stretch that it takes.
void grab(const ModeOptions& options, const ModeInput& input, ModeState& state, double dt_s)
{
    state.grabbed = input.hand;
    state.above_detent_m =
        aboveDetent(options.zoom, input.frame.scene_per_meter) - input.hand_shift.z;
    if (state.mode == StylusMode::Pan) {
        const Vec3 hand_m_per_s = dt_s > 0.0 ? input.hand_shift * (1.0 / dt_s) : Vec3{};
        const PanOptions held = heldPan(options, input);
        grabMap(held, state.pan, input.surface_force_n, hand_m_per_s);
        state.pan.stretch_m =
            state.pan.stretch_m - Vec3{input.hand_shift.x, input.hand_shift.y, 0.0};
        if (input.stiffness_n_per_m > 0.0) {
            state.grabbed.z += input.surface_force_n.z / input.stiffness_n_per_m;
        }
    }
}

ModeStep pan(const ModeOptions& options, const ModeInput& input, ModeState& state, double dt_s)
{
    const PanOptions held = heldPan(options, input);
    const PanStep moved = pullMap(held, state.pan, input.hand_shift, input.free_share, dt_s);
    Vec3 force_n = moved.force_n;
    force_n.z = -input.stiffness_n_per_m * (input.hand.z - state.grabbed.z);
    return {.frame = input.frame.panned(moved.shift_m),
            .seen_from = input.frame,
            .force_n = force_n,
            .has_moved_map = !(moved.shift_m == Vec3{})};
}

ModeStep zoom(const ModeOptions& options, const ModeInput& input, ModeState& state)
{
    const double scale = input.frame.scene_per_meter;
    const double wanted = scale / zoomFactor(options.zoom, input.hand_shift.z);
    const double next = std::clamp(wanted, std::min(scale, options.scene_per_meter_min),
                                   std::max(scale, options.scene_per_meter_max));
    const WorkspaceFrame lifted = input.frame.panned({0.0, 0.0, input.hand_shift.z});
    WorkspacePoint fixed = input.hand;
    fixed.z -= std::max(input.clearance_m - input.hand_shift.z - kZoomHeightM, 0.0);
    const WorkspaceFrame zoomed = lifted.zoomed(fixed, scale / next);
    state.above_detent_m =
        std::remainder(state.above_detent_m + input.hand_shift.z, detentStep(options.zoom));
    const double hold = input.stiffness_n_per_m * input.free_share;
    return {.frame = zoomed.turned(input.hand, Angle::radians(input.twist_change_rad)),
            .seen_from = lifted,
            .force_n = {-hold * (input.hand.x - state.grabbed.x),
                        -hold * (input.hand.y - state.grabbed.y),
                        detentForce(options.zoom, state.above_detent_m)},
            .has_moved_map = input.hand_shift.z != 0.0 || input.twist_change_rad != 0.0};
}

ModeStep glide(const ModeOptions& options, const ModeInput& input, ModeState& state, double dt_s)
{
    const PanStep moved = glideMap(options.pan, state.pan, input.free_share, dt_s);
    if (moved.shift_m == Vec3{}) {
        return {.frame = input.frame, .seen_from = input.frame};
    }
    return {.frame = input.frame.panned(moved.shift_m),
            .seen_from = input.frame,
            .has_moved_map = true};
}

} // namespace

ModeStep stepModes(const ModeOptions& options,
                   const ModeInput& input,
                   ModeState& state,
                   double dt_s) noexcept
{
    const StylusMode last = state.mode;
    state.mode =
        nextMode(last, {.is_pressing = input.is_in_contact, .is_grabbing = input.is_grabbing},
                 input.is_in_contact);
    const bool has_changed = state.mode != last && (isHolding(state.mode) || isHolding(last));
    if (has_changed && isHolding(state.mode)) {
        grab(options, input, state, dt_s);
    }
    if (state.mode == StylusMode::Zoom) {
        state.pan = {};
    }
    ModeStep step = state.mode == StylusMode::Pan    ? pan(options, input, state, dt_s)
                    : state.mode == StylusMode::Zoom ? zoom(options, input, state)
                                                     : glide(options, input, state, dt_s);
    step.has_changed_mode = has_changed;
    return step;
}

} // namespace marsview
