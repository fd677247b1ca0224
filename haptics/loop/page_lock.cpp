#include "haptics/loop/page_lock.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <link.h>
#include <string_view>
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

// Between constants, AddressSanitizer has what nobody should read.
[[gnu::no_sanitize("address")]] void touchPages(std::uintptr_t begin, std::uintptr_t bytes) noexcept
{
    // NOLINTNEXTLINE(performance-no-int-to-ptr): that is how loaders tell addresses
    const auto* first = reinterpret_cast<const volatile std::byte*>(begin);
    for (std::uintptr_t at = 0; at < bytes; at += pageBytes()) {
        static_cast<void>(first[at]);
    }
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

void touchProgram() noexcept
{
    dl_iterate_phdr(
        [](dl_phdr_info* object, std::size_t, void*) {
            const std::string_view name = object->dlpi_name != nullptr ? object->dlpi_name : "";
            const bool is_called = name.empty() || name.find("/libc.so") != name.npos ||
                                   name.find("/libm.so") != name.npos ||
                                   name.find("/libstdc++.so") != name.npos;
            for (ElfW(Half) i = 0; is_called && i < object->dlpi_phnum; ++i) {
                const ElfW(Phdr)& part = object->dlpi_phdr[i];
                if (part.p_type == PT_LOAD && (part.p_flags & PF_R) != 0 &&
                    (part.p_flags & PF_W) == 0) {
                    touchPages(object->dlpi_addr + part.p_vaddr, part.p_memsz);
                }
            }
            return 0;
        },
        nullptr);
}

} // namespace marsview
