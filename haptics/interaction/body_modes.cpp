#include "haptics/interaction/body_modes.h"

#include "core/body/body_positions.h"

#include <cmath>

namespace marsview {
namespace {

Vec3 horizontal(const Vec3& v) noexcept
{
    return {v.x, v.y, 0.0};
}

// Nearer to the center than this share of the radius, a hand can roll nothing.
constexpr double kLeverMin = 0.1;

Vec3 turnOf(const Vec3& lever, const Vec3& shift, double lever_min) noexcept
{
    const double square = dot(lever, lever);
    return square > lever_min * lever_min ? cross(lever, shift) * (1.0 / square) : Vec3{};
}

// A frame over the level axes at the hand, whose scene begins at the hand, as a frame on the body.
// In its own workspace the hand is at `leveled_hand`.
WorkspaceFrame onBody(const WorkspaceFrame& leveled,
                      const WorkspacePoint& leveled_hand,
                      const WorkspaceFrame& before,
                      const WorkspacePoint& hand,
                      const Rotation& level) noexcept
{
    const Rotation to_body = *before.body_axes * level.inverse();
    const Rotation turn = Rotation::by({0.0, 0.0, leveled.turn.radians()});
    return {.anchor = hand,
            .place = before.toScene(hand) + to_body * leveled.toScene(leveled_hand),
            .scene_per_meter = leveled.scene_per_meter,
            .body_axes = (to_body * turn * level).orthonormal()};
}

} // namespace

WorkspaceFrame rolled(const WorkspaceFrame& frame,
                      const Ellipsoid& body,
                      const WorkspacePoint& hand,
                      const Vec3& turn_rad) noexcept
{
    const BodyVertical before = verticalAt(body, frame.toScene(hand));
    const Vec3 up = frame.body_axes->inverse() * before.up;
    const Rotation turned = *frame.body_axes * Rotation::by(-turn_rad);
    const ScenePoint there =
        turned * frame.body_axes->inverse() * frame.toScene(hand); // the center stays
    const BodyVertical after = verticalAt(body, there);
    const Rotation leveled = Rotation::carrying(turned * up, after.up) * turned;
    return {.anchor = hand,
            .place = there + after.up * (before.height_m - after.height_m),
            .scene_per_meter = frame.scene_per_meter,
            .body_axes = leveled.orthonormal()};
}

// The modes of the plane work along the level axes at the hand.
ModeStep stepBodyModes(const ModeOptions& options,
                       const ModeInput& input,
                       const Ellipsoid& body,
                       ModeState& state,
                       BodyModeState& body_state,
                       double dt_s) noexcept
{
    const WorkspaceFrame& frame = input.frame;
    const ScenePoint at = frame.toScene(input.hand);
    const BodyVertical vertical = verticalAt(body, at);
    if (state.mode != StylusMode::Zoom) {
        const Rotation before = body_state.level;
        body_state.level =
            Rotation::carrying(frame.body_axes->inverse() * vertical.up, {0.0, 0.0, 1.0});
        state.pan.stretch_m =
            horizontal(body_state.level * (before.inverse() * state.pan.stretch_m));
    }
    const Rotation& level = body_state.level;
    const Rotation back = level.inverse();
    const Vec3 lever = frame.differenceToWorkspace(at - ScenePoint{});
    const double lever_min = kLeverMin * body.polar_m / frame.scene_per_meter;

    ModeInput leveled = input;
    const Vec3 hand = level * (input.hand - WorkspacePoint{});
    leveled.hand = {hand.x, hand.y, vertical.height_m / frame.scene_per_meter};
    leveled.hand_shift = level * input.hand_shift;
    leveled.surface_force_n = level * input.surface_force_n;
    leveled.frame = {.anchor = leveled.hand, .place = {}, .scene_per_meter = frame.scene_per_meter};
    const bool will_hold = isHolding(
        nextMode(state.mode, {.is_pressing = input.is_in_contact, .is_grabbing = input.is_grabbing},
                 input.is_in_contact));
    // A body that glides keeps its axis wherever the hand moves: only its speed counts.
    const double speed_m_per_s = length(body_state.spin_rad_per_s) * length(lever);
    state.pan.velocity_m_per_s = will_hold
                                     ? horizontal(level * cross(body_state.spin_rad_per_s, lever))
                                     : Vec3{speed_m_per_s, 0.0, 0.0};

    ModeStep step = stepModes(options, leveled, state, dt_s);
    step.force_n = back * step.force_n;
    const Vec3 velocity_m_per_s = state.pan.velocity_m_per_s;
    if (state.mode == StylusMode::Zoom) {
        body_state.spin_rad_per_s = {};
        const WorkspaceFrame seen_from =
            onBody(step.seen_from, leveled.hand, frame, input.hand, level);
        step.frame = onBody(step.frame, leveled.hand, frame, input.hand, level);
        step.seen_from = seen_from;
        return step;
    }
    if (state.mode == StylusMode::Pan) {
        body_state.spin_rad_per_s = turnOf(lever, back * velocity_m_per_s, lever_min);
    } else {
        body_state.spin_rad_per_s =
            body_state.spin_rad_per_s *
            (speed_m_per_s > 0.0 ? length(velocity_m_per_s) / speed_m_per_s : 0.0);
    }
    const Vec3 turn_rad = body_state.spin_rad_per_s * dt_s;
    step.has_moved_map = !(turn_rad == Vec3{});
    step.frame = step.has_moved_map ? rolled(frame, body, input.hand, turn_rad) : frame;
    step.seen_from = frame;
    return step;
}

} // namespace marsview
