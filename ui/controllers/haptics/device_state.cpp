#include "ui/controllers/haptics/device_state.h"

namespace marsview {

DeviceState DeviceTransitions::take(DeviceEvent event) noexcept
{
    if (event == DeviceEvent::RecordingChosen) {
        after_recording_ = afterChoiceOfRecording();
    }
    state_ = next(event);
    return state_;
}

DeviceState DeviceTransitions::next(DeviceEvent event) const noexcept
{
    using enum DeviceState;
    switch (event) {
    case DeviceEvent::DeviceChosen:
        return Opening;
    case DeviceEvent::AwaitedChosen:
        return state_ == Lost || state_ == LostAndGone ? Reopening : Opening;
    case DeviceEvent::RememberedChosen:
        return OpeningRemembered;
    case DeviceEvent::RecordingChosen:
        return OpeningRecording;
    case DeviceEvent::Opened:
        return state_ == Reopening          ? Reconnected
               : state_ == OpeningRecording ? Replaying
               : isOpening(state_)          ? Connected
                                            : state_;
    case DeviceEvent::Absent:
    case DeviceEvent::Refused:
        return afterFailure(event);
    case DeviceEvent::Missed:
        return state_ == Lost ? LostAndGone : state_;
    case DeviceEvent::Lost:
        return state_ == Connected || state_ == Reconnected ? Lost : state_;
    case DeviceEvent::RecordingOver:
        return state_ == Replaying ? after_recording_ : isConnected(state_) ? Idle : state_;
    case DeviceEvent::Disconnected:
        return Idle;
    case DeviceEvent::Closed:
        return isOpening(state_) || isConnected(state_) ? Idle : state_;
    }
    return state_;
}

DeviceState DeviceTransitions::afterFailure(DeviceEvent event) const noexcept
{
    using enum DeviceState;
    switch (state_) {
    case Opening:
        return Idle;
    case OpeningRemembered:
        return event == DeviceEvent::Absent ? Awaiting : Idle;
    case OpeningRecording:
        return after_recording_;
    case Reopening:
        return LostAndRefused;
    case Returning:
        return Awaiting;
    default:
        return state_;
    }
}

DeviceState DeviceTransitions::afterChoiceOfRecording() const noexcept
{
    using enum DeviceState;
    if (state_ == OpeningRecording || state_ == Replaying) {
        return after_recording_; // one recording takes the place of another
    }
    if (isOpening(state_) || isConnected(state_)) {
        return Returning;
    }
    return isAwaiting(state_) ? Awaiting : Idle;
}

bool isOpening(DeviceState state) noexcept
{
    using enum DeviceState;
    return state == Opening || state == OpeningRemembered || state == OpeningRecording ||
           state == Reopening || state == Returning;
}

bool isConnected(DeviceState state) noexcept
{
    using enum DeviceState;
    return state == Connected || state == Reconnected || state == Replaying;
}

bool isAwaiting(DeviceState state) noexcept
{
    using enum DeviceState;
    return state == Awaiting || state == Lost || state == LostAndGone;
}

bool isAfterLoss(DeviceState state) noexcept
{
    using enum DeviceState;
    return state == Lost || state == LostAndGone || state == LostAndRefused || state == Reopening ||
           state == Reconnected;
}

} // namespace marsview
