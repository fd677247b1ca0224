// Panning of a map with inertia: it keeps moving after it is released.
#pragma once

#include "core/base/vec.h"

#include <limits>

namespace marsview {

/// In the workspace, horizontally: the map's mass feels the same at every zoom.
struct PanOptions {
    double mass_kg = 0.2;
    /// Between the hand and the grabbed point: a stiff spring instead of a rigid hold, which
    /// devices cannot render. > 0.
    double grip_n_per_m = 250.0;
    double grip_n_s_per_m = 2.0;
    /// After a grab the force may grow by 0.02 N in a millisecond: where a moving hand grabs a map
    /// at rest, the grabbed point slips instead of knocking.
    double grip_rate_n_per_s_max = 20.0;
    double drag_per_s = 0.7;        // decay rate of the speed
    double speed_m_per_s_max = 0.5; // of a gliding map
};

struct PanState {
    Vec3 velocity_m_per_s{}; // of the map; horizontal
    Vec3 stretch_m{};        // from the grabbed point to the hand; horizontal
    /// Of the hold; it grows from the grab on.
    double force_n_max = std::numeric_limits<double>::infinity();
};

struct PanStep {
    Vec3 shift_m{}; // of the map
    Vec3 force_n{}; // on the hand
};

/// The map keeps its velocity. The hold begins with the stretch at which it exerts the horizontal
/// part of `force_n` on a hand of this velocity: the force does not step at the grab.
void grabMap(const PanOptions& options,
             PanState& state,
             const Vec3& force_n,
             const Vec3& hand_m_per_s) noexcept;

/// The hand holds the map and has moved by `hand_shift` within `dt_s` >= 0. `mass_share`, 0 to 1,
/// scales the mass: at 0, where the hand touches a wall, the map follows without inertia and the
/// force is zero. Implicit in time: stable for any stiffness and any mass. The force is what
/// changes the map's momentum, and its drag.
PanStep pullMap(const PanOptions& options,
                PanState& state,
                const Vec3& hand_shift,
                double mass_share,
                double dt_s) noexcept;

/// Something has moved the map back by `shift`, horizontally, after a step. It loses its velocity
/// in the opposite direction. `hold_share`, 0 to 1, of the shift stretches the hold.
void stopMap(PanState& state, const Vec3& shift, double hold_share) noexcept;

/// The map is not held. If a wall is touched, `mass_share` 0, it loses its momentum.
PanStep
glideMap(const PanOptions& options, PanState& state, double mass_share, double dt_s) noexcept;

} // namespace marsview
