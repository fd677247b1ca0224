// The mouse as a stylus: mode, goal, force and pose.
#pragma once

#include "core/base/vec.h"
#include "core/contact/contact.h"
#include "core/geo/frames.h"
#include "haptics/device/recorded_tick.h"

namespace marsview {

/// The pressed buttons.
struct StylusButtons {
    bool is_pressing = false; // left mouse button
    bool is_grabbing = false; // space bar
};

/// The next mode: a grab keeps the mode in which it began until it ends.
StylusMode nextMode(StylusMode mode, const StylusButtons& buttons, bool is_in_contact) noexcept;

/// A mouse has no depth axis: the stylus hovers at a constant height above the surface under the
/// pointer and is pressed to a constant depth below it. Both are workspace lengths, so that they
/// look and feel the same at every zoom; the wheel changes the depth while pressing.
struct StylusReach {
    double hover_points = 26.0; // on the screen
    double depth_points = 30.0;
};

inline constexpr double kStylusDepthMin = 4.0; // points
inline constexpr double kStylusDepthMax = 120.0;

/// The goal: above or below `ground`. `point_m` is the length of a screen point there, in scene
/// meters.
ScenePoint stylusGoal(const ScenePoint& ground,
                      const StylusReach& reach,
                      bool is_pressing,
                      double point_m) noexcept;

/// The workspace length of a screen point: a window of 800 points is then 160 mm high, about the
/// reach of a desktop stylus.
inline constexpr double kHandMetersPerPoint = 2e-4;

/// The spring between proxy and goal, in the range in which desktop devices are stable.
inline constexpr double kStiffnessNPerM = 300.0;

/// The full scale of the force meter: the typical peak force of desktop devices.
inline constexpr double kForceNMax = 3.3;

/// The force on the hand in newtons: the spring from `goal` to `proxy`, limited to kForceNMax.
/// `point_m` > 0.
Vec3 stylusForce(const ScenePoint& proxy, const ScenePoint& goal, double point_m) noexcept;

/// The stylus and its contact force. In scene coordinates.
struct StylusPose {
    StylusMode mode = StylusMode::Hover;
    ScenePoint proxy;
    ScenePoint goal;
    bool is_in_contact = false;
    Vec3 force_n{};                  // on the hand
    double force_n_max = kForceNMax; // its maximum

    bool operator==(const StylusPose&) const = default;
};

/// While a contact is kept, at its proxy and with its force; otherwise at `free`, without a force.
/// `point_m` > 0.
StylusPose stylusPose(StylusMode mode,
                      const ContactState& contact,
                      const ScenePoint& goal,
                      const ScenePoint& free,
                      double point_m) noexcept;

} // namespace marsview
