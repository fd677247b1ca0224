// Converts between Force Dimension's frame and the workspace frame: pure functions.
//
// Force Dimension uses meters and newtons, x toward the user, y right, z up; the workspace frame
// has x right, y away from the user, z up.
#pragma once

#include "haptics/device/orientation.h"
#include "haptics/device/workspace.h"

#include <array>

namespace marsview {

constexpr WorkspacePoint fromDhd(const std::array<double, 3>& m)
{
    return {m[1], -m[0], m[2]};
}

constexpr std::array<double, 3> forceToDhd(const Vec3& force_n)
{
    return {-force_n.y, force_n.x, force_n.z};
}

/// `frame` holds the rows of the wrist's rotation matrix. The stylus lies along their x axis where
/// it is the identity: level, the tip away from the user, as in the reference orientation.
inline Orientation orientationFromDhd(const std::array<std::array<double, 3>, 3>& frame) noexcept
{
    const Orientation theirs = orientationOf(frame);
    return {theirs.w, theirs.y, -theirs.x, theirs.z};
}

} // namespace marsview
