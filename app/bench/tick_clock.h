// A clock for spans of nanoseconds that costs little to read.
#pragma once

#include <chrono>
#include <cstdint>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace marsview {

/// On x86-64 the processor's time stamp counter, elsewhere the system's steady clock. Spans are
/// good to about 20 ns, as the processor may run ahead of a reading.
class TickClock {
public:
    /// Learns the length of a tick. Takes 20 ms.
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
    /// What reading it costs: it is part of every span.
    double readingNanoseconds() const noexcept
    {
        return reading_ns_;
    }

private:
    double ns_per_tick_ = 1.0;
    double reading_ns_ = 0.0;
};

} // namespace marsview
