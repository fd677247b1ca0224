// The state that the servo loop publishes while it runs.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "haptics/interaction/mouse_stylus.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/loop/safety_limiter.h"

#include <cstdint>
#include <limits>

namespace marsview {

/// Totals since the loop began; the first, uncounted ticks are excluded here as from the times.
struct LoopCounts {
    std::uint64_t ticks = 0;
    std::uint64_t in_contact = 0;
    std::uint64_t cut_short = 0;         // contact updates that reached their bound
    std::uint64_t ticks_with_misses = 0; // some terrain was not available at full resolution
    std::uint64_t samples_missed = 0;
    std::uint64_t force_off = 0;    // ticks with the force off, for any reason
    std::uint64_t damped = 0;       // ticks with added damping for passivity
    std::uint64_t read_errors = 0;  // of the device
    std::uint64_t not_recorded = 0; // ticks that did not fit into a recording
};

/// One tick. Trivially copyable, for a SeqLock.
struct LoopState {
    std::uint64_t tick = 0;
    std::int64_t time_ns = 0; // steady clock
    WorkspacePoint hand{};
    ScenePoint goal{};
    ContactState contact;
    StylusMode mode = StylusMode::Hover;
    ForceOffReason reason = ForceOffReason::NoTouch;
    Vec3 force_n{};
    bool is_force_recorded = false; // force_n is that of a recording; no device gets it
    bool is_at_edge = false;        // of the map
    double ground_share = 1.0;
    double stiffness_n_per_m = 0.0;
    double tick_s = 0.0; // how long the tick took
    /// As moved by the hand; `frame_number` is that of the settings from which it started.
    WorkspaceFrame frame;
    WorkspaceFrame seen_frame; // which the camera follows; `frame` also moves to fit the view
    std::uint64_t frame_number = 0;
    LoopCounts counts;
    bool is_finished = false; // the device has finished, or was lost
    /// Ticks have stopped, and all of the above is from the last one (ServoLoop::isStalled). If
    /// force_n is not zero, the motors may still apply it.
    bool is_stalled = false;
};

/// Events, in order.
enum class LoopEventKind : std::uint8_t {
    ModeChanged,
    MapChanged,
    ForceOff,
    Holding,
    PointPressed,  ///< the button that sets points went down (LoopSettings::is_placing)
    PointReleased, ///< and up again
};

struct LoopEvent {
    LoopEventKind kind = LoopEventKind::ForceOff;
    StylusMode mode = StylusMode::Hover;
    ForceOffReason reason = ForceOffReason::None; // for ForceOff
    std::uint64_t tick = 0;
    ScenePoint place{}; // for PointPressed and PointReleased: the proxy, or the hand in free space
};

/// The terrain that was touched, and the contact settings.
struct TouchedGround {
    std::uint64_t serial = 0; // ServoMap's; unique per contact model
    std::uint64_t map_id = 0;
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0; // of VirtualProxy's sphere, scene meters
    double exaggeration = 1.0;

    bool operator==(const TouchedGround&) const = default;
};

/// One update of the contact model, and its tick: the unit of a recording.
struct TickRecord {
    std::uint64_t tick = 0;
    std::int64_t time_ns = 0; // steady clock
    TracePoint goal{};
    TracePoint proxy{};
    Vec3 force_n{}; // on the hand
    WorkspacePoint hand{};
    StylusMode mode = StylusMode::Hover;
    ForceOffReason reason = ForceOffReason::None;
    bool is_in_contact = false;
    bool has_goal = false; // false: the contact model was not updated in this tick
    bool has_motion = false;
    SceneMotion motion{}; // of the map by the hand, since the last update that was recorded
    /// Of the surface straight below or above the hand, in the workspace; NaN outside the map.
    double surface_z_m = std::numeric_limits<double>::quiet_NaN();
    float tick_us = 0.0F;
    TouchedGround ground{};
    bool is_on_body = false;          // the map lies on its body
    std::uint32_t ground_records = 0; // number of terrain records since the last update
};

} // namespace marsview
