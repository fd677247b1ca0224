// What the servo loop tells of itself while it runs.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "haptics/interaction/mouse_stylus.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/loop/safety_limiter.h"

#include <cstdint>

namespace marsview {

/// Sums since the loop began; those of the first ticks are left out like their times.
struct LoopCounts {
    std::uint64_t ticks = 0;
    std::uint64_t in_contact = 0;
    std::uint64_t cut_short = 0;         // updates of the contact model that its bound ended
    std::uint64_t ticks_with_misses = 0; // some terrain was not there at full resolution
    std::uint64_t samples_missed = 0;
    std::uint64_t let_go = 0;       // ticks without force, whatever the reason
    std::uint64_t damped = 0;       // ticks in which damping was added to stay passive
    std::uint64_t read_errors = 0;  // of the device
    std::uint64_t not_recorded = 0; // ticks that a recording could not take
};

/// Of one tick. Trivially copyable, for a SeqLock.
struct LoopState {
    std::uint64_t tick = 0;
    std::int64_t time_ns = 0; // steady clock
    WorkspacePoint hand{};
    ScenePoint goal{};
    ContactState contact;
    StylusMode mode = StylusMode::Hover;
    LetGoReason reason = LetGoReason::NoTouch;
    Vec3 force_n{};
    double ground_share = 1.0;
    double stiffness_n_per_m = 0.0;
    double tick_s = 0.0; // how long the tick took
    /// As the hand has moved the map; `frame_number` is that of the settings it began with.
    WorkspaceFrame frame;
    std::uint64_t frame_number = 0;
    LoopCounts counts;
    bool is_finished = false; // the device has ended, or was lost
    /// No tick comes any more, and all of the above is of the last one (ServoLoop::isStalled).
    /// Where force_n is not zero all the same, the motors may still have it.
    bool is_stalled = false;
};

/// Something that happened, in order.
enum class LoopEventKind : std::uint8_t { ModeChanged, MapChanged, LetGo, Holding };

struct LoopEvent {
    LoopEventKind kind = LoopEventKind::LetGo;
    StylusMode mode = StylusMode::Hover;
    LetGoReason reason = LetGoReason::None; // of letting go
    std::uint64_t tick = 0;
};

/// What ground was touched, and how.
struct TouchedGround {
    std::uint64_t serial = 0; // ServoMap's: no two contact models have the same
    std::uint64_t map_id = 0;
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0; // of VirtualProxy's sphere, scene metres
    double exaggeration = 1.0;

    bool operator==(const TouchedGround&) const = default;
};

/// One update of the contact model, and the tick it was part of: what is recorded.
struct TickRecord {
    std::uint64_t tick = 0;
    std::int64_t time_ns = 0; // steady clock
    TracePoint goal{};
    TracePoint proxy{};
    Vec3 force_n{}; // on the hand
    WorkspacePoint hand{};
    StylusMode mode = StylusMode::Hover;
    LetGoReason reason = LetGoReason::None;
    bool is_in_contact = false;
    bool has_goal = false; // false: the contact model was not asked in this tick
    float tick_us = 0.0F;
    TouchedGround ground{};
    std::uint32_t ground_records = 0; // of what its ground was, since the last update
};

} // namespace marsview
