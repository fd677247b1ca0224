// 3Dconnexion SpaceMouse devices. They move the camera, not the stylus.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/hid/hid_list.h"
#include "haptics/drivers/spacemouse/spacemouse_report.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace marsview {

/// Reads reports on its own thread. A camera reads the rates once per frame and moves by the rates
/// times the frame's duration.
class SpaceMouse {
public:
    /// The connected devices, with URIs "spacemouse:/dev/hidraw3". Mice and keyboards of the same
    /// maker are excluded.
    static std::vector<FoundDevice> find(const HidApi& api = systemHidApi());

    /// `address` is a path, or empty for the first device. The error names the URI. `notify`, which
    /// may be empty, is called on the reading thread when the cap leaves its rest position, when a
    /// button is pressed, and when the device is lost, so that an idle caller need not poll.
    static Result<std::unique_ptr<SpaceMouse>> open(std::string_view address,
                                                    const HidApi& api = systemHidApi(),
                                                    std::function<void()> notify = {});
    /// Waits for a running read, at most 50 ms, and for a running call of `notify`.
    ~SpaceMouse();
    SpaceMouse(const SpaceMouse&) = delete;
    SpaceMouse& operator=(const SpaceMouse&) = delete;

    const std::string& name() const noexcept { return name_; }
    /// The latest rates; all zero once the device is lost, or after 150 ms without a report while
    /// it was pushed. Any thread except real-time ones.
    SpaceMouseRates rates() const noexcept;
    /// The buttons pressed since the last call, as bits, including those released in the meantime.
    /// Any thread.
    std::uint32_t takePressed() noexcept { return pressed_.exchange(0); }
    /// The device was unplugged; it does not recover.
    bool isLost() const noexcept { return is_lost_.load(std::memory_order_acquire); }

private:
    SpaceMouse(const HidApi& api, HidHandle handle, std::string name, std::function<void()> notify);
    void run() noexcept;

    const HidApi& api_;
    HidHandle handle_;
    std::string name_;
    std::function<void()> notify_;
    SeqLock<SpaceMouseRates> rates_;
    std::atomic<std::uint32_t> pressed_{0};
    std::atomic<bool> is_lost_{false};
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

/// Lists SpaceMouse devices and explains why they cannot be opened as haptic devices. The window
/// opens them by itself.
class SpaceMouseDriver final : public DeviceDriver {
public:
    explicit SpaceMouseDriver(const HidApi& api = systemHidApi())
        : api_(api)
    {}
    std::string_view scheme() const noexcept override { return "spacemouse"; }
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

private:
    const HidApi& api_;
};

} // namespace marsview
