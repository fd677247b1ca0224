// Devices of plugins, from folders and by path.
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
    std::vector<std::filesystem::path> folders; // where plugins are looked for, in this order
    std::filesystem::path marker_folder;        // see LoadMarker, LastTrouble
    std::filesystem::path lock_folder;          // see lockDevice(); empty: devices are not locked
    /// For loading a plugin, for asking what is there, and for opening a device.
    std::chrono::milliseconds patience{3000};

    /// The folders of $MARSVIEW_PLUGIN_PATH (apart by colons), the user's
    /// ($XDG_DATA_HOME/marsview/plugins, else ~/.local/share/marsview/plugins), those of the
    /// installation that the program lies in, the system's.
    static PluginOptions standard();
};

/// The folders for plugins of an installation whose programs are in `program_folder`: those that
/// exist of ../lib*/marsview/plugins and ../lib/*/marsview/plugins (/usr/lib/x86_64-linux-gnu), in
/// the order of their names. Wherever it was installed to or moved, what is installed into the same
/// prefix is found.
std::vector<std::filesystem::path>
installedPluginFolders(const std::filesystem::path& program_folder);

/// "plugin:/path/of/it.so", "plugin:it.so" in one of the folders, with "#id" behind for one of
/// several devices. A plugin cannot take the program with it again and again: it is loaded, asked
/// and opened on watched threads, and one that brought the program down meanwhile, or in the first
/// seconds of running, or while it was closed, is left out from then on (LoadMarker,
/// GuardedDevice). What went wrong with a device the last time is said of it when it is found again
/// (LastTrouble). One device is one program's. The folders are looked at anew by every find().
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
    Result<std::vector<PluginEntry>> list(const std::filesystem::path& file,
                                          const std::shared_ptr<const PluginLibrary>& library);
    Result<std::string> nameOf(const std::filesystem::path& file,
                               const std::shared_ptr<const PluginLibrary>& library,
                               std::string id);
    std::vector<FoundDevice> devicesOf(const std::filesystem::path& file);
    /// The regular file that a plugin is named by: a path, or a name in one of the folders, with or
    /// without ".so"; empty if there is none.
    std::filesystem::path fileNamed(const std::filesystem::path& name) const;
    std::string folderNames() const;
    Error hung(const std::filesystem::path& file, std::string_view what, std::string_view doing);

    PluginOptions options_;
    std::map<std::filesystem::path, Known> known_;
};

} // namespace marsview
