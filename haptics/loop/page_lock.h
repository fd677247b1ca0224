// Memory that the servo thread reads without a page fault.
#pragma once

#include <cstddef>

namespace marsview {

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

/// Brings in the code and constants of the program itself and of the libraries that ticks call (C,
/// C++ and mathematics), so that what is called for the first time an hour later costs no page
/// fault. Milliseconds; not for the servo's turns.
void touchProgram() noexcept;

} // namespace marsview
