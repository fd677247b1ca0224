// The states of the connection to a haptic device, and the transitions between them.
#pragma once

#include <cstdint>

namespace marsview {

enum class DeviceState : std::uint8_t {
    Idle,              // nothing is connected, opened or awaited
    Opening,           // a device that was chosen, or an awaited one that was found
    OpeningRemembered, // the device of the settings, without being asked to
    OpeningRecording,
    Reopening,      // the lost device: its diagnostic log is continued
    Returning,      // the device that a recording took the place of
    Connected,      // to a device
    Reconnected,    // to the lost device
    Replaying,      // a recording in place of a device
    Awaiting,       // a device is missing; it is connected when it is found
    Lost,           // the same, but the device has not been missing from a search since
    LostAndGone,    // it has
    LostAndRefused, // the lost device was there again, but could not be opened
};

enum class DeviceEvent : std::uint8_t {
    DeviceChosen,     // to be opened
    AwaitedChosen,    // the same, and it is the awaited device: found, or connected by the user
    RememberedChosen, // to be opened without being asked to
    RecordingChosen,  // to be opened
    Opened,
    Absent,        // opening failed: the device is not plugged in
    Refused,       // opening failed for another reason
    Missed,        // a search did not find the awaited device
    Lost,          // the device has gone without being asked to
    RecordingOver, // it ended, was lost, was stopped, or does not match the maps
    Disconnected,  // by the user
    Closed,        // the program ends
};

/// Which state follows which. Not listed: the event changes nothing.
///
/// | state                                        | event            | next state            |
/// |----------------------------------------------|------------------|-----------------------|
/// | any                                          | DeviceChosen     | Opening               |
/// | Lost, LostAndGone                            | AwaitedChosen    | Reopening             |
/// | any other                                    | AwaitedChosen    | Opening               |
/// | any                                          | RememberedChosen | OpeningRemembered     |
/// | any                                          | RecordingChosen  | OpeningRecording      |
/// | Opening, OpeningRemembered, Returning        | Opened           | Connected             |
/// | Reopening                                    | Opened           | Reconnected           |
/// | OpeningRecording                             | Opened           | Replaying             |
/// | OpeningRemembered                            | Absent           | Awaiting              |
/// | Opening, OpeningRemembered                   | Absent, Refused  | Idle, unless above    |
/// | Returning                                    | Absent, Refused  | Awaiting              |
/// | Reopening                                    | Absent, Refused  | LostAndRefused        |
/// | OpeningRecording                             | Absent, Refused  | as with RecordingOver |
/// | Lost                                         | Missed           | LostAndGone           |
/// | Connected, Reconnected                       | Lost             | Lost                  |
/// | Replaying, before which a device was         |                  |                       |
/// | - being opened or connected                  | RecordingOver    | Returning             |
/// | - awaited                                    | RecordingOver    | Awaiting              |
/// | - neither                                    | RecordingOver    | Idle                  |
/// | Connected, Reconnected (a device may end)    | RecordingOver    | Idle                  |
/// | any                                          | Disconnected     | Idle                  |
/// | any, unless a device is awaited or refused   | Closed           | Idle                  |
///
/// A lost device is connected only once a search has missed it: else one that fails while it is
/// plugged in would be opened again and again.
class DeviceTransitions {
public:
    DeviceState state() const noexcept { return state_; }
    /// Returns the new state.
    DeviceState take(DeviceEvent event) noexcept;

private:
    DeviceState next(DeviceEvent event) const noexcept;
    DeviceState afterFailure(DeviceEvent event) const noexcept;
    DeviceState afterChoiceOfRecording() const noexcept;

    DeviceState state_ = DeviceState::Idle;
    // That a recording leads to: Returning, Awaiting or Idle.
    DeviceState after_recording_ = DeviceState::Idle;
};

/// A device or a recording is being opened.
bool isOpening(DeviceState state) noexcept;
/// A device or a recording is connected: there is a servo loop.
bool isConnected(DeviceState state) noexcept;
/// Nothing is connected, and a device will be when a search finds it.
bool isAwaiting(DeviceState state) noexcept;
/// The last device has gone without being asked to, and no other has been chosen since.
bool isAfterLoss(DeviceState state) noexcept;

} // namespace marsview
