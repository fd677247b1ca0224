// Reports of 3Dconnexion six-axis devices: decoding.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>

namespace marsview {

/// How far the cap is pushed and turned, as a fraction of its range, -1 to 1: the requested
/// velocities. Axes: x right, y away from the user, z up; rotations about them are right-handed.
struct SpaceMouseRates {
    Vec3 push;
    Vec3 turn;
    std::uint32_t buttons = 0; // bit 0: the first one

    bool isAtRest() const { return push == Vec3{} && turn == Vec3{}; }
};

/// Updates `rates` from a report, which begins with its number. Older devices send translation and
/// rotation in separate reports, newer ones together: the length distinguishes them. Returns false
/// if the report has no rates or buttons.
bool takeSpaceMouseReport(std::span<const unsigned char> report, SpaceMouseRates& rates);

} // namespace marsview
