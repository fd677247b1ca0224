// A device that is believed only as far as its samples make sense.
#pragma once

#include "haptics/device/haptic_device.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace marsview {

/// Goes between a device of unknown making and the loop. A sample that cannot be true (not finite,
/// farther outside the workspace than the workspace is wide, faster than any hand) is withheld: the
/// answer is Unready, and the force zero until a sample is as it should be. Three in a row, or more
/// than one in five for a while, and the device is Lost for good. Forces are clamped to the peak
/// force; one that is not finite becomes zero.
class CheckedDevice final : public HapticDevice {
public:
    enum class Fault : std::uint8_t { None, NotFinite, OutOfReach, Jump };

    /// `device` is there and states what is possible (capability_check.h).
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
    bool is_withholding_ = false; // the last sample
    std::atomic<Fault> fault_{Fault::None};
};

} // namespace marsview
