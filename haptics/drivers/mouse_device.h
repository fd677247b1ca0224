// A mouse as a device: a window says where the stylus is, and shows the force that nobody feels.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace marsview {

/// Where the window has the stylus.
struct MousePointer {
    WorkspacePoint position; // clamped to MouseDevice's workspace
    double twist_rad = 0.0;
    std::uint32_t buttons = 0; // bit 0: as a stylus button, the space bar for instance
    bool is_held = false;      // the mouse button that stands for a hand on the stylus
};

/// Between the window and the device. Positions that are not finite are left out.
class MouseLink {
public:
    /// The window's; one thread.
    void setPointer(const MousePointer& pointer) noexcept;
    /// What the device was told to push with last; zero while none is open. Any thread but
    /// real-time ones.
    Vec3 forceN() const noexcept { return force_n_.read(); }

private:
    friend class MouseDevice;

    SeqLock<MousePointer> pointer_;
    SeqLock<Vec3> force_n_;
    std::atomic<bool> is_open_{false};
};

/// The sample is always as new as its reading: a mouse at rest says nothing, and is not stale.
class MouseDevice final : public HapticDevice {
public:
    /// Null where the link has a device already.
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
