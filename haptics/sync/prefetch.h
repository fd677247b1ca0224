// Loading memory into the processor's caches before it is needed.
#pragma once

#include <cstddef>

namespace marsview {

/// Asks for memory that will soon be written. Any thread; changes nothing and waits for nothing.
inline void prefetchForWriting(const void* begin, std::size_t bytes) noexcept
{
    constexpr std::size_t kLine = 64;
    const auto* at = static_cast<const unsigned char*>(begin);
    for (std::size_t i = 0; i < bytes; i += kLine) {
        __builtin_prefetch(at + i, 1);
    }
    __builtin_prefetch(at + bytes - 1, 1);
}

} // namespace marsview
