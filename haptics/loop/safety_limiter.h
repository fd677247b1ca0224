// The last stage before the motors. It does not trust its input: for any input, the force is
// finite, bounded, changes at a bounded rate, and goes to zero after an error.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <limits>
#include <string_view>

namespace marsview {

/// Why the force is off. If several reasons apply, the first in this order is reported.
enum class ForceOffReason : std::uint8_t {
    None,              // the force may be on
    EmergencyStop,     // requested by the user
    DeviceLost,        // unplugged or dead
    DeviceFinished,    // a recording has ended
    DeviceUnready,     // not calibrated, or its own stop is pressed
    DeviceStale,       // its sample is too old
    DeviceImplausible, // implausible reading: not finite, out of reach, or too fast
    NotHeld,           // in the inkwell, or the dead-man switch is released
    MissedDeadline,    // the loop itself was late, too often, or after a pause
    LoopStalled,       // ticks have stopped: reported by the watchdog, never by a tick
    TerrainStale,      // the terrain thread has stopped responding
    Fault,             // internal error: invalid force or invalid time
    NoTouch,           // nothing to touch
};

inline constexpr std::uint8_t kForceOffReasonCount = 13;

/// In lower case, for people and for files: "emergency stop".
std::string_view forceOffReasonName(ForceOffReason reason) noexcept;

/// Constant while a device is open.
struct SafetyLimits {
    double force_n_max = 0.0; // of the vector
    /// The force that the motors can sustain for hours, as root mean square over heat_s.
    double force_n_continuous = std::numeric_limits<double>::infinity();
    double heat_s = 5.0;                 // time constant of the windings' temperature
    double rate_n_per_s_max = 500.0;     // of the vector's change
    double release_n_per_s_max = 2000.0; // the same while the force is turned off
    double ramp_s = 0.5;                 // from zero to the full force, at each start
    double change_ramp_s = 0.15;         // the same after a change of mode or map
};

struct SafetyInput {
    Vec3 force_n{};
    /// Added to `force_n`, and reduced first where the sum is too strong: a wall that is pressed
    /// hard does not weaken the surface below the hand.
    Vec3 yielding_n{};
    ForceOffReason reason = ForceOffReason::None; // reported by earlier stages
    bool has_changed = false;                     // the mode or the map; ramps in again
};

struct SafetyState {
    Vec3 force_n{};       // the last force, on the motors until the next write
    double gain = 0.0;    // fraction that is let through: 0 to 1
    double ramp_s = 0.;   // duration of this ramp from 0 to 1; 0: not started
    double heat_n2 = 0.0; // low-pass of the squared force, like the heating of windings
};

struct SafetyOutput {
    Vec3 force_n{};
    ForceOffReason reason = ForceOffReason::None;
};

/// A longer step is a pause, during which the hand may have moved anywhere: after it the limiter
/// turns the force off, regardless of the input, and ramps in again.
inline constexpr double kSafetyStepMaxS = 0.01;
/// The step that a ramp-down uses after a pause or for an invalid time: the force does not jump
/// after either.
inline constexpr double kSafetyStepFallbackS = 0.001;

/// SafetyState::heat_n2 after `seconds` without force.
double cooledHeat(const SafetyLimits& limits, double heat_n2, double seconds) noexcept;

/// The maximum force at `heat_n2`: force_n_max up to 0.64 of the heat that the continuous force
/// finally produces, and above that a falling limit, down to force_n_continuous. So a brief press
/// is strong, a long press fades to the sustainable force, and a force below 0.8 of the continuous
/// force is never reduced.
double warmForceMax(const SafetyLimits& limits, double heat_n2) noexcept;

///     SafetyState state;
///     const SafetyOutput out = limitForce(limits, {.force_n = wanted_n}, state, dt_s);
///     device.write(out.force_n);
///
/// `dt_s` is the time since the last force was written: the written force therefore never changes
/// faster than the rate in real time, however late or early a tick comes. The bounds hold for any
/// input and state, including NaN and infinities: |force| <= force_n_max, and |force - last force|
/// <= rate × dt_s, where the rate is release_n_per_s_max during a ramp-down; after a pause or for
/// an invalid dt_s, rate × kSafetyStepFallbackS. Only if the limits themselves have become smaller
/// than the last force does the magnitude take precedence over the rate. A state that contains NaN
/// is a fault; a last force that is not finite counts as zero. As the heat approaches that of
/// force_n_continuous, the force falls to force_n_continuous, no faster than the rate. A limit that
/// is NaN or negative is 0. Servo thread.
SafetyOutput limitForce(const SafetyLimits& limits,
                        const SafetyInput& input,
                        SafetyState& state,
                        double dt_s) noexcept;

} // namespace marsview
