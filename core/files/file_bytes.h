// Bytes of a file anywhere: on disk or at an address.
#pragma once

#include "core/base/raw_array.h"
#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace marsview {

/// An open file that is read in pieces. Paths may be those of GDAL's file systems (/vsicurl/…). For
/// one thread at a time.
class FileBytes {
public:
    /// NotFound if it does not exist, Unreadable if it cannot be opened.
    static Result<FileBytes> open(const std::string& path);

    const std::string& path() const noexcept { return path_; }
    /// The size when the file was opened.
    std::uint64_t size() const noexcept { return size_; }

    /// All `count` bytes from `offset` on; Unreadable if there are fewer; then no buffer is
    /// allocated.
    Result<RawArray<std::byte>> read(std::uint64_t offset, std::uint64_t count) const;

private:
    struct Close {
        void operator()(void* file) const noexcept;
    };

    FileBytes() = default;

    std::string path_;
    std::uint64_t size_ = 0;
    bool has_exact_ranges_ = false;     // for a file on a server
    std::unique_ptr<void, Close> file_; // GDAL's file handle
};

} // namespace marsview
