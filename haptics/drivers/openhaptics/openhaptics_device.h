// A PHANTOM or Touch device.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/haptic_device.h"
#include "haptics/drivers/openhaptics/openhaptics_api.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace marsview {

/// Driven by the vendor's scheduler, one frame per tick. read() and write() work only within the
/// tick, and return Unready outside of it.
class OpenHapticsDevice final : public HapticDevice {
public:
    struct Options {
        std::shared_ptr<OpenHapticsApi> api;
        std::string name;             // as in the vendor's configuration; empty: the default one
        std::string uri;              // for errors
        bool is_at_home = false;      // resets the encoders of a device that has that calibration
        std::optional<FileLock> lock; // keeps other programs away from it
    };

    /// Takes seconds. Unsupported if the encoders of a device are to be reset that calibrates
    /// itself otherwise.
    static Result<std::unique_ptr<HapticDevice>> open(Options options);
    /// Stops the clock, and leaves the motors without force.
    ~OpenHapticsDevice() override;

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool startClock(ClockTick tick, void* self) noexcept override;
    void stopClock() noexcept override;
    std::string trouble() const override;

private:
    OpenHapticsDevice(Options options, hd::Handle handle);

    void describe();
    void describeForces();
    void describeCalibration();
    unsigned int resetEncoders();
    std::string calibrationAdvice(hd::Enum state) const;
    template <typename T, typename Get>
    bool get(Get getter, hd::Enum what, T* values) const;

    unsigned int frame() noexcept;
    void beginFrame(std::chrono::steady_clock::time_point now) noexcept;
    void checkCalibration() noexcept;
    void take(unsigned int error) noexcept;
    void updateStatus() noexcept;

    std::shared_ptr<OpenHapticsApi> api_;
    std::optional<FileLock> lock_;
    hd::Handle handle_;
    DeviceCapabilities capabilities_;
    int calibration_styles_ = 0;     // all that the device has
    hd::Enum calibration_style_ = 0; // that the running scheduler can update; 0: none

    // Used by the scheduler's thread.
    DeviceSample sample_;
    bool is_calibrated_ = false;
    unsigned frames_ = 0;
    unsigned frames_of_rest_ = 0;

    // Shared between the scheduler's thread and the threads that start, stop and watch.
    std::atomic<DeviceStatus> status_{DeviceStatus::Unready};
    std::atomic<std::thread::id> frame_thread_{}; // default id outside of a frame
    ClockTick tick_ = nullptr;
    void* tick_self_ = nullptr;
    hd::SchedulerHandle scheduled_ = 0;
    bool is_scheduled_ = false;
    std::atomic<bool> is_stopping_{false};
    std::atomic<bool> is_inside_{false};
    // For trouble(): an error code, or that the device is not calibrated.
    std::atomic<unsigned int> error_{hd::kSuccess};
    std::atomic<unsigned int> calibration_{hd::kCalibrationOk};
};

} // namespace marsview
