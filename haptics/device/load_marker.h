// Remembering what took the program down while it was being loaded.
#pragma once

#include "core/base/file_lock.h"
#include "core/base/result.h"

#include <filesystem>
#include <optional>

namespace marsview {

/// A small locked file that is there while a plugin is being loaded or opened. Where the program
/// ends meanwhile, however it ends, the file stays behind and says so at the next start. Its name
/// stands for the plugin's path, size and time: another build of the plugin has another one.
class LoadMarker {
public:
    /// $XDG_STATE_HOME/marsview/loading, else ~/.local/state/marsview/loading.
    static std::filesystem::path defaultFolder();

    /// Marks that `plugin`, an existing file, is being loaded, until the marker is destroyed.
    /// Invalid, with what to do about it, where an earlier attempt took its program down. Where the
    /// folder cannot be written to, and where another program is loading the same plugin right now,
    /// the marker exists but marks nothing.
    static Result<LoadMarker> make(const std::filesystem::path& folder,
                                   const std::filesystem::path& plugin);

    /// Forgets all earlier failures, so that these plugins are tried again.
    static void forgetFailures(const std::filesystem::path& folder);

private:
    explicit LoadMarker(std::optional<FileLock> lock)
        : lock_(std::move(lock))
    {}
    std::optional<FileLock> lock_;
};

} // namespace marsview
