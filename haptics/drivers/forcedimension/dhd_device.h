// A Force Dimension device or a Novint Falcon.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/haptic_device.h"
#include "haptics/drivers/forcedimension/dhd_api.h"
#include "haptics/drivers/forcedimension/dhd_models.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace marsview {

/// The library's calls wait for USB transfers, so they are made on a separate thread, a thousand
/// times a second; read() and write() exchange the latest values with it. If the loop has not
/// written for 20 ms the force is zero. Forces are enabled when the device is opened, and after it
/// was calibrated; not after the user's force button or the device's own velocity limit turned them
/// off.
class DhdDevice final : public HapticDevice {
public:
    struct Options {
        std::shared_ptr<const DhdApi> api;
        int number = 0;               // of the devices that the library counts
        std::string uri;              // for errors
        std::optional<FileLock> lock; // keeps other programs away from it
    };

    /// Takes up to seconds. NotFound if fewer devices are connected. The device is wrapped in a
    /// CheckedDevice.
    static Result<std::unique_ptr<HapticDevice>> open(Options options);
    /// Leaves the motors without force.
    ~DhdDevice() override;

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    std::string trouble() const override;

private:
    using Clock = std::chrono::steady_clock;

    enum class State : std::uint8_t { Silent, Uncalibrated, ForcesOff, Fine, Lost };
    struct Wanted {
        Vec3 force_n;
        Clock::time_point time;
    };

    DhdDevice(Options options, dhd::Id id);

    void describe();
    void run() noexcept;
    bool exchange() noexcept;
    bool readStatus() noexcept;
    std::optional<DeviceSample> readSample() noexcept;
    bool setForce(const Vec3& force_n) noexcept;

    std::shared_ptr<const DhdApi> api_;
    std::optional<FileLock> lock_;
    dhd::Id id_;
    const DhdModel* model_ = nullptr;
    DeviceCapabilities capabilities_;

    // Used by the thread that exchanges values.
    unsigned rounds_ = 0;
    bool was_uncalibrated_ = false;
    Clock::time_point heard_;
    State newest_state_ = State::Silent;

    SeqLock<DeviceSample> sample_;
    SeqLock<Wanted> wanted_;
    std::atomic<State> state_{State::Silent};
    std::atomic<bool> is_stopping_{false};
    DeviceSample last_sample_; // of read()
    std::thread thread_;
};

} // namespace marsview
