#include "haptics/loop/page_lock.h"

#include <cerrno>
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

std::uintptr_t pageBytes() noexcept
{
    static const auto kBytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    return kBytes;
}

} // namespace

PageLock::PageLock(const void* data, std::size_t bytes) noexcept
    : data_(data)
    , bytes_(bytes)
{
    if (bytes == 0) {
        return;
    }
    const auto* first = static_cast<const volatile std::byte*>(data);
    for (std::size_t at = 0; at < bytes; at += pageBytes()) {
        static_cast<void>(first[at]);
    }
    static_cast<void>(first[bytes - 1]);
    error_ = mlock(data, bytes) == 0 ? 0 : errno;
}

// Locks do not nest, and at both ends a page may be shared with what others have locked: such pages
// stay locked until the memory goes back to the system.
PageLock::~PageLock()
{
    if (bytes_ == 0 || error_ != 0) {
        return;
    }
    const auto begin = reinterpret_cast<std::uintptr_t>(data_);
    const std::uintptr_t first = (begin + pageBytes() - 1) / pageBytes() * pageBytes();
    const std::uintptr_t last = (begin + bytes_) / pageBytes() * pageBytes();
    if (first < last) {
        munlock(reinterpret_cast<const void*>(first), last - first); // NOLINT
    }
}

PageLock::PageLock(PageLock&& other) noexcept
    : data_(other.data_)
    , bytes_(std::exchange(other.bytes_, 0))
    , error_(other.error_)
{}

PageLock& PageLock::operator=(PageLock&& other) noexcept
{
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    std::swap(error_, other.error_);
    return *this;
}

} // namespace marsview
