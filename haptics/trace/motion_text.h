// Modes and motions of the map in recordings.
#pragma once

#include "haptics/device/recorded_tick.h"

#include <optional>
#include <string>
#include <string_view>

namespace marsview {

/// "hover", "press", "pan", "zoom".
std::string_view stylusModeName(StylusMode mode) noexcept;
std::optional<StylusMode> stylusMode(std::string_view name) noexcept;

/// The column of a recording with motions of the map; empty where the hand has not moved it.
inline constexpr std::string_view kMotionColumn = "motion";

/// "1 2 3 1.5 2 3 0.5 0": where a point of the scene is, where it moves to, the scale and the turn
/// in radians. On a body, three numbers for the turn: its axis in the body-fixed frame, as long as
/// the angle. Exact: parseMotion() gives the same motion to the bit.
std::string motionText(const SceneMotion& motion);
/// Empty if `text` is not such a motion, or its scale is not positive.
std::optional<SceneMotion> parseMotion(std::string_view text);

} // namespace marsview
