// Time-domain passivity: the rendered force must not give the hand more energy than the hand put
// in.
//
// After B. Hannaford and J.-H. Ryu, Time-domain passivity control of haptic interfaces, IEEE Trans.
// Robotics and Automation 18 (2002): the energy at the port is observed, and when it becomes
// negative, damping that dissipates the surplus is added to the force.
#pragma once

#include "core/base/vec.h"

namespace marsview {

struct PassivityOptions {
    /// Damping itself is stable only up to a limit that depends on the device and the delay.
    double damping_n_s_per_m_max = 3.0;
    /// Energy put in long ago must not cancel out a current oscillation: beyond what springs and
    /// masses hold, energy is capped at this value, and it is reset when nothing is touched.
    double energy_j_max = 2e-3;
    /// Neither must a surplus from long ago, as from a force that has ramped in, be damped in a
    /// later motion: it is forgotten with this time constant. An oscillation renews it in every
    /// period.
    double surplus_s = 0.1;
    /// Cutoff frequency of the low-pass filter for the hand's velocity: encoder positions are
    /// quantized.
    double velocity_hz = 60.0;
};

struct PassivityState {
    double energy_j = 0.0; // put in by the hand, minus the energy returned
    Vec3 velocity_m_per_s{};
    Vec3 last_force_n{}; // acted until now
};

struct PassivityInput {
    Vec3 force_n{};        // requested
    Vec3 shift_m{};        // of the hand since the last call, during which the last force acted
    double stored_j = 0.0; // in springs and masses, which may return it
};

struct PassivityStep {
    Vec3 force_n{};                 // with the damping
    double damping_n_s_per_m = 0.0; // usually 0
};

/// The damping weakens a force along which the hand moves, down to zero: a hand that leaves or
/// slides over a surface is not held back. If `dt_s` is 0 or NaN, the force is returned unchanged.
PassivityStep keepPassive(const PassivityOptions& options,
                          const PassivityInput& input,
                          PassivityState& state,
                          double dt_s) noexcept;

/// Records the force that was written, after the limiter.
void noteWritten(PassivityState& state, const Vec3& force_n) noexcept;

} // namespace marsview
