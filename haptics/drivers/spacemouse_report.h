// What 3Dconnexion's six-axis devices say: bytes to rates.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>

namespace marsview {

/// How far the cap is pushed and turned, as a share of what it can be, -1 to 1: the speeds that
/// are wished for. Axes: x right, y away from the user, z up; turns about them by the right hand.
struct SpaceMouseRates {
    Vec3 push;
    Vec3 turn;
    std::uint32_t buttons = 0; // bit 0: the first one

    bool isAtRest() const { return push == Vec3{} && turn == Vec3{}; }
};

/// Takes over what a report, its number in front, says. Older devices send pushes and turns in
/// reports of their own, newer ones together: the length tells. False where it says nothing.
bool takeSpaceMouseReport(std::span<const unsigned char> report, SpaceMouseRates& rates);

} // namespace marsview
