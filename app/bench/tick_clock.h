// A clock for nanosecond intervals that is cheap to read.
#pragma once

#include <chrono>
#include <cstdint>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace marsview {

/// On x86-64 the processor's time stamp counter, elsewhere the system's steady clock. Intervals are
/// accurate to about 20 ns, since the processor may execute ahead of a reading.
class TickClock {
public:
    /// Calibrates the tick length. Takes 20 ms.
    TickClock();

    static std::uint64_t now() noexcept
    {
#if defined(__x86_64__)
        return __rdtsc();
#else
        return static_cast<std::uint64_t>(
            std::chrono::steady_clock::now().time_since_epoch().count());
#endif
    }
    double nanoseconds(std::uint64_t ticks) const noexcept
    {
        return static_cast<double>(ticks) * ns_per_tick_;
    }
    /// The duration of one reading, which is included in every interval.
    double readingNanoseconds() const noexcept
    {
        return reading_ns_;
    }

private:
    double ns_per_tick_ = 1.0;
    double reading_ns_ = 0.0;
};

} // namespace marsview
