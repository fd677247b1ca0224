// Between the frame of OpenHaptics and ours: pure functions.
//
// OpenHaptics counts in millimetres, x right, y up, z towards the user; the workspace in metres,
// x right, y away from the user, z up. Forces are newtons in both.
#pragma once

#include "haptics/device/workspace.h"

#include <array>

namespace marsview {

constexpr WorkspacePoint fromOpenHaptics(const std::array<double, 3>& mm)
{
    return {mm[0] / 1000.0, -mm[2] / 1000.0, mm[1] / 1000.0};
}

/// Lowest corner, then highest.
constexpr WorkspaceBox boxFromOpenHaptics(const std::array<double, 6>& mm)
{
    return {{mm[0] / 1000.0, -mm[5] / 1000.0, mm[1] / 1000.0},
            {mm[3] / 1000.0, -mm[2] / 1000.0, mm[4] / 1000.0}};
}

constexpr std::array<double, 3> forceToOpenHaptics(const Vec3& force_n)
{
    return {force_n.x, force_n.z, -force_n.y};
}

} // namespace marsview
