// Detects from another thread that ticks have stopped.
#pragma once

#include "haptics/loop/detachable_thread.h"
#include "haptics/loop/servo_core.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

namespace marsview {

/// A normal-priority thread that monitors a loop's tick count. All safety checks in a tick (stale
/// samples, the emergency stop, the limiter) need ticks; if a device that owns the clock stops
/// calling them, or a tick hangs, this thread is the remaining safeguard.
class LoopWatchdog {
public:
    static constexpr std::chrono::milliseconds kLook{5};
    /// Time without ticks after which they count as stalled and the motors are brought to rest.
    static constexpr std::chrono::milliseconds kStalled{20};
    /// Time without ticks after which the loop is considered ended.
    static constexpr std::chrono::milliseconds kDead{2000};

    /// `waits_for_first`: the first tick has no time limit.
    LoopWatchdog(std::shared_ptr<ServoCore> core, bool waits_for_first);
    /// Returns within some milliseconds. If the thread hangs in the device, it is detached.
    ~LoopWatchdog();
    LoopWatchdog(const LoopWatchdog&) = delete;
    LoopWatchdog& operator=(const LoopWatchdog&) = delete;

    /// False: the thread hangs in the device. No further call of the device begins.
    bool endWithin(std::chrono::milliseconds patience);

private:
    struct Shared {
        std::mutex mutex;
        std::condition_variable wake;
        bool is_ending = false;
    };
    static void watch(ServoCore& core, Shared& shared, bool waits_for_first);

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    DetachableThread thread_;
};

} // namespace marsview
