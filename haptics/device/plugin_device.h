// A device provided by a plugin.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/device/plugin_abi.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace marsview {

/// Calls the functions of a plugin's table, which has been checked for completeness. The returned
/// values are not checked here (see CheckedDevice).
class PluginDevice final : public HapticDevice {
public:
    // Structs grow only at their end: the size in version 1, and room for newer fields.
    static constexpr std::uint32_t kCapabilitiesBytesMin = 160;
    static constexpr std::uint32_t kCapabilitiesBytesMax = 4096;
    static constexpr std::uint32_t kSampleBytesMin = 48;
    static constexpr std::uint32_t kSampleBytesMax = 1024;
    static_assert(sizeof(MarsviewCapabilities) >= kCapabilitiesBytesMin);
    static_assert(sizeof(MarsviewSample) >= kSampleBytesMin);

    /// Takes ownership of the handle that the plugin's `open` returned.
    PluginDevice(const MarsviewPlugin& table, MarsviewDevice* device);
    /// Closes the device. If the plugin does not return within two seconds, it is abandoned
    /// together with the device.
    ~PluginDevice() override;

    /// Reads the capabilities; call once, before anything else. `plugin_name` replaces a missing
    /// device name. Returns the first invalid one, phrased to follow the device's name.
    std::optional<std::string> describe(const std::string& plugin_name);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool startClock(ClockTick tick, void* self) noexcept override;
    void stopClock() noexcept override;
    std::string trouble() const override;

    /// Calibrates the device, which is in its home position. Call after describe(), before anything
    /// else. Returns the reason if that fails, phrased to follow the device's name.
    std::optional<std::string> calibrate();

private:
    DeviceStatus noted(std::uint32_t answer) noexcept;
    std::string message() const;

    MarsviewPlugin table_;
    MarsviewDevice* device_;
    DeviceCapabilities capabilities_;
    ClockTick tick_ = nullptr;
    void* tick_self_ = nullptr;
    std::atomic<std::uint32_t> strange_answer_{0}; // last unknown status; 0: none
    std::atomic<std::uint32_t> answer_{MARSVIEW_FINE};

    // The plugin is asked for its message on a watched thread, rarely, and not again after a call
    // that did not return.
    mutable std::mutex message_mutex_;
    mutable std::string message_;
    mutable std::uint32_t message_answer_ = MARSVIEW_FINE; // the status that the message is about
    mutable std::chrono::steady_clock::time_point message_time_;
    mutable bool is_mute_ = false;
    // The plugin may have been compiled with a larger sample struct than this program has.
    alignas(std::max_align_t) std::array<std::byte, kSampleBytesMax> sample_{};
};

} // namespace marsview
