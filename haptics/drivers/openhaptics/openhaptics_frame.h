// Converts between the OpenHaptics frame and the workspace frame: pure functions.
//
// OpenHaptics uses millimeters, x right, y up, z toward the user; the workspace frame uses meters,
// x right, y away from the user, z up. Forces are in newtons in both.
#pragma once

#include "haptics/device/orientation.h"
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

/// `transform` is a 4x4 matrix, column-major. The stylus's own axes are converted as well: with the
/// identity it is level, and its tip points away from the user, in both frames.
inline Orientation orientationFromOpenHaptics(const std::array<double, 16>& transform) noexcept
{
    const auto& m = transform;
    const Orientation theirs =
        orientationOf({{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}});
    return {theirs.w, theirs.x, -theirs.z, theirs.y};
}

/// Their third gimbal angle is positive clockwise, seen from the back end of the stylus.
constexpr double twistFromOpenHaptics(double third_gimbal_rad)
{
    return -third_gimbal_rad;
}

constexpr std::array<double, 3> forceToOpenHaptics(const Vec3& force_n)
{
    return {force_n.x, force_n.z, -force_n.y};
}

} // namespace marsview
