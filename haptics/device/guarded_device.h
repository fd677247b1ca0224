// A plugin's device during the time in which a crash is blamed on the plugin.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/last_trouble.h"
#include "haptics/device/plugin_call.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace marsview {

/// Keeps a CrashMarker on disk until the device has been read kReadsOfTrial times, and again while
/// it closes. If the program crashes in start_clock, in the first reads and writes, or in close,
/// the next start therefore knows which plugin was running. If the device is not read for `idle`,
/// the marker is removed until the next read, so that unrelated crashes are not blamed on the
/// plugin. Also keeps other programs away from the device, supplies a reason if the plugin gives
/// none, and saves the current trouble for later device lists when the device is closed.
class GuardedDevice final : public HapticDevice {
public:
    /// Two seconds at the usual 1 kHz.
    static constexpr std::uint64_t kReadsOfTrial = 2000;

    struct Options {
        std::unique_ptr<HapticDevice> device{}; // not null
        std::filesystem::path plugin{};
        std::filesystem::path marker_folder{};
        std::optional<CrashMarker> marker{}; // of PluginCall::Run
        std::optional<FileLock> lock{};
        std::optional<LastTrouble> last_trouble{};
        std::chrono::milliseconds idle{10'000};
    };

    explicit GuardedDevice(Options options);
    ~GuardedDevice() override;

    const DeviceCapabilities& capabilities() const noexcept override;
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool recordedTick(RecordedTick& tick) const noexcept override;
    bool startClock(ClockTick tick, void* self) noexcept override;
    void stopClock() noexcept override;
    std::string trouble() const override;

private:
    void watch(const std::stop_token& stop);
    void mark();

    std::unique_ptr<HapticDevice> device_;
    std::filesystem::path plugin_;
    std::filesystem::path marker_folder_;
    std::chrono::milliseconds idle_;
    std::optional<FileLock> lock_;
    std::optional<LastTrouble> last_trouble_;

    std::atomic<std::uint64_t> reads_{0};
    std::atomic<DeviceStatus> status_{DeviceStatus::Fine}; // status of the last read or write

    std::mutex mutex_; // guards the members below; the servo thread does not lock it
    std::condition_variable_any wake_;
    std::optional<CrashMarker> marker_;
    bool is_on_trial_ = true;
    std::jthread watcher_; // last member: its thread uses all the others
};

} // namespace marsview
