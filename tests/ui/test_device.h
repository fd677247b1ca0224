// A haptic device whose hand the test leads, and drivers with it and some that fail.
#pragma once

#include "haptics/device/device_driver.h"
#include "ui/controllers/device_finder.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace marsview {

/// What the test and its devices share.
struct TestHand {
    std::mutex mutex; // of position; the tick only tries
    WorkspacePoint position{};
    std::atomic<std::uint32_t> buttons{0};
    std::atomic<bool> is_lost{false};
    std::atomic<double> force_n{0.0};     // written last
    std::atomic<double> force_n_min{0.0}; // since the test has set it
    std::atomic<int> open_count{0};       // devices that are open now
    std::atomic<bool> is_there{true};     // to be found
    std::atomic<bool> is_held_up{false};  // opening waits as long

    void moveTo(const WorkspacePoint& at)
    {
        const std::lock_guard lock(mutex);
        position = at;
    }
};

/// Schemes: "hand" (the test's), "gone" (found with a reason, refuses to open), and "sim",
/// "replay".
DriverMaker testDrivers(const std::shared_ptr<TestHand>& hand);

} // namespace marsview
