// A haptic device controlled by the test, and drivers with it and with failing devices.
#pragma once

#include "haptics/device/device_driver.h"
#include "ui/controllers/device_finder.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace marsview {

/// The state shared by the test and its devices.
struct TestHand {
    std::mutex mutex; // of position; the tick only tries to lock
    WorkspacePoint position{};
    std::atomic<std::uint32_t> buttons{0};
    std::atomic<bool> is_lost{false};
    std::atomic<double> force_n{0.0};     // the last force written
    std::atomic<double> force_n_min{0.0}; // since the test last set it
    std::atomic<int> open_count{0};       // devices currently open
    std::atomic<bool> is_there{true};     // whether drivers find it
    std::atomic<bool> is_held_up{false};  // opening blocks while it is set

    void moveTo(const WorkspacePoint& at)
    {
        const std::lock_guard lock(mutex);
        position = at;
    }
};

/// Schemes: "hand" (the test's), "gone" (found with a reason, fails to open), and "sim", "replay".
DriverMaker testDrivers(const std::shared_ptr<TestHand>& hand);

} // namespace marsview
