// The outcome of a device in a loop: how long the force was off, and whether the device failed.
#pragma once

#include "core/base/result.h"
#include "haptics/loop/servo_loop.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

namespace marsview {

/// Follows a loop's events while it runs. One thread, the one that owns the loop.
class LoopWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device whose ticks have stopped for this long has failed.
    static constexpr std::chrono::seconds kSilenceMax{5};

    /// `ticks_max` is the loop's: a loop that ends by itself earlier has failed.
    LoopWatch(std::uint64_t ticks_max, Clock::time_point now)
        : ticks_max_(ticks_max)
        , ticked_(now)
    {}

    /// Takes all pending events. Call it several times a second, and once more before the loop is
    /// stopped: the ramp-down at the stop does not count as an event, nor does the end of a loop
    /// that has run for all its ticks.
    void look(ServoLoop& loop, Clock::time_point now);

    /// Whether the device has been silent for kSilenceMax at the last look().
    bool isSilent() const noexcept { return is_silent_; }
    /// Until the last look(), by reason, including NoTouch.
    std::array<std::uint64_t, kForceOffReasonCount> forceOffTicks() const noexcept;
    /// The last reason other than NoTouch; None if the force was never off for another reason.
    ForceOffReason lastReason() const noexcept { return last_reason_; }
    /// Done, or how the device failed to run to the end: it never ticked, never became ready, never
    /// delivered a current sample, was lost or fell silent; or, if it ran, what else went wrong.
    /// Begins with `uri`.
    Status verdict(const std::string& uri) const;

private:
    std::uint64_t ticks_max_;
    std::array<std::uint64_t, kForceOffReasonCount> ticks_by_reason_{};
    ForceOffReason reason_ = ForceOffReason::NoTouch; // since since_tick_
    ForceOffReason last_reason_ = ForceOffReason::None;
    std::uint64_t since_tick_ = 0;
    LoopState state_;
    std::string trouble_;
    double rate_hz_ = 1000.0;
    Clock::time_point ticked_;
    bool is_silent_ = false;
    bool has_ended_ = false; // by itself
};

} // namespace marsview
