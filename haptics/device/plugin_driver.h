// Devices of plugins, from folders and by path.
#pragma once

#include "haptics/device/device_driver.h"
#include "haptics/device/plugin_library.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct PluginOptions {
    std::vector<std::filesystem::path> folders; // where plugins are looked for, in this order
    std::filesystem::path marker_folder;        // see LoadMarker
    /// For loading a plugin, for asking what is there, and for opening a device.
    std::chrono::milliseconds patience{3000};

    /// The folders of $MARSVIEW_PLUGIN_PATH (apart by colons), the user's
    /// ($XDG_DATA_HOME/marsview/plugins, else ~/.local/share/marsview/plugins), the system's.
    static PluginOptions standard();
};

/// "plugin:/path/of/it.so", "plugin:it.so" in one of the folders, with "#id" behind for one of
/// several devices. A plugin cannot take the program with it more than once: its code is called on
/// watched threads, and one that brought the program down while it was loaded or opened is left out
/// from then on. The folders are looked at anew by every find().
class PluginDriver final : public DeviceDriver {
public:
    explicit PluginDriver(PluginOptions options = PluginOptions::standard());

    std::string_view scheme() const noexcept override { return "plugin"; }
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

    /// Forgets what hung, was refused or took the program down; all is tried again.
    void forgetFailures();

private:
    struct Known {
        std::string stamp; // of the file, as it was
        Result<std::shared_ptr<const PluginLibrary>> library;
    };

    Result<std::shared_ptr<const PluginLibrary>> load(const std::filesystem::path& file);
    std::vector<FoundDevice> devicesOf(const std::filesystem::path& file);
    std::string folderNames() const;
    Error hung(const std::filesystem::path& file, std::string_view what, std::string_view doing);

    PluginOptions options_;
    std::map<std::filesystem::path, Known> known_;
};

} // namespace marsview
