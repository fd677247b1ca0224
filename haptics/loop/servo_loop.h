// A device and the loop around it: settings in, states, events and statistics out.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/loop/flight_recorder.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/loop_state.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/sync/seq_lock.h"
#include "haptics/sync/spsc_queue.h"
#include "haptics/sync/triple_buffer.h"

#include <atomic>
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

/// Runs only while something can be felt: from a set() with a map on, until one without, or one
/// that is stopped for good. The thread is the program's own, or the device's where it owns the
/// clock. All but what says otherwise is for one thread, the one that made it.
class ServoLoop {
public:
    static constexpr std::size_t kRecordsMax = 1U << 14;

    explicit ServoLoop(std::unique_ptr<HapticDevice> device, const ServoLoopOptions& options = {});
    /// Stops; the device is closed.
    ~ServoLoop();
    ServoLoop(const ServoLoop&) = delete;
    ServoLoop& operator=(const ServoLoop&) = delete;

    /// From the next tick on. Starts and stops the loop as it becomes needed.
    void set(const LoopSettings& settings);
    /// Lets the force fade out, within some milliseconds, and ends the thread. set() starts it
    /// anew.
    void stop();

    bool isRunning() const noexcept { return is_running_; }
    /// Whether the loop has come to its end by itself: the device has finished or is lost, or
    /// ticks_max are done. Any thread.
    bool hasEnded() const noexcept { return has_ended_.load(std::memory_order_acquire); }
    const DeviceCapabilities& device() const noexcept { return device_->capabilities(); }
    /// Why the device is not as it should be, in one sentence; empty where nothing is known.
    std::string trouble() const { return device_->trouble(); }

    /// Of the last tick. Any thread.
    LoopState state() const noexcept { return state_.read(); }
    /// In order; false where there is none. One thread.
    bool nextEvent(LoopEvent& event) noexcept { return events_.take(event); }
    /// Of what ran last, and of what is running, some ticks old.
    LoopStatistics statistics() const;
    RealTimeGrants grants() const;
    const FlightRecorder& flight() const noexcept { return flight_; }

    /// From now on ticks are kept for takeRecord(), until it is switched off. What is not taken in
    /// time, more than kRecordsMax updates, is lost, and counted. Any thread.
    void keepRecords(bool is_kept) noexcept
    {
        keeps_records_.store(is_kept, std::memory_order_relaxed);
    }
    /// One thread, which may be another: the one that writes recordings.
    bool takeRecord(TickRecord& record) noexcept { return records_->take(record); }

private:
    void start();
    LoopOutcome
    turn(std::chrono::steady_clock::time_point now, double dt_s, bool has_missed_deadline) noexcept;
    void publish(const StepResult& result, double tick_s) noexcept;
    void record(const StepResult& result, double tick_s) noexcept;
    static void deviceTick(void* self, std::chrono::steady_clock::time_point now) noexcept;

    std::unique_ptr<HapticDevice> device_;
    ServoLoopOptions options_;
    TickOptions tick_options_;
    bool is_running_ = false;
    LoopTime stopped_{}; // the last time; motors cool down meanwhile
    bool owns_clock_ = false;

    // Between the threads.
    TripleBuffer<LoopSettings> settings_;
    SeqLock<LoopState> state_;
    SpscQueue<LoopEvent, 256> events_;
    std::unique_ptr<SpscQueue<TickRecord, kRecordsMax>> records_;
    FlightRecorder flight_;
    std::atomic<bool> keeps_records_{false};
    std::atomic<bool> is_ending_{false};
    std::atomic<bool> has_ended_{false};

    // The servo thread's.
    TickState tick_;
    DeviceSample sample_;
    LoopCounts counts_;
    std::uint64_t ticks_ = 0;
    LetGoReason last_reason_ = LetGoReason::NoTouch;
    bool is_finished_ = false;

    // Of a device that owns the clock.
    LoopStatistics device_statistics_;
    SeqLock<LoopStatistics> device_published_;
    LoopTime device_last_{};
    LoopTime device_deadline_{};

    LoopStatistics last_statistics_; // of what ran last
    RealTimeGrants last_grants_;
    std::unique_ptr<RealTimeThread> thread_; // last: it uses all the others
};

} // namespace marsview
