// A loaded device plugin: its checked function table, extended to this program's size.
#pragma once

#include "core/base/result.h"
#include "haptics/device/haptic_device.h"
#include "haptics/device/plugin_abi.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// What a plugin reports about one of its devices.
struct PluginEntry {
    std::string id;
    std::string name;
    std::string reason; // empty if it can be opened
};

/// Whether a device is calibrated at the pose that it has when it is opened.
enum class PluginHoming : std::uint8_t { None, AtHome };

/// Loaded libraries stay loaded. All calls run the plugin's code and may hang or crash with it:
/// PluginDriver guards them. Any thread, one at a time.
class PluginLibrary {
public:
    /// Rejects, with the reason, a file that is not a shared library, has no table, or whose table
    /// has another version, is too small, or is incomplete.
    static Result<PluginLibrary> load(const std::filesystem::path& file);

    const std::string& name() const noexcept { return name_; }
    std::vector<PluginEntry> enumerate() const;
    /// Rejects devices with implausible capabilities. The device is wrapped in a CheckedDevice.
    /// Errors begin with `uri`.
    Result<std::unique_ptr<HapticDevice>> open(const std::string& id,
                                               std::string_view uri,
                                               PluginHoming homing = PluginHoming::None) const;

private:
    PluginLibrary(const MarsviewPlugin& table, std::string name)
        : table_(table)
        , name_(std::move(name))
    {}

    MarsviewPlugin table_;
    std::string name_;
};

} // namespace marsview
