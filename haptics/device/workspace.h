// The frame of devices, in which hands move and forces are felt.
#pragma once

#include "core/base/vec.h"

namespace marsview {

/// A position at a device, in metres: x right, y away from the user, z up. Every driver converts
/// its own axes and units to these at its edge. Forces in this frame are Vec3 in newtons.
struct WorkspacePoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr bool operator==(const WorkspacePoint&) const = default;
};

constexpr Vec3 operator-(const WorkspacePoint& a, const WorkspacePoint& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

constexpr WorkspacePoint operator+(const WorkspacePoint& a, const Vec3& metres)
{
    return {a.x + metres.x, a.y + metres.y, a.z + metres.z};
}

/// What a device reaches.
struct WorkspaceBox {
    WorkspacePoint low{};
    WorkspacePoint high{};

    constexpr bool operator==(const WorkspaceBox&) const = default;
};

} // namespace marsview
