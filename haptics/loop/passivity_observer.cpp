#include "haptics/loop/passivity_observer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {

PassivityStep keepPassive(const PassivityOptions& options,
                          const PassivityInput& input,
                          PassivityState& state,
                          double dt_s) noexcept
{
    const Vec3& force_n = input.force_n;
    const Vec3& shift_m = input.shift_m;
    if (!(dt_s > 0.0) || !std::isfinite(dt_s)) {
        return {.force_n = force_n};
    }
    const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * options.velocity_hz * dt_s);
    state.velocity_m_per_s =
        state.velocity_m_per_s + (shift_m * (1.0 / dt_s) - state.velocity_m_per_s) * share;
    if (state.energy_j < 0.0) {
        state.energy_j *= std::exp(-dt_s / std::max(options.surplus_s, 1e-3));
    }
    state.energy_j -= dot(state.last_force_n, shift_m);
    if (force_n == Vec3{} && state.last_force_n == Vec3{}) {
        state.energy_j = 0.0;
    }
    if (!std::isfinite(state.energy_j)) {
        state = {};
        return {.force_n = force_n};
    }
    const double stored_j = input.stored_j > 0.0 ? input.stored_j : 0.0; // also for NaN
    state.energy_j =
        std::clamp(state.energy_j, -options.energy_j_max, options.energy_j_max + stored_j);
    // Where the force gives energy, along the force alone, and no more than the force: damping
    // neither holds back a hand that leaves the surface, nor one that slides over it.
    const double size_n = length(force_n);
    const double speed = size_n > 0.0 ? dot(force_n, state.velocity_m_per_s) / size_n : 0.0;
    if (state.energy_j >= 0.0 || !(speed > 0.0)) {
        return {.force_n = force_n};
    }
    const double damping = std::min(
        {-state.energy_j / (speed * speed * dt_s), size_n / speed, options.damping_n_s_per_m_max});
    const double kept = std::max(1.0 - damping * speed / size_n, 0.0);
    return {.force_n = force_n * kept, .damping_n_s_per_m = damping};
}

void noteWritten(PassivityState& state, const Vec3& force_n) noexcept
{
    state.last_force_n = force_n;
}

} // namespace marsview
