// Arrays that are filled right after they are created.
#pragma once

#include "core/base/check.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace marsview {

/// Asks for large pages for a large array: a page fault for 2 MiB costs about as much as one for 4
/// KiB. Advice only.
inline void useLargePages([[maybe_unused]] std::byte* data,
                          [[maybe_unused]] std::size_t bytes) noexcept
{
#ifdef __linux__
    constexpr std::size_t kPage = 4096;
    constexpr std::size_t kWorthwhile = std::size_t{4} << 20U;
    if (bytes >= kWorthwhile) {
        const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(data) % kPage) % kPage;
        madvise(data + before, bytes - before, MADV_HUGEPAGE);
    }
#endif
}

/// A fixed number of uninitialized elements.
template <typename T>
class RawArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    RawArray() = default;
    explicit RawArray(std::size_t size)
        : data_(std::make_unique_for_overwrite<T[]>(size))
        , size_(size)
    {
        useLargePages(reinterpret_cast<std::byte*>(data_.get()), size * sizeof(T));
    }

    T* data() noexcept { return data_.get(); }
    const T* data() const noexcept { return data_.get(); }
    std::size_t size() const noexcept { return size_; }
    T& operator[](std::size_t i) noexcept { return data_[i]; }
    const T& operator[](std::size_t i) const noexcept { return data_[i]; }
    T* begin() noexcept { return data(); }
    T* end() noexcept { return data() + size_; }
    const T* begin() const noexcept { return data(); }
    const T* end() const noexcept { return data() + size_; }

private:
    std::unique_ptr<T[]> data_;
    std::size_t size_ = 0;
};

} // namespace marsview
