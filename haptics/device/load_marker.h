// Remembering which plugin took the program down, and with what.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace marsview {

/// Which of a plugin's functions the program is in.
enum class PluginCall : std::uint8_t { Load, Enumerate, Open, Run, Close };

/// A small locked file that is there while the program is inside a plugin. Where the program ends
/// meanwhile, the file stays behind and says so at the next start. Its name stands for the plugin's
/// path, size and time, so that another build of the plugin has another one, then for the call, and
/// for the process: programs that run at once neither clear nor blame each other's.
///
/// A plugin that hangs has not taken the program down: where the main thread ends the program in
/// order, by returning from main() or by exit(), the files of calls that never came back go. A
/// plugin that calls exit() does so on another thread, and its file stays.
class LoadMarker {
public:
    /// $XDG_STATE_HOME/marsview/loading, else ~/.local/state/marsview/loading.
    static std::filesystem::path defaultFolder();

    /// Marks that the program is inside `plugin`, an existing file, until the marker is destroyed.
    /// Invalid, with what to do about it, where an earlier call took its program down. Where the
    /// folder cannot be written to the marker exists but marks nothing. Any thread.
    static Result<LoadMarker>
    make(const std::filesystem::path& folder, const std::filesystem::path& plugin, PluginCall call);

    /// What an end in order does by itself. For a handler of exit() after which no other one runs.
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
