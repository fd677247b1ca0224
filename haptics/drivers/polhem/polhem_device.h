// A WoodenHaptics or Polhem device.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/haptic_device.h"
#include "haptics/drivers/hid/hid_list.h"
#include "haptics/drivers/polhem/polhem_kinematics.h"
#include "haptics/drivers/polhem/polhem_report.h"
#include "haptics/sync/seq_lock.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

namespace marsview {

/// Reports are read and written on a separate thread, since writing one may take 14 ms; read() and
/// write() exchange the latest values with it. If the loop has not written for 20 ms, or the board
/// has not reported for 20 ms, the currents are zero.
///
/// The encoders count from their position at power-on, and no report shows whether they have been
/// set since. They are trusted only after this object has set them and has read them back as
/// `home_encoders`; until then the device is Unready. They are set when the user presses the
/// board's button to confirm that the device is in its home position, or, with `homes_at_once`,
/// when the first report is consistent with the home position: within kRestCountsMax of zero
/// (powered on in the home position) or of `home_encoders` (calibrated before). A board that stops
/// reporting and then counts from zero has lost its power, and with it its calibration.
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

    /// About two degrees of a body: how accurately a person puts the device into its home position.
    static constexpr int kRestCountsMax = 100;

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
    enum class State : std::uint8_t { Silent, Uncalibrated, NotAtRest, NotSet, Fine, Lost };
    enum class Homing : std::uint8_t { NotAsked, Refused, Asked, Done };

    void run() noexcept;
    bool exchange() noexcept;
    bool home() noexcept;
    void believe() noexcept;
    bool isCloseToHome() const noexcept;
    bool readNewest() noexcept;
    bool writeNow(const PolhemCommand& command) noexcept;
    void take(const PolhemReport& report, std::size_t bytes) noexcept;
    PolhemEncoders corrected(const PolhemEncoders& encoders) const noexcept;

    const HidApi& api_;
    HidHandle handle_;
    PolhemParameters parameters_;
    std::optional<FileLock> lock_;
    DeviceCapabilities capabilities_;

    // Used by the thread that exchanges reports.
    PolhemLayout layout_;
    bool homes_at_once_; // at the first report
    bool is_to_home_ = false;
    Homing homing_ = Homing::NotAsked;
    bool has_heard_ = false;
    bool was_silent_ = false;
    PolhemEncoders newest_{};
    PolhemEncoders before_silence_{};
    Clock::time_point heard_;
    PolhemEncoders offset_{}; // for boards whose encoders cannot be set

    SeqLock<Said> said_;
    SeqLock<Wanted> wanted_;
    std::atomic<State> state_{State::Silent};
    std::atomic<bool> is_stopping_{false};
    Said last_said_; // of read()
    std::thread thread_;
};

} // namespace marsview
