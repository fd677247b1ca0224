// Memory that the servo thread reads without a page fault.
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

/// Brings a range of memory in, and keeps the system from taking its pages away for as long as it
/// lives, as far as the system grants that (RLIMIT_MEMLOCK). Not for the servo thread.
class PageLock {
public:
    PageLock() = default;
    PageLock(const void* data, std::size_t bytes) noexcept;
    ~PageLock();
    PageLock(PageLock&& other) noexcept;
    PageLock& operator=(PageLock&& other) noexcept;

    /// 0 where the pages are locked, or there are none; otherwise what the system said (errno).
    int error() const noexcept { return error_; }
    std::size_t bytes() const noexcept { return error_ == 0 ? bytes_ : 0; }

private:
    const void* data_ = nullptr;
    std::size_t bytes_ = 0;
    int error_ = 0;
};

/// For as long as one of these lives, the process keeps the pages that it has touched. That takes
/// the right to lock any amount: where the system grants a bounded one (RLIMIT_MEMLOCK without
/// CAP_IPC_LOCK), locking everything would make the process's next large allocation or growing
/// stack fail. Then `memory` alone is locked, one range after the other, as far as it goes. What
/// others have locked by PageLock stays in memory but is no longer locked when the last one dies.
class ProcessLock {
public:
    explicit ProcessLock(std::span<const MemoryRange> memory);
    ~ProcessLock();
    ProcessLock(const ProcessLock&) = delete;
    ProcessLock& operator=(const ProcessLock&) = delete;

    /// Empty where all of the process is locked; otherwise why it is not, and what is.
    const std::string& refusal() const noexcept { return refusal_; }

private:
    bool is_whole_ = false;
    std::vector<PageLock> locks_; // of the ranges
    std::string refusal_;
};

/// Brings in the code and constants of the program itself and of the libraries that ticks call (C,
/// C++ and mathematics), so that what is called for the first time an hour later costs no page
/// fault. Milliseconds; not for the servo's turns.
void touchProgram() noexcept;

} // namespace marsview
