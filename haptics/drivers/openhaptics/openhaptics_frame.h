// Converts between the OpenHaptics frame and the workspace frame: pure functions.
//
// OpenHaptics uses millimeters, x right, y up, z toward the user; the workspace frame uses meters,
// x right, y away from the user, z up. Forces are in newtons in both.
#pragma once

#include "haptics/device/workspace.h"

#include <array>

namespace marsview {

constexpr WorkspacePoint fromOpenHaptics(const std::array<double, 3>& mm)
{
    return {mm[0] / 1000.0, -mm[2] / 1000.0, mm[1] / 1000.0};
}

/// `mm` holds the minimum corner, then the maximum corner.
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
