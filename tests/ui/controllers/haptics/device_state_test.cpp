// The transitions between the states of a connection: every row of the table in device_state.h.
#include "ui/controllers/haptics/device_state.h"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <vector>

namespace marsview {
namespace {

using State = DeviceState;
using Event = DeviceEvent;

constexpr std::array kStates{
    State::Idle,
    State::Opening,
    State::OpeningRemembered,
    State::OpeningRecording,
    State::Reopening,
    State::Returning,
    State::Connected,
    State::Reconnected,
    State::Replaying,
    State::Awaiting,
    State::Lost,
    State::LostAndGone,
    State::LostAndRefused,
};
constexpr std::array kEvents{
    Event::DeviceChosen, Event::AwaitedChosen, Event::RememberedChosen, Event::RecordingChosen,
    Event::Opened,       Event::Absent,        Event::Refused,          Event::Missed,
    Event::Lost,         Event::RecordingOver, Event::Disconnected,     Event::Closed,
};

DeviceTransitions after(std::initializer_list<Event> events)
{
    DeviceTransitions transitions;
    for (const Event event : events) {
        transitions.take(event);
    }
    return transitions;
}

// In a state, by the shortest way to it. A recording takes the place of nothing.
DeviceTransitions in(State state)
{
    switch (state) {
    case State::Idle:
        return {};
    case State::Opening:
        return after({Event::DeviceChosen});
    case State::OpeningRemembered:
        return after({Event::RememberedChosen});
    case State::OpeningRecording:
        return after({Event::RecordingChosen});
    case State::Reopening:
        return after({Event::DeviceChosen, Event::Opened, Event::Lost, Event::AwaitedChosen});
    case State::Returning:
        return after(
            {Event::DeviceChosen, Event::RecordingChosen, Event::Opened, Event::RecordingOver});
    case State::Connected:
        return after({Event::DeviceChosen, Event::Opened});
    case State::Reconnected:
        return after(
            {Event::DeviceChosen, Event::Opened, Event::Lost, Event::AwaitedChosen, Event::Opened});
    case State::Replaying:
        return after({Event::RecordingChosen, Event::Opened});
    case State::Awaiting:
        return after({Event::RememberedChosen, Event::Absent});
    case State::Lost:
        return after({Event::DeviceChosen, Event::Opened, Event::Lost});
    case State::LostAndGone:
        return after({Event::DeviceChosen, Event::Opened, Event::Lost, Event::Missed});
    case State::LostAndRefused:
        return after({Event::DeviceChosen, Event::Opened, Event::Lost, Event::AwaitedChosen,
                      Event::Refused});
    }
    return {};
}

struct Row {
    State state;
    Event event;
    State next;
};

// All that change the state; in the others the event changes nothing.
const std::vector<Row>& table()
{
    static const std::vector<Row> kRows = [] {
        std::vector<Row> rows{
            {State::Opening, Event::Opened, State::Connected},
            {State::OpeningRemembered, Event::Opened, State::Connected},
            {State::Returning, Event::Opened, State::Connected},
            {State::Reopening, Event::Opened, State::Reconnected},
            {State::OpeningRecording, Event::Opened, State::Replaying},
            {State::Opening, Event::Absent, State::Idle},
            {State::Opening, Event::Refused, State::Idle},
            {State::OpeningRemembered, Event::Absent, State::Awaiting},
            {State::OpeningRemembered, Event::Refused, State::Idle},
            {State::OpeningRecording, Event::Absent, State::Idle},
            {State::OpeningRecording, Event::Refused, State::Idle},
            {State::Reopening, Event::Absent, State::LostAndRefused},
            {State::Reopening, Event::Refused, State::LostAndRefused},
            {State::Returning, Event::Absent, State::Awaiting},
            {State::Returning, Event::Refused, State::Awaiting},
            {State::Lost, Event::Missed, State::LostAndGone},
            {State::Connected, Event::Lost, State::Lost},
            {State::Reconnected, Event::Lost, State::Lost},
            {State::Connected, Event::RecordingOver, State::Idle},
            {State::Reconnected, Event::RecordingOver, State::Idle},
            {State::Replaying, Event::RecordingOver, State::Idle},
        };
        for (const State state : kStates) {
            const bool was_lost = state == State::Lost || state == State::LostAndGone;
            rows.push_back({state, Event::DeviceChosen, State::Opening});
            rows.push_back(
                {state, Event::AwaitedChosen, was_lost ? State::Reopening : State::Opening});
            rows.push_back({state, Event::RememberedChosen, State::OpeningRemembered});
            rows.push_back({state, Event::RecordingChosen, State::OpeningRecording});
            rows.push_back({state, Event::Disconnected, State::Idle});
        }
        for (const State state :
             {State::Opening, State::OpeningRemembered, State::OpeningRecording, State::Reopening,
              State::Returning, State::Connected, State::Reconnected, State::Replaying}) {
            rows.push_back({state, Event::Closed, State::Idle});
        }
        return rows;
    }();
    return kRows;
}

State expectedAfter(State state, Event event)
{
    for (const Row& row : table()) {
        if (row.state == state && row.event == event) {
            return row.next;
        }
    }
    return state;
}

TEST(DeviceTransitions, EveryEventInEveryStateLeadsWhereTheTableSays)
{
    for (const State state : kStates) {
        for (const Event event : kEvents) {
            DeviceTransitions transitions = in(state);
            ASSERT_EQ(transitions.state(), state);
            EXPECT_EQ(transitions.take(event), expectedAfter(state, event))
                << "state " << static_cast<int>(state) << ", event " << static_cast<int>(event);
        }
    }
}

TEST(DeviceTransitions, WhatARecordingTookThePlaceOfFollowsIt)
{
    for (const State before : kStates) {
        if (before == State::OpeningRecording || before == State::Replaying) {
            continue; // see below
        }
        const State expected = isOpening(before) || isConnected(before) ? State::Returning
                               : isAwaiting(before)                     ? State::Awaiting
                                                                        : State::Idle;
        DeviceTransitions ended = in(before);
        ended.take(Event::RecordingChosen);
        ended.take(Event::Opened);
        EXPECT_EQ(ended.take(Event::RecordingOver), expected) << static_cast<int>(before);
        DeviceTransitions refused = in(before);
        refused.take(Event::RecordingChosen);
        EXPECT_EQ(refused.take(Event::Refused), expected) << static_cast<int>(before);
    }
}

TEST(DeviceTransitions, ASecondRecordingTakesThePlaceOfTheSameDevice)
{
    DeviceTransitions transitions =
        after({Event::DeviceChosen, Event::Opened, Event::RecordingChosen, Event::RecordingChosen,
               Event::Opened, Event::RecordingChosen, Event::Opened});
    EXPECT_EQ(transitions.take(Event::RecordingOver), State::Returning);
    // And it is forgotten with the next choice.
    transitions.take(Event::Disconnected);
    transitions.take(Event::RecordingChosen);
    transitions.take(Event::Opened);
    EXPECT_EQ(transitions.take(Event::RecordingOver), State::Idle);
}

// Else a device that fails while it is plugged in would be opened again and again.
TEST(DeviceTransitions, ADeviceThatIsLostAgainMustBeMissedAgain)
{
    DeviceTransitions transitions = in(State::LostAndGone);
    transitions.take(Event::AwaitedChosen);
    transitions.take(Event::Opened);
    ASSERT_EQ(transitions.state(), State::Reconnected);
    EXPECT_EQ(transitions.take(Event::Lost), State::Lost);
    EXPECT_EQ(transitions.take(Event::Missed), State::LostAndGone);
}

TEST(DeviceTransitions, ALossIsRememberedUntilAnotherChoice)
{
    for (const State state : {State::Lost, State::LostAndGone, State::Reopening, State::Reconnected,
                              State::LostAndRefused}) {
        EXPECT_TRUE(isAfterLoss(state));
        for (const Event event : {Event::DeviceChosen, Event::RecordingChosen,
                                  Event::RememberedChosen, Event::Disconnected}) {
            DeviceTransitions transitions = in(state);
            EXPECT_FALSE(isAfterLoss(transitions.take(event))) << static_cast<int>(state);
        }
    }
}

TEST(DeviceTransitions, AStateIsOfOneKind)
{
    for (const State state : kStates) {
        const int kinds = static_cast<int>(isOpening(state)) +
                          static_cast<int>(isConnected(state)) +
                          static_cast<int>(isAwaiting(state));
        const bool is_none = state == State::Idle || state == State::LostAndRefused;
        EXPECT_EQ(kinds, is_none ? 0 : 1) << static_cast<int>(state);
    }
}

} // namespace
} // namespace marsview
