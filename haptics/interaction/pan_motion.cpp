#include "haptics/interaction/pan_motion.h"

#include <algorithm>

namespace marsview {
namespace {

Vec3 level(const Vec3& v) noexcept
{
    return {v.x, v.y, 0.0};
}

Vec3 bounded(const Vec3& v, double length_max) noexcept
{
    const double l = length(v);
    return l > length_max ? v * (length_max / l) : v;
}

} // namespace

void grabMap(const PanOptions& options,
             PanState& state,
             const Vec3& force_n,
             const Vec3& hand_m_per_s) noexcept
{
    const Vec3 damping_n = (level(hand_m_per_s) - state.velocity_m_per_s) * options.grip_n_s_per_m;
    state.stretch_m = (level(force_n) + damping_n) * (-1.0 / options.grip_n_per_m);
    state.force_n_max = length(level(force_n));
}

// With m the mass, k and b the hold's spring and damper, c the drag, s the stretch and v' the map's
// velocity after the step:
//   m (v' - v) / dt = F - m c v',   F = k (s + hand_shift - v' dt) + b (hand_shift / dt - v')
PanStep pullMap(const PanOptions& options,
                PanState& state,
                const Vec3& hand_shift,
                double mass_share,
                double dt_s) noexcept
{
    if (!(dt_s > 0.0)) {
        return {.shift_m = {}, .force_n = state.stretch_m * -options.grip_n_per_m};
    }
    const double mass_kg = options.mass_kg * std::clamp(mass_share, 0.0, 1.0);
    const double k = options.grip_n_per_m;
    const double b = options.grip_n_s_per_m;
    const Vec3 hand_m_per_s = level(hand_shift) * (1.0 / dt_s);
    const Vec3 stretch_m = state.stretch_m + level(hand_shift);
    const double mass_rate = mass_kg / dt_s;
    const Vec3 before_m_per_s = state.velocity_m_per_s;
    const Vec3 driving_n = before_m_per_s * mass_rate + stretch_m * k + hand_m_per_s * b;
    state.velocity_m_per_s =
        driving_n * (1.0 / (mass_rate + mass_kg * options.drag_per_s + k * dt_s + b));
    PanStep step;
    step.shift_m = state.velocity_m_per_s * dt_s;
    state.stretch_m = stretch_m - step.shift_m;
    step.force_n = -(state.stretch_m * k + (hand_m_per_s - state.velocity_m_per_s) * b);
    if (length(step.force_n) > state.force_n_max && mass_rate > 0.0) {
        // The same equation for v' with the force that the hold can exert; the stretch is then what
        // is left of it.
        step.force_n = bounded(step.force_n, state.force_n_max);
        state.velocity_m_per_s = (before_m_per_s * mass_rate - step.force_n) *
                                 (1.0 / (mass_rate + mass_kg * options.drag_per_s));
        step.shift_m = state.velocity_m_per_s * dt_s;
        state.stretch_m = (step.force_n + (hand_m_per_s - state.velocity_m_per_s) * b) * (-1.0 / k);
    }
    state.force_n_max += options.grip_rate_n_per_s_max * dt_s;
    return step;
}

void stopMap(PanState& state, const Vec3& shift, double hold_share) noexcept
{
    const Vec3 way = level(shift);
    const double square = dot(way, way);
    const double along = dot(state.velocity_m_per_s, way);
    if (square > 0.0 && along < 0.0) {
        state.velocity_m_per_s = state.velocity_m_per_s - way * (along / square);
    }
    state.stretch_m = state.stretch_m - way * hold_share;
}

PanStep
glideMap(const PanOptions& options, PanState& state, double mass_share, double dt_s) noexcept
{
    state.stretch_m = {};
    if (!(mass_share > 0.0)) {
        state.velocity_m_per_s = {};
    }
    if (!(dt_s > 0.0)) {
        return {};
    }
    state.velocity_m_per_s = bounded(state.velocity_m_per_s, options.speed_m_per_s_max) *
                             (1.0 / (1.0 + options.drag_per_s * dt_s));
    constexpr double kRestMPerS = 1e-4;
    if (length(state.velocity_m_per_s) < kRestMPerS) {
        state.velocity_m_per_s = {};
    }
    return {.shift_m = state.velocity_m_per_s * dt_s, .force_n = {}};
}

} // namespace marsview
