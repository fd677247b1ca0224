// Vectors of many megabytes.
#pragma once

#include "core/base/raw_array.h"

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace marsview {

/// Standard allocator that asks for large pages. Where page faults for 4 KiB pages are expensive,
/// as on virtual machines, they are most of the cost of creating a large array. Elements without an
/// initial value stay uninitialized, as in RawArray, so that the thread that fills them touches
/// them first.
template <typename T>
struct LargePageAllocator {
    // NOLINTNEXTLINE(readability-identifier-naming): the standard's name
    using value_type = T;

    LargePageAllocator() = default;
    template <typename U>
    // NOLINTNEXTLINE(google-explicit-constructor): as allocators are
    LargePageAllocator(const LargePageAllocator<U>& /*other*/) noexcept
    {}

    T* allocate(std::size_t count)
    {
        void* data = ::operator new (count * sizeof(T), std::align_val_t{alignof(T)});
        useLargePages(static_cast<std::byte*>(data), count * sizeof(T));
        return static_cast<T*>(data);
    }
    void deallocate(T* data, std::size_t /*count*/) noexcept
    {
        ::operator delete (data, std::align_val_t{alignof(T)});
    }
    template <typename U, typename... First>
    void construct(U* at, First&&... first)
    {
        if constexpr (sizeof...(First) == 0) {
            ::new (static_cast<void*>(at)) U;
        } else {
            ::new (static_cast<void*>(at)) U(std::forward<First>(first)...);
        }
    }
    bool operator==(const LargePageAllocator&) const = default;
};

template <typename T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

} // namespace marsview
