// The last stage before the motors. It trusts nobody: whatever comes before it, the force on the
// hand is finite, bounded, changes at a bounded rate, and goes to zero where anything is wrong.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <limits>
#include <string_view>

namespace marsview {

/// Why there is no force. The first that holds, in this order, is told.
enum class LetGoReason : std::uint8_t {
    None,           // there may be force
    EmergencyStop,  // somebody has asked for it
    DeviceLost,     // unplugged or dead
    DeviceFinished, // a recording has ended
    DeviceUnready,  // not calibrated, or its own stop is pressed
    DeviceStale,    // what it measured is too old
    DeviceNonsense, // it measured what is no number, or a place that no hand gets to in the time
    NotHeld,        // in the inkwell, or the dead-man switch is released
    MissedDeadline, // the loop itself came too late, too often, or after a pause
    LoopStalled,    // no tick comes any more: said by who watches the loop, never by a tick
    TerrainStale,   // whoever brings the terrain has gone silent
    Fault,          // the program computed what is no force, or was given what is no time
    NoTouch,        // there is nothing to be felt
};

inline constexpr std::uint8_t kLetGoReasonCount = 13;

/// In lower case, for people and for files: "emergency stop".
std::string_view letGoReasonName(LetGoReason reason) noexcept;

/// Constant while a device is open.
struct SafetyLimits {
    double force_n_max = 0.0; // of the vector
    /// What the motors stand for hours, as root mean square over heat_s.
    double force_n_continuous = std::numeric_limits<double>::infinity();
    double heat_s = 5.0;                 // in which small motors' windings warm up and cool down
    double rate_n_per_s_max = 500.0;     // of the vector's change
    double release_n_per_s_max = 2000.0; // the same while letting go
    double ramp_s = 0.5;                 // from nothing to all of it, whenever it begins
    double change_ramp_s = 0.15;         // the same after a change of mode or map
};

struct SafetyInput {
    Vec3 force_n{};
    LetGoReason reason = LetGoReason::None; // what others have found wrong
    bool has_changed = false;               // the mode or the map; ramps in anew
};

struct SafetyState {
    Vec3 force_n{};       // the last, which is on the motors until the next is written
    double gain = 0.0;    // of what is let through: 0 to 1
    double ramp_s = 0.;   // how long the gain takes from 0 to 1 this time; 0: has not begun
    double heat_n2 = 0.0; // low-pass of the squared force, as currents heat windings
};

struct SafetyOutput {
    Vec3 force_n{};
    LetGoReason reason = LetGoReason::None;
    bool is_bounded = false; // by magnitude, heat or rate
};

/// What is longer is a pause, during which the hand may have gone anywhere: after it the limiter
/// lets go, whatever is asked for, and ramps in anew.
inline constexpr double kSafetyStepMaxS = 0.01;
/// Letting go counts as this what is a pause, or no time at all: after neither anything jumps.
inline constexpr double kSafetyStepFallbackS = 0.001;

/// SafetyState::heat_n2 after `seconds` without force.
double cooledHeat(const SafetyLimits& limits, double heat_n2, double seconds) noexcept;

/// The force that the motors stand at `heat_n2`: all of force_n_max up to 0.64 of what the
/// continuous force brings about in the end, and from there less, down to force_n_continuous
/// itself. So what is pressed for moments is strong, what is pressed for long fades to what may
/// last, and what does not exceed 0.8 of that never changes.
double warmForceMax(const SafetyLimits& limits, double heat_n2) noexcept;

/// `dt_s` is the time since the last force was written: so what is written never changes faster
/// than the rate in real time, however late or early a tick comes. The bounds hold for any input
/// and state, NaN and infinities included: |force| <= force_n_max, and |force - last force| <= rate
/// × dt_s, where the rate is release_n_per_s_max while letting go; after a pause and where dt_s is
/// no time, rate × kSafetyStepFallbackS. Only where the limits themselves have become smaller than
/// the last force, the magnitude comes before the rate. A state that holds what is no number is a
/// fault; a last force that is none counts as zero. The force goes down to force_n_continuous, no
/// faster than the rate, as its heat comes near that one's. A limit that is no number, or negative,
/// is 0. Servo thread.
SafetyOutput limitForce(const SafetyLimits& limits,
                        const SafetyInput& input,
                        SafetyState& state,
                        double dt_s) noexcept;

} // namespace marsview
