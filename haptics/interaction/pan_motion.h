// A map that is pulled by a hand: it has inertia, and goes on by itself when it is let go.
#pragma once

#include "core/base/vec.h"

namespace marsview {

/// In the workspace, seen from above: what the hand feels of the map's mass is the same at every
/// zoom.
struct PanOptions {
    double mass_kg = 0.2;
    /// Between the hand and what it has grabbed: a stiff spring instead of a rigid hold, which no
    /// device renders. > 0.
    double grip_n_per_m = 250.0;
    double grip_n_s_per_m = 2.0;
    double drag_per_s = 0.7;        // share of the speed that is lost in a second, at first
    double speed_m_per_s_max = 0.5; // of a map that glides
};

struct PanState {
    Vec3 velocity_m_per_s{}; // of the map; level
    Vec3 stretch_m{};        // from what was grabbed to the hand; level
};

struct PanStep {
    Vec3 shift_m{}; // of the map
    Vec3 force_n{}; // on the hand
};

/// What moves goes on moving; only the hold begins without a stretch.
void grabMap(PanState& state) noexcept;

/// The hand holds the map and has moved by `hand_shift` within `dt_s` >= 0. `mass_share`, 0 to 1,
/// is of the mass: at 0, where the hand touches a wall, the map follows without inertia and the
/// force is zero. Implicit in time: no stiffness and no mass, however small, is too much for a
/// step.
PanStep pullMap(const PanOptions& options,
                PanState& state,
                const Vec3& hand_shift,
                double mass_share,
                double dt_s) noexcept;

/// Nobody holds the map. A wall that is touched, `mass_share` 0, takes its momentum.
PanStep
glideMap(const PanOptions& options, PanState& state, double mass_share, double dt_s) noexcept;

} // namespace marsview
