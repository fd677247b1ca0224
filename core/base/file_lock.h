// Telling other programs that a file is being worked on or is in use.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// A lock on a file of its own, which is made where it is missing. The system releases it when the
/// program ends, however it ends. Any thread, one at a time.
class FileLock {
public:
    enum class Kind : std::uint8_t {
        Exclusive, // one holder; the lock's file says who, and goes when it is released
        Shared,    // any number of holders
    };

    /// A shared lock whose file is there is had even where nothing may be written.
    /// Nothing where somebody else holds it in a way that excludes this. An error where the lock's
    /// file can be neither made nor opened.
    static Result<std::optional<FileLock>> tryLock(const std::string& path, Kind kind);

    /// Whether somebody holds it in either way. Makes no file.
    static bool isHeld(const std::string& path);

    /// The process that holds the exclusive lock, as its file says; 0 where unknown.
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
