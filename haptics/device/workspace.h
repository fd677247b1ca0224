// The device frame, in which positions are measured and forces act.
#pragma once

#include "core/base/vec.h"

namespace marsview {

/// A position of the device, in meters: x right, y away from the user, z up. Every driver converts
/// its own axes and units to these. Forces in this frame are Vec3 in newtons.
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

constexpr WorkspacePoint operator+(const WorkspacePoint& a, const Vec3& meters)
{
    return {a.x + meters.x, a.y + meters.y, a.z + meters.z};
}

/// The reach of a device.
struct WorkspaceBox {
    WorkspacePoint low{};
    WorkspacePoint high{};

    constexpr bool operator==(const WorkspaceBox&) const = default;
};

} // namespace marsview
