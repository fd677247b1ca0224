// Large arrays that may lie in a file instead of in memory.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace marsview {

/// Where large arrays lie: in files without names in a folder, which vanish with the arrays, even
/// if the program is killed.
struct ScratchPlace {
    std::string folder;
    std::size_t bytes_min = std::size_t{8} << 20U; // smaller arrays are in memory
};

/// A fixed number of bytes, in memory or in a mapped file. The system writes the file's pages to
/// the disk and reads them again as needed; release() gives back the memory that they take.
class ScratchBytes {
public:
    enum class Content : std::uint8_t { Uninitialized, Zeros };

    ScratchBytes() = default;
    /// In a file if `place` says so, otherwise in memory. TooLarge if there is no room. Pages of
    /// zeros take memory only once they are touched.
    static Result<ScratchBytes>
    create(std::size_t bytes, Content content, const ScratchPlace* place = nullptr);
    ScratchBytes(ScratchBytes&& other) noexcept
        : data_(std::exchange(other.data_, nullptr))
        , size_(std::exchange(other.size_, 0))
        , is_file_(std::exchange(other.is_file_, false))
    {}
    ScratchBytes& operator=(ScratchBytes&& other) noexcept
    {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(is_file_, other.is_file_);
        return *this;
    }
    ~ScratchBytes();

    std::byte* data() noexcept { return data_; }
    const std::byte* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    bool isFile() const noexcept { return is_file_; }

    /// Gives the memory of a file's pages back; their content stays. Any thread, also while others
    /// read and write them.
    void release() const noexcept;

private:
    Status map(std::size_t bytes, const std::string& folder);

    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
    bool is_file_ = false;
};

} // namespace marsview
