// A device and the loop around it: settings in; states, events and statistics out.
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
    /// Its period is set from the device.
    RealTimeOptions thread{.lead = std::chrono::microseconds(100)};
    std::optional<TickOptions> tick;   // empty: tickOptionsFor(the device)
    std::uint64_t ticks_max = 0;       // the loop ends after this many; 0: no limit
    std::size_t flight_ticks = 10'000; // capacity of the flight recorder
};

/// Runs only while there is something to touch: from a set() with a map until one without. The
/// thread is the program's own, or the device's if it owns the clock. Members not marked otherwise
/// are for the thread that created the object.
///
/// A LoopWatchdog monitors it: if ticks stop, it reports this and, unless another thread is inside
/// the device, writes zero. Nothing here waits for a driver that hangs: after kPatience its thread
/// and the device are abandoned; the device is never accessed again and is closed if the driver
/// returns. Limitation: a driver that hangs in read() or write() keeps the last force on the
/// motors, since no other call may be made at the same time, until the driver or the device detects
/// by itself that writes have stopped (plugin_abi.h requires that within 20 ms).
class ServoLoop {
public:
    /// Time limit for starting and for stopping, each. Closing a device gets twice as much.
    static constexpr std::chrono::milliseconds kPatience{1000};
    static constexpr std::size_t kRecordsMax = ServoCore::kRecordsMax;

    explicit ServoLoop(std::unique_ptr<HapticDevice> device, const ServoLoopOptions& options = {});
    /// Stops the loop; the device is closed unless it has been abandoned.
    ~ServoLoop();
    ServoLoop(const ServoLoop&) = delete;
    ServoLoop& operator=(const ServoLoop&) = delete;

    /// Applies all settings at once from the next tick on. Starts and stops the loop as needed; an
    /// emergency stop does not end the loop but makes its ticks turn the force off. If starting
    /// fails, the loop has ended, and status() returns the reason.
    void set(const LoopSettings& settings);
    /// Ramps the force down, within some milliseconds, and ends the thread. set() starts it again.
    void stop();

    bool isRunning() const noexcept { return is_running_; }
    /// Whether the loop has ended by itself: the device has finished or is lost, its clock could
    /// not be started, ticks have stopped for good, or ticks_max was reached. Any thread.
    bool hasEnded() const noexcept { return core_->hasEnded(); }
    /// Whether ticks have stopped, temporarily or for good: state() is from the last one. Any
    /// thread.
    bool isStalled() const noexcept { return core_->isStalled(); }
    /// Done, or an error of the loop itself: its clock was not started, or the driver hangs. One
    /// sentence that begins with the device's name.
    Status status() const;
    const DeviceCapabilities& device() const noexcept { return core_->device().capabilities(); }
    /// HapticDevice::playedShare().
    double playedShare() const noexcept { return core_->device().playedShare(); }
    /// Why the device does not work, or the error of status(), in one sentence; empty if unknown,
    /// and while stalled ticks may still resume.
    std::string trouble() const;

    /// Of the last tick, including whether the loop has stalled. Any thread.
    LoopState state() const noexcept { return core_->state(); }
    /// In order; false if there is none. One thread.
    bool nextEvent(LoopEvent& event) noexcept { return core_->events().take(event); }
    /// Of the previous run, plus the current one with a delay of some ticks.
    LoopStatistics statistics() const;
    RealTimeGrants grants() const;
    const FlightRecorder& flight() const noexcept { return core_->flight(); }

    /// Switches the collection of ticks for takeRecord() on or off. Updates beyond kRecordsMax that
    /// are not taken in time are lost, and counted. Any thread.
    void keepRecords(bool is_kept) noexcept { core_->keepRecords(is_kept); }
    /// One thread, which may be another one: the thread that writes recordings.
    bool takeRecord(TickRecord& record) noexcept { return core_->records().take(record); }
    /// The record last taken is preceded by TickRecord::ground_records of these.
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
    bool is_abandoned_ = false;      // a driver hangs, and owns all of the core
    std::string trouble_;            // an error of the loop itself; empty: none
    LoopStatistics last_statistics_; // of the previous run
    RealTimeGrants last_grants_;
    std::optional<RealTimeThread> thread_;
    std::optional<LoopWatchdog> watchdog_;
};

} // namespace marsview
