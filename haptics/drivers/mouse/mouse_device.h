// The mouse as a device: a window provides the stylus position and displays the force.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace marsview {

/// The stylus as the window moves it.
struct MousePointer {
    WorkspacePoint position; // clamped to MouseDevice's workspace
    double twist_rad = 0.0;
    std::uint32_t buttons = 0; // bit 0: the stylus button, for instance the space bar
    bool is_held = false;      // the mouse button that represents holding the stylus
};

/// Connects the window and the device. Positions that are not finite are ignored.
class MouseLink {
public:
    /// Called by the window; one thread.
    void setPointer(const MousePointer& pointer) noexcept;
    /// The force last written to the device; zero while none is open. Any thread except real-time
    /// ones.
    Vec3 forceN() const noexcept { return force_n_.read(); }

private:
    friend class MouseDevice;

    SeqLock<MousePointer> pointer_;
    SeqLock<Vec3> force_n_;
    std::atomic<bool> is_open_{false};
};

/// Every reading carries the current time: a mouse at rest sends nothing and is not stale.
class MouseDevice final : public HapticDevice {
public:
    /// Null if the link already has a device.
    static std::unique_ptr<MouseDevice> open(std::shared_ptr<MouseLink> link);
    ~MouseDevice() override;

    static const WorkspaceBox& workspace();

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;

private:
    explicit MouseDevice(std::shared_ptr<MouseLink> link);

    std::shared_ptr<MouseLink> link_;
    DeviceCapabilities capabilities_;
    MousePointer last_;
};

} // namespace marsview
