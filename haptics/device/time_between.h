// Overflow-safe differences of time points.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace marsview {

/// From `begin` to `end`; negative if `end` is earlier. Untrusted devices may put any time into
/// their samples: a difference that does not fit saturates.
inline std::chrono::nanoseconds timeBetween(std::chrono::steady_clock::time_point begin,
                                            std::chrono::steady_clock::time_point end) noexcept
{
    const std::int64_t from_ns = std::chrono::nanoseconds(begin.time_since_epoch()).count();
    const std::int64_t to_ns = std::chrono::nanoseconds(end.time_since_epoch()).count();
    std::int64_t between_ns = 0;
    if (__builtin_sub_overflow(to_ns, from_ns, &between_ns)) {
        between_ns = to_ns > from_ns ? std::numeric_limits<std::int64_t>::max()
                                     : std::numeric_limits<std::int64_t>::min();
    }
    return std::chrono::nanoseconds(between_ns);
}

} // namespace marsview
