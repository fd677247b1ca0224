// Devices of plugins, found in folders or by path.
#pragma once

#include "core/base/file_lock.h"
#include "haptics/device/device_driver.h"
#include "haptics/device/plugin_library.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct PluginOptions {
    std::vector<std::filesystem::path> folders; // searched for plugins in this order
    std::filesystem::path marker_folder;        // see CrashMarker, LastTrouble
    std::filesystem::path lock_folder;          // see lockDevice(); empty: devices are not locked
    /// Time limit for loading a plugin, listing its devices, and opening a device.
    std::chrono::milliseconds patience{3000};

    /// The folders of $MARSVIEW_PLUGIN_PATH (separated by colons), the user's
    /// ($XDG_DATA_HOME/marsview/plugins, else ~/.local/share/marsview/plugins), those of the
    /// program's installation, and the system's.
    static PluginOptions standard();
};

/// The plugin folders of an installation whose programs are in `program_folder`: the existing ones
/// of ../lib*/marsview/plugins and ../lib/*/marsview/plugins (/usr/lib/x86_64-linux-gnu), sorted by
/// name. Plugins installed into the same prefix are found wherever the prefix is.
std::vector<std::filesystem::path>
installedPluginFolders(const std::filesystem::path& program_folder);

/// "plugin:/path/of/it.so", or "plugin:it.so" in one of the folders; append "#id" to select one of
/// several devices, and ",home" to calibrate one that is in its home position. A plugin cannot
/// crash the program repeatedly: it is loaded, queried and opened on watched threads, and a plugin
/// that crashed the program in one of these calls, in its first seconds of running, or while it was
/// closed, is skipped from then on (CrashMarker, GuardedDevice). The last problem with a device is
/// shown when the device is found again (LastTrouble). Only one program at a time can use a device.
/// Every find() scans the folders again.
class PluginDriver final : public DeviceDriver {
public:
    explicit PluginDriver(PluginOptions options = PluginOptions::standard());

    std::string_view scheme() const noexcept override { return "plugin"; }
    std::vector<FoundDevice> find() override;
    Result<std::unique_ptr<HapticDevice>> open(std::string_view address) override;

    /// Forgets plugins that hung, were rejected or crashed the program, so that all are tried
    /// again.
    void forgetFailures();

private:
    struct Known {
        std::string stamp; // of the file when it was loaded
        Result<std::shared_ptr<const PluginLibrary>> library;
    };

    Result<std::shared_ptr<const PluginLibrary>> load(const std::filesystem::path& file);
    Result<std::vector<PluginEntry>> list(const std::filesystem::path& file,
                                          const std::shared_ptr<const PluginLibrary>& library);
    Result<std::string> nameOf(const std::filesystem::path& file,
                               const std::shared_ptr<const PluginLibrary>& library,
                               std::string id);
    std::vector<FoundDevice> devicesOf(const std::filesystem::path& file);
    /// The regular file for a plugin's name: a path, or a file in one of the folders, with or
    /// without ".so"; empty if none exists.
    std::filesystem::path fileNamed(const std::filesystem::path& name) const;
    std::string folderNames() const;
    Error hung(const std::filesystem::path& file, std::string_view what, std::string_view doing);

    PluginOptions options_;
    std::map<std::filesystem::path, Known> known_;
};

} // namespace marsview
