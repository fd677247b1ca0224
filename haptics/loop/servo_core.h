// State shared by the servo thread, its watchdog and its owner.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/loop/flight_recorder.h"
#include "haptics/loop/haptic_tick.h"
#include "haptics/loop/loop_state.h"
#include "haptics/loop/loop_statistics.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/sync/seq_lock.h"
#include "haptics/sync/spsc_queue.h"
#include "haptics/sync/triple_buffer.h"
#include "haptics/terrain/ground_log.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

struct ServoCoreOptions {
    TickOptions tick;
    std::chrono::nanoseconds period{1'000'000};
    std::uint64_t uncounted_turns = 100;
    std::uint64_t ticks_max = 0;       // 0: no limit
    std::size_t flight_ticks = 10'000; // capacity of the flight recorder
};

/// The device, the tick's state and the data exchanged between the threads. Shared: if a driver
/// hangs, its thread keeps this object as long as needed, and the other threads continue without
/// it.
class ServoCore {
public:
    static constexpr std::size_t kRecordsMax = 1U << 14;

    ServoCore(std::unique_ptr<HapticDevice> device, const ServoCoreOptions& options);

    HapticDevice& device() noexcept { return *device_; }
    const HapticDevice& device() const noexcept { return *device_; }
    const ServoCoreOptions& options() const noexcept { return options_; }
    /// The memory that ticks use besides the map, for locking.
    std::vector<MemoryRange> memory() const;

    // Called by the owner, while no tick runs.

    /// Before the first tick.
    void begin();
    /// After the last one.
    void end();

    // Called by the ticking thread.

    LoopOutcome turn(LoopTime begin, bool has_missed_deadline) noexcept;
    /// Shortly before turn(): loads what it will need into the processor's caches.
    void prepareTurn() noexcept;
    /// As HapticDevice::ClockTick; `self` is a ServoCore.
    static void deviceTick(void* self, LoopTime now) noexcept;

    // For the watchdog. Any thread but the ticking one.

    /// Increases at the beginning and at the end of every turn.
    std::uint64_t beats() const noexcept { return beats_.load(std::memory_order_acquire); }
    void setStalled(bool is_stalled) noexcept
    {
        is_stalled_.store(is_stalled, std::memory_order_release);
    }
    bool isStalled() const noexcept
    {
        return is_stalled_.load(std::memory_order_acquire) ||
               is_given_up_.load(std::memory_order_acquire);
    }
    /// Writes zero to the device unless another thread is inside it. If that succeeds, the next
    /// tick starts from zero force. May hang if the device does.
    void bringToRest() noexcept;
    /// Ends the loop because ticks have stopped, even if they resume later.
    void giveUp() noexcept;

    // Called by any thread.

    LoopState state() const noexcept;
    bool hasEnded() const noexcept { return has_ended_.load(std::memory_order_acquire); }
    /// From the next tick on the force ramps down, and then the loop ends.
    void askToEnd() noexcept { is_ending_.store(true, std::memory_order_release); }
    /// If the hanging tick returns, it no longer accesses the device, the map or the limiter.
    void abandon() noexcept { is_abandoned_.store(true, std::memory_order_release); }
    const FlightRecorder& flight() const noexcept { return flight_; }
    TripleBuffer<LoopSettings>& settings() noexcept { return settings_; }
    SpscQueue<LoopEvent, 256>& events() noexcept { return events_; }
    SpscQueue<TickRecord, kRecordsMax>& records() noexcept { return records_; }
    GroundLog::Queue& groundRecords() noexcept { return ground_records_; }
    void keepRecords(bool is_kept) noexcept
    {
        recording_.store(is_kept ? ++last_recording_ : 0, std::memory_order_relaxed);
    }
    /// For a device that owns the clock.
    const LoopStatistics& clockStatistics() const noexcept { return clock_statistics_; }
    LoopStatistics latestClockStatistics() const noexcept { return clock_published_.read(); }

private:
    LoopOutcome turnInside(LoopTime begin, bool has_missed_deadline) noexcept;
    bool takeDevice() noexcept { return !is_device_taken_.exchange(true); }
    void leaveDevice() noexcept { is_device_taken_.store(false); }
    void forgetForce() noexcept;
    DeviceStatus writeForce(const Vec3& force_n) noexcept;
    void publish(const StepResult& result, double tick_s) noexcept;
    void record(const StepResult& result, double tick_s) noexcept;
    bool takeRecording() noexcept;
    bool recordGround(bool was_told) noexcept;

    std::unique_ptr<HapticDevice> device_;
    ServoCoreOptions options_;

    // Shared between the threads.
    TripleBuffer<LoopSettings> settings_;
    SeqLock<LoopState> state_;
    SpscQueue<LoopEvent, 256> events_;
    SpscQueue<TickRecord, kRecordsMax> records_;
    GroundLog::Queue ground_records_;
    FlightRecorder flight_;
    std::atomic<std::uint64_t> beats_{0};
    std::atomic<std::uint64_t> last_recording_{0};
    std::atomic<std::uint64_t> recording_{0}; // 0: none
    std::atomic<bool> is_ending_{false};
    std::atomic<bool> has_ended_{false};
    std::atomic<bool> is_abandoned_{false};
    std::atomic<bool> is_stalled_{false};
    std::atomic<bool> is_given_up_{false};
    std::atomic<bool> is_device_taken_{false}; // a thread is inside read or write
    std::atomic<bool> is_brought_to_rest_{false};

    // Used by the ticking thread.
    TickState tick_;
    DeviceSample sample_;
    Vec3 shift_m_{}; // between the last two samples
    LoopCounts counts_;
    std::uint64_t ticks_ = 0;
    LoopTime read_at_{};  // when the last sample was read; 0: none
    LoopTime wrote_at_{}; // when the last force was written
    bool was_too_long_ = false;
    bool has_motion_ = false; // of the map, not yet in a record
    SceneMotion motion_{};
    ForceOffReason last_reason_ = ForceOffReason::NoTouch;
    GroundLog ground_log_;
    std::uint64_t told_recording_ = 0;       // of the recording that ground_log_ reports to
    std::uint32_t untaken_ground_count_ = 0; // terrain records not yet counted by a tick record
    bool is_finished_ = false;
    LoopTime rested_at_{}; // when it ended; the motors cool down from then on

    // The same for a device that owns the clock.
    LoopStatistics clock_statistics_;
    SeqLock<LoopStatistics> clock_published_;
    LoopTime clock_last_{};
};

} // namespace marsview
