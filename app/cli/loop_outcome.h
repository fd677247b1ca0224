// What became of a device in a loop: for how long its forces were let go, and whether it failed.
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

    /// A device that has not called or answered the tick for so long does not work.
    static constexpr std::chrono::seconds kSilenceMax{5};

    /// `ticks_max` is the loop's: one that ends by itself before that has failed.
    LoopWatch(std::uint64_t ticks_max, Clock::time_point now)
        : ticks_max_(ticks_max)
        , ticked_(now)
    {}

    /// Takes all events that there are. Call it several times a second, then once before the loop
    /// is stopped: how that lets go counts as nothing that happened, and neither does how a loop
    /// that has run for all its ticks does.
    void look(ServoLoop& loop, Clock::time_point now);

    /// Whether the last look was of a device that has been silent for kSilenceMax.
    bool isSilent() const noexcept { return is_silent_; }
    /// Up to the last look, by reason; NoTouch too.
    std::array<std::uint64_t, kLetGoReasonCount> letGoTicks() const noexcept;
    /// The last that was not NoTouch; None where forces were never let go.
    LetGoReason lastReason() const noexcept { return last_reason_; }
    /// Done, or what the device did instead of running to the end: it never ticked, never became
    /// ready, never had a sample of now, was lost or fell silent; or, where it ran, what else went
    /// wrong. Begins with `uri`.
    Status verdict(const std::string& uri) const;

private:
    std::uint64_t ticks_max_;
    std::array<std::uint64_t, kLetGoReasonCount> ticks_by_reason_{};
    LetGoReason reason_ = LetGoReason::NoTouch; // since since_tick_
    LetGoReason last_reason_ = LetGoReason::None;
    std::uint64_t since_tick_ = 0;
    LoopState state_;
    std::string trouble_;
    double rate_hz_ = 1000.0;
    Clock::time_point ticked_;
    bool is_silent_ = false;
    bool has_ended_ = false; // by itself
};

} // namespace marsview
