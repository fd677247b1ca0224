// Memory that the servo thread can read without a page fault.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace marsview {

struct MemoryRange {
    const void* data = nullptr;
    std::size_t bytes = 0;
};

/// Pages a range in and keeps it resident during its lifetime, as far as the system permits
/// (RLIMIT_MEMLOCK). Not for the servo thread.
class PageLock {
public:
    PageLock() = default;
    PageLock(const void* data, std::size_t bytes) noexcept;
    ~PageLock();
    PageLock(PageLock&& other) noexcept;
    PageLock& operator=(PageLock&& other) noexcept;

    /// 0 if the pages are locked or there are none; otherwise the system's errno.
    int error() const noexcept { return error_; }
    std::size_t bytes() const noexcept { return error_ == 0 ? bytes_ : 0; }

private:
    const void* data_ = nullptr;
    std::size_t bytes_ = 0;
    int error_ = 0;
};

/// Locks all touched pages of the process during its lifetime. This requires the right to lock any
/// amount: under a limit (RLIMIT_MEMLOCK without CAP_IPC_LOCK), locking everything would make the
/// process's next large allocation or stack growth fail. In that case only `memory` is locked, one
/// range after the other, up to the limit. When the last ProcessLock is destroyed, pages locked by
/// a PageLock stay in memory but become unlocked.
class ProcessLock {
public:
    explicit ProcessLock(std::span<const MemoryRange> memory);
    ~ProcessLock();
    ProcessLock(const ProcessLock&) = delete;
    ProcessLock& operator=(const ProcessLock&) = delete;

    /// Empty if the whole process is locked; otherwise the reason, and the part that is locked.
    const std::string& refusal() const noexcept { return refusal_; }

private:
    bool is_whole_ = false;
    std::vector<PageLock> locks_; // of the ranges
    std::string refusal_;
};

/// Pages in the code and constants of the program itself and of the libraries that ticks call (C,
/// C++ and math), so that a function's first call, even an hour later, causes no page fault. Takes
/// milliseconds; not for the servo's turns.
void touchProgram() noexcept;

} // namespace marsview
