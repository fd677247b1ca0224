// A 3Dconnexion SpaceMouse and its kin. They steer the camera, not the stylus.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/drivers/hid_list.h"
#include "haptics/drivers/spacemouse_report.h"
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

/// Reads reports on a thread of its own. A camera asks for the rates once a frame and moves by them
/// times the frame's time.
class SpaceMouse {
public:
    /// What is connected, with URIs "spacemouse:/dev/hidraw3". Mice and keyboards of the same maker
    /// are left out.
    static std::vector<FoundDevice> find(const HidApi& api = systemHidApi());

    /// `address` is a path, or empty for the first one. The error names the URI. `notify`, which
    /// may be empty, is called on the reading thread when the cap leaves its rest, when a button
    /// goes down, and when the device is lost: who has nothing to do in between need not ask.
    static Result<std::unique_ptr<SpaceMouse>> open(std::string_view address,
                                                    const HidApi& api = systemHidApi(),
                                                    std::function<void()> notify = {});
    /// Waits for a reading that is under way, 50 ms at most, and for a call of `notify`.
    ~SpaceMouse();
    SpaceMouse(const SpaceMouse&) = delete;
    SpaceMouse& operator=(const SpaceMouse&) = delete;

    const std::string& name() const noexcept { return name_; }
    /// The newest rates; all zero once it is lost, or silent for 150 ms while it was pushed. Any
    /// thread but real-time ones.
    SpaceMouseRates rates() const noexcept;
    /// The buttons that went down since this was asked last, as bits; none is forgotten that was
    /// released meanwhile. Any thread.
    std::uint32_t takePressed() noexcept { return pressed_.exchange(0); }
    /// It was unplugged; never recovers.
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

/// Lists them among the devices, and says what they are for to those who would touch with one. The
/// window opens them by itself.
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
