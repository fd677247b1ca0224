// Remembers which plugin crashed the program, and in which call.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace marsview {

/// The plugin function that the program is calling.
enum class PluginCall : std::uint8_t { Load, Enumerate, Open, Run, Close };

/// A small locked file that exists while the program is inside a plugin. If the program ends during
/// the call, the file remains and shows it at the next start. The file name encodes the plugin's
/// path, size and time (so that another build of the plugin gets another name), the call and the
/// process: programs that run at the same time neither clear nor blame each other's files.
///
/// A plugin that hangs has not crashed the program: if the main thread ends the program normally,
/// by returning from main() or calling exit(), the files of calls that have not returned are
/// deleted. A plugin that calls exit() does so on another thread, and its file remains.
class LoadMarker {
public:
    /// $XDG_STATE_HOME/marsview/loading, else ~/.local/state/marsview/loading.
    static std::filesystem::path defaultFolder();

    /// Marks that the program is inside `plugin`, an existing file, until the marker is destroyed.
    /// Returns Invalid, with the remedy, if an earlier call crashed the program. If the folder is
    /// not writable, the marker exists but records nothing. Any thread.
    static Result<LoadMarker>
    make(const std::filesystem::path& folder, const std::filesystem::path& plugin, PluginCall call);

    /// What a normal exit does by itself. For an exit() handler that runs after all others.
    static void clearAtExit();

    /// Forgets all earlier failures, so that these plugins are tried again.
    static void forgetFailures(const std::filesystem::path& folder);

private:
    explicit LoadMarker(std::optional<FileLock> lock)
        : lock_(std::move(lock))
    {}
    std::optional<FileLock> lock_;
};

} // namespace marsview
