// Notices that no tick comes any more, from outside.
#pragma once

#include "haptics/loop/leavable_thread.h"
#include "haptics/loop/servo_core.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

namespace marsview {

/// A thread without any urgency that counts a loop's ticks while it runs. Everything that a tick
/// watches over (old samples, the emergency stop, the limiter) needs ticks; where a device that
/// owns the clock stops calling them, or one hangs, this is what is left.
class LoopWatchdog {
public:
    static constexpr std::chrono::milliseconds kLook{5};
    /// Silence after which ticks count as stalled, and the motors are brought to rest.
    static constexpr std::chrono::milliseconds kStalled{20};
    /// And after which they will not come back: the loop has ended.
    static constexpr std::chrono::milliseconds kDead{2000};

    /// `waits_for_first`: the first tick takes as long as it takes.
    LoopWatchdog(std::shared_ptr<ServoCore> core, bool waits_for_first);
    /// Within some milliseconds. Where the thread hangs in the device, it is left alone.
    ~LoopWatchdog();
    LoopWatchdog(const LoopWatchdog&) = delete;
    LoopWatchdog& operator=(const LoopWatchdog&) = delete;

    /// False: it hangs in the device. No call of the device begins afterwards.
    bool endWithin(std::chrono::milliseconds patience);

private:
    struct Shared {
        std::mutex mutex;
        std::condition_variable wake;
        bool is_ending = false;
    };
    static void watch(ServoCore& core, Shared& shared, bool waits_for_first);

    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    LeavableThread thread_;
};

} // namespace marsview
