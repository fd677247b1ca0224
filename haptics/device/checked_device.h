// A device whose samples are checked before they are used.
#pragma once

#include "haptics/device/haptic_device.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace marsview {

/// Sits between an untrusted device and the loop. An implausible sample (not finite, farther
/// outside the workspace than the workspace is wide, faster than a hand can move) is rejected:
/// read() returns Unready, and the force is zero until a sample is plausible again. After three bad
/// samples in a row, or more than one in five for a while, the device is permanently Lost. Forces
/// are clamped to the peak force; a force that is not finite becomes zero.
class CheckedDevice final : public HapticDevice {
public:
    enum class Fault : std::uint8_t { None, NotFinite, NotARotation, OutOfReach, Jump };

    /// `device` is not null, and its capabilities have passed the check (capability_check.h).
    explicit CheckedDevice(std::unique_ptr<HapticDevice> device);

    const DeviceCapabilities& capabilities() const noexcept override;
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool startClock(ClockTick tick, void* self) noexcept override;
    void stopClock() noexcept override;
    std::string trouble() const override;

private:
    Fault faultOf(const DeviceSample& sample) const noexcept;

    std::unique_ptr<HapticDevice> device_;
    WorkspaceBox reach_;
    DeviceSample last_;
    bool has_last_ = false;
    bool is_dropped_ = false;
    int doubt_ = 0;
    bool is_withholding_ = false; // whether the last sample was rejected
    std::atomic<Fault> fault_{Fault::None};
};

} // namespace marsview
