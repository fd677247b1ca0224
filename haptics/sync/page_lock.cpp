#include "haptics/sync/page_lock.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <link.h>
#include <linux/capability.h>
#include <mutex>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

std::uintptr_t pageBytes() noexcept
{
    static const auto kBytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    return kBytes;
}

// AddressSanitizer has red zones between constants, which must not be read.
[[gnu::no_sanitize("address")]] void touchPages(std::uintptr_t begin, std::uintptr_t bytes) noexcept
{
    // NOLINTNEXTLINE(performance-no-int-to-ptr): loaders report addresses this way
    const auto* first = reinterpret_cast<const volatile std::byte*>(begin);
    for (std::uintptr_t at = 0; at < bytes; at += pageBytes()) {
        static_cast<void>(first[at]);
    }
}

// Whether the process may lock an unlimited amount.
bool mayLockAnything()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) {
        return true;
    }
    __user_cap_header_struct header{};
    header.version = _LINUX_CAPABILITY_VERSION_3;
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
    return syscall(SYS_capget, &header, sets.data()) == 0 &&
           (sets[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

// Locks of the process do not nest: munlockall() by the last owner ends them.
struct WholeLock {
    std::mutex mutex;
    int users = 0;
};

WholeLock& wholeLock()
{
    static WholeLock lock;
    return lock;
}

std::string lockWhole()
{
    WholeLock& whole = wholeLock();
    const std::lock_guard guard(whole.mutex);
    // Pages are locked when they are touched: locking reserved memory, such as the stacks of all
    // threads, would touch all of it.
#if defined(MCL_ONFAULT)
    if (whole.users > 0 || mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) {
        ++whole.users;
        return {};
    }
    return std::strerror(errno); // NOLINT(concurrency-mt-unsafe): glibc's is
#else
    return "this system cannot lock pages as they are touched";
#endif
}

void unlockWhole() noexcept
{
    WholeLock& whole = wholeLock();
    const std::lock_guard guard(whole.mutex);
    if (--whole.users == 0) {
        munlockall();
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
    const auto begin = reinterpret_cast<std::uintptr_t>(data);
    touchPages(begin, bytes);
    touchPages(begin + bytes - 1, 1);
    error_ = mlock(data, bytes) == 0 ? 0 : errno;
}

// Locks do not nest, and the pages at both ends may be shared with other locks: these pages stay
// locked until the memory returns to the system.
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

ProcessLock::ProcessLock(std::span<const MemoryRange> memory)
{
    constexpr const char* kRemedy = "ask for all of it with ulimit -l unlimited or CAP_IPC_LOCK";
    if (mayLockAnything()) {
        const std::string refusal = lockWhole();
        is_whole_ = refusal.empty();
        if (!is_whole_) {
            refusal_ = fmt::format("{}; {}", refusal, kRemedy);
        }
        return;
    }
    std::size_t bytes = 0;
    for (const MemoryRange& range : memory) {
        locks_.emplace_back(range.data, range.bytes);
        bytes += locks_.back().bytes();
    }
    constexpr std::size_t kKilobyte = 1024;
    refusal_ = fmt::format("only {} kB that the loop itself uses are locked; {}", bytes / kKilobyte,
                           kRemedy);
}

ProcessLock::~ProcessLock()
{
    if (is_whole_) {
        unlockWhole();
    }
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
