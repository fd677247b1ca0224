// The mouse as a stylus: where in space it points.
#pragma once

#include "core/base/vec.h"
#include "core/geo/frames.h"

namespace marsview {

/// What the hand with the mouse is doing. As in section 4.2 of the paper "Large Haptic Topographic
/// Maps", what a grab does depends on whether the stylus touches the ground.
enum class StylusMode {
    Hover, // in free space above the ground
    Press, // into the ground
    Pan,   // grabbed in contact: the map moves with the hand
    Zoom,  // grabbed in free space
};

/// What the hand holds down.
struct StylusButtons {
    bool is_pressing = false; // left mouse button
    bool is_grabbing = false; // space bar
};

/// The mode that follows: a grab keeps the mode with which it began until it ends.
StylusMode nextMode(StylusMode mode, const StylusButtons& buttons, bool is_in_contact) noexcept;

/// A mouse knows no depth: the stylus hovers at a steady height over the ground behind the pointer
/// and is pressed to a steady depth below it. Both are lengths of the hand, so that they look and
/// feel the same at every zoom; the wheel changes the depth while pressing.
struct StylusReach {
    double hover_points = 26.0; // of the screen
    double depth_points = 30.0;
};

inline constexpr double kStylusDepthMin = 4.0; // points
inline constexpr double kStylusDepthMax = 120.0;

/// Where the stylus aims: above or below `ground`. `point_m` is what a point of the screen is long
/// there, in scene metres.
ScenePoint stylusGoal(const ScenePoint& ground,
                      const StylusReach& reach,
                      bool is_pressing,
                      double point_m) noexcept;

/// How the hand is laid over the view: a point of the screen is this long at the hand, which makes
/// a window of 800 points 160 mm high, about what a desktop stylus reaches.
inline constexpr double kHandMetresPerPoint = 2e-4;

/// The spring between proxy and goal, in the range in which desktop devices are stable.
inline constexpr double kStiffnessNPerM = 300.0;

/// The force that fills the meter: what desktop devices sustain for a moment.
inline constexpr double kForceNMax = 3.3;

/// The force on the hand in newtons: the spring from `goal` to `proxy`, cut off at kForceNMax.
/// `point_m` > 0.
Vec3 stylusForce(const ScenePoint& proxy, const ScenePoint& goal, double point_m) noexcept;

} // namespace marsview
