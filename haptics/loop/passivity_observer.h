// Time-domain passivity: what is felt must not give the hand more energy than the hand put in.
//
// After B. Hannaford and J.-H. Ryu, Time-domain passivity control of haptic interfaces, IEEE Trans.
// Robotics and Automation 18 (2002): the energy at the port is observed, and where it has become
// negative, as much damping as takes the surplus out is added to the force.
#pragma once

#include "core/base/vec.h"

namespace marsview {

struct PassivityOptions {
    /// Damping is only stable itself up to what the device and the delay allow.
    double damping_n_s_per_m_max = 3.0;
    /// Energy that was put in long ago must not pay for an oscillation now: what has been gathered
    /// is forgotten beyond this, and at once where nothing is felt.
    double energy_j_max = 2e-3;
    /// The hand's velocity is what remains of its positions below this frequency: encoders have
    /// steps.
    double velocity_hz = 60.0;
};

struct PassivityState {
    double energy_j = 0.0; // that the hand has put in, less what it was given
    Vec3 velocity_m_per_s{};
    Vec3 last_force_n{}; // that acted until now
};

struct PassivityStep {
    Vec3 force_n{};                 // with the damping
    double damping_n_s_per_m = 0.0; // 0 nearly always
};

/// `shift_m` is the hand's way since the last call, during which the force that was written then
/// acted; `force_n` is what is wanted now. Where `dt_s` is 0 or no number, the force passes as it
/// is.
PassivityStep keepPassive(const PassivityOptions& options,
                          const Vec3& force_n,
                          const Vec3& shift_m,
                          PassivityState& state,
                          double dt_s) noexcept;

/// What was written in the end, after the limiter.
void noteWritten(PassivityState& state, const Vec3& force_n) noexcept;

} // namespace marsview
