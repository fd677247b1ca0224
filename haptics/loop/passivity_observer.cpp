#include "haptics/loop/passivity_observer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {

PassivityStep keepPassive(const PassivityOptions& options,
                          const Vec3& force_n,
                          const Vec3& shift_m,
                          PassivityState& state,
                          double dt_s) noexcept
{
    if (!(dt_s > 0.0) || !std::isfinite(dt_s)) {
        return {.force_n = force_n};
    }
    const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * options.velocity_hz * dt_s);
    state.velocity_m_per_s =
        state.velocity_m_per_s + (shift_m * (1.0 / dt_s) - state.velocity_m_per_s) * share;
    state.energy_j -= dot(state.last_force_n, shift_m);
    if (force_n == Vec3{} && state.last_force_n == Vec3{}) {
        state.energy_j = 0.0;
    }
    if (!std::isfinite(state.energy_j)) {
        state = {};
        return {.force_n = force_n};
    }
    state.energy_j = std::clamp(state.energy_j, -options.energy_j_max, options.energy_j_max);
    const double speed_squared = dot(state.velocity_m_per_s, state.velocity_m_per_s);
    if (state.energy_j >= 0.0 || force_n == Vec3{} || !(speed_squared > 0.0)) {
        return {.force_n = force_n};
    }
    const double damping =
        std::min(-state.energy_j / (speed_squared * dt_s), options.damping_n_s_per_m_max);
    return {.force_n = force_n - state.velocity_m_per_s * damping, .damping_n_s_per_m = damping};
}

void noteWritten(PassivityState& state, const Vec3& force_n) noexcept
{
    state.last_force_n = force_n;
}

} // namespace marsview
