// Locks that show other programs that a file is being worked on or is in use.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// A lock on a separate lock file, which is created if missing. The system releases the lock when
/// the program ends, however it ends. Any thread, one at a time.
class FileLock {
public:
    enum class Kind : std::uint8_t {
        Exclusive, // one holder, named in the lock file; the file is removed on release
        Shared,    // any number of holders
    };

    /// A shared lock on an existing lock file works even in a read-only folder. Empty if another
    /// holder excludes this kind of lock. An error if the lock file can be neither created nor
    /// opened.
    static Result<std::optional<FileLock>> tryLock(const std::string& path, Kind kind);

    /// Whether any process holds the lock, shared or exclusive. Creates no file.
    static bool isHeld(const std::string& path);

    /// The process that holds the exclusive lock, as named in the lock file; 0 if unknown.
    static long holder(const std::string& path);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

private:
    FileLock(int descriptor, std::string path, Kind kind);
    void release() noexcept;

    int descriptor_ = -1;
    std::string path_;
    Kind kind_ = Kind::Shared;
};

} // namespace marsview
