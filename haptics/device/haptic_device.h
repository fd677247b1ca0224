// A haptic device as the servo loop meets it: where the hand is, in; a force, out.
#pragma once

#include "core/contact/goal_frame.h"
#include "haptics/device/workspace.h"

#include <chrono>
#include <cstdint>
#include <string>

namespace marsview {

/// What a device says of itself when it is opened; constant from then on.
struct DeviceCapabilities {
    std::string name;                   // for people: maker and model
    WorkspaceBox workspace;             // what the hand reaches
    double force_n_peak = 0.0;          // for moments; 0: it feels, but cannot push
    double force_n_continuous = 0.0;    // without getting hot; 0: not stated, as the peak
    double stiffness_n_per_m_max = 0.0; // of a stable wall, as its maker states it; 0: not stated
    double rate_hz = 1000.0;            // of its samples
    std::uint8_t axes_in = 3;           // 3: position; 6: orientation as well
    std::uint8_t axes_out = 3;          // of force
    std::uint8_t buttons = 1;
    /// The device calls the tick from a thread of its own (startClock), instead of being read
    /// from the program's.
    bool owns_clock = false;
    /// It tells whether somebody holds it: an inkwell or a dead-man switch.
    bool has_presence = false;
};

/// Of one moment.
struct DeviceSample {
    WorkspacePoint position{};
    double twist_rad = 0.0;    // of the stylus about its axis; 0 where axes_in is 3
    std::uint32_t buttons = 0; // bit 0: the stylus button
    /// False in the inkwell or with the dead-man switch released: nothing may push.
    bool is_held = true;
    /// When the device measured this; steady clock. Old samples make the loop let go.
    std::chrono::steady_clock::time_point time{};
};

enum class DeviceStatus : std::uint8_t {
    Fine,
    Unready,  // connected but not usable now: not calibrated, emergency stop pressed; may recover
    Lost,     // unplugged or dead; it never recovers, open it anew
    Finished, // a replayed recording has ended
};

/// Opened by a DeviceDriver, closed by its destructor, which leaves the motors without force. All
/// but constructor and destructor are for one thread at a time, take microseconds, and neither
/// allocate, lock nor wait: a device whose transport blocks has a thread of its own and answers
/// with the newest value.
class HapticDevice {
public:
    virtual ~HapticDevice() = default;
    HapticDevice(const HapticDevice&) = delete;
    HapticDevice& operator=(const HapticDevice&) = delete;

    virtual const DeviceCapabilities& capabilities() const noexcept = 0;
    /// The newest sample. `sample` keeps its value unless the answer is Fine.
    virtual DeviceStatus read(DeviceSample& sample) noexcept = 0;
    /// The force on the hand from now on, in newtons, in the workspace frame. The caller has
    /// limited it; a driver clamps it to what its motors stand all the same. Where the answer is
    /// not Fine the motors are without force, and the caller begins anew from there. Zero may also
    /// be written by another thread while no tick runs, to bring the motors to rest.
    virtual DeviceStatus write(const Vec3& force_n) noexcept = 0;

    /// A device that plays back a recording has no hand, but goals in map coordinates. Where this
    /// is true, `goal` is that of the last sample, and its position means nothing.
    virtual bool recordedGoal(TracePoint& /*goal*/) const noexcept { return false; }
    /// The share of a recording that has been played back, 0 to 1. Any thread.
    virtual double playedShare() const noexcept { return 0.0; }

    /// A simulated hand strokes within this part of its workspace from the next sample on; other
    /// devices ignore it. The ticking thread's.
    virtual void strokeWithin(const WorkspaceBox& /*box*/) noexcept {}

    /// A device that owns the clock calls `tick(self, now)` once per period on its own thread from
    /// start() on, until stop() has returned; the tick reads and writes it. For a device that does
    /// not own the clock both do nothing, and start() is false.
    using ClockTick = void (*)(void* self, std::chrono::steady_clock::time_point now) noexcept;
    virtual bool startClock(ClockTick /*tick*/, void* /*self*/) noexcept { return false; }
    virtual void stopClock() noexcept {}

    /// Why the last answer was Unready or Lost, in one sentence for people that goes on after the
    /// device's name and a colon; or what else has gone wrong, such as a recording on a full disk.
    /// Empty where all is fine or nothing is known. Any thread but that of the tick: it allocates.
    virtual std::string trouble() const { return {}; }

protected:
    HapticDevice() = default;
};

} // namespace marsview
