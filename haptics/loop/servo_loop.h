// A device and the loop around it: settings in, states, events and statistics out.
#pragma once

#include "core/base/result.h"
#include "haptics/device/haptic_device.h"
#include "haptics/loop/flight_recorder.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/loop_state.h"
#include "haptics/loop/loop_watchdog.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/loop/servo_core.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

struct ServoLoopOptions {
    RealTimeOptions thread;            // its period is the device's
    std::optional<TickOptions> tick;   // nothing: tickOptionsFor(the device)
    std::uint64_t ticks_max = 0;       // the loop ends by itself after so many; 0: never
    std::size_t flight_ticks = 10'000; // that the flight recorder keeps
};

/// Runs only while something can be felt: from a set() with a map on, until one without. The thread
/// is the program's own, or the device's where it owns the clock. All but what says otherwise is
/// for one thread, the one that made it.
///
/// A LoopWatchdog looks after it: where ticks stop it says so and, as long as nobody is inside the
/// device, writes zero. Nothing here waits for a driver that hangs: after kPatience its thread is
/// left alone with the device, which is never touched again, and closed if the driver ever comes
/// back. What cannot be done: a driver that hangs in read() or write() keeps the motors as they
/// are, as no other call may be made meanwhile; they have the last force until the driver or the
/// device notices by itself that writes have stopped (plugin_abi.h asks for that within 20 ms).
class ServoLoop {
public:
    /// For what may hang: starting and stopping, each. Closing a device has twice as much.
    static constexpr std::chrono::milliseconds kPatience{1000};
    static constexpr std::size_t kRecordsMax = ServoCore::kRecordsMax;

    explicit ServoLoop(std::unique_ptr<HapticDevice> device, const ServoLoopOptions& options = {});
    /// Stops; the device is closed, unless it has been left alone.
    ~ServoLoop();
    ServoLoop(const ServoLoop&) = delete;
    ServoLoop& operator=(const ServoLoop&) = delete;

    /// From the next tick on, all of it at once. Starts and stops the loop as it becomes needed; an
    /// emergency stop does not end it, but tells ticks to let go. Where starting fails the loop has
    /// ended, and status() says why.
    void set(const LoopSettings& settings);
    /// Lets the force fade out, within some milliseconds, and ends the thread. set() starts it
    /// anew.
    void stop();

    bool isRunning() const noexcept { return is_running_; }
    /// Whether the loop has come to its end by itself: the device has finished or is lost, its
    /// clock could not be started, ticks have stopped for good, or ticks_max are done. Any thread.
    bool hasEnded() const noexcept { return core_->hasEnded(); }
    /// Whether ticks have stopped, for now or for good: state() is of the last one. Any thread.
    bool isStalled() const noexcept { return core_->isStalled(); }
    /// Done, or what has gone wrong with the loop itself: its clock was not started, or the driver
    /// hangs. One sentence that begins with the device's name.
    Status status() const;
    const DeviceCapabilities& device() const noexcept { return core_->device().capabilities(); }
    /// HapticDevice::playedShare().
    double playedShare() const noexcept { return core_->device().playedShare(); }
    /// Why the device is not as it should be, or what status() says, in one sentence; empty where
    /// nothing is known, and while ticks have stopped but may come back.
    std::string trouble() const;

    /// Of the last tick, and whether there still are any. Any thread.
    LoopState state() const noexcept { return core_->state(); }
    /// In order; false where there is none. One thread.
    bool nextEvent(LoopEvent& event) noexcept { return core_->events().take(event); }
    /// Of what ran last, and of what is running, some ticks old.
    LoopStatistics statistics() const;
    RealTimeGrants grants() const;
    const FlightRecorder& flight() const noexcept { return core_->flight(); }

    /// From now on ticks are kept for takeRecord(), until it is switched off. What is not taken in
    /// time, more than kRecordsMax updates, is lost, and counted. Any thread.
    void keepRecords(bool is_kept) noexcept { core_->keepRecords(is_kept); }
    /// One thread, which may be another: the one that writes recordings.
    bool takeRecord(TickRecord& record) noexcept { return core_->records().take(record); }
    /// TickRecord::ground_records of them belong to a record that was taken, before it.
    bool takeGroundRecord(GroundRecord& record) noexcept
    {
        return core_->groundRecords().take(record);
    }

private:
    void start();
    Status startClock();
    bool endClock();
    void giveUp(std::string trouble);

    ServoLoopOptions options_;
    std::shared_ptr<ServoCore> core_;
    bool owns_clock_ = false;
    bool is_running_ = false;
    bool is_abandoned_ = false;      // a driver hangs, and has all of the core
    std::string trouble_;            // of the loop itself; empty: none
    LoopStatistics last_statistics_; // of what ran last
    RealTimeGrants last_grants_;
    std::optional<RealTimeThread> thread_;
    std::optional<LoopWatchdog> watchdog_;
};

} // namespace marsview
