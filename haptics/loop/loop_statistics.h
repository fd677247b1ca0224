// What is counted of a loop that has deadlines.
#pragma once

#include "haptics/loop/time_histogram.h"

#include <chrono>
#include <cstdint>

namespace marsview {

/// Times of the steady clock.
using LoopTime = std::chrono::steady_clock::time_point;

/// One turn of the loop.
struct LoopTurn {
    LoopTime deadline; // at which it was to begin
    LoopTime begin;
    LoopTime end;
};

/// Counts of turns. A turn has missed its deadline when it ends after the next one's beginning. It
/// is the loop's own fault where the tick alone took longer than a period, and the system's where
/// the thread was woken too late for its tick.
struct LoopStatistics {
    TimeHistogram tick;     // how long ticks took
    TimeHistogram lateness; // of their beginnings
    std::uint64_t missed_by_tick = 0;
    std::uint64_t missed_by_waking = 0;
    std::uint64_t skipped = 0; // turns that never began, as they were over already
    // Of the thread during these turns: taken from memory, and read from a disk.
    std::uint64_t minor_faults = 0;
    std::uint64_t major_faults = 0;

    /// Counts the turn and says when the next one begins: a whole number of periods later.
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
