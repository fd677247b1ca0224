// Records during what the program crashed.
#pragma once

#include "core/base/file_lock.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace marsview {

/// A small locked file that exists while the program does something that can crash it. If the
/// program ends in that time, the file remains and shows it at the next start. The file name says
/// what was done and by which process: programs that run at the same time neither clear nor blame
/// each other's files.
///
/// A call that hangs has not crashed the program: if the main thread ends the program normally, by
/// returning from main() or calling exit(), the files of calls that have not returned are deleted.
/// A plugin that calls exit() does so on another thread, and its file remains.
class CrashMarker {
public:
    /// $XDG_STATE_HOME/marsview/loading, else ~/.local/state/marsview/loading.
    static std::filesystem::path defaultFolder();

    /// Marks that the program does `what`, "subject.activity", until the marker is destroyed. If
    /// the folder is not writable, the marker records nothing. Any thread.
    static CrashMarker set(const std::filesystem::path& folder, const std::string& what);

    /// The name of a file that an ended program left behind and that starts with
    /// `beginning`, without its ending: "subject.activity-4711-0". Nothing if there is none.
    static std::optional<std::string> leftBehind(const std::filesystem::path& folder,
                                                 const std::string& beginning);

    /// Deletes the files of ended programs whose names start with `beginning`.
    static void forget(const std::filesystem::path& folder, const std::string& beginning = {});

    /// What a normal exit does by itself. For an exit() handler that runs after all others.
    static void clearAtExit();

private:
    explicit CrashMarker(std::optional<FileLock> lock)
        : lock_(std::move(lock))
    {}
    std::optional<FileLock> lock_;
};

} // namespace marsview
