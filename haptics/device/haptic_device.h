// The haptic device as the servo loop uses it: position in, force out.
#pragma once

#include "haptics/device/orientation.h"
#include "haptics/device/recorded_tick.h"
#include "haptics/device/workspace.h"

#include <chrono>
#include <cstdint>
#include <string>

namespace marsview {

/// The capabilities a device reports when it is opened; they do not change while it is open.
struct DeviceCapabilities {
    std::string name;                   // for people: maker and model
    WorkspaceBox workspace;             // the reach of the end effector
    double force_n_peak = 0.0;          // short-term; 0: position input only, no force output
    double force_n_continuous = 0.0;    // without overheating; 0: not stated, the peak applies
    double stiffness_n_per_m_max = 0.0; // for a stable wall, from the maker; 0: not stated
    double torque_nm_peak = 0.0;        // short-term; 0: no torque output
    double rate_hz = 1000.0;            // sample rate
    std::uint8_t axes_in = 3;           // 3: position; 6: orientation as well
    std::uint8_t axes_out = 3;          // force axes
    std::uint8_t buttons = 1;
    /// The device calls the tick from its own thread (startClock) instead of being read from the
    /// program's thread.
    bool owns_clock = false;
    /// The device reports whether it is held: an inkwell or a dead-man switch.
    bool has_presence = false;
    /// The device is calibrated by a person: hold it in its home position and open it with ",home"
    /// at the end of its address. Until then it is Unready, with advice as its trouble.
    bool can_set_home = false;
};

/// Either button of a stylus grabs: which one is under the finger depends on the hand.
constexpr std::uint32_t kGrabbingButtons = 0b11;

/// One reading of a device.
struct DeviceSample {
    WorkspacePoint position{};
    /// Of the stylus about its axis, from any reference; 0 where axes_in is 3. Positive
    /// counter-clockwise seen from the stylus's back end, which is from above with the tip down.
    double twist_rad = 0.0;
    Orientation orientation{};
    std::uint32_t buttons = 0; // bits 0 and 1: the buttons of the stylus (kGrabbingButtons)
    /// False in the inkwell or with the dead-man switch released: the device must not push.
    bool is_held = true;
    /// When the device measured this; steady clock. The loop turns the force off if samples are
    /// stale.
    std::chrono::steady_clock::time_point time{};
};

enum class DeviceStatus : std::uint8_t {
    Fine,
    Unready,  // connected but unusable: not calibrated, emergency stop pressed; may recover
    Lost,     // unplugged or dead; does not recover, must be opened again
    Finished, // a replayed recording has ended
};

///     DeviceSample sample;
///     if (device.read(sample) == DeviceStatus::Fine) {
///         device.write(springForce(sample.position)); // workspace frame, newtons
///     }
///
/// Opened by a DeviceDriver; the destructor closes it and leaves the motors without force. All
/// members except the constructor and the destructor are called by one thread at a time, take
/// microseconds, and do not allocate, lock or wait: a device whose transport blocks has its own
/// thread and returns the latest value.
class HapticDevice {
public:
    virtual ~HapticDevice() = default;
    HapticDevice(const HapticDevice&) = delete;
    HapticDevice& operator=(const HapticDevice&) = delete;

    virtual const DeviceCapabilities& capabilities() const noexcept = 0;
    /// The newest sample. `sample` keeps its value unless the result is Fine.
    virtual DeviceStatus read(DeviceSample& sample) noexcept = 0;
    /// Sets the force on the hand, in newtons, in the workspace frame, until the next call. The
    /// caller has limited it; a driver also clamps it to what its motors tolerate. If the result is
    /// not Fine, the motors are without force and the caller restarts its force from zero. Another
    /// thread may write zero while no tick runs, to bring the motors to rest.
    virtual DeviceStatus write(const Vec3& force_n) noexcept = 0;

    /// A device that plays back a recording provides goals in map coordinates instead of stylus
    /// positions. If this returns true, `tick` is that of the last sample, and the sample's
    /// position has no meaning.
    virtual bool recordedTick(RecordedTick& /*tick*/) const noexcept { return false; }
    /// The fraction of a recording that has been played back, 0 to 1. Any thread.
    virtual double playedShare() const noexcept { return 0.0; }

    /// Restricts the strokes of a simulated hand to this part of its workspace from the next sample
    /// on; other devices ignore the call. Called by the ticking thread.
    virtual void strokeWithin(const WorkspaceBox& /*box*/) noexcept {}

    /// A device that owns the clock calls `tick(self, now)` once per period on its own thread, from
    /// startClock() until stopClock() has returned; the tick reads and writes the device. For a
    /// device that does not own the clock both do nothing, and startClock() returns false.
    using ClockTick = void (*)(void* self, std::chrono::steady_clock::time_point now) noexcept;
    virtual bool startClock(ClockTick /*tick*/, void* /*self*/) noexcept { return false; }
    virtual void stopClock() noexcept {}

    /// Why the last status was Unready or Lost, as one sentence for people, phrased to follow the
    /// device's name and a colon; or another problem, such as a recording that stopped because the
    /// disk is full. Empty without a problem or if the cause is unknown. Any thread except the
    /// tick's: it allocates.
    virtual std::string trouble() const { return {}; }

protected:
    HapticDevice() = default;
};

} // namespace marsview
