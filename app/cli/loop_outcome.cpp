#include "app/cli/loop_outcome.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr std::string_view kWhatToDo = "connect it again; if that does not help, update its driver";

std::uint64_t& of(std::array<std::uint64_t, kForceOffReasonCount>& ticks, ForceOffReason reason)
{
    return ticks.at(static_cast<std::size_t>(reason));
}

} // namespace

void LoopWatch::look(ServoLoop& loop, Clock::time_point now)
{
    LoopEvent event;
    while (loop.nextEvent(event)) {
        if (event.kind != LoopEventKind::ForceOff && event.kind != LoopEventKind::Holding) {
            continue;
        }
        if (event.tick > ticks_max_) {
            continue; // the normal end: the force ramps down as for an unready device
        }
        // The tick of the event is the first one with the new reason.
        of(ticks_by_reason_, reason_) += event.tick - 1 - since_tick_;
        since_tick_ = event.tick - 1;
        reason_ = event.reason;
        if (reason_ != ForceOffReason::None && reason_ != ForceOffReason::NoTouch) {
            last_reason_ = reason_;
        }
    }
    const LoopState state = loop.state();
    if (state.tick != state_.tick) {
        ticked_ = now;
    }
    has_ended_ = loop.hasEnded();
    is_silent_ = !has_ended_ && now - ticked_ >= kSilenceMax;
    state_ = state;
    trouble_ = loop.trouble();
    rate_hz_ = loop.device().rate_hz;
}

std::array<std::uint64_t, kForceOffReasonCount> LoopWatch::forceOffTicks() const noexcept
{
    auto ticks = ticks_by_reason_;
    const std::uint64_t end = std::min(state_.tick, ticks_max_);
    if (end > since_tick_) {
        ticks[static_cast<std::size_t>(reason_)] += end - since_tick_;
    }
    ticks[static_cast<std::size_t>(ForceOffReason::None)] = 0;
    return ticks;
}

Status LoopWatch::verdict(const std::string& uri) const
{
    const double ran_s = static_cast<double>(state_.tick) / rate_hz_;
    // A driver's message usually ends with the remedy.
    const auto said = [&](std::string_view otherwise) {
        if (trouble_.empty()) {
            return fmt::format("{}; {}", otherwise, kWhatToDo);
        }
        return trouble_.find(';') == std::string::npos ? fmt::format("{}; {}", trouble_, kWhatToDo)
                                                       : trouble_;
    };
    if (state_.tick == 0) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: the loop did not start: {}", uri,
                                                        said("the device never called it"))};
    }
    const bool is_finished = last_reason_ == ForceOffReason::DeviceFinished;
    const bool is_cut_short = has_ended_ && !is_finished && state_.tick < ticks_max_;
    if (is_silent_ || (is_cut_short && !state_.is_finished)) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: fell silent after {:.1f} s: {}", uri, ran_s,
                                 said("the device stopped responding"))};
    }
    if (state_.is_finished && !is_finished) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: was lost after {:.1f} s: {}", uri,
                                                        ran_s, said("the device gives no reason"))};
    }
    if (forceOffTicks()[static_cast<std::size_t>(ForceOffReason::DeviceUnready)] >=
        std::min(state_.tick, ticks_max_)) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: did not become ready within {:.1f} s: {}", uri, ran_s,
                                 said("the device gives no reason"))};
    }
    if (forceOffTicks()[static_cast<std::size_t>(ForceOffReason::DeviceStale)] >=
        std::min(state_.tick, ticks_max_)) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: every sample was too old or in the future; its driver must "
                                 "use CLOCK_MONOTONIC time stamps",
                                 uri)};
    }
    // Failures that did not affect the device, such as of a recording.
    if (!trouble_.empty() && last_reason_ != ForceOffReason::DeviceUnready) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: {}", uri, trouble_)};
    }
    return Done{};
}

} // namespace marsview
