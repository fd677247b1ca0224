// A device of a plugin.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/device/plugin_abi.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// Asks the functions of a plugin's table, which has been found complete. What it answers is not
/// checked (CheckedDevice does that).
class PluginDevice final : public HapticDevice {
public:
    // Structs grow at their end only: what version 1 began with, and room for what newer ones add.
    static constexpr std::uint32_t kCapabilitiesBytesMin = 160;
    static constexpr std::uint32_t kCapabilitiesBytesMax = 4096;
    static constexpr std::uint32_t kSampleBytesMin = 48;
    static constexpr std::uint32_t kSampleBytesMax = 1024;
    static_assert(sizeof(MarsviewCapabilities) >= kCapabilitiesBytesMin);
    static_assert(sizeof(MarsviewSample) >= kSampleBytesMin);

    /// Takes over what the plugin's `open` answered.
    PluginDevice(const MarsviewPlugin& table, MarsviewDevice* device);
    /// Closes the device. A plugin that does not come back from that within two seconds is left
    /// alone with it.
    ~PluginDevice() override;

    /// Asks what the device is, to be done once, before anything else. `plugin_name` stands in for
    /// a name. Returns what is wrong with the answer, to be put after the device's name.
    std::optional<std::string> describe(const std::string& plugin_name);

    const DeviceCapabilities& capabilities() const noexcept override { return capabilities_; }
    DeviceStatus read(DeviceSample& sample) noexcept override;
    DeviceStatus write(const Vec3& force_n) noexcept override;
    bool startClock(ClockTick tick, void* self) noexcept override;
    void stopClock() noexcept override;
    std::string trouble() const override;

private:
    DeviceStatus noted(std::uint32_t answer) noexcept;

    MarsviewPlugin table_;
    MarsviewDevice* device_;
    DeviceCapabilities capabilities_;
    ClockTick tick_ = nullptr;
    void* tick_self_ = nullptr;
    std::atomic<std::uint32_t> strange_answer_{0}; // the last; 0: none
    // The plugin may have been compiled with a larger sample than this program knows.
    alignas(std::max_align_t) std::array<std::byte, kSampleBytesMax> sample_{};
};

} // namespace marsview
