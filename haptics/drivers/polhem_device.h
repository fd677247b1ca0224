// A WoodenHaptics or Polhem arm.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/haptic_device.h"
#include "haptics/drivers/hid_list.h"
#include "haptics/drivers/polhem_kinematics.h"
#include "haptics/drivers/polhem_report.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

namespace marsview {

/// Reports are read and written on a thread of its own, since writing one may take 14 ms; read()
/// and write() exchange the newest values with it. Where the loop has not written for 20 ms, or the
/// board has not said anything for 20 ms, the currents are zero.
///
/// Its encoders only count from where they were when they got power, so the arm is Unready until it
/// has been calibrated: in its rest position, by the board's button or by `homes_at_once`.
class PolhemDevice final : public HapticDevice {
public:
    struct Options {
        const HidApi* api = nullptr;
        HidHandle handle;
        PolhemLayout layout = PolhemLayout::RawHid;
        PolhemParameters parameters;
        bool homes_at_once = false;
        std::optional<FileLock> lock; // keeps other programs away from it
    };

    explicit PolhemDevice(Options options);
    /// Leaves the motors without current.
    ~PolhemDevice() override;

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    std::string trouble() const override;

private:
    using Clock = std::chrono::steady_clock;

    struct Said {
        PolhemEncoders encoders{};
        Clock::time_point time;
    };
    struct Wanted {
        Vec3 force_n;
        Clock::time_point time;
    };
    enum class State : std::uint8_t { Silent, Uncalibrated, Fine, Lost };

    void run() noexcept;
    bool exchange() noexcept;
    bool readNewest() noexcept;
    bool writeNow(const PolhemCommand& command) noexcept;
    void take(const PolhemReport& report, std::size_t bytes) noexcept;
    PolhemEncoders corrected(const PolhemEncoders& encoders) const noexcept;

    const HidApi& api_;
    HidHandle handle_;
    PolhemParameters parameters_;
    std::optional<FileLock> lock_;
    DeviceCapabilities capabilities_;

    // Of the thread that exchanges reports.
    PolhemLayout layout_;
    bool is_to_home_;
    bool is_homed_ = false;
    bool has_heard_ = false;
    PolhemEncoders newest_{};
    Clock::time_point heard_;
    PolhemEncoders offset_{}; // of boards whose encoders cannot be set

    SeqLock<Said> said_;
    SeqLock<Wanted> wanted_;
    std::atomic<State> state_{State::Silent};
    std::atomic<bool> is_stopping_{false};
    Said last_said_; // of read()
    std::thread thread_;
};

} // namespace marsview
