#include "app/bench/tick_clock.h"

namespace marsview {

TickClock::TickClock()
{
    using Steady = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kSpan{20};
    const auto begin = Steady::now();
    const std::uint64_t ticks_begin = now();
    std::uint64_t ticks = 0;
    auto end = begin;
    while (end - begin < kSpan) {
        end = Steady::now();
        ticks = now() - ticks_begin;
    }
    ns_per_tick_ =
        std::chrono::duration<double, std::nano>(end - begin).count() / static_cast<double>(ticks);
    constexpr int kReadings = 10000;
    const std::uint64_t first = now();
    std::uint64_t last = first;
    for (int i = 0; i < kReadings; ++i) {
        last = now();
    }
    reading_ns_ = nanoseconds(last - first) / kReadings;
}

} // namespace marsview
