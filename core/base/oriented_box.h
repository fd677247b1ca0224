// A box in any direction.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace marsview {

/// Its axes are perpendicular to each other, of length 1.
struct OrientedBox {
    Vec3 center;
    std::array<Vec3, 3> axes;
    std::array<double, 3> half_m{}; // of its sides, along the axes

    /// How far the box reaches from its center along a vector, times the vector's length.
    double reachAlong(const Vec3& along) const noexcept
    {
        double reach = 0.0;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            reach += half_m[i] * std::abs(dot(axes[i], along));
        }
        return reach;
    }
    double diagonal_m() const noexcept // NOLINT(readability-identifier-naming)
    {
        return 2.0 * std::hypot(half_m[0], half_m[1], half_m[2]);
    }
    /// Of a point from the nearest point of the box; 0 inside.
    double distanceFrom(const Vec3& point) const noexcept
    {
        const Vec3 way = point - center;
        std::array<double, 3> beyond{};
        for (std::size_t i = 0; i < axes.size(); ++i) {
            beyond[i] = std::max(std::abs(dot(axes[i], way)) - half_m[i], 0.0);
        }
        return std::hypot(beyond[0], beyond[1], beyond[2]);
    }
    std::array<Vec3, 8> corners() const noexcept
    {
        std::array<Vec3, 8> all{};
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto side = [&](std::size_t axis) {
                return axes[axis] * ((i >> axis & 1U) != 0 ? half_m[axis] : -half_m[axis]);
            };
            all[i] = center + side(0) + side(1) + side(2);
        }
        return all;
    }
};

} // namespace marsview
