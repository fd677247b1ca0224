// A tick of a recording, as a device plays it back.
#pragma once

#include "core/base/vec.h"
#include "core/contact/goal_frame.h"
#include "core/geo/frames.h"

#include <cstdint>
#include <optional>

namespace marsview {

/// The interaction mode. As in section 4.2 of the paper "Large Haptic Topographic Maps", the effect
/// of a grab depends on whether the stylus touches the surface.
enum class StylusMode : std::uint8_t {
    Hover, // in free space above the surface
    Press, // into the surface
    Pan,   // grabbed in contact: the map moves with the hand
    Zoom,  // grabbed in free space
};

/// A motion of what the hand sees in the scene, as by panning, zooming and turning the map: `from`
/// moves to `to`, and everything else with it.
struct SceneMotion {
    ScenePoint from{};
    ScenePoint to{};
    double scale = 1.0;    // of distances about the point; > 0
    double turn_rad = 0.0; // about the vertical through it, counterclockwise seen from above
    /// On a body, whose scene is the body-fixed frame: about this axis through it, as long as the
    /// angle; turn_rad is then 0.
    std::optional<Vec3> body_turn_rad{};

    constexpr bool operator==(const SceneMotion&) const = default;
};

/// Only the goal is in every file of goals.
struct RecordedTick {
    TracePoint goal{};
    std::optional<Vec3> force_n{}; // on the hand
    std::optional<StylusMode> mode{};
    std::optional<SceneMotion> motion{};
};

} // namespace marsview
