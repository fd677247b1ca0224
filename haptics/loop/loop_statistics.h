// Statistics of a loop with deadlines.
#pragma once

#include "haptics/loop/time_histogram.h"

#include <chrono>
#include <cstdint>

namespace marsview {

/// Times of the steady clock.
using LoopTime = std::chrono::steady_clock::time_point;

/// One turn of the loop.
struct LoopTurn {
    LoopTime deadline; // scheduled begin
    LoopTime begin;
    LoopTime end;
};

/// Counts of turns. A turn misses its deadline if it ends after the next turn's scheduled begin.
/// The loop itself is the cause if the tick alone took longer than a period, and the system is the
/// cause if the thread woke up too late.
struct LoopStatistics {
    TimeHistogram tick;     // duration of ticks
    TimeHistogram lateness; // of turn begins
    std::uint64_t missed_by_tick = 0;
    std::uint64_t missed_by_waking = 0;
    std::uint64_t skipped = 0; // turns that never began, because their time had passed
    // Page faults of the thread during these turns: without and with disk reads.
    std::uint64_t minor_faults = 0;
    std::uint64_t major_faults = 0;

    /// Counts the turn and returns when the next one begins: a whole number of periods later.
    LoopTime add(const LoopTurn& turn, std::chrono::nanoseconds period) noexcept
    {
        tick.record(turn.end - turn.begin);
        lateness.record(turn.begin - turn.deadline);
        const LoopTime next = turn.deadline + period;
        if (turn.end <= next) {
            return next;
        }
        ++(turn.end - turn.begin > period ? missed_by_tick : missed_by_waking);
        const auto over = (turn.end - next) / period;
        skipped += static_cast<std::uint64_t>(over);
        return next + over * period;
    }
};

} // namespace marsview
